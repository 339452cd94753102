# SPDX-License-Identifier: Apache-2.0
"""Imports that pylint takes for those of the file itself, and that are of another module."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: So much of a line is looked at.
_LONGEST = 400
_TAKEN = regex(r"[ \t]*from[ \t]+([A-Za-z_]\w*)[ \t]+import[ \t]+\(?([\w, \t]+)")
#: ``from utils.paths import find``: the package, and the module of it.
_PART = regex(r"[ \t]*from[ \t]+((?:\w+\.)*\w+)\.(\w+)[ \t]+import\b")


def are_of_another(path: str, line: int, workspace: Workspace, is_python2: Callable[[str, Workspace], bool]) -> bool:
    """Whether the import of a module with the file's own name, in *line*, is of another one.

    A script without an ending is no module, nor is a launch file. ``from utils.paths import find`` in ``utils/__init__.py`` is of the module beside it. In Python 2 ``import a`` in ``a/__init__.py`` is of ``a/a.py`` ("Intra-package References" in its tutorial).
    """
    folder, _, name = path.rpartition("/")
    if not name.endswith(".py"):
        return True
    if "def generate_launch_description" in workspace.text(path):
        return True  # launch loads it by its path, which brings no directory
    end = f"/{name[:-3]}/__init__.py"
    if "roslib.load_manifest(" in workspace.text(path) and any(f"/{one}".endswith(end) for one in workspace.names):
        return True  # which puts the directories of packages before that of the script
    if _is_of_directory(path, line, workspace):
        return True
    inner = _PART.match(_line(path, line, workspace))
    if name == "__init__.py" and inner is not None and inner[1].rpartition(".")[2] == folder.rpartition("/")[2]:
        return any(f"{folder}/{inner[2]}{end}" in workspace.names for end in (".py", "/__init__.py"))
    beside = f"{folder}/{folder.rpartition('/')[2]}.py"
    return name == "__init__.py" and beside in workspace.names and is_python2(path, workspace)


def _is_of_directory(path: str, line: int, workspace: Workspace) -> bool:
    """Whether the import takes modules from the directory that the file lies in and is called like: ``from utils import paths`` in ``utils/utils.py``.

    Without an ``__init__.py`` pylint does not take the directory for a package; Python does (PEP 420), where the file is imported from above.
    """
    folder, _, name = path.rpartition("/")
    taken, stem = _TAKEN.match(_line(path, line, workspace)), name.removesuffix(".py")
    if taken is None or taken[1] != stem or folder.rpartition("/")[2] != stem:
        return False
    modules = [word.split()[0] for word in taken[2].split(",") if word.strip()]
    return bool(modules) and all(f"{folder}/{module}.py" in workspace.names for module in modules)


def _line(path: str, line: int, workspace: Workspace) -> str:
    """The beginning of a line of the file at *path*; "" if it is not there."""
    lines = workspace.text(path).split("\n")
    return lines[line - 1][:_LONGEST] if 0 < line <= len(lines) else ""
