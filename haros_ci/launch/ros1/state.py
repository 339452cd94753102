# SPDX-License-Identifier: Apache-2.0
"""What is gathered while launch files are evaluated."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

from haros_ci.launch.facts import ros1
from haros_ci.launch.facts.record import Recorder
from haros_ci.launch.ros1.scope import LoaderScope, location
from haros_ci.model.architecture import Condition, Parameter, Unknown
from haros_ci.model.launch import LaunchElement, LaunchFile, Started
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence, in_words, together
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.substitutions.files import Files
from haros_ci.substitutions.names import Text, canonical, derived, join_in, quoted
from haros_ci.substitutions.presence import Assumed, LaunchArguments
from haros_ci.substitutions.substitution import SubstitutionSources, substitute
from haros_ci.substitutions.types import boolean
from haros_ci.substitutions.yaml import YamlValue

#: Tags, values, remaps and texts that one evaluation may handle, weighed by what they cost.
BUDGET = 1_000_000
#: The same for what is asked and evaluated with other args.
SPARE = 500_000
MAX_PROBLEMS = 1_000
_COMPARED = 20


class RoslaunchBudgetExhausted(Exception):
    """The launch files ask for more than BUDGET."""


@dataclass(slots=True, kw_only=True)
class RoslaunchState:
    """The outcome so far; every door to the outside that evaluation has."""

    files: Files
    load: Callable[[str], LaunchFile | None]
    environment: Mapping[str, str]
    problems: dict[Problem, None] = field(default_factory=dict)
    parameters: dict[str, list[Parameter]] = field(default_factory=dict)
    nodes: list[Started] = field(default_factory=list)
    names: dict[tuple[str, tuple[Condition, ...]], Location] = field(default_factory=dict)
    machines: dict[str, tuple[str | None, ...]] = field(default_factory=dict)
    arguments_shown: dict[str, str] = field(default_factory=dict)
    read: set[str] = field(default_factory=set)
    included: set[str] = field(default_factory=set)
    facts: Recorder = field(default_factory=Recorder)
    documents: dict[str, YamlValue | None] = field(default_factory=dict)
    #: While a node's tag is evaluated: where parameters are set then, and what it has set so far.
    tag: tuple[dict[str, list[Parameter]], list[Parameter]] | None = None
    #: Whether an include could not be followed.
    is_partial: bool = False
    budget: int = BUDGET
    #: The args of the top level, where it is asked what is there under others of them.
    arguments: LaunchArguments | None = None
    #: Under which of them that is done which is being evaluated, and those that are assumed, how often inside one another.
    presence: Presence = ()
    assumed: Assumed = field(default_factory=dict)
    assumptions: int = 0
    alternatives: list[Started] = field(default_factory=list)
    alternative_parameters: list[Parameter] = field(default_factory=list)
    assumed_problems: dict[Problem, str] = field(default_factory=dict)
    #: Whether a question is asked that is of no consequence; the args that it reads, and what ``OTHER`` is compared with.
    is_asking: bool = False
    reads: dict[str, Text] = field(default_factory=dict)
    compared: set[str] = field(default_factory=set)
    #: What is left for questions and assumptions, and whether it is being spent.
    spare: int = SPARE
    is_spare: bool = False

    def spend(self, cost: int) -> None:
        self.budget -= cost
        if self.budget < 0:
            raise RoslaunchBudgetExhausted

    def problem(self, path: str, line: int | None, message: str, certain: bool = False) -> None:
        """What is wrong; with args that are assumed, only what is *certain* then."""
        if self.is_asking or (self.assumed and not certain):
            return
        problem = Problem(path, message, line)
        if self.assumed:
            words = in_words((name, text.raw) for name, text in sorted(self.assumed.items()))
            self.assumed_problems.setdefault(problem, words)
        elif len(self.problems) < MAX_PROBLEMS:
            self.problems[problem] = None

    def wrong(self, scope: LoaderScope, tag: LaunchElement, message: str, certain: bool = False) -> None:
        """A problem at *tag*."""
        self.problem(scope.path, tag.line, message, certain)

    def substituted(self, scope: LoaderScope, tag: LaunchElement, raw: str) -> Text:
        """*raw* with its substitutions; what is wrong with them becomes problems at *tag*."""
        self.spend(1 + len(raw) // 20)
        args: Mapping[str, Text] = scope.args if self.arguments is None else _Seen(self, scope)
        made = substitute(
            raw, SubstitutionSources(args, scope.missing, self.environment, scope.directory, self.compared)
        )
        self.spend(len(made.text.raw) // 20)
        for error in made.errors:
            self.wrong(scope, tag, f"<{tag.tag}>: {error}")
        if made.errors:
            ros1.undeclared(self, scope, tag, raw)
        for name in made.missing:
            self._missing(scope, name)
        if isinstance(args, _Seen) and args.reads:
            self.reads.update(args.reads)
            return self._traced(made.text, raw, args.reads, scope.directory)
        return made.text

    def _traced(self, text: Text, raw: str, reads: Mapping[str, Text], directory: str) -> Text:
        """*text*, which *raw* gives with the args that it *reads*, with its origin."""
        origins = [read.origin for read in reads.values() if read.origin is not None]
        if not origins:
            return text
        if len(reads) == 1 and raw == f"$(arg {next(iter(reads))})":
            return replace(text, origin=origins[0])
        return replace(text, origin=derived(origins, partial(self._again, raw, reads, directory)))

    def _again(self, raw: str, reads: Mapping[str, Text], directory: str, assumed: Assumed) -> Text:
        """What *raw* gives with what it has read, where args are as *assumed*."""
        assert self.arguments is not None
        self.spend(1 + len(raw) // 20)
        found = {name: self.arguments.resolved(text, assumed) for name, text in reads.items()}
        args = {name: text for name, text in found.items() if text is not None}
        return substitute(raw, SubstitutionSources(args, {}, self.environment, directory, self.compared)).text

    def attribute(self, scope: LoaderScope, tag: LaunchElement, name: str) -> Text | None:
        """The attribute *name* of *tag*, substituted; None if it is not there."""
        raw = tag.get(name)
        if raw is None:
            return None
        made = self.substituted(scope, tag, raw)
        ros1.attribute(self, scope, tag, name, made)
        return made

    def required(self, scope: LoaderScope, tag: LaunchElement, *names: str) -> list[Text] | None:
        """The attributes *names* of *tag*, substituted; None, and a problem, if one is missing."""
        missing = [name for name in names if tag.get(name) is None]
        if missing:
            self.wrong(scope, tag, f"<{tag.tag}> lacks the attribute {quoted(missing[0])}; add it")
            return None
        return [self.attribute(scope, tag, name) or Text("") for name in names]

    def check_attributes(self, scope: LoaderScope, tag: LaunchElement, allowed: tuple[str, ...]) -> None:
        for name, _ in tag.attributes:
            if name not in allowed and name not in ("if", "unless"):
                self.wrong(scope, tag, f"<{tag.tag}> has no attribute {quoted(name)}; remove it or correct its name")

    def truth(self, scope: LoaderScope, tag: LaunchElement, name: str) -> bool | None:
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

    def conditions(self, scope: LoaderScope, tag: LaunchElement) -> tuple[Condition, ...] | None:
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
            ros1.tested(self, scope, tag, statement, text, None)
            return (*scope.conditions, Condition(statement, raw, location(scope, tag)))
        try:
            holds = boolean(text.raw) == (statement == "if")
        except ValueError:
            shown = quoted(text.shown)
            self.wrong(scope, tag, f"<{tag.tag} {statement}={shown}>: neither true nor false. The tag is left out")
            return None
        ros1.tested(self, scope, tag, statement, text, holds)
        return scope.conditions if holds else None

    def add_parameter(self, name: Text, parameter: Parameter) -> None:
        """Set *parameter* under its full *name*; those that it surely overrides go (the last one wins)."""
        self.spend(2 + len(name.raw) // 100 + 4 * len(parameter.conditions))
        full = canonical(name.raw)
        unknowns = name.unknown("name", parameter.location) if parameter.location else ()
        made = replace(parameter, name=Text(full).shown, unknowns=(*unknowns, *parameter.unknowns))
        if self.presence:
            made = replace(made, presence=together(parameter.presence, self.presence) or self.presence)
        if self.tag is not None and self.tag[0] is self.parameters:
            made = replace(made, is_of_node=True)
            self.tag[1].append(made)
        before = self.parameters.setdefault(made.name, [])
        if name.known:
            conditions = set(made.conditions)
            before[-_COMPARED:] = [old for old in before[-_COMPARED:] if not conditions <= set(old.conditions)]
        before.append(made)

    @contextmanager
    def in_tag(self) -> Iterator[list[Parameter]]:
        """What is set inside is a node's own, and is in the list afterwards; not what is set with other args."""
        before, own = self.tag, list[Parameter]()
        self.tag = self.parameters, own
        try:
            yield own
        finally:
            self.tag = before

    def unsettle(self, name: Text, why: str, place: Location) -> None:
        """What is at *name* and below it may be set anew, nobody knows to what."""
        full = Text(canonical(name.raw)).shown.rstrip("/")
        self.spend(len(self.parameters) // 10)
        reason = f"it may be set anew: {why}"
        unknowns = unset("value", reason, place) + unset("type", reason, place)

        def unset_anew(old: Parameter) -> Parameter:
            return replace(old, type=None, value=None, unknowns=(*_names(old.unknowns), *unknowns))

        def is_meant(other: str) -> bool:
            return other == full or other.startswith(f"{full}/")

        for other, those in self.parameters.items():
            if is_meant(other):
                those[:] = map(unset_anew, those)
        if self.tag is not None and self.tag[0] is self.parameters:
            self.tag[1][:] = [unset_anew(old) if is_meant(old.name) else old for old in self.tag[1]]

    def _missing(self, scope: LoaderScope, name: str) -> None:
        how = "set it in the configuration, or give it a default"
        if scope.included_at is not None:
            how = f"set it in the <include> at {scope.included_at.path}:{scope.included_at.line}, or give it a default"
            self.facts.absent.setdefault((scope.included_at, scope.path), set()).add(name)
        self.problem(
            scope.path,
            scope.missing[name],
            f"argument {quoted(name)} has neither value nor default; what depends on it is unknown: {how}",
        )


class _Seen(Mapping[str, Text]):
    """The args of a scope as they are with what is assumed; it remembers which have been read."""

    def __init__(self, state: RoslaunchState, scope: LoaderScope) -> None:
        self._state, self._scope = state, scope
        self.reads: dict[str, Text] = {}

    def __getitem__(self, name: str) -> Text:
        assert self._state.arguments is not None
        found = self._scope.args.get(name)
        kept = found if found is not None else self._scope.unset.get(name)
        if kept is not None:
            self.reads[name] = kept
            if kept.origin is not None and not kept.origin.arguments.isdisjoint(self._state.assumed):
                found = self._state.arguments.resolved(kept, self._state.assumed)
        if found is None:
            raise KeyError(name)
        return found

    def __contains__(self, name: object) -> bool:
        try:
            return isinstance(name, str) and self[name] is not None
        except KeyError:
            return False

    def __iter__(self) -> Iterator[str]:
        return iter(self._scope.args)

    def __len__(self) -> int:
        return len(self._scope.args)


def inner_namespace(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement) -> Text | None:
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


def check_clear_params(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement) -> bool:
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
