# SPDX-License-Identifier: Apache-2.0
"""Where the files of a package are once it is installed, and install() commands that are added to its CMake."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import Installed
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.results.fix import Edit, Fix

_PACKAGE_CALL = regex(r"(?m)^(?:ament_package|ament_auto_package|autoware_ament_auto_package)[ \t]*\(")
#: The start of an install() in a comment; the line above which the template of catkin_create_pkg has there.
_COMMENTED_CALL = regex(r"^[ \t]*#[ \t#]*install[ \t]*\(", re.IGNORECASE)
_CALL = regex(r"^[ \t]*install[ \t]*\(", re.IGNORECASE)
#: A comment above a target by which it is not to be installed; and what makes one of a task, or of something else.
_NOT_INSTALLED = regex(
    r"\bnon-?[ ]?installed\b|\bnot[ ]+(?:to[ ]+be[ ]+|be[ ]+|being[ ]+)?install(?:ed|able)?\b|\b(?:don'?t|never)[ ]+install(?:ed)?\b|\bno[ ]+install\b"
    r"|\buninstalled\b|\bfor[ ]+(?:local[ ]+)?(?:development|developers|debugging)\b|\b(?:development|developers?|debugging)[ ]+only\b",
    re.IGNORECASE,
)
_TASK = regex(r"\b(?:todo|fixme|xxx|bug|why|if|when|unless|until|yet|might|may)\b|\?", re.IGNORECASE)
#: Lines of comments above a target that are read.
_ABOVE = 2
_WORD = regex(r"[\w./+${}-]+")


def left_out_on_purpose(package: ProjectPackage) -> frozenset[str]:
    """The words in comments inside the install() commands of *package*, in commands that are commented out, and alone on a line beside them.

    What catkin_create_pkg writes as an example (below a line with ``##``) counts for nothing.
    """
    found: set[str] = set()
    for path in package.project.below(package.path):
        if path.endswith("CMakeLists.txt"):
            text = package.project.text(path)
            found.update(_left_out(text) if "install" in text else ())
    return frozenset(word.replace("${PROJECT_NAME}", package.name).rstrip("/") for word in found)


def is_said_not_installed(package: ProjectPackage, at: Location) -> bool:
    """Whether a comment just above the target at *at*, or behind its name, says that it is not to be installed."""
    lines = package.project.text(at.path).splitlines()
    if not at.line or at.line > len(lines):
        return False
    comments = [lines[at.line - 1].partition("#")[2]]
    for line in reversed(lines[max(at.line - 1 - _ABOVE, 0) : at.line - 1]):
        if not line.lstrip().startswith("#"):
            break
        comments.append(line)
    return any(_NOT_INSTALLED.search(text) and not _TASK.search(text) for text in comments)


def _left_out(text: str) -> Iterator[str]:
    """The words of such comments in one file of CMake."""
    open_call = open_comment = 0
    is_template = is_beside = False
    for line in text.splitlines():
        code, _, comment = line.partition("#")
        if open_call <= 0 and not code.strip() and _COMMENTED_CALL.match(line) and not is_template:
            open_comment = 0
            yield from _WORD.findall(comment)
            open_comment += comment.count("(") - comment.count(")")
        elif open_comment > 0 and not code.strip() and comment:
            yield from _WORD.findall(comment)
            open_comment += comment.count("(") - comment.count(")")
        else:
            open_comment = 0
            words = _WORD.findall(comment)
            if open_call > 0 or (is_beside and not code.strip() and len(words) == 1):
                yield from words
            is_start = open_call <= 0 and _CALL.match(code) is not None
            if is_start and comment:
                yield from words
            if is_start or open_call > 0:
                open_call = max(open_call, 0) + code.count("(") - code.count(")")
                is_beside = open_call <= 0
            elif code.strip() or not comment:
                is_beside = False
        is_template = line.lstrip().startswith("##") or (is_template and bool(comment) and not code.strip())


def landings(package: ProjectPackage, path: str) -> tuple[str, ...]:
    """The paths below the install prefix that the file or directory at the root-relative *path* is installed to."""
    found = []
    for row in package.build.installed:
        if row.path == path:
            found.append(row.destination if row.kind == "directory" else f"{row.destination}/{row.name}")
        elif row.kind == "directory" and (row.path == "." or path.startswith(f"{row.path}/")):
            rest = path if row.path == "." else path[len(row.path) + 1 :]
            found.append(f"{row.destination}/{rest}")
    return tuple(found)


def is_made_program_later(package: ProjectPackage, path: str, earlier: Installed) -> bool:
    """Whether a later install(PROGRAMS) puts the file at *path* to where the row *earlier* puts it.

    The one that comes last gives the mode, also where the file is up to date (cmFileCopier::InstallFile of CMake).
    """
    target = f"{earlier.destination}/{earlier.name}"
    if earlier.kind == "directory":
        target = f"{earlier.destination}/{path if earlier.path == '.' else path[len(earlier.path) + 1 :]}"
    is_later = False
    for row in package.build.installed:
        if row is earlier:
            is_later = True
        elif is_later and row.kind == "program" and row.path == path and f"{row.destination}/{row.name}" == target:
            return True
    return False


def install_place(package: ProjectPackage) -> Location:
    """Where another install() goes: the last one that there is, else the end of CMakeLists.txt or data_files of setup.py."""
    last = [
        install.command.location
        for install in package.cmake.installs
        if install.command.location.path == package.cmake_path
    ]
    if last:
        return Location(package.cmake_path, last[-1].line)
    text = package.project.text(package.cmake_path)
    if text:
        call = _PACKAGE_CALL.search(text)
        return Location(package.cmake_path, text.count("\n", 0, call.start()) + 1 if call else 1)
    setup = package.inside("setup.py")
    text = package.project.text(setup)
    at = text.find("data_files")
    return Location(setup, text.count("\n", 0, at) + 1 if at >= 0 else 1)


def install_line(package: ProjectPackage, line: str, description: str) -> Fix | None:
    """*line* as a command of its own before ament_package(), which has to be the last, or at the end of CMakeLists.txt."""
    text = package.project.text(package.cmake_path)
    if not text:
        return None
    end = "\r\n" if "\r\n" in text else "\n"
    line = line.replace("\n", end)
    calls = list(_PACKAGE_CALL.finditer(text))
    if len(calls) > 1:
        return None
    if calls:
        number = text.count("\n", 0, calls[0].start()) + 1
        return Fix(description, (Edit(package.cmake_path, (number, 1), (number, 1), f"{line}{end}{end}"),))
    if package.ros == 2:
        return None
    lines = text.splitlines(keepends=True)
    if not lines[-1].endswith(("\n", "\r")):
        point = (len(lines), len(lines[-1]) + 1)
        return Fix(description, (Edit(package.cmake_path, point, point, f"{end}{end}{line}{end}"),))
    point = (len(lines) + 1, 1)
    return Fix(description, (Edit(package.cmake_path, point, point, f"{end}{line}{end}"),))


def install_directory(package: ProjectPackage, directory: str) -> Fix | None:
    """*directory* of the package installed to its share: beside its like, else by a command of its own."""
    text = package.project.text(package.cmake_path)
    place = r"share/\$\{PROJECT_NAME\}" if package.ros == 2 else r"\$\{CATKIN_PACKAGE_SHARE_DESTINATION\}"
    for command in package.cmake.installs:
        at, kind = command.command.location, command.kind
        if kind != "DIRECTORY" or at.path != package.cmake_path or at.line is None:
            continue
        if command.command.is_conditional or command.command.is_test:
            continue
        start = sum(map(len, text.splitlines(keepends=True)[: at.line - 1])) + (at.column or 1) - 1
        found = re.compile(
            rf"install\s*\(\s*DIRECTORY(\s+)([\w./-]+(?:(\s+)[\w./-]+)*)\s+DESTINATION\s+{place}/?\s*\)"
        ).match(text, start)
        if found is not None and not any(word.endswith("/") for word in found[2].split()):
            between = found[3] or (found[1] if "\n" in found[1] else " ")
            before = text[: found.end(2)]
            number = before.count("\n") + 1
            point = (number, len(before) - (before.rfind("\n") + 1) + 1)
            return Fix(f"install {directory}", (Edit(package.cmake_path, point, point, between + directory),))
    share = "share/${PROJECT_NAME}" if package.ros == 2 else "${CATKIN_PACKAGE_SHARE_DESTINATION}"
    return install_line(package, f"install(DIRECTORY {directory} DESTINATION {share})", f"install {directory}")


def install_commands(package: ProjectPackage, things: Iterable[str]) -> str:
    """The commands of CMake that install directories and files of the package, *things*, to its share."""
    share = "share/${PROJECT_NAME}" if package.ros == 2 else "${CATKIN_PACKAGE_SHARE_DESTINATION}"
    folders = [thing for thing in things if package.inside(thing) in package.project.directories]
    files = [thing for thing in things if thing not in folders]
    kinds = (("DIRECTORY", folders), ("FILES", files))
    return "\n".join(f"install({kind} {' '.join(names)} DESTINATION {share})" for kind, names in kinds if names)
