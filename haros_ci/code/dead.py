# SPDX-License-Identifier: Apache-2.0
"""Functions that nothing in the workspace calls."""

from __future__ import annotations

import re

from haros_ci.code.classes import base_names, class_named, owner_of
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.regex import regex

#: Comments and texts of C++.
_COMMENTS = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:[^\"\\\n]|\\.)*\"", re.DOTALL)
#: What stands before the name of a function that is declared or defined: ``void * Detector::``; and words that are no types.
_DECLARED = regex(r"\b([A-Za-z_]\w*)[\s>*&]+(?:\w+\s*::\s*)*$")
_NO_TYPES = frozenset("return co_return co_await co_yield throw new delete else do case not and or endif goto".split())
#: The bases whose methods are known: they call none of a class that is not virtual.
_NODES = frozenset(("rclcpp::Node", "rclcpp_lifecycle::LifecycleNode", "nodelet::Nodelet"))
_PYTHON_BASES = frozenset(("object", "rclpy.node.Node", "rclpy.Node", "Node"))
#: A comment of Python, with what stands before it on its line.
_REMARK = regex(r"^((?:[^\"'#\n]|\"[^\"\n]*\"|'[^'\n]*')*)#[^\n]*", re.MULTILINE)
_PROGRAM = regex(r"^if[ \t(]+__name__[ \t]*==[ \t]*['\"]__main__['\"]|^#!", re.MULTILINE)


def is_dead(code: Codebase, routine: Routine) -> bool:
    """Whether nothing in the workspace calls the function or hands it on: it is named where it is declared and defined alone.

    Of a class with a base that is not seen the base may call it. A public function of a Python module that is no program may be for others.
    """
    key = ("dead", id(routine))
    if key not in code.kept:
        code.kept[key] = _is_dead(code, routine)
        code.kept["keep", id(routine)] = routine
    found: bool = code.kept[key]
    return found


def _is_dead(code: Codebase, routine: Routine) -> bool:
    function = routine.method.function
    name = function.name.rpartition("::")[2]
    if routine.is_python:
        return _is_dead_in_python(code, routine)
    if function.kind != "function" or name == "main" or not name.isidentifier():
        return False
    owner = owner_of(code, routine)
    if owner is not None and any(
        class_named(code, base, owner[0]) is None for base in base_names(code, owner) - _NODES
    ):
        return False
    return not any(_is_used(code, path, name) for path in sorted(code.mentioning(name)))


def _is_used(code: Codebase, path: str, name: str) -> bool:
    """Whether a C++ file has a virtual function of that name, or names one elsewhere than where it is declared or defined."""
    functions = code.by_path[path].program.functions
    if any(function.is_virtual and function.name.rpartition("::")[2] == name for function in functions):
        return True
    text = _COMMENTS.sub(" ", code.text(path))
    for found in re.finditer(rf"(?<!\w){name}\b\s*(\(?)", text):
        declared = _DECLARED.search(text, max(0, found.start() - 200), found.start())
        if not found[1] or declared is None or declared[1] in _NO_TYPES:
            return True
    return False


def _is_dead_in_python(code: Codebase, routine: Routine) -> bool:
    function = routine.method.function
    name = function.name.rpartition(".")[2]
    if function.kind != "function" or name == "main" or name.startswith("__") or not name.isidentifier():
        return False
    text = code.text(routine.path)
    if not name.startswith("_") and not _PROGRAM.search(text):
        return False
    owner = owner_of(code, routine)
    if owner is not None and any(
        class_named(code, base_name, owner[0]) is None for base_name in base_names(code, owner) - _PYTHON_BASES
    ):
        return False
    lines = text.split("\n")[: max((function.line or 1) - 1, 0)]
    if lines and lines[-1].strip().startswith(("@", ")")):
        return False  # a decorator may keep it
    word = re.compile(rf"(?<!\w){name}(?!\w)")
    defined = re.compile(rf"\bdef[ \t]+{name}\b")
    for path in code.mentioning(name):
        plain = defined.sub(" ", _REMARK.sub(r"\1", code.text(path)))
        if word.search(plain):
            return False
    return True
