# SPDX-License-Identifier: Apache-2.0
"""ROS 2 parameter files: ``node: {ros__parameters: ...}`` unfolded into rules for the nodes that they name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

from haros_ci.bounded_yaml import YamlFault
from haros_ci.launch.facts import ros2
from haros_ci.launch.facts.sections import sections_of
from haros_ci.launch.ros2.context import Context, LaunchBudgetExhausted
from haros_ci.launch.ros2.parameter_yaml import (
    Items,
    Map,
    Scalar,
    Tree,
    python_value,
    rcl_value,
    read_trees,
    size_of,
)
from haros_ci.launch.ros2.places import Places
from haros_ci.launch.ros2.refused_values import refused_in
from haros_ci.launch.ros2.rewritten import rewrite, rewritten_names
from haros_ci.launch.ros2.substitutions import perform
from haros_ci.model.architecture import Unknown
from haros_ci.model.launch import ParameterRule
from haros_ci.model.launch_phrases import read_phrase
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.substitutions.names import MARK, Text, literal, quoted

SECTION = "ros__parameters"


class _Missing(Exception):
    """The file is not known, or no parameter file."""


@dataclass(frozen=True, slots=True)
class Component:
    """Whose parameters launch itself picks from the file (``to_parameters_list``): a composable node's full *name*."""

    name: str


def file_rules(
    context: Context, path: Text, substitutes: bool, location: Location, component: Component | None = None
) -> tuple[ParameterRule, ...]:
    """The parameters that the file at *path* gives; of a *component* those that launch sends to it.

    A file that is not known is one rule with the name ``?``. Each rule has the line of YAML as origin.
    """
    own = context.places.written.get((path.raw, path.reasons))
    if own is not None:
        return _of_written(context, own, path, location, component)
    is_as_written = component is None and path.raw not in context.rewritten
    try:
        file, trees = _trees(context, path, substitutes, location, 0)
    except _Missing as err:
        there = context.places.read(path.raw)[0] if path.known and is_as_written else None
        refused = refused_in(context.places, there) if there is not None else None
        ros2.parameter_file(context, path, location, None, None, substitutes, refused)
        return (missing(str(err), location),)
    patterns = sections_of(context.places, file, trees, component.name if component is not None else None)
    refused = refused_in(context.places, file) if is_as_written else None
    ros2.parameter_file(context, path, location, file, patterns, refused=refused)
    key = ("rules", id(trees), file, location, component)
    if key in context.places.made:
        found, leaves = context.places.made[key][1]
        context.spend(leaves)
    else:
        found, leaves = _rules(context, trees, file, location, component)
        context.places.made[key] = (trees, (found, leaves))
    rules: tuple[ParameterRule, ...] = found
    return rules


def _of_written(
    context: Context, own: tuple[Text | str, Location], path: Text, location: Location, component: Component | None
) -> tuple[ParameterRule, ...]:
    """The parameters of a file that a launch file makes itself; they stand where it writes it."""
    ros2.parameter_file(context, path, location, None, None)
    content, place = own
    if isinstance(content, str):
        return (missing(f"a parameter file that the launch file writes: {content}", location),)
    try:
        trees = read_trees(content)
    except YamlFault as err:
        return (missing(f"a parameter file that the launch file writes: {err}", location),)
    rules, _ = _rules(context, trees, place.path, location, component)
    return tuple(replace(rule, origin=place) if rule.origin is not None else rule for rule in rules)


def _rules(
    context: Context, trees: tuple[Tree, ...], file: str, location: Location, component: Component | None
) -> tuple[tuple[ParameterRule, ...], int]:
    """The parameters that the documents of a file give, and the steps that it took to read them."""
    found: list[ParameterRule] = []
    before = context.steps
    for tree in trees:
        sections, reason = _for_nodes(tree) if component is None else _for_component(tree, component)
        if reason:
            found.append(missing(f"in {file} {reason}", location))
        for pattern, leaves in sections:
            for name, value in _leaves(leaves, ""):
                context.spend(1)
                found.append(_rule(pattern, name, value, location, file, component is not None))
    return tuple(found), before - context.steps


def parameter_file(places: Places, path: str, location: Location) -> tuple[ParameterRule, ...]:
    """``file_rules`` of the file at *path*, as arguments that a launch file performs have it."""
    try:
        return file_rules(Context(places, {}), literal(path), False, location)
    except LaunchBudgetExhausted:
        return (missing(f"parameter file {quoted(path)}: it is too large", location),)


