# SPDX-License-Identifier: Apache-2.0
"""Code and interfaces that name a message, service or action of a released package by a slip of its name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, is_letter_slip
from haros_ci.api.interfaces import InterfaceReference, InterfaceUsers, always_at, references_to
from haros_ci.api.packages import paths_by_name


def check(project: Project) -> Iterator[Finding]:
    known: dict[InterfaceReference, str] = {}

    def meant_by(reference: InterfaceReference) -> str:
        if reference not in known:
            known[reference] = _meant(project, reference)
        return known[reference]

    for reference, places in InterfaceUsers(project).named.items():
        meant = meant_by(reference)
        for path, written in places if meant else ():
            at = (
                None
                if path in project.code.unbuilt or _is_here(project, written)
                else always_at(project, path, written)
            )
            if at is not None:
                shown = written.strip('"<>')
                effect = (
                    "included, so that this file does not build"
                    if "/" in shown
                    else "imported, so that the import fails"
                )
                yield _finding(at, f"{shown} is {effect}", shown, reference.package, meant)
    for package in project.packages:
        for interface in package.build.interfaces:
            for field in (one for section in interface.sections for one in section if interface.is_generated):
                name, _, short = re.split(r"[\[<]", field.type)[0].partition("/")
                meant = meant_by(InterfaceReference(name, "msg", short.lower())) if short else ""
                if meant:
                    at = Location(interface.path, field.line)
                    what = f"{interface.name} has a field {field.name} of {name}/{short}, so that {package.name} does not build"
                    yield _finding(at, what, f"{interface.name} {name}/{short}", name, meant)


def _finding(at: Location, what: str, about: str, package: str, meant: str) -> Finding:
    return Finding(
        at=at,
        message=f"{what}: no release of {package} defines this interface; did you mean {package}/{meant}?",
        about=(about,),
        apart=(at.path, about),
    )


def _meant(project: Project, reference: InterfaceReference) -> str:
    """The one interface of a released package that *reference* is a slip of; "" where it is right, or nothing alike is known."""
    name = reference.package
    if project.package(name) is not None or not project.knowledge.is_whole(name):
        return ""
    stems: dict[str, str] = {}
    for definition in project.knowledge.interfaces(name):
        kind, _, short = definition.partition("/")
        made = references_to(name, kind, short, None)
        if any(one.stem == reference.stem for one in made):
            return ""
        if reference.kind in (kind, ""):
            stems[short.replace("_", "").lower()] = short
    near = [short for stem, short in stems.items() if is_letter_slip(stem, reference.stem)]
    return near[0] if len(near) == 1 else ""


def _is_here(project: Project, written: str) -> bool:
    """Whether the workspace has a header of this path, or a module in the place of the generated one."""
    name = written.strip('"<>')
    if "/" not in name:
        module = name.rpartition(".")[0].replace(".", "/")
        return any(path.endswith((f"{module}.py", f"{module}/__init__.py")) for path in project.workspace.names)
    paths = paths_by_name(project.workspace.names).get(name.rpartition("/")[2], ())
    return any(f"/{path}".endswith(f"/{name}") for path in paths)


CHECK = Check(
    id="misspelt-interface",
    summary="Message, service or action of a released package, misspelt.",
    level=Level.ERROR,
    tags=("interfaces",),
    project=check,
)
