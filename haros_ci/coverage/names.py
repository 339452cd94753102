# SPDX-License-Identifier: Apache-2.0
"""The names by which calls of ROS APIs are found in text: those of the API rows that make an endpoint or a parameter."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from haros_ci.model.api import Row
from haros_ci.model.architecture import KINDS

#: Methods that any class may have, and those whose calls are no calls of ROS most of the time.
EVERYDAY = frozenset(
    "start add call create configure init del search get set has publish publish_if_subscribed onInit on_parameter_event".split()
)
#: Classes of which many an object makes nothing.
SILENT = frozenset(("Buffer", "TransportHints", "LifecycleNode"))


@dataclass(frozen=True, slots=True)
class Names:
    """What is looked for in files of one language and ROS version.

    *methods* are last parts of names; *qualified* functions that are told by the namespace before them only (``param::get``); *classes*
    are by their last part all full names.
    """

    methods: frozenset[str]
    qualified: frozenset[str]
    classes: dict[str, frozenset[str]]
    #: The library classes that rows tell of, the methods of each that make something, and the bases of each.
    making: dict[str, frozenset[str]] = field(default_factory=dict)
    bases: dict[str, frozenset[str]] = field(default_factory=dict)


def names_of(rows: Iterable[Row]) -> Names:
    """What is looked for, by the *rows* of one language and ROS version."""
    methods: set[str] = set()
    qualified: set[str] = set()
    classes: dict[str, set[str]] = {}
    making: dict[str, set[str]] = {}
    bases: dict[str, set[str]] = {}
    for row in rows:
        whole = row.call.replace(".", "::")
        space, _, last = whole.rpartition("::")
        if row.bases:
            bases.setdefault(whole, set()).update(each.replace(".", "::") for each in row.bases)
        if not _makes_something(row):
            continue
        if last[:1].isupper():
            if last not in SILENT:
                classes.setdefault(last, set()).add(whole)
            continue
        owner = space.rpartition("::")[2]
        if owner[:1].isupper():
            making.setdefault(space, set()).add(last)
        if last not in EVERYDAY:
            methods.add(last)
        elif owner[:1].islower() and "::" in space:
            qualified.add(f"{owner}::{last}")
    return Names(frozenset(methods), frozenset(qualified), _frozen(classes), _frozen(making), _frozen(bases))


def _makes_something(row: Row) -> bool:
    """Whether a call of the row makes an endpoint or a parameter by itself."""
    return any(entry.kind in KINDS and not entry.implicit for entry in row.makes)


def _frozen(table: dict[str, set[str]]) -> dict[str, frozenset[str]]:
    return {name: frozenset(found) for name, found in table.items()}


def joined(one: Names, other: Names) -> Names:
    """What is looked for where the ROS version of a file is not known."""
    classes = {
        name: one.classes.get(name, frozenset()) | other.classes.get(name, frozenset())
        for name in {**one.classes, **other.classes}
    }
    making = {
        name: one.making.get(name, frozenset()) | other.making.get(name, frozenset())
        for name in {**one.making, **other.making}
    }
    bases = {
        name: one.bases.get(name, frozenset()) | other.bases.get(name, frozenset())
        for name in {**one.bases, **other.bases}
    }
    return Names(one.methods | other.methods, one.qualified | other.qualified, classes, making, bases)
