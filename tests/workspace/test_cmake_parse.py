# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.workspace.cmake_parse import MAX_DEPTH, parse_cmake


def words(text: str) -> list[tuple[str, bool]]:
    script = parse_cmake(f"f({text})")
    assert script.errors == ()
    return [(argument.text, argument.is_quoted) for argument in script.commands[0].arguments]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a b", [("a", False), ("b", False)]),
        ("a\n\tb\r\n c", [("a", False), ("b", False), ("c", False)]),
        ('"a b" c', [("a b", True), ("c", False)]),
        (r'"a \"b\" c"', [(r"a \"b\" c", True)]),
        ('"two\nlines"', [("two\nlines", True)]),
        (r"a\ b c\;d", [(r"a\ b", False), (r"c\;d", False)]),
        ("[[a ${b} ]]", [("a ${b} ", True)]),
        ("[==[a ]] ]=] b]==]", [("a ]] ]=] b", True)]),
        ("[[\nfirst newline is dropped]]", [("first newline is dropped", True)]),
        ("a # comment )\n b", [("a", False), ("b", False)]),
        ("a #[[comment )\n ]] b", [("a", False), ("b", False)]),
        ("(a AND b) OR c", [(w, False) for w in ["(", "a", "AND", "b", ")", "OR", "c"]]),
        ('-Da="b c"', [('-Da="b c"', False)]),
        ("$(MAKE) a", [("$(MAKE)", False), ("a", False)]),
        ("${a${b}}c", [("${a${b}}c", False)]),
        ("${yaml-cpp_VERSION}", [("${yaml-cpp_VERSION}", False)]),
        ("a[b]c", [("a[b]c", False)]),
        ("$<TARGET_OBJECTS:x>", [("$<TARGET_OBJECTS:x>", False)]),
        ('"a""b"', [("a", True), ("b", True)]),
        ("", []),
    ],
)
def test_arguments(text: str, expected: list[tuple[str, bool]]) -> None:
    assert words(text) == expected


def test_lines_and_columns_and_names() -> None:
    script = parse_cmake("# a\n#[[ b\n ]]\n  Set (A b)\nINCLUDE(c)")
    assert [(c.name, c.line, c.column) for c in script.commands] == [("set", 4, 3), ("include", 5, 1)]


def test_blocks() -> None:
    script = parse_cmake("if(A)\nx()\nelseif(B)\nforeach(i)\ny()\nendforeach()\nelse()\nendif(A)\nz()")
    block, last = script.commands
    assert [(opener.name, [inner.name for inner in body]) for opener, body in block.branches] == [
        ("if", ["x"]),
        ("elseif", ["foreach"]),
        ("else", []),
    ]
    assert last.name == "z"


@pytest.mark.parametrize(
    ("text", "kept", "error"),
    [
        ("a()\nb(", ["a"], (2, "b(...) is not closed; what follows is not read")),
        ("a()\n)b()", ["a"], (2, "a command was expected; what follows is not read")),
        ('a()\nb("c', ["a"], (2, "b(...) is not closed; what follows is not read")),
        ("a()\n#[[ b", ["a"], (2, "the bracket comment is not closed")),
        ("a()\nendif()\nb()", ["a", "b"], (2, "endif() closes nothing")),
        ("a()\nelse()\nb()", ["a", "b"], (2, "else() outside of if()")),
        ("a()\nif(x)\nb()", ["a", "if"], (2, "if() is not closed")),
    ],
)
def test_what_is_not_cmake(text: str, kept: list[str], error: tuple[int, str]) -> None:
    script = parse_cmake(text)
    assert [command.name for command in script.commands] == kept
    assert script.errors == (error,)


def test_deep_nesting_is_cut() -> None:
    depth = MAX_DEPTH + 3
    script = parse_cmake("if(a)\n" * depth + "endif()\n" * depth + "b()")
    assert [command.name for command in script.commands] == ["if", "b"]
    assert script.errors == ((MAX_DEPTH + 1, f"blocks nested deeper than {MAX_DEPTH}; what is deeper is not read"),)


def test_any_text() -> None:
    hypothesis = pytest.importorskip("hypothesis")
    alphabet = hypothesis.strategies.sampled_from([*'ab(){}[]=#"\\;$\n <>:', "\0", "\ue000", "if(", "endif()"])

    @hypothesis.settings(max_examples=60, deadline=None, database=None, derandomize=True)
    @hypothesis.given(hypothesis.strategies.lists(alphabet, max_size=60).map("".join))
    def check(text: str) -> None:
        parse_cmake(text)

    check()
