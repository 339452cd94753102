# SPDX-License-Identifier: Apache-2.0
"""``<node>``, ``<test>`` and ``<machine>`` (wiki roslaunch/XML/node, rostest, roslaunch/XML/machine)."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from haros_ci.graph.remap_rules import written_rule
from haros_ci.graph.words import scalar, split
from haros_ci.launch.facts import ros1
from haros_ci.launch.ros1.param import Named, params
from haros_ci.launch.ros1.presence import assume, held
from haros_ci.launch.ros1.rosparam import rosparam
from haros_ci.launch.ros1.scope import LoaderScope, Remap, location
from haros_ci.launch.ros1.state import RoslaunchState, check_clear_params, inner_namespace, unknown_condition, unset
from haros_ci.model.architecture import Condition, Parameter, Unknown
from haros_ci.model.launch import LaunchElement, Started
from haros_ci.substitutions.names import MARK, Text, canonical, is_legal, is_private, literal, quoted, unknown
from haros_ci.substitutions.types import type_of

_OPTIONS = ("machine", "args", "output", "respawn", "respawn_delay", "cwd", "launch-prefix", "required")
NODE_ATTRIBUTES = ("pkg", "type", "name", "ns", "clear_params", *_OPTIONS)
TEST_ATTRIBUTES = (*NODE_ATTRIBUTES, "test-name", "time-limit", "retry")
MACHINE_ATTRIBUTES = ("name", "address", "env-loader", "ssh-port", "user", "password", "default", "timeout")


def node(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]) -> None:
    """Add the node of *tag* and its parameters; nothing, with a problem, if roslaunch refuses the tag.

    The order is roslaunch's: the node's ``<rosparam>``, then ``~`` params of the scope, then its own ``<param>``.
    """
    is_test = tag.tag == "test"
    state.check_attributes(scope, tag, TEST_ATTRIBUTES if is_test else NODE_ATTRIBUTES)
    needed = state.required(scope, tag, *(("test-name",) if is_test else ("name",)), "pkg", "type")
    if needed is None or not check_clear_params(state, scope, tag):
        return
    name, package, type_ = needed
    if is_test:
        name = state.attribute(scope, tag, "name") or name
    namespace = inner_namespace(state, scope, tag)
    if namespace is None or not _accepted(state, scope, tag, name, package, type_):
        return
    if not is_legal(name.raw):
        state.wrong(scope, tag, f"{quoted(name.shown)} is no legal node name; use letters, digits and _")
    options = {option: state.attribute(scope, tag, option) or literal("") for option in _OPTIONS}
    if not _options_accepted(state, scope, tag, options):
        return
    state.spend(25 + len(scope.args) // 2)
    own = replace(scope.child(namespace, conditions), is_shared=False)
    full = Text(canonical(f"{namespace.raw}/{name.raw}"), namespace.reasons + name.reasons)
    inner = scope.child(full, conditions)
    outer = scope.child(scope.namespace, conditions)
    named: list[Named] = []
    with state.in_tag() as mine:
        for child in tag.children:
            state.spend(5)
            kind = child.tag.lower()
            if kind not in ("remap", "param", "rosparam", "env"):
                state.wrong(scope, child, f"<{child.tag}> cannot stand in <{tag.tag}>; remove it")
                ros1.ignored(state, scope, child, tag.tag)
                continue
            under = state.conditions(outer, child)
            if under is None:
                if kind in ("rosparam", "param"):
                    assume(state, outer, child, partial(_own_parameter, state, inner, full, child))
                continue
            with held(state, outer, child):
                if kind == "remap":
                    remap(state, own, child, under)
                elif kind == "env":
                    environment(state, own, child, under)
                elif kind == "rosparam":
                    rosparam(state, inner, child, under)
                else:
                    made = params(state, outer, child, under)
                    named.extend(Named(m.name, replace(m.parameter, presence=state.presence)) for m in made)
        for private in scope.privates:
            merged = _merged(private.parameter.conditions, conditions)
            named_private = replace(private.parameter, conditions=merged)
            state.add_parameter(_private_name(full, private.name), named_private)
        for entry in named:
            state.add_parameter(_private_name(full, entry.name), entry.parameter)
        _arguments(state, scope, tag, full, options["args"], conditions)
    state.spend(len(own.remaps) // 4 + len(own.environment) // 4)
    _check_duplicate(state, scope, tag, full, conditions)
    started = _started(scope, tag, full, namespace, package, type_, options, own)
    state.nodes.append(started if full.known else replace(started, own=tuple(mine)))
    ros1.started(state, scope, state.nodes[-1])


def _own_parameter(
    state: RoslaunchState, inner: LoaderScope, full: Text, child: LaunchElement, outer: LoaderScope
) -> None:
    """The ``<param>`` or ``<rosparam>`` *child* of the node *full* by itself."""
    if child.tag.lower() == "rosparam":
        rosparam(state, inner, child, outer.conditions)
        return
    for entry in params(state, outer, child, outer.conditions):
        state.add_parameter(_private_name(full, entry.name), entry.parameter)


def _arguments(
    state: RoslaunchState,
    scope: LoaderScope,
    tag: LaunchElement,
    full: Text,
    args: Text,
    conditions: tuple[Condition, ...],
) -> None:
    """``_name:=value`` among a node's arguments: it sets that private parameter when it starts."""
    if "_" not in args.raw:
        return
    place = location(scope, tag)
    reason = "; ".join(dict.fromkeys(args.reasons))
    for name, text in split(args.raw).private:
        if MARK in name:
            continue
        state.spend(2)
        value = None if MARK in text else scalar(text)
        unknowns = unset("value", reason, place) + unset("type", reason, place) if value is None else ()
        kind = None if value is None else type_of(value)
        made = Parameter(name="", type=kind, value=value, conditions=conditions, location=place, unknowns=unknowns)
        state.add_parameter(_private_name(full, literal(name)), made)


