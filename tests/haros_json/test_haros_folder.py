# SPDX-License-Identifier: Apache-2.0
"""A directory as an output: whole files, nothing else touched, other projects and earlier points kept."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import haros_kit as kit
import pytest

from haros_ci.commands.output import parse_outputs, text_in
from haros_ci.errors import UserError
from haros_ci.haros_json.documents import added, documents
from haros_ci.model.location import Location
from haros_ci.writing import put_below


def test_whole_files_below_a_new_directory(tmp_path: Path) -> None:
    folder = tmp_path / "a" / "data"
    put_below(folder, {"p/x/1.json": "[]\n", "p.json": "é\n"})
    assert (folder / "p" / "x" / "1.json").read_text() == "[]\n"
    assert sorted(path.name for path in folder.rglob("*") if path.is_file()) == ["1.json", "p.json"]
    put_below(folder, {"p.json": "2"})
    assert (folder / "p.json").read_text() == "2"


def test_what_lies_there_stays(tmp_path: Path) -> None:
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "mine.json").write_text("mine")
    put_below(tmp_path, {"p/a.json": "1"})
    assert (tmp_path / "p" / "mine.json").read_text() == "mine"


def test_a_link_in_the_place_of_a_file_is_replaced_and_not_followed(tmp_path: Path) -> None:
    (tmp_path / "victim").write_text("safe")
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "p.json").symlink_to(tmp_path / "victim")
    put_below(tmp_path / "data", {"p.json": "new"})
    assert (tmp_path / "victim").read_text() == "safe"
    assert (tmp_path / "data" / "p.json").read_text() == "new"


@pytest.mark.parametrize("place", ["p", "p/compliance"])
def test_a_directory_behind_a_link_is_refused(tmp_path: Path, place: str) -> None:
    (tmp_path / "away").mkdir()
    target = tmp_path / "data" / place
    target.parent.mkdir(parents=True)
    target.symlink_to(tmp_path / "away")
    with pytest.raises(UserError, match="is a symbolic link"):
        put_below(tmp_path / "data", {"p/compliance/a.json": "1"})
    assert list((tmp_path / "away").iterdir()) == []


@pytest.mark.parametrize("path", ["data", "data/p", "data/p/a.json/x"])
def test_what_is_in_the_way_is_said(tmp_path: Path, path: str) -> None:
    """A file where a directory has to be, a directory where a file has to be."""
    target = tmp_path / path
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("")
    with pytest.raises(UserError, match="cannot be written"):
        put_below(tmp_path / "data", {"p/a.json": "1"})


def test_a_directory_is_needed(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="is no directory"):
        parse_outputs((f"haros-json={tmp_path / 'file'}",))
    with pytest.raises(UserError, match="haros-json is several files"):
        parse_outputs(("haros-json",))
    assert parse_outputs((f"haros-json={tmp_path}",)) == (("haros-json", tmp_path),)
    assert parse_outputs(("haros-json=d", "text")) == (("haros-json", Path("d")), ("text", None))


def test_text_that_may_be_read(tmp_path: Path) -> None:
    (tmp_path / "projects.json").write_text("[]")
    (tmp_path / "link.json").symlink_to("projects.json")
    (tmp_path / "bad.json").write_bytes(b"\xff")
    assert text_in(tmp_path, "projects.json") == "[]"
    assert text_in(tmp_path, "none.json") is None
    for name in ("link.json", "bad.json", "."):
        with pytest.raises(UserError):
            text_in(tmp_path, name)


# -- what is kept of before --------------------------------------------------------------------------------------------


def run_of(name: str, when: str | None = None, issues: int = 0) -> dict[str, str]:
    results = [
        kit.result(kit.BRACES, "cpplint", "Said" + " again" * n, location=Location("base/src/base.cpp", 7 + n, 3))
        for n in range(issues)
    ]
    return documents(kit.given(results, project={"project": name}, timestamp=when))


def test_other_projects_stay_in_their_place() -> None:
    others = [{"id": "one", "packages": [], "repositories": []}, {"id": "two"}, {"id": "three"}]
    whole = added(run_of("two"), {"projects.json": json.dumps(others)}.get)
    listed = json.loads(whole["projects.json"])
    assert [one["id"] for one in listed] == ["one", "two", "three"]
    assert listed[0] == others[0]
    assert listed[1]["packages"] == ["base", "extra"]


@pytest.mark.parametrize("text", ["{}", "[1]", "no", "[" * 100_000])
def test_what_is_no_list_of_projects_is_not_overwritten(text: str) -> None:
    with pytest.raises(ValueError):
        added(run_of("two"), {"projects.json": text}.get)


def test_the_history_of_earlier_revisions_is_kept() -> None:
    first = added(run_of("p", "2024-01-01-00-00", 2), lambda _: None)
    second = added(run_of("p", "2024-02-01-00-00", 1), first.get)
    again = added(run_of("p", "2024-02-01-00-00", 1), second.get)
    kit.read(second)
    history = json.loads(second["p/summary.json"])["history"]
    assert history["timestamps"] == ["2024-01-01-00-00", "2024-02-01-00-00"]
    assert history["issues"] == [2, 1]
    assert again == second
    older = json.loads(added(run_of("p", "2023-01-01-00-00"), second.get)["p/summary.json"])["history"]
    assert older["timestamps"] == ["2023-01-01-00-00"]


@pytest.mark.parametrize(
    "history",
    [
        None,
        [],
        {},
        {"timestamps": ["2020-01-01-00-00"]},
        {key: ["2020-01-01-00-00"] for key in ("timestamps", "issues")},
        "nonsense",
    ],
)
def test_a_history_that_is_none_is_dropped(history: Any) -> None:
    own = run_of("p", "2024-01-01-00-00")
    assert (
        added(own, {"p/summary.json": json.dumps({"history": history})}.get)["p/summary.json"] == own["p/summary.json"]
    )
    assert added(own, {"p/summary.json": "{"}.get)["p/summary.json"] == own["p/summary.json"]


def test_points_that_are_none_are_dropped() -> None:
    first = json.loads(run_of("p", "2020-01-01-00-00")["p/summary.json"])
    for key, values in first["history"].items():
        values += ["<b>" if key == "timestamps" else 1, values[0]]
    first["history"]["issues"][2] = "many"
    own = run_of("p", "2024-01-01-00-00")
    history = json.loads(added(own, {"p/summary.json": json.dumps(first)}.get)["p/summary.json"])["history"]
    assert history["timestamps"] == ["2020-01-01-00-00", "2024-01-01-00-00"]
