# SPDX-License-Identifier: Apache-2.0
"""What the adapters for C++, build, shell and configuration files make of captured output and of settings."""

from __future__ import annotations

import json
import re
from pathlib import Path
from types import ModuleType

import pytest
from linter_samples import MemoryStore, workspace
from test_adapters import brief, parse

from haros_ci.linters import (
    clang_format,
    cmake_lint,
    cmakelint,
    flawfinder,
    hadolint,
    shellcheck,
    xmllint,
    yaml_settings,
    yamllint,
)
from haros_ci.linters.linter import Batch, Finding, GaveUp, LintOptions, Program
from haros_ci.model.location import Location

PROGRAM = Program(("tool",), "1")

DOCUMENT = "<?xml version='1.0'?>\n<replacements xml:space='preserve' incomplete_format='false'>\n{}</replacements>\n"


def replaced(*spans: tuple[int, int]) -> str:
    return DOCUMENT.format("".join(f"<replacement offset='{a}' length='{n}'>&#10;</replacement>\n" for a, n in spans))


def formatted(root: Path, files: dict[str, str], stdout: str, code: int = 0) -> list[Finding | GaveUp]:
    """With what ``--verbose`` tells of the files, but for ``ignored.cpp``."""
    told = sorted(path for path in files if path.endswith(".cpp") and path != "ignored.cpp")
    stderr = "".join(f"Formatting [{n}/{len(told)}] ./{path}\n" for n, path in enumerate(told, start=1))
    return parse(clang_format, root, files, stdout, stderr, code)


def regions(said: list[Finding | GaveUp]) -> list[tuple[int | None, int | None, str]]:
    return [
        (s.result.location.line, s.result.location.column, s.result.message.partition(" as ")[0])
        for s in said
        if isinstance(s, Finding)
    ]


#: "é" is two bytes: offsets count them, columns do not.
SOURCE = "/* é */ int  a;\nint b;\n\n\n\nint  c;\n"
CLANG_FORMAT = [
    (replaced(), []),
    (replaced((12, 2)), [(1, 12, "Not formatted")]),
    (replaced((12, 2), (16, 1)), [(1, 12, "Not formatted to line 2")]),
    (replaced((12, 2), (20, 1)), [(1, 12, "Not formatted to line 2")]),
    (replaced((12, 2), (30, 2)), [(1, 12, "Not formatted"), (6, 4, "Not formatted")]),
    (replaced((23, 3)), [(2, 7, "Not formatted to line 5")]),
]


@pytest.mark.parametrize(("stdout", "expected"), CLANG_FORMAT)
def test_clang_format_tells_a_place_once(tmp_path: Path, stdout: str, expected: list[object]) -> None:
    assert regions(formatted(tmp_path, {"a.cpp": SOURCE}, stdout)) == expected


def test_clang_format_answers_in_the_order_of_the_files(tmp_path: Path) -> None:
    stdout = replaced() + replaced((0, 1))
    assert brief(formatted(tmp_path, {"b.cpp": "x", "a.cpp": "x"}, stdout)) == [("b.cpp", "formatting", "b.cpp:1:1")]


def test_clang_format_says_how_many_places_it_leaves_out(tmp_path: Path) -> None:
    text = "int  a;\n\n" * 40
    said = formatted(tmp_path, {"a.cpp": text}, replaced(*((9 * n + 3, 2) for n in range(40))))
    assert len(said) == clang_format.MOST and isinstance(said[-1], Finding)
    assert "15 more places" in said[-1].result.message


@pytest.mark.parametrize(("stdout", "code"), [("", 0), (replaced() * 2, 0), (replaced(), 1), (replaced()[:-5], 0)])
def test_clang_format_refuses(tmp_path: Path, stdout: str, code: int) -> None:
    with pytest.raises(ValueError):
        formatted(tmp_path, {"a.cpp": SOURCE}, stdout, code)


def test_clang_format_may_leave_out_what_is_to_be_ignored(tmp_path: Path) -> None:
    files = {"a.cpp": "x", "ignored.cpp": "x"}
    with pytest.raises(ValueError, match="no answer for ignored.cpp"):
        formatted(tmp_path, files, replaced())
    assert formatted(tmp_path, {**files, ".clang-format-ignore": "ignored.cpp\n"}, replaced()) == []


