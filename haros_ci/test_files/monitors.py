# SPDX-License-Identifier: Apache-2.0
"""The monitors of a suite as a module, with the names of its classes. The module is what ``haros-ci monitor --generate`` writes, without its node."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from haros_ci.behaviour.tree import Event, Property
from haros_ci.monitor_files.classes import Described, TooDeep, class_text
from haros_ci.monitor_files.core import core_text
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.records import dataclass
from haros_ci.test_files.suite import Suite

#: How a module of monitors begins.
_HEAD = """\
# {mark}; generating again writes it anew.
\"\"\"The properties as monitors: each takes messages in order of time, and says when it is violated.\"\"\"

"""


@dataclass(frozen=True, slots=True)
class Monitors:
    """The *text* of the module, the name of the class of each property and assumption by its identity, and sentences about what is left out."""

    text: str
    classes: Mapping[int, str]
    left_out: tuple[str, ...]


def roles_of(parsed: Property) -> Iterator[tuple[str, Event]]:
    """The events of a property, each with its role."""
    for role, events in (
        ("activator", parsed.scope.activator),
        ("terminator", parsed.scope.terminator),
        ("trigger", parsed.pattern.trigger),
        ("behaviour", parsed.pattern.behaviour),
    ):
        for event in events:
            yield role, event


def monitors_of(suite: Suite, mark: str) -> Monitors:
    """The monitors of all properties and assumptions that can be written; *mark* begins the module."""
    described: list[Described] = []
    classes: dict[int, str] = {}
    left_out: list[str] = []
    for item in (*suite.properties, *suite.assumptions):
        monitor = monitor_of(item.parsed, {}, item.constants)
        one = Described(monitor, item.title, item.text)
        try:
            class_text("Property", one)
        except TooDeep:
            left_out.append(f"{item.title}: not tested: too many operators stand within each other in a predicate")
            continue
        if monitor.unusable:
            left_out.append(f"{item.title}: not tested: {monitor.unusable}")
            continue
        described.append(one)
        classes[id(item)] = f"Property{len(described)}"
    return Monitors(f"{_HEAD.format(mark=mark)}{module_of(described)}", classes, tuple(left_out))


def module_of(described: Sequence[Described]) -> str:
    """The classes of these properties, ``Property1`` and so on, as a module; annotations are not evaluated, so that Python 3.8 reads them."""
    return core_text(described)[0]
