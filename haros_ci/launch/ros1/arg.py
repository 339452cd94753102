# SPDX-License-Identifier: Apache-2.0
"""``<arg>`` (wiki roslaunch/XML/arg): declared in a file, set by its value, by who includes it, or by its default."""

from __future__ import annotations

from haros_ci.launch.facts import ros1
from haros_ci.launch.ros1.scope import LoaderScope
from haros_ci.launch.ros1.state import RoslaunchState, unknown_condition
from haros_ci.model.architecture import Condition
from haros_ci.model.launch import LaunchElement
from haros_ci.substitutions.names import Text, quoted, unknown

ATTRIBUTES = ("name", "value", "default", "doc")


def arg(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]) -> None:
    """Declare the arg of *tag* in *scope*. Under an undecided condition its value is unknown, unless it is the same."""
    provided = _attributes(state, scope, tag)
    if provided is None:
        return
    name, value, default = provided
    ros1.declared(state, scope, tag, name)
    undecided = len(conditions) > len(scope.conditions)
    if name in scope.declared:
        if not undecided and name not in scope.doubtful and not scope.overrides_allowed:
            first = scope.declared[name]
            state.wrong(scope, tag, f"argument {quoted(name)} is already declared on line {first}; remove one")
            return
    else:
        scope.declared[name] = tag.line
    if undecided:
        _set_perhaps(scope, name, value, default, unknown_condition(conditions))
    elif value is not None:
        if name in scope.args and not scope.overrides_allowed and name not in scope.doubtful:
            state.wrong(
                scope,
                tag,
                f"argument {quoted(name)} has a fixed value here, but is also set from outside; write 'default' instead"
                " of 'value', or do not set it",
            )
            return
        scope.args[name] = _doubtful(scope, name, value)
    elif default is not None and name not in scope.args:
        scope.args[name] = default
    elif default is not None and name in scope.doubtful:
        scope.args[name] = _doubtful(scope, name, default)
    elif name not in scope.args:
        scope.missing[name] = tag.line
    if name in scope.args:
        scope.missing.pop(name, None)


def passed_arg(
    state: RoslaunchState,
    scope: LoaderScope,
    tag: LaunchElement,
    conditions: tuple[Condition, ...],
    passed: dict[str, Text],
) -> str | None:
    """Put the arg of *tag*, a child of an ``<include>``, into *passed*, and return its name; None if it is refused."""
    provided = _attributes(state, scope, tag)
    if provided is None:
        return None
    name, value, default = provided
    if value is None and default is None:
        state.wrong(scope, tag, f"argument {quoted(name)} is passed without a value; add one")
        return None
    made = value if value is not None else passed.get(name, default)
    if len(conditions) > len(scope.conditions) and passed.get(name) != made:
        made = unknown(f"whether {quoted(name)} is passed: {unknown_condition(conditions)}")
    if made is not None:
        passed[name] = made
    return name


def _attributes(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement
) -> tuple[str, Text | None, Text | None] | None:
    state.check_attributes(scope, tag, ATTRIBUTES)
    names = state.required(scope, tag, "name")
    value, default = (state.attribute(scope, tag, attribute) for attribute in ("value", "default"))
    if names is None:
        return None
    if not names[0].known:
        state.wrong(scope, tag, f"the name of an <arg> is unknown: {names[0].reasons[0]}. The tag is left out")
        return None
    name = names[0].raw
    if value is not None and default is not None:
        state.wrong(scope, tag, f"argument {quoted(name)} has both 'value' and 'default'; keep one. It is left out")
        return None
    return name, value, default


def _set_perhaps(scope: LoaderScope, name: str, value: Text | None, default: Text | None, why: str) -> None:
    made = value if value is not None else default
    if made is None:
        if name not in scope.args:
            scope.missing[name] = scope.declared[name]
        return
    if name in scope.args and name not in scope.doubtful and value is None:
        return
    if scope.args.get(name) != made or name not in scope.args:
        scope.args[name] = unknown(f"which value argument {quoted(name)} has: {why}")
    scope.doubtful.add(name)


def _doubtful(scope: LoaderScope, name: str, made: Text) -> Text:
    """*made*, unless an undecided tag may have set the arg to something else before."""
    before = scope.args.get(name)
    if name not in scope.doubtful or before is None or before == made:
        return made
    return before if not before.known else unknown(f"which value argument {quoted(name)} has is undecided")