TABLE = "File,Line,Column,DefaultLevel,Level,Category,Name,Warning,Suggestion,Note,CWEs,Context,Fingerprint,ToolVersion,RuleId,HelpUri\n"
ROW = './0/a b.cpp,4,11,4,4,buffer,strcpy,"Unbounded, it seems (CWE-120).",Bound it.,,CWE-120,"x, y",00,2.0.20,FF1001,https://x\n'


def test_flawfinder(tmp_path: Path) -> None:
    assert parse(flawfinder, tmp_path, {"a b.cpp": ""}, TABLE) == []
    (said,) = parse(flawfinder, tmp_path, {"a b.cpp": ""}, TABLE + ROW)
    assert isinstance(said, Finding)
    assert (said.result.rule, said.result.location) == ("FF1001", Location("a b.cpp", 4, 11, 4, 17))
    assert said.result.message == "strcpy: Unbounded, it seems (CWE-120). Bound it."


@pytest.mark.parametrize(
    ("stdout", "code"),
    [("", 0), (TABLE, 14), ("Error: failed\n" + TABLE, 0), (TABLE + ROW.replace("./0/", "./9/"), 0)],
)
def test_flawfinder_refuses(tmp_path: Path, stdout: str, code: int) -> None:
    with pytest.raises((ValueError, KeyError)):
        parse(flawfinder, tmp_path, {"a b.cpp": ""}, stdout, code=code)


def comment(**changes: object) -> dict[str, object]:
    plain = {"file": "./0/a.sh", "line": 2, "column": 6, "endLine": 2, "endColumn": 8, "level": "info", "code": 2086}
    return {**plain, "message": "Quote it.", "fix": None, **changes}


SHELLCHECK = [
    ([], []),
    ([comment()], [Location("a.sh", 2, 6, 2, 8)]),
    ([comment(endColumn=6)], [Location("a.sh", 2, 6)]),
    ([comment(endLine=3, endColumn=1)], [Location("a.sh", 2, 6, 3, 1)]),
]


@pytest.mark.parametrize(("comments", "expected"), SHELLCHECK)
def test_shellcheck(tmp_path: Path, comments: list[object], expected: list[Location]) -> None:
    said = parse(shellcheck, tmp_path, {"a.sh": ""}, json.dumps({"comments": comments}), code=1)
    assert [s.result.location for s in said if isinstance(s, Finding)] == expected
    assert {s.result.rule for s in said if isinstance(s, Finding)} <= {"SC2086"}


@pytest.mark.parametrize(("adapter", "name"), [(shellcheck, "a.sh"), (hadolint, "Dockerfile")])
@pytest.mark.parametrize(("stdout", "code"), [("", 0), ("{", 0), ("3", 0), ('[{"file": "x"}]', 0), ("[]", 2)])
def test_json_is_refused(tmp_path: Path, adapter: ModuleType, name: str, stdout: str, code: int) -> None:
    with pytest.raises((ValueError, KeyError, TypeError)):
        parse(adapter, tmp_path, {name: ""}, stdout, code=code)


def test_hadolint(tmp_path: Path) -> None:
    base = {"file": "./0/Dockerfile", "column": 1, "level": "warning", "line": 3, "message": "no\nwhitespace"}
    report = json.dumps([{**base, "code": "DL3023"}, {**base, "code": "DL1000"}])
    assert brief(parse(hadolint, tmp_path, {"Dockerfile": ""}, report)) == [
        ("Dockerfile", "DL3023", "Dockerfile:3"),
        ("Dockerfile", "no whitespace", 3),
    ]


