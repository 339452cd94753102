# SPDX-License-Identifier: Apache-2.0
"""Dictionaries that are written in a call are keywords of it."""

from __future__ import annotations

import ast

import pytest

from haros_ci.extract.python.keywords import written_out


def shown(text: str) -> str:
    call = ast.parse(text, mode="eval").body
    assert isinstance(call, ast.Call)
    call.keywords = list(written_out(call.keywords))
    return ast.unparse(call)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("f(**{'a': 1})", "f(a=1)"),
        ("f(x, b=2, **{'a': 1, 'c': g()}, d=3)", "f(x, b=2, a=1, c=g(), d=3)"),
        ("f(**dict(a=1))", "f(a=1)"),
        ("f(**{})", "f()"),
        ("f(**dict())", "f()"),
        ("f(**{'a': {**b}})", "f(a={**b})"),
    ],
)
def test_they_are_written_out(text: str, found: str) -> None:
    assert shown(text) == found


@pytest.mark.parametrize(
    "text",
    [
        "f(a=1)",
        "f(**a)",
        "f(**{a: 1})",
        "f(**{'a': 1, **b})",
        "f(**{1: 2})",
        "f(**{'a b': 1})",
        "f(**dict(a))",
        "f(**dict(**a))",
        "f(**g(a=1))",
        "f(*[1])",
        "f({'a': 1})",
    ],
)
def test_others_stay(text: str) -> None:
    assert shown(text) == text
