# SPDX-License-Identifier: Apache-2.0
"""``<param>`` (wiki roslaunch/XML/param): one parameter, from a value, a file or a command."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import replace

from haros_ci.launch.facts import ros1
from haros_ci.launch.ros1.rosparam import key_shown, key_text, leaf_parameter
from haros_ci.launch.ros1.scope import LoaderScope, Private, location
from haros_ci.launch.ros1.state import RoslaunchState, unset
from haros_ci.model.architecture import Condition, Parameter
from haros_ci.model.launch import LaunchElement
from haros_ci.records import dataclass
from haros_ci.substitutions.names import MARK, Text, is_private, join_in, literal, quoted
from haros_ci.substitutions.types import TYPES, convert, type_of
from haros_ci.substitutions.yaml import YamlError, YamlValue, read_yaml

ATTRIBUTES = ("name", "value", "type", "textfile", "binfile", "command")
_SOURCES = ("value", "textfile", "binfile", "command")


@dataclass(frozen=True, slots=True)
class Named:
    """A parameter and its name as written; a map of ``type="yaml"`` makes several."""

    name: Text
    parameter: Parameter


def scope_param(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]
) -> None:
    """A ``<param>`` outside a node: ``~name`` is for the nodes declared after it, others are set in the namespace."""
    for named in params(state, scope, tag, conditions):
        if not is_private(named.name.raw):
            state.add_parameter(join_in(scope.namespace, named.name), named.parameter)
            continue
        overridden = set(conditions)
        state.spend(len(scope.privates) // 4)
        scope.privates[:] = [
            private
            for private in scope.privates
            if private.name.raw != named.name.raw or not overridden <= set(private.parameter.conditions)
        ]
        scope.privates.append(Private(named.name, replace(named.parameter, presence=scope.presence)))


def params(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]
) -> Iterator[Named]:
    """What the ``<param>`` *tag* sets; nothing, with a problem, if roslaunch refuses it."""
    state.check_attributes(scope, tag, ATTRIBUTES)
    names = state.required(scope, tag, "name")
    provided = [name for name in _SOURCES if tag.get(name) is not None]
    kind = (tag.get("type") or "auto").lower().strip()
    if names is None:
        return
    name = names[0].stripped()
    place = location(scope, tag)
    if not name.raw:
        state.wrong(scope, tag, "<param> has an empty name; give it one. The tag is left out")
    elif len(provided) != 1:
        state.wrong(scope, tag, f"<param name={quoted(name.shown)}> needs one of {', '.join(_SOURCES)}, and only one")
    elif kind not in TYPES:
        allowed = ", ".join(TYPES)
        state.wrong(scope, tag, f"<param name={quoted(name.shown)} type={quoted(kind)}>: write one of {allowed}")
    else:
        blank = Parameter(name="", type=TYPES[kind], value=None, conditions=conditions, location=place)
        text = state.attribute(scope, tag, provided[0]) or Text("")
        if provided[0] == "value":
            yield from _converted(state, scope, tag, name, text.stripped(), kind, blank)
        elif provided[0] == "textfile":
            yield from _textfile(state, scope, tag, name, text, kind, blank)
        elif provided[0] == "binfile":
            reason = f"binary content (base64) of {quoted(text.shown)}, which is none of the plain types"
            unknowns = unset("value", reason, place) + unset("type", reason, place)
            yield Named(name, replace(blank, type=None, unknowns=unknowns))
        else:
            ros1.command(state, scope, tag, text)
            yield Named(name, _of_command(text, kind, blank))


def _converted(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, name: Text, text: Text, kind: str, blank: Parameter
) -> Iterator[Named]:
    place = location(scope, tag)
    if kind == "yaml":
        yield from _yaml(state, scope, tag, name, text, blank)
        return
    if not text.known:
        is_text = blank.type == "str" or (kind == "auto" and "/" in text.raw)
        unknowns = text.unknown("value", place)
        if is_text:
            yield Named(name, replace(blank, type="str", value=text.shown, unknowns=unknowns))
        else:
            unknowns += text.unknown("type", place) if blank.type is None else ()
            yield Named(name, replace(blank, unknowns=unknowns))
        return
    try:
        value = convert(text.raw, "str" if kind == "string" else "bool" if kind == "boolean" else kind)
    except ValueError:
        state.wrong(scope, tag, f"<param name={quoted(name.shown)}>: {quoted(text.raw)} is no {kind}; correct it")
        return
    parameter = leaf_parameter(state, YamlValue(tag.line, value), blank.conditions, place, None)
    yield Named(name, replace(parameter, type=type_of(value)))


def _yaml(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, name: Text, text: Text, blank: Parameter
) -> Iterator[Named]:
    """A map becomes its leaves, as the parameter server keeps it; one without entries is set as such."""
    state.spend(len(text.raw) // 20)
    try:
        document = read_yaml(text)
    except YamlError as err:
        state.wrong(scope, tag, f"<param name={quoted(name.shown)}>: {err}")
        return
    state.spend(document.size)
    todo = [(name, document)]
    while todo:
        here, value = todo.pop()
        if value.data is None:
            state.wrong(scope, tag, f"{quoted(here.shown)} has no value (null): roslaunch cannot set it; give it one")
            continue
        if not isinstance(value.data, dict) or not value.data:
            parameter = leaf_parameter(state, value, blank.conditions, location(scope, tag), None)
            yield Named(here, parameter)
            continue
        inner: list[tuple[Text, YamlValue]] = []
        for key, item in value.data.items():
            part = key_text(key)
            if part is None or part.raw.startswith(("/", "~", MARK)):
                state.wrong(
                    scope,
                    tag,
                    f"{quoted(here.shown)}: no node can read the key {key_shown(key)} of a map in a"
                    " <param>; keys are texts without a leading / or ~, or use <rosparam>",
                )
                continue
            inner.append((Text(f"{here.raw}/{part.raw}", here.reasons + part.reasons), item))
        todo.extend(reversed(inner))


def _textfile(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, name: Text, file: Text, kind: str, blank: Parameter
) -> Iterator[Named]:
    place = state.files.place(file)
    if place.path is not None and state.files.has(place.path):
        state.read.add(place.path)
        content = state.files.workspace.text(place.path).replace("\r\n", "\n")
        state.spend(len(content) // 20)
        yield from _converted(state, scope, tag, name, literal(content), kind, blank)
        return
    reason = place.reason or f"{place.path} {state.files.why_not(place.path or '')}"
    if not place.outside and file.known:
        state.wrong(scope, tag, f"<param name={quoted(name.shown)} textfile={quoted(file.shown)}>: {reason}")
    unknowns = unset("value", f"text of {quoted(file.shown)}: {reason}", location(scope, tag))
    if blank.type is None:
        unknowns += unset("type", f"text of {quoted(file.shown)}: {reason}", location(scope, tag))
    yield Named(name, replace(blank, unknowns=unknowns))


def _of_command(text: Text, kind: str, blank: Parameter) -> Parameter:
    """The value is what a command prints, and none is run here; what xacro prints is XML."""
    at = blank.location
    assert at is not None
    blank = replace(blank, command=text.shown)
    file = _xacro_file(text.shown)
    if file is not None and kind == "auto":
        return replace(blank, type="str", unknowns=unset("value", f"xacro makes it of {quoted(file)}", at))
    unknowns = unset("value", f"printed by the command {quoted(text.shown)}", at)
    if blank.type is None:
        unknowns += unset("type", f"printed by the command {quoted(text.shown)}", at)
    return replace(blank, unknowns=unknowns)


def _xacro_file(command: str) -> str | None:
    """The file that *command* gives to xacro; None if it is another command."""
    try:
        words = shlex.split(command.replace("$(find ", f"$(find{MARK}"))
    except ValueError:
        return None
    words = [word.replace(MARK, " ") for word in words]
    if words and words[0].rpartition("/")[2].startswith("python"):
        words = words[1:]
    if not words or words[0].rpartition("/")[2] not in ("xacro", "xacro.py"):
        return None
    files = [word for word in words[1:] if not word.startswith("-") and ":=" not in word]
    return files[0] if files else None