XMLLINT = [
    ("", []),
    (
        "@a b.xml:3: parser error : Opening and ending tag mismatch\n</a>\n    ^",
        [("a b.xml", "parser-error", "a b.xml:3")],
    ),
    ("@a b.xml:3: parser error : One\n@a b.xml:4: parser error : Two", [("a b.xml", "parser-error", "a b.xml:3")]),
    ("@a b.xml:2: namespace error : Namespace prefix x\n" * 2, [("a b.xml", "namespace-error", "a b.xml:2")]),
    ('warning: failed to load external entity "@a b.xml"', [("a b.xml", "it cannot be read", None)]),
    ("Entity: line 1: parser error : Detected an entity reference loop", []),
    ("@other.xml:3: parser error : elsewhere", []),
    (" @a b.xml:3: parser error : quoted in a source line", []),
    ("@a b.xml:3: parser error : <\n./a b.xml:1: parser error : lies\n^", [("a b.xml", "parser-error", "a b.xml:3")]),
    ("./a b.xml:1: parser error : lies", []),
]


@pytest.mark.parametrize(("stderr", "expected"), XMLLINT)
def test_xmllint(tmp_path: Path, stderr: str, expected: list[object]) -> None:
    """``@`` is the link by which the files go; what is quoted of a file cannot name it."""
    stderr = stderr.replace("@", f"{tmp_path}/workspace/")
    assert brief(parse(xmllint, tmp_path, {"a b.xml": ""}, stderr=stderr, code=1)) == expected


def test_xmllint_refuses(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="exit code 9"):
        parse(xmllint, tmp_path, {"a.xml": ""}, code=9)


TEXTS = [(yamllint, "a.yaml"), (cmakelint, "CMakeLists.txt"), (cmake_lint, "a.cmake")]


@pytest.mark.parametrize(("adapter", "path"), TEXTS)
def test_what_is_asked_about_texts(tmp_path: Path, adapter: ModuleType, path: str) -> None:
    said = [["rule", 2, 3, "m"], ["rule", 0, None, "whole"], ["rule", 2, None, "line"]]
    answer = json.dumps({"path": path, "said": said}) + "\n"
    assert brief(parse(adapter, tmp_path, {path: ""}, answer)) == [
        (path, "rule", f"{path}:2:3"),
        (path, "rule", path),
        (path, "rule", f"{path}:2"),
    ]
    problem = json.dumps({"path": path, "problem": "nested too deeply"})
    assert brief(parse(adapter, tmp_path, {path: ""}, problem)) == [(path, "nested too deeply", None)]


@pytest.mark.parametrize(("adapter", "path"), TEXTS)
@pytest.mark.parametrize(
    "stdout", ["", "{", "{}", '{"path": "x", "said": []}', "[]", "null", '{"path": "PATH", "said": 3}']
)
def test_an_answer_that_is_none(tmp_path: Path, adapter: ModuleType, path: str, stdout: str) -> None:
    with pytest.raises((ValueError, KeyError, TypeError)):
        parse(adapter, tmp_path, {path: ""}, stdout.replace("PATH", path))


def test_yamllint_does_without_patterns_that_are_not_there(tmp_path: Path) -> None:
    (asked,) = request(tmp_path, yamllint, {"a.yaml": "", ".yamllint": "ignore-from-file: [gone]\n"})
    assert asked["settings"] == {"ignore": [], "rules": {}} and asked["needs"] == [".yamllint", "gone"]


def request(root: Path, adapter: ModuleType, files: dict[str, str], **options: bool) -> list[dict[str, object]]:
    """What the worker is asked, one request for each settings file, with its path as ``group``."""
    space, chosen = workspace(root, files), LintOptions(**options)  # type: ignore[arg-type]
    units = list(adapter.plan(space, chosen, MemoryStore()))
    asked = []
    for group in sorted({unit.group for unit in units}):
        batch = Batch(space, tuple(u.file for u in units if u.group == group), chosen, root, group)
        needs = sorted({path for unit in units if unit.group == group for path in unit.settings})
        asked.append({**json.loads(adapter.command(PROGRAM, batch).stdin), "group": group, "needs": needs})
    return asked


