# SPDX-License-Identifier: Apache-2.0
"""Tools that a project file declares: what is read, what is said of mistakes, and what an untrusted file gets."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from haros_ci.config.describe import describe
from haros_ci.config.load import load
from haros_ci.config.project import read_project
from haros_ci.errors import UserError
from haros_ci.model.declared_tool import DeclaredTool

NAME = ".haros-ci.yaml"
PAGE = (Path(__file__).parents[2] / "docs" / "declared-tools.md").read_text(encoding="utf-8")


def tools(text: str, *, trust: bool = True) -> tuple[DeclaredTool, ...]:
    found = read_project(f"linters:\n  {text}\n".encode(), NAME, trust_config=trust).values["declared"]
    assert isinstance(found, tuple)
    return found


def test_every_key() -> None:
    (tool,) = tools(
        "t: {exec: [t, -v, '{file}'], files: ['*.c'], languages: [cpp], reads: [.trc], output: regex, stream: stderr,"
        " pattern: '(?P<path>.+): (?P<message>.+)', levels: {b: off, a: error}, exit: [3, 0], timeout: 5}"
    )
    assert tool == DeclaredTool(
        name="t",
        argv=("t", "-v", "{file}"),
        files=("*.c",),
        languages=("cpp",),
        reads=(".trc",),
        output="regex",
        pattern="(?P<path>.+): (?P<message>.+)",
        levels=(("a", "error"), ("b", "off")),
        stream="stderr",
        exits=(0, 3),
        origin=".haros-ci.yaml:2",
    )


@pytest.mark.parametrize(
    ("rest", "stream", "exits"),
    [
        ("", "both", (0, 1)),
        (", output: json", "stdout", (0, 1)),
        (", exit: 3", "both", (3,)),
        (", exit: any", "both", ()),
    ],
)
def test_what_is_taken_for_granted(rest: str, stream: str, exits: tuple[int, ...]) -> None:
    (tool,) = tools(f"t: {{exec: [t, '{{files}}'], languages: [cpp]{rest}}}")
    assert (tool.stream, tool.exits) == (stream, exits)


@pytest.mark.parametrize("text", ["ruff: true", "ruff: {timeout: 5}", "ruff:", "ruff: {exec: }"])
def test_other_entries_declare_nothing(text: str) -> None:
    assert tools(text) == ()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t: {exec: 't --all', files: [a]}", "'exec' of linter 't' must be a list, not a text"),
        ("t: {exec: [], files: [a]}", "1 to 100 entries"),
        ("t: {exec: [t, 1], files: [a]}", "an argument in 'exec' of linter 't' must be text, not a number"),
        ("t: {exec: [''], files: [a]}", "must be text"),
        ("t: {exec: [--help], files: [a]}", "begins with an option"),
        ("t: {exec: ['{file}'], files: [a]}", "begins with a file"),
        ("t: {exec: [t, '--in={files}'], files: [a]}", "stands once, as an argument of its own"),
        ("t: {exec: [t, '{files}', '{files}'], files: [a]}", "stands once"),
        ("t: {exec: [t, '{files}', '{file}'], files: [a]}", "not beside {file}"),
        (f"t: {{exec: [t, {'x' * 1001}], files: [a]}}", "too long"),
        (f"t: {{exec: [{'t, ' * 101}], files: [a]}}", "1 to 100 entries"),
        ('t: {exec: [t, "a\\0b"], files: [a]}', "NUL"),
        ("t: {exec: [t]}", "does not say which files it is for"),
        ("t: {exec: [t], languages: [c++]}", "a language cannot be 'c\\+\\+'"),
        ("t: {exec: [t], files: [../a]}", "stay inside it"),
        ("t: {exec: [t], files: [a], reads: ['']}", "is empty"),
        ("t: {exec: [t], files: [a], output: xml}", "'output' cannot be 'xml'"),
        ("t: {exec: [t], files: [a], stream: all}", "'stream' cannot be 'all'"),
        ("t: {exec: [t], files: [a], exit: [256]}", "'exit' of linter 't' must be a list of codes from 0 to 255"),
        ("t: {exec: [t], files: [a], exit: []}", "must be a list of codes"),
        ("t: {exec: [t], files: [a], exit: [true]}", "must be a list of codes"),
        ("t: {exec: [t], files: [a], levels: {E: bad}}", "the level of 'E' cannot be 'bad'"),
        ("t: {exec: [t], files: [a], output: regex}", "'pattern' goes with output: regex, and that needs one"),
        ("t: {exec: [t], files: [a], pattern: x}", "'pattern' goes with output: regex"),
        ("t: {exec: [t], files: [a], output: regex, pattern: '(?P<path>a)'}", "has no group 'message'"),
        (
            "t: {exec: [t], files: [a], output: regex, pattern: '(?P<file>a)(?P<message>b)'}",
            "no group is called 'file'",
        ),
        ("t: {exec: [t], files: [a], output: regex, pattern: '(a)\\1'}", "invalid escape sequence"),
        ("t: {exec: [t], files: [a], fields: {path: x}}", "'fields' goes with output: json"),
        ("t: {exec: [t], files: [a], output: json, fields: {file: x}}", "unknown key 'file'"),
        ("t: {exec: [t], files: [a], output: json, fields: {path: [x]}}", "'path' in 'fields' must be text"),
        ("t: {exec: [t], files: [a], arguments: [-v]}", "has an 'exec'"),
        ("t: {exec: [t], files: [a], shell: true}", "unknown key 'shell'"),
        ("'a b': {exec: [t], files: [a]}", "a tool's name has letters, digits"),
        ("'a:b': {exec: [t], files: [a]}", "a tool's name has"),
        ("ruff: {files: [a]}", "'files' of linter 'ruff' is for a tool of your own, with an 'exec'"),
        ("ruff: {levels: {a: note}}", "'levels' of linter 'ruff' is for a tool of your own"),
    ],
)
@pytest.mark.parametrize("trust", [True, False])
def test_mistakes(text: str, message: str, trust: bool) -> None:
    with pytest.raises(UserError, match=rf"^\.haros-ci\.yaml:2: .*{message}") as raised:
        tools(text, trust=trust)
    assert raised.value.help


def test_an_untrusted_file_gets_a_note_and_no_tool(tmp_path: Path) -> None:
    text = "profile: ros\nlinters:\n  my-tool:\n    exec: [t, '{files}']\n    languages: [cpp]\n"
    (tmp_path / NAME).write_text(text)
    settings = load(tmp_path)
    assert settings.notes == (
        ".haros-ci.yaml:3: linter 'my-tool' starts a program, so it is run only with --trust-config",
    )
    assert settings.tools == () and settings.claims is None
    assert [tool.name for tool in settings.declared] == ["my-tool"], "its selectors are none the less good ones"
    trusted = load(tmp_path, trust_config=True)
    assert trusted.notes == () and trusted.tools == settings.declared
    (tmp_path / NAME).write_text(text + "    enabled: false\n")
    assert load(tmp_path).notes == ()
    assert load(tmp_path, isolated=True, trust_config=True).declared == ()


def test_settings_show_it(tmp_path: Path) -> None:
    (tmp_path / NAME).write_text("linters:\n  t: {exec: [t, '{files}'], files: [a], levels: {E: error}, exit: any}\n")
    shown = describe(load(tmp_path, trust_config=True))
    assert (
        '  t: {"exec": ["t", "{files}"], "files": ["a"], "output": "gcc", "levels": {"E": "error"}, "stream": "both",'
        ' "exit": "any"}\n' in shown
    )
    assert describe(load(tmp_path)).count("--trust-config") == 1


def test_the_page_has_working_examples_and_every_key() -> None:
    from haros_ci.config.declared import EXEC_KEYS
    from haros_ci.model.declared_tool import OUTPUTS, STREAMS
    from haros_ci.model.package import LANGUAGES

    (example,) = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    read = read_project(example.encode(), NAME, trust_config=True)
    assert read.notes == () and [tool.name for tool in read.values["declared"]] == ["chktex", "eslint", "perlcritic"]
    for key in EXEC_KEYS:
        assert re.search(rf"^\| `{key}` \|", PAGE, re.MULTILINE), key
    for word in (*OUTPUTS, *STREAMS, *LANGUAGES):
        assert f"`{word}`" in PAGE, word
