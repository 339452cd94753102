# SPDX-License-Identifier: Apache-2.0
"""An end below a condition of values alone is no choice that a node has: a wrong type beside it stays wrong."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from haros_ci.checking.coexistence import is_never_made


def made(*conditions: tuple[str, str], ruled_out: bool = True) -> Any:
    found = tuple(SimpleNamespace(statement=statement, condition=text) for statement, text in conditions)
    return cast("Any", SimpleNamespace(raw=SimpleNamespace(is_ruled_out=ruled_out), conditions=found))


@pytest.mark.parametrize(
    "text",
    [
        "True",
        "true",
        "1 == 1",
        "not 0",
        "!(1 > 2)",
        "'a' == 'b'",
        '"" or None',
        "1 & 3",
        "-1 < 0.5",
        "nullptr",
        "1 is not None",
    ],
)
def test_values_alone(text: str) -> None:
    assert is_never_made(made(("else", text)))
    assert is_never_made(made(("if", text), ("#if", "#else")))


@pytest.mark.parametrize("text", ["#if 0", "#else", "#ifdef NEVER", "#elif A > 1"])
def test_what_no_build_compiles(text: str) -> None:
    assert is_never_made(made(("#if", text)))


@pytest.mark.parametrize(
    "text",
    [
        *("use_int", "not use_int", "self.use", "use == 1", "is_on()", "True_", "len('a')", "a", "ok and True"),
        *("params['use']", "f'{a}'", "'a' + b", "get_parameter('use').value", "1 if a else 0", ""),
    ],
)
def test_what_a_run_decides(text: str) -> None:
    assert not is_never_made(made(("else", text)))
    assert not is_never_made(made(("if", "True"), ("else", text)))


def test_what_is_not_ruled_out() -> None:
    assert not is_never_made(made(("if", "True"), ruled_out=False))
    assert not is_never_made(made(("#if", "#if 1"), ruled_out=False))


def test_long_conditions_are_not_looked_at() -> None:
    assert not is_never_made(made(("if", "(" * 1_000)))
    assert is_never_made(made(("if", "(" * 300)))
