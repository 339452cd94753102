# SPDX-License-Identifier: Apache-2.0
"""Where the files of packages are that descriptions name: in their sources, or where the build installs them from."""

from __future__ import annotations

import re

from haros_ci.launch.facts.files import Finder
from haros_ci.model.launch_facts import FileUse
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.robot.sources import FIND, Located, Look

_NOWHERE = Location(".")
_FIND_OR_END = regex(r"\$\(find(?:-pkg-share)? |\)")


def by_builds(finder: Finder) -> Look:
    """Looks for files with what the builds install and may make."""

    def look(package: str, inner: str) -> Located:
        return found(finder, f"$(find {package})/{inner}")

    return look


def found(finder: Finder, text: str) -> Located:
    """Where the path *text* of a launch file leads: below ``$(find pkg)``, ``$(find-pkg-share pkg)`` or ``$(workspace dir)``."""
    use = finder.completed(FileUse(location=_NOWHERE, kind="value", text=text))
    if use.is_found or use.path in finder.written:
        return Located(use.path)
    return Located(None, use.is_found is False, use.similar)


def as_xacro(text: str) -> str:
    """*text* of a launch file as the reader writes the directories of packages."""
    pending = 0

    def written(found: re.Match[str]) -> str:
        nonlocal pending
        if found[0] != ")":
            pending += 1
            return FIND
        if not pending:
            return ")"
        pending -= 1
        return ""

    return _FIND_OR_END.sub(written, text)


def as_launched(text: str) -> str:
    """The path *text* of a description as a ROS 2 launch file writes it; a path that is not in a package's directory as it is."""
    if not text.startswith(FIND):
        return text
    package, slash, inner = text[len(FIND) :].partition("/")
    return f"$(find-pkg-share {package}){slash}{inner}"
