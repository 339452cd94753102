# SPDX-License-Identifier: Apache-2.0
"""Predicates: never true, always true, one of another; and properties: one of another, one against another."""

from __future__ import annotations

from itertools import product

import pytest

from haros_ci.behaviour.clauses import Reader
from haros_ci.behaviour.comparing import Compared, excluded, follows
from haros_ci.behaviour.deciding import Predicate, implies, is_always, is_never, overlap
from haros_ci.behaviour.messages import Messages, Scene
from haros_ci.behaviour.parser import parse_property
from haros_ci.interfaces.definitions import Definitions
from haros_ci.model.build import Interface, InterfaceField

FIELDS = (("u", "uint8"), ("i", "int32"), ("f", "float64"), ("t", "string"), ("b", "bool"), ("v", "float64[]"))
MESSAGE = Interface(
    name="p/M",
    kind="msg",
    path="",
    sections=(
        (
            *(InterfaceField(name=name, type=kind, line=0) for name, kind in FIELDS),
            InterfaceField(name="LOW", type="uint8", line=0, is_constant=True, value="3"),
            InterfaceField(name="NAME", type="string", line=0, is_constant=True, value="n"),
        ),
    ),
)
MESSAGES = Messages(Definitions((MESSAGE,), 1))
SCENE = Scene(MESSAGES, MESSAGES.named("p/M"), {})


def predicate(text: str, scene: Scene | None = SCENE) -> Predicate:
    (event,) = parse_property(f"globally: no /a {{{text}}}").pattern.behaviour
    return Predicate(event.predicate, Reader(scene, event.alias))


NEVER = [
    "False", "u < 0", "u > 255", "u > 3 and u < 4", "u = 3 and u = 4", "u = LOW and u != 3", "u = 0.5", "u in {300, -1}", "u in [5 to 3]",
    "u in ![3 to 4]!", 't = "x" and t = "y"', "t = NAME and not t = \"n\"", "b and not b", "b = True and b = False", "b != True and b != False", "f < 1 and f > 1",
    "f < 1 and not f <= 2", "not (f < 1 or f >= 1) and f != 3 and f = 3", "len(v) < 0", "f > u and not f > u", "not (u >= 0 or b)", "b and (b implies u < 0)",
    "(b iff u > 3) and b and u < 2", "u != 0 and u < 1", "i > 2 ** 31", "2 > 3", "u in [10 to 20] and not u in [0 to 30]", "v[0] > 1 and v[0] < 1", "f > INF",
]  # fmt: skip
ALWAYS = [
    "True", "u >= 0", "u <= 255", "u < 3 or u >= 3", 't != "x" or t != "y"', "b or not b", "len(v) >= 0", "not (u < 0)", "u != 0.5", "u in [0 to 255]", "b implies b", "2 < 3",
    "u in [0 to 300] or b", "f > u or not f > u", "b iff b", "f != 3 or f = 3 and f > 2",
]  # fmt: skip
NEITHER = [
    "u < 1", "u > 254", "u >= 3 and u <= 3", "f > 3 and f < 4", "f < 3 or f >= 3", "not (f < 3) and not (f >= 3)", "f = f", "f != f", "f < u and u < f",
    "t = NAME", "b", "u in {1, 300}", "u > LOW", "exists k in v: @k > 1", "forall k in [0 to 3]: v[@k] > 0", "v[0] > 1 or v[0] <= 1 or b", "w < 0", "abs(f) < 0",
    "f <= INF", "x = NAN", "i < 10 ** 400", "u / 0 > 1", "u * 2 > 1000",
]  # fmt: skip


@pytest.mark.parametrize("text", NEVER)
def test_never(text: str) -> None:
    assert is_never(predicate(text))
    assert not is_always(predicate(text))


@pytest.mark.parametrize("text", ALWAYS)
def test_always(text: str) -> None:
    assert is_always(predicate(text))
    assert not is_never(predicate(text))


@pytest.mark.parametrize("text", NEITHER)
def test_neither(text: str) -> None:
    assert not is_never(predicate(text))
    assert not is_always(predicate(text))


def test_without_types_less_is_known() -> None:
    assert not is_never(predicate("u < 0", None))
    assert not is_always(predicate("u < 3 or u >= 3", None))
    assert is_never(predicate("u < 0 and u > 0", None))


def test_many_alternatives_are_not_decided() -> None:
    text = " and ".join(f"(x{n} = 1 or x{n} = 2)" for n in range(12))
    assert not is_never(predicate(f"u < 0 and {text}", None))


VALUES = (0, 1, 2, 3, 255)
ATOMS = ("u < 2", "u = 2", "u != 3", "u >= 3", "u in {1, 255}", "u in [1 to 2]!", "b")


