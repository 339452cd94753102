# SPDX-License-Identifier: Apache-2.0
"""In processes of pytest-xdist the cases of a test that gets nothing of its own are one test, which names each case that fails.

To start, report and count a test takes four times as long there as a small one runs. Without ``-n`` each case is a test, as it is if some
are chosen by their names: ``pytest 'tests/a.py::test_b[case]'``.
"""

from __future__ import annotations

import inspect
from collections.abc import Sequence

import pytest
from every import every

#: What a fixture of such a scope gives is the same for all cases.
SHARED = ("module", "package", "session")


def are_chosen(config: pytest.Config) -> bool:
    """Whether some cases are asked for by name."""
    return bool(config.option.keyword) or any("[" in str(argument) for argument in config.args)


def together(items: Sequence[pytest.Function]) -> list[pytest.Function]:
    """The cases of one function as one test, or as they are, where each gets something of its own, has a mark or is one alone."""
    if len(items) < 2 or not all(_is_plain(item) for item in items):
        return list(items)
    first = items[0]
    names = tuple(first.callspec.params)
    if any(tuple(item.callspec.params) != names for item in items):
        return list(items)
    rows = [tuple(item.callspec.params.values()) for item in items]
    identifiers = {id(row): item.callspec.id for row, item in zip(rows, items)}
    test = every(names, rows, ids=lambda row: identifiers[id(row)])(first.obj)
    del test.pytestmark  # type: ignore[attr-defined]  # it is of the cases
    return [pytest.Function.from_parent(first.parent, name=first.originalname, callobj=test)]


def _is_plain(item: pytest.Function) -> bool:
    """Whether the item is a function with values of ``pytest.mark.parametrize`` alone, and fixtures that all cases share."""
    spec = getattr(item, "callspec", None)
    if spec is None or item.cls is not None or hasattr(item.obj, "hypothesis"):
        return False
    marks = list(item.own_markers)
    if any(mark.name != "parametrize" or mark.kwargs.get("indirect") for mark in marks):
        return False
    given = {name for mark in marks for name in _names(mark)}
    others = set(item.fixturenames) - given
    if "request" not in inspect.signature(item.obj).parameters:
        others.discard("request")  # it is asked for by what all share
    return given == set(spec.params) and all(_is_shared(item, name) for name in others)


def _names(mark: pytest.Mark) -> list[str]:
    names = mark.args[0] if mark.args else mark.kwargs["argnames"]
    return [name.strip() for name in names.split(",")] if isinstance(names, str) else list(names)


def _is_shared(item: pytest.Function, name: str) -> bool:
    found = item._fixtureinfo.name2fixturedefs.get(name)
    return found is not None and found[-1].scope in SHARED
