# SPDX-License-Identifier: Apache-2.0
"""The launch context: launch configurations, environment and what is set for all nodes, with scopes that come and go.

As launch has it, the namespace is the configuration ``ros_namespace``; remaps and parameters of all nodes are lists
that a scope shares with the one around it where that has begun them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from haros_ci.link.launching.places import Places
from haros_ci.link.launching.substitutions import perform
from haros_ci.link.roslaunch_names import MARK, Text, literal, quoted, unknown
from haros_ci.model.architecture import Condition
from haros_ci.model.launch_actions import Action, Performed, Phrase, Test
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence
from haros_ci.model.workspace import Problem

NAMESPACE = "ros_namespace"
#: Steps that one evaluation may take; an action, a parameter and a part of a text are steps.
BUDGET = 600_000


class Exhausted(Exception):
    """The launch files do more than can be evaluated."""


@dataclass(frozen=True, slots=True)
class GlobalRemap:
    source: Text
    target: Text
    location: Location
    conditions: tuple[Condition, ...] = ()


@dataclass(frozen=True, slots=True)
class GlobalParameter:
    """SetParameter (*name* and *value*, in *action*) or SetParametersFromFile (*path*), performed where it stands."""

    action: Action
    values: tuple[tuple[Text, Any], ...] = ()
    path: Text | None = None
    conditions: tuple[Condition, ...] = ()


@dataclass(slots=True)
class Scope:
    """All that a scoped group saves and restores. The two lists are None until something is put into them."""

    configurations: dict[str, Text] = field(default_factory=dict)
    environment: dict[str, Text] = field(default_factory=dict)
    remaps: list[GlobalRemap] | None = None
    parameters: list[GlobalParameter] | None = None

    def copy(self) -> Scope:
        return Scope(dict(self.configurations), dict(self.environment), self.remaps, self.parameters)


@dataclass(slots=True)
class Context:
    """The state while a launch description is performed; what an OpaqueFunction gets."""

    places: Places
    initial: Mapping[str, Text]
    scope: Scope = field(default_factory=Scope)
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

    def spend(self, steps: int) -> None:
        self.steps -= steps
        if self.steps < 0:
            raise Exhausted

    def problem(self, location: Location | None, message: str) -> None:
        path, line = (location.path, location.line) if location is not None else (self.path, None)
        self.problems[Problem(path, message, line)] = None

    def text(self, phrase: Phrase) -> Text:
        """*phrase* in this context; a MARK stands for each part that is not known."""
        return perform(self, phrase, 0)

    def perform(self, phrase: Phrase) -> Performed:
        text = self.text(phrase)
        return Performed(text.shown, "; ".join(dict.fromkeys(text.reasons)))

    def configuration(self, name: str) -> Performed | None:
        text = self.scope.configurations.get(name)
        return None if text is None else Performed(text.shown, "; ".join(dict.fromkeys(text.reasons)))

    def set_configuration(self, name: str, value: Performed) -> None:
        self.scope.configurations[name] = as_text(value)

    def test(self, test: Test) -> bool | None:
        """Whether *test* holds; None, with a problem where launch would stop, if that is not known."""
        if test.kind in ("if", "unless") and test.phrases:
            text = self.text(test.phrases[0])
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
            value = self.scope.configurations.get(name.raw)
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
