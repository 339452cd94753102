# SPDX-License-Identifier: Apache-2.0
"""Sections of parameter files that are for nodes which no launch file starts under that name (ROS 2)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, System, SystemNode, is_slip, listed, regex
from haros_ci.api.launch import NodePattern, ParameterFileUse

#: A section of a parameter file, and so much of one is looked at.
_SECTION = regex(
    r"^[\"']?([\w/*]{1,200})[\"']?:[ \t]*(?:#[^\n]*)?\n(?:[ \t]*(?:#[^\n]*)?\n){0,50}[ \t]+[\"']?ros__parameters[\"']?[ \t]*:",
    re.MULTILINE,
)
_LONG = 100_000
#: What a program of Python has.
_STARTS = regex(r"\A#!|^if[ \t(]+__name__[ \t]*==", re.MULTILINE)


def check(system: System) -> Iterator[Finding]:
    here: dict[str, list[ParameterFileUse]] = {}
    for use in system.facts(ParameterFileUse):
        if use.path is not None and use.is_read:
            here.setdefault(use.path, []).append(use)
    for path, uses in sorted(here.items()):
        unserved = [use for use in uses if _is_unserved(use)]
        if unserved:
            found = list(_of_file(system, unserved, (*uses, *system.whole.parameter_files.get(path, ()))))
            yield from found or _of_others(system, unserved)


def _of_file(system: System, unserved: list[ParameterFileUse], uses: tuple[ParameterFileUse, ...]) -> Iterator[Finding]:
    """The sections that match no process which is given the file, where another process is given it for nothing."""
    if not all(use.is_read for use in uses):
        return
    live = {_key(pattern) for use in uses for pattern in use.patterns if _matches(use, pattern) is not False}
    is_own = len({use.program for use in uses}) == 1
    reported: set[tuple[str, Location]] = set()
    for use in unserved:
        dead = [pattern for pattern in use.patterns if _key(pattern) not in live]
        for node_pattern in dead:
            is_meant = (is_own and len(dead) == 1) or any(
                _is_like(node_pattern.pattern, name) for name in _names(system, use)
            )
            if is_meant and _key(node_pattern) not in reported:
                reported.add(_key(node_pattern))
                node = use.node or f"the node of {'/'.join(use.program)}"
                yield Finding(
                    at=node_pattern.location,
                    message=(
                        f"no node that loads this file has the name of its section {node_pattern.pattern}: {node} "
                        f"{_otherwise(system, use, node_pattern)}"
                    ),
                    about=(node_pattern.pattern, "/".join(use.program)),
                    flow=(
                        (use.location, "the file is loaded here"),
                        (node_pattern.location, "this section has another name"),
                    ),
                    presence=use.presence,
                )


def _of_others(system: System, unserved: list[ParameterFileUse]) -> Iterator[Finding]:
    """Nodes that are given a file for others alone, where the file beside it that is for them is given to nobody of that name."""
    given = system.facts(ParameterFileUse)
    for use in unserved:
        own = [other for other in given if other.node == use.node and other.program == use.program]
        if use.node is None or "?" in use.node or not all(_is_unserved(other) for other in own):
            continue
        meant = _beside(system, use)
        if meant is None or any(other.program == use.program for other in system.whole.parameter_files.get(meant, ())):
            continue
        others = listed([f"{pattern.pattern}" for pattern in use.patterns])
        yield Finding(
            at=use.location,
            message=(
                f"{use.node} is given {use.path}, which is for {others} alone, and gets none of its parameters: {meant} has a section of "
                "that name; write that file"
            ),
            about=(use.node, "/".join(use.program), str(use.path)),
            presence=use.presence,
        )


def _beside(system: System, use: ParameterFileUse) -> str | None:
    """The one parameter file in the directory of the one that is given which has a section for the node; None without one, or with several."""
    folder = str(use.path).rpartition("/")[0]
    if system.workspace is None or use.node is None:
        return None
    found = []
    for path in sorted(system.workspace.names):
        if path.rpartition("/")[0] == folder and path != use.path and path.endswith((".yaml", ".yml")):
            sections = _SECTION.findall(system.workspace.text(path)[:_LONG])
            if any(_fits(section, use.node) for section in sections if "*" not in section):
                found.append(path)
    return found[0] if len(found) == 1 else None


def _key(pattern: NodePattern) -> tuple[str, Location]:
    return pattern.pattern, pattern.location


def _is_unserved(use: ParameterFileUse) -> bool:
    return bool(use.patterns) and all(_matches(use, pattern) is False for pattern in use.patterns)


def _matches(use: ParameterFileUse, pattern: NodePattern) -> bool | None:
    """Whether the section is for a node of the process; None if that is not known.

    The name in a launch file is that of all nodes of a process but those that fix their own name in code: a section
    alone in its file that is called nearly so is meant for it, also of a program that is not in the workspace.
    """
    if pattern.matches is None and use.node and "?" not in use.node and len(use.patterns) == 1:
        if _is_like(pattern.pattern, use.node.rpartition("/")[2]) and not _fits(pattern.pattern, use.node):
            return False
    return pattern.matches


def _fits(pattern: str, name: str) -> bool:
    """Whether the key of a section is for the node of that full name (rcl_yaml_param_parser, namespace.c; rcl/wildcards)."""
    parts = re.split(r"(/\*\*|/\*)", f"/{pattern.lstrip('/')}")
    return re.fullmatch("".join(_WILD.get(part) or re.escape(part) for part in parts), name) is not None


_WILD = {"/**": r"(?:/[^/]+)*", "/*": r"/[^/]+"}


def _otherwise(system: System, use: ParameterFileUse, section: NodePattern) -> str:
    """How the node is called, and what to write: a section without a namespace is for the node in the namespace / alone."""
    pattern = section.pattern
    if _reads_none(system, use, section):
        return f"is called otherwise, and declares none of these parameters; start {pattern} with this file, or take the file from {use.node or 'it'}"
    name = pattern.strip("/")
    if script := _script(system, use, name):
        return f"is another program than {script}, and gets none of these parameters; start {script} with this file, or take the file from {use.node or 'it'}"
    if use.node and name == use.node.rpartition("/")[2]:
        return f"is in a namespace, so it gets none of these parameters; write /**/{name} (or {use.node}) here"
    return f"is called otherwise, so it gets none of these parameters; write {_right(use)} or /** here, or name the node {pattern}"


def _reads_none(system: System, use: ParameterFileUse, section: NodePattern) -> bool:
    """Whether no node of the process has any of the parameters of the *section*."""
    nodes = _nodes(system, use)
    return (
        bool(nodes and section.keys)
        and "?" not in "".join(section.keys)
        and all(node.names.has(key) is False for node in nodes for key in section.keys)
    )


def _script(system: System, use: ParameterFileUse, name: str) -> str:
    """The script of the node's package that is called like the section, and that is no file of the node; "" if there is none."""
    folders = [package.path for package in system.packages.values() if package.name == use.program[0]]
    places = {end.location.path for node in _nodes(system, use) for end in node.ends if end.in_source}
    if system.workspace is None or len(folders) != 1 or not places or use.program[1].removesuffix(".py") == name:
        return ""
    inside = "" if folders[0] == "." else f"{folders[0]}/"
    named = [path for path in system.workspace.names if path.startswith(inside) and path.endswith(f"/{name}.py")]
    if len(named) != 1 or named[0] in places or not _STARTS.search(system.workspace.text(named[0])):
        return ""
    return named[0].rpartition("/")[2]


