# SPDX-License-Identifier: Apache-2.0
"""Data classes of haros_ci.records do what those of the standard library do."""

from __future__ import annotations

import copy
import dataclasses
import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, field, replace
from itertools import product
from typing import Any, ClassVar

import pytest

from haros_ci import records


def _classes(dataclass: Callable[..., Any], **settings: bool) -> dict[str, Any]:
    """The same classes, made by *dataclass*."""

    @dataclass(**settings)
    class Plain:
        """One."""

        a: int
        b: str = "b"
        c: list[int] = field(default_factory=list)
        kept: ClassVar[int] = 3

    @dataclass(**settings)
    class Fields:
        a: int
        d: int = field(default=4, repr=False)
        e: tuple[int, ...] = field(default=(), compare=False)
        f: int = field(default=5, kw_only=True)
        g: int = field(default=6, init=False)
        h: list[int] = field(default_factory=lambda: [7], init=False, compare=False)

    @dataclass(**settings)
    class Below(Plain):
        b: str = "other"
        z: int = 1

    @dataclass(**settings)
    class Empty:
        pass

    @dataclass(**settings)
    class After:
        a: int

        def __post_init__(self) -> None:
            if self.a < 0:
                raise ValueError("below 0")

    @dataclass(**settings)
    class Own:
        a: int

        def __repr__(self) -> str:
            return "own"

        def __eq__(self, other: object) -> bool:
            return True

        def __hash__(self) -> int:
            return 1

    @dataclass(**settings)
    class Equal:
        a: int

        def __eq__(self, other: object) -> bool:
            return True

    found = {name: value for name, value in locals().items() if isinstance(value, type)}
    for cls in found.values():
        cls.__qualname__ = cls.__name__
    return found


SETTINGS = [
    {"frozen": frozen, "slots": slots, "eq": eq, "kw_only": kw_only}
    for frozen, slots, eq, kw_only in product((False, True), repeat=4)
]
MADE = {
    "Plain": [{"a": 1}, {"a": 1, "b": "x", "c": [2]}, {"a": 2}],
    "Fields": [{"a": 1}, {"a": 1, "d": 2, "e": (3,), "f": 4}, {"a": 1, "e": (9,)}],
    "Below": [{"a": 1}, {"a": 1, "b": "x", "c": [2], "z": 0}],
    "Empty": [{}],
    "After": [{"a": 1}, {"a": 2}],
    "Own": [{"a": 1}, {"a": 2}],
    "Equal": [{"a": 1}, {"a": 2}],
}


def _hash(value: object) -> object:
    """Its kind and its number, where it is not that of one object."""
    try:
        return hash(value) if type(value).__hash__ is not object.__hash__ else "its own"
    except TypeError as error:
        return str(error).replace("'Plain'", "'P'")


def _said(call: Callable[[], object]) -> str:
    try:
        return repr(call())
    except (TypeError, ValueError, AttributeError) as error:
        return f"{type(error).__name__}: {error}".replace("<locals>.", "")


@pytest.mark.parametrize("settings", SETTINGS, ids=lambda settings: "-".join(k for k, v in settings.items() if v))
@pytest.mark.parametrize("name", MADE)
def test_as_the_standard_library(name: str, settings: dict[str, bool]) -> None:
    ours, theirs = (_classes(make, **settings)[name] for make in (records.dataclass, dataclasses.dataclass))
    one, other = ([cls(**given) for given in MADE[name]] for cls in (ours, theirs))
    assert [repr(value) for value in one] == [repr(value) for value in other]
    assert [[a == b for a in one] for b in one] == [[a == b for a in other] for b in other]
    assert [_hash(value) for value in one] == [_hash(value) for value in other]
    assert [dataclasses.asdict(value) for value in one] == [dataclasses.asdict(value) for value in other]
    assert [copy.copy(value) == value for value in one] == [copy.copy(value) == value for value in other]
    assert [repr(copy.deepcopy(value)) for value in one] == [repr(value) for value in other]
    assert ours.__match_args__ == theirs.__match_args__
    assert [f.name for f in dataclasses.fields(ours)] == [f.name for f in dataclasses.fields(theirs)]
    assert hasattr(one[0], "__dict__") == hasattr(other[0], "__dict__")
    assert (one[0] == other[0]) == (other[0] == one[0])


@pytest.mark.parametrize("settings", SETTINGS, ids=lambda settings: "-".join(k for k, v in settings.items() if v))
def test_what_fails_fails_alike(settings: dict[str, bool]) -> None:
    ours, theirs = (_classes(make, **settings) for make in (records.dataclass, dataclasses.dataclass))
    for name, call in (
        ("Plain", lambda cls: cls()),
        ("Plain", lambda cls: cls(1, "b", [], 4)),
        ("Plain", lambda cls: cls(a=1, unknown=2)),
        ("Plain", lambda cls: cls(1)),
        ("Fields", lambda cls: cls(a=1, g=2)),
        ("Fields", lambda cls: cls(1, 2, (), 3)),
        ("After", lambda cls: cls(a=-1)),
        ("Plain", lambda cls: setattr(cls(a=1), "a", 2)),
        ("Plain", lambda cls: delattr(cls(a=1), "a")),
        ("Plain", lambda cls: cls(a=1) < cls(a=2)),
        ("Fields", lambda cls: replace(cls(a=1), g=3)),
    ):
        said = _said(lambda call=call, name=name: call(ours[name]))  # type: ignore[misc]  # lambdas are not typed
        expected = _said(lambda call=call, name=name: call(theirs[name]))  # type: ignore[misc]  # the same
        assert said.split(": ")[0] == expected.split(": ")[0], name
        if not settings["frozen"]:
            assert (
                said.replace("test_records.", "") == expected
                or "__init__" in said
                or "__slots__" in said
                or "no attribute" in said
            )


@records.dataclass(frozen=True, slots=True, order=True)
class Sent:
    a: int
    b: tuple[str, ...] = ()


@records.dataclass(frozen=True)
class Round:
    a: list[object]


@pytest.mark.parametrize("value", [Sent(1), Sent(2, ("x",))])
def test_it_goes_to_other_processes(value: Sent) -> None:
    again = pickle.loads(pickle.dumps(value))
    assert again == value and hash(again) == hash(value) and again is not value


def test_order() -> None:
    assert Sent(1) < Sent(1, ("a",)) < Sent(2) <= Sent(2) and Sent(3) > Sent(2) >= Sent(1, ("z",))
    assert sorted([Sent(2), Sent(1)]) == [Sent(1), Sent(2)]


def test_nothing_is_assigned_to_what_is_frozen() -> None:
    for change in (lambda: setattr(Sent(1), "a", 2), lambda: delattr(Sent(1), "a"), lambda: setattr(Sent(1), "c", 2)):
        with pytest.raises(FrozenInstanceError):
            change()


def test_a_record_in_itself_is_shown() -> None:
    items: list[object] = []
    value = Round(items)
    items.append(value)
    assert repr(value) == "Round(a=[...])"


def test_objects_of_another_class_are_not_equal() -> None:
    assert Sent(1) != (1, ()) and Sent(1) != Round([1])
