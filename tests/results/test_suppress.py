# SPDX-License-Identifier: Apache-2.0
"""Comments that silence findings, in the comment syntax of each kind of file."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.results.result import Result, Run, Tool
from haros_ci.results.rule import Level
from haros_ci.results.suppress import suppress

LANGUAGES = {
    "cpp": "cpp", "py": "python", "yaml": "yaml", "cmake": "cmake", "msg": "interface", "launch": "launch",
    "xml": "package", "sh": "shell", "dockerfile": "dockerfile", "md": "markdown", "bin": "",
}  # fmt: skip


def language(path: str) -> str:
    return LANGUAGES[path.rpartition(".")[2]]


def matches(selector: str, result: Result) -> bool:
    return selector in (result.rule, result.full_id, result.tool, "*")


def run(
    path: str, text: str, *lines: int | None, rule: str = "bad", value: float | None = None, **more: object
) -> tuple[list[bool], list[str], Run]:
    """Which of the results on *lines* are suppressed, what is unused, and the run."""
    results = tuple(Result("tool", rule, Level.WARNING, "Bad.", Location(path, line), value=value) for line in lines)
    before = Run(Tool("tool"), results=results, analysed=frozenset({path}))
    (after,), unused = suppress(
        (before,),
        lambda _: text,
        language,
        matches,
        enabled=lambda tool, path: ("bad", "worse"),
        **more,  # type: ignore[arg-type]
    )
    return [bool(result.suppressions) for result in after.results], [result.message for result in unused], after


FIRES: list[tuple[str, str, int]] = [
    ("a.cpp", "int a;  // haros: ignore[bad] because\n", 1),
    ("a.cpp", "int a;  /* haros: ignore[bad] */\n", 1),
    ("a.cpp", "// haros: ignore[bad] because\nint a;\n", 2),
    ("a.cpp", "// haros: ignore[bad] because\n\n// more\nint a;\n", 4),
    ("a.cpp", "/* haros: ignore[bad]\n * because */\nint a;\n", 3),
    ("a.cpp", "int a;  // haros: ignore[worse, bad] because\n", 1),
    ("a.cpp", "int a;  // haros: ignore[tool:bad]\n", 1),
    ("a.cpp", "int a;  // haros: ignore\n", 1),
    ("a.cpp", "int a;  // haros:ignore-line\n", 1),
    ("a.cpp", "int a;  // why, haros:ignore-line\n", 1),
    ("a.cpp", "int a;  // haros:ignore-line[bad]\n", 1),
    ("a.cpp", "// haros:ignore-next-line\nint a;\n", 2),
    ("a.cpp", "int b;  // haros: ignore-next-line[bad] because\nint a;\n", 2),
    ("a.cpp", "char b = '\"';  // haros:ignore-line\n", 1),
    ("a.cpp", "int b = 1'000;  // haros:ignore-line\n", 1),
    ("a.cpp", "int b = 0xAB'CD'EF;  // haros:ignore-line\n", 1),
    ("a.cpp", "double b = 1'000.5e3;  // haros:ignore-line\n", 1),
    ("a.cpp", "switch (a) { case'\"': b(); }  // haros:ignore-line\n", 1),
    ("a.cpp", "char b = MADE'\"';  // haros:ignore-line\n", 1),
    ("a.cpp", "char b = u8'\"';  // haros:ignore-line\n", 1),
    ("a.cpp", "int a;\r\nint b;  // haros:ignore-line\r\n", 2),
    ("a.cpp", "#include <a>  // haros:ignore-line\n", 1),
    ("a.py", "a = 1  # haros: ignore[bad] because\n", 1),
    ("a.py", "# haros: ignore[bad]\na = 1\n", 2),
    ("a.py", "a = '#'  # haros:ignore-line\n", 1),
    ("a.py", '"""a"""  # haros:ignore-line\n', 1),
    ("a.yaml", "a: 1  # haros: ignore[bad]\n", 1),
    ("a.yaml", "it: isn't  # haros: ignore[bad]\n", 1),
    ("a.cmake", "add(a)  # haros: ignore[bad]\n", 1),
    ("a.cmake", "#[[ haros: ignore[bad] ]]\nadd(a)\n", 2),
    ("a.msg", "int8 a  # haros: ignore[bad]\n", 1),
    ("a.launch", "<a/>  <!-- haros: ignore[bad] because -->\n", 1),
    ("a.launch", "<!-- haros: ignore[bad] -->\n<a/>\n", 2),
    ("a.launch", "<!--\n haros:ignore-next-line -->\n<a/>\n", 3),
    ("package.xml", "<!-- haros:ignore-next-line -->\n<a/>\n", 2),
    ("a.sh", "# haros: ignore[bad] because\necho $1\n", 2),
    ("a.sh", "echo 'it' \"#\" $#  # haros: ignore[bad]\n", 1),
    ("a.sh", "echo it\\'s  # haros: ignore[bad]\n", 1),
    ("a.dockerfile", "# haros: ignore[bad]\nRUN apt update\n", 2),
    ("a.md", "<!-- haros: ignore[bad] -->\nA robto.\n", 2),
]
QUIET: list[tuple[str, str, int]] = [
    ("a.cpp", "int a;  // haros: ignore[worse]\n", 1),
    ("a.cpp", "int a;\nint b;  // haros: ignore[bad]\n", 1),
    ("a.cpp", "int b;  // haros: ignore[bad]\nint a;\n", 2),
    ("a.cpp", "// haros:ignore-line\nint a;\n", 2),
    ("a.cpp", "// haros:ignore-next-line\n\nint a;\n", 3),
    ("a.cpp", 'f("// haros:ignore-line");\n', 1),
    ("a.cpp", 'f(R"(\n// haros:ignore-line\n)");\n', 2),
    ("a.cpp", 'f("\\"// haros:ignore-line");\n', 1),
    ("a.cpp", "# haros:ignore-line\n", 1),
    ("a.cpp", "int a;  // haros:ignored-line\n", 1),
    ("a.cpp", "int a;  // haros:ignore-lines\n", 1),
    ("a.cpp", "int a;  // haros ignore-line\n", 1),
    ("a.cpp", "int a;  // Haros:ignore-line\n", 1),
    ("a.cpp", "int a;  // NOLINT\n", 1),
    ("a.py", "a = '# haros:ignore-line'\n", 1),
    ("a.py", '"""\n# haros:ignore-line\n"""\n', 2),
    ("a.py", "a = 1  // haros:ignore-line\n", 1),
    ("a.py", "a = 1  # noqa\n", 1),
    ("a.yaml", "a: b# haros:ignore-line\n", 1),
    ("a.yaml", "a: '# haros:ignore-line'\n", 1),
    ("a.cmake", 'set(A "\n# haros:ignore-line")\n', 2),
    ("a.msg", "string S=a # haros:ignore-line\n", 1),
    ("a.msg", 'string s "# haros:ignore-line"\n', 1),
    ("a.launch", "<a/>  # haros:ignore-line\n", 1),
    ("a.launch", '<a b="haros:ignore-line"/>\n', 1),
    ("a.launch", "<a><![CDATA[\n<!-- haros:ignore-line -->\n]]></a>\n", 2),
    ("a.sh", "echo '\n# haros:ignore-line'\n", 2),
    ("a.sh", "echo a#haros:ignore-line\n", 1),
    ("a.sh", 'echo "# haros:ignore-line"\n', 1),
    ("a.dockerfile", "RUN a  # haros:ignore-line\n", 1),
    ("a.md", "# haros:ignore-line\n", 1),
    ("a.bin", "// haros:ignore-line\n", 1),
]


