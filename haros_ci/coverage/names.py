# SPDX-License-Identifier: Apache-2.0
"""The names by which calls of ROS APIs are found in text: those of the API rows that make an endpoint or a parameter."""

from __future__ import annotations

from haros_ci.model.api import Row
from haros_ci.model.architecture import KINDS
from haros_ci.model.once import once
from haros_ci.records import dataclass

#: Methods that any class may have, and those whose calls are no calls of ROS most of the time.
EVERYDAY = frozenset(
    "start add call create configure init del search get set has publish publish_if_subscribed onInit on_parameter_event".split()
)
#: Classes of which most objects make no endpoint.
SILENT = frozenset(("Buffer", "TransportHints", "LifecycleNode"))


@dataclass(frozen=True, slots=True)
class Names:
    """What is looked for in files of one language and ROS version.

    *methods* are last parts of names; *qualified* are functions that only the namespace before them distinguishes from others
    (``param::get``); *classes* has all full names by their last part.
    """

    methods: frozenset[str]
    qualified: frozenset[str]
    classes: dict[str, frozenset[str]]


@once
def names_of(rows: tuple[Row, ...]) -> Names:
    """What is looked for, by the *rows* of one language and ROS version."""
    methods: set[str] = set()
    qualified: set[str] = set()
    classes: dict[str, set[str]] = {}
    for row in rows:
        if not _makes_something(row):
            continue
        whole = row.call.replace(".", "::")
        space, _, last = whole.rpartition("::")
        if last[:1].isupper():
            if last not in SILENT:
                classes.setdefault(last, set()).add(whole)
            continue
        owner = space.rpartition("::")[2]
        if last not in EVERYDAY:
            methods.add(last)
        elif owner[:1].islower() and "::" in space:
            qualified.add(f"{owner}::{last}")
    return Names(frozenset(methods), frozenset(qualified), {name: frozenset(found) for name, found in classes.items()})


def _makes_something(row: Row) -> bool:
    """Whether a call of the row makes an endpoint or a parameter by itself."""
    return any(entry.kind in KINDS and not entry.implicit for entry in row.makes)


def joined(one: Names, other: Names) -> Names:
    """What is looked for where the ROS version of a file is not known."""
    classes = {
        name: one.classes.get(name, frozenset()) | other.classes.get(name, frozenset())
        for name in {**one.classes, **other.classes}
    }
    return Names(one.methods | other.methods, one.qualified | other.qualified, classes)
