# SPDX-License-Identifier: Apache-2.0
"""A ROS 2 process: its nodes under their final names, remapping rules, parameters given from outside.

What counts is design.ros2.org/articles/ros_command_line_arguments.html and static_remapping.html: a node's own options come
before what the process is given, of several rules the first that matches counts, and what it gives is not looked up again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from haros_ci.graph.names import clean
from haros_ci.graph.words import is_rule, scalar
from haros_ci.model.architecture import Condition
from haros_ci.model.launch import ParameterRule
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.values.abstract import Value
from haros_ci.values.cells import Named

#: Sources of rules that name a node: ``__node:=name``, ``__name:=name``, ``__ns:=/namespace``.
NAMES, SPACES = frozenset(("__node", "__name")), frozenset(("__ns",))
#: Flags between ``--ros-args`` and ``--`` that a word follows.
TAKES_ONE = frozenset(
    "-r --remap -p --param --params-file --log-level --log-config-file --log-file-name -e --enclave".split()
)
#: The kind of a node that a class of a library is given by whoever uses it.
GIVEN = "given"
#: Why the value of a parameter is not known that has no default.
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