YAMLLINT = [
    ({}, yamllint.DEFAULT_SETTINGS),
    ({".yamllint": "extends: relaxed\n"}, {"extends": "relaxed", "rules": {}}),
    ({".yamllint": "rules: {truthy: disable}\nlocale: en_US.UTF-8\n"}, {"rules": {"truthy": False}}),
    (
        {
            ".yamllint": "extends: ci/base.yml\nrules: {braces: {level: warning}}\n",
            "ci/base.yml": "extends: default\nrules:\n  braces: {max-spaces-inside: 1}\n",
        },
        {"extends": "default", "rules": {"braces": {"max-spaces-inside": 1, "level": "warning"}}},
    ),
    (
        {".yamllint": "ignore-from-file: .gitignore\n", ".gitignore": "build/\n*.tmp\n"},
        {"ignore": ["build/", "*.tmp"], "rules": {}},
    ),
    (
        {".yamllint": "rules: {truthy: {ignore-from-file: list}}\n", "list": "a.yaml\n"},
        {"rules": {"truthy": {"ignore": ["a.yaml"]}}},
    ),
]


@pytest.mark.parametrize(("files", "settings"), YAMLLINT)
def test_yamllint_gets_its_settings_in_one_piece(
    tmp_path: Path, files: dict[str, str], settings: dict[str, object]
) -> None:
    (asked,) = request(tmp_path, yamllint, {"a.yaml": "x: 1\n", **files})
    assert asked["settings"] == settings
    assert asked["needs"] == sorted(path for path in files)
    assert asked["files"] == [{"path": "a.yaml", "name": "a.yaml", "text": "x: 1\n"}]


REFUSED = [
    (yamllint, ".yamllint", "extends: ../outside.yml\n", "'../outside.yml', which lies outside"),
    (yamllint, ".yamllint", "extends: /etc/hostname\n", "'/etc/hostname', which lies outside"),
    (yamllint, ".yamllint", "extends: gone.yml\n", "'gone.yml', which is no file"),
    (yamllint, ".yamllint", "extends: .yamllint\n", "one too many"),
    (yamllint, ".yamllint", "ignore-from-file: ../../etc/passwd\n", "which lies outside"),
    (yamllint, ".yamllint", "rules: [\n", "line 2: "),
    (yamllint, ".yamllint", "- a\n", "not a map"),
    (yamllint, ".yamllint", "rules: [a]\n", "rules is not a map"),
    (cmake_lint, ".cmake-format.yaml", "lint: [\n", "line 2: "),
    (cmake_lint, ".cmake-format.json", "[" * 100, "nested deeper than"),
]


@pytest.mark.parametrize(("adapter", "name", "text", "reason"), REFUSED)
def test_settings_that_cannot_be_followed_end_the_run(
    tmp_path: Path, adapter: ModuleType, name: str, text: str, reason: str
) -> None:
    with pytest.raises(ValueError, match=f"{re.escape(name)}: ") as err:
        request(tmp_path / "root", adapter, {"a.yaml": "", "a.cmake": "", name: text})
    assert reason in str(err.value)


def test_the_nearest_settings_hold_and_begin_where_they_lie(tmp_path: Path) -> None:
    files = {".yamllint": "rules: {}\n", "p/.yamllint.yml": "ignore: b/\n", "a.yaml": "", "p/b/c.yaml": ""}
    outer, inner = request(tmp_path, yamllint, files)
    assert (outer["group"], inner["group"]) == (".yamllint", "p/.yamllint.yml")
    assert inner["files"] == [{"path": "p/b/c.yaml", "name": "b/c.yaml", "text": ""}]


CMAKE_LINT = [
    ({}, {"config": {}}),
    (
        {".cmake-format.yaml": "lint: {max_branches: 3}\ninclude: [/etc/passwd]\n"},
        {"config": {"lint": {"max_branches": 3}}},
    ),
    ({".cmake-format.json": '{"encode": {"input_encoding": "x"}, "line_width": 9}'}, {"config": {"line_width": 9}}),
    ({".cmake-format": "import os\nos.system('id')\n"}, {"config": {}}),
    ({".cmake-format.py": "import os\n", "cmake-format.py": "x\n"}, {"config": {}}),
]


@pytest.mark.parametrize(("files", "settings"), CMAKE_LINT)
def test_cmake_lint_gets_data_alone(tmp_path: Path, files: dict[str, str], settings: dict[str, object]) -> None:
    (asked,) = request(tmp_path, cmake_lint, {"a.cmake": "", **files})
    assert asked["settings"] == settings


