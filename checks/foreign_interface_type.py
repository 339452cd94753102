# SPDX-License-Identifier: Apache-2.0
"""Field types of ROS 1 in interfaces of ROS 2."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Edit, Finding, Fix, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import Interface, InterfaceField

#: What genmsg knows by these words alone, and how rosidl wants it written.
TYPES = {
    "time": "builtin_interfaces/Time",
    "duration": "builtin_interfaces/Duration",
    "Header": "std_msgs/Header",
}


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if package.ros != 2 or package.commands("generate_messages", "add_message_files"):
            continue
        commands = package.commands("rosidl_generate_interfaces")
        if not commands or any(command.is_conditional for command in commands):
            continue
        own = {interface.name.partition("/")[2] for interface in package.build.interfaces if interface.kind == "msg"}
        for interface in package.build.interfaces:
            if interface.is_generated:
                yield from _of(project, package, interface, own)


def _of(project: Project, package: ProjectPackage, interface: Interface, own: set[str]) -> Iterator[Finding]:
    lines = project.text(interface.path).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for field in (interface_field for section in interface.sections for interface_field in section):
        word, _, array = field.written.partition("[")
        if word not in TYPES or (word == "Header" and word in own):
            continue
        line = lines[field.line - 1] if field.line <= len(lines) else ""
        column = line.find(field.written) + 1
        end = column + len(word)
        right = TYPES[word] + (f"[{array}" if array else "")
        effect = (
            f"ROS 2 reads it as {package.name}/Header, which does not exist"
            if word == "Header"
            else f"rosidl has no type {word}, and its generation fails"
        )
        yield Finding(
            at=Location(
                interface.path, field.line, column or None, field.line if column else None, end if column else None
            ),
            message=f"{field.written} {field.name} in {interface.name}: {effect}; write {right}",
            about=(interface.name, field.name),
            fixes=_fixes(package, interface, field, column, word),
        )


def _fixes(
    package: ProjectPackage, interface: Interface, field: InterfaceField, column: int, word: str
) -> tuple[Fix, ...]:
    """Only where the package has the other one as a dependency already: else more is to be done than this."""
    right = TYPES[word]
    provider = right.partition("/")[0]
    named = {argument for command in package.commands("rosidl_generate_interfaces") for argument in command.arguments}
    if not column or provider not in package.declared or provider not in named:
        return ()
    edit = Edit(interface.path, (field.line, column), (field.line, column + len(word)), right)
    return (Fix(f"write {right}", (edit,)),)


CHECK = Check(
    id="foreign-interface-type",
    summary="ROS 1 field type in a ROS 2 interface.",
    level=Level.ERROR,
    catalogue="I06",
    tags=("interfaces",),
    project=check,
)
