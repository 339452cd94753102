# SPDX-License-Identifier: Apache-2.0
"""Packages whose directories programs ask for by name (ament_index_python, ament_index_cpp, rospkg, roslib): they have to be there when it runs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.checking.imports import used_files
from haros_ci.checking.optional import depends_on_package
from haros_ci.checking.project import ProjectPackage
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

_CALL = regex(
    r"\b(get_package_share_directory|get_package_share_path|get_package_prefix|FindPackageShare|FindPackagePrefix"
    r"|package::getPath|RosPack\(\)\.get_path|(?:ros_?pack|_rp|\brp)\.get_path)\s*\(\s*(?:package(?:_name)?\s*=\s*)?[\"']([A-Za-z][\w-]*)[\"']\s*[,)]"
)
_WORDS = ("get_package_", "FindPackage", "getPath", "get_path")
#: What asks whether a package is there, or is ready for it not to be: ``getPath`` gives an empty path then.
_ASKS = regex(
    r"PackageNotFoundError|get_packages_with_prefixes|ResourceNotFound|has_resource|get_resource\b|\.list\(\)|\.empty\(\)"
)
#: Of Python the same for ROS 1; what code of ROS 2 does is read by its statements.
_ASKS_ROS_1 = regex(r"ResourceNotFound|\.list\(\)")
_LONG = 1_000_000


@dataclass(frozen=True, slots=True)
class Lookup:
    """*function* is asked for the directory of the package *name*."""

    name: str
    function: str
    location: Location


def lookups(package: ProjectPackage) -> tuple[Lookup, ...]:
    """What programs and modules of *package* that are built or installed ask for; launch files and tests are left out."""
    return package.project.sources.once(("lookups", package.path), lambda: tuple(_lookups(package)))


def launch_lookups(package: ProjectPackage) -> Iterator[Lookup]:
    """What launch files of *package* in Python ask for, in the order of the files."""
    yield from _in(package, [path for path, is_launch in used_files(package) if is_launch and path.endswith(".py")])


def _lookups(package: ProjectPackage) -> Iterator[Lookup]:
    paths = [path for path, is_launch in used_files(package) if not is_launch and not _is_tool(package, path)]
    for target in package.build.targets:
        if not target.is_test and not target.is_conditional:
            paths += target.sources
    yield from _in(package, paths)


def _in(package: ProjectPackage, paths: Iterable[str]) -> Iterator[Lookup]:
    project = package.project
    for path in dict.fromkeys(paths):
        text = project.text_with(path, *_WORDS)
        if (
            len(text) > _LONG
            or not any(word in text for word in _WORDS)
            or (_ASKS_ROS_1 if path.endswith(".py") else _ASKS).search(text)
        ):
            continue
        is_python = path.endswith(".py")
        mark = "#" if path.endswith(".py") or "//" not in text else "//"
        for number, line in enumerate(text.split("\n"), 1):
            for match in _CALL.finditer(line) if len(line) < 2_000 else ():
                before = line[: match.start()]
                if mark not in before and not before.lstrip().startswith(("*", ">>>")):
                    at = Location(path, number, match.start() + 1)
                    if not (is_python and depends_on_package(text, at)):
                        yield Lookup(match[2], match[1], at)


def _is_tool(package: ProjectPackage, path: str) -> bool:
    """Whether the file lies beside the import packages that setup.py names, and nothing installs it."""
    tops = {name.partition(".")[0] for name, _ in package.build.python_packages}
    if not tops or path in {entry_point.path for entry_point in package.build.entry_points}:
        return False
    inner = path if package.path == "." else path[len(package.path) + 1 :]
    places = (installed.path for installed in package.build.installed)
    return tops.isdisjoint(inner.split("/")) and not any(
        path == place or path.startswith(f"{place}/") for place in places
    )