def values_in(text: str, path: str) -> tuple[ParameterRule, ...]:
    """What the parameter file with *text* gives as it stands, no substitution performed; () if it is not YAML."""
    try:
        trees = read_trees(literal(text))
    except YamlFault:
        return ()
    place = Location(path)
    return tuple(
        _rule(pattern, name, value, place, path, False)
        for tree in trees
        for pattern, leaves in _for_nodes(tree)[0]
        for name, value in _leaves(leaves, "")
    )


def _for_nodes(tree: Tree) -> tuple[list[tuple[str, Tree]], str]:
    """The sections under their keys as rcl joins them; ``n`` and ``/n`` are two, though both are for one node."""
    found: list[tuple[str, Tree]] = []
    reason = ""
    for keys, leaves in _below(tree, ()):
        joined = ""
        for key in keys:
            joined += key if not joined or joined.endswith("/") else f"/{key}"
        if MARK in joined:
            reason = "it is not known which nodes a section is for"
        else:
            found.append((joined, leaves))
    return found, reason


def _for_component(tree: Tree, component: Component) -> tuple[list[tuple[str, Tree]], str]:
    """What launch sends to a component: ``/**``, with the component's own section over it, key by key at the top.

    A file without sections is sent as a whole; of several sources the later counts, whatever its section was.
    """
    sections = {"/".join(key.lstrip("/") for key in keys): leaves for keys, leaves in _below(tree, ())}
    if not sections:
        return ([("/**", tree)] if isinstance(tree, Map) else []), ""
    own = component.name.lstrip("/")
    reason = "it is not known which section is for this component" if "?" in own and set(sections) - {"**"} else ""
    if any(MARK in key for key in sections):
        reason = "it is not known which nodes a section is for"
    parts = [part for key in ("**", own) if isinstance(part := sections.get(key), Map)]
    entries = {key: value for part in parts for key, value in part.entries.items()}
    return ([("/**", Map(entries, parts[0].line))] if parts else []), reason


def missing(reason: str, location: Location) -> ParameterRule:
    """Parameters of which nothing is known."""
    return ParameterRule(
        node="/**", name="?", type=None, value=None, location=location, unknowns=(Unknown("name", reason, location),)
    )


