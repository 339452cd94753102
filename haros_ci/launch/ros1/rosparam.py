# SPDX-License-Identifier: Apache-2.0
"""``<rosparam>`` (wiki roslaunch/XML/rosparam): YAML unfolded into parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from haros_ci.launch.ros1.scope import LoaderScope, location
from haros_ci.launch.ros1.state import RoslaunchState, unset
from haros_ci.model.architecture import Condition, Parameter
from haros_ci.model.launch import LaunchElement
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.substitutions.names import MARK, Text, join, join_in, literal, quoted, unknown
from haros_ci.substitutions.types import type_of
from haros_ci.substitutions.yaml import OpaqueNode, YamlError, YamlValue, parts, plain, read_yaml

ATTRIBUTES = ("command", "ns", "file", "param", "subst_value")
_INT32 = range(-(2**31), 2**31)


@dataclass(frozen=True, slots=True)
class Leaf:
    """One parameter of an unfolded map."""

    name: Text
    value: YamlValue


def rosparam(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]) -> None:
    """Load what *tag* says into the namespace of *scope*.

    Of a file that cannot be read nobody knows what it sets: a parameter ``/namespace/?`` stands for that.
    ``delete`` and ``dump`` happen before parameters are set, so they change none. A name with ``~`` stays as it is, as
    in ``roslaunch --dump-params``: it is private to roslaunch itself.
    """
    state.check_attributes(scope, tag, ATTRIBUTES)
    command, ns, file, param = (state.attribute(scope, tag, name) for name in ("command", "ns", "file", "param"))
    substitute = state.truth(scope, tag, "subst_value")
    name = _target(ns, param)
    verb = "load" if command is None or command.raw == "" else command.raw
    if command is not None and not command.known:
        state.wrong(scope, tag, f"<rosparam> has an unknown command: {command.reasons[0]}. The tag is left out")
        _anything(state, scope, tag, conditions, name, f"<rosparam> has an unknown command: {command.reasons[0]}")
    elif verb == "delete" and file is not None:
        state.wrong(scope, tag, "<rosparam command='delete'> takes no 'file'; remove it")
    elif verb == "dump" and file is None:
        state.wrong(scope, tag, "<rosparam command='dump'> needs a 'file'; add it")
    elif verb == "load":
        source = _file(state, scope, tag, file) if file is not None else _body(tag)
        why = source if isinstance(source, str) else _load(state, scope, tag, conditions, source, name, substitute)
        if why is not None:
            _anything(state, scope, tag, conditions, name, why)
    elif verb not in ("delete", "dump"):
        state.wrong(scope, tag, f"<rosparam command={quoted(verb)}>: write load, dump or delete. The tag is left out")


@dataclass(frozen=True, slots=True)
class _Source:
    text: str
    path: str | None
    line: Callable[[int], int]


def _target(ns: Text | None, param: Text | None) -> Text:
    """``ns`` and ``param`` as one name; either may be global or private, which then counts alone."""
    outer, inner = ns or literal(""), param or literal("")
    joined = join(outer.raw, inner.raw) if inner.raw else outer.raw
    if joined.count(MARK) == len(inner.reasons):
        return Text(joined, inner.reasons)
    return Text(joined, outer.reasons + inner.reasons)


def _file(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, file: Text) -> _Source | str:
    """The text of *file*, or why there is none."""
    place = state.files.place(file)
    if place.path is None:
        why = f"<rosparam> loads {quoted(file.shown)}: {place.reason}"
        state.wrong(scope, tag, f"{why}; what it sets is unknown")
        return why
    if not state.files.has(place.path):
        why = f"<rosparam> loads {quoted(file.shown)}: {place.path} {state.files.why_not(place.path)}"
        state.wrong(scope, tag, why)
        return why
    state.read.add(place.path)
    return _Source(state.files.workspace.text(place.path), place.path, lambda line: line)


def _body(tag: LaunchElement) -> _Source:
    starts = [0]
    for line in tag.text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)

    def line_of(line: int) -> int:
        offset = starts[min(line, len(starts)) - 1]
        before = [pair for pair in tag.text_lines if pair[0] <= offset] or [(0, tag.line)]
        return before[-1][1] + tag.text.count("\n", before[-1][0], offset)

    return _Source(tag.text, None, line_of)


def _load(
    state: RoslaunchState,
    scope: LoaderScope,
    tag: LaunchElement,
    conditions: tuple[Condition, ...],
    source: _Source,
    name: Text,
    substitute: bool | None,
) -> str | None:
    """Set what *source* says below *name*; the result is why that is not known."""
    path = source.path or scope.path
    if substitute is None:
        why = "<rosparam>: whether 'subst_value' holds is unknown"
        state.wrong(scope, tag, f"{why}. The tag is left out")
        return why
    document = _document(state, scope, tag, source, substitute)
    if document is None:
        return f"the YAML of <rosparam>{f' in {source.path}' if source.path else ''} cannot be read"
    state.spend(document.size)
    if document.data is None:
        return None
    if not name.raw and not isinstance(document.data, dict):
        state.wrong(scope, tag, "<rosparam> sets a single value and needs a 'param'; add it")
        return None
    full = join_in(scope.namespace, name) if name.raw else scope.namespace
    place = location(scope, tag)
    private = False
    for leaf in _unfold(state, path, source, full, document):
        private = private or leaf.name.raw.startswith("~")
        origin = Location(path, source.line(leaf.value.line))
        state.add_parameter(leaf.name, leaf_parameter(state, leaf.value, conditions, place, origin))
    if private:
        state.wrong(
            scope,
            tag,
            "<rosparam> sets names that begin with '~': they are private to roslaunch itself and no node sees them; use"
            " <param>, or a <rosparam> inside the <node> with names that do not begin with '~'",
        )
    return None


def _anything(
    state: RoslaunchState,
    scope: LoaderScope,
    tag: LaunchElement,
    conditions: tuple[Condition, ...],
    name: Text,
    why: str,
) -> None:
    """Whatever lies below *name* may be set, and what was set there before may be set anew."""
    full = join_in(scope.namespace, name) if name.raw else scope.namespace
    if full.raw.startswith("~"):
        return
    place = location(scope, tag)
    state.unsettle(full, why, place)
    unknowns = unset("value", why, place) + unset("type", why, place)
    made = Parameter(name="", type=None, value=None, conditions=conditions, location=place, unknowns=unknowns)
    below = unknown(why)
    state.add_parameter(Text(f"{full.raw.rstrip('/')}/{below.raw}", full.reasons + below.reasons), made)


def _document(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, source: _Source, substitute: bool
) -> YamlValue | None:
    """The YAML of *source*; None, with a problem, if roslaunch cannot load it."""
    cached = source.path is not None and not substitute
    if cached and source.path in state.documents:
        return state.documents[source.path or ""]
    state.spend(len(source.text) // 20)
    text = state.substituted(scope, tag, source.text) if substitute else literal(source.text)
    document = None
    try:
        document = read_yaml(text)
    except YamlError as err:
        state.problem(source.path or scope.path, source.line(err.line), f"YAML of <rosparam>: {err}")
    if cached:
        state.documents[source.path or ""] = document
    return document


def _unfold(state: RoslaunchState, path: str, source: _Source, name: Text, value: YamlValue) -> Iterator[Leaf]:
    """The leaves of *value* under *name*; maps without entries set nothing."""
    if not isinstance(value.data, dict):
        if value.data is None:
            line = source.line(value.line)
            state.problem(path, line, f"{quoted(name.shown)} has no value (null): roslaunch cannot set it; give it one")
        else:
            yield Leaf(name, value)
        return
    for key, item in value.data.items():
        part = key_text(key)
        if part is None:
            line = source.line(item.line)
            state.problem(path, line, f"YAML of <rosparam>: key {key_shown(key)} is no text; quote it. It is left out")
            continue
        yield from _unfold(state, path, source, join_in(name, part), item)


def key_text(key: object) -> Text | None:
    """A key of a map as a part of a name; None if it is no text."""
    if isinstance(key, OpaqueNode) and key.unknown is not None:
        return key.unknown
    return literal(key) if isinstance(key, str) else None


def key_shown(key: object) -> str:
    return quoted(key.shown or "?" if isinstance(key, OpaqueNode) else str(key))


def leaf_parameter(
    state: RoslaunchState, value: YamlValue, conditions: tuple[Condition, ...], place: Location, origin: Location | None
) -> Parameter:
    """The parameter that *value*, no map, makes; its name is still empty."""
    at = origin or place
    inside = parts(value)
    if any(part is None for part in inside):
        state.problem(
            at.path, at.line, "a list holds an item without a value (null): roslaunch cannot set it; give it one"
        )
    if any(isinstance(part, int) and part not in _INT32 for part in inside):
        state.problem(at.path, at.line, "an integer of more than 32 bits: roslaunch cannot set it; make it smaller")
    opaque = next((part for part in inside if isinstance(part, OpaqueNode)), None)
    if opaque is None:
        data: Any = plain(value.data)
        kind = type_of(data)
        return Parameter(name="", type=kind, value=data, conditions=conditions, location=place, origin=origin)
    whole = value.data is opaque
    kind = opaque.type if whole else "yaml"
    unknowns = unset("value", opaque.reason, at)
    if kind is None:
        unknowns += unset("type", opaque.reason, at)
    shown = opaque.shown if whole and kind == "str" else None
    return Parameter(
        name="", type=kind, value=shown, conditions=conditions, location=place, origin=origin, unknowns=unknowns
    )