@pytest.mark.parametrize("words", [" and ", " or ", " implies ", " iff "])
def test_what_is_said_holds_for_all_values(words: str) -> None:
    """Against Python, over all values of a small message."""
    said = {
        "u < 2": lambda u, b: u < 2, "u = 2": lambda u, b: u == 2, "u != 3": lambda u, b: u != 3, "u >= 3": lambda u, b: u >= 3,
        "u in {1, 255}": lambda u, b: u in (1, 255), "u in [1 to 2]!": lambda u, b: 1 <= u < 2, "b": lambda u, b: b,
    }  # fmt: skip
    join = {
        " and ": lambda x, y: x and y, " or ": lambda x, y: x or y, " implies ": lambda x, y: not x or y, " iff ": lambda x, y: x == y,
    }[words]  # fmt: skip
    for one, other, negated in product(ATOMS, ATOMS, (False, True)):
        text = f"{'not ' if negated else ''}({one}{words}{other})"
        holds = {negated != bool(join(said[one](u, b), said[other](u, b))) for u in range(256) for b in (False, True)}
        assert is_never(predicate(text)) is (holds == {False}), text
        assert is_always(predicate(text)) is (holds == {True}), text


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ("u > 3", "u > 2", True),
        ("u > 2", "u > 3", False),
        ("u > 2", "u >= 3", True),
        ("f > 2", "f >= 3", False),
        ("u = LOW", "u in {3, 4}", True),
        ("f > u", "f > u", True),
        ("f > u and b", "b", True),
        ("not f < 3", "f >= 3", False),
        ("f >= 3", "not f < 3", True),
        ("u > 3", "u > 2 or v[0] > 1", False),
        ("v[0] > 1", "v[0] > 0", True),
        ("False", "u = 1", True),
    ],
)
def test_implies(one: str, other: str, expected: bool) -> None:
    assert implies(predicate(one), predicate(other)) is expected
    assert implies(predicate(one), Predicate(None, Reader()))


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [("u > 3", "u < 5", True), ("u > 3", "u < 4", False), ("f > u", "u < 4", False), ("u = 1", "t = NAME", True)],
)
def test_overlap(one: str, other: str, expected: bool) -> None:
    assert overlap(predicate(one), predicate(other)) is expected


def compared(text: str) -> Compared:
    return Compared(parse_property(text), lambda event: Predicate(event.predicate, Reader(None, event.alias)))


FOLLOWS = [
    ("globally: no /a {x > 3}", "globally: no /a {x > 2}"),
    ("globally: no /a {x > 3}", "globally: no (/b or /a)"),
    ("globally: no /a within 1 s", "globally: no /a"),
    ("after /p: no /a", "globally: no /a"),
    ("after /p: no /a within 1 s", "globally: no /a"),
    ("globally: some /a", "globally: some /a {x > 1} within 1 s"),
    ("globally: some (/a or /b)", "globally: some /a"),
    ("globally: /a {x > 1} causes /b within 2 s", "globally: /a causes /b {y} within 1 s"),
    ("globally: /a forbids /b {y} within 1 s", "globally: /a forbids /b"),
    ("after /p: /a forbids /b within 1 s", "globally: /a forbids /b within 1 s"),
    ("globally: /a forbids /b", "globally: no /b"),
    ("globally: /b requires /a", "globally: no /b"),
    ("globally: /b {y} requires /a within 2 s", "globally: /b requires /a {x} within 1 s"),
    ("globally: /a as A causes /b {x = @A.x} within 2 s", "globally: /a as A causes /b {x = @A.x} within 1 s"),
]
APART = [
    ("globally: no /a", "globally: no /a {x > 2}"),
    ("globally: no /a", "globally: no /a within 1 s"),
    ("globally: no /a", "after /p: no /a"),
    ("after /p: no /a within 1 s", "globally: no /a within 5 s"),
    ("globally: some /a {x}", "globally: some /a"),
    ("after /p: some /a", "globally: some /a"),
    ("globally: /a causes /b", "globally: /a {x} causes /b"),
    ("globally: /a causes /b within 1 s", "globally: /a causes /b within 2 s"),
    ("until /q: /a causes /b", "globally: /a causes /b"),
    ("after /p: /b requires /a", "globally: /b requires /a"),
    ("globally: /a forbids /b", "globally: /a forbids /b within 1 s"),
    ("globally: /b requires /a {x}", "globally: /b requires /a"),
    ("globally: /a as A causes /b {x = @A.x}", "globally: /c as A causes /b {x = @A.x}"),
    ("globally: /a as A forbids /b {x = @A.x}", "globally: /c as A forbids /b {x = @A.x}"),
    ("globally: /a causes /b", "globally: /a forbids /b"),
    ("globally: /a forbids /b", "globally: no /b within 1 s"),
]


@pytest.mark.parametrize(("one", "other"), FOLLOWS)
def test_one_property_follows_from_another(one: str, other: str) -> None:
    assert follows(compared(one), compared(other))
    assert follows(compared(one), compared(one))


@pytest.mark.parametrize(("one", "other"), APART)
def test_one_property_does_not_follow(one: str, other: str) -> None:
    assert not follows(compared(one), compared(other))


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ("globally: some /a {x > 3}", "globally: no /a {x > 2}", True),
        ("globally: some /a within 1 s", "globally: no /a within 2 s", True),
        ("after /p: some /a", "globally: no /a", True),
        ("globally: /a causes /b", "globally: no /b", True),
        ("globally: /a {x} causes /b within 1 s", "globally: /a forbids /b within 1 s", True),
        ("globally: some /a", "globally: no /a {x}", False),
        ("globally: some /a", "globally: no /a within 2 s", False),
        ("globally: some /a", "after /p: no /a", False),
        ("globally: /a causes /b within 2 s", "globally: /a forbids /b within 1 s", False),
        ("globally: /a causes /b", "globally: no /b within 2 s", False),
        ("globally: no /a", "globally: some /a", False),
        ("globally: /a as A causes /b {x = @A.x}", "globally: no /b", False),
    ],
)
def test_excluded(one: str, other: str, expected: bool) -> None:
    assert (excluded(compared(one), compared(other)) is not None) is expected
