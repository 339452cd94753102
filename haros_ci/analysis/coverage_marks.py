# SPDX-License-Identifier: Apache-2.0
"""Nodes that may have more than the model says: code that they run has calls of ROS APIs which the model does not account for."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from haros_ci.analysis.coverage import Calls, CoverageJudge, judging
from haros_ci.analysis.coverage_nodes import NOT_IN, Users, type_name
from haros_ci.code.codebase import Routine
from haros_ci.config.settings import Settings
from haros_ci.coverage import judge
from haros_ci.coverage.judge import Places, Seen, Syntax, TextSite
from haros_ci.coverage.pieces import last_name
from haros_ci.coverage.search import shown
from haros_ci.model.architecture import Architecture, Configuration, Node, Unknown
from haros_ci.model.coverage import PRODUCTION
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.rates.runs import FRAMEWORK, STARTS, outside_caller
from haros_ci.systems.link import Linked
from haros_ci.timing import timed

#: Calls that are named at one node.
MOST = 20
#: Functions that run without being named.
BY_THEMSELVES = frozenset(("constructor", "destructor", "lambda", "module"))
#: A function that is called on an object, by its name alone, or given away; no definition or declaration, which has a type before the name.
_USED_CPP = (
    r"(?:\.|->)\s?NAME\b|&\s?(?:\w{1,80}::){0,9}NAME\b|(?:[;{}(,=!&|?:]|\breturn\b|\belse\b)\s{0,80}NAME\s?\("
    r"|[(,=]\s?(?:\w{1,80}::){0,9}NAME\s?[,;)]"
)
_USED_PYTHON = r"\.NAME\b|(?<!\bdef )(?<![.\w])NAME\b(?!\s?=[^=])"

Marks = Mapping[str, tuple[Unknown, ...]]


@timed("coverage")
def marked(made: Linked, workspace: Workspace, settings: Settings, calls: Calls | None = None) -> Linked:
    """*made* with an unknown ``endpoints`` at every node that a call may belong to which the model does not account for.

    Those are calls in a function that makes endpoints of the node, or in another method of a class of which one does, unless nothing names
    it. *calls* has, and gets, what is found in the text of files.
    """
    marks = _marks(made, workspace, settings, calls)
    if not marks:
        return made

    def under(name: str, arguments: Mapping[str, str]) -> Configuration | None:
        found = made.under(name, arguments)
        return None if found is None else _configuration(found, marks)

    configurations = tuple(_configuration(one, marks) for one in made.architecture.configurations)
    whole: Architecture = replace(made.architecture, configurations=configurations)
    return replace(made, architecture=whole, under=under)


def _marks(made: Linked, workspace: Workspace, settings: Settings, calls: Calls | None) -> Marks:
    """What is unknown of each node type."""
    coverage = judging(made, workspace, settings, calls)
    users = Users(made.architecture, made.sources, within=True)
    places = coverage.places()
    pending = [site for site in coverage.found(users.paths) if not places.has(site)]
    area = coverage.areas()
    marks: dict[str, list[Unknown]] = {}
    where = Syntax(coverage.code)
    for site, names in _of_nodes(pending, users):
        if all(len(marks.get(name, ())) >= MOST for name in names):
            continue
        if area(site.source) != PRODUCTION or not _is_missing(coverage, where, site, places):
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


def _is_missing(asked: CoverageJudge, where: Syntax, site: TextSite, places: Places) -> bool:
    """Whether a site that stands at no endpoint may be a call of a ROS API whose endpoint is not at the caller's place."""
    code = asked.code
    placed = where.of(site)
    if placed is not None:
        name = last_name(placed[0].method.function.name)
        if name in judge.WRAPPERS:
            return False
        key = ("is used", id(placed[0].method.function))
        if key not in code.kept:
            code.kept[key] = _is_used(asked, placed[0].method, name)
        if not code.kept[key]:
            return False
    return judge.other(code, where, site, Seen(places, {}, {})) is None


def _is_used(asked: CoverageJudge, routine: Routine, name: str) -> bool:
    """Whether something runs a function by itself, or some text beside its definitions names it as one calls a function or gives it away.

    The text is asked, as the call graph of a large workspace costs more than all else that a run does with what it has kept.
    """
    function = routine.function
    if function.kind in BY_THEMSELVES or name in (*FRAMEWORK, *STARTS, "main") or name.startswith("__"):
        return True
    if outside_caller(asked.code, routine, name):
        return True
    used = re.compile((_USED_PYTHON if routine.is_python else _USED_CPP).replace("NAME", re.escape(name)))
    files = (asked.code.by_path[path] for path in sorted(asked.code.mentioning(name)))
    return any(used.search(asked.text(source)) is not None for source in files)


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
