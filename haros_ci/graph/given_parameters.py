# SPDX-License-Identifier: Apache-2.0
"""The parameters that a ROS 2 process is given from outside: by its command line, its launch file and parameter files."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

from haros_ci.graph.names import UNKNOWN
from haros_ci.graph.parameters import Perhaps
from haros_ci.model.architecture import Condition
from haros_ci.model.launch import ParameterRule
from haros_ci.values.abstract import Known, Opaque, Value

#: Why the value of a parameter is not known of which the name is not, or not that of its node.
NO_NAME = "the parameter's name is not known"
OF_WHICH = "the node's name is not known, and a section of parameters for one node may be for it"
#: Asked for in place of a parameter's name: the names of all.
EVERY = "*"


class Parameters:
    """The parameters that a process is given, as rcl puts them together.

    The sections of all files are one list in the order in which their keys are first seen; of what matches a node the
    last counts (rcl_yaml_param_parser, rclcpp::detail::resolve_parameter_overrides).
    """

    def __init__(self, rules: Iterable[ParameterRule]) -> None:
        self._sections: dict[str, dict[str, list[ParameterRule]]] = {}
        self.unread: ParameterRule | None = None
        self._unread_after: dict[int, ParameterRule] = {}
        self.rules = tuple(rules)
        for rule in reversed(self.rules):
            if "?" in rule.name:
                self.unread = self.unread or rule
            elif self.unread is not None:
                self._unread_after[id(rule)] = self.unread
        for rule in self.rules:
            if "?" in rule.name:
                continue
            section = self._sections.setdefault(rule.node, {})
            if rule.conditions:
                section.setdefault(rule.name, []).append(rule)
            else:
                section[rule.name] = [rule]

    def of(self, node: str) -> dict[str, ParameterRule]:
        """The rule that counts for each parameter of the node with that full name."""
        found: dict[str, ParameterRule] = {}
        for pattern, section in self._sections.items():
            if matches(pattern, node):
                found.update((name, rules[-1]) for name, rules in section.items())
        return found

    def every(self, node: str, under: tuple[Condition, ...] = ()) -> Value:
        """The names of all parameters that a node is given, sorted; Opaque if they are not known."""
        if self.unread is not None:
            return Opaque(f"there may be more: {reason(self.unread)}", self.unread.location)
        found = self.of(node)
        for rule in found.values():
            if not set(rule.conditions) <= set(under):
                return Opaque(f"the parameter {rule.name} is set under a condition", rule.location)
        return Known(sorted(found))

    def get(self, node: str, name: str, under: tuple[Condition, ...] = ()) -> Value | None:
        """The value that a node is given for a parameter; None if none, Opaque if it is not known, Perhaps if it may not be."""
        if name == EVERY:
            return self.every(node, under)
        if UNKNOWN in name:
            return self._like(node, name)
        other = self._of_another(node, name) if UNKNOWN in node else None
        if other is not None:
            return Perhaps(OF_WHICH, other.location)
        found: list[ParameterRule] = []
        for pattern, section in self._sections.items():
            if name in section and matches(pattern, node):
                rules = section[name]
                found = [*(found if rules[0].conditions else ()), *rules]
        if not found:
            if self.unread is not None:
                return Perhaps(f"it may be set: {reason(self.unread)}", self.unread.location)
            return None
        last = found[-1]
        # What the launch file itself says is not said twice; a file that comes later may be there to say otherwise.
        unread = self._unread_after.get(id(last)) if last.origin is not None else None
        if unread is not None:
            return Opaque(f"something else may be set: {reason(unread)}", unread.location)
        if not set(last.conditions) <= set(under):
            return (Perhaps if all(rule.conditions for rule in found) else Opaque)(
                f"the parameter {name} is set under a condition", last.location
            )
        if last.unknowns or last.value is None:
            return Opaque(reason(last), last.origin or last.location)
        return Known(last.value)

    def _of_another(self, node: str, name: str) -> ParameterRule | None:
        """A rule for the parameter *name* of nodes of which one may be *node*, a name that is known in parts only."""
        for pattern, section in self._sections.items():
            if name in section and not matches(pattern, node) and fits(f"/{pattern.lstrip('/')}", node):
                return section[name][-1]
        return None

    def _like(self, node: str, shape: str) -> Value | None:
        """None unless a node gets a parameter whose name is known in parts only; which parameter that is cannot be decided."""
        if self.unread is not None:
            return Perhaps(f"it may be set: {reason(self.unread)}", self.unread.location)
        for pattern, section in self._sections.items():
            if matches(pattern, node):
                for name in section:
                    if fits(name, shape):
                        return Opaque(NO_NAME, section[name][-1].location)
        return None


class InContainer(Parameters):
    """What a component is given: its *own* rules for its own node, for others that it makes what its container's process is given.

    The container constructs it with ``use_global_arguments(false)`` (rclcpp_components, ComponentManager).
    """

    def __init__(self, own: Parameters, name: str | None, around: Parameters) -> None:
        super().__init__(own.rules)
        self._name = name
        self._around = around

    def _is_own(self, node: str) -> bool:
        return self._name is None or node == self._name

    def of(self, node: str) -> dict[str, ParameterRule]:
        return super().of(node) if self._is_own(node) else self._around.of(node)

    def every(self, node: str, under: tuple[Condition, ...] = ()) -> Value:
        return super().every(node, under) if self._is_own(node) else self._around.every(node, under)

    def get(self, node: str, name: str, under: tuple[Condition, ...] = ()) -> Value | None:
        return super().get(node, name, under) if self._is_own(node) else self._around.get(node, name, under)


def fits(name: str, shape: str) -> bool:
    """Whether a name may be the one of which *shape* tells parts, with ``?`` for those that are not known."""
    first, *rest = shape.split(UNKNOWN)
    if not rest:
        return name == shape
    if not name.startswith(first) or not name.endswith(rest[-1]) or len(name) < len(first) + len(rest[-1]):
        return False
    place, end = len(first), len(name) - len(rest[-1])
    for part in rest[:-1]:
        place = name.find(part, place, end) + len(part)
        if place < len(part):
            return False
    return True


def reason(rule: ParameterRule) -> str:
    """Why the value of *rule* is not known."""
    return rule.unknowns[0].reason if rule.unknowns else "its value is not known"


@lru_cache(maxsize=4096)
def _pattern(text: str) -> re.Pattern[str]:
    text = text if text.startswith("/") else f"/{text}"
    parts = re.split(r"(/\*\*|/\*)", text)
    kinds = {"/**": r"(?:/[^/]+)*", "/*": r"/[^/]+"}
    return re.compile("".join(kinds.get(part) or re.escape(part) for part in parts))


def matches(pattern: str, node: str) -> bool:
    """Whether a parameter file's key (``/**``, ``/*/planner``, ``node``) is for the node of that full name."""
    return _pattern(pattern).fullmatch(node) is not None
