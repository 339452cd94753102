# SPDX-License-Identifier: Apache-2.0
"""Which project file counts, which value wins, and what a base revision changes."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from haros_ci.config.load import load
from haros_ci.config.settings import PathPolicy, Policy, Settings
from haros_ci.errors import UserError
from haros_ci.results.rule import Level


@dataclass(frozen=True)
class AtBase:
    """The base revision of what lies below *top*."""

    top: Path
    files: dict[str, str]

    def holds(self, path: Path) -> bool:
        return path.is_relative_to(self.top)

    def read(self, path: Path) -> bytes | None:
        text = self.files.get(path.relative_to(self.top).as_posix())
        return None if text is None else text.encode()


def write(root: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return root


@pytest.mark.parametrize(
    ("files", "start", "found"),
    [
        ({}, ".", None),
        ({"haros.yaml": ""}, ".", "haros.yaml"),
        ({".haros-ci.yaml": "", "haros.yaml": ""}, ".", ".haros-ci.yaml"),
        ({"haros.yaml": "", "src/x": ""}, "src", "haros.yaml"),
        ({".haros-ci.yaml": "", "src/pkg/haros.yaml": ""}, "src/pkg", "src/pkg/haros.yaml"),
        ({".haros-ci.yaml": "", "src/pkg/haros.yaml": ""}, "src", ".haros-ci.yaml"),
        ({"src/.haros-ci.yaml": ""}, ".", None),
        ({"haros.yml": "", ".haros-ci.yml": "", "haros-ci.yaml": ""}, ".", None),
        ({"haros.yaml/x": ""}, ".", None),
        ({"../.haros-ci.yaml": "profile: all"}, ".", None),
    ],
)
def test_discovery(tmp_path: Path, files: dict[str, str], start: str, found: str | None) -> None:
    root = tmp_path / "ws"
    root.mkdir()
    write(root, files)
    assert load(root, start=root / start).project_file == found


def test_files_are_not_merged(tmp_path: Path) -> None:
    write(tmp_path, {".haros-ci.yaml": "profile: all\n", "src/haros.yaml": "fail-on: note\n"})
    settings = load(tmp_path, start=tmp_path / "src")
    assert (settings.profile, settings.fail_on) == ("ros", Level.NOTE)


def test_a_start_elsewhere_is_the_root(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", {"haros.yaml": ""})
    write(tmp_path / "other", {"haros.yaml": ""})
    assert load(root, start=tmp_path / "other").project_file == "haros.yaml"


def test_isolated_reads_none(tmp_path: Path) -> None:
    write(tmp_path, {".haros-ci.yaml": "broken: ["})
    assert load(tmp_path, isolated=True) == Settings(root=tmp_path)


def test_a_named_file(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", {".haros-ci.yaml": "profile: all", "ci/strict.yaml": "profile: strict"})
    outside = write(tmp_path / "elsewhere", {"p.yaml": "profile: google"}) / "p.yaml"
    inside = load(root, project=root / "ci" / "strict.yaml")
    assert (inside.profile, inside.project_file) == ("strict", "ci/strict.yaml")
    assert load(root, project=outside).profile == "google"
    assert load(root, project=root / "ci" / ".." / "ci" / "strict.yaml").project_file == "ci/strict.yaml"


@pytest.mark.parametrize("name", ["none.yaml", "ci"])
def test_a_named_file_must_be_there(tmp_path: Path, name: str) -> None:
    (tmp_path / "ci").mkdir()
    with pytest.raises(UserError, match="no such project file"):
        load(tmp_path, project=tmp_path / name)


def test_named_and_isolated_exclude_each_other(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="--isolated"):
        load(tmp_path, project=tmp_path / "x", isolated=True)


def test_a_link_out_of_the_workspace(tmp_path: Path) -> None:
    secret = write(tmp_path, {"secret.yaml": "profile: all"}) / "secret.yaml"
    root = tmp_path / "ws"
    root.mkdir()
    (root / ".haros-ci.yaml").symlink_to(secret)
    with pytest.raises(UserError, match="symbolic link out of the workspace"):
        load(root)
    assert load(root, isolated=True).profile == "ros"


def test_a_link_within_the_workspace(tmp_path: Path) -> None:
    write(tmp_path, {"ci/p.yaml": "profile: all"})
    (tmp_path / ".haros-ci.yaml").symlink_to(tmp_path / "ci" / "p.yaml")
    assert load(tmp_path).profile == "all"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_is_no_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / ".haros-ci.yaml")
    assert load(tmp_path).project_file is None


def test_a_huge_file(tmp_path: Path) -> None:
    with (tmp_path / "haros.yaml").open("wb") as stream:
        stream.truncate(2_000_000_000)
    with pytest.raises(UserError, match=r"haros\.yaml: larger than"):
        load(tmp_path)


@pytest.mark.parametrize(
    ("text", "flags", "expected"),
    [
        ("", {}, {}),
        ("profile: all", {}, {"profile": "all"}),
        ("profile: all", {"profile": "strict"}, {"profile": "strict"}),
        ("profile: all", {"profile": None}, {"profile": "all"}),
        ("fail-on: error", {"fail_on": "note"}, {"fail_on": Level.NOTE}),
        ("fail-on: error", {"fail_on": "never"}, {"fail_on": None}),
        ("fail-on: never", {}, {"fail_on": None}),
        ("exclude: [a, b]", {"exclude": ("b", "c")}, {"exclude": ("a", "b", "c")}),
        ("select: [a]", {"select": ("b",)}, {"policy": Policy(select=("a",)), "command_line": Policy(select=("b",))}),
        ("", {"ignore": (("a", "b"), ("c",))}, {"command_line": Policy(ignore=("a", "b", "c"))}),
        ("baseline: k.jsonl", {"no_baseline": True}, {"baseline": None}),
        ("baseline: k.jsonl", {"no_baseline": False}, {"baseline": "k.jsonl"}),
        ("", {"jobs": 3, "require_baseline": True}, {"jobs": 3, "require_baseline": True}),
        ("", {"baseline_rev": "main", "imports": ("a.sarif",)}, {"baseline_rev": "main", "imports": ("a.sarif",)}),
        ("", {"allow_tool_failure": ("pylint",)}, {"allow_tool_failure": frozenset({"pylint"})}),
        ("", {"paths": ("src",), "output": ("sarif",), "why": True}, {"paths": ("src",)}),
        (
            "per-path: {a: {profile: all, ignore: [x]}}",
            {},
            {"per_path": (PathPolicy(globs=("a",), profile="all", policy=Policy(ignore=("x",))),)},
        ),
        (
            "per-path: {a: {profile: all, ignore: [x]}}",
            {"profile": "ros"},
            {"per_path": (PathPolicy(globs=("a",), policy=Policy(ignore=("x",))),)},
        ),
    ],
)
def test_precedence(tmp_path: Path, text: str, flags: dict[str, object], expected: dict[str, object]) -> None:
    settings = load(write(tmp_path, {".haros-ci.yaml": text}), command_line=flags)
    changed = {name for name in Settings.__slots__ if getattr(settings, name) != getattr(Settings(root=tmp_path), name)}
    assert {name: getattr(settings, name) for name in expected} == expected
    assert changed - {"project", "project_file", "origins"} <= expected.keys()


@pytest.mark.parametrize(
    ("flags", "message", "help_"),
    [
        ({"profile": "strikt"}, "--profile: unknown value 'strikt'", "did you mean 'strict'?"),
        ({"fail_on": "errors"}, "--fail-on: unknown value 'errors'", "did you mean 'error'?"),
        ({"exclude": ("../x",)}, "--exclude '../x': globs are relative to the workspace root", "write it like"),
    ],
)
def test_wrong_flags(tmp_path: Path, flags: dict[str, object], message: str, help_: str) -> None:
    with pytest.raises(UserError) as caught:
        load(tmp_path, command_line=flags)
    assert caught.value.message.startswith(message)
    assert help_ in (caught.value.help or "")


def test_paths_of_the_command_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = tmp_path / "ws"
    (root / "src").mkdir(parents=True)
    monkeypatch.chdir(root / "src")
    flags = {"baseline": "../known.jsonl", "compile_database": "../../build"}
    settings = load(root, command_line=flags)
    assert settings.baseline == "known.jsonl"
    assert settings.compile_database == str(tmp_path / "build")
    assert dict(settings.origins)["baseline"] == "command line"


@pytest.mark.parametrize(
    ("base", "head", "profile", "notes"),
    [
        ({}, {}, "ros", ()),
        ({".haros-ci.yaml": "profile: all"}, {".haros-ci.yaml": "profile: all"}, "all", ()),
        (
            {".haros-ci.yaml": "profile: strict"},
            {".haros-ci.yaml": "profile: bugs-only"},
            "strict",
            (".haros-ci.yaml differs from the base revision's .haros-ci.yaml, which this run uses",),
        ),
        (
            {},
            {".haros-ci.yaml": "profile: bugs-only"},
            "ros",
            (".haros-ci.yaml is not in the base revision: it has no effect until it is",),
        ),
        (
            {"haros.yaml": "profile: strict"},
            {},
            "strict",
            ("haros.yaml is removed here; this run still uses the base revision's",),
        ),
        (
            {"haros.yaml": "profile: strict"},
            {"haros.yaml": "profile: strict", ".haros-ci.yaml": "ignore: [x]"},
            "strict",
            (".haros-ci.yaml differs from the base revision's haros.yaml, which this run uses",),
        ),
        (
            {".haros-ci.yaml": "profile: all"},
            {".haros-ci.yaml": "broken: ["},
            "all",
            (".haros-ci.yaml differs from the base revision's .haros-ci.yaml, which this run uses",),
        ),
    ],
)
def test_the_base_revision_decides(
    tmp_path: Path, base: dict[str, str], head: dict[str, str], profile: str, notes: tuple[str, ...]
) -> None:
    write(tmp_path, head)
    settings = load(tmp_path, base=AtBase(tmp_path, base))
    assert (settings.profile, settings.notes) == (profile, notes)


def test_a_named_file_comes_from_the_base_revision_too(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", {"ci.yaml": "profile: bugs-only"})
    outside = write(tmp_path, {"own.yaml": "profile: google"}) / "own.yaml"
    assert load(root, project=root / "ci.yaml", base=AtBase(root, {"ci.yaml": "profile: all"})).profile == "all"
    assert load(root, project=outside, base=AtBase(root, {})).profile == "google"
    new = load(root, project=root / "ci.yaml", base=AtBase(root, {}))
    assert (new.profile, new.project_file) == ("ros", None)
    assert new.notes == ("ci.yaml is not in the base revision: it has no effect until it is",)


def test_without_the_base_no_file_of_the_workspace_counts(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", {"ci.yaml": "profile: all", ".haros-ci.yaml": "broken: ["})
    outside = write(tmp_path, {"own.yaml": "profile: google"}) / "own.yaml"
    for project in (None, root / "ci.yaml"):
        settings = load(root, project=project, base_missing="unknown revision 'x'.", command_line={"fail_on": "never"})
        assert (settings.profile, settings.project_file, settings.fail_on) == ("ros", None, None)
        assert [note.partition(":")[0].endswith(" does not count") for note in settings.notes] == [True]
        assert settings.without_base.startswith("unknown revision 'x'. The defaults and the command line are used: ")
    assert load(root, project=outside, base_missing="x").profile == "google"
    assert load(tmp_path, base_missing="x").notes == (), "where there is no project file nothing is to be said of one"
    assert load(root, project=outside).without_base == ""
    with pytest.raises(UserError, match="no such project file"):
        load(root, project=root / "gone.yaml", base_missing="x")


def test_beside_the_repository_files_are_read_from_disk(tmp_path: Path) -> None:
    root = write(tmp_path, {".haros-ci.yaml": "profile: all", "src/arm/ci.yaml": "profile: google"})
    base = AtBase(root / "src/arm", {"ci.yaml": "profile: strict"})
    assert (load(root, base=base).profile, load(root, base=base).notes) == ("all", ())
    assert load(root, project=root / "src/arm/ci.yaml", base=base).profile == "strict"


def test_without_a_project_file_no_yaml_is_imported(tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from haros_ci.config.load import load;"
        "import haros_ci.config.selection, haros_ci.config.selector;"
        "load(Path(sys.argv[1]), command_line={'select': ('a',), 'profile': 'all'});"
        "print(sorted({'yaml', 'difflib', 'json'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
