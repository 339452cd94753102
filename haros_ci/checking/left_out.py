# SPDX-License-Identifier: Apache-2.0
"""Nodes that a launch file in Python still names since a change, and does not start any more; and classes that a decorator may have replaced."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from haros_ci.checking.changed import both
from haros_ci.checking.project import Project
from haros_ci.checking.system import SystemNode
from haros_ci.model.architecture import Unknown
from haros_ci.model.location import Location
from haros_ci.regex import regex

#: A text or a remark of Python; of a remark nothing is in the group.
_TEXT = regex(r"#[^\n]*|(?P<mark>['\"])(?P<text>[^'\"\\\n]*)(?P=mark)")
_OF_A_CLASS = regex(r"what the decorator .* makes of the class ")


def left_out(project: Project) -> Iterator[tuple[Location, SystemNode]]:
    """Where the launch file names the program of a node that it started at the base, and starts it under no launch arguments now."""
    named: dict[tuple[bool, str], tuple[Counter[str], dict[str, int]]] = {}
    for old, new in both(project):
        there = Counter(node.type for node in new.nodes)
        gone = Counter(node.type for node in old.nodes) - there
        names = {node.name for node in new.nodes}
        for node in old.nodes:
            path = project.renames.get(node.location.path, node.location.path)
            if not node.is_launched or not path.endswith(".py") or not gone[node.type] or node.name in names:
                continue
            if project.base is None or project.text(path) == project.base.text(node.location.path):
                continue
            before = named.setdefault((True, path), _texts(project.base.text(node.location.path)))
            now = named.setdefault((False, path), _texts(project.text(path)))
            if 0 < before[0][node.raw.type] <= now[0][node.raw.type]:
                yield Location(path, now[1][node.raw.type]), node


def replaced(project: Project) -> Iterator[tuple[SystemNode, Unknown]]:
    """Nodes of which a class has a decorator since a change that may make another class of it."""
    for old, new in both(project):
        before = {node.name: node for node in old.nodes}
        for node in new.nodes:
            was = before.get(node.name)
            known = {unknown.reason for unknown in was.raw.unknowns} if was is not None else set()
            for unknown in node.raw.unknowns:
                if was is not None and unknown.reason not in known and _OF_A_CLASS.match(unknown.reason):
                    yield node, unknown


def _texts(code: str) -> tuple[Counter[str], dict[str, int]]:
    """How often each text in one line stands in Python *code*, and the line where it does first."""
    count: Counter[str] = Counter()
    lines: dict[str, int] = {}
    line, last = 1, 0
    for match in _TEXT.finditer(code):
        if match["mark"]:
            line, last = line + code.count("\n", last, match.start()), match.start()
            count[match["text"]] += 1
            lines.setdefault(match["text"], line)
    return count, lines