@pytest.mark.parametrize(("path", "text", "line"), FIRES)
def test_suppressed(path: str, text: str, line: int) -> None:
    silent, unused, _ = run(path, text, line)
    assert silent == [True]
    assert [message for message in unused if "worse" not in message] == []


@pytest.mark.parametrize(("path", "text", "line"), QUIET)
def test_not_suppressed(path: str, text: str, line: int) -> None:
    assert run(path, text, line)[0] == [False]


def test_what_a_suppression_says() -> None:
    _, _, after = run("a.cpp", "\nint a;  // haros: ignore[bad] - the vendor's  \n", 2)
    (suppression,) = after.results[0].suppressions
    assert (suppression.kind, suppression.justification) == ("inSource", "the vendor's")
    assert suppression.location == Location("a.cpp", 2, 9)
    _, _, after = run("a.launch", "<!-- haros: ignore[bad] the vendor's -->\n<a/>\n", 2)
    assert after.results[0].suppressions[0].justification == "the vendor's"


def test_only_the_line_is_meant() -> None:
    text = "int a;\nint b;  // haros:ignore-line\nint c;\n"
    assert run("a.cpp", text, 1, 2, 3, None)[0] == [False, True, False, False]


UNUSED = [
    (
        "int a;  // haros: ignore[bad] because\n",
        "In the comment 'haros: ignore[bad]', 'bad' suppresses no finding. Remove it.",
    ),
    (
        "int a;  // haros: ignore[bad, worse]\n",
        "In the comment 'haros: ignore[bad, worse]', 'bad', 'worse' suppress no finding. Remove them.",
    ),
]


@pytest.mark.parametrize(("text", "message"), UNUSED)
def test_unused(text: str, message: str) -> None:
    assert run("a.cpp", text)[1] == [message]


@pytest.mark.parametrize("text", ["int a;  // haros:ignore-line\n", "// haros:ignore-next-line\nint a;\n"])
def test_a_comment_without_a_rule_is_never_called_unused(text: str) -> None:
    assert run("a.cpp", text)[1] == []


def test_unused_part_of_a_list() -> None:
    assert run("a.cpp", "int a;  // haros: ignore[bad, worse]\n", 1)[1] == [
        "In the comment 'haros: ignore[bad, worse]', 'worse' suppresses no finding. Remove it."
    ]


def test_unused_is_a_note_of_our_own_at_the_comment() -> None:
    before = Run(Tool("tool"), analysed=frozenset({"a.cpp"}))
    _, (unused,) = suppress(
        (before,), lambda _: "\n x; // haros: ignore[bad]\n", language, matches, enabled=lambda tool, path: ("bad",)
    )
    assert (unused.full_id, unused.level, unused.location) == (
        "haros-ci:unused-suppression", Level.NOTE, Location("a.cpp", 2, 5),
    )  # fmt: skip


