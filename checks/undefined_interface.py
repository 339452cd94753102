# SPDX-License-Identifier: Apache-2.0
"""Code and interfaces that name a message, service or action that its package does not define."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from difflib import get_close_matches

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, alternatives, equally_near, regex
from haros_ci.api.interfaces import InterfaceReference, InterfaceUsers, always_at, is_written_here, references_to

GENERATE = ("rosidl_generate_interfaces", "add_message_files", "add_service_files", "add_action_files")
ENDINGS = (".msg", ".srv", ".action", ".idl")
_LOWER = regex(r"[\"<]([a-z]\w*)/([a-z][a-z0-9_]*)\.h[\">]", re.ASCII)
#: What generators write once for all interfaces of a package (rosidl_generator_c, rosidl_typesupport_*).
_OF_ALL = regex(r"rosidl_\w+__visibility_control\.hp?p?")
#: Made by dynamic_reconfigure of a .cfg.
OF_A_CONFIG = "config"


class Defining:
    """A package of the workspace that defines interfaces, all of them known."""

    def __init__(self, package: ProjectPackage) -> None:
        self.package = package
        self.interfaces = package.build.interfaces
        self.messages = {interface.name for interface in self.interfaces if interface.kind == "msg"}
        if package.ros != 2:
            made = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback")
            self.messages |= {f"{e.name}{ending}" for e in self.interfaces if e.kind == "action" for ending in made}
        self.references = {
            reference
            for interface in self.interfaces
            for reference in references_to(package.name, interface.kind, interface.name.partition("/")[2], package.ros)
        }

    def like(self, kind: str, stem: str, project: Project, others: Iterable[Defining]) -> str:
        """The interface of that name in a package of the workspace, or in one that the package depends on; else the one here whose name is most like *stem*, in words.

        "" if there is none of these.
        """
        named = {e.name: e.kind for other in others if other is not self for e in other.interfaces}
        for package in self.package.declared:
            named |= {
                f"{package}/{short}": of
                for of, _, short in (e.partition("/") for e in project.knowledge.interfaces(package))
            }
        elsewhere = sorted(
            name for name, of in named.items() if kind in (of, "") and name.partition("/")[2].lower() == stem
        )
        if elsewhere:
            meant = alternatives(elsewhere)
            return f"; did you mean {meant}?" if meant else ""
        names = {e.name.partition("/")[2].lower(): e.name for e in self.interfaces if kind in (e.kind, "")}
        found = alternatives([names[name] for name in equally_near(stem, sorted(names), 0.6)])
        return f"; did you mean {found}?" if found else ""


def check(project: Project) -> Iterator[Finding]:
    names = Counter(raw.name for raw in project.workspace.packages)
    defining = {
        package.name: Defining(package)
        for package in project.packages
        if names[package.name] == 1 and package.build.interfaces and _is_known(package)
    }
    yield from _in_interfaces(project, defining)
    if defining:
        users = InterfaceUsers(project)
        yield from _without_parts(_in_code(project, defining, users))
        yield from _once_a_file(_under_old_names(project, defining, users))


def _without_parts(found: Iterator[Finding]) -> Iterator[Finding]:
    """Without the request or response of a service that the same file imports as well: the import of both is one mistake."""
    findings = list(found)
    named = {(finding.at.path, *finding.about) for finding in findings}
    for finding in findings:
        name = str(finding.about[0])
        service = re.sub(r"(?:Request|Response)$", "", name)
        if ".srv." not in name or service == name or (finding.at.path, service) not in named:
            yield finding


def _once_a_file(found: Iterator[tuple[str, Finding]]) -> Iterator[Finding]:
    """One for all that a file names of one package, by the old name of the package; the further ones are related."""
    files: dict[tuple[str, str], list[Finding]] = {}
    for old, finding in found:
        files.setdefault((finding.at.path, old), []).append(finding)
    for first, *others in files.values():
        yield replace(first, related=tuple((other.at, f"{other.about[0]}, too") for other in others))


def _is_known(package: ProjectPackage) -> bool:
    """Whether CMake tells all that the package generates, and the files are there."""
    commands = package.commands(*GENERATE)
    arguments = [argument for command in commands for argument in command.arguments]
    if (
        not commands
        or any(command.is_conditional for command in commands)
        or any("$" in argument for argument in arguments)
    ):
        return False
    there = {
        (interface.name.partition("/")[2], interface.path.rpartition(".")[2]) for interface in package.build.interfaces
    }
    files = (argument.rpartition("/")[2].rpartition(".") for argument in arguments if argument.endswith(ENDINGS))
    return all((stem, ending) in there for stem, _, ending in files)


def _in_interfaces(project: Project, defining: Mapping[str, Defining]) -> Iterator[Finding]:
    """Fields of a type that is not there."""
    for package in project.packages:
        for interface in package.build.interfaces if package.name in defining else ():
            for field in (
                interface_field
                for section in interface.sections
                for interface_field in section
                if interface.is_generated
            ):
                base = re.split(r"[\[<]", field.type)[0]
                if package.ros == 2 and field.written.partition("[")[0] == "Header":
                    continue  # foreign-interface-type
                of = defining.get(base.partition("/")[0])
                if of is None or base in of.messages or "/" not in base:
                    continue
                yield Finding(
                    at=Location(interface.path, field.line),
                    message=f"{interface.name} has a field {field.name} of {base}, but {of.package.name} defines no such message"
                    f": {package.name} does not build{of.like('msg', base.partition('/')[2].lower(), project, defining.values())}",
                    about=(interface.name, base),
                )


def _under_old_names(
    project: Project, defining: Mapping[str, Defining], users: InterfaceUsers
) -> Iterator[tuple[str, Finding]]:
    """Interfaces of the file's own package under the name of a package that nobody knows, with that name: the package was renamed."""
    if not project.knowledge.is_there:
        return
    folders = {part for name in project.workspace.names for part in name.split("/")[:-1]}
    package_of = project.workspace.package_finder()
    named = [(reference, *place) for reference, places in users.named.items() for place in places]
    for reference, path, written in (*named, *_lower_case(project, defining)):
        name = reference.package
        of = defining.get(package_of(path) or "")
        if of is None or name in {of.package.name, *of.package.declared} or path in project.code.unbuilt:
            continue
        other, own = project.package(name), of.package.name
        if other is None and (name in folders or project.knowledge.is_known(name)):
            continue
        if other is not None and any(name in command.arguments for command in of.package.build.commands):
            continue
        if not get_close_matches(name, [own], 1, 0.6) or replace(reference, package=own) not in of.references:
            continue
        at = always_at(project, path, written)
        if at is None:
            continue
        shown = written.strip('"<>')
        use_text = (
            "included, so that this file does not build" if "/" in shown else "imported, so that the import fails"
        )
        why = f"there is no package {name}" if other is None else f"{own} neither declares nor finds {name}"
        message = f"{shown} is {use_text}: {why}, and {own} itself defines this interface; write {own} for {name}"
        yield name, Finding(at=at, message=message, about=(shown,), apart=(path, shown))


