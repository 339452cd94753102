# SPDX-License-Identifier: Apache-2.0
"""Programs as JSON: they come back, and nothing else does."""

from __future__ import annotations

import json
from typing import Any

import pytest

from haros_ci import syntax
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.python.read import read_python
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded, encoded

TEXT = (
    "#include <a.h>\n#define M(x) x\n#define N 1\nPLUGINLIB_EXPORT_CLASS(A, B)\nusing namespace n; using X = Y<int>;\n"
    "template <class T> struct A : B { int c = 1; A(int d = 2) : c(d) { [this] { e(); }(); } };\nint v;\n"
    "#ifdef G\nvoid f() { x = = 1; }\n#endif\n"
)


def test_to_and_from() -> None:
    program = read_cpp(TEXT)
    assert all(getattr(program, each) for each in Program.__struct_fields__)
    text = encoded(program)
    assert text is not None
    assert decoded(text) == program
    assert hash(decoded(text)) == hash(program)
    assert encoded(decoded(text) or Program("")) == text
    assert decoded(encoded(Program("python"))) == Program("python")


@pytest.mark.parametrize(
    "value",
    [
        0,
        -0.0,
        1.0,
        1e300,
        5e-324,
        2**63,
        2**64,
        -(2**63),
        -(2**80),
        10**99,
        0.1,
        True,
        False,
        "",
        "a\u0000\n",
        "é\U0001f600\u2028",
    ],
)
def test_literals_come_back_as_they_are(value: Any) -> None:
    kind = {bool: syntax.Boolean, str: syntax.String}.get(type(value), syntax.Number)
    program = Program("cpp", variables=(syntax.Field("v", syntax.AUTO, syntax.Equals(kind(value)), 1, 1),))
    text = encoded(program)
    assert text is not None
    assert text.isascii()
    assert "\n" not in text
    found = decoded(text)
    assert found == program
    assert repr(found) == repr(program)


def test_everything_comes_back_in_one_form() -> None:
    for program in (read_cpp(TEXT), read_python("import a\nclass B(a.C):\n    d = {**e, 'f': [g, *h]}\n")):
        assert _classes(decoded(encoded(program))) == _classes(program)
        assert list not in _classes(program)


def _classes(value: Any) -> set[type]:
    inner = [getattr(value, name) for name in value.__struct_fields__] if isinstance(value, syntax.Record) else value
    found = {type(value)}
    for each in inner if isinstance(inner, (tuple, list)) else ():
        found |= _classes(each)
    return found


@pytest.mark.parametrize(
    "value", [None, 0, "", [], {}, [1], ["cpp"] + [[]] * 11, [1] + [[]] * 9, ["cpp", ["x"]], ["cpp", [[]] * 9]]
)
def test_other_shapes(value: Any) -> None:
    assert decoded(json.dumps(value)) is None


@pytest.mark.parametrize(
    "text", [None, "", "[", '["cpp"', "\x00", '["cpp"] x', '["\\ud800"]', "[" * 100_000, '["cpp",[' * 50_000]
)
def test_no_json(text: str | None) -> None:
    assert decoded(text) is None


def test_nested_too_deeply_is_none() -> None:
    value: syntax.Expression = syntax.Null()
    for _ in range(100_000):
        value = syntax.Star(value)
    program = Program("cpp", variables=(syntax.Field("v", syntax.AUTO, syntax.Equals(value), 1, 1),))
    assert encoded(program) is None
    text = (encoded(Program("cpp", variables=(syntax.Field("v", syntax.AUTO, None, 1, 1),))) or "").replace(
        "null", '["=",' + '["star",' * 100_000 + '["none"]' + "]" * 100_001
    )
    assert decoded(text) is None


def test_every_other_shape_within_is_refused_or_harmless() -> None:
    """Replace every value by one of another kind: never an exception, and what is not refused is of the shape."""
    good = json.loads(encoded(read_cpp(TEXT)) or "")
    refused = total = 0
    for path in _paths(good, 12):
        for other in (None, 1, "x", [], {}, True, [1, 2, 3]):
            changed = json.loads(json.dumps(good))
            at = changed
            for index in path[:-1]:
                at = at[index]
            at[path[-1]] = other
            total += 1
            found = decoded(json.dumps(changed))
            refused += found is None
            assert found is None or decoded(encoded(found)) == found
    assert refused > 0.7 * total


def _paths(value: Any, depth: int) -> list[tuple[int, ...]]:
    if not isinstance(value, list) or not depth:
        return []
    found: list[tuple[int, ...]] = []
    for index, each in enumerate(value):
        found.append((index,))
        found += [(index, *rest) for rest in _paths(each, depth - 1)]
    return found
