# SPDX-License-Identifier: Apache-2.0
"""What is gathered while launch files are evaluated, and the scope that a tag stands in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from haros_ci.link.roslaunch_files import Files
from haros_ci.link.roslaunch_names import Text, canonical, join_in, quoted
from haros_ci.link.roslaunch_substitution import Sources, substitute
from haros_ci.link.roslaunch_types import boolean
from haros_ci.link.roslaunch_yaml import YamlValue
from haros_ci.model.architecture import Condition, Parameter, Unknown
from haros_ci.model.launch import LaunchElement, LaunchFile, Started
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence
from haros_ci.model.workspace import Problem

#: Tags, values, remaps and texts that one evaluation may handle, weighed by what they cost.
BUDGET = 1_000_000
MAX_PROBLEMS = 1_000
_COMPARED = 20


class Exhausted(Exception):
    """The launch files ask for more than BUDGET."""


@dataclass(frozen=True, slots=True)
class Private:
    """A ``~name`` param of a scope: every node declared after it gets one."""

    name: Text
    parameter: Parameter


@dataclass(frozen=True, slots=True)
class Remap:
    """A ``<remap>`` tag; its target is unknown where it is undecided whether it holds."""

    source: Text
    target: Text
    location: Location


@dataclass(slots=True, kw_only=True)
class Scope:
    """Where a tag stands, as roslaunch's loader context. *declared* maps args to the line of their tag; *doubtful* are
    those that an undecided condition may have set; *missing* those declared that nothing sets."""

    path: str
    namespace: Text
    directory: str
    args: dict[str, Text] = field(default_factory=dict)
    declared: dict[str, int] = field(default_factory=dict)
    missing: dict[str, int] = field(default_factory=dict)
    doubtful: set[str] = field(default_factory=set)
    overrides_allowed: bool = False
    privates: list[Private] = field(default_factory=list)
    remaps: tuple[Remap, ...] = ()
    environment: tuple[tuple[Text, Text], ...] = ()
    conditions: tuple[Condition, ...] = ()
    chain: tuple[tuple[object, ...], ...] = ()
    included_at: Location | None = None
    depth: int = 0
    #: Under which launch arguments that is done which is being evaluated.
    presence: Presence = ()

    def child(self, namespace: Text, conditions: tuple[Condition, ...]) -> Scope:
        """A scope inside this one; what is set in it stays in it."""
        return replace(
            self,
            namespace=namespace,
            args=dict(self.args),
            declared=dict(self.declared),
            missing=dict(self.missing),
            doubtful=set(self.doubtful),
            overrides_allowed=False,
            privates=list(self.privates),
            conditions=conditions,
            depth=self.depth + 1,
        )

    def add_remap(self, remap: Remap) -> None:
        """A later one with the same source replaces an earlier one (roslaunch compares them as written)."""
        same = [old for old in self.remaps if old.source.raw == remap.source.raw and old.source.known]
        self.remaps = (*(old for old in self.remaps if old not in same), remap)


@dataclass(slots=True, kw_only=True)
class State:
    """The outcome so far; every door to the outside that evaluation has."""

    files: Files
    load: Callable[[str], LaunchFile | None]
    environment: Mapping[str, str]
    problems: dict[Problem, None] = field(default_factory=dict)
    parameters: dict[str, list[Parameter]] = field(default_factory=dict)
    nodes: list[Started] = field(default_factory=list)
    names: dict[tuple[str, tuple[Condition, ...]], Location] = field(default_factory=dict)
    machines: dict[str, tuple[str | None, ...]] = field(default_factory=dict)
    arguments: dict[str, str] = field(default_factory=dict)
    read: set[str] = field(default_factory=set)
    included: set[str] = field(default_factory=set)
    documents: dict[str, YamlValue | None] = field(default_factory=dict)
    #: Whether an include could not be followed.
    is_partial: bool = False
    budget: int = BUDGET

    def spend(self, cost: int) -> None:
        self.budget -= cost
        if self.budget < 0:
            raise Exhausted

    def problem(self, path: str, line: int | None, message: str) -> None:
        if len(self.problems) < MAX_PROBLEMS:
            self.problems[Problem(path, message, line)] = None

    def wrong(self, scope: Scope, tag: LaunchElement, message: str) -> None:
        """A problem at *tag*."""
        self.problem(scope.path, tag.line, message)

    def substituted(self, scope: Scope, tag: LaunchElement, raw: str) -> Text:
        """*raw* with its substitutions; what is wrong with them becomes problems at *tag*."""
        self.spend(1 + len(raw) // 20)
        made = substitute(raw, Sources(scope.args, scope.missing, self.environment, scope.directory))
        self.spend(len(made.text.raw) // 20)
        for error in made.errors:
            self.wrong(scope, tag, f"<{tag.tag}>: {error}")
        for name in made.missing:
            self._missing(scope, name)
        return made.text

    def attribute(self, scope: Scope, tag: LaunchElement, name: str) -> Text | None:
        """The attribute *name* of *tag*, substituted; None if it is not there."""
        raw = tag.get(name)
        return None if raw is None else self.substituted(scope, tag, raw)

    def required(self, scope: Scope, tag: LaunchElement, *names: str) -> list[Text] | None:
        """The attributes *names* of *tag*, substituted; None, and a problem, if one is missing."""
        missing = [name for name in names if tag.get(name) is None]
        if missing:
            self.wrong(scope, tag, f"<{tag.tag}> lacks the attribute {quoted(missing[0])}; add it")
            return None
        return [self.substituted(scope, tag, tag.get(name) or "") for name in names]

    def check_attributes(self, scope: Scope, tag: LaunchElement, allowed: tuple[str, ...]) -> None:
        for name, _ in tag.attributes:
            if name not in allowed and name not in ("if", "unless"):
                self.wrong(scope, tag, f"<{tag.tag}> has no attribute {quoted(name)}; remove it or correct its name")

    def truth(self, scope: Scope, tag: LaunchElement, name: str) -> bool | None:
        """Attribute *name* as a boolean, False if it is not there; None if unknown or, with a problem, no boolean."""
        text = self.attribute(scope, tag, name)
        if text is None:
            return False
        if not text.known:
            return None
        word = text.raw.lower()
        if word in ("true", "false"):
            return word == "true"
        self.wrong(scope, tag, f"<{tag.tag} {name}={quoted(text.raw)}> is neither true nor false; write one of them")
        return None

    def conditions(self, scope: Scope, tag: LaunchElement) -> tuple[Condition, ...] | None:
        """The conditions that *tag* stands under, its own undecided one included; None if it is not to be evaluated."""
        statements = [name for name in ("if", "unless") if tag.get(name) is not None]
        if not statements:
            return scope.conditions
        if len(statements) == 2:
            self.wrong(scope, tag, f"<{tag.tag}> has both 'if' and 'unless'; keep one. The tag is left out")
            return None
        statement = statements[0]
        raw = tag.get(statement) or ""
        text = self.substituted(scope, tag, raw)
        if not text.known:
            return (*scope.conditions, Condition(statement, raw, location(scope, tag)))
        try:
            holds = boolean(text.raw) == (statement == "if")
        except ValueError:
            shown = quoted(text.shown)
            self.wrong(scope, tag, f"<{tag.tag} {statement}={shown}>: neither true nor false. The tag is left out")
            return None
        return scope.conditions if holds else None

    def add_parameter(self, name: Text, parameter: Parameter) -> None:
        """Set *parameter* under its full *name*; those that it surely overrides go (the last one wins)."""
        self.spend(2 + len(name.raw) // 100 + 4 * len(parameter.conditions))
        full = canonical(name.raw)
        unknowns = name.unknown("name", parameter.location) if parameter.location else ()
        made = replace(parameter, name=Text(full).shown, unknowns=(*unknowns, *parameter.unknowns))
        before = self.parameters.setdefault(made.name, [])
        if name.known:
            conditions = set(made.conditions)
            before[-_COMPARED:] = [old for old in before[-_COMPARED:] if not conditions <= set(old.conditions)]
        before.append(made)

    def unsettle(self, name: Text, why: str, place: Location) -> None:
        """What is at *name* and below it may be set anew, nobody knows to what."""
        full = Text(canonical(name.raw)).shown.rstrip("/")
        self.spend(len(self.parameters) // 10)
        reason = f"it may be set anew: {why}"
        unknowns = unset("value", reason, place) + unset("type", reason, place)
        for other, together in self.parameters.items():
            if other == full or other.startswith(f"{full}/"):
                together[:] = [
                    replace(old, type=None, value=None, unknowns=(*_names(old.unknowns), *unknowns)) for old in together
                ]

    def _missing(self, scope: Scope, name: str) -> None:
        how = "set it in the configuration, or give it a default"
        if scope.included_at is not None:
            how = f"set it in the <include> at {scope.included_at.path}:{scope.included_at.line}, or give it a default"
        self.problem(
            scope.path,
            scope.missing[name],
            f"argument {quoted(name)} has neither value nor default; what depends on it is unknown: {how}",
        )


def location(scope: Scope, tag: LaunchElement) -> Location:
    return Location(scope.path, tag.line, tag.column)


def inner_namespace(state: State, scope: Scope, tag: LaunchElement) -> Text | None:
    """The namespace inside *tag* by its ``ns``; None, and a problem, if roslaunch refuses it."""
    ns = state.attribute(scope, tag, "ns")
    if ns is None:
        return scope.namespace
    if ns.raw == "":
        state.wrong(scope, tag, f"<{tag.tag}> has an empty 'ns'; remove the attribute. The tag is left out")
        return None
    if ns.raw.startswith("~"):
        state.wrong(scope, tag, f"<{tag.tag} ns={quoted(ns.raw)}>: a namespace cannot be private. The tag is left out")
        return None
    return join_in(scope.namespace, ns)


def check_clear_params(state: State, scope: Scope, tag: LaunchElement) -> bool:
    """Whether ``clear_params`` is in order; it clears before anything is set, so it changes no parameter set here."""
    if not tag.get("clear_params"):
        return True
    cleared = state.truth(scope, tag, "clear_params")
    if cleared and tag.tag != "node" and tag.tag != "test" and tag.get("ns") is None:
        state.wrong(scope, tag, f"<{tag.tag}> needs an 'ns' to use 'clear_params'; add it. The tag is left out")
        return False
    return True


def unknown_condition(conditions: tuple[Condition, ...]) -> str:
    """Why something under the last, undecided of *conditions* is unknown."""
    last = conditions[-1]
    return f"it depends on {last.statement}={quoted(last.condition)} at {last.location.path}:{last.location.line}"


def _names(unknowns: tuple[Unknown, ...]) -> tuple[Unknown, ...]:
    return tuple(entry for entry in unknowns if entry.field == "name")


def unset(field_name: str, reason: str, place: Location) -> tuple[Unknown, ...]:
    return (Unknown(field_name, reason, place),)