def _lower_case(project: Project, defining: Mapping[str, Defining]) -> Iterator[tuple[InterfaceReference, str, str]]:
    """Headers of ROS 1 that are called like interfaces in lower case."""
    package_of = project.workspace.package_finder()
    for path, program in project.programs.items():
        of = defining.get(package_of(path) or "") if program.language != "python" else None
        for written in program.includes if of is not None and of.package.ros != 2 else ():
            found = _LOWER.fullmatch(written)
            if found is not None:
                yield InterfaceReference(found[1], "", found[2].replace("_", "")), path, written


def _in_code(project: Project, defining: Mapping[str, Defining], users: InterfaceUsers) -> Iterator[Finding]:
    built = {path for package in project.packages for target in package.build.targets for path in target.sources}
    for reference, places in users.named.items():
        of = defining.get(reference.package)
        if of is None or reference in of.references:
            continue
        for path, written in places:
            if path in project.code.unbuilt:
                continue
            finding = _unless_handmade(project, defining, of, reference, path, written, built)
            if finding is not None:
                yield finding


def _unless_handmade(
    project: Project,
    defining: Mapping[str, Defining],
    of: Defining,
    reference: InterfaceReference,
    path: str,
    written: str,
    built: set[str],
) -> Finding | None:
    """The finding for one name in one file; None where people may have written what it means, or only some builds read it."""
    at = always_at(project, path, written)
    if at is None or is_written_here(project, written):
        return None
    name = written.strip('"<>')
    if "/" in name:
        file = name.rpartition("/")[2]
        if (not reference.kind and reference.stem.endswith(OF_A_CONFIG)) or _OF_ALL.fullmatch(file):
            return None
        stem = file.partition(".")[0]
        if any(stem in argument for command in of.package.build.commands for argument in command.arguments):
            return None
        message = f"{name} is included, but {of.package.name} defines no such interface"
        is_sure = path in built
        effect = "this file does not build"
    else:
        message = f"{name} is imported, but {of.package.name} defines no such interface"
        effect, is_sure = "the import fails", True
    return Finding(
        at=at,
        message=f"{message}: {effect}{of.like(reference.kind, reference.stem, project, defining.values())}",
        about=(name,),
        level=None if is_sure else Level.WARNING,
        apart=(path, name),
    )


CHECK = Check(
    id="undefined-interface",
    summary="Message, service or action that its package does not define.",
    level=Level.ERROR,
    catalogue="I02",
    tags=("interfaces",),
    project=check,
)
