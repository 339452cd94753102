# SPDX-License-Identifier: Apache-2.0
"""What a file says of names, all of it looked up at once."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from haros_ci.checking import file_words

PATH = "a.py"


def code(text: str) -> Any:
    """As much of a codebase as is asked for."""
    source = SimpleNamespace(path=PATH, program=SimpleNamespace(language="python"))
    return SimpleNamespace(kept={}, text=lambda path: text, sources=(source,))


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("hasattr(self, 'a')\n", {"a"}),
        ('getattr(x, "a", "b")\n', {"a", "b"}),
        ("getattr(x, y)\n", set()),
        ("# hasattr(self, 'a')\n", set()),
        ("call(self, 'a')\n", set()),
    ],
)
def test_asked_for(text: str, names: set[str]) -> None:
    assert file_words.asked_for(code(text), PATH) == names


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("f(1)\ng (2)\n", {"f", "g"}),
        ("class A(B):\n    pass\n", set()),
        ("class A(B()):\n    pass\n", {"B"}),
        ("x.f(1)\n", {"f"}),
        ("f\n", set()),
    ],
)
def test_called_in(text: str, names: set[str]) -> None:
    assert file_words.called_in(code(text), PATH) == names


@pytest.mark.parametrize(
    ("text", "here", "elsewhere"),
    [
        ("self.go\n", {"self", "go"}, {"self"}),
        ("other.go\n", {"other", "go"}, {"other", "go"}),
        ("def go(): pass\n", {"def", "pass"}, {"def", "pass"}),
        ("x = 1  # go\n", {"x", "1"}, {"x", "1"}),
        ("myself.go\n", {"myself", "go"}, {"myself", "go"}),
    ],
)
def test_named_in(text: str, here: set[str], elsewhere: set[str]) -> None:
    assert file_words.named_in(code(text), PATH, is_elsewhere=False) == here
    assert file_words.named_in(code(text), PATH, is_elsewhere=True) == elsewhere


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("self.a = 1\n", {"a": ["self"]}),
        ("x.a, y.b = 1, 2\n", {"a": ["x"], "b": ["y"]}),
        ("x[1].a = 1\n", {"a": ["1"]}),
        ("x.a == 1\n", {}),
        ("f(x.a, y)\nz = 1\n", {}),
        ("f(x.a, y=1)\n", {"a": ["x"]}),
        ("x.a\n", {}),
        ("# x.a = 1\n", {}),
    ],
)
def test_receivers(text: str, found: dict[str, list[str]]) -> None:
    assert file_words.receivers_of(code(text), PATH) == found


def test_the_rest() -> None:
    text = code("global a, b\nx = 'setattr('\ndef f():\n    f(f)\n")
    assert file_words.shared_in(text, PATH) == {"a", "b"}
    assert file_words.defined_in(text, PATH) == {"f"}
    assert file_words.word_count(text, PATH)["f"] == 3
    assert not file_words.makes_by_name(text, PATH)
    assert file_words.makes_by_name(code("setattr(x, y, 1)\n"), PATH)
