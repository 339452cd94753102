# SPDX-License-Identifier: Apache-2.0
"""What nodes of Python say, and that code which is nested deeper than Python's own functions follow stops nobody who looks at it."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable

import pytest

from haros_ci.checking.old_python import misfits, parsed_of_any_version
from haros_ci.linters.dead_statements import is_dead, is_for_python2
from haros_ci.linters.given_endpoints import given_in_python
from haros_ci.linters.lost_setup import lost_setup
from haros_ci.linters.never_bound import never_bound
from haros_ci.linters.pylint_definitions import loses_nothing
from haros_ci.linters.taken_names import taken
from haros_ci.results.module_names import names_of
from haros_ci.results.python_nodes import MOST_PARTS, dotted, is_same, mentions


def expression(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a", "a"),
        ("a.b.c", "a.b.c"),
        ("a().b", ""),
        ("a[0].b", ""),
        ("'a'.b", ""),
        ("a" + ".b" * MOST_PARTS, "a" + ".b" * MOST_PARTS),
        ("a" + ".b" * (MOST_PARTS + 1), ""),
    ],
)
def test_dotted(text: str, expected: str) -> None:
    assert dotted(expression(text)) == expected


def test_mentions() -> None:
    name = re.compile(r"^log")
    assert mentions(expression("f(a, b.logger[0])"), name) and mentions(expression("log"), name)
    assert not mentions(expression("f('log', catalog, a.b)"), name)


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ("a = b . c", "a = b.c  # d", True),
        ("def f(a, *, b=1): return [a]", "def f(a,*,b = 1):\n    return [ a ]", True),
        ("a = 1", "a = 1.0", False),
        ("a = 1", "a = True", False),
        ("a = [b]", "a = [b, b]", False),
        ("a = b + c", "a = b - c", False),
        ("f(a, b=c)", "f(a, d=c)", False),
        ("if a: b", "if a: b\nelse: c", False),
    ],
)
def test_is_same(one: str, other: str, expected: bool) -> None:
    assert is_same(ast.parse(one), ast.parse(other)) is expected


def test_what_is_set_and_what_is_read() -> None:
    (statement,) = ast.parse("a.b = a.b").body
    assert isinstance(statement, ast.Assign) and is_same(statement.targets[0], statement.value)


DEEP = 1_000
TEXTS = {
    "attributes": "import os\nos" + ".b" * DEEP + "()\nx = 1\n",
    "calls": "import os\nos.b" + "()" * DEEP + "\nx = 1\n",
    "a condition": "import sys\nif sys" + "[0]" * DEEP + " == 2:\n    x = 1\n",
    "a version": "import sys\nif sys.version_info" + ".b" * DEEP + " < 3:\n    x = 1\n",
    "an exception": "import os\ntry:\n    x = 1\nexcept os" + ".b" * DEEP + ":\n    import q\n",
    "two functions": "import os\n" + ("def f():\n    return os" + ".b" * DEEP + "\n") * 2,
    "a callback": "import rospy\nf(rospy" + ".b" * DEEP + ", g().create_timer)\n",
    "a log": "import rospy\nrospy" + ".b" * DEEP + ".loginfo('%s of %s' % a, b)\nprint 'x'\n",
}


def _misfits(text: str) -> Iterable[object]:
    found = parsed_of_any_version(text)
    return () if found is None else tuple(misfits(found[0], found[2]))


LOOKS: dict[str, Callable[[str], object]] = {
    "dead": lambda text: is_dead(text, 3, 0),
    "for Python 2": lambda text: is_for_python2(text, 3, 0),
    "same": lambda text: loses_nothing(text, 4),
    "given": lambda text: tuple(given_in_python(text)),
    "setup": lambda text: lost_setup(f"from setuptools import setup\nsetup()\n{text}"),
    "bound": lambda text: tuple(never_bound(text)),
    "taken": lambda text: tuple(taken(text)),
    "names": names_of,
    "misfits": _misfits,
}


@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("text", TEXTS)
def test_deep_code_stops_nobody(text: str, look: str) -> None:
    ast.parse(TEXTS[text].replace("print 'x'\n", ""))  # else there is nothing to look at
    LOOKS[look](TEXTS[text])


def test_what_stands_around_deep_code_is_seen() -> None:
    assert loses_nothing(TEXTS["two functions"], 4)
    assert list(given_in_python(TEXTS["a callback"])) == [(2, "create_timer")]
    assert is_dead("def f():\n    return\n    x" + ".b" * DEEP + "()\n    y = 1\n", 4, 4)
