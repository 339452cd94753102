# SPDX-License-Identifier: Apache-2.0
"""What a run makes, and what is called back in it: kept, forgotten again, and joined where two ways make the same."""

from __future__ import annotations

from collections.abc import Callable as Function_
from collections.abc import Mapping
from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING

from haros_ci.graph.parameters import Setting
from haros_ci.graph.ros2_process import RosNode
from haros_ci.model.architecture import Condition, Qos
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.values.abstract import NONE, Callable
from haros_ci.values.cells import Slot

if TYPE_CHECKING:
    from haros_ci.follow.walk import Walk

#: What tells what is made, called back, or offered from all else of its kind.
Key = tuple[object, ...]
#: The least and greatest value of a parameter, and its step.
Range = tuple[float | None, float | None, float | None]
#: The reason where not all conditions are recorded.
SEVERAL = "it is made on several ways, each under conditions of its own"
#: Why what stands behind a way out that is taken as things are may not be made in ROS 2: no statement around it says so.
BEHIND = "as things are, the code returns before it comes to this"


@dataclass(frozen=True, slots=True)
class MadeEntity:
    """What a call made, before remapping: *name* is absolute, with ``?`` for unknown parts."""

    kind: str
    name: str
    type: str | None
    location: Location
    conditions: tuple[Condition, ...]
    queue_size: int | None = None
    latched: bool | None = None
    value: object = None
    implicit: bool = False
    qos: Qos | None = None
    effective: object = None
    read_only: bool | None = None
    range: Range | None = None
    is_dynamic: bool = False
    is_strict: bool = False
    #: The ROS 2 node that has it; None if it is not known, and in ROS 1.
    node: RosNode | None = None
    is_exact: bool = False
    #: Of the branches around it, those that are not taken as things are.
    dead: int = 0
    #: Whether it stands behind an early way out that is taken as things are.
    is_behind: bool = False
    unknowns: tuple[tuple[str, str, Location | None], ...] = ()
    #: The name as the call gives it, ``?`` for its unknown parts.
    written: str | None = field(default=None, compare=False)


class Entities(dict[Key, MadeEntity]):
    """What was made, by key."""

    __slots__ = ("_keys",)

    def __init__(self) -> None:
        super().__init__()
        self._keys: dict[tuple[str, object], dict[Key, None]] = {}

    def note(self, key: Key, made: MadeEntity) -> None:
        """Keep what was *made* so that ``of`` finds it."""
        self[key] = made
        for what in (made.name, made.location):
            self._keys.setdefault((made.kind, what), {})[key] = None

    def of(self, kind: str, what: str | Location | None) -> list[tuple[Key, MadeEntity]]:
        """What was made of a *kind* under that name, or in that place."""
        return [(key, self[key]) for key in self._keys.get((kind, what), ()) if key in self]


@dataclass(frozen=True, slots=True, eq=False)
class Root:
    """A function that is called back later, under the conditions of its registration.

    *writes* are what the callback that registered it leaves behind, if it was one.
    """

    function: Callable
    conditions: tuple[Condition, ...]
    writes: Mapping[Slot, object] = field(default_factory=dict)
    #: Whether it is called when somebody sets parameters, or takes a node down: what it changes then is not seen elsewhere.
    is_update: bool = False
    #: Whether a managed node is brought up by it, before anything else is called back.
    is_setup: bool = False
    #: Whether a framework calls it when the object is there, as a nodelet's manager calls ``onInit``.
    is_entry: bool = False
    #: Whether a behaviour tree calls it: what it changes is not seen elsewhere.
    is_tick: bool = False
    #: Why it may not be registered although the conditions hold, where no statement says so.
    doubt: str | None = None
    #: Of the branches around its registration, those that are not taken as things are.
    dead: int = 0


@dataclass(frozen=True, slots=True)
class Kept:
    """What a walk had recorded at some point."""

    made: Mapping[Key, MadeEntity]
    gaps: Mapping[str, Location]
    #: Of nodes, names, alternatives, of timers and rates, and of functions that were made.
    counts: tuple[int, int, int, int, int]
    #: The static variables and plug-ins that there were.
    sets: tuple[frozenset[tuple[str, str]], frozenset[Key]]
    #: The callbacks, and the number of each.
    roots: tuple[tuple[Root, ...], Mapping[Key, int]]


