# SPDX-License-Identifier: Apache-2.0
"""Nodes that may have more than the model says: code that they run has calls of ROS APIs which the model does not account for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from haros_ci.analysis.coverage import NOT_IN, CoverageJudge, judging
from haros_ci.analysis.coverage_nodes import Users, type_name
from haros_ci.code.codebase import Codebase, codebase
from haros_ci.config.settings import Settings
from haros_ci.coverage import judge
from haros_ci.coverage.judge import Places, Seen, Syntax, TextSite
from haros_ci.coverage.pieces import last_name
from haros_ci.coverage.search import shown
from haros_ci.model.architecture import Architecture, Configuration, Node, Unknown
from haros_ci.model.coverage import PRODUCTION
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.rates.runs import UNCALLED, runs
from haros_ci.systems.link import Linked
from haros_ci.timing import timed

#: Calls that are named at one node.
MOST = 20

Marks = Mapping[str, tuple[Unknown, ...]]


@timed("coverage")
def marked(made: Linked, workspace: Workspace, settings: Settings) -> Linked:
    """*made* with an unknown ``endpoints`` at every node that a call may belong to which the model does not account for.

    Those are calls in a function that makes endpoints of the node, or in another method of a class of which one does, unless nothing is seen
    to call it.
    """
    ros = {package.name: package.ros for package in workspace.packages if package.ros is not None}
    code = codebase(made.sources, workspace.text, ros)
    marks = _marks(made, workspace, settings, code)
    if not marks:
        return made

    def under(name: str, arguments: Mapping[str, str]) -> Configuration | None:
        found = made.under(name, arguments)
        return None if found is None else _configuration(found, marks)

    configurations = tuple(_configuration(one, marks) for one in made.architecture.configurations)
    whole: Architecture = replace(made.architecture, configurations=configurations)
    return replace(made, architecture=whole, under=under)


def _marks(made: Linked, workspace: Workspace, settings: Settings, code: Codebase) -> Marks:
    """What is unknown of each node type."""
    coverage = judging(made, workspace, settings, code)
    found = coverage.found()
    places = coverage.places()
    pending = [site for site in found if not places.has(site)]
    if not pending:
        return {}
    users = Users(made.architecture, code.sources, within=True)
    area = coverage.areas()
    marks: dict[str, list[Unknown]] = {}
    for site, names in _of_nodes(pending, users):
        if area(site.source) != PRODUCTION or not _is_missing(coverage, site, places):
            continue
        reason = f"{shown(workspace.text(site.source.path), site.call)}{NOT_IN}"
        unknown = Unknown("endpoints", reason, Location(site.source.path, site.start_line, site.start_column))
        for name in names:
            marks.setdefault(name, []).append(unknown)
    return {name: tuple(ones[:MOST]) for name, ones in marks.items()}


def _of_nodes(pending: list[TextSite], users: Users) -> Iterator[tuple[TextSite, tuple[str, ...]]]:
    """The sites that may belong to nodes, with their types."""
    for site in pending:
        names = users.of(site.source.path, site.line)
        if names:
            yield site, names


def _is_missing(asked: CoverageJudge, site: TextSite, places: Places) -> bool:
    """Whether a site that stands at no endpoint may be a call of a ROS API whose endpoint is not at the caller's place."""
    code = asked.code
    where = Syntax(code)
    placed = where.of(site)
    if placed is not None:
        name = last_name(placed[0].method.function.name)
        if name in judge.WRAPPERS or runs(code, placed[0]).reason == UNCALLED:
            return False
    return judge.other(code, where, site, Seen(places, {}, {})) is None


def _configuration(found: Configuration, marks: Marks) -> Configuration:
    return replace(
        found,
        nodes=tuple(_node(node, marks) for node in found.nodes),
        alternatives=tuple(_node(node, marks) for node in found.alternatives),
    )


def _node(node: Node, marks: Marks) -> Node:
    own = marks.get(type_name(node))
    return (
        node if own is None else replace(node, unknowns=(*node.unknowns, *(u for u in own if u not in node.unknowns)))
    )
