# SPDX-License-Identifier: Apache-2.0
"""An end below a condition of values alone is no choice that a node has: a wrong type beside it stays wrong."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from haros_ci.checking.coexistence import in_doubt, is_never_made


def made(*conditions: tuple[str, str], ruled_out: bool = True) -> Any:
    found = tuple(SimpleNamespace(statement=statement, condition=text) for statement, text in conditions)
    return cast("Any", SimpleNamespace(raw=SimpleNamespace(is_ruled_out=ruled_out, conditions=found)))


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


@pytest.mark.parametrize(
    ("statement", "text", "is_kept"),
    [
        *((statement, text, False) for statement in ("if", "elif", "else") for text in ("True", "1 == 1", "false")),
        *(
            ("while", "True", True),
            ("for", "1", True),
            ("catch", "", True),
            ("#if", "#if 1", True),
            ("switch", "1", True),
        ),
        *(("if", "use", True), ("else", "1 if a else 0", True), ("unless", "", True)),
    ],
)
def test_conditions_that_always_hold_are_none(statement: str, text: str, is_kept: bool) -> None:
    conditions = made(("if", "a"), (statement, text)).raw.conditions
    assert len(in_doubt(conditions)) == 1 + is_kept


PYTHON = {
    "use = True\n": True,
    "def f():\n    use = 1 - 1\n": True,
    "use: bool = False\n": True,
    "use = True\nuse = ask()\n": False,
    "def f(use=True):\n    pass\n": False,
    "use = ask()\n": False,
    "def f():\n    use = True\n    def g():\n        nonlocal use\n        use = False\n": False,
    "from switches import use\n": False,
    "use = []\n": False,
    "other = True\n": False,
    "use = (\n": False,
}
CPP = {
    "const bool use = true;\n": True,
    "constexpr int use{0};\n": True,
    "static constexpr auto use = 1;\n": True,
    "bool use = true;\n": False,
    "const bool use = ask();\n": False,
    "// const bool use = true;\n": False,
    "const bool use = true;\nvoid f() { bool use = ask(); }\n": False,
    "const bool used = true;\n": False,
}


@pytest.mark.parametrize("condition", ["use", "not use"])
@pytest.mark.parametrize("text", PYTHON)
def test_variables_of_python(condition: str, text: str) -> None:
    assert is_never_made(switched(condition, "a.py"), lambda path: text) is PYTHON[text]


@pytest.mark.parametrize("condition", ["use", "!use", "! use"])
@pytest.mark.parametrize("text", CPP)
def test_constants_of_cpp(condition: str, text: str) -> None:
    assert is_never_made(switched(condition, "a.cpp"), lambda path: text) is CPP[text]


def test_what_is_more_than_a_name() -> None:
    for condition in ("use and other", "self.use", "use()", "use.on", "use == 1"):
        assert not is_never_made(switched(condition, "a.py"), lambda path: "use = True\n")
    assert not is_never_made(switched("use", "a.py"))


def switched(condition: str, path: str) -> Any:
    one = SimpleNamespace(statement="else", condition=condition, location=SimpleNamespace(path=path))
    return cast("Any", SimpleNamespace(raw=SimpleNamespace(is_ruled_out=True, conditions=(one,))))
