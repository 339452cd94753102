# SPDX-License-Identifier: Apache-2.0
"""What names files of packages' share directories: launch files, manifests of ROS 1, models and worlds."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.checking.unread_values import is_undeclared_value
from haros_ci.model.launch_facts import FileUse
from haros_ci.model.location import Location
from haros_ci.regex import regex

#: Where a model or a page names a file of a package.
_COMMENT = regex(r"<!--.*?(?:-->|\Z)", re.S)
_NAMED = regex(r"(?:package://([\w-]+)/|\$\((?:find|find-pkg-share)\s+([\w-]+)\)/)([\w./+-]+)")
#: How the manifest of a ROS 1 package names the descriptions of its plug-ins, and rqt's and rosdoc's files.
_EXPORTED = regex(r"""\bplugin\s*=\s*["']\$\{prefix\}/([\w./+-]+)["']""")
#: A directory of which a launch file chooses something by an argument or the environment.
_CHOSEN = regex(r"\$\((?:find|find-pkg-share)\s+([\w-]+)\)/((?:[\w.+-]+/){1,20})\$\((?:arg|var|env|optenv)\s")
_MODELS = (".urdf", ".xacro", ".sdf", ".world", ".rviz", ".srdf")


def share_uses(project: Project) -> Iterator[tuple[Location, str, str]]:
    """Places that name a file of a package's share directory: the place, the package, the path in there."""
    seen: set[tuple[Location, str]] = set()
    for system in project.systems:
        for use in system.facts(FileUse):
            key = (use.location, use.inner)
            is_known = bool(use.package) and use.inner not in ("", ".") and bool(use.is_found)
            if is_known and key not in seen and not is_undeclared_value(system, use):
                seen.add(key)
                yield use.location, use.package, use.inner
    for package in project.packages:
        text = project.text(package.manifest_path) if package.ros == 1 else ""
        plain = _without_comments(text)
        for match in _EXPORTED.finditer(plain):
            yield Location(package.manifest_path, plain.count("\n", 0, match.start()) + 1), package.name, match[1]
    for path in sorted(project.workspace.names):
        if path.endswith(_MODELS):
            text = _without_comments(project.text(path))
            for match in _NAMED.finditer(text):
                yield Location(path, text.count("\n", 0, match.start()) + 1), match[1] or match[2], match[3]
    yield from _chosen(project)


def _chosen(project: Project) -> Iterator[tuple[Location, str, str]]:
    """Directories of which launch files choose something, whatever it is: no part of them is installed."""
    for file in project.workspace.files:
        if file.language != "launch" or file.path.endswith((".py", ".yaml", ".yml")):
            continue
        text = _without_comments(project.text(file.path))
        for match in _CHOSEN.finditer(text):
            package, inner = project.package(match[1]), match[2].rstrip("/")
            if package is not None and package.inside(inner) in project.directories:
                if not _is_installed_in_part(package, package.inside(inner)):
                    yield Location(file.path, text.count("\n", 0, match.start()) + 1), match[1], inner


def _is_installed_in_part(package: ProjectPackage, folder: str) -> bool:
    return any(row.path.startswith(f"{folder}/") for row in package.build.installed)


def _without_comments(text: str) -> str:
    return _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
