# SPDX-License-Identifier: Apache-2.0
"""Presence conditions: under which launch arguments an entity of a configuration exists.

As in feature-oriented product lines, a presence condition is over a finite domain: here a conjunction of choices, each of a
launch argument of the configuration's own launch files. () holds always. Nothing is enumerated: two entities can exist together
if the conjunction of theirs is not contradictory.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.records import dataclass

_TRUTH = {"true": "true", "1": "true", "false": "false", "0": "false"}


@dataclass(frozen=True, slots=True, order=True)
class Choice:
    """A launch *argument* has *value*, or, where not *equal*, another one. Booleans are ``true`` and ``false``, always equal."""

    argument: str
    value: str
    equal: bool = True


#: A conjunction of choices, sorted, without repetition.
Presence = tuple[Choice, ...]
ALWAYS: Presence = ()


def choice(argument: str, value: str, *, equal: bool = True, boolean: bool = False) -> Choice:
    """The choice of *value* for *argument*; of a *boolean* argument in its one spelling, with the other value where not *equal*."""
    word = _TRUTH.get(value.strip().lower()) if boolean else None
    if word is None:
        return Choice(argument, value, equal)
    return Choice(argument, word if equal else "false" if word == "true" else "true")


def together(*presences: Presence) -> Presence | None:
    """The conjunction; None if it is contradictory, so that the entities never exist at once."""
    merged = tuple(sorted(set().union(*presences)))
    fixed: dict[str, str] = {}
    for item in merged:
        if item.equal and fixed.setdefault(item.argument, item.value) != item.value:
            return None
    if any(not item.equal and fixed.get(item.argument) == item.value for item in merged):
        return None
    return tuple(item for item in merged if item.equal or item.argument not in fixed)


def assignment(presence: Presence, defaults: Mapping[str, str]) -> tuple[tuple[str, str], ...] | None:
    """The arguments to set for *presence* to hold, as few as can be: those whose default does not do already.

    None where a choice excludes a default and no other value is known.
    """
    requested: list[tuple[str, str]] = []
    for item in presence:
        default = defaults.get(item.argument)
        same = default is not None and _same(default, item.value)
        if item.equal and not same:
            requested.append((item.argument, _spelled(item.value, default)))
        elif not item.equal and same:
            return None
    return tuple(requested)


def _same(default: str, value: str) -> bool:
    return default == value or (value in ("true", "false") and _TRUTH.get(default.strip().lower()) == value)


def _spelled(value: str, default: str | None) -> str:
    """A boolean as the default writes it, for expressions that only take it so."""
    word = (default or "").strip()
    if value not in ("true", "false") or word not in ("True", "False", "1", "0"):
        return value
    return value.capitalize() if word in ("True", "False") else "1" if value == "true" else "0"


def in_words(requested: Iterable[tuple[str, str]]) -> str:
    """``use_sim:=true slam:=true``, as one writes it on the command line."""
    return " ".join(f"{name}:={value}" for name, value in requested)
