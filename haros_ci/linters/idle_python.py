# SPDX-License-Identifier: Apache-2.0
"""What pylint says of Python that nothing in the workspace runs, though no name sets it aside: it is so, and nobody mends it on the day it is shown."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from haros_ci.linters.dead_statements import OF_FILES
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.linters.uncalled import is_found
from haros_ci.linters.undefined_names import OF_PYTHON_2
from haros_ci.model.former_names import mention
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

TOOL = "pylint"
#: Findings that are held against all files of the workspace; the rest keep their levels.
MOST = 200
#: Said of the place of a definition, whether or not anything calls it.
_OF_DEFINITIONS = frozenset(("function-redefined", "class-variable-slots-conflict"))
_OF_ARGUMENTS = frozenset(("no-method-argument", "no-self-argument"))
#: What a file does that is more than a list of constants.
_ACTS = (ast.While, ast.For, ast.If, ast.With, ast.Call)
_MAIN = regex(r"^if[ \t(]+__name__[ \t]*==[ \t]*['\"]__main__['\"]", re.MULTILINE)
_PYTHON_3 = regex(r"#![^\n]{0,200}\bpython3")
_QUOTED = regex(r"['\"`](\w+)['\"`]")
_ROS_1 = regex(r"^(?:import|from)[ \t]+(?:rospy|roslib|rostest)\b", re.MULTILINE)
_BOTH = regex(r"\brclpy\b|\bROS_VERSION\b")
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
#: What makes names, but for assignments.
_MAKES = (*_FUNCTIONS, ast.ClassDef, ast.Import, ast.ImportFrom, ast.Lambda)


def with_idle_python(
    results: Iterable[Result], workspace: Workspace, is_given: Callable[[Result], bool]
) -> tuple[Result, ...]:
    """*results*, those of pylint in what nothing runs as notes; where the level *is_given* by the settings it stands.

    That is a function or class of a program which nothing names; a file without definitions and imports, or for Python 2, that nothing names; a file for ROS 1
    in a package of ROS 2; and an empty method of a class that nothing names.
    """
    idle = _Idle(workspace)
    return tuple(
        replace(result, level=Level.NOTE)
        if result.tool == TOOL and result.level is not Level.NOTE and not is_given(result) and idle.has(result)
        else result
        for result in results
    )


class _Idle:
    """What nothing in *workspace* runs."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._of_ros2 = {
            package.name
            for package in workspace.packages
            if package.ros == 2
            and "ROS_VERSION" not in workspace.text(f"{package.path}/package.xml".removeprefix("./"))
        }
        self._package_of = workspace.package_finder()
        self._asked = 0
        self._used: dict[tuple[str, str], bool] = {}
        self._doubting = Doubting()

    def has(self, result: Result) -> bool:
        """Whether the place of *result* is in such code. What stops a compiler stops at the whole file, whatever is run of it."""
        path, line = result.location.path, result.location.line
        text = self._workspace.text(path)
        if line is None or result.rule in OF_FILES or not self._doubting.may(path, result.full_id, text):
            return False
        self._asked += 1
        if self._asked > MOST:
            return False
        if self._package_of(path) in self._of_ros2 and _ROS_1.search(text) and not _BOTH.search(text):
            return True
        tree = nodes(text)
        if result.rule == "undefined-variable":
            found = _QUOTED.search(result.message)
            if found is not None and (self._is_old(found[1], path, text) or _is_fragment(tree, found[1])):
                return not self._is_named(path)
        if result.rule in _OF_ARGUMENTS and (name := _stub(tree, line)):
            return not self._is_used(name, path, text)
        part = _part(tree, line) if result.rule not in _OF_DEFINITIONS and _MAIN.search(text) else ""
        return bool(part) and not is_found(part, text) and not self._is_used(part, path, text)

    def _is_old(self, name: str, path: str, text: str) -> bool:
        """Whether *name* is one of Python 2, in a file of no package that does not ask for Python 3."""
        return name in OF_PYTHON_2 and self._package_of(path) is None and _PYTHON_3.match(text) is None

    def _is_named(self, path: str) -> bool:
        """Whether another file has the name of the file at *path*, without its ending."""
        stem = path.rpartition("/")[2].rpartition(".")[0]
        return any(self._mentions(stem, re.compile(mention(path, stem)), path))

    def _is_used(self, name: str, path: str, text: str) -> bool:
        """Whether *name*, of the file at *path* with that *text*, stands outside of comments there, or in another file that does not define it itself."""
        if (name, path) not in self._used:
            self._used[name, path] = self._stands_elsewhere(name, path, text)
        return self._used[name, path]

    def _stands_elsewhere(self, name: str, path: str, text: str) -> bool:
        used = re.compile(rf"(?<!def )(?<!class )\b{name}\b")
        if used.search(without_comments(text, "python")) is not None:
            return True
        own = re.compile(rf"^(?:def|class) {name}\b", re.MULTILINE)
        stem = path.rpartition("/")[2].rpartition(".")[0]
        return any(own.search(other) is None or stem in other for other in self._mentions(name, used, path))

    def _mentions(self, word: str, pattern: re.Pattern[str], path: str) -> Iterator[str]:
        """The texts of files, but for that at *path*, which have *word* as the *pattern* has it."""
        texts = (self._workspace.text(file.path) for file in self._workspace.files if file.path != path)
        return (text for text in texts if word in text and pattern.search(text) is not None)


def _is_fragment(tree: Sequence[ast.AST], name: str) -> bool:
    """Whether a file is lines to be typed into the shell of some tool: they do something, make no names but by assignments, and call no function of that *name*."""
    calls = (node.func for node in tree if isinstance(node, ast.Call))
    is_called = any(isinstance(one, ast.Name) and one.id == name for one in calls)
    acts = any(isinstance(node, _ACTS) for node in tree)
    return acts and not is_called and not any(isinstance(node, _MAKES) for node in tree)


def _part(tree: Sequence[ast.AST], line: int) -> str:
    """The name of the function, or of the class without a base, at the outermost level that *line* is in; "" where a decorator may hand it to somebody."""
    top = next(iter(tree), None)
    for node in top.body if isinstance(top, ast.Module) else ():
        if isinstance(node, (*_FUNCTIONS, ast.ClassDef)) and node.lineno <= line <= (node.end_lineno or 0):
            is_plain = not isinstance(node, ast.ClassDef) or not (node.bases or node.keywords)
            return node.name if is_plain and not node.decorator_list else ""
    return ""


def _stub(tree: Sequence[ast.AST], line: int) -> str:
    """The name of the class without a base that *line* is in, if all its methods are empty; "" otherwise."""
    for node in tree:
        if isinstance(node, ast.ClassDef) and node.lineno <= line <= (node.end_lineno or 0) and not node.bases:
            functions = [one for one in node.body if isinstance(one, _FUNCTIONS)]
            return node.name if all(map(_is_empty, functions)) else ""
    return ""


def _is_empty(function: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    return all(
        isinstance(one, ast.Pass) or (isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant))
        for one in function.body
    )
