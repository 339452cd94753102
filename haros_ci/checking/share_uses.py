# SPDX-License-Identifier: Apache-2.0
"""What names files of packages' share directories: launch files, manifests of ROS 1, models and worlds."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.checking.project import Project
from haros_ci.checking.unread_values import is_undeclared_value
from haros_ci.model.launch_facts import FileUse
from haros_ci.model.location import Location
from haros_ci.regex import regex

#: Where a model or a page names a file of a package.
_COMMENT = regex(r"<!--.*?(?:-->|\Z)", re.S)
_NAMED = regex(r"(?:package://([\w-]+)/|\$\((?:find|find-pkg-share)\s+([\w-]+)\)/)([\w./+-]+)")
#: How the manifest of a ROS 1 package names the descriptions of its plug-ins, and rqt's and rosdoc's files.
_EXPORTED = regex(r"""\bplugin\s*=\s*["']\$\{prefix\}/([\w./+-]+)["']""")
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
        plain = _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
        for match in _EXPORTED.finditer(plain):
            yield Location(package.manifest_path, plain.count("\n", 0, match.start()) + 1), package.name, match[1]
    for path in sorted(project.workspace.names):
        if path.endswith(_MODELS):
            text = _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), project.text(path))
            for match in _NAMED.finditer(text):
                yield Location(path, text.count("\n", 0, match.start()) + 1), match[1] or match[2], match[3]
