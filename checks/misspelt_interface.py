# SPDX-License-Identifier: Apache-2.0
"""Code and interfaces that name a message, service or action of a released package by a slip of its name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, is_letter_slip
from haros_ci.api.interfaces import InterfaceReference, InterfaceUsers, always_at, is_written_here, references_to


def check(project: Project) -> Iterator[Finding]:
    known: dict[InterfaceReference, str] = {}

    def meant_by(reference: InterfaceReference) -> str:
        if reference not in known:
            known[reference] = _meant(project, reference)
        return known[reference]

    for reference, places in InterfaceUsers(project).named.items():
        meant = meant_by(reference)
        for path, written in places if meant else ():
            if path not in project.code.unbuilt and not is_written_here(project, written):
                yield from _named(project, path, written, reference.package, meant)
    for package in project.packages:
        for interface in package.build.interfaces:
            for field in (one for section in interface.sections for one in section if interface.is_generated):
                name, _, short = re.split(r"[\[<]", field.type)[0].partition("/")
                meant = meant_by(InterfaceReference(name, "msg", short.lower())) if short else ""
                if meant:
                    at = Location(interface.path, field.line)
                    what, effect = (
                        f"{interface.name} has a field {field.name} of {name}/{short}",
                        f"{package.name} does not build",
                    )
                    yield _finding(at, what, effect, f"{interface.name} {name}/{short}", name, meant)


def _named(project: Project, path: str, written: str, package: str, meant: str) -> Iterator[Finding]:
    """The finding of one import or include, where it stands under no condition."""
    at, shown = always_at(project, path, written), written.strip('"<>')
    use, effect = ("included", "this file does not build") if "/" in shown else ("imported", "the import fails")
    if at is not None:
        yield _finding(at, f"{shown} is {use}", effect, shown, package, meant)


def _finding(at: Location, what: str, effect: str, about: str, package: str, meant: str) -> Finding:
    return Finding(
        at=at,
        message=f"{what}, but no release of {package} defines this interface: {effect}; did you mean {package}/{meant}?",
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


CHECK = Check(
    id="misspelt-interface",
    summary="Message, service or action of a released package, misspelt.",
    level=Level.ERROR,
    tags=("interfaces",),
    project=check,
)
