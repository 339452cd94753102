# SPDX-License-Identifier: Apache-2.0
"""Files that a program opens below the share directory of a package, and that are not there once the package is installed; images of maps."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from itertools import islice

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, alternatives, dataclass, regex
from haros_ci.api.code import weighed
from haros_ci.api.launch import LostImage, lost_images, similar_files
from haros_ci.api.packages import landings, may_appear, paths_by_name

#: What gives the directory of a package: ament_index_cpp, ament_index_python, roslib, rospkg.
_DIRECTORY = (
    r"(?:(?:\w+(?:::|\.))*(?:get_package_share_directory|get_package_share_path|getPath)|(?:\w+\.RosPack\(\)|\w*rospack\w*)\.get_path)"
    r"\(\s*[\"'](\w+)[\"']\s*(?:,\s*)?\)"
)
_ASSIGNED = regex(
    rf"(?m)^[ \t]*(?:(?:const[ \t]+)?(?:(?:std::)?string|auto)[ \t]+)?((?:self\.)?\w+)[ \t]*=[ \t]*(?:Path\()?{_DIRECTORY}\)?[ \t]*(?:;[ \t]*)?$"
)
_LITERALS = r"((?:\s*,\s*[\"'][^\"'\n{}%]+[\"'])+)\s*(?:,\s*)?\)"
_ADDED = r"\s*\+\s*(?:std::string\()?[\"']/([^\"'\n{}%]+)[\"']\)?(?!\s*(?:\+|%|\.format))"
_SLASHED = r"((?:\s*/\s*[\"'][^\"'\n{}%]+[\"'])+)(?!\s*(?:/|\+))"
#: Files that somebody wrote by hand, which nodes read.
_READ = regex(r"\.(?:ya?ml|json|csv|urdf|xacro|sdf|srdf|rviz|xml|world|pgm)$")
#: Code that may make the file, or asks whether it is there.
_MAKES = regex(
    r"[\"'][wa]b?\+?[\"']|ofstream|\bdump\(|\.write\(|write_text|to_csv|savetxt|imwrite|makedirs|mkdir|create_director|exists\(|is_?file\(|"
    r"isdir\(|touch\(|saveMap|save_|writeFile"
)
#: A line that says what is used where nothing else is given.
_DEFAULT = regex(r"default|param|declare|argument", re.IGNORECASE)
_ASIDE = regex(r"(?:^|[/_])(?:tests?|launch|examples?|deprecated|old)(?:[/_.]|$)")
#: Commands of CMake that make no file.
_QUIET = ("install", "find_package", "project", "add_executable", "add_library", "target_link_libraries")


@dataclass(frozen=True, slots=True)
class _FileUse:
    package: str
    inner: str
    at: Location


def check(project: Project) -> Iterator[Finding]:
    yield from weighed(project, _found(project))
    yield from map(_of_map, lost_images(project))


def _found(project: Project) -> Iterator[Finding]:
    for file in project.workspace.files:
        if file.language not in ("cpp", "python") or _ASIDE.search(file.path):
            continue
        text = project.text(file.path)
        if ("get_package_share" not in text and "getPath" not in text and "get_path" not in text) or _MAKES.search(
            text
        ):
            continue
        for use in _uses(file.path, text):
            package = project.package(use.package)
            if package is not None and not use.inner.startswith(".."):
                yield from _finding(package, use)


def _uses(path: str, text: str) -> Iterator[_FileUse]:
    for match in re.finditer(_DIRECTORY + _ADDED, text):
        yield from _use(path, text, match, match[1], match[2])
    for match in re.finditer(rf"os\.path\.join\(\s*{_DIRECTORY}{_LITERALS}", text):
        yield from _use(path, text, match, match[1], _joined(match[2]))
    for match in re.finditer(rf"(?:Path\()?{_DIRECTORY}\)?{_SLASHED}", text):
        yield from _use(path, text, match, match[1], _joined(match[2]))
    for assigned in _ASSIGNED.finditer(text):
        name = re.escape(assigned[1])
        if len(re.findall(rf"(?<![\w.]){name}\s*\+?=(?!=)", text)) != 1:
            continue
        for match in re.finditer(rf"os\.path\.join\(\s*{name}{_LITERALS}", text):
            yield from _use(path, text, match, assigned[2], _joined(match[1]))
        for match in re.finditer(rf"(?<![\w.]){name}{_ADDED}", text):
            yield from _use(path, text, match, assigned[2], match[1])
        for match in re.finditer(rf"(?<![\w.]){name}{_SLASHED}", text):
            yield from _use(path, text, match, assigned[2], _joined(match[1]))


def _joined(words: str) -> str:
    return "/".join(re.findall(r"[\"']([^\"']+)[\"']", words))


def _use(path: str, text: str, match: re.Match[str], package: str, inner: str) -> Iterator[_FileUse]:
    line = text.rfind("\n", 0, match.start()) + 1
    before = text[line : match.start()]
    inner = posixpath.normpath(inner.strip("/"))
    if _DEFAULT.search(before):
        return
    if _READ.search(inner) and "//" not in before and "#" not in before and not before.lstrip().startswith("*"):
        number = text.count("\n", 0, match.start()) + 1
        yield _FileUse(package, inner, Location(path, number, match.start() - line + 1))


def _finding(package: ProjectPackage, use: _FileUse) -> Iterator[Finding]:
    project, path = package.project, package.inside(use.inner)
    is_there = path in project.workspace.names
    if package.ros == 1 and is_there:
        return  # in a devel space it is found, and directory-not-installed tells of the rest
    if not _is_known(package) or may_appear(package, path, _QUIET):
        return
    place = posixpath.normpath(f"share/{package.name}/{use.inner}")
    sources = [
        installed.path for installed in package.build.installed if f"{installed.destination}/{installed.name}" == place
    ]
    alike = paths_by_name(project.workspace.names).get(posixpath.basename(use.inner), ())
    sources += [name for name in alike if place in landings(package, name)]
    if sources:
        return
    if is_there:
        message = (
            f"but {package.name} does not install it: the file is missing after the installation, and opening it "
            f"fails; install it to share/{package.name}"
        )
    else:
        prefix = "" if package.path == "." else f"{package.path}/"
        own = [name[len(prefix) :] for name in islice(project.below(package.path), 2000)]
        near = alternatives([repr(name) for name in similar_files(use.inner, own, package.name)])
        message = f"but {package.name} does not have this file: opening it fails" + (
            f"; did you mean {near}?" if near else "; correct the path, or add the file"
        )
    yield Finding(
        at=use.at,
        message=f"the program uses {use.inner} of {package.name}, {message}",
        about=(f"{package.name}/{use.inner}",),
        apart=(use.inner,),
    )


def _of_map(lost: LostImage) -> Finding:
    """map_server reads the image as soon as it loads the map, and stops without it."""
    return Finding(
        at=lost.location,
        message=f"the map names the image {lost.path}, which does not exist: map_server cannot load the map; {lost.advice}",
        about=(lost.path,),
        apart=(lost.path,),
        level=None if lost.is_used else Level.NOTE,
    )


def _is_known(package: ProjectPackage) -> bool:
    """Whether all that the package installs is known."""
    if package.ros is None or package.build.problems:
        return False
    if any("${" in row.path + row.destination + row.name for row in package.build.installed):
        return False
    if package.build.commands:
        return package.cmake.is_whole
    return package.ros == 2 and package.has("setup.py")


CHECK = Check(
    id="share-file-missing",
    summary="File of a share directory that is opened but not installed, or image of a map that does not exist.",
    level=Level.WARNING,
    tags=("packages", "code"),
    project=check,
)
