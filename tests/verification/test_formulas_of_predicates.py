# SPDX-License-Identifier: Apache-2.0
"""Predicates as formulas and as closures: the same value of the same message, also where a part of it is not there."""

from __future__ import annotations

import random
from importlib.util import find_spec
from typing import Any

import pytest

from haros_ci.behaviour.messages import Typed
from haros_ci.behaviour.parser import parse_property
from haros_ci.behaviour.tree import Event, Expression
from haros_ci.interfaces.definitions import FieldType
from haros_ci.monitoring import predicates as closures
from haros_ci.monitoring.monitor import no_constants
from haros_ci.verification.fields import Fields, Kind
from haros_ci.verification.lowering import lowered
from haros_ci.verification.problem import Claim, NotModelled

pytestmark = pytest.mark.skipif(find_spec("z3") is None, reason="needs the extra: pip install 'haros-ci[verify]'")

TYPES = {
    "n": FieldType("int32"), "u": FieldType("uint8"), "x": FieldType("float64"), "flag": FieldType("bool"), "t": FieldType("string"),
    "items": FieldType("float64", form="sequence"), "items[0]": FieldType("float64"), "items[2]": FieldType("float64"),
    "three": FieldType("int32", form="array", size=3), **{f"three[{n}]": FieldType("int32") for n in range(3)},
}  # fmt: skip


def typed(event: Event, expression: Expression) -> Typed:
    from haros_ci.behaviour.text import expression_text

    return TYPES.get(expression_text(expression))


def formula(text: str, message: dict[str, Any]) -> bool:
    """What the formula of a predicate says of *message*."""
    import z3

    from haros_ci.verification.predicates import TRUE, Compiler, Value

    claim = lowered(Claim(0, text, parse_property(f"globally: no /a {{{text}}}"), typed=typed))
    (event,) = claim.stated.pattern.behaviour
    fields = Fields()
    fields.add((claim,))

    def value(key: str) -> Any:
        slot = fields.slots["/a", key]
        found: Any = message
        if slot.is_length:
            return Value(Kind.INT, z3.IntVal(len(message[str(slot.path[0])])))
        for part in slot.path:
            if isinstance(part, int) and part >= len(found):
                return Value(slot.kind, z3.RealVal(0), z3.BoolVal(False))
            found = found[part]
        makes = {
            Kind.BOOL: z3.BoolVal,
            Kind.INT: z3.IntVal,
            Kind.REAL: z3.RealVal,
            Kind.TEXT: lambda t: z3.IntVal(fields.text(t)),
        }
        return Value(slot.kind, makes[slot.kind](found), TRUE)

    solver = z3.Solver()
    solver.add(Compiler(claim, fields).holds(event, value, {}))
    return bool(solver.check() == z3.sat)


def closure(text: str, message: dict[str, Any]) -> bool:
    (event,) = parse_property(f"globally: no /a {{{text}}}").pattern.behaviour
    test = closures.test_of(event, no_constants, closures.Faults())
    assert test is not None
    return test(message, {})


PREDICATES = [
    "n = 3", "n != 3", "n < 2.5", "n >= u", "x = 0.5", "x * 2 > n + 1", "x / n > 1", "x / u = 0 or flag", "flag", "not flag", "flag = True",
    "flag implies n > 0", "flag iff n > 0", "n in {1, 2, 3}", "n in [1 to 3]", "n in ![1 to 3]!", "not n in [1 to 3]", "x in [0 to INF]", "x < INF",
    'x = NAN', 'x != NAN', 't = "on"', 't != "on"', 't in {"on", "off"}', "items[0] > 1", "items[2] > 1", "not items[2] > 1",
    "items[2] > 1 or n > 0", "n > 0 or items[2] > 1", "n > 0 and items[2] > 1", "n > 0 implies items[2] > 1", "len(items) = 2", "len(items) > u",
    "abs(x) > 1", "max(n, u, 2) = 2", "min(n, x) < 0", "n ** 2 > 3", "-n > x", "forall i in {0, 1}: three[@i] > 0", "exists i in [0 to 2]: three[@i] = n",
    "exists i in three: three[@i] = 2", "forall i in three: three[@i] < 4", "n - u * 2 < x",
]  # fmt: skip


#: These are the same for all messages here.
ALWAYS = ("x < INF", "x = NAN", "x != NAN", "forall i in three: three[@i] < 4")


@pytest.mark.parametrize("text", PREDICATES)
def test_a_formula_says_what_the_closure_says(text: str) -> None:
    draw = random.Random(text)
    answers = set()
    for _ in range(30):
        message = {
            "n": draw.randrange(-3, 5), "u": draw.randrange(4), "x": draw.choice((-2.0, -0.5, 0.0, 0.5, 1.0, 3.0)), "flag": draw.random() < 0.5,
            "t": draw.choice(("on", "off", "else")), "items": [draw.choice((0.0, 2.0)) for _ in range(draw.randrange(4))],
            "three": [draw.randrange(4) for _ in range(3)],
        }  # fmt: skip
        expected = closure(text, message)
        answers.add(expected)
        assert formula(text, message) is expected, message
    assert len(answers) == 2 or text in ALWAYS


@pytest.mark.parametrize(
    ("text", "construct"),
    [
        ("sin(x) > 0", "the function sin"),
        ("state = DROPPED", "DROPPED, a constant of a message whose definition is not known"),
        ("items[n] > 0", "an index that depends on a message"),
        ("forall i in items: items[@i] > 0", "a quantifier over items"),
        ("forall i in [0 to 1000]: n > @i", "a quantifier over"),
        ("sum(items) > 0", "a whole array as a value: items"),
        ("n in items", "a whole array as a value: items"),
        ("len(t) > 2", "the length of a text"),
        ("sqrt(x) > 2", "the function sqrt"),
        ("items[99999] > 0", "an array of more than 10,000 items"),
        ("x ** 0.5 > 1", "the power"),
    ],
)
def test_what_is_not_modelled_is_named(text: str, construct: str) -> None:
    with pytest.raises(NotModelled, match=construct):
        formula(text, {"n": 1, "x": 1.0, "items": [], "three": [1, 2, 3]})
