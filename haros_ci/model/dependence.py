# SPDX-License-Identifier: Apache-2.0
"""Which inputs of nodes can cause which outputs: directly or through state, under which conditions, and what is not known."""

from __future__ import annotations

from haros_ci.model.location import Location
from haros_ci.records import dataclass

#: How an input leads to an output: its callback sends it, its callback changes what decides or gives data to that, or it may do so.
DIRECT, STATE, PERHAPS = "direct", "state", "perhaps"
#: Nobody knows, for a reason.
UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class When:
    """A condition on the way: *text* as written, *is_met* False where it must not hold (an else, a way out before).

    *reads* are what it asks for: ``parameter x``, ``field x.y``, ``state x``.
    """

    text: str
    is_met: bool
    location: Location
    reads: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Cause:
    """An input that can cause an output. *kind* is subscription, service, action, timer, response or parameters.

    *name* is that of the topic, service or action, "" for others. *how* is direct, state or perhaps, *state* what is changed on the way, *conditions* are those
    on the way, *path* the places from the callback to what is sent. *is_each* says that each run of the callback sends once.
    """

    kind: str
    name: str
    location: Location
    how: str
    state: tuple[str, ...] = ()
    conditions: tuple[When, ...] = ()
    path: tuple[tuple[Location, str], ...] = ()
    reason: str = ""
    is_each: bool = False


@dataclass(frozen=True, slots=True)
class Output:
    """What a node sends: *kind* is that of the endpoint. *calls* are the places that send.

    *is_start* says that the program also sends it by itself, at its beginning or in a loop of its own.
    *reason* says why inputs that are not among the *causes* may be causes, too; "" if they are none.
    """

    kind: str
    name: str
    location: Location | None
    calls: tuple[Location, ...]
    causes: tuple[Cause, ...]
    is_start: bool = False
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Input:
    """What a node gets, or a timer of it; *reason* says why it is not known what it does, "" if it is."""

    kind: str
    name: str
    location: Location | None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class NodeDependence:
    """The inputs and outputs of one *node*; *reason* says why it may have others."""

    node: str
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Reached:
    """A step of a slice over a system: in *node* the *source*, a topic, service, action or timer, leads to the *target*.

    *depth* counts from where the slice begins. *how* is that of the cause, or ``unknown`` for a *reason*.
    """

    node: str
    source: tuple[str, str]
    target: tuple[str, str]
    how: str
    depth: int
    cause: Cause | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Slice:
    """All that *name* reaches (*is_forward*), or that reaches it, nearest first."""

    name: str
    is_forward: bool
    steps: tuple[Reached, ...]


@dataclass(frozen=True, slots=True)
class Dependence:
    """The dependence in all nodes of a configuration, and the slices over it that were asked for."""

    nodes: tuple[NodeDependence, ...]
    slices: tuple[Slice, ...] = ()
