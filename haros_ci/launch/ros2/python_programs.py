# SPDX-License-Identifier: Apache-2.0
"""Programs of packages that an interpreter of Python is given by their file or module: ``python3 -m demo.talker``."""

from __future__ import annotations

import posixpath
import re

from haros_ci.launch.ros2.places import Places
from haros_ci.model.build import EntryPoint

#: The interpreter as launch files name it, and its options without a value.
INTERPRETERS = ("python3", "python", "/usr/bin/python3")
FLAGS = ("-u", "-B", "-O", "-OO", "-E", "-s", "-S", "-I", "-q", "-v")


def of_module(places: Places, module: str) -> tuple[str, str] | None:
    """The package and the console script that ``-m`` runs as well: one of the module whose function its last lines call."""
    for package, build in sorted(places.builds.items()):
        for point in build.entry_points:
            if point.module == module and _calls(places, point):
                return package, point.name
    return None


def of_file(places: Places, path: str) -> tuple[str, str] | None:
    """The package and the name of the program that the file at *path*, as it is installed, is; None where it is none."""
    found = places.find(path).path if path.startswith("$(") and path.endswith(".py") else None
    if found is None:
        return None
    for package, build in sorted(places.builds.items()):
        for installed in build.installed:
            if installed.kind == "program" and installed.path == found:
                return package, installed.name or posixpath.basename(found)
        for point in build.entry_points:
            if point.path == found:
                return (package, point.name) if _calls(places, point) else None
        if found in build.scripts:
            return package, posixpath.basename(found)
    return None


def _calls(places: Places, point: EntryPoint) -> bool:
    """Whether the branch of a module that is started calls the function of a console script."""
    text = places.workspace.text(point.path) if point.path else ""
    branch = re.search(r"^if[ (]+__name__\s{0,9}==\s{0,9}[\"']__main__[\"']", text, re.MULTILINE)
    return branch is not None and re.search(rf"\b{re.escape(point.function)}\(", text[branch.end() :]) is not None