NOT_JUDGED = [
    ("another tool's rule", "// haros: ignore[other:bad]", Run(Tool("tool"), analysed=frozenset({"a.cpp"}))),
    ("rule that is off", "// haros: ignore[off]", Run(Tool("tool"), analysed=frozenset({"a.cpp"}))),
    ("file not analysed", "// haros: ignore[bad]", Run(Tool("tool"), analysed=frozenset({"b.cpp"}))),
    ("tool failed", "// haros: ignore[bad]", Run(Tool("tool"), analysed=frozenset({"a.cpp"}), successful=False)),
    (
        "all rules, tool failed",
        "// haros:ignore-line",
        Run(Tool("tool"), analysed=frozenset({"a.cpp"}), successful=False),
    ),
    ("all rules, own run only", "// haros:ignore-line", Run(Tool("haros-ci"), analysed=frozenset({"a.cpp"}))),
    ("in a string", 'f("// haros: ignore[bad]");', Run(Tool("tool"), analysed=frozenset({"a.cpp"}))),
]


@pytest.mark.parametrize(("name", "text", "before"), NOT_JUDGED, ids=[case[0] for case in NOT_JUDGED])
def test_not_called_unused(name: str, text: str, before: Run) -> None:
    texts = {"a.cpp": text, "b.cpp": ""}
    _, unused = suppress((before,), texts.__getitem__, language, matches, enabled=lambda tool, path: ("bad", "worse"))
    assert unused == ()


def test_without_a_catalogue_reported_rules_are_judged() -> None:
    result = Result("tool", "bad", Level.NOTE, "Bad.", Location("b.cpp", 1))
    before = Run(Tool("tool"), results=(result,), analysed=frozenset({"a.cpp", "b.cpp"}))
    texts = {"a.cpp": "x; // haros: ignore[bad]\ny; // haros: ignore[worse]", "b.cpp": ""}
    _, unused = suppress((before,), texts.__getitem__, language, matches)
    assert [result.location.line for result in unused] == [1]


METRICS = [
    ("a.cpp", "void f() {  // NOLINT\n", True),
    ("a.cpp", "void f() {  // NOLINT(bad)\n", True),
    ("a.cpp", "void f() {  // NOLINT(other, bad)\n", True),
    ("a.cpp", "// NOLINTNEXTLINE(bad)\n", False),
    ("a.cpp", "void f() {  // NOLINT(other)\n", False),
    ("a.cpp", "void f() {  // NOLINTER\n", False),
    ("a.cpp", 'void f("NOLINT") {\n', False),
    ("a.py", "def f():  # noqa\n", True),
    ("a.py", "def f():  # noqa: bad\n", True),
    ("a.py", "def f():  # noqa: E501,bad\n", True),
    ("a.py", "def f():  # noqa: E501\n", False),
    ("a.py", "def f(a='# noqa'):\n", False),
]


@pytest.mark.parametrize(("path", "text", "expected"), METRICS)
def test_metrics_honour_the_native_comments(path: str, text: str, expected: bool) -> None:
    silent, unused, _ = run(path, text, 1, value=31.0)
    assert (silent, unused) == ([expected], [])


def test_next_line_form_of_the_native_comment() -> None:
    assert run("a.cpp", "// NOLINTNEXTLINE(bad)\nvoid f() {\n", 2, value=31.0)[0] == [True]


def test_files_without_a_mention_are_not_read() -> None:
    before = Run(Tool("tool"), analysed=frozenset({"a.cpp", "b.cpp"}))
    read: list[str] = []

    def text(path: str) -> str:
        read.append(path)
        return ""

    assert suppress((before,), text, language, matches, mentions=lambda path: path == "b.cpp") == ((before,), ())
    assert read == ["b.cpp"]


def test_suppressions_from_elsewhere_stay() -> None:
    _, _, after = run("a.cpp", "x;  // haros:ignore-line\n", 1)
    again = replace(after, results=after.results * 1)
    (twice,), _ = suppress((again,), lambda _: "x;  // haros:ignore-line\n", language, matches)
    assert len(twice.results[0].suppressions) == 2


@pytest.mark.parametrize(
    ("names", "meant"),
    [("bda", ["bda"]), ("bad, bda", ["bda"]), ("tool:bda", ["tool:bda"]), ("bad", []), ("other", []), ("", [])],
)
def test_a_name_that_no_rule_has_is_an_error_with_what_was_meant(names: str, meant: list[str]) -> None:
    slips = {"bda": "did you mean 'bad'?", "tool:bda": "did you mean 'tool:bad'?"}
    text = f"int a;  // haros: ignore[{names}]\n"
    assert run("a.cpp", text, 1, slip=lambda name: slips.get(name, ""))[1] == [
        f"In the comment 'haros: ignore[{names}]', '{name}' is the name of no rule, so it silences nothing: {slips[name]}"
        for name in meant
    ]
