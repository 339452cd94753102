# SPDX-License-Identifier: Apache-2.0
"""Which statements of Python are never run: what pylint calls an error there is none."""

from __future__ import annotations

import pytest

from haros_ci.linters.dead_statements import is_dead, is_for_python2
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.pylint import _is_doubted
from haros_ci.linters.undefined_names import weighed_names
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

DEAD = [
    "def f():\n    return 1\n\n    return HERE\n",
    "def f():\n    raise ValueError\n    print(HERE)\n",
    "def f():\n    return 1; HERE\n",
    "for a in b:\n    continue\n    HERE\n",
    "while a:\n    break\n    if c:\n        HERE\n",
    "def f():\n    return\n    for a in b:\n        use(\n            HERE)\n",
    "if False:\n    HERE\n",
    "if 0:\n    def f():\n        HERE\n",
    "while False:\n    HERE\n",
    "if True:\n    a\nelse:\n    HERE\n",
    "def f():\n    return 1\n    @HERE\n    def g():\n        pass\n",
    "def f():\n    if a:\n        return 1\n        HERE\n    return 2\n",
    "def f():\n    try:\n        return 1\n        HERE\n    except E:\n        pass\n",
    "def f():\n    try:\n        a\n    except E:\n        raise\n        HERE\n",
    "def f():\n    try:\n        a\n    finally:\n        return 1\n        HERE\n",
    "async def f():\n    return 'ä'; HERE\n",
    "match a:\n    case 1:\n        raise E\n        HERE\n",
    "while True:\n    a\nelse:\n    b\nHERE\n",
    "while True:\n    for a in b:\n        break\nHERE\n",
    "while 1:\n    def f():\n        while a:\n            break\nHERE\n",
    "def f():\n    while True:\n        if a:\n            return\n    HERE\n",
    "def f():\n    quit()\n    HERE\n",
    "import sys\ndef f():\n    if a:\n        sys.exit(1)\n        HERE\n",
    "if True or HERE:\n    a\n",
    "if True or a or HERE:\n    b\n",
    "if a or 1 or HERE:\n    b\n",
    "b = False and use(\n    HERE)\n",
    "if False and a:\n    HERE\n",
    "while 0 and a:\n    HERE\n",
    "if True or a:\n    b\nelse:\n    HERE\n",
]
ALIVE = [
    "def f():\n    if a:\n        return 1\n    HERE\n",
    "def f():\n    return HERE\n",
    "def f():\n    HERE; return 1\n",
    "def f():\n    return use(1,\n        HERE)\n",
    "def f():\n    return 1\nHERE\n",
    "def f():\n    try:\n        return 1\n    finally:\n        HERE\n",
    "def f():\n    try:\n        return 1\n    except E:\n        HERE\n",
    "def f():\n    try:\n        a\n    except E:\n        raise\n    else:\n        HERE\n",
    "for a in b:\n    if a:\n        continue\n    HERE\n",
    "for a in b:\n    break\nelse:\n    HERE\n",
    "for a in b:\n    break\nHERE\n",
    "if False:\n    a\nelse:\n    HERE\n",
    "if True:\n    HERE\n",
    "while True:\n    HERE\n",
    "if TYPE_CHECKING:\n    HERE\n",
    "if DEBUG:\n    HERE\n",
    "if False or a:\n    HERE\n",
    "while True:\n    if a:\n        break\nHERE\n",
    "while True:\n    for a in b:\n        pass\n    else:\n        break\nHERE\n",
    "while True:\n    try:\n        a\n    except E:\n        break\nHERE\n",
    "while a:\n    b\nHERE\n",
    "def f():\n    if a:\n        quit()\n    HERE\n",
    "def f(quit):\n    quit = 1\n    quit()\n    HERE\n",
    "def f(exit):\n    exit()\n    HERE\n",
    "from tools import exit\ndef f():\n    exit()\n    HERE\n",
    "def f():\n    self.exit()\n    HERE\n",
    "def f():\n    exit(HERE)\n",
    "if False or HERE:\n    a\n",
    "if True and HERE:\n    a\n",
    "if HERE or True:\n    a\n",
    "if (True or a) and HERE:\n    b\n",
    "if True or a:\n    HERE\n",
    "if a and False:\n    HERE\n",
    "if True and a:\n    b\nelse:\n    HERE\n",
    "if '' or HERE:\n    a\n",
    "if not True:\n    HERE\n",
    "def f():\n    with a:\n        raise E\n    HERE\n",
    "def f():\n    # return\n    HERE\n",
    "def f():\n    '''\n    return 1\n    '''\n    HERE\n",
    "def f():\n    exit\n    HERE\n",
    "g = lambda: HERE\n",
    "def f():\n    return 1\n    HERE = (\n",
    "match a:\n    case 1:\n        raise E\n    case 2:\n        HERE\n",
]