def _nodes(system: System, use: ParameterFileUse) -> list[SystemNode]:
    """The nodes of the process that is given the file."""
    program = "/".join(use.program)
    return [node for node in system.nodes if node.type == program and use.node in (None, node.name)]


def _right(use: ParameterFileUse) -> str:
    return use.node.lstrip("/") if use.node else "its name"


def _names(system: System, use: ParameterFileUse) -> set[str]:
    """What the node is called, here and in other systems, and its program."""
    program = "/".join(use.program)
    names = {use.program[1].rpartition("::")[2].removesuffix(".py")}
    if use.node:
        names.add(use.node.rpartition("/")[2])
    names.update(node.name.rpartition("/")[2] for node in system.nodes if node.type == program)
    return {name for name in names | system.whole.names.get(program, frozenset()) if "?" not in name}


def _is_like(pattern: str, name: str) -> bool:
    last = pattern.rpartition("/")[2]
    shorter, longer = sorted((last, name), key=len)
    return last == name or is_slip(last, name) or (len(shorter) > 4 and longer.startswith(shorter))


CHECK = Check(
    id="parameter-section-unmatched",
    summary="Section of a parameter file that matches no node.",
    level=Level.WARNING,
    catalogue="P07",
    tags=("parameters", "launch"),
    run=check,
)
