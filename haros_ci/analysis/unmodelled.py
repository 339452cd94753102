# SPDX-License-Identifier: Apache-2.0
"""Plug-in libraries whose code is in the workspace and of which the model shows nothing."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from haros_ci import syntax
from haros_ci.analysis.coverage import uncovered
from haros_ci.config.settings import Settings
from haros_ci.coverage.names import Names, joined, names_of
from haros_ci.coverage.pieces import last_name
from haros_ci.extract.apis.tables import rows
from haros_ci.index.index import Source
from haros_ci.model.architecture import Architecture
from haros_ci.model.build import Build
from haros_ci.model.workspace import Workspace
from haros_ci.report.summary import plural
from haros_ci.syntax import Class, Function
from haros_ci.syntax.walk import everything
from haros_ci.systems.link import Linked

#: Bases of plug-ins that are nodes themselves: one that no launch file loads is shown as a configuration of its own.
_NODES = frozenset(("nodelet::Nodelet", "rclcpp_components::NodeFactory"))
MOST = 5


def lacking(made: Linked, workspace: Workspace, settings: Settings) -> tuple[str, ...]:
    """Sentences on what the model that was *made* of *workspace* lacks: known kinds of programs, and calls of ROS APIs."""
    return (*unmodelled(made.architecture, made.builds, made.sources), *uncovered(made, workspace, settings))


def unmodelled(found: Architecture, builds: Mapping[str, Build], sources: Iterable[Source] = ()) -> tuple[str, ...]:
    """A sentence on the packages with plug-ins (controllers, planners, layers, displays) of which *found* has nothing.

    What they publish, subscribe to and read is missing from the model. None where there is no such package. A plug-in is none of them
    if a node is it, if an endpoint stands in a method of its class or of a base of that, or if the *sources* have such methods and none of
    them calls a ROS API, as ``model --coverage`` counts them.
    """
    shown = {name for one in found.configurations for node in one.nodes for name in _names(node.package, node.type)}
    shown |= {node.class_name for one in found.configurations for node in one.nodes if node.class_name}
    missing = _missing(found, builds, sources, shown)
    if not missing:
        return ()
    return (
        f"Not modelled: plug-ins of {plural(len(missing), 'package')} ({_listed(missing.items())}). No node is seen to load them, so the topics, "
        "services and parameters that they may use are not in the model",
    )


def of_tests(workspace: Workspace) -> tuple[str, ...]:
    """A sentence on launch files that are no configuration because they, or their package, are named as tests."""
    from haros_ci.launch.ros2.dialect import is_ros2_file
    from haros_ci.launch.ros2.entry import named_as_tests

    found = named_as_tests(workspace, is_ros2_file(workspace))
    if not found:
        return ()
    others = f" and {len(found) - MOST} more" if len(found) > MOST else ""
    return (
        f"Named as tests, so no configuration: {', '.join(found[:MOST])}{others}. --launch FILE shows what one of them starts",
    )


def _missing(
    found: Architecture, builds: Mapping[str, Build], sources: Iterable[Source], shown: set[str]
) -> dict[str, str]:
    """By package the base class of its first plug-in that is not *shown* and of whose code the model may lack all."""
    missing: dict[str, str] = {}
    code: _Code | None = None
    for package, build in sorted(builds.items()):
        for plugin in build.plugins:
            if package in missing or plugin.base in _NODES or not shown.isdisjoint((plugin.name, plugin.type)):
                continue
            code = code or _Code(found, sources)
            if code.may_lack(plugin.type):
                missing[package] = plugin.base
    return missing


class _Code:
    """The classes of the workspace and their methods, and the lines at which the model has an endpoint."""

    def __init__(self, found: Architecture, sources: Iterable[Source]) -> None:
        self._classes: dict[str, list[Class]] = {}
        self._methods: dict[str, list[tuple[Source, Function]]] = {}
        for source in sources:
            for definition in source.program.classes:
                self._classes.setdefault(last_name(definition.name), []).append(definition)
            for function in source.program.functions:
                if function.owner and function.body is not None:
                    self._methods.setdefault(last_name(function.owner), []).append((source, function))
        ends = (end for one in found.configurations for node in one.nodes for end in node.endpoints)
        self._lines = {(end.location.path, end.location.line) for end in ends if end.location is not None}
        self._called: dict[str, Names] = {}

    def may_lack(self, type: str) -> bool:
        """Whether the model has nothing of what the class of a plug-in may make; true where the class is not here."""
        names = self._with_bases(last_name(word) for word in re.findall(r"[\w:.]+", type))
        methods = [method for name in names for method in self._methods.get(name, ())]
        calls = [(source.path, call.line) for source, function in methods for call in self._calls(source, function)]
        return not methods or bool(calls) and self._lines.isdisjoint(calls)

    def _with_bases(self, names: Iterable[str]) -> set[str]:
        found: set[str] = set()
        waiting = list(names)
        while waiting:
            name = waiting.pop()
            if name in self._classes and name not in found:
                found.add(name)
                waiting += (last_name(base.name) for class_ in self._classes[name] for base in class_.bases)
        return found

    def _calls(self, source: Source, function: Function) -> Iterator[syntax.Call]:
        """The calls in a method that look like ones of ROS APIs."""
        names = self._names(source.program.language)
        for node in everything((function.body, function.inits)):
            if (
                isinstance(node, syntax.Call)
                and isinstance(node.callee, (syntax.Name, syntax.Member))
                and node.arguments
            ):
                called = last_name(node.callee.name)
                if called in names.methods or called in names.classes:
                    yield node

    def _names(self, language: str) -> Names:
        if language not in self._called:
            one, two = (names_of(rows(language, ros)) for ros in (1, 2))
            self._called[language] = joined(one, two)
        return self._called[language]


def _names(package: str, type_: str) -> tuple[str, ...]:
    return type_, f"{package}/{type_}", f"{package}::{type_}"


def _listed(items: Iterable[tuple[str, str]]) -> str:
    every = [f"{package}: {base}" for package, base in items]
    more = f"; and {len(every) - MOST} more" if len(every) > MOST else ""
    return "; ".join(every[:MOST]) + more