def remap(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]) -> None:
    """Add a remap to *scope*; under an undecided condition its target is unknown, unless it changes nothing."""
    state.check_attributes(scope, tag, ("from", "to"))
    pair = state.required(scope, tag, "from", "to")
    if pair is None:
        return
    source, target = (Text(canonical(text.raw), text.reasons) for text in pair)
    for text in (source, target):
        if not text.raw or not is_legal(text.raw):
            message = f"{quoted(text.raw)} is no legal name" if text.raw else "'from' and 'to' cannot be empty"
            state.wrong(scope, tag, f"<remap>: {message}; correct it. The tag is left out")
            return
    undecided = conditions[len(scope.conditions) :]
    rule = written_rule(
        source.shown, target.shown, location(scope, tag), conditions=undecided, is_global=scope.is_shared
    )
    if undecided:
        old = next((remap.target.raw for remap in scope.remaps if remap.source.raw == source.raw), source.raw)
        if target.known and old == target.raw:
            return
        shown = f"whether {quoted(source.shown)} is remapped to {quoted(target.shown)}: "
        target = unknown(shown + unknown_condition(conditions))
    state.spend(len(scope.remaps) // 10)
    scope.add_remap(Remap(source, target, location(scope, tag), rule))


def environment(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]
) -> None:
    """Add an environment variable to the nodes of *scope*."""
    state.check_attributes(scope, tag, ("name", "value"))
    pair = state.required(scope, tag, "name", "value")
    if pair is None:
        return
    name, value = pair
    if not name.raw:
        state.wrong(scope, tag, "<env> has an empty name; give it one. The tag is left out")
        return
    if len(conditions) > len(scope.conditions):
        value = unknown(f"whether {quoted(name.shown)} is set: {unknown_condition(conditions)}")
    state.spend(len(scope.environment) // 10)
    scope.environment = (*scope.environment, (name, value))


def machine(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]) -> None:
    """Declare a machine that nodes may name."""
    state.check_attributes(scope, tag, MACHINE_ATTRIBUTES)
    needed = state.required(scope, tag, "name", "address")
    provided = {name: state.attribute(scope, tag, name) for name in MACHINE_ATTRIBUTES}
    for child in tag.children:
        state.wrong(scope, child, f"<{child.tag}> cannot stand in <machine>; remove it")
        ros1.ignored(state, scope, child, "machine")
    if needed is None:
        return
    default = provided["default"]
    if default is not None and default.known and default.raw.lower() not in ("", "true", "false", "never"):
        state.wrong(scope, tag, f"<machine default={quoted(default.raw)}>: write true, false or never")
    for name, whole in (("timeout", False), ("ssh-port", True)):
        _check_number(state, scope, tag, name, provided[name], whole=whole)
    shown = tuple(text.shown if text is not None else None for key, text in provided.items() if key != "default")
    name = needed[0].shown
    if needed[0].known and state.machines.setdefault(name, shown) != shown and not conditions:
        state.wrong(scope, tag, f"machine {quoted(name)} is declared twice, in different ways; keep one")


