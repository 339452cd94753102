# SPDX-License-Identifier: Apache-2.0
"""Edits that fixes are made of: lines and elements added, changed or dropped, beside their like and indented as they are."""

from __future__ import annotations

import re

from haros_ci.checking.outline import Outline, Span
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.worlds import condition_on
from haros_ci.model.element import Element
from haros_ci.results.fix import Edit, Fix

#: The tags that a manifest lists in this order (REP 149).
ORDER = (
    "name", "version", "description", "maintainer", "license", "url", "author",
    "buildtool_depend", "buildtool_export_depend", "build_depend", "build_export_depend", "depend", "run_depend", "exec_depend",
    "doc_depend", "test_depend", "conflict", "replace", "group_depend", "member_of_group", "export",
)  # fmt: skip


#: Lines that go in; one that begins with a tabulator stands one level deeper.
Lines = tuple[str, ...]


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


def add_element(package: ProjectPackage, tag: str, text: str, description: str, condition: str = "") -> Fix | None:
    """``<tag>text</tag>`` in the manifest: among its like, in the order of the alphabet if they are, else where REP 149 has it.

    It gets a line of its own unless its neighbour shares one, and the *condition*, if there is one. None if the manifest cannot be edited.
    """
    outline, root = _outline(package), package.manifest
    if outline is None or root is None:
        return None
    edit = _beside(outline, root, tag, (_tag(tag, escaped(text), condition),), text)
    return Fix(description, (edit,)) if edit is not None else None


def add_export(package: ProjectPackage, tag: str, text: str, description: str) -> Fix | None:
    """``<tag>text</tag>`` in the export section of the manifest, which is made if there is none."""
    outline, root = _outline(package), package.manifest
    if outline is None or root is None:
        return None
    new = (f"<{tag}>{escaped(text)}</{tag}>",)
    exports = [child for child in root.children if child.tag == "export"]
    if not exports:
        edit = _beside(outline, root, "export", ("<export>", "\t" + new[0], "</export>"), "")
    elif exports[0].children:
        first = outline.span(exports[0].children[0])
        edit = _before(outline, first, new) if first is not None else None
    else:
        edit = _fill(outline, outline.span(exports[0]), new)
    return Fix(description, (edit,)) if edit is not None else None


def add_dependency(package: ProjectPackage, kind: str, name: str) -> Fix | None:
    """``<kind>name</kind>`` in the manifest of *package*; None where that cannot be written.

    In format 1 there are only build_depend, buildtool_depend, run_depend and test_depend (REP 127): ``depend`` becomes
    build_depend and run_depend, the kinds that run or are exported become run_depend. What is there already is not
    written again.
    """
    description = f"declare {name}"
    kinds: tuple[str, ...] = (kind,)
    if package.raw.format < 2:
        kinds = _FORMAT_1.get(kind, (kind,))
    condition = _condition(package, name)
    there = {
        dependency.kind
        for dependency in package.raw.dependencies
        if dependency.name == name and dependency.condition is None
    }
    parts = [add_element(package, item, name, description, condition) for item in kinds if item not in there]
    edits = tuple(edit for part in parts if part is not None for edit in part.edits)
    return Fix(description, edits) if edits and None not in parts else None


def dependency_tags(package: ProjectPackage, kind: str, name: str) -> str:
    """The tags that :func:`add_dependency` writes, as a message shows them: in format 1 ``depend`` is two.

    What only one ROS has gets a condition where the manifest has such (REP 149).
    """
    kinds = _FORMAT_1.get(kind, (kind,)) if package.raw.format < 2 else (kind,)
    return " and ".join(_tag(item, name, _condition(package, name)) for item in kinds)


def _condition(package: ProjectPackage, name: str) -> str:
    return condition_on(name, package.raw, package.project.manifests)


def _tag(tag: str, content: str, condition: str) -> str:
    attribute = f' condition="{condition}"' if condition else ""
    return f"<{tag}{attribute}>{content}</{tag}>"


def rename_element(package: ProjectPackage, element: Element, tag: str, description: str) -> Fix | None:
    """*element* of the manifest becomes one of *tag*, its attributes and content as they are."""
    outline = _outline(package)
    span = outline.span(element) if outline is not None else None
    if outline is None or span is None:
        return None
    places = [span.name] + ([span.closing] if span.closing is not None else [])
    return Fix(description, tuple(outline.edit(at, at + len(span.tag), tag) for at in places))


def drop_element(package: ProjectPackage, element: Element, description: str) -> Fix | None:
    """The manifest without *element*, and without its lines if nothing else stands on them."""
    outline = _outline(package)
    span = outline.span(element) if outline is not None else None
    if outline is None or span is None:
        return None
    start, end = span.start, span.end
    indentation, after = outline.indentation(span), outline.line_end(span.end)
    if indentation is not None and after is not None and not outline.text[span.end : after].strip():
        start, end = span.start - len(indentation), after
    return Fix(description, (outline.edit(start, end, ""),))


