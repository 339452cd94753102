# SPDX-License-Identifier: Apache-2.0
"""Which undefined names are errors, which may be defined, and which are."""

from __future__ import annotations

import pytest

from haros_ci.linters.undefined_names import weighed_names
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level


def level(name: str, text: str, *, ros1: bool = True, rule: str = "pylint:undefined-variable") -> Level | None:
    line = next(i for i, each in enumerate(text.split("\n"), 1) if name in each)
    column = text.split("\n")[line - 1].index(name) + 1
    tool, _, rule = rule.partition(":")
    said = Result(tool, rule, Level.ERROR, f"Undefined name `{name}`", Location("a.py", line, column))
    found = weighed_names([said], lambda path: text, lambda path: ros1)
    return found[0].level if found else None


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("corners", "print(corners)\n"),
        ("corners", "print('a', corners, 'b')\n"),
        ("corners", "print(f'{corners}')\n"),
        ("corners", "executor.exec(corners)\n"),
        ("corners", "print(globals()); corners\n"),
        ("corners", "import sys\nif sys.version_info[0] < 3:\n    corners\n"),
    ],
)
def test_errors(name: str, text: str) -> None:
    assert level(name, text) is Level.ERROR and level(name, text, ros1=False, rule="ruff:F821") is Level.ERROR


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("raw_input", "raw_input('go')\n"),
        ("xrange", "for i in xrange(3):\n    pass\n"),
        ("unicode", "isinstance(a, unicode)\n"),
    ],
)
def test_names_of_python_2(name: str, text: str) -> None:
    assert level(name, text) is Level.WARNING  # ROS 1: before Noetic there is nothing but Python 2
    assert level(name, text, ros1=False) is Level.ERROR
    assert level(name, "import sys\nif sys.version_info[0] < 3:\n    " + text.replace("\n", "\n    ")) is None
    assert level(name, f"try:\n    {name}\nexcept NameError:\n    pass\n") is None


@pytest.mark.parametrize(
    "text", ["def f(a: 'Node') -> None:\n", 'a: List["Node"] = []\n', "globals()['a'] = 1\nNode\n"]
)
def test_names_that_may_be_there(text: str) -> None:
    assert level("Node", text) is Level.WARNING
    assert level("Node", text, rule="flake8:F821") is Level.WARNING


def test_names_that_others_define() -> None:
    assert level("_", "_('go')\n") is None and level("__class__", "__class__\n") is None
    assert level("_", "_('go')\n", rule="pylint:unused-variable") is Level.ERROR


def test_a_level_that_the_settings_give_stands() -> None:
    said = Result("ruff", "F821", Level.ERROR, "Undefined name `xrange`", Location("a.py", 1, 1))
    assert weighed_names([said], lambda path: "xrange\n", lambda path: True, lambda result: True) == (said,)


LATE = "from __future__ import annotations\n"


@pytest.mark.parametrize(
    "text",
    [
        "HOME: Final = 1\n",
        "class A:\n    home: Final[str] = 'a'\n",
        "def f(a: int, b: list[Final]) -> None: ...\n",
        "def f(a: int) -> dict[str, Final]: ...\n",
        "def f(\n    a: int | Final,\n): ...\n",
    ],
)
def test_annotations_that_nothing_evaluates(text: str) -> None:
    assert level("Final", LATE + text) is Level.WARNING
    assert level("Final", text) is Level.ERROR


@pytest.mark.parametrize(
    "text",
    [
        "home: str = Final\n",
        "if home: Final\n",
        "print({1: Final})\n",
        "f = lambda a: Final\n",
        "def f(a=Final): ...\n",
        "a[1:Final]\n",
        "a[b:Final]\n",
    ],
)
def test_what_is_evaluated_all_the_same(text: str) -> None:
    assert level("Final", LATE + text) is Level.ERROR
