# SPDX-License-Identifier: Apache-2.0
"""A ROS 2 process: its nodes under their final names, remapping rules, parameters given from outside.

What counts is design.ros2.org/articles/ros_command_line_arguments.html and static_remapping.html: a node's own options come
before what the process is given, of several rules the first that matches counts, and what it gives is not looked up again.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache

from haros_ci.graph.names import UNKNOWN, clean
from haros_ci.graph.parameters import Perhaps
from haros_ci.graph.words import is_rule, scalar
from haros_ci.model.architecture import Condition
from haros_ci.model.launch import ParameterRule
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.values.abstract import Known, Opaque, Value
from haros_ci.values.cells import Named

#: Sources of rules that name a node: ``__node:=name``, ``__name:=name``, ``__ns:=/namespace``.
NAMES, SPACES = frozenset(("__node", "__name")), frozenset(("__ns",))
#: Flags between ``--ros-args`` and ``--`` that a word follows.
TAKES_ONE = frozenset(
    "-r --remap -p --param --params-file --log-level --log-config-file --log-file-name -e --enclave".split()
)
#: The kind of a node that a class of a library is given by whoever uses it.
GIVEN = "given"
#: Why the value of a parameter is not known of which the name is not, and of one that has no default.
NO_NAME = "the parameter's name is not known"
OF_WHICH = "the node's name is not known, and a section of parameters for one node may be for it"
NO_DEFAULT = "the parameter is declared without a default, and nothing seen gives it a value"
#: What a rule's source begins with that is for topics, or for services, alone.
TOPIC, SERVICE = "rostopic://", "rosservice://"


@dataclass(frozen=True, slots=True)
class RemappingRule:
    """A remapping rule *source*``:=``*target*, for the node called *node* alone unless that is empty."""

    node: str
    source: str
    target: str


@dataclass(frozen=True, slots=True)
class RosArguments:
    """What ``--ros-args`` say: rules in order, parameters as (node, name, text), parameter files."""

    rules: tuple[RemappingRule, ...] = ()
    parameters: tuple[tuple[str, str, str], ...] = ()
    files: tuple[str, ...] = ()
    rest: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class RosNode(Named):
    """A node of the process under its final *name*; *space* is the namespace of relative names, *own* that of the node.

    *why* says what is not known where a name has ``?``. *main* is the node that a sub-node belongs to.
    """

    name: str
    own: str
    space: str
    kind: str
    class_name: str
    location: Location
    conditions: tuple[Condition, ...] = ()
    rules: tuple[RemappingRule, ...] = ()
    given: Mapping[str, Value] = field(default_factory=dict)
    why: tuple[str, Location | None] | None = None
    main: RosNode | None = None
    options: dict[str, bool] = field(default_factory=dict)

    @property
    def whole(self) -> RosNode:
        """The node itself, where this is a sub-node of it."""
        return self if self.main is None else self.main.whole

    def expand(self, name: str) -> str:
        """*name* as an absolute one (rcl_expand_topic_name): ``~/x`` is below the node, ``x`` below its namespace."""
        for word, text in (("{node}", self.name.rpartition("/")[2]), ("{ns}", self.own), ("{namespace}", self.own)):
            name = name.replace(word, text)
        if name.startswith("/"):
            return clean(name)
        if name == "~" or name.startswith(("~/", "~?")):
            return clean(f"{self.name}/{name[1:]}")
        return clean(f"{self.space}/{name}")

    def remap(self, name: str, is_service: bool = False) -> str:
        """What the absolute *name* of a topic, or of a service, is remapped to; itself without a rule for it."""
        last = self.name.rpartition("/")[2]
        for rule in self.rules:
            if rule.source in NAMES or rule.source in SPACES or rule.node not in ("", last):
                continue
            scheme, source = schemed(rule.source)
            if scheme == (TOPIC if is_service else SERVICE):
                continue
            if "?" not in source and self.whole.expand(source) == name:
                return self.target(rule)
        return name

    def target(self, rule: RemappingRule) -> str:
        """The name that *rule* gives; one whose beginning is not known may be absolute."""
        text = schemed(rule.target)[1]
        return clean(f"/{text}") if text.startswith("?") else self.whole.expand(text)


@dataclass(frozen=True, slots=True)
class Process:
    """What a process is given from outside: its rules, and parameters by full name of node and name.

    *component* are the arguments of the options that a component is constructed with, None for an executable.
    """

    rules: tuple[RemappingRule, ...] = ()
    parameter: Callable[[str, str], Value | None] = lambda node, name: None
    component: tuple[RemappingRule, ...] | None = None
    has_parameters: bool = False


def named(
    name: str,
    namespace: str,
    rules: tuple[RemappingRule, ...],
) -> tuple[str, str]:
    """The final full name and namespace of a node that the code calls *name* in *namespace*.

    A rule that gives a namespace to one node is for the name that the node has by then (rcl_node_init).
    """
    found_name = next((r.target for r in rules if r.source in NAMES and r.node in ("", name)), name)
    found_space = next((r.target for r in rules if r.source in SPACES and r.node in ("", found_name)), namespace)
    space = clean(f"/{found_space}")
    return clean(f"{space}/{found_name}"), space


def schemed(text: str) -> tuple[str, str]:
    """``rostopic://`` or ``rosservice://``, if a rule's source or target begins with that, and the name."""
    scheme = next((item for item in (TOPIC, SERVICE) if text.startswith(item)), "")
    return scheme, text[len(scheme) :]


def rule_of(text: str) -> RemappingRule | None:
    """``[node:]source:=target``; None if it is no rule."""
    head, sign, target = text.partition(":=")
    if not sign or not head:
        return None
    node, colon, source = head.partition(":")
    if not colon or source.startswith("//"):
        return RemappingRule("", head, target)
    return RemappingRule(node, source, target)


def ros_arguments(words: Iterable[str]) -> RosArguments:
    """A command line's words sorted: what stands between ``--ros-args`` and ``--``, rules that stand elsewhere, and the rest."""
    rules: list[RemappingRule] = []
    parameters: list[tuple[str, str, str]] = []
    files: list[str] = []
    rest: list[str] = []
    is_ros, flag = False, ""
    for word in words:
        if not is_ros:
            is_ros = word == "--ros-args"
            rule = rule_of(word) if is_rule(word) else None
            if rule is not None:
                rules.append(rule)
            elif not is_ros:
                rest.append(word)
        elif flag:
            rule = rule_of(word)
            if rule is not None and flag in ("-r", "--remap"):
                rules.append(rule)
            elif rule is not None and flag in ("-p", "--param"):
                parameters.append((rule.node, rule.source, rule.target))
            elif flag == "--params-file":
                files.append(word)
            flag = ""
        elif word == "--":
            is_ros = False
        elif word in TAKES_ONE:
            flag = word
    return RosArguments(tuple(rules), tuple(parameters), tuple(files), tuple(rest))


def from_arguments(found: RosArguments, location: Location) -> tuple[ParameterRule, ...]:
    """The parameters of ``-p [node:]name:=value``; *node* is a key as in a file (rcl ``_rcl_parse_param_rule``)."""
    made = []
    for node, name, text in found.parameters:
        value = scalar(text)
        unknown = "?" in text
        made.append(
            ParameterRule(
                node=node or "/**",
                name=name,
                type=None,
                value=None if unknown else value,
                location=location,
            )
        )
    return tuple(made)


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
