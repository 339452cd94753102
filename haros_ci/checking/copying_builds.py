# SPDX-License-Identifier: Apache-2.0
"""Whether evidently nobody builds a workspace of ROS 2 with links to its sources, whose execute bits count then."""

from __future__ import annotations

import re

from haros_ci.checking.interpreted import is_sourced
from haros_ci.checking.project import Project
from haros_ci.regex import regex

#: So many scripts without their bits show how a workspace is built.
_FEW = 2
#: Files that describe the build for people and machines, and the options with which the execute bit of the source counts.
_TELLING = regex(
    r"\.(?:md|rst|txt|sh|bash|zsh|ya?ml|json|toml|py|mk|meta|repos)$|(?:^|/)[^/.]*$|dockerfile|containerfile", re.I
)
_LINKING = regex(r"symlink[-_]install")


def is_built_by_copying(project: Project) -> bool:
    """Whether evidently nobody builds with links to the sources: no script (of two or more) of ament's install(PROGRAMS) has its bit, and nothing says so."""
    bits = project.workspace.executables
    paths = {
        script.path
        for package in project.packages
        if package.ros == 2
        for script in package.build.installed
        if script.kind == "program" and not script.keeps_mode and script.destination in ("bin", f"lib/{package.name}")
        if project.text(script.path).startswith("#!") and not is_sourced(script.path, package)
    }
    if bits is None or len(paths) < _FEW or not paths.isdisjoint(bits):
        return False
    texts = (path for path in project.workspace.names if _TELLING.search(path))
    return not any(_LINKING.search(project.text(path)) for path in texts)
