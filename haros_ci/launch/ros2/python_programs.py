# SPDX-License-Identifier: Apache-2.0
"""Programs of packages that an interpreter of Python is given by their file or module: ``python3 -m demo.talker``."""

from __future__ import annotations

import posixpath
import re

from haros_ci.launch.ros2.places import Places
from haros_ci.model.build import EntryPoint
from haros_ci.regex import regex
from haros_ci.substitutions.names import MARK

#: The interpreter as launch files name it, and its options without a value.
INTERPRETERS = ("python3", "python", "/usr/bin/python3")
FLAGS = ("-u", "-B", "-O", "-OO", "-E", "-s", "-S", "-I", "-q", "-v")
#: What imports the client library, and what a file does when it is run: its branch for that, or calls.
_CLIENT = regex(r"^[ \t]*(?:import|from)[ \t]+rclpy\b", re.MULTILINE)
_RUNS = regex(r"""^(?:if[ (]+__name__\s{0,9}==\s{0,9}["']__main__["']|[\w.]{1,99}\()""", re.MULTILINE)
_PART = "a part of the command line is not known"


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


def file_of(places: Places, words: list[str]) -> tuple[str, int]:
    """The file of the workspace that the interpreter is given by *words*, by its path or as a module, and how many of them say so; "" if there is none.

    ``-m`` runs the file of a module, and ``__main__.py`` of a package (docs.python.org/3/using/cmdline.html).
    """
    start = _start(words)
    if not start or len(words) <= start:
        return "", 0
    if words[start] == "-m":
        found = _files_of_module(places, words[start + 1]) if len(words) > start + 1 else []
        return (found[0], start + 2) if len(found) == 1 else ("", 0)
    path = places.find(words[start]).path if words[start].startswith("$(") else None
    return (path, start + 1) if path is not None and path in places.files.listed else ("", 0)


def is_of_ros(places: Places, path: str) -> bool:
    """Whether a file that is run does something, and imports the client library of ROS 2 itself."""
    text = places.workspace.text(path)
    return _CLIENT.search(text) is not None and _RUNS.search(text) is not None


def why_not(places: Places, words: list[str]) -> str:
    """Why it is not known what the interpreter is given by *words*, where that may be of the workspace; "" elsewhere."""
    start = _start(words)
    if not start or len(words) <= start:
        return ""
    if words[start] == "-m":
        module = words[start + 1] if len(words) > start + 1 else ""
        if MARK in module:
            return _PART
        if module.partition(".")[0] not in places.files.directories or _files_of_module(places, module):
            return ""
        return "no file of the workspace is that module"
    file = words[start]
    if MARK in file:
        return _PART
    if file.startswith("-") or not (file.endswith(".py") or file.startswith("$(")):
        return ""
    place = places.find(file)
    if place.path is None:
        return "" if place.outside else place.reason
    return "" if places.files.has(place.path) else "it is not in the workspace"


def _start(words: list[str]) -> int:
    """Where the interpreter gets what it runs; 0 if *words* begin with no interpreter."""
    if not words or words[0] not in INTERPRETERS:
        return 0
    return next((number for number, word in enumerate(words[1:], 1) if word not in FLAGS), len(words))


def _files_of_module(places: Places, module: str) -> list[str]:
    """The files of packages that are that *module*, for whoever has them installed."""
    inner = module.replace(".", "/")
    found = {
        posixpath.normpath(f"{start}/{below}/{inner}{ending}")
        for start in places.files.directories.values()
        for below in ("", "src")
        for ending in (".py", "/__main__.py")
    }
    return sorted(found & places.files.listed)
