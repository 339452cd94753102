# SPDX-License-Identifier: Apache-2.0
"""Nodelets that a program loads into itself, with ``nodelet::Loader``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.follow.frames import Frame
from haros_ci.follow.made import MadeEntity, make
from haros_ci.follow.ros import paces
from haros_ci.follow.walk import Walk
from haros_ci.graph.names import clean, pattern, resolve
from haros_ci.model.location import Location
from haros_ci.values.abstract import NONE, TRUE, Cell, Choice, Known, Mapped, Opaque, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Nodelets that one node loads.
MOST = 64


def remappings(walk: Walk) -> Value:
    """``ros::names::getRemappings()``: what the node's own command line remaps."""
    return Mapped(Cell({source: Cell(Known(target)) for source, target in sorted(walk.context.remaps.items())}))


def nodelet(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...], location: Location) -> Value:
    """``nodelet::Loader::load(name, type, remappings, my_argv)``: the nodelet is a part of the node, under that name.

    Its private namespace is the name, its namespace the one above; its remappings go before the node's own (nodelet.h).
    """
    if walk.quiet:
        return walk.opaque("whether a nodelet is loaded", frame, location.line)
    name, kind = args[0].value, args[1].value
    renames = _remappings(args[2].value) if len(args) > 2 else {}
    options = kind.options if isinstance(kind, Choice) else (kind,)
    for option in options:
        with walk.doubted("one of several nodelets is loaded" if len(options) > 1 else None):
            _load(walk, name, option, renames, location)
    return TRUE if len(options) == 1 else walk.opaque("whether a nodelet is loaded", frame, location.line)


def _load(walk: Walk, name: Value, kind: Value, renames: Mapping[str, Value] | None, location: Location) -> None:
    if not isinstance(kind, Known) or not issubclass(kind.kind, str):
        walk.gaps.setdefault("it loads a nodelet of which the type is not known", location)
        return
    context = walk.context
    text, why, where = pattern(name)
    full = resolve(text, context.namespace, context.name) if text[:1] != "?" else "/?"
    above = "/?" if why is not None else full.rpartition("/")[0] or "/"
    context.loaded.append(kind.of(str))
    if len(context.loaded) > MOST:
        walk.gaps.setdefault(f"it loads more than the {MOST} nodelets that are followed", location)
        return
    found = context.nodelet(kind.of(str), full, above, walk.parameter)
    if found is None:
        walk.gaps.setdefault(f"it loads the nodelet {kind.value}, which is not in the workspace", location)
        return
    made, gaps = found
    for message, place in gaps.items():
        walk.gaps.setdefault(message, place)
    named = None if renames is None else _absolute(renames, full)
    for item in made:
        unknowns = item.unknowns
        if why is not None and "?" in item.name and not any(field == "name" for field, _, _ in unknowns):
            unknowns = (*unknowns, ("name", f"the name of the nodelet: {why}", where or location))
        item = replace(item, conditions=(*walk.conditions, *item.conditions), unknowns=unknowns)
        if item.kind in paces.KINDS:
            walk.paces[item.kind, item.location, full] = (item, None)
            continue
        make(walk, _renamed(item, named, location))
        if item.kind == "setters":
            _was_set(walk, item.name, location)


def _remappings(value: Value) -> Mapping[str, Value] | None:
    """The entries of a map of remappings; None if they are not known."""
    content = value.content.value if isinstance(value, Mapped) else {} if value == NONE else None
    found = (
        {key: cell.value for key, cell in content.items() if isinstance(key, str)} if isinstance(content, dict) else {}
    )
    return found if isinstance(content, dict) and len(found) == len(content) else None


def _absolute(renames: Mapping[str, Value], full: str) -> dict[str, Value]:
    """Remappings by absolute names: relative ones hold below the namespace of each of the nodelet's handles."""
    space = full.rpartition("/")[0] or "/"
    found: dict[str, Value] = {}
    for handle in (full, space):
        for source, target in renames.items():
            text, why, _ = pattern(target)
            found[resolve(source, handle, full)] = Known(resolve(text, handle, full)) if why is None else target
    return found


def _renamed(item: MadeEntity, renames: Mapping[str, Value] | None, location: Location) -> MadeEntity:
    if renames is None:
        unknown = ("name", "the remappings of the nodelet are not known", location)
        return item if item.implicit else replace(item, name="/?", unknowns=(*item.unknowns, unknown))
    target = renames.get(item.name)
    if target is None:
        return item
    text, why, where = pattern(target)
    if why is None:
        return replace(item, name=clean(text))
    return replace(item, name="/?", unknowns=(*item.unknowns, ("name", why, where or location)))


def _was_set(walk: Walk, name: str, location: Location) -> None:
    """The node finds what the nodelet has set, if not to what."""
    own = walk.server.value
    if isinstance(own, dict):
        value = Opaque("a nodelet sets it", location)
        walk.state.write(walk.server, value if "?" in name else {**own, name: value})
