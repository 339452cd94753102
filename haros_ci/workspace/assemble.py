# SPDX-License-Identifier: Apache-2.0
"""From the contents of files to a Workspace, wherever the contents come from."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from pathlib import Path

from haros_ci.model.launch_commands import Commanded, commanded
from haros_ci.model.loose_launches import is_loose_launch
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Buffer, Hiding, Problem, Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.workspace.content import examine
from haros_ci.workspace.files import TextReader
from haros_ci.workspace.generated import says_generated
from haros_ci.workspace.installed_beside import installed_beside, is_program
from haros_ci.workspace.known_copies import copied_library, is_of_project
from haros_ci.workspace.package_xml import parse_package, settled, supports_both
from haros_ci.workspace.third_party import ThirdParty
from haros_ci.workspace.views import doubles

#: Endings of sketches, and what those include that talk to ROS (wiki.ros.org/rosserial_arduino, micro_ros_arduino, ros2arduino).
_SKETCHES = (".ino", ".pde")
_OF_ROS = regex(r"#[ \t]*include[ \t]*[<\"](?:ros\.h|rosserial|ArduinoHardware|micro_ros|ros2arduino|rclc?/|rcl/)")

#: The branch of Python modules that are started, and what imports a client library of ROS.
_STARTED = regex(r"""^if[ (]+__name__\s*==\s*["']__main__["']""", re.MULTILINE)
_CLIENT = regex(r"^(?:import|from)[ \t]+(?:rospy|rclpy)\b", re.MULTILINE)
#: The function that a program of C++ begins with, and what initialises a client library of ROS in it.
_MAIN = regex(r"^[ \t]*(?:int|auto)[ \t\n]{1,9}main[ \t]*\(", re.MULTILINE)
_INITIALISED = regex(r"\b(?:ros|rclcpp)::init[ \t]*\(")
#: What a launch file has, by its language (design.ros2.org/articles/roslaunch.html, wiki.ros.org/roslaunch/XML).
_LAUNCHES = {
    "launch": regex(r"<launch\b|^launch[ \t]*:", re.MULTILINE),
    "python": regex(r"^def[ \t]+generate_launch_description\b", re.MULTILINE),
}
#: The name of a package, in a manifest that no parser takes.
_NAME = regex(rb"<name>\s*([A-Za-z][\w-]{0,99})\s*</name>")
_TESTS = frozenset(("test", "tests"))
#: What it means for the model that a program lies in no package.
_LOST = "what nodes publish and subscribe to there is not in the model"
#: A package, and what is wrong with its manifest.
_Found = tuple[Package, Problem | None]


@dataclass(frozen=True, slots=True)
class Content:
    """The bytes of one file."""

    path: str
    language: str
    data: bytes


@dataclass(frozen=True, slots=True)
class SymbolicLink:
    """A symbolic link at *path*, and what it leads to."""

    path: str
    target: str


@dataclass(frozen=True, slots=True)
class Skipped:
    """A file at *path* that is not read, and why; *is_source* unless it is prose, or only tools of the user's own would read it."""

    path: str
    problem: Problem
    is_source: bool = True


def _initialises(content: Content) -> bool:
    """Whether a C++ file may be a program of ROS."""
    return content.language == "cpp" and (b"ros::init" in content.data or b"rclcpp::init" in content.data)


def _source_file(content: Content) -> SourceFile:
    from hashlib import sha256

    return SourceFile(
        path=content.path,
        language=content.language,
        size=len(content.data),
        digest=sha256(content.data).hexdigest(),
        lines=content.data.count(b"\n"),
        has_directive=b"haros:" in content.data,
        is_generated=says_generated(content.language, content.data),
        third_party=copied_library(content.path, content.language, content.data),
    )


def assemble(
    root: Path,
    contents: Iterable[Content | SymbolicLink | Problem | Skipped],
    *,
    listed: Iterable[str],
    problems: Iterable[Problem],
    targets: frozenset[str] | None,
    context: Iterable[Content],
    max_file_size: int,
    name: str | None = None,
    names: Iterable[str] | None = None,
    executables: Iterable[str] | None = None,
    elsewhere: Path | None = None,
    differs: Callable[[str], bool] | None = None,
    requested: Iterable[str] = (),
    buffer: Buffer | None = None,
) -> Workspace:
    """Hash and examine *contents* one by one (they may be a generator), parse manifests, sort everything.

    *listed* are all paths that may be asked for as text, those that are not analysed (tools' settings) included.
    A package inside another one is none: its files are the outer one's. *context* are manifests of packages that the files lie in, but that are not to be analysed themselves. A nameless
    package at the root takes *name*, by default the root's own. *names* are the paths of all files, by default *listed*,
    *executables* those whose execute bit is set, None if nobody knows.
    Files that are not *listed* lie below *elsewhere*, by default the root. *differs* tells whether a change has made the file at a path what
    it is: one that cannot be analysed is no mere problem then. *requested* are the directories that the run is about. *buffer* is what the reader has instead of one of the files.
    """
    name = name or root.name
    listed = tuple(listed)
    names = frozenset(listed if names is None else names)
    found = list(problems)
    unread: list[Problem] = []
    files: list[SourceFile] = []
    links: dict[str, str] = {}
    packages: dict[str, _Found] = {}
    undecided: dict[str, Content] = {}
    initialised: set[str] = set()
    for manifest in context:
        packages[_directory(manifest.path)] = (_package(manifest, name)[0], None)
    for content in contents:
        if isinstance(content, Problem):
            found.append(content)
            continue
        if isinstance(content, Skipped):
            is_brought = content.is_source and differs is not None and differs(content.path)
            (unread if is_brought else found).append(content.problem)
            continue
        if isinstance(content, SymbolicLink):
            links[content.path] = content.target
            continue
        usable, problem = examine(content.path, content.language, content.data)
        if problem is not None:
            is_brought = not usable and differs is not None and differs(content.path)
            (unread if is_brought else found).append(problem)
        if content.path.rpartition("/")[2] == "package.xml":
            directory = _directory(content.path)
            packages[directory] = _package(content, name)
            if supports_both(packages[directory][0]):
                undecided[directory] = content
        if usable:
            if _initialises(content):
                initialised.add(content.path)
            files.append(_source_file(content))
    packages = _outermost(packages)
    others = [package for package, _ in packages.values()]
    for directory, manifest in undecided.items():
        if directory not in packages:
            continue
        package, fault = packages[directory]
        packages[directory] = settled(package, manifest.path, manifest.data, others), fault
    every = [package for package, _ in packages.values()]
    owners = {directory: package.name for directory, (package, _) in packages.items()}
    owned = _owned(sorted(files, key=lambda file: file.path), owners, ThirdParty(names, owners, requested))
    found += doubles(every, owned)
    reader = TextReader(root, listed, max_file_size, elsewhere, buffer)
    found += _of_rosbuild(owned, names, reader)
    found += _of_sketches(names, reader)
    executables = None if executables is None else frozenset(executables)
    found += _of_no_package(owned, reader, executables)
    found += _cpp_of_no_package(owned, initialised, names, reader)
    found += _launch_files_of_no_package(owned, every, reader)
    return Workspace(
        root=root,
        packages=tuple(sorted(every, key=lambda p: (p.path, p.name))),
        files=owned,
        reader=reader,
        targets=None
        if targets is None
        else targets & {*(file.path for file in files), *(problem.path for problem in unread)},
        problems=in_order(found),
        faults=in_order(fault for _, fault in packages.values() if fault is not None),
        links=tuple(sorted(links.items())),
        names=names,
        executables=executables,
        hiding=Hiding(unread=in_order(unread)),
    )


def _outermost(packages: dict[str, _Found]) -> dict[str, _Found]:
    """The packages, by directory, that lie in no other: where a package.xml is, whatever it says, nobody looks further down.

    That is catkin_pkg's ``find_package_paths`` and colcon's recursive discovery; a package.xml below is one file more of the
    outer package.
    """
    found: dict[str, _Found] = {}
    for directory in sorted(packages, key=lambda path: () if path == "." else tuple(path.split("/"))):
        above = directory
        while above != "." and above not in found:
            above = _directory(above)
        if above not in found:
            found[directory] = packages[directory]
    return found


def _package(content: Content, root_name: str) -> _Found:
    """The package of a manifest; of a malformed one its directory, under the name that stands in the text or else its own, and the fault."""
    package = parse_package(content.path, content.data)
    if isinstance(package, Package):
        return package, None
    directory = _directory(content.path)
    written = _NAME.findall(content.data)
    own = root_name if directory == "." else directory.rpartition("/")[2]
    return Package(name=written[0].decode() if len(written) == 1 else own, path=directory), package


def _owned(files: Iterable[SourceFile], owners: dict[str, str], third_party: ThirdParty) -> tuple[SourceFile, ...]:
    """The files with the name of the package around them, and the copy of another project.

    The *files* come with the name of the library that they are a copy of, in the place of its directory.
    """
    known: dict[str, str | None] = {".": None, **owners}
    made = []
    for file in files:
        directory = start = _directory(file.path)
        while directory not in known:
            directory = _directory(directory)
        known[start] = known[directory]
        owner, library = known[directory], file.third_party
        is_copy = bool(library) and not is_of_project(library, owner)
        around = third_party.directory(file.path)
        copy = file.path if is_copy and (not around or third_party.is_tree(around)) else around
        made.append(replace(file, package=owner, third_party=copy))
    return tuple(made)


def _of_rosbuild(files: Iterable[SourceFile], names: frozenset[str], reader: TextReader) -> Iterable[Problem]:
    """One problem for all packages of rosbuild (wiki.ros.org/rosbuild): a manifest.xml beside a CMakeLists.txt, in no package."""
    found = [
        file.path.removesuffix("CMakeLists.txt") + "manifest.xml"
        for file in files
        if file.package is None and file.path.rpartition("/")[2] == "CMakeLists.txt"
    ]
    found = [path for path in found if path in names and "<package" in reader.text(path)]
    if found:
        number = "1 package" if len(found) == 1 else f"{len(found)} packages"
        yield Problem(
            found[0], f"{number} of rosbuild (manifest.xml, no package.xml): their nodes are not in the model"
        )


def _of_sketches(names: frozenset[str], reader: TextReader) -> Iterable[Problem]:
    """One problem for all sketches of Arduino that talk to ROS (rosserial, micro-ROS, ros2arduino): they are nodes, and are not read."""
    found = sorted(
        path
        for path in names
        if path.endswith(_SKETCHES) and "examples" not in path.split("/") and _OF_ROS.search(reader.text(path))
    )
    if found:
        what = "this Arduino sketch" if len(found) == 1 else f"this Arduino sketch and {len(found) - 1} more"
        verb = "uses" if len(found) == 1 else "use"
        yield Problem(found[0], f"{what} {verb} ROS: what such nodes publish and subscribe to is not in the model")


def _of_no_package(
    files: Collection[SourceFile], reader: TextReader, executables: Collection[str] | None
) -> Iterable[Problem]:
    """One problem for all Python programs that talk to ROS and lie in no package, nor are installed by one: people start them by their paths, and no node is made of them."""
    found = []
    for file in files:
        if file.package is None and file.language == "python" and not file.third_party:
            *directories, name = file.path.split("/")
            if _TESTS.isdisjoint(directories) and not name.startswith("test_") and not name.endswith("launch.py"):
                text = reader.text(file.path)
                if _CLIENT.search(text) and _STARTED.search(text):
                    found.append(file.path)
    beside = installed_beside(files, reader.text) if found else ()
    found = [path for path in found if not is_program(path, beside, executables)]
    yield from _in_no_package(found, ("Python program of ROS", "Python programs of ROS"), _LOST)


def _cpp_of_no_package(
    files: Iterable[SourceFile], initialised: set[str], names: frozenset[str], reader: TextReader
) -> Iterable[Problem]:
    """One problem for all C++ programs that lie in no package, of those that have *initialised* a client library of ROS: no node is made of them.

    Packages of rosbuild have a problem of their own.
    """
    found = []
    for file in files:
        if file.path in initialised and file.package is None and not file.third_party:
            *directories, name = file.path.split("/")
            around = ("/".join((*directories[:number], "manifest.xml")) for number in range(len(directories) + 1))
            if _TESTS.isdisjoint(directories) and not name.startswith("test_") and names.isdisjoint(around):
                text = reader.text(file.path)
                if _INITIALISED.search(text) and _MAIN.search(text):
                    found.append(file.path)
    yield from _in_no_package(found, ("C++ program of ROS", "C++ programs of ROS"), _LOST)


def _launch_files_of_no_package(
    files: Iterable[SourceFile], packages: list[Package], reader: TextReader
) -> Iterable[Problem]:
    """One problem for all launch files that lie in no package, nor beside one whose nodes they start: they are no configuration."""
    found = []
    commands: Commanded | None = None
    files = tuple(files)
    for file in files:
        launches = _LAUNCHES.get(file.language)
        if file.package is None and launches is not None and not file.third_party:
            text = reader.text(file.path) if _TESTS.isdisjoint(file.path.split("/")[:-1]) else ""
            if launches.search(text):
                commands = commands if commands is not None else commanded(files, reader.text)
                is_commanded = commands.names(file)
                is_named = is_commanded or file.language != "python" or file.path.endswith("launch.py")
                if not is_named or not is_loose_launch(file, packages, text, is_commanded=is_commanded):
                    found.append(file.path)
    yield from _in_no_package(
        found, ("launch file", "launch files"), "what is started there is no configuration of the model"
    )


def _in_no_package(paths: list[str], nouns: tuple[str, str], lost: str) -> Iterable[Problem]:
    """One problem at the first of *paths*, which lie in no package, if there are any; *lost* says what that means."""
    if paths:
        others = len(paths) - 1
        what = f"this and {others} more {nouns[others > 1]} lie" if others else f"a {nouns[0]} that lies"
        yield Problem(min(paths), f"{what} in no package: {lost}")


def in_order(problems: Iterable[Problem]) -> tuple[Problem, ...]:
    """*problems* once, by their places."""
    return tuple(sorted(set(problems), key=lambda p: (p.path, p.line or 0, p.message)))


def _directory(path: str) -> str:
    return path.rpartition("/")[0] or "."
