# SPDX-License-Identifier: Apache-2.0
"""Input that is deep, long, broken or random: a Program comes back, and it is JSON."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.extract.python.read import read_python
from haros_ci.extract.python.tokens import longest_chain
from haros_ci.syntax.codec import decoded, encoded

MANY = 3000


def shape(text: str) -> list[tuple[int, str]]:
    """The problems; fails where the Program does not fit a JSON encoder."""
    program = read_python(text)
    assert decoded(encoded(program)) == program
    return list(program.problems)


@pytest.mark.parametrize(
    "text",
    [
        "x = 1" + " + 1" * 500,
        "x = a" + ".b" * 500,
        "x = a" + "()" * 500,
        "x = " + "not " * 500 + "a",
        "x = a" + " and a" * MANY,
        "x = a" + " < a" * MANY,
        "x = " + "1 if a else " * 300 + "1",
        "x = " + "lambda: " * 300 + "1",
        "if a: b\n" + "elif a: b\n" * 300,
        "a = " * MANY + "b",
        "".join(" " * i + "if a:\n" for i in range(99)) + " " * 99 + "[[[f()]]]",
    ],
    ids=range(11),
)
def test_deep_input_is_cut_with_one_problem(text: str) -> None:
    ((_, message),) = shape(text)
    assert message == "nested deeper than 100 levels: what lies deeper is unknown; split the statement or function"


@pytest.mark.parametrize(
    "text",
    ["(" * MANY, "x = 1" + " + 1" * 100_000, "-" * 20_000 + "1", "if a: b\n" + "elif a: b\n" * 20_000],
    ids=range(4),
)
def test_what_cannot_be_parsed_for_its_depth_is_a_problem(text: str) -> None:
    assert len(shape(text)) == 1


@pytest.mark.parametrize(
    "text",
    [
        "x = [" + "f(1L), " * MANY + "]",
        "x = [" + "f('é'), " * MANY + "]",
        "import a\n" * MANY,
        ", ".join(f"a{i}" for i in range(MANY)) + " = f()",
        "class " + "A" * 100_000 + ":\n" + "  def f(): pass\n" * 1000,
        "x = '\udcff'",
        "x = 0x" + "f" * 5000,
        "\\\n" * MANY + "a",
        "\x0cif a:\n\x0c  b\n",
    ],
    ids=range(9),
)
def test_long_or_odd_input_is_read(text: str) -> None:
    assert shape(text) == []


def test_a_null_byte_is_a_problem() -> None:
    assert shape("a\nb\0c\n") == [(2, "not Python text: it has a null byte")]


def test_nothing_is_executed(capsys: pytest.CaptureFixture[str]) -> None:
    shape("print('run')\nraise SystemExit\n")
    assert capsys.readouterr().out == ""


def test_no_warning_for_old_escapes(recwarn: pytest.WarningsRecorder) -> None:
    shape("x = '\\d' is 'a'\n")
    assert len(recwarn) == 0


@pytest.mark.parametrize(
    ("text", "length"),
    [
        ("", 0),
        ("a.b.c + d", 3),
        ("a.b, c.d, e.f", 1),
        ("f(a + b + c, d)\n", 2),
        ("a(1, 2)(3, 4)(5)", 3),
        ("'a.b.c' # d.e.f", 0),
        ("a + (\nb\n+ c)", 2),
        ("a + b\nc + d", 1),
    ],
)
def test_longest_chain(text: str, length: int) -> None:
    assert longest_chain(text) == length


def test_random_text_never_raises(tmp_path: Path) -> None:
    hypothesis = pytest.importorskip("hypothesis")
    hypothesis.configuration.set_hypothesis_home_dir(tmp_path)
    words = [
        "print",
        "except",
        "raise",
        "exec",
        "if",
        "else",
        "lambda",
        "def",
        "class",
        "for",
        "in",
        "a",
        "é",
        "07",
        "1L",
    ]
    marks = ["(", ")", "[", "]", "{", "}", ":", ",", ";", "=", ".", "`", "<>", ">>", "*", "'", '"', "'''", "f'{", "\\"]
    pieces = hypothesis.strategies.sampled_from([*words, *marks, "\n", "\r", "\t", " ", "\n  ", "\0", "\x0c", "\ufeff"])

    @hypothesis.settings(max_examples=60, deadline=None, database=None, derandomize=True)
    @hypothesis.given(hypothesis.strategies.lists(pieces, max_size=30))
    def check(parts: list[str]) -> None:
        shape(" ".join(parts))
        shape("".join(parts))

    check()
