# SPDX-License-Identifier: Apache-2.0
"""Tools that a project file declares, run by the real runner; the tools are small scripts on PATH."""

from __future__ import annotations

import json
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from linter_samples import MemoryStore, everything, workspace

from haros_ci.linters.declared import declared
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.run import lint
from haros_ci.model.declared_tool import DeclaredTool
from haros_ci.results.result import Result, Run
from haros_ci.results.rule import Level

#: Prints what stands in a file beside it, and keeps a note of its arguments. Its code is the first line of that file.
SCRIPT = """#!{python} -IS
import os, sys
here = os.path.dirname(os.path.abspath(__file__))
if sys.argv[1:] == ["--version"]:
    print("tool 2.5.1"); sys.exit()
with open(os.path.join(here, "calls"), "a") as calls:
    calls.write(" ".join(sys.argv[1:]) + "\\n")
code, _, text = open(os.path.join(here, "says")).read().partition("\\n")
sys.stdout.write(text.replace("@ROOT@", os.getcwd()))
sys.exit(int(code))
"""
FILES = {"a.py": "import os\nx = 1\ny = 2\n", "b.py": "x = 1\n", "c.cpp": "int x;\n", "sub/d.py": "\n\n"}


@pytest.fixture
def box(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The directory on PATH with the tool."""
    place = tmp_path / "bin"
    place.mkdir()
    script = place / "my-tool"
    script.write_text(SCRIPT.format(python=sys.executable), encoding="utf-8")
    script.chmod(0o755)
    monkeypatch.setenv("PATH", f"{place}{os.pathsep}/usr/bin{os.pathsep}/bin")
    return place


def tool(**changes: Any) -> DeclaredTool:
    given: dict[str, Any] = {"name": "my-tool", "argv": ("my-tool", "{files}"), "languages": ("python",)}
    return DeclaredTool(**{**given, **changes})


def run(box: Path, tool: DeclaredTool, says: str, code: int = 1, store: MemoryStore | None = None, **more: Any) -> Run:
    (box / "says").write_text(f"{code}\n{says}", encoding="utf-8")
    space = workspace(box.parent / "ws", {**FILES, **more.pop("files", {})})
    (only,) = lint(space, declared([tool]), LintOptions(**more), store or MemoryStore(), everything)
    return only


def calls(box: Path) -> list[str]:
    return (box / "calls").read_text().splitlines() if (box / "calls").exists() else []


def told(run: Run) -> list[tuple[str, int | None, int | None, str, str, str]]:
    def row(r: Result) -> tuple[str, int | None, int | None, str, str, str]:
        return (r.location.path, r.location.line, r.location.column, r.level.value, r.rule, r.message)

    return [row(result) for result in run.results]


def complaint(run: Run) -> str:
    assert not run.successful and run.results == ()
    return " ".join(note.message for note in run.notifications)


GCC = """starting
./a.py:1:8: warning: unused import 'os' [W1]
a.py:2: error: x is wrong
@ROOT@/sub/d.py:1:1: note: looks empty
b.py:1:1: an odd thing: happens
b.py:1: fatal error: it ends [-Wend,-Wmore]
"""


def test_gcc(box: Path) -> None:
    done = run(box, tool(levels=(("note", "note"),)), GCC)
    assert done.successful and done.notifications == ()
    assert (done.tool.name, done.tool.version) == ("my-tool", "2.5.1")
    assert told(done) == [
        ("a.py", 1, 8, "warning", "W1", "unused import 'os'"),
        ("a.py", 2, None, "error", "error", "x is wrong"),
        ("b.py", 1, None, "error", "-Wend,-Wmore", "it ends"),
        ("b.py", 1, 1, "warning", "finding", "an odd thing: happens"),
        ("sub/d.py", 1, 1, "note", "note", "looks empty"),
    ]
    assert calls(box) == ["./a.py ./b.py ./sub/d.py"], "names cannot be options; other kinds are not given"
    assert done.analysed == {"a.py", "b.py", "sub/d.py"}


def test_notes_explain_what_is_above(box: Path) -> None:
    done = run(box, tool(), "a.py:1:1: error: bad [E]\nb.py:1:1: note: because of this\n/usr/x.py:1: note: elsewhere\n")
    (only,) = done.results
    assert [(r.location.path, r.message) for r in only.related] == [("b.py", "because of this")]


def test_a_note_with_a_rule_stands_for_itself(box: Path) -> None:
    done = run(box, tool(), "a.py:1:1: warning: bad [S1]\na.py:2:1: note: less bad [S2]\n")
    assert [(rule, level) for _, _, _, level, rule, _ in told(done)] == [("S1", "warning"), ("S2", "note")]


REGEX = r"^(?P<level>[EW]) (?P<path>\S+) line (?P<line>\d+)(?:-(?P<end_line>\d+))?: (?P<message>.*) \((?P<rule>\w+)\)$"


def test_regex(box: Path) -> None:
    declared_one = tool(output="regex", pattern=REGEX, levels=(("E", "error"), ("W", "off")))
    done = run(box, declared_one, "E a.py line 2-3: bad (x1)\nW a.py line 1: less bad (x2)\nall done\n")
    assert told(done) == [("a.py", 2, None, "error", "x1", "bad")]
    assert done.results[0].location.end_line == 3


def test_checkstyle(box: Path) -> None:
    says = """<?xml version="1.0"?><checkstyle><file name="a.py">
    <error line="1" column="2" severity="error" message="m &amp; n" source="r.S"/></file>
    <file name="b.py"><error line="x" severity="info" message="whole file"/></file><file name="z.py"/></checkstyle>"""
    done = run(box, tool(output="checkstyle"), says)
    assert told(done) == [
        ("a.py", 1, 2, "error", "r.S", "m & n"),
        ("b.py", None, None, "note", "info", "whole file"),
    ]


@pytest.mark.parametrize(
    ("fields", "document"),
    [
        ((), [{"path": "a.py", "line": 3, "rule": "R", "level": "error", "message": "m"}]),
        ((), {"path": "a.py", "line": "3", "rule": "R", "level": "ERROR", "message": "m"}),
        (
            (("results", "issues"), ("path", "place.file"), ("line", "place.lines.0"), ("rule", "code")),
            {"issues": [{"place": {"file": "a.py", "lines": [3, 9]}, "code": "R", "level": "error", "message": "m"}]},
        ),
        (
            (("results", "*.messages"), ("path", "filePath"), ("rule", "ruleId"), ("level", "severity")),
            [{"filePath": "a.py", "messages": [{"line": 3, "ruleId": "R", "severity": 2, "message": "m"}]}],
        ),
        (
            (("results", "files.*"), ("level", "tool.worst")),
            {"tool": {"worst": "error"}, "files": {"one": [{"path": "a.py", "line": 3, "rule": "R", "message": "m"}]}},
        ),
    ],
)
def test_json(box: Path, fields: tuple[tuple[str, str], ...], document: object) -> None:
    done = run(box, tool(output="json", fields=fields, levels=(("2", "error"),)), json.dumps(document))
    assert told(done) == [("a.py", 3, None, "error", "R", "m")]


def test_json_lines(box: Path) -> None:
    says = '{"file": "a.py", "line": 1, "message": "m"}\n\n{"file": "b.py", "message": "n", "rule": 7}\n'
    done = run(box, tool(output="json-lines", fields=(("path", "file"),)), says)
    assert told(done) == [("a.py", 1, None, "warning", "finding", "m"), ("b.py", None, None, "warning", "7", "n")]


def sarif(*results: dict[str, object], **more: object) -> str:
    return json.dumps(
        {"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "x"}}, "results": list(results), **more}]}
    )


def at(uri: str, line: int = 1) -> list[dict[str, object]]:
    return [{"physicalLocation": {"artifactLocation": {"uri": uri}, "region": {"startLine": line, "startColumn": 2}}}]


def test_sarif(box: Path) -> None:
    inside = {"ruleId": "R", "level": "error", "message": {"text": "m"}, "locations": at("a.py", 3)}
    foreign = [
        {**inside, "locations": at(uri)} for uri in ("../x.py", "/etc/passwd", "file:///etc/passwd", "z.py", "c:/a.py")
    ]
    done = run(box, tool(output="sarif"), sarif(inside, *foreign), 0)
    assert told(done) == [("a.py", 3, 2, "error", "R", "m")] and done.results[0].tool == "my-tool"
    failed = run(box, tool(output="sarif"), sarif(inside, invocations=[{"executionSuccessful": False}]), 0)
    assert "did not succeed" in complaint(failed)


@pytest.mark.parametrize("output", ["gcc", "regex", "json", "json-lines"])
def test_nothing_to_say(box: Path, output: str) -> None:
    done = run(box, tool(output=output, pattern=REGEX), "", 0)
    assert done.successful and done.results == ()


# -- ways of being called ------------------------------------------------------------------------------------------


def test_one_file_at_a_time(box: Path) -> None:
    done = run(box, tool(argv=("my-tool", "--in={file}")), "", 0)
    assert done.successful
    assert calls(box) == ["--in=./a.py", "--in=./b.py", "--in=./sub/d.py"]


def test_without_files_once_for_all(box: Path) -> None:
    store = MemoryStore()
    whole = tool(argv=("my-tool", "--all"))
    done = run(box, whole, "b.py:1: warning: w\n", store=store)
    assert calls(box) == ["--all"] and told(done) == [("b.py", 1, None, "warning", "warning", "w")]
    assert done.analysed == {"a.py", "b.py", "sub/d.py"}
    assert told(run(box, whole, "b.py:1: warning: other\n", store=store)) == told(done) and len(calls(box)) == 1
    changed = run(box, whole, "b.py:1: warning: other\n", store=store, files={"b.py": "x = 2\n"})
    assert [row[-1] for row in told(changed)] == ["other"] and len(calls(box)) == 2


def test_the_cache_knows_command_settings_and_what_is_read(box: Path) -> None:
    store = MemoryStore()
    first = tool(argv=("my-tool", "--config=.myrc", "{files}"), reads=("*.cpp",))
    asked = 0
    for change, files in [
        ({}, {}),
        ({"argv": ("my-tool", "--config=.myrc", "-v", "{files}")}, {}),
        ({"levels": (("warning", "error"),)}, {}),
        ({}, {".myrc": "strict\n"}),
        ({}, {"c.cpp": "int y;\n"}),
    ]:
        run(box, replace(first, **change), "", 0, store=store, files=files)
        asked += 1
        assert len(calls(box)) == asked, "asked anew"
    run(box, first, "", 0, store=store, files={"c.cpp": "int y;\n", "other.xml": "<a/>\n"})
    assert len(calls(box)) == asked, "nothing of all that has changed"
    script = box / "my-tool"
    script.write_text(script.read_text() + "# a new release\n")
    run(box, first, "", 0, store=store)
    assert len(calls(box)) == asked + 1


def test_a_program_of_the_workspace_only_by_its_path(box: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inside = box.parent / "ws" / "tools"
    inside.mkdir(parents=True)
    (box / "my-tool").rename(inside / "my-tool")
    (inside / "says").write_text("0\n")
    monkeypatch.setenv("PATH", f"{inside}{os.pathsep}{os.environ['PATH']}")
    assert "not installed" in complaint(run(box, tool(), "", 0))
    assert run(box, tool(argv=("tools/my-tool", "{files}")), "", 0).successful
    assert run(box, tool(argv=("{root}/tools/my-tool", "--at={root}", "{files}")), "", 0).successful
    root = box.parent / "ws"
    assert calls(inside)[1] == f"--at={root} ./a.py ./b.py ./sub/d.py"


# -- trouble -------------------------------------------------------------------------------------------------------

BOMB = '<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><checkstyle><file name="a.py"><error message="&b;"/></file></checkstyle>'


@pytest.mark.parametrize(
    ("changes", "says", "code", "words"),
    [
        ({}, "a.py:1: error: e\n", 2, "exit code 2"),
        ({}, "usage: my-tool\n", 1, "exit code 1, and no line of its output is a finding"),
        ({"output": "json"}, "", 1, "exit code 1, and nothing was written"),
        ({"output": "sarif"}, "", 1, "exit code 1, and nothing was written"),
        ({"stream": "stderr"}, "a.py:1: error: e\n", 1, "exit code 1, and nothing was written"),
        ({"output": "json"}, "oops", 1, "cannot be parsed"),
        ({"output": "json"}, "[" * 100_000, 0, "failed"),
        ({"output": "json"}, '{"a":' * 100_000, 0, "failed"),
        ({"output": "json"}, '[{"message": "no place"}]', 0, "an entry without path: check 'fields'"),
        ({"output": "json"}, '[{"path": "a.py"}]', 0, "an entry without message"),
        ({"output": "json-lines"}, "{}\n{", 0, "failed"),
        ({"output": "checkstyle"}, "a.py:1: error: e\n", 0, "not XML"),
        ({"output": "checkstyle"}, BOMB, 0, "document type declaration"),
        ({"output": "sarif"}, "[]", 0, "not a SARIF log"),
        ({"output": "sarif"}, '{"version": "2.1.0", "runs": ' + "[" * 100_000, 0, "nested too deeply"),
        (
            {},
            "c.cpp:1: warning: in a header\n",
            1,
            "reports on c.cpp, which it was not given: name such files under 'reads'",
        ),
        ({"argv": ("no-such-tool", "{files}")}, "", 0, "my-tool is not installed"),
    ],
)
def test_trouble_is_never_green(box: Path, changes: dict[str, Any], says: str, code: int, words: str) -> None:
    assert words in complaint(run(box, tool(**changes), says, code))


def test_what_it_also_reads_it_may_report_on(box: Path) -> None:
    one = tool(argv=("my-tool", "{file}"), languages=(), files=("a.py",), reads=("*.cpp",))
    assert told(run(box, one, "c.cpp:1: warning: in a header\n")) == [
        ("c.cpp", 1, None, "warning", "warning", "in a header")
    ]
    many = tool(reads=("*.cpp",))
    done = run(box, many, "c.cpp:1: warning: in a header\n")
    assert done.successful and len(calls(box)) > 2, "asked again with fewer files, until it is clear whose it is"


def test_a_flood_ends(box: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("haros_ci.linters.tool_text.MAX_FINDINGS", 50)
    assert "more than 50 findings" in complaint(
        run(box, tool(files=("a.py",), languages=()), "a.py:1: error: e\n" * 51)
    )


def test_hostile_text_becomes_one_clean_line(box: Path) -> None:
    says = (
        "a.py:1:1: error: \x1b[31mred\x1b[0m \x1b]0;title\x07bell\x07 \x9b2J \u202eback\t[ok]\n"
        f"b.py:999999999:1: warning: {'long ' * 10_000}\n"
        "b.py:99999999999999999999:1: error: no such line\n"
        "\x1b[1msub/d.py:1:\x1b[0m warning: coloured [\x1b[35mW\x1b[0m]\n"
        f"{'x' * 100_000}:1: error: e\n"
    )
    done = run(box, tool(), says)
    assert [(p, line, rule) for p, line, _, _, rule, _ in told(done)] == [
        ("a.py", 1, "error"),
        ("b.py", 999999999, "warning"),
        ("sub/d.py", 1, "W"),
    ]
    first, second, third = (result.message for result in done.results)
    assert first == "red bell 2J back [ok]" and third == "coloured"
    assert 3000 < len(second) <= 4000 and all(message.isprintable() for message in (first, second, third))


@pytest.mark.parametrize(
    "path",
    [
        "../ws2/a.py",
        "/etc/passwd",
        "/a.py",
        "a.py/../../a.py",
        "sub/../../a.py",
        "z.py",
        "a.py\0",
        "~/a.py",
        "c:\\a.py",
    ],
)
def test_places_elsewhere_are_dropped(box: Path, path: str) -> None:
    done = run(box, tool(output="json"), json.dumps([{"path": path, "line": 1, "message": "m"}]))
    assert done.successful and done.results == ()


@pytest.mark.parametrize("path", ["a.py", "./a.py", "sub/../a.py", ".//a.py", "@ROOT@/a.py", " a.py "])
def test_places_inside_are_found(box: Path, path: str) -> None:
    done = run(box, tool(output="json"), json.dumps([{"path": path, "line": 1, "message": "m"}]))
    assert [result.location.path for result in done.results] == ["a.py"]


@pytest.mark.parametrize(
    ("word", "level"),
    [
        ("Error", Level.ERROR),
        ("fatal", Level.ERROR),
        ("WARNING", Level.WARNING),
        ("info", Level.NOTE),
        ("E501", Level.WARNING),
    ],
)
def test_levels_by_likeness(word: str, level: Level) -> None:
    (adapter,) = declared([tool()])
    assert adapter.level_of(word) is level


@pytest.mark.parametrize(
    ("word", "level"), [("E", Level.ERROR), ("e", Level.NOTE), ("minor", None), ("error", Level.NOTE), ("MINOR", None)]
)
def test_levels_as_told(word: str, level: Level | None) -> None:
    (adapter,) = declared([tool(levels=(("*", "note"), ("E", "error"), ("minor", "off")))])
    assert adapter.level_of(word) is level