def either(
    one: tuple[Condition, ...], other: tuple[Condition, ...], pairs: Mapping[Location, Location]
) -> tuple[tuple[Condition, ...], bool]:
    """The conditions of what is made on two ways, and whether they are all: what both ways have in common.

    That is all where one of the ways has no more, or where one takes an ``if`` and the other its ``else``; *pairs* has
    the place of each ``else``'s ``if``. Early ways out in which they differ do not count.
    """
    common = tuple(condition for condition in one if condition in other)
    around = sorted(common, key=lambda condition: condition.is_early)
    left, right = ([item for item in way if not item.is_early and item not in common] for way in (one, other))
    if len(left) == len(right) == 1:
        first, second = (right[0], left[0]) if left[0].statement == "else" else (left[0], right[0])
        both = first.statement == "if" and second.statement == "else" and first.condition == second.condition
        return tuple(around), both and pairs.get(second.location) == first.location
    return tuple(around), not left or not right


def make(walk: Walk, made: MadeEntity) -> None:
    """Keep *made* unless this is a rehearsal; of two ways to one endpoint the less conditional counts."""
    if walk.quiet or walk.is_raised:
        return
    key = (
        made.kind,
        made.name,
        made.type,
        made.location,
        made.queue_size,
        made.latched,
        repr(made.value),
        made.qos,
        made.node and made.node.name,
    )
    known = walk.made.get(key)
    conditions, unknowns = made.conditions, made.unknowns
    if made.is_behind and not walk.dead and walk.context.process is not None:
        unknowns = (*unknowns, ("conditions", BEHIND, made.location))
    if walk.doubts:
        unknowns = (*unknowns, ("conditions", walk.doubts[-1], made.location))
    if known is not None:
        other = replace(made, conditions=conditions, unknowns=unknowns, dead=walk.ruled_out())
        conditions, unknowns = _both(walk, known, other)
        if known.is_behind != made.is_behind:  # on one of the ways it is come to
            made = replace(made, is_behind=False)
            counting, rest = (other, known) if known.is_behind else (known, other)
            if counting.dead == rest.dead:
                conditions, unknowns = counting.conditions, counting.unknowns
            unknowns = tuple(unknown for unknown in unknowns if unknown[:2] != ("conditions", BEHIND))
        if known.type != made.type or known.is_strict != made.is_strict:
            made = _as_known(known, made)
    dead = walk.ruled_out() if known is None else min(walk.ruled_out(), known.dead)
    if dead != made.dead or conditions is not made.conditions or unknowns is not made.unknowns:
        made = replace(made, conditions=conditions, unknowns=unknowns, dead=dead)
    if known is not None and (known.conditions != conditions or known.dead != dead):
        walk.news += 1
    walk.made.note(key, made)
    if walk.lacking and len(walk.lacking) == walk.ruled_out() == dead:
        walk.lacks[key] = tuple(walk.lacking)


def _sets(made: MadeEntity) -> bool:
    """Whether a setter is one that is made as things are, and deletes nothing."""
    return not made.dead and (made.value is not None or made.type is not None or bool(made.unknowns))


def is_set_in_time(walk: Walk) -> None:
    """What is ruled out as a parameter is not set that the node itself sets is made when it runs again: the server keeps it."""
    setters = [Setting("", made.name, NONE) for made in walk.made.values() if made.kind == "setters" and _sets(made)]
    for key, lacking in walk.lacks.items():
        made = walk.made.get(key)
        if made is None or made.dead != len(lacking):
            continue
        if all(any(setter.concerns(name) for setter in setters for name in names) for names in lacking):
            walk.made[key] = replace(made, dead=0)


def _as_known(known: MadeEntity, made: MadeEntity) -> MadeEntity:
    """*made* is strict if it was *known* as that, and has the type that was."""
    if known.is_strict and not made.is_strict:
        made = replace(made, is_strict=True)
    if known.type is not None and made.type is None:  # which a later reading has recorded
        made = replace(made, type=known.type)
    return made


def _both(
    walk: Walk, known: MadeEntity, other: MadeEntity
) -> tuple[tuple[Condition, ...], tuple[tuple[str, str, Location | None], ...]]:
    """The conditions and unknowns of what is made on two ways; one that fewer branches rule out as things are counts alone."""
    conditions, is_all = either(known.conditions, other.conditions, walk.pairs)
    unknowns, before = other.unknowns, known.unknowns
    if counts_alone(known, other, is_all):
        counting = known if known.dead < other.dead else other
        conditions = counting.conditions
        before = before if counting is known else tuple(unknown for unknown in before if unknown[1] != SEVERAL)
    elif not is_all and SEVERAL not in (unknown[1] for unknown in before):
        unknowns = (*unknowns, ("conditions", SEVERAL, other.location))
    if _is_certain(known, other, conditions) or _is_certain(other, known, conditions):
        before, unknowns = (tuple(one for one in items if one[0] != "conditions") for items in (before, unknowns))
    return conditions, tuple(dict.fromkeys((*before, *unknowns)))


