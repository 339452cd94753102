# SPDX-License-Identifier: Apache-2.0
"""The launch context: launch configurations, environment and what is set for all nodes, with scopes that come and go.

As launch has it, the namespace is the configuration ``ros_namespace``; remaps and parameters of all nodes are lists
that a scope shares with the one around it where that has begun them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from haros_ci.launch.facts.record import Recorder
from haros_ci.launch.ros2.places import Places
from haros_ci.launch.ros2.substitutions import perform
from haros_ci.model.architecture import Condition
from haros_ci.model.launch_actions import Action, Performed, Phrase, Test
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence, in_words
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.substitutions.names import MARK, Text, derived, literal, quoted, unknown
from haros_ci.substitutions.presence import OTHER, Assumed, LaunchArguments, is_elsewhere

NAMESPACE = "ros_namespace"
#: Steps that one evaluation may take; an action, a parameter and a part of a text are steps.
BUDGET = 600_000
#: Steps for what is asked and done under other launch arguments, all together.
SPARE = 300_000


class LaunchBudgetExhausted(Exception):
    """The launch files do more than can be evaluated."""


@dataclass(frozen=True, slots=True)
class GlobalRemap:
    source: Text
    target: Text
    location: Location
    conditions: tuple[Condition, ...] = ()
    presence: Presence = ()


@dataclass(frozen=True, slots=True)
class GlobalParameter:
    """SetParameter (*name* and *value*, in *action*) or SetParametersFromFile (*path*), performed where it stands."""

    action: Action
    values: tuple[tuple[Text, Any], ...] = ()
    path: Text | None = None
    conditions: tuple[Condition, ...] = ()
    presence: Presence = ()


@dataclass(slots=True)
class GroupScope:
    """All that a scoped group saves and restores. The two lists are None until something is put into them."""

    configurations: dict[str, Text] = field(default_factory=dict)
    environment: dict[str, Text] = field(default_factory=dict)
    remaps: list[GlobalRemap] | None = None
    parameters: list[GlobalParameter] | None = None
    #: Configurations that are set with other launch arguments only.
    unset: dict[str, Text] = field(default_factory=dict)

    def copy(self) -> GroupScope:
        unset = dict(self.unset)
        return GroupScope(dict(self.configurations), dict(self.environment), self.remaps, self.parameters, unset)

    def isolated(self) -> GroupScope:
        """A copy of which nothing that is done in it is seen outside."""
        made = self.copy()
        made.remaps = None if self.remaps is None else list(self.remaps)
        made.parameters = None if self.parameters is None else list(self.parameters)
        return made


@dataclass(slots=True)
class Context:
    """The state while a launch description is performed; what an OpaqueFunction gets."""

    places: Places
    initial: Mapping[str, Text]
    scope: GroupScope = field(default_factory=GroupScope)
    #: The launch file being performed, root-relative.
    path: str = ""
    problems: dict[Problem, None] = field(default_factory=dict)
    files: set[str] = field(default_factory=set)
    #: What a RewrittenYaml stands for, by the path that performing it gives.
    rewritten: dict[str, Any] = field(default_factory=dict)
    #: The file and the documents that such a path has given.
    rewritten_trees: dict[str, tuple[str, Any]] = field(default_factory=dict)
    steps: int = BUDGET
    #: Under which launch arguments that is done which is being performed.
    presence: Presence = ()
    #: The launch arguments, where it is asked what is there under others of them.
    arguments: LaunchArguments | None = None
    #: Arguments that are taken to have other values while something is performed.
    assumed: Assumed = field(default_factory=dict)
    #: Problems that are there under assumptions, with the assumption.
    assumed_problems: dict[Problem, str] = field(default_factory=dict)
    #: Whether a question is asked that is of no consequence.
    is_asking: bool = False
    #: The configurations that have been read, where this is asked for, and whether there are no others.
    reads: dict[str, Text | None] | None = None
    is_again: bool = False
    #: The literals that ``OTHER`` has been compared with; None in it where something else is done with it.
    compared: set[str | None] = field(default_factory=set)
    #: Steps that are left for all questions and assumptions, and whether they are being spent.
    spare: int = SPARE
    is_spare: bool = False
    #: What is said besides, for checks, and the includes that lead to what is being performed.
    facts: Recorder = field(default_factory=Recorder)
    included: tuple[Location, ...] = ()

    def spend(self, steps: int) -> None:
        self.steps -= steps
        if self.steps < 0:
            raise LaunchBudgetExhausted

    def problem(self, location: Location | None, message: str, certain: bool = False) -> None:
        """What is wrong; where arguments are assumed, only what is *certain* then."""
        path, line = (location.path, location.line) if location is not None else (self.path, None)
        problem = Problem(path, message, line)
        if self.is_asking or (self.assumed and not certain):
            return
        if self.assumed:
            words = in_words((name, text.raw) for name, text in sorted(self.assumed.items()))
            self.assumed_problems.setdefault(problem, words)
        else:
            self.problems[problem] = None

    def text(self, phrase: Phrase) -> Text:
        """*phrase* in this context; a MARK stands for each part that is not known."""
        if self.arguments is None or all(isinstance(part, str) for part in phrase):
            return perform(self, phrase, 0)
        around, self.reads = self.reads, {}
        try:
            made = perform(self, phrase, 0)
        finally:
            reads, self.reads = self.reads, around
            if around is not None:
                around.update(reads)
        origins = [text.origin for text in reads.values() if text is not None and text.origin is not None]
        if not origins:
            return made
        if len(reads) == 1 and len(phrase) == 1 and not isinstance(phrase[0], str) and phrase[0].kind == "var":
            return replace(made, origin=origins[0])
        return replace(made, origin=derived(origins, partial(self._again, phrase, self.path, reads)))

    def _again(self, phrase: Phrase, path: str, reads: Mapping[str, Text | None], assumed: Assumed) -> Text | None:
        """What *phrase* is in the file at *path*, with what it has read there, where arguments are as *assumed*."""
        before = self.swapped(reads, assumed, path)
        try:
            return perform(self, phrase, 0)
        finally:
            self.restore(before)

    def swapped(self, reads: Mapping[str, Text | None], assumed: Assumed, path: str) -> tuple[Any, ...]:
        """Go where only what has been *read* is set, and arguments are as *assumed*; what ``restore`` needs to come back."""
        before = (self.scope, self.assumed, self.is_asking, self.is_again, self.reads, self.path)
        known = {name: text for name, text in reads.items() if text is not None and not is_elsewhere(text)}
        self.scope = GroupScope(known, self.scope.environment)
        nothing = unknown("it is not set")
        self.scope.unset = {name: text or nothing for name, text in reads.items() if name not in known}
        self.assumed, self.is_asking, self.is_again, self.reads, self.path = assumed, True, True, None, path
        return before

    def restore(self, before: tuple[Any, ...]) -> None:
        self.scope, self.assumed, self.is_asking, self.is_again, self.reads, self.path = before

    def get(self, name: str) -> Text | None:
        """A launch configuration, as it is with the arguments that are assumed; None if nothing sets it."""
        scope = self.scope
        found = scope.configurations.get(name)
        if self.arguments is None:
            return found
        kept = found if found is not None else scope.unset.get(name)
        if self.reads is not None:
            self.reads[name] = kept
        if (
            self.assumed
            and kept is not None
            and kept.origin is not None
            and not kept.origin.arguments.isdisjoint(self.assumed)
        ):
            self.spend(5)
            return self.arguments.resolved(kept, self.assumed)
        if self.is_again and found is None and name not in scope.unset:
            return unknown(f"whether {quoted(name)} is set depends on launch arguments")
        return found

    def reading(self, phrases: Iterable[Phrase], tests: Iterable[Test] = ()) -> dict[str, Text | None]:
        """The configurations that *phrases* and *tests* depend on."""
        around, self.reads = self.reads, {}
        try:
            for phrase in phrases:
                self.text(phrase)
            for test in tests:
                self.test(test)
            return self.reads
        finally:
            self.reads = around

    def perform(self, phrase: Phrase) -> Performed:
        text = self.text(phrase)
        return Performed(text.shown, "; ".join(dict.fromkeys(text.reasons)))

    def configuration(self, name: str) -> Performed | None:
        self.facts.read.add(name)
        text = self.get(name)
        return None if text is None else Performed(text.shown, "; ".join(dict.fromkeys(text.reasons)))

    def names_of_configurations(self) -> tuple[str, ...] | None:
        return None if self.facts.is_open or self.is_again else tuple(self.scope.configurations)

    def set_configuration(self, name: str, value: Performed) -> None:
        self.scope.configurations[name] = as_text(value)

    def set_any_configuration(self) -> None:
        self.facts.is_open = True

    def test(self, test: Test) -> bool | None:
        """Whether *test* holds; None, with a problem where launch would stop, if that is not known."""
        if test.kind in ("if", "unless") and test.phrases:
            text = self.text(test.phrases[0])
            if self.arguments is not None and not self.is_asking:
                self.arguments.tested(text)
            word = text.raw.strip().lower()
            if not text.known:
                return None
            if word not in ("true", "1", "false", "0"):
                what = f"the condition {quoted(test.text)} is {quoted(text.raw)}"
                self.problem(test.location, f"{what}; it must be true, false, 1 or 0")
                return None
            return (word in ("true", "1")) == (test.kind == "if")
        if test.kind in ("equals", "not-equals") and test.phrases:
            name = self.text(test.phrases[0])
            expected = self.text(test.phrases[1]) if len(test.phrases) > 1 else None
            value = self.get(name.raw)
            if value is not None and value.raw == OTHER:
                self.compared.add(expected.raw if expected is not None else None)
            if not name.known or (expected is not None and not expected.known) or (value and not value.known):
                return None
            equal = (value.raw if value is not None else None) == (expected.raw if expected is not None else None)
            return equal == (test.kind == "equals")
        return None


def as_text(performed: Performed) -> Text:
    """What an OpaqueFunction gives, as a text; its ``?`` are its unknown parts."""
    if performed.known:
        return literal(performed.text)
    count = performed.text.count("?")
    if not count:
        return unknown(performed.reason)
    return Text(performed.text.replace("?", MARK), (performed.reason,) * count)
