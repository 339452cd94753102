# SPDX-License-Identifier: Apache-2.0
"""Manifests that are XML and have a name, and that catkin and colcon refuse or do not understand as they are meant."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, Project, ProjectPackage, is_slip, regex
from haros_ci.api.packages import Element, drop_element, needs, place, rename_element, set_attribute, word

VERSIONS = ("version_lt", "version_lte", "version_eq", "version_gte", "version_gt")
#: The tags of each format with their attributes (REP 127, 140, 149).
OF_ALL: dict[str, tuple[str, ...]] = {
    "name": (),
    "version": ("compatibility",),
    "description": (),
    "maintainer": ("email",),
    "license": (),
    "url": ("type",),
    "author": ("email",),
    "export": (),
    **dict.fromkeys(("build_depend", "buildtool_depend", "test_depend", "conflict", "replace"), VERSIONS),
}
OF_2 = dict.fromkeys(
    ("build_export_depend", "buildtool_export_depend", "depend", "exec_depend", "doc_depend"), VERSIONS
)
OF_3: dict[str, tuple[str, ...]] = {"group_depend": (), "member_of_group": ()}
#: What stands in the export section (REP 127, 149 and common plug-ins): it does nothing beside it.
OF_EXPORT = ("build_type", "metapackage", "architecture_independent", "deprecated", "message_generator")
EMAIL = regex(r"[-\w%+]+(?:\.[-\w%+]+)*@[-a-zA-Z0-9%]+(?:\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}", re.A)
VERSION = regex(r"[0-9]+\.[0-9]+\.[0-9]+")
PLACEHOLDER = regex(r"[@{}]|\$\(|%\(|<%")


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        root = package.manifest
        if root is not None and root.tag == "package" and not _is_template(root):
            for part in (_required, _tags, _dependencies, _metapackage, _plugins):
                yield from part(package, root)


def _is_template(root: Element) -> bool:
    """Whether something is still to be filled in: ``@NAME@``, ``{{ name }}``."""
    return any(PLACEHOLDER.search(word(element)) for element in root.all("name", "version"))


def known_tags(format: int) -> dict[str, tuple[str, ...]]:
    """The tags that a manifest of this format may have, and their attributes."""
    if format == 1:
        return {**OF_ALL, "run_depend": VERSIONS}
    tags = {**OF_ALL, **OF_2}
    if format == 2:
        return tags
    tags |= OF_3
    with_condition = {tag: (*names, "condition") for tag, names in tags.items() if "depend" in tag}
    others: dict[str, tuple[str, ...]] = {"member_of_group": ("condition",), "license": ("file",)}
    others |= dict.fromkeys(("conflict", "replace"), (*VERSIONS, "condition"))
    return {**tags, **with_condition, **others}


def _required(package: ProjectPackage, root: Element) -> Iterator[Finding]:
    """What every manifest has to say, once or at least once."""
    count = Counter(child.tag for child in root.children)
    for tag in ("name", "version", "description"):
        if count[tag] != 1:
            second = [*root.all(tag)][1:2]
            times = "twice" if count[tag] == 2 else f"{count[tag]} times" if count[tag] else "not at all"
            what = f"<{tag}> occurs {times}, but must occur exactly once"
            yield _finding(package, second[0] if second else None, what, tag)
    for tag in ("maintainer", "license"):
        if not count[tag]:
            yield _finding(package, None, f"<{tag}> is missing, but required", tag)
    if count["export"] > 1:
        yield _finding(package, list(root.all("export"))[1], "it has more than one <export>; merge them", "export")
    for element in root.all("version"):
        if VERSION.fullmatch(word(element)) is None:
            yield _finding(
                package,
                element,
                f"the version {word(element)!r} does not consist of three numbers; write for example 1.2.3",
                "version",
            )
    for element in root.all("description", "license"):
        if not word(element) and not element.children:
            yield _finding(package, element, f"<{element.tag}> is empty; fill it in, or remove it", element.tag)
    for element in root.all("maintainer", "author"):
        email = element.attributes.get("email")
        if email is None and element.tag == "maintainer":
            yield _finding(
                package, element, f"maintainer {word(element)} has no email attribute; add it", f"email {word(element)}"
            )
        elif email is not None and EMAIL.fullmatch(email) is None:
            yield _finding(package, element, f"{email!r} is not an email address; write one", f"email {word(element)}")


def _tags(package: ProjectPackage, root: Element) -> Iterator[Finding]:
    """Tags and attributes that the format does not have; each tag once."""
    known = known_tags(package.raw.format)
    reported: set[str] = set()
    for child in root.children:
        if child.tag not in known:
            if child.tag not in reported:
                reported.add(child.tag)
                yield _unknown(package, root, child, known)
            continue
        if child.tag not in ("description", "export") and child.children:
            inner = child.children[0]
            what = f"<{child.tag}> contains <{inner.tag}>, but may contain text only"
            yield _finding(package, inner, what, f"{child.tag} {inner.tag}")
        odd = [n for n in child.attributes if n not in known[child.tag] and n != "xmlns" and ":" not in n]
        if odd:
            older = package.raw.format < 3 and set(odd) <= {"condition", "file"}
            why = (
                f"which format {package.raw.format} does not define; use format 3"
                if older
                else "which no tool reads; remove it"
            )
            fixes = _newer(package, root, 3) if older else ()
            yield _finding(
                package, child, f"<{child.tag}> has the attribute {odd[0]}, {why}", f"{child.tag} {odd[0]}", fixes
            )


def _unknown(package: ProjectPackage, root: Element, child: Element, known: dict[str, tuple[str, ...]]) -> Finding:
    tag, format = child.tag, package.raw.format
    fixes: tuple[Fix, ...] = ()
    if tag == "run_depend":
        advice, fixes = "write exec_depend, its name since format 2", _renamed(package, root, tag, "exec_depend")
    elif tag == "exec_depend" and format == 1:
        advice, fixes = "write run_depend, its name in format 1", _renamed(package, root, tag, "run_depend")
    elif tag in OF_2 or tag in OF_3:
        least = 2 if tag in OF_2 else 3
        advice, fixes = f"use format {least}", _newer(package, root, least)
    elif tag in OF_EXPORT:
        advice = "move it into <export>"
    else:
        near = next((name for name in known if is_slip(tag, name)), None)
        advice = "no tool reads it; remove it" if near is None else f"write {near}"
        fixes = _renamed(package, root, tag, near) if near is not None and "depend" in near else ()
    return _finding(package, child, f"format {format} has no <{tag}>: {advice}", f"<{tag}>", fixes)


def _renamed(package: ProjectPackage, root: Element, tag: str, name: str) -> tuple[Fix, ...]:
    """All elements of *tag* become ones of *name*."""
    text = f"rename {tag} to {name}"
    parts = [rename_element(package, element, name, text) for element in root.all(tag)]
    edits = tuple(edit for part in parts if part is not None for edit in part.edits)
    return (Fix(text, edits),) if None not in parts else ()


def _newer(package: ProjectPackage, root: Element, format: int) -> tuple[Fix, ...]:
    """The manifest in a newer format; from format 1 only where nothing in it is of format 1 alone."""
    if package.raw.format == 1 and any(root.all("run_depend")):
        return ()
    fix = set_attribute(package, root, "format", str(format), f"make it a manifest of format {format}")
    return () if fix is None else (fix,)


def _dependencies(package: ProjectPackage, root: Element) -> Iterator[Finding]:
    """Dependencies on itself, and those that another one contains."""
    for child in root.children:
        if child.tag.endswith("_depend") or child.tag == "depend":
            if word(child) == package.name and child.tag != "group_depend":
                fix = drop_element(package, child, f"drop the dependency on {package.name}")
                what = f"the package declares a <{child.tag}> on itself; remove it"
                yield _finding(package, child, what, f"{child.tag} itself", () if fix is None else (fix,))
    whole = "test_depend" if package.raw.format == 1 else "depend"
    parts = (
        ["build_depend", "run_depend"]
        if whole == "test_depend"
        else ["build_depend", "build_export_depend", "exec_depend"]
    )
    wider: dict[tuple[str | None, ...], Element] = {}
    again: dict[tuple[str | None, ...], list[Element]] = {}
    for element in root.all(whole):
        if wider.setdefault(_key(element), element) is not element and whole == "depend":
            again.setdefault(_key(element), []).append(element)
    for key, others in again.items():
        if word(others[0]) != package.name:
            yield _twice(package, wider[key], others)
    for child in root.all(*parts):
        other = wider.get(_key(child))
        if other is None or word(child) == package.name:
            continue
        superfluous = child if package.raw.format > 1 else other
        fix = drop_element(package, superfluous, f"drop the {superfluous.tag} on {word(child)}")
        yield _finding(
            package,
            superfluous,
            f"<{superfluous.tag}> on {word(child)} repeats <{(other if superfluous is child else child).tag}>; remove it",
            f"{superfluous.tag} {word(child)}",
            () if fix is None else (fix,),
        )


def _metapackage(package: ProjectPackage, root: Element) -> Iterator[Finding]:
    """A metapackage of ROS 1 has dependencies of packages that run alone (REP 127)."""
    if package.ros != 1 or not package.raw.is_metapackage:
        return
    for need in needs(package, "build_depend", "depend", "test_depend"):
        run = "run_depend" if package.raw.format == 1 else "exec_depend"
        yield Finding(
            at=place(package, need),
            message=f"the metapackage {package} has a <{need.kind}> on {need.name}, but may have <{run}> only",
            about=(package.name, f"{need.kind} {need.name} of a metapackage"),
            level=Level.WARNING,
            apart=(need.kind, need.name),
        )


def _key(element: Element) -> tuple[str | None, ...]:
    """What makes two dependencies the same for catkin_pkg: all but the tag, conditions as they are written."""
    return word(element), *(element.attributes.get(name) for name in (*VERSIONS, "condition"))


def _twice(package: ProjectPackage, first: Element, others: list[Element]) -> Finding:
    """*others* repeat the <depend> *first*, which catkin_pkg calls redundant with all that it stands for."""
    name = word(first)
    parts = [drop_element(package, other, f"drop the second <depend> on {name}") for other in others]
    edits = tuple(edit for part in parts if part is not None for edit in part.edits)
    fixes = (Fix(f"drop the second <depend> on {name}", edits),) if None not in parts else ()
    what = f"<depend> on {name} repeats that of line {place(package, first).line}; remove it"
    return _finding(package, others[0], what, f"depend {name}", fixes)


def _plugins(package: ProjectPackage, root: Element) -> Iterator[Finding]:
    """In ROS 1 the path of an exported plug-in description is taken as it is."""
    if package.ros != 1:
        return
    for export in root.all("export"):
        for child in export.children:
            path = child.attributes.get("plugin", "")
            if path.endswith(".xml") and not path.startswith(("${prefix}", "/", "$(")):
                fix = set_attribute(package, child, "plugin", "${prefix}/" + path, "write the path from the package")
                yield Finding(
                    at=place(package, child),
                    message=f"the plug-in description {path} for {child.tag} is a relative path, so it is searched for in the current "
                    f"directory of the process; write ${{prefix}}/{path}",
                    about=(package.name, f"plugin {child.tag} {path}"),
                    fixes=() if fix is None else (fix,),
                    apart=(path,),
                )


def _finding(
    package: ProjectPackage, element: Element | None, what: str, about: str, fixes: tuple[Fix, ...] = ()
) -> Finding:
    return Finding(
        at=place(package, element),
        message=f"catkin and colcon reject the manifest of {package}: {what}",
        about=(package.name, about),
        fixes=fixes,
        apart=(about,),
    )


CHECK = Check(
    id="invalid-manifest",
    summary="package.xml that does not follow its format.",
    level=Level.ERROR,
    catalogue="M10",
    tags=("packages",),
    project=check,
)