def _is_certain(way: MadeEntity, other: MadeEntity, conditions: tuple[Condition, ...]) -> bool:
    """Whether *way* alone makes it for sure under *conditions*, whatever the *other* one does."""
    is_open = any(unknown[0] == "conditions" for unknown in way.unknowns)
    return set(way.conditions) == set(conditions) and way.dead <= other.dead and not is_open


def counts_alone(known: MadeEntity | Root, other: MadeEntity | Root, is_all: bool) -> bool:
    """Whether of two ways the one counts that fewer branches rule out: not where they are the branches of one ``if``."""
    is_longer = len(known.conditions) != len(other.conditions)
    return known.dead != other.dead and (is_longer or not is_all)


def keep(walk: Walk) -> Kept:
    """A snapshot of what the walk has recorded so far, to go back to."""
    counts = len(walk.nodes), len(walk.names), len(walk.alternatives), len(walk.paces), len(walk.held)
    sets = frozenset(walk.statics), frozenset(walk.offered)
    return Kept(dict(walk.made), dict(walk.gaps), counts, sets, (tuple(walk.roots), dict(walk.known_roots)))


def go_back(walk: Walk, kept: Kept) -> None:
    """Drop what was recorded since the snapshot *kept*."""
    walk.made.clear()
    walk.made.update(kept.made)
    walk.gaps.clear()
    walk.gaps.update(kept.gaps)
    nodes, names, alternatives, paces, held = kept.counts
    for function in list(walk.held)[held:]:
        del walk.held[function]
    for key in list(walk.paces)[paces:]:
        del walk.paces[key]
    del walk.nodes[nodes:], walk.names[names:], walk.alternatives[alternatives:]
    walk.roots[:] = kept.roots[0]
    walk.known_roots = dict(kept.roots[1])
    statics, offered = kept.sets
    for key in walk.statics.keys() - statics:
        del walk.statics[key]
    walk.offered &= offered


def not_ruled_out(walk: Walk, run: Function_[[], None]) -> None:
    """What *run* makes again, and other branches than before, is not ruled out; what else it makes and registers does not count."""
    kept = keep(walk)
    run()
    found = dict(walk.made)
    go_back(walk, kept)
    for key, made in kept.made.items():
        other = found.get(key)
        if other is not None and other.dead < made.dead:
            walk.made[key] = other


def forget_again(walk: Walk, known: int) -> None:
    """Of what was made after the first *known*, drop what stands where the same was made before."""
    every = list(walk.made.items())
    before = {(made.kind, made.location) for _, made in every[:known]}
    for key, made in every[known:]:
        if (made.kind, made.location) in before:
            del walk.made[key]


def forget_dead(walk: Walk, known: int) -> None:
    """Of what was made after the first *known*, drop what stands in branches that another turn of a loop takes.

    Where no turn takes all of the branches around a place, those count that take the most. The same of early ways out:
    a turn that takes one makes nothing behind it where another does not take it.
    """
    if len(walk.made) > known:
        since = list(islice(reversed(walk.made.items()), len(walk.made) - known))[::-1]
        least: dict[tuple[str, Location], tuple[int, bool]] = {}
        for _, made in since:
            place, count = (made.kind, made.location), (made.dead, made.is_behind)
            least[place] = min(count, least.get(place, count))
        for key, made in since:
            if (made.dead, made.is_behind) > least[made.kind, made.location]:
                del walk.made[key]


def forget_unowned(walk: Walk) -> None:
    """Drop what is made on a node that is not known where the same call is seen to make it on one that is.

    It is another way to that: the conditions are those of both.
    """
    owned: dict[tuple[str, Location], list[Key]] = {}
    for key, made in walk.made.items():
        if made.node is not None:
            owned.setdefault((made.kind, made.location), []).append(key)
    for key, made in list(walk.made.items()):
        same = owned.get((made.kind, made.location), ())
        if made.node is None and made.name.startswith("/?") and same:
            del walk.made[key]
            for item in same:
                known = walk.made[item]
                result = replace(
                    made, unknowns=tuple(unknown for unknown in made.unknowns if unknown[0] == "conditions")
                )
                conditions, unknowns = _both(walk, known, result)
                dead = min(known.dead, made.dead)
                walk.made[item] = replace(known, conditions=conditions, unknowns=unknowns, dead=dead)