def _accepted(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, name: Text, package: Text, type_: Text
) -> bool:
    if "/" in name.raw:
        state.wrong(scope, tag, f"node name {quoted(name.shown)} holds a namespace; use ns=... The tag is left out")
        return False
    for label, text in (("name", name), ("pkg", package), ("type", type_)):
        if not text.raw.strip():
            state.wrong(scope, tag, f"<{tag.tag}> has an empty {label!r}; fill it in. The tag is left out")
            return False
    if tag.tag != "test":
        return True
    for label in ("respawn", "respawn_delay", "output"):
        if tag.get(label) is not None:
            state.wrong(scope, tag, f"<test> takes no {label!r}; remove it. The tag is left out")
            return False
    for label, whole in (("time-limit", False), ("retry", True)):
        _check_number(state, scope, tag, label, state.attribute(scope, tag, label), whole=whole)
    return True


def _options_accepted(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, options: dict[str, Text]) -> bool:
    if tag.tag == "node":
        respawn, required = (state.truth(scope, tag, name) for name in ("respawn", "required"))
        if respawn and required:
            state.wrong(scope, tag, "<node> cannot be both respawn and required; keep one. The tag is left out")
            return False
    _check_number(state, scope, tag, "respawn_delay", options["respawn_delay"], whole=False, positive=False)
    for label, allowed in (("output", ("log", "screen")), ("cwd", ("ROS_HOME", "node", "ros_home"))):
        text = options[label]
        if tag.get(label) is not None and text.known and text.raw not in allowed:
            choice = " or ".join(allowed[:2])
            state.wrong(scope, tag, f"<{tag.tag} {label}={quoted(text.raw)}>: write {choice}. The tag is left out")
            return False
    return True


def _check_number(
    state: RoslaunchState,
    scope: LoaderScope,
    tag: LaunchElement,
    label: str,
    text: Text | None,
    *,
    whole: bool,
    positive: bool = True,
) -> None:
    if text is None or not text.known or (not text.raw and tag.get(label) is None) or (whole and not text.raw):
        return
    try:
        number = int(text.raw[:100]) if whole else float(text.raw[:100])
    except ValueError:
        state.wrong(scope, tag, f"<{tag.tag} {label}={quoted(text.raw)}> is no number; correct it")
        return
    if positive and not whole and number <= 0:
        state.wrong(scope, tag, f"<{tag.tag} {label}={quoted(text.raw)}> must be more than 0; correct it")


def _private_name(node_name: Text, name: Text) -> Text:
    """*name* below the node; in a node ``~x``, ``/x`` and ``x`` are the same, as in roslaunch."""
    bare = name.raw[1:] if is_private(name.raw) else name.raw
    return Text(canonical(f"{node_name.raw}/{bare}"), node_name.reasons + name.reasons)


def _merged(first: tuple[Condition, ...], second: tuple[Condition, ...]) -> tuple[Condition, ...]:
    return (*second, *(condition for condition in first if condition not in second))


def _check_duplicate(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, full: Text, conditions: tuple[Condition, ...]
) -> None:
    """roslaunch refuses a second node of one name; under differing conditions they may exclude each other."""
    if tag.tag == "test" or not full.known:
        return
    key = (full.raw, conditions)
    first = state.names.get(key)
    if first is None:
        state.names[key] = location(scope, tag)
        return
    where = f"{first.path}:{first.line}"
    state.wrong(scope, tag, f"a node named {quoted(full.raw)} is already at {where}; rename one of them")


def _started(
    scope: LoaderScope,
    tag: LaunchElement,
    full: Text,
    namespace: Text,
    package: Text,
    type_: Text,
    options: dict[str, Text],
    own: LoaderScope,
) -> Started:
    place = location(scope, tag)
    fields = {
        "name": full,
        "package": package,
        "type": type_,
        "arguments": options["args"],
        "machine": options["machine"],
        "launch_prefix": options["launch-prefix"],
    }
    unknowns: list[Unknown] = [entry for key, text in fields.items() for entry in text.unknown(key, place)]
    for entry in own.remaps:
        both = Text("", entry.source.reasons + entry.target.reasons)
        unknowns.extend(both.unknown("remaps", entry.location))
    for name, value in own.environment:
        unknowns.extend(Text("", name.reasons + value.reasons).unknown("environment", place))
    return Started(
        name=full.shown,
        namespace=namespace.shown,
        package=package.shown,
        type=type_.shown,
        location=place,
        arguments=options["args"].shown,
        remaps=tuple((entry.source.shown, entry.target.shown, entry.location) for entry in own.remaps),
        rules=tuple(entry.rule for entry in own.remaps),
        conditions=own.conditions,
        presence=own.presence,
        environment=tuple((name.shown, value.shown) for name, value in own.environment),
        machine=options["machine"].shown or None,
        is_test=tag.tag == "test",
        respawn=options["respawn"].raw.lower() == "true",
        required=options["required"].raw.lower() == "true",
        launch_prefix=options["launch-prefix"].shown,
        unknowns=tuple(unknowns),
    )