def place(text: str) -> tuple[int, int]:
    line = next(number for number, item in enumerate(text.split("\n"), 1) if "HERE" in item)
    return line, text.split("\n")[line - 1].index("HERE")


@pytest.mark.parametrize("text", DEAD)
def test_what_is_never_run(text: str) -> None:
    assert is_dead(text, *place(text)) and weighed(text) == ()


@pytest.mark.parametrize("text", ALIVE)
def test_what_may_be_run(text: str) -> None:
    assert not is_dead(text, *place(text)) and len(weighed(text)) == 1


@pytest.mark.parametrize("line", [0, -1, 9])
def test_a_line_outside_of_the_file(line: int) -> None:
    assert not is_dead("def f():\n    return\n    a\n", line, 0)


def test_a_line_without_a_column_is_dead_as_a_whole() -> None:
    assert is_dead("def f():\n    return\n    a\n", 3, None)
    assert not is_dead("def f():\n    return; a\n", 2, None)


def weighed(text: str) -> tuple[Result, ...]:
    line, column = place(text)
    found = Result(
        "pylint", "undefined-variable", Level.ERROR, "Undefined variable 'HERE'", Location("a.py", line, column + 1)
    )
    return weighed_names([found], lambda path: text, lambda path: False)


#: What pylint reports at a statement that is never run, and whether it is left out there.
REPORTED = [
    ("undefined-variable", "error", True),
    ("no-member", "error", True),
    ("import-error", "error", True),
    ("too-many-function-args", "error", True),
    ("not-in-loop", "error", False),
    ("nonlocal-without-binding", "error", False),
    ("init-is-generator", "error", False),
    ("bidirectional-unicode", "error", False),
    ("unreachable", "warning", False),
    ("unused-variable", "warning", False),
    ("line-too-long", "convention", False),
]


@pytest.mark.parametrize(("rule", "kind", "is_left_out"), REPORTED)
def test_what_pylint_says_there(rule: str, kind: str, is_left_out: bool) -> None:
    text = "def f():\n    return 1\n    HERE.a(1)\n\n\nHERE.a(1)\n"
    report = {"symbol": rule, "type": kind, "line": 3, "column": 4, "message": ""}
    assert _is_doubted(report, "a.py", text, Doubting()) is is_left_out
    assert not _is_doubted({**report, "line": 6, "column": 0}, "a.py", text, Doubting())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("if sys.version_info[0] < 3:\n    HERE\nelse:\n    a\n", True),
        ("if sys.version_info[0] == 2:\n    HERE\n", True),
        ("if sys.version_info < (3, 0):\n    HERE\n", True),
        ("if sys.version_info.major >= 3:\n    a\nelse:\n    HERE\n", True),
        ("if sys.version_info[0] < 3:\n    a\nelse:\n    HERE\n", False),
        ("if sys.version_info >= (3, 0):\n    HERE\n", False),
        ("if sys.version_info < (3, 10):\n    HERE\nelse:\n    a\n", False),
        ("if sys.version_info < least:\n    HERE\n", False),
        ("if version < 3:\n    HERE\n", False),
        ("if TYPE_CHECKING and sys.version_info >= (3, 0):\n    HERE\n", False),
        ("if sys.version_info[0] < 3:\n    a\nHERE\n", False),
    ],
)
def test_what_python_2_alone_runs(text: str, expected: bool) -> None:
    assert is_for_python2(text.replace("HERE", "here"), *place(text)) is expected
    assert not is_dead(text.replace("HERE", "here"), *place(text))


@pytest.mark.parametrize(
    ("rule", "is_left_out"), [("bad-super-call", True), ("no-member", True), ("undefined-variable", False)]
)
def test_what_pylint_says_of_python_2(rule: str, is_left_out: bool) -> None:
    text = "import sys\nif sys.version_info[0] < 3:\n    a.b(c)\n"
    report = {"symbol": rule, "type": "error", "line": 3, "column": 4, "message": ""}
    assert _is_doubted(report, "a.py", text, Doubting()) is is_left_out
