# SPDX-License-Identifier: Apache-2.0
"""``haros-ci report`` and ``check --output html=FILE``, as processes of their own."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from commandline import commit, haros, write
from page_kit import SCHEMA, Parts
from small_robot import FILES, TALKER

from haros_ci.commands.output import parse_outputs, text_in
from haros_ci.errors import UserError
from haros_ci.haros_json.documents import history_of
from haros_ci.haros_json.summary import HISTORY

#: No linter has a rule on: they take most of the time, and are not what is tried here.
QUICK = ("--profile", "architecture", "--ignore", "pylint,cppcheck", "--allow-tool-failure", "lizard", "--allow-tool-failure", "radon")  # fmt: skip


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = write(tmp_path_factory.mktemp("ws"), FILES)
    commit(root)
    return root


def data_in(path: Path) -> dict[str, Any]:
    data: dict[str, Any] = json.loads(Parts(path.read_text(encoding="utf-8")).texts["script"][0])
    jsonschema.validate(data, SCHEMA)
    return data


def texts(data: dict[str, Any], key: str) -> list[str]:
    return [data["tables"]["texts"][one["name"]] for one in data[key]]


def test_the_page_is_written_where_it_is_asked_for(workspace: Path, tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    done = haros("report", ".", *QUICK, "--output", str(out), cwd=workspace)
    assert done.returncode == 0 and "open it in a browser" in done.stderr, done.stderr
    data = data_in(out)
    assert texts(data, "configurations") == ["robot/launch/a.launch.py"]
    assert texts(data, "packages") == ["robot"]
    assert data["findings"] and data["changes"] is None and data["launch_files"] == 1


def test_a_check_writes_the_same_page(workspace: Path, tmp_path: Path) -> None:
    one, other = tmp_path / "one.html", tmp_path / "other.html"
    haros("report", ".", *QUICK, "--output", str(one), cwd=workspace)
    done = haros("check", ".", *QUICK, "--output", f"html={other}", "--output", "text", cwd=workspace)
    assert done.returncode == 1 and "node_name" in done.stdout
    assert one.read_bytes() == other.read_bytes()


def test_what_is_as_it_was_is_not_made_again(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", FILES)

    def stages(name: str) -> set[str]:
        done = haros("report", ".", *QUICK, "--timings", "--output", f"../{name}", cwd=root)
        assert done.returncode == 0, done.stderr
        return {line[19:].strip() for line in done.stderr.splitlines()}

    assert {"link", "structure"} <= stages("one.html")
    assert not {"link", "structure"} & stages("two.html")
    assert (tmp_path / "one.html").read_bytes() == (tmp_path / "two.html").read_bytes()
    write(root, {"robot/robot/talker.py": TALKER.replace("def main", "def start")})
    assert {"link", "structure"} <= stages("three.html")
    assert "start" in data_in(tmp_path / "three.html")["tables"]["texts"]


def test_what_a_branch_changes(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", FILES)
    base = commit(root)
    write(root, {"robot/robot/talker.py": TALKER.replace('"chatter"', '"shouting"')})
    done = haros("report", ".", *QUICK, "--base", base, "--output", "page.html", cwd=root)
    assert done.returncode == 0, done.stderr
    data = data_in(root / "page.html")
    assert [row[:2] for row in data["changes"]["rows"]] == [["publisher", "renamed"]]
    assert {row[3] for row in data["findings"]} <= {"known", "counted"}


def test_quality_over_time_is_what_a_folder_has_kept(workspace: Path, tmp_path: Path) -> None:
    folder, page = tmp_path / "data", tmp_path / "page.html"
    folder.mkdir()
    done = haros("check", ".", *QUICK, "--output", f"haros-json={folder}", "--output", f"html={page}", cwd=workspace)
    assert done.returncode == 1, done.stderr
    assert [point[0] for point in data_in(page)["history"]] == ["2024-01-01-00-00"]
    haros("report", ".", *QUICK, "--output", str(page), cwd=workspace)
    assert data_in(page)["history"] == []
    haros("report", ".", *QUICK, "--history", str(folder), "--output", str(page), cwd=workspace)
    assert len(data_in(page)["history"]) == 1


def test_what_monitor_says_is_shown(workspace: Path, tmp_path: Path) -> None:
    page, said = tmp_path / "page.html", tmp_path / "said.json"
    one = {"verdict": "violated", "text": "globally: no /a", "witnesses": []}
    said.write_text(json.dumps({"recording": {"name": "a.mcap"}, "properties": [one]}), encoding="utf-8")
    done = haros("report", ".", *QUICK, "--verdicts", str(said), "--output", str(page), cwd=workspace)
    assert done.returncode == 0, done.stderr
    assert texts(data_in(page), "verdicts") == ["a.mcap"]


@pytest.mark.parametrize("content", [None, "{}"])
def test_verdicts_that_are_none(tmp_path: Path, content: str | None) -> None:
    said = tmp_path / "said.json"
    if content is not None:
        said.write_text(content, encoding="utf-8")
    done = haros("report", ".", "--verdicts", str(said), cwd=tmp_path)
    assert done.returncode == 2 and "said.json" in done.stderr and not (tmp_path / "haros-ci-report.html").exists()


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        "{",
        "[" * 5000,
        '{"history": {"timestamps": ["<script>"]}}',
        '{"history": {"timestamps": ["2024-01-01-00-00"], "lines_of_code": ["x"]}}',
        '{"history": {"timestamps": 3}}',
    ],
)
def test_a_history_that_is_none(tmp_path: Path, content: str) -> None:
    write(tmp_path, {"default/summary.json": content})
    assert history_of({}, lambda name: text_in(tmp_path, name)) == ()


def test_of_a_history_only_numbers_are_taken() -> None:
    keys = {key: [1, "<b>", 3, True] for key in HISTORY}
    keys["timestamps"] = ["2024-01-02-00-00", "2024-01-01-00-00", "<img>", "2024-01-03-00-00"]
    points = history_of({"project": "../a/b"}, lambda name: json.dumps({"history": keys}))
    assert points == (("2024-01-02-00-00", 1, 1, 1, 1, 1, 1, 1),)


def test_a_folder_that_is_a_link_is_not_read(tmp_path: Path) -> None:
    write(tmp_path / "away", {"summary.json": "{}"})
    (tmp_path / "data").mkdir()
    (tmp_path / "data/default").symlink_to(tmp_path / "away")
    with pytest.raises(UserError):
        history_of({}, lambda name: text_in(tmp_path / "data", name))


def test_no_folder_is_said(workspace: Path, tmp_path: Path) -> None:
    done = haros(
        "report", ".", *QUICK, "--history", str(tmp_path / "no"), "--output", str(tmp_path / "p.html"), cwd=workspace
    )
    assert done.returncode == 2 and "is no directory" in done.stderr and not (tmp_path / "p.html").exists()


def browser_that_notes(tmp_path: Path) -> str:
    """What the environment names as the browser: it writes down what it is to open."""
    script = tmp_path / "browser.sh"
    script.write_text(f'#!/bin/sh\nprintf "%s" "$1" > "{tmp_path}/opened"\n')
    script.chmod(0o755)
    return f"{script} %s"


def test_the_page_is_opened_if_asked_for(workspace: Path, tmp_path: Path) -> None:
    out, opened, browser = tmp_path / "a b.html", tmp_path / "opened", browser_that_notes(tmp_path)
    done = haros("report", ".", *QUICK, "--output", str(out), cwd=workspace, BROWSER=browser)
    assert done.returncode == 0 and not opened.exists()
    done = haros("report", ".", *QUICK, "--open", "--output", str(out), cwd=workspace, BROWSER=browser)
    assert done.returncode == 0 and opened.read_text() == out.as_uri(), done.stderr


def test_nothing_is_opened_in_ci(workspace: Path, tmp_path: Path) -> None:
    out, browser = tmp_path / "page.html", browser_that_notes(tmp_path)
    done = haros("report", ".", *QUICK, "--open", "--output", str(out), cwd=workspace, BROWSER=browser, CI="true")
    assert done.returncode == 0 and "not opened in CI" in done.stderr
    assert out.exists() and not (tmp_path / "opened").exists()


def test_one_configuration(workspace: Path, tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    chosen = haros(
        "report", ".", *QUICK, "--configuration", "robot/launch/a.launch.py", "--output", str(out), cwd=workspace
    )
    assert chosen.returncode == 0 and len(data_in(out)["configurations"]) == 1
    done = haros("report", ".", *QUICK, "--configuration", "away", "--output", str(tmp_path / "no.html"), cwd=workspace)
    assert done.returncode == 2 and "no configuration away" in done.stderr and "robot/launch/a.launch.py" in done.stderr
    assert not (tmp_path / "no.html").exists()


def test_rates_where_they_are_asked_for(tmp_path: Path) -> None:
    """Also where the page without them is in the cache."""
    root = write(tmp_path / "ws", FILES)

    def rates(*more: str) -> list[list[str]]:
        out = tmp_path / "page.html"
        done = haros("report", ".", *QUICK, *more, "--output", str(out), cwd=root)
        assert done.returncode == 0, done.stderr
        data = data_in(out)
        [one] = data["configurations"]
        return [[data["tables"]["texts"][number] for number in row] for row in one["rates"]["published"]]

    assert rates() == []
    found = rates("--rates")
    assert found and all(len(row) == 3 for row in found)
    assert rates() == []


def test_dependence_where_it_is_asked_for(workspace: Path, tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    done = haros("report", ".", *QUICK, "--output", str(out), cwd=workspace)
    assert done.returncode == 0 and [one["dependence"] for one in data_in(out)["configurations"]] == [[]]
    done = haros("report", ".", *QUICK, "--dependence", "--output", str(out), cwd=workspace)
    data = data_in(out)
    [one] = data["configurations"]
    assert done.returncode == 0 and len(one["dependence"]) == len(one["nodes"]), done.stderr
    assert data["tables"]["dependence"]


def test_a_base_that_cannot_be_had_is_no_page(workspace: Path, tmp_path: Path) -> None:
    done = haros("report", ".", *QUICK, "--base", "nowhere", "--output", str(tmp_path / "no.html"), cwd=workspace)
    assert done.returncode == 2 and not (tmp_path / "no.html").exists()


def test_nothing_to_look_at_is_a_page(tmp_path: Path) -> None:
    (tmp_path / "ws").mkdir()
    done = haros("report", ".", *QUICK, "--output", "page.html", cwd=tmp_path / "ws")
    assert done.returncode == 0, done.stderr
    assert data_in(tmp_path / "ws/page.html")["findings"] == []


def test_the_format_goes_to_stdout_alone() -> None:
    assert parse_outputs(("html",)) == (("html", None),)
    with pytest.raises(Exception, match="cannot share stdout"):
        parse_outputs(("html", "text"))


@pytest.mark.parametrize(
    "command",
    [("report", ".", "--output", "OUT"), ("check", ".", "--output", "html=OUT"), ("check", ".", "--output", "haros-json=DIR")],
)  # fmt: skip
def test_what_a_check_measures_is_not_measured_again(tmp_path: Path, command: tuple[str, ...]) -> None:
    pytest.importorskip("lizard")
    root = write(tmp_path / "ws", {**FILES, "robot/src/x.cpp": "int f() { return 1; }\n"})
    names = [
        word.replace("OUT", str(tmp_path / "page.html")).replace("DIR", str(tmp_path / "data")) for word in command
    ]
    (tmp_path / "data").mkdir()
    only = ("--isolated", "--profile", "architecture", "--ignore", "pylint,cppcheck", "--select", "metrics:max-cyclomatic-complexity-15", "--cache-dir", str(tmp_path / "cache"))  # fmt: skip
    done = haros(*names, *only, "--timings", "--allow-tool-failure", "radon", cwd=root)
    assert done.returncode in (0, 1), done.stderr
    assert " lizard\n" in done.stderr and "lizard values" not in done.stderr
