# SPDX-License-Identifier: Apache-2.0
"""Star imports of modules that no reader of the workspace sees: extensions that are compiled, packages that are not installed."""

from __future__ import annotations

import ast
import posixpath
import re
import sys
from collections.abc import Iterable, Iterator
from functools import lru_cache

from haros_ci.knowledge.knowledge import knowledge
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: Modules that are followed from one star import.
_MOST = 20
#: Modules of the standard library of which pylint knows every name.
_KNOWN = frozenset(
    "collections copy datetime enum functools itertools math os random socket struct sys threading time typing".split()
)
_INTERFACES = regex(r"(\w+)\.(?:msg|srv|action)\Z")
_DEFINITIONS = (".msg", ".srv", ".action")
#: What the modules that genpy and rosidl write import themselves, and so bring.
_OF_GENERATED = frozenset(
    "array codecs collections genpy itertools math numbers numpy os python3 rosidl_parser struct sys traceback".split()
)
#: What they call the classes that they make of one service or action.
_OF_PARTS = regex(
    r"_?(?:Request|Response|Event|Goal|Result|Feedback|SendGoal|GetResult|FeedbackMessage|Action(?:Goal|Result|Feedback)?)\Z"
)
#: What makes a module of compiled code: macros and functions of pybind11, nanobind, Boost.Python and Python itself, and their functions for CMake and setuptools.
_COMPILED = r"(?:PYBIND11_MODULE|PYBIND11_PLUGIN|NB_MODULE|BOOST_PYTHON_MODULE(?:_INIT)?|pybind11_add_module|nanobind_add_module|python_add_module|python3?_add_library|Extension|CMakeExtension|Pybind11Extension)\s*\(\s*['\"]?(?:[\w.]+\.)?{name}\b|\bPyInit_{name}\b"
_COMPILING = ("cpp", "cmake", "setup", "python")


def is_of_unseen(path: str, workspace: Workspace) -> bool:
    """Whether names may come into the module at *path* by a star import whose module the workspace does not have as Python, at any depth.

    A relative one that is not there has to be compiled by something in the workspace: else it is missing, and every import of the package stops.
    """
    waiting, seen = [path], {path}
    while waiting:
        here = waiting.pop()
        for level, module in _starred(workspace.text(here)):
            found = _files(here, level, module, workspace)
            if not found and _is_unseen(level, module, workspace):
                return True
            for other in found:
                if other not in seen and len(seen) < _MOST:
                    seen.add(other)
                    waiting.append(other)
    return False


def may_bring(name: str, path: str, workspace: Workspace) -> bool:
    """Whether a star import of the module at *path* may bring *name*: of modules that make the classes of interfaces it is known what they bring.

    These are the interfaces themselves, and what the generated modules import: packages whose types they use, and some of the standard library.
    """
    known = knowledge()
    here = {package.name: package.path for package in workspace.packages}
    if name in _OF_GENERATED or name in here or known.is_package(name) is not False:
        return True
    for level, module in _starred(workspace.text(path)):
        if not level and module in _KNOWN:
            if posixpath.join(posixpath.dirname(path), f"{module}.py") in workspace.names:
                return True  # which Python takes, and pylint does not
            continue
        match = _INTERFACES.match(module)
        if level or match is None:
            return True
        if match[1] in here:
            made = _defined_below(f"{here[match[1]]}/".removeprefix("./"), workspace.names)
        else:
            made = frozenset(definition.partition("/")[2] for definition in known.interfaces(match[1]))
        if not made or name in made or _OF_PARTS.sub("", name) in made:
            return True
    return False


@lru_cache(maxsize=64)
def _defined_below(top: str, names: frozenset[str]) -> frozenset[str]:
    """The interfaces that files below the directory *top* define: it is asked for each name, and there may be thousands of both."""
    return frozenset(
        posixpath.basename(name).partition(".")[0]
        for name in names
        if name.startswith(top) and name.endswith(_DEFINITIONS)
    )


def _starred(text: str) -> Iterator[tuple[int, str]]:
    """The level and name of each module of which *text* imports everything."""
    for node in nodes(text) if "*" in text else ():
        if isinstance(node, ast.ImportFrom) and any(name.name == "*" for name in node.names):
            yield node.level, node.module or ""


def _files(path: str, level: int, module: str, workspace: Workspace) -> Iterable[str]:
    """The files of the workspace that *module* may be, as the file at *path* imports it."""
    ways = [f"{module.replace('.', '/')}.py", f"{module.replace('.', '/')}/__init__.py"] if module else ["__init__.py"]
    if level:
        folder = posixpath.normpath(posixpath.join(posixpath.dirname(path), *([".."] * (level - 1))))
        return [name for way in ways if (name := posixpath.normpath(posixpath.join(folder, way))) in workspace.names]
    return sorted(name for name in workspace.names for way in ways if f"/{name}".endswith(f"/{way}"))


def _is_unseen(level: int, module: str, workspace: Workspace) -> bool:
    if not level:
        return module.partition(".")[0] not in sys.stdlib_module_names
    name = re.escape(module.rpartition(".")[2])
    if not name:
        return False
    compiled = re.compile(_COMPILED.format(name=name))
    built = re.compile(rf"(?:^|/){name}(?:\.[\w-]+)*\.(?:so|pyd|pyx)$")
    return any(map(built.search, workspace.names)) or any(
        compiled.search(workspace.text(file.path)) for file in workspace.files if file.language in _COMPILING
    )