def _trees(
    context: Context, path: Text, substitutes: bool, location: Location, depth: int
) -> tuple[str, tuple[Tree, ...]]:
    """The root-relative path of the file and its documents."""
    if not path.known:
        raise _Missing(f"parameter file {quoted(path.raw)}: {path.reasons[0]}")
    how = context.rewritten.get(path.raw)
    if how is not None:
        if depth > 10:
            raise _Missing("a file is rewritten too often")
        again = context.rewritten_trees.get(path.raw)
        if again is not None:
            return again[0], _performed(context, again[1]) if substitutes else again[1]
        file, trees = _trees(context, how["source"], False, location, depth + 1)
        for text in rewritten_names(how):
            if not text.known:
                raise _Missing(f"it is not known what is rewritten in the file: {text.reasons[0]}")
        context.spend(20 + sum(size_of(tree) for tree in trees) // 4)
        trees = _once(context, ("rewritten", id(trees), *sorted(how.items())), trees, partial(rewrite, trees, how))
        context.rewritten_trees[path.raw] = (file, trees)
        return file, _performed(context, trees) if substitutes else trees
    found, content, reason = context.places.read(path.raw)
    ros2.named(context, path, location, "parameters")
    if found is None:
        if not context.places.find(path.raw).outside:
            context.problem(location, f"parameter file {quoted(path.raw)}: {reason}")
        raise _Missing(f"parameter file {quoted(path.raw)}: {reason}")
    context.files.add(found)
    context.spend(20 + len(content) // 100)
    text = literal(content)
    if substitutes and ("$(" in content or "\\" in content):
        phrase, problem = read_phrase(content, Location(found))
        if problem:
            context.problem(Location(found), f"substitutions are allowed in this file, but {problem}")
            raise _Missing(f"parameter file {quoted(found)}: {problem}")
        text = perform(context, phrase, 0)
    key = (found, text)
    trees_ = context.places.parsed.get(key)
    if trees_ is None:
        try:
            trees_ = read_trees(text)
        except YamlFault as err:
            context.problem(Location(found, err.line), str(err))
            raise _Missing(f"parameter file {quoted(found)}: {err}") from err
        context.places.parsed[key] = trees_
    return found, trees_


def _once(
    context: Context, key: tuple[object, ...], trees: tuple[Tree, ...], make: Callable[[], tuple[Tree, ...]]
) -> tuple[Tree, ...]:
    """What *make* makes of *trees*, made once for all launch files; *key* has their identity. It is read only."""
    if key not in context.places.made:
        context.places.made[key] = (trees, make())
    made: tuple[Tree, ...] = context.places.made[key][1]
    return made


def _phrased(trees: tuple[Tree, ...]) -> tuple[frozenset[int], tuple[Scalar, ...]]:
    """The ids of what has substitutions to perform, in it or below; and the scalars that have, in order, as often as they stand there."""
    found: set[int] = set()
    scalars: list[Scalar] = []

    def has_phrase(tree: Tree) -> bool:
        if isinstance(tree, Scalar):
            has = "$(" in tree.text and not tree.reasons
            if has:
                scalars.append(tree)
        else:
            has = sum(map(has_phrase, tree.entries.values() if isinstance(tree, Map) else tree.items)) > 0
        if has:
            found.add(id(tree))
        return has

    for tree in trees:
        has_phrase(tree)
    return frozenset(found), tuple(scalars)


def _performed(context: Context, trees: tuple[Tree, ...]) -> tuple[Tree, ...]:
    """Substitutions inside the scalars of a file that has been rewritten; what has none is the same in both."""
    key = ("phrased", id(trees))
    if key not in context.places.made:
        context.places.made[key] = (trees, _phrased(trees))
    phrased, scalars = context.places.made[key][1]
    if not scalars:
        return trees
    performed = tuple(_performed_scalar(context, scalar) for scalar in scalars)

    def make() -> tuple[Tree, ...]:
        rest = iter(performed)

        def done(tree: Tree) -> Tree:
            if id(tree) not in phrased:
                return tree
            if isinstance(tree, Map):
                return Map({key: done(value) for key, value in tree.entries.items()}, tree.line)
            if isinstance(tree, Items):
                return Items([done(item) for item in tree.items], tree.line)
            return next(rest)

        return tuple(done(tree) for tree in trees)

    return _once(context, ("performed", id(trees), performed), trees, make)


def _performed_scalar(context: Context, scalar: Scalar) -> Scalar:
    phrase, problem = read_phrase(scalar.text)
    if problem:
        return replace(scalar, reasons=(problem,))
    made = perform(context, phrase, 0)
    if made.known and scalar.is_plain:
        again = read_trees(made)
        if len(again) == 1 and isinstance(again[0], Scalar):
            return replace(again[0], line=scalar.line)
    return replace(scalar, text=made.raw, reasons=made.reasons)


def _below(tree: Tree, keys: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Tree]]:
    if isinstance(tree, Map):
        for key, value in tree.entries.items():
            if key == SECTION:
                yield keys, value
            else:
                yield from _below(value, (*keys, key))


def _leaves(tree: Tree, prefix: str) -> Iterator[tuple[str, Tree]]:
    if not isinstance(tree, Map):
        if prefix:
            yield prefix, tree
        return
    for key, value in tree.entries.items():
        yield from _leaves(value, f"{prefix}.{key}" if prefix else key)


def _rule(pattern: str, name: str, tree: Tree, location: Location, file: str, is_component: bool) -> ParameterRule:
    origin = Location(file, tree.line)
    kind, value, reason = tree_value(tree, is_component)
    unknowns: tuple[Unknown, ...] = (Unknown("value", reason, origin),) if reason else ()
    if MARK in name:
        name = name.replace(MARK, "?")
        unknowns += (Unknown("name", "a part of the key is not known", origin),)
    if reason and kind is None:
        unknowns += (Unknown("type", reason, origin),)
    return ParameterRule(
        node=pattern, name=name, type=kind, value=value, location=location, origin=origin, unknowns=unknowns
    )


def tree_value(tree: Tree, is_component: bool) -> tuple[str | None, Any, str]:
    """Type, value and, where it is not known, the reason, of a scalar or a list of scalars of one type."""
    if isinstance(tree, Scalar):
        return python_value(tree) if is_component else rcl_value(tree)
    if isinstance(tree, Map):
        return None, None, "a map is no parameter value"
    if not tree.items:
        return None, [], "an empty list has no type"
    read = python_value if is_component else rcl_value
    made = [read(item) for item in tree.items if isinstance(item, Scalar)]
    if len(made) < len(tree.items):
        return None, None, "a list of lists or maps is no parameter value"
    kinds = {kind for kind, _, _ in made}
    if is_component and kinds == {"int", "double"}:
        made = [("double", None if value is None else float(value), reason) for _, value, reason in made]
        kinds = {"double"}
    if len(kinds) > 1 and None not in kinds:
        return None, None, f"the list mixes {', '.join(sorted(kind for kind in kinds if kind))}"
    kind = next(iter(kinds)) if len(kinds) == 1 else None
    reason = next((reason for _, _, reason in made if reason), "")
    typed = None if kind is None else f"{kind}[]"
    return (typed, None, reason) if reason else (typed, [value for _, value, _ in made], "")
