# SPDX-License-Identifier: Apache-2.0
"""Which ROS 2 launch files a workspace is started by: those that no other one includes."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable, Collection, Iterable, Mapping

from haros_ci.launch.facts.memory import LaunchMemory, Memo
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch_actions import Description
from haros_ci.model.launch_commands import commanded
from haros_ci.model.loose_launches import is_aside, is_loose_launch
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.timing import timed

_NAMES = tuple(f"{mark}launch.{kind}" for mark in (".", "_") for kind in ("xml", "yaml", "yml", "py"))
_ENDINGS = (".py", ".xml", ".launch", ".yaml", ".yml")
#: The function that ``ros2 launch`` calls, without arguments.
_CALLED = regex(r"^def[ \t]+generate_launch_description[ \t]*\([ \t]*\)", re.MULTILINE)
#: What ``ros2 launch`` and launch_testing ask a Python file for.
_ENTRIES = ("generate_launch_description", "generate_test_description")
_IMPORT = regex(r"^[ \t]*(?:from|import)[ \t]([^\n#]*)", re.MULTILINE)
_WORD = regex(r"\w+")


@timed("launch")
def entry_files(
    workspace: Workspace,
    load: Callable[[str], Description | None],
    places: Places,
    is_ros2: Callable[[str], bool],
    memo: Memo | None = None,
    environment: Mapping[str, str] | None = None,
) -> tuple[str, ...]:
    """The ROS 2 launch files in packages, and beside them (``loose_launches``), that no other one includes with its default arguments, sorted.

    They are called ``*.launch.xml``, ``*_launch.py`` and the like, or describe something and lie in a directory ``launch``, are what a
    command starts (``launch_commands``), or modules of Python with the function that ``ros2 launch`` calls; *is_ros2* says of a path whether it is for ROS 2. Those below ``test``, those called ``test_…`` and those of
    packages called ``…_tests`` are descriptions of tests. A Python file that describes nothing and is imported by one of the others is a module
    of theirs. Each file is launched once, in *environment*; with a *memo*
    ``launch_system`` does not do it again.
    """
    found, loose, called = _launch_files(workspace, load, is_ros2)
    imported = _imported((*found, *loose, *called), workspace)
    found += [path for path in called if not _is_imported(path, imported)]
    kept = memo if memo is not None else LaunchMemory()
    included: set[str] = set()
    entries: list[str] = []
    loose_ones, every = frozenset(loose), frozenset((*found, *loose))
    for path in (*found, *loose):
        if load(path) is None or _is_module(path, imported, workspace):
            continue
        entries.append(path)
        system = launch_system((path,), workspace, load, {}, environment or {}, places, kept)
        own = loose_ones if path in loose_ones else every
        included.update(other for other in system.includes if other != path and other in own)
    return tuple(sorted(path for path in entries if path not in included))


def _launch_files(
    workspace: Workspace, load: Callable[[str], Description | None], is_ros2: Callable[[str], bool]
) -> tuple[list[str], list[str], list[str]]:
    """The launch files in packages, those beside them, and modules of Python in packages that may be launched."""
    found: list[str] = []
    loose: list[str] = []
    called: list[str] = []
    commands = commanded(workspace.files, workspace.text)
    roots = {package.name: package.path for package in workspace.packages}
    for file in workspace.files:
        parts = file.path.split("/")
        if not is_ros2(file.path) or _is_below_tests(parts) or _is_named_test(parts, file.package or ""):
            continue
        if file.package is None:
            is_commanded = parts[-1].endswith(_ENDINGS) and commands.names(file)
            is_named = is_commanded or parts[-1].endswith(_NAMES)
            text = workspace.text(file.path) if is_named else ""
            if is_named and is_loose_launch(file, workspace.packages, text, is_commanded=is_commanded):
                loose += [file.path] if _describes(load(file.path)) else []
        elif file.path.endswith(_NAMES) or parts[-1] in ("launch.xml", "launch.yaml", "launch.py"):
            found.append(file.path)
        elif _may_describe(parts) or (parts[-1].endswith(_ENDINGS) and commands.names(file)):
            found += [file.path] if _describes(load(file.path)) else []
        elif file.language == "python" and not file.third_party and not is_aside(_inside(file, roots)):
            if _CALLED.search(workspace.text(file.path)) and _describes(load(file.path)):
                called.append(file.path)
    return found, loose, called


def _may_describe(parts: list[str]) -> bool:
    """Whether a file lies in a directory ``launch``, and has an ending of launch files."""
    return parts[-2:-1] == ["launch"] and parts[-1].endswith((".xml", ".py", ".launch"))


def _describes(description: Description | None) -> bool:
    return description is not None and any(action.kind != "?" for action in description.actions)


def _imported(paths: Iterable[str], workspace: Workspace) -> Mapping[str, Collection[str]]:
    """By each word of an import in the Python files of *paths* the files that have it there."""
    found: dict[str, set[str]] = {}
    for path in paths:
        if path.endswith(".py"):
            for match in _IMPORT.finditer(workspace.text(path)):
                for word in _WORD.findall(match[1]):
                    found.setdefault(word, set()).add(path)
    return found


def _is_module(path: str, imported: Mapping[str, Collection[str]], workspace: Workspace) -> bool:
    """Whether the file at *path* has functions for others and no description: ``from robot.common_launch import arguments``.

    *imported* are words of imports with the files that have them.
    """
    if not path.endswith(".py") or any(name in workspace.text(path) for name in _ENTRIES):
        return False
    return _is_imported(path, imported)


def _is_imported(path: str, imported: Mapping[str, Collection[str]]) -> bool:
    stem = posixpath.basename(path).removesuffix(".py")
    return stem.isidentifier() and any(other != path for other in imported.get(stem, ()))


def _inside(file: SourceFile, roots: Mapping[str, str]) -> str:
    """The path of *file* from its package on."""
    return file.path.removeprefix(f"{roots.get(file.package or '', '')}/")


def named_as_tests(workspace: Workspace, is_ros2: Callable[[str], bool]) -> tuple[str, ...]:
    """The launch files that are no configuration for their own name or that of their package alone; they may be no tests."""
    found = []
    for file in workspace.files:
        parts = file.path.split("/")
        if file.package is None or not file.path.endswith(_NAMES) or _is_below_tests(parts) or not is_ros2(file.path):
            continue
        if _is_named_test(parts, file.package):
            found.append(file.path)
    return tuple(sorted(found))


def _is_below_tests(parts: list[str]) -> bool:
    return any(part in ("test", "tests") for part in parts[:-1])


def _is_named_test(parts: list[str], package: str) -> bool:
    return parts[-1].startswith("test_") or package.endswith(("_test", "_tests"))
