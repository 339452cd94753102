# SPDX-License-Identifier: Apache-2.0
"""Programs as JSON: they come back, and nothing else does."""

from __future__ import annotations

import json
from typing import Any

import pytest

from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.program_json import from_json, to_json
from haros_ci.model.program import Program

TEXT = (
    "#include <a.h>\n#define M(x) x\n#define N 1\nPLUGINLIB_EXPORT_CLASS(A, B)\nusing namespace n; using X = Y<int>;\n"
    "template <class T> struct A : B { int c = 1; A(int d = 2) : c(d) { [this] { e(); }(); } };\nint v;\n"
    "#ifdef G\nvoid f() { x = = 1; }\n#endif\n"
)


def test_to_and_from() -> None:
    program = read_cpp(TEXT)
    assert all(getattr(program, each) for each in Program.__slots__)
    assert from_json(to_json(program)) == program
    again = from_json(json.loads(json.dumps(to_json(program))))
    assert again is not None
    assert json.dumps(to_json(again)) == json.dumps(to_json(program))
    assert [each.name for each in again.functions] == [each.name for each in program.functions]
    assert from_json(to_json(Program("python"))) == Program("python")


@pytest.mark.parametrize(
    "value", [None, 0, "", [], {}, [1], ["cpp"], ["cpp"] + [[]] * 8, ["cpp"] + [[]] * 10, [1] + [[]] * 9]
)
def test_other_shapes(value: Any) -> None:
    assert from_json(value) is None


def test_every_other_shape_within_is_refused_or_harmless() -> None:
    """Replace every value down to the members' own by one of another kind: never an exception."""
    good = json.loads(json.dumps(to_json(read_cpp(TEXT))))
    refused = total = 0
    for path in _paths(good, 3):
        for other in (None, 1, "x", [], {}, True, [1, 2, 3]):
            changed = json.loads(json.dumps(good))
            at = changed
            for index in path[:-1]:
                at = at[index]
            at[path[-1]] = other
            total += 1
            refused += from_json(changed) is None
    assert refused > 0.7 * total


def _paths(value: Any, depth: int) -> list[tuple[int, ...]]:
    if not isinstance(value, list) or not depth:
        return []
    found: list[tuple[int, ...]] = []
    for index, each in enumerate(value):
        found.append((index,))
        found += [(index, *rest) for rest in _paths(each, depth - 1)]
    return found
