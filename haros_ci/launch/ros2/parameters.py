# SPDX-License-Identifier: Apache-2.0
"""The parameters that a launch description gives to one node, in the order in which launch_ros passes them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from haros_ci.bounded_yaml import YamlFault
from haros_ci.launch.ros2.context import Context, GlobalParameter
from haros_ci.launch.ros2.parameter_files import Component, file_rules, missing, tree_value
from haros_ci.launch.ros2.parameter_yaml import Items, Map, dumped, rcl_value, read_trees
from haros_ci.model.architecture import Unknown
from haros_ci.model.launch import ParameterRule
from haros_ci.model.launch_actions import ParameterSource, Substitution
from haros_ci.model.location import Location
from haros_ci.substitutions.names import Text, literal, quoted

_TYPES = {"bool": "bool", "int": "int", "float": "double", "str": "str", "bytes": "bytes"}
_LISTS = {f"{name}_array": f"{kind}[]" for name, kind in _TYPES.items()}


def node_rules(
    context: Context, sources: Iterable[ParameterSource], component: Component | None = None, name: str = "/**"
) -> tuple[ParameterRule, ...]:
    """What is set for all nodes, then the node's own *sources* (launch_ros ``Node``, ``LoadComposableNodes``).

    *name* is the key that a dictionary is written under: the full name where launch knows it, else ``/**``.
    """
    found: list[ParameterRule] = []
    for parameter in context.scope.parameters or ():
        found.extend(_global_rules(context, parameter, component))
    for source in sources:
        found.extend(source_rules(context, source, component, name))
    return tuple(found)


def _global_rules(context: Context, parameter: GlobalParameter, component: Component | None) -> Iterable[ParameterRule]:
    if parameter.path is not None:
        location = next((s.location for s in parameter.action.parameters), parameter.action.location)
        rules: Iterable[ParameterRule] = file_rules(context, parameter.path, False, location, component)
    else:
        rules = [
            _rule(name, _argument(made) if component is None else made, source.location, component is None)
            for source in parameter.action.parameters
            for name, made in values_of(parameter.values, source)
        ]
    if not parameter.conditions and not parameter.presence:
        return rules
    return [replace(rule, conditions=parameter.conditions, presence=parameter.presence) for rule in rules]


def _argument(made: tuple[str | None, Any, str]) -> tuple[str | None, Any, str]:
    """A text as ``-p name:=text`` gives it, without quotes: it may be a number or a truth to the node."""
    _, value, reason = made
    if reason or not isinstance(value, str) or not value:
        return made
    try:
        trees = read_trees(literal(value))
    except YamlFault:
        return made
    return tree_value(trees[0], False) if len(trees) == 1 and not isinstance(trees[0], Map) else made


def source_rules(
    context: Context, source: ParameterSource, component: Component | None, node: str = "/**"
) -> Iterable[ParameterRule]:
    """The rules of one source; those of a dictionary are for *node*."""
    if source.kind == "file":
        return file_rules(context, context.text(source.path), source.substitutes, source.location, component)
    if source.kind != "values":
        return (missing(source.reason or "the parameters are not known", source.location),)
    return [
        _rule(name, made, source.location, component is None, "/**" if source.argument else node)
        for name, made in values_of(performed_values(context, source), source)
    ]


def performed_values(context: Context, source: ParameterSource) -> tuple[tuple[Text, Any], ...]:
    """Names and values with their substitutions performed: a text, plain data or a list of such."""
    return tuple((context.text(name), _performed(context, value)) for name, value in source.values)


def _performed(context: Context, value: Any) -> Any:
    context.spend(1)
    if isinstance(value, tuple) and all(isinstance(part, (str, Substitution)) for part in value):
        return context.text(value)
    if isinstance(value, (list, tuple)):
        return [_performed(context, item) for item in value]
    return value


def values_of(values: tuple[tuple[Text, Any], ...], source: ParameterSource) -> Iterable[tuple[Text, Any]]:
    """Dotted names and (type, value, reason) of *values*; maps are unfolded."""
    types: Mapping[str, str] = dict(source.types)
    for name, value in values:
        if isinstance(value, Mapping):
            inner = tuple((_dotted(name, str(key)), item) for key, item in value.items())
            yield from values_of(inner, source)
        else:
            yield name, typed_value(value, types.get(name.shown))


def _dotted(name: Text, key: str) -> Text:
    return Text(f"{name.raw}.{literal(key).raw}", name.reasons)


def typed_value(value: Any, kind: str | None) -> tuple[str | None, Any, str]:
    """Type, value and, where it is not known, the reason, of a value given in a launch file.

    A text made of substitutions is read as YAML by PyYAML unless *kind* says what it is; plain data stays as it is.
    """
    if isinstance(value, Text):
        return _text_value(value, kind)
    if isinstance(value, list):
        return _list_value(value, kind)
    if isinstance(value, bool) or value is None:
        return ("bool", value, "") if value is not None else (None, None, "it has no value (None)")
    if isinstance(value, (int, float)):
        if kind == "str":
            return "str", str(value), ""
        return tree_value(dumped(float(value) if kind == "float" else value, 1), True)
    if isinstance(value, str):
        return "str", value, ""
    return None, None, "it is no value that a parameter can have"


def _text_value(text: Text, kind: str | None) -> tuple[str | None, Any, str]:
    typed = _TYPES.get(kind or "") or _LISTS.get(kind or "")
    if not text.known:
        return typed, None, "; ".join(dict.fromkeys(text.reasons))
    if kind == "str":
        return "str", text.raw, ""
    if kind in ("int", "float"):
        try:
            number = int(text.raw) if kind == "int" else float(text.raw)
        except ValueError:
            return typed, None, f"{quoted(text.raw)} is no {kind}"
        return tree_value(dumped(number, 1), True)
    if not text.raw:
        return "str", "", ""
    if kind == "bool" and text.raw in ("0", "1"):
        return "bool", text.raw == "1", ""
    try:
        trees = read_trees(text)
    except YamlFault:
        return typed, None, f"{quoted(text.raw)} is not valid YAML; give the value's type if it is text"
    if len(trees) != 1:
        return typed, None, f"{quoted(text.raw)} is no single value"
    made = tree_value(trees[0], True)
    if typed is not None and not made[2] and made[0] != typed:
        return typed, None, f"{quoted(text.raw)} is no {kind}"
    return made


def _list_value(values: list[Any], kind: str | None) -> tuple[str | None, Any, str]:
    single = kind.removesuffix("_array") if kind is not None else None
    if not values:
        return _LISTS.get(kind or ""), [], "" if kind in _LISTS else "an empty list has no type"
    made = [typed_value(value, single) for value in values]
    if any(isinstance(value, list) for value in values):
        return None, None, "a list of lists is no parameter value"
    kinds = {one for one, _, _ in made}
    if kinds == {"int", "double"}:
        made = [("double", None if value is None else float(value), reason) for _, value, reason in made]
        kinds = {"double"}
    reason = next((reason for _, _, reason in made if reason), "")
    if len(kinds) > 1 and None not in kinds:
        return None, None, f"the list mixes {', '.join(sorted(one for one in kinds if one))}"
    one = next(iter(kinds)) if len(kinds) == 1 else None
    typed = None if one is None else f"{one}[]"
    return (typed, None, reason) if reason else (typed, [value for _, value, _ in made], "")


def _rule(
    name: Text, made: tuple[str | None, Any, str], location: Location, is_process: bool, node: str = "/**"
) -> ParameterRule:
    """A value for the node of the process; there it goes through a file that PyYAML writes and rcl reads."""
    kind, value, reason = made
    if is_process and not reason and isinstance(value, str):
        kind, value, reason = rcl_value(dumped(value, 1))
    if is_process and not reason and kind == "str[]" and any(rcl_value(dumped(v, 1))[0] != "str" for v in value):
        kind, value, reason = tree_value(Items([dumped(item, 1) for item in value], 1), False)
    unknowns: tuple[Unknown, ...] = ()
    if not name.known:
        unknowns += (Unknown("name", "; ".join(dict.fromkeys(name.reasons)), location),)
    if reason:
        unknowns += (Unknown("value", reason, location),)
        unknowns += (Unknown("type", reason, location),) if kind is None else ()
    return ParameterRule(node=node, name=name.shown, type=kind, value=value, location=location, unknowns=unknowns)
