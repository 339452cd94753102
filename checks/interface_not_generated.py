# SPDX-License-Identifier: Apache-2.0
"""Message, service and action definitions that lie in a package and that its CMake does not generate, or that it names in vain."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage, regex
from haros_ci.api.packages import CMakeCommand, Interface, insert_line, interfaces_in_use

_OLD = {"add_message_files": "msg", "add_service_files": "srv", "add_action_files": "action"}
_NEW = "rosidl_generate_interfaces"
_KINDS = (*_OLD.values(), "idl")
#: Words in names of commands that may generate interfaces, though it is not known which.
_OTHERS = regex(r"rosidl|genmsg|gensrv|msg|message|interface|idl|protobuf|catkin_simple|^cs_")
_SINGLE = {"DIRECTORY": 1, "BASE_DIR": 1, "LIBRARY_NAME": 1}
_ENDS = ("DEPENDENCIES", "PACKAGE", "NOINSTALL", "ADD_LINTER_TESTS", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK")
#: What says that a file is the copy of another one, at the end of its name; names that rosidl takes (rosidl_adapter, ``valid_message_name``).
_COPY = regex(r"(?:[_-](?i:backup|bak|old|copy|orig|tmp|unused|deprecated)|(?<=[a-z\d])(?:Backup|Copy|Old))\d*$")
_COMMENT = regex(r"#[^\n]*")
_NAME = regex(r"[A-Z][A-Za-z0-9]*")
#: What actionlib_msgs adds to the name of an action for its messages.
_OF_ACTION = ("Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback")
_ASIDE = ("deprecated", "unused", "old", "backup", "test", "tests", "examples")


def check(project: Project) -> Iterator[Finding]:
    used: Mapping[str, Location] | None = None
    for package in project.packages:
        if package.raw.build_type == "ament_python":
            continue  # nothing runs its CMake: wrong-build-type tells of it
        commands = package.commands(*_OLD, _NEW)
        left = [
            interface
            for interface in package.build.interfaces
            if not (commands and interface.is_generated)
            and _is_own(interface, package)
            and not _is_of_an_action(interface, package)
        ]
        if commands:
            yield from _in_vain(package, commands)
            yield from _forgotten(package, commands)
        if not left or not _are_plain(commands) or not (commands or _generates_nothing(package)):
            continue
        used = interfaces_in_use(project) if used is None else used
        for interface in left:
            if commands:
                if interface.name not in used and (_is_kept(interface, package) or _lacks_types(interface, project)):
                    continue
                if not _is_mentioned(interface, package, even_in_comments=interface.name not in used):
                    yield _left_out(interface, package, commands, used.get(interface.name))
            elif interface.name in used and not _is_of_left_over(used[interface.name], package, used):
                yield _alone(interface, package, used[interface.name])


def _is_own(interface: Interface, package: ProjectPackage) -> bool:
    """Whether it lies where generated ones do: ``msg``, ``srv``, ``action``, or beside one that is generated."""
    directory = posixpath.dirname(interface.path)
    if any(part in _ASIDE for part in directory.removeprefix(package.path).split("/")):
        return False
    beside = {posixpath.dirname(other.path) for other in package.build.interfaces if other.is_generated}
    return directory in beside or directory in {package.inside(kind) for kind in _KINDS}


def _is_of_an_action(interface: Interface, package: ProjectPackage) -> bool:
    """Whether add_action_files() makes a message of this name from an action of the package (genaction.py of actionlib_msgs)."""
    return interface.kind == "msg" and any(
        other.kind == "action" and other.is_generated and interface.name in {f"{other.name}{end}" for end in _OF_ACTION}
        for other in package.build.interfaces
    )


def _is_of_left_over(use: Location, package: ProjectPackage, used: Mapping[str, Location]) -> bool:
    """Whether what uses it is another definition of the *package*, which generates none, and that nothing uses."""
    return any(other.path == use.path and other.name not in used for other in package.build.interfaces)


def _is_kept(interface: Interface, package: ProjectPackage) -> bool:
    """Whether its name marks an old copy, or is a name that rosidl rejects, so that adding it to the list would stop the build."""
    name = posixpath.basename(interface.path).partition(".")[0]
    return _COPY.search(name) is not None or (package.ros == 2 and _NAME.fullmatch(name) is None)


def _lacks_types(interface: Interface, project: Project) -> bool:
    """Whether a field has a type that its package, one of the workspace, does not define: the definition could not be generated."""
    defined = {other.name for package in project.packages for other in package.build.interfaces}
    fields = [field for section in interface.sections for field in section]
    types = {field.type.partition("[")[0].partition("<=")[0] for field in fields}
    return any(
        "/" in kind and project.package(kind.partition("/")[0]) is not None and kind not in defined for kind in types
    )


def _is_mentioned(interface: Interface, package: ProjectPackage, *, even_in_comments: bool) -> bool:
    """Whether CMake names it where it is not followed: under a condition, or commented out, which is meant."""
    name = posixpath.basename(interface.path)
    for file in package.files:
        if file.language == "cmake":
            for line in package.project.text(file.path).splitlines():
                if name in line and (even_in_comments or name in line.partition("#")[0]):
                    return True
    return False


def _are_plain(commands: tuple[CMakeCommand, ...]) -> bool:
    """Whether all that they generate is known."""
    return not any(command.is_conditional or any("$" in word for word in command.arguments) for command in commands)


def _left_out(
    interface: Interface, package: ProjectPackage, commands: tuple[CMakeCommand, ...], use: Location | None
) -> Finding:
    of_kind = [command for command in commands if _OLD.get(command.name, interface.kind) == interface.kind]
    command = (of_kind or list(commands))[0]
    file = posixpath.relpath(interface.path, package.path)
    why = "which uses it, does not build or start" if use is not None else "so no code can use it"
    fix = _insertion(interface, package) if of_kind else None
    related = [(Location(interface.path, 1), f"{interface.name} is defined here")]
    related += [(use, "it is used here")] if use is not None else []
    return Finding(
        at=command.location,
        message=(
            f"{file} is not in the list of interfaces that package {package.name} generates, "
            + (f"and {use.path}, {why}" if use is not None else why)
            + ("; add it to the list" if use is not None else "; add it to the list, or delete the file")
        ),
        about=(package.name, interface.name),
        related=tuple(related),
        apart=(interface.name, interface.kind),
        level=Level.ERROR if use is not None else None,
        fixes=(fix,) if fix is not None else (),
    )


def _generates_nothing(package: ProjectPackage) -> bool:
    """Whether its CMake is there and has no command that might generate interfaces, not even one that is not reached.

    A command in a comment is none: a list that is commented out generates nothing.
    """
    names = {command.name for command in package.build.commands} - {"message"}
    texts = (package.project.text(file.path) for file in package.files if file.language == "cmake")
    return (
        bool(names)
        and not any(_OTHERS.search(name) for name in names)
        and not any(name in _COMMENT.sub("", text) for text in texts for name in (*_OLD, _NEW))
    )


def _alone(interface: Interface, package: ProjectPackage, use: Location) -> Finding:
    """A definition in a package that generates none."""
    elsewhere, base = _elsewhere(interface, package, use), interface.name.partition("/")[2]
    lists = next((name for name, kind in _OLD.items() if kind == interface.kind), "add_message_files")
    how = f"{lists}() and generate_messages()" if package.ros == 1 else f"{_NEW}()"
    return Finding(
        at=Location(interface.path, 1),
        message=(
            f"package {package.name} generates no interfaces, but {use.path} uses {interface.name}: it does not build or "
            f"start; {f'use {elsewhere}/{base}, which {elsewhere} generates' if elsewhere else f'call {how}'}"
        ),
        about=(package.name, interface.name),
        related=((use, "it is used here"),),
        level=Level.ERROR,
    )


def _elsewhere(interface: Interface, package: ProjectPackage, use: Location) -> str:
    """A package with an interface of this name that the package at *use* depends on: the definition has moved there; "" if there is none, or several."""
    project, base = package.project, interface.name.partition("/")[2]
    owner = next((file.package for file in project.workspace.files if file.path == use.path), None)
    user = project.package(owner) if owner is not None else None
    found = []
    for name in sorted((user.declared if user is not None else frozenset()) - {package.name}):
        other = project.package(name)
        made = other.build.interfaces if other is not None else ()
        is_made = any(one.is_generated and (one.name, one.kind) == (f"{name}/{base}", interface.kind) for one in made)
        if is_made and other is not None and other.commands(*_OLD, _NEW):
            found.append(name)
    return found[0] if len(found) == 1 else ""


def _insertion(interface: Interface, package: ProjectPackage) -> Fix | None:
    """A line for it among those of the interfaces of its kind, each of which has a line of its own; sorted if they are."""
    text = package.project.text(package.cmake_path)
    lines = text.splitlines()
    siblings = [
        other
        for other in package.build.interfaces
        if other.is_generated
        and posixpath.dirname(other.path) == posixpath.dirname(interface.path)
        and other.kind == interface.kind
    ]
    found: list[tuple[int, str]] = []
    for other in siblings:
        name = posixpath.basename(other.path)
        at = [
            number
            for number, line in enumerate(lines, 1)
            if re.fullmatch(rf'\s*"?(?:[\w./]*/)?{re.escape(name)}"?\s*', line)
        ]
        if len(at) == 1:
            found.append((at[0], name))
    if not found or len(found) != len(siblings):
        return None
    found.sort()
    names = [name for _, name in found]
    mine = posixpath.basename(interface.path)
    later = [number for number, name in found if name > mine] if names == sorted(names) and len(names) > 1 else []
    number, model = (later[0], found[0]) if later else (found[-1][0] + 1, found[-1])
    line = lines[model[0] - 1].rstrip().replace(model[1], mine)
    return Fix(f"generate {interface.name}", (insert_line(package.cmake_path, text, number, line),))


def _in_vain(package: ProjectPackage, commands: tuple[CMakeCommand, ...]) -> Iterator[Finding]:
    """Files that a list names and that are not there: CMake stops."""
    names = package.project.workspace.names
    for command in commands:
        if command.is_conditional or not names:
            continue
        for word, place in _listed(command, package):
            if place is None or place in names or _is_made(word, package):
                continue
            alike = _alike(place, package)
            meant = f"; the package has {posixpath.relpath(alike, package.path)}" if alike else ""
            yield Finding(
                at=_line_of(word, command, package),
                message=(
                    f"{word} is in the list of interfaces that package {package.name} generates, but the file does not exist: "
                    f"CMake stops{meant}"
                ),
                about=(package.name, posixpath.relpath(place, package.path)),
                apart=(word,),
                level=Level.ERROR,
            )


def _listed(command: CMakeCommand, package: ProjectPackage) -> Iterator[tuple[str, str | None]]:
    """The definitions that *command* names, as written, each with its root-relative path."""
    directory = ""
    if command.name in _OLD:
        directory = next(iter(command.after("DIRECTORY")), _OLD[command.name])
        if "FILES" not in command.arguments or "BASE_DIR" in command.arguments:
            return
        words = command.after("FILES", *_SINGLE, *_ENDS)
    else:
        end = next((at for at, word in enumerate(command.arguments) if word in (*_ENDS, *_SINGLE)), None)
        words = command.arguments[1:end]
    for word in words:
        if (
            word.endswith((".msg", ".srv", ".action", ".idl"))
            and "$" not in word
            and ":" not in word
            and "$" not in directory
        ):
            place = command.place(f"{directory}/{word}" if directory else word)
            inside = place is not None and (package.path == "." or place.startswith(f"{package.path}/"))
            yield word, place if inside else None


def _is_made(word: str, package: ProjectPackage) -> bool:
    """Whether another command than the lists mentions the file: it may write it."""
    name = posixpath.basename(word)
    stem = name.rpartition(".")[0]
    return any(
        stem in argument
        for command in package.build.commands
        if command.name not in (*_OLD, _NEW, "set", "list")
        for argument in command.arguments
    )


def _alike(place: str, package: ProjectPackage) -> str | None:
    """A definition of this name in other letters or in another directory."""
    name = posixpath.basename(place).lower()
    found = (
        interface.path for interface in package.build.interfaces if posixpath.basename(interface.path).lower() == name
    )
    return next(found, None)


def _line_of(word: str, command: CMakeCommand, package: ProjectPackage) -> Location:
    """The line in which a command's argument is written, if it is: else that of the command."""
    lines = package.project.text(command.location.path).splitlines()
    start = command.location.line or 1
    for number in range(start, min(start + 500, len(lines) + 1)):
        if re.search(rf"(?<![\w./-]){re.escape(word)}(?![\w.-])", lines[number - 1].partition("#")[0]):
            return Location(command.location.path, number)
        if lines[number - 1].strip() == ")":
            break
    return command.location


def _forgotten(package: ProjectPackage, commands: tuple[CMakeCommand, ...]) -> Iterator[Finding]:
    """ROS 1: lists without generate_messages()."""
    listing = [command for command in commands if command.name in _OLD]
    known = {*_OLD, "generate_dynamic_reconfigure_options"}
    others = [command.name for command in package.build.commands if command.name not in known]
    if not listing or package.ros != 1 or any(_OTHERS.search(name) for name in others if name != "message"):
        return
    if not any(command.is_conditional for command in listing):
        yield Finding(
            at=listing[0].location,
            message=(
                f"package {package.name} lists interfaces, but never calls generate_messages(): no interface is "
                "generated; call it after the lists and before catkin_package()"
            ),
            about=(package.name, "generate_messages"),
            level=Level.ERROR,
        )


CHECK = Check(
    id="interface-not-generated",
    summary="Interface file that CMake does not generate, or listed interface file that does not exist.",
    level=Level.WARNING,
    catalogue="B13",
    tags=("build", "interfaces"),
    project=check,
)
