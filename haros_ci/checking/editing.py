# SPDX-License-Identifier: Apache-2.0
"""Edits that fixes are made of: whole lines added or dropped, beside their like and indented as they are."""

from __future__ import annotations

import re

from haros_ci.checking.project import ProjectPackage
from haros_ci.results.fix import Edit, Fix

#: The tags that a manifest lists in this order (REP 149).
ORDER = (
    "buildtool_depend", "buildtool_export_depend", "build_depend", "build_export_depend", "depend", "run_depend", "exec_depend",
    "doc_depend", "test_depend", "conflict", "replace", "group_depend", "member_of_group", "export",
)  # fmt: skip


def insert_line(path: str, text: str, number: int, line: str) -> Edit:
    """*line* (without its end) as a line of its own before the line *number* of *text*, ended as the others are."""
    lines = text.splitlines(keepends=True)
    end = "\r\n" if lines and lines[0].endswith("\r\n") else "\n"
    before = "" if number <= len(lines) or not lines or lines[-1].endswith(("\n", "\r")) else end
    if before:
        return Edit(path, (len(lines), len(lines[-1]) + 1), (len(lines), len(lines[-1]) + 1), before + line)
    return Edit(path, (number, 1), (number, 1), line + end)


def drop_lines(path: str, first: int, last: int) -> Edit:
    """Without the lines *first* to *last*."""
    return Edit(path, (first, 1), (last + 1, 1), "")


def add_element(package: ProjectPackage, tag: str, text: str, description: str) -> Fix | None:
    """``<tag>text</tag>`` in the manifest, after the last of its like, else where the order of tags has it.

    None where an element shares its line with another one, so that no line is certain.
    """
    root = package.manifest
    source = package.project.text(package.manifest_path)
    if root is None or not source:
        return None
    lines = source.splitlines()
    rank = ORDER.index(tag) if tag in ORDER else len(ORDER)
    earlier = [child for child in root.children if child.tag not in ORDER or ORDER.index(child.tag) <= rank]
    like = [child for child in earlier if child.tag == tag] or [child for child in earlier if child.tag in ORDER]
    after = (like or earlier)[-1:]
    if not after:
        return None
    start = after[0].line
    end = _end(lines, start, after[0].tag)
    if end is None:
        return None
    indentation = re.match(r"\s*", lines[start - 1])
    line = f"{indentation[0] if indentation else ''}<{tag}>{text}</{tag}>"
    return Fix(description, (insert_line(package.manifest_path, source, end + 1, line),))


def add_dependency(package: ProjectPackage, kind: str, name: str) -> Fix | None:
    """``<kind>name</kind>`` in the manifest of *package*; None where its place is not certain.

    In format 1 there are only build_depend, run_depend and test_depend (REP 127): ``depend`` becomes the first two.
    """
    description = f"declare {name}"
    if package.raw.format >= 2:
        return add_element(package, kind, name, description)
    kinds = {"depend": ("build_depend", "run_depend"), "exec_depend": ("run_depend",)}.get(kind, (kind,))
    parts = [add_element(package, each, name, description) for each in kinds]
    edits = tuple(edit for part in parts if part is not None for edit in part.edits)
    return Fix(description, edits) if len(edits) == len(kinds) else None


def _end(lines: list[str], start: int, tag: str) -> int | None:
    """The line that the element of *tag* at the line *start* ends in, if nothing else stands on its lines."""
    pattern = re.compile(
        rf"\s*<{re.escape(tag)}\b[^<>]*?(?:/>|>[^<]*</{re.escape(tag)}\s*>)\s*(?:<!--.*?-->\s*)?\Z", re.S
    )
    opening = re.compile(rf"\s*<{re.escape(tag)}\b")
    if start > len(lines) or not opening.match(lines[start - 1]):
        return None
    for last in range(start, min(start + 20, len(lines)) + 1):
        if pattern.match("\n".join(lines[start - 1 : last])):
            return last
    return None
