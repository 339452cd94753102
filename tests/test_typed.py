# SPDX-License-Identifier: Apache-2.0
"""The interpreter is typed (decision 0020): ``Any`` stands nowhere in it but where a table or a call has things of many kinds."""

from __future__ import annotations

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
#: The interpreter and all that checks see.
ROOMS = ("haros_ci/syntax", "haros_ci/values", "haros_ci/index", "haros_ci/follow", "haros_ci/api", "checks")
_TABLE = "look-ups of many kinds share a table; who reads it says what kind its own are"
_NAMED = "arguments by their names, each of its own type"
#: Modules that name ``Any``: how often, and why.
MANY_KINDS: dict[str, tuple[int, str]] = {
    "haros_ci/index/index.py": (1, _TABLE),
    "haros_ci/index/trace.py": (1, _TABLE),
    "haros_ci/follow/walk.py": (1, _TABLE),
    "haros_ci/follow/ros/qos.py": (2, _NAMED),
    "haros_ci/follow/libraries/argparse_words.py": (1, _NAMED),
}
#: Lines that mypy is told to leave alone, each with its reason.
MOST_IGNORED = 7
_IGNORED = re.compile(r"# type: ignore(?P<code>\[[\w, -]+\])?(?P<reason>  # \w.*)?")


def uses(text: str) -> int:
    """How often ``Any`` of typing is named, imports aside; what is written in quotes counts, too."""
    nodes = list(ast.walk(ast.parse(text)))
    quoted = [node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    return (
        sum(isinstance(node, ast.Name) and node.id == "Any" for node in nodes)
        + sum(isinstance(node, ast.Attribute) and node.attr == "Any" for node in nodes)
        + sum(bool(re.search(r"\bAny[\],|]|\bAny$", item)) for item in quoted)
    )


def modules() -> list[Path]:
    return sorted(path for room in ROOMS for path in (ROOT / room).rglob("*.py"))


def test_no_any() -> None:
    found = Counter({path.relative_to(ROOT).as_posix(): uses(path.read_text(encoding="utf-8")) for path in modules()})
    assert +found == {path: count for path, (count, _) in MANY_KINDS.items()}


def test_what_mypy_leaves_alone_has_a_reason() -> None:
    lines = [
        f"{path.relative_to(ROOT).as_posix()}: {line.strip()}"
        for path in modules()
        for line in path.read_text(encoding="utf-8").splitlines()
        if "type: ignore" in line
    ]
    assert len(lines) <= MOST_IGNORED, "\n".join(lines)
    for line in lines:
        found = _IGNORED.search(line)
        assert found is not None and found["code"] and found["reason"], line


def test_mypy_has_no_exceptions() -> None:
    """All modules of ours are checked in the same way, strictly."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert re.search(r"^\[tool\.mypy\]\nstrict = true\n", text, re.MULTILINE)
    for table in text.split("[[tool.mypy.overrides]]")[1:]:
        assert "haros_ci" not in table.partition("\n[")[0]


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("from typing import Any\n", 0),
        ("x: int\n", 0),
        ('"""Any C++ cast."""\n', 0),
        ("any(x)\n", 0),
        ("from typing import Any\nx: Any = 1\n", 1),
        ("import typing\nx: dict[str, typing.Any]\n", 1),
        ("def f(a: Any, b: list[Any]) -> Any: ...\n", 3),
        ('x = cast("dict[str, Any]", y)\n', 1),
    ],
)
def test_uses_are_counted(text: str, count: int) -> None:
    assert uses(text) == count