def test_cmake_lint_gets_the_file_itself_where_it_is_trusted(tmp_path: Path) -> None:
    (asked,) = request(tmp_path, cmake_lint, {"a.cmake": "", ".cmake-format.py": "x = 1\n"}, trust_config=True)
    assert asked["settings"] == {"file": str(tmp_path / ".cmake-format.py")}


PASS = ["disable=SC2086,SC2046", "enable=all", "shell=dash", "  disable=SC2034  # unused", "extended-analysis=false"]
STOP = [
    "external-sources=true",
    "source-path=/etc",
    "source-path=SCRIPTDIR",
    "disable=SC2086 external-sources=true",
    "x",
]


def test_of_a_shellcheckrc_only_what_leads_nowhere_is_passed(tmp_path: Path) -> None:
    space = workspace(tmp_path / "root", {"a.sh": "", ".shellcheckrc": "\n".join([*PASS, *STOP])})
    (unit,) = shellcheck.plan(space, LintOptions(), MemoryStore())
    command = shellcheck.command(PROGRAM, Batch(space, (unit.file,), LintOptions(), tmp_path, unit.group))
    assert command.cwd is not None and command.cwd.is_relative_to(tmp_path)
    assert (command.cwd / ".shellcheckrc").read_text().splitlines() == PASS
    assert unit.settings == (".shellcheckrc",)


@pytest.mark.parametrize(
    ("first", "linted"),
    [
        ("#!/bin/sh", True),
        ("#!/usr/bin/env bash", True),
        ("echo", True),
        ("#!/bin/bash # not zsh\n", True),
        ("#!/bin/zsh", False),
        ("#!/usr/bin/env fish", False),
        ("#!/bin/tcsh -f", False),
    ],
)
def test_scripts_of_other_shells_are_left_alone(tmp_path: Path, first: str, linted: bool) -> None:
    space = workspace(tmp_path, {"a.sh": first + "\n"})
    assert bool(list(shellcheck.plan(space, LintOptions(), MemoryStore()))) == linted


def test_clang_format_is_for_files_that_a_style_is_written_for(tmp_path: Path) -> None:
    files = {
        "p/.clang-format": "BasedOnStyle: InheritParentConfig\n",
        "p/q/a.cpp": "",
        "b.cpp": "",
        "p/.clang-format-ignore": "q/*\n",
    }
    (unit,) = clang_format.plan(workspace(tmp_path, files), LintOptions(), MemoryStore())
    assert (unit.file.path, unit.group) == ("p/q/a.cpp", "p/.clang-format")
    assert set(unit.settings) == {"p/.clang-format", "p/.clang-format-ignore"}


def test_clang_format_gives_up_names_that_fit_nowhere(tmp_path: Path) -> None:
    name = "/".join(["d" * 200] * 8) + ".cpp"
    files = {"a.cpp": "x", name: ""}
    stderr = "Formatting [1/1] ./a.cpp\n"
    said = parse(clang_format, tmp_path, files, replaced(), stderr)
    assert brief(said) == [(name, "its name is too long", None)]


BOUNDED = [
    "a: " + "[" * 30 + "]" * 30,
    "a: &a [1]\nc: [" + "*a, " * 30 + "]",
    "x" * 60_000,
    "&a [*a]",
    "a: !!python/object:os.system x",
    "? [1, 2]\n: x",
    "a: !!bool x",
    "a: !!int ''",
    "a: !!float ''",
    "a: !!timestamp x",
    "a: 2020-13-01",
]


@pytest.mark.parametrize("text", BOUNDED)
def test_settings_are_read_within_limits(text: str) -> None:
    with pytest.raises(ValueError):
        yaml_settings.read(text)


@pytest.mark.parametrize(
    ("text", "value"),
    [("", {}), ("# x\n", {}), ("a: 2020-01-01\n", {"a": "2020-01-01"}), ("a: &b 1\nc: *b", {"a": 1, "c": 1})],
)
def test_settings_are_plain_values(text: str, value: object) -> None:
    assert yaml_settings.read(text) == value