def set_text(package: ProjectPackage, element: Element, text: str, description: str) -> Fix | None:
    """The content of *element* of the manifest becomes *text*."""
    outline = _outline(package)
    span = outline.span(element) if outline is not None else None
    if outline is None or span is None or span.closing is None or span.children:
        return None
    return Fix(description, (outline.edit(span.open, span.close, escaped(text)),))


def set_attribute(package: ProjectPackage, element: Element, name: str, value: str, description: str) -> Fix | None:
    """The attribute *name* of *element* of the manifest becomes *value*; it is added if it is not there."""
    outline = _outline(package)
    span = outline.span(element) if outline is not None else None
    if outline is None or span is None:
        return None
    tag = outline.text[span.start : span.open]
    match = re.search(rf"""(\s{re.escape(name)}\s*=\s*)("[^"]*"|'[^']*')""", tag)
    quoted = f'"{escaped(value)}"'
    if match is not None:
        return Fix(description, (outline.edit(span.start + match.start(2), span.start + match.end(2), quoted),))
    return Fix(description, (outline.insert(span.name + len(span.tag), f" {name}={quoted}"),))


def escaped(text: str) -> str:
    """*text* as the content of an element."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


#: What the kinds of formats 2 and 3 are in format 1.
_FORMAT_1 = {
    "depend": ("build_depend", "run_depend"),
    "exec_depend": ("run_depend",),
    "build_export_depend": ("run_depend",),
    "buildtool_export_depend": ("run_depend",),
    "doc_depend": ("build_depend",),
}


def _outline(package: ProjectPackage) -> Outline | None:
    root, text = package.manifest, package.project.text(package.manifest_path)
    if root is None or not text:
        return None
    outline = Outline(package.manifest_path, text, root)
    return outline if outline.span(root) is not None else None


def _beside(outline: Outline, root: Element, tag: str, new: Lines, text: str) -> Edit | None:
    """*new* after its neighbour among the children of *root*."""
    rank = ORDER.index(tag) if tag in ORDER else len(ORDER)
    like = [child for child in root.children if child.tag == tag]
    if like:
        words = [" ".join(child.text.split()) for child in like]
        before = [child for child, word in zip(like, words) if word <= text] if words == sorted(words) else like
        if not before:
            first = outline.span(like[0])
            return _before(outline, first, new) if first is not None else None
        neighbour = before[-1]
    else:
        ranked = [child for child in root.children if child.tag in ORDER]
        earlier = [child for child in ranked if ORDER.index(child.tag) < rank]
        if not earlier:
            span = outline.span(root)
            if span is None:
                return None
            first = outline.span(root.children[0]) if root.children else None
            return _before(outline, first, new) if first is not None else _fill(outline, span, new)
        neighbour = max(earlier, key=lambda child: ORDER.index(child.tag) * len(ranked) + ranked.index(child))
    span = outline.span(neighbour)
    if span is None:
        return None
    after = outline.line_end(span.end)
    indentation = outline.indentation(span)
    if after is None or indentation is None:
        return outline.insert(span.end, _laid(new, None, outline))
    return outline.insert(after, indentation + _laid(new, indentation, outline) + outline.newline)


def _before(outline: Outline, span: Span, new: Lines) -> Edit:
    indentation = outline.indentation(span)
    if indentation is None:
        return outline.insert(span.start, _laid(new, None, outline))
    return outline.insert(span.start, _laid(new, indentation, outline) + outline.newline + indentation)


def _fill(outline: Outline, span: Span | None, new: Lines) -> Edit | None:
    """*new* as the only child of an element that has none."""
    if span is None:
        return None
    indentation = outline.indentation(span) or ""
    line = outline.newline + indentation
    laid = line + _step(indentation) + _laid(new, indentation + _step(indentation), outline)
    if span.closing is None:
        slash = outline.text.rindex("/", span.start, span.end)
        return outline.edit(slash, span.end, f">{laid}{line}</{span.tag}>")
    if outline.text[span.open : span.close].strip():
        return outline.insert(span.open, laid)
    return outline.edit(span.open, span.close, laid + line)


def _laid(new: Lines, indentation: str | None, outline: Outline) -> str:
    """*new* with its further lines indented, or all on one line."""
    if indentation is None:
        return "".join(line.lstrip("\t") for line in new)
    step = _step(indentation)
    return (outline.newline + indentation).join(line.replace("\t", step, 1) for line in new)


def _step(indentation: str) -> str:
    return indentation or "  "
