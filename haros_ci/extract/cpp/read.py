# SPDX-License-Identifier: Apache-2.0
"""The front end's entry: one C++ file to one Program."""

from __future__ import annotations

from collections.abc import Mapping

from tree_sitter import Node

from haros_ci.extract.cpp import blanks, branches, directives, scopes
from haros_ci.extract.cpp.grammar import errors, missing, parse
from haros_ci.extract.cpp.unit import CppScope, Unit, unit_of
from haros_ci.syntax import Program

LARGEST = 4_000_000
#: The parameters of a macro, and its text.
Macro = tuple[tuple[str, ...], str]
_COUNTED = 1000


def read_cpp(text: str, macros: Mapping[str, Macro] | None = None) -> Program:
    """Lower a C++ source or header, any dialect from C++98 to C++20, without its includes, but for *macros* of theirs that have parameters.

    All branches of its preprocessor conditionals are read. What cannot be read is left out, with a problem
    (at most five per file) where that is in a function; nothing is raised.
    """
    if len(text) > LARGEST:
        return Program("cpp", problems=((1, f"larger than {LARGEST} characters: the file is not read"),))
    text = text.removeprefix("\ufeff")
    readable = blanks.readable(text)
    data, root, splits = _tree(readable)
    if root is None:
        return Program("cpp", problems=((1, "too unlike C++ to parse in reasonable time: the file is not read"),))
    unit = unit_of(data)
    unit.found.callable_macros.update(macros or {})
    unit.found.splits = splits
    whole = readable.encode("utf-8", "replace").decode("latin-1") if splits else ""
    unit.found.directed = whole if len(whole) == len(data) else ""
    scopes.declare(unit, [root], CppScope(), 0)
    return _program(unit, readable)


def tree_of(text: str) -> tuple[bytes, Node | None]:
    """The tree of *text* with the least in errors, and what was parsed for it: the same length, some of it blank."""
    data, root, _ = _tree(text)
    return data, root


def _tree(text: str) -> tuple[bytes, Node | None, tuple[branches.Split, ...]]:
    """The same, and the branches that are left of conditionals of which only one can be parsed."""
    splits: tuple[branches.Split, ...] = ()
    data = text.encode("utf-8", "replace")
    root = parse(data)
    for reduce in (lambda text: (blanks.simplified(text), ()), branches.single):
        if root is None or not root.has_error:
            break
        reduced, left = reduce(text)
        if reduced != text:
            other = reduced.encode("utf-8", "replace")
            other_root = parse(other)
            if other_root is not None and _unread(other_root) < _unread(root):
                text, data, root, splits = reduced, other, other_root, left
    return data, root, splits


def _unread(root: Node) -> int:
    """How much of the text is in syntax errors; a bracket that had to be made up, too, is one."""
    return sum(node.end_byte - node.start_byte + 1 for node in (*errors(root, _COUNTED), *missing(root, _COUNTED)))


def _program(unit: Unit, text: str) -> Program:
    found = unit.found
    return Program(
        "cpp",
        functions=tuple(function for function in found.functions if function is not None),
        classes=tuple(class_ for class_ in found.classes if class_ is not None),
        variables=tuple(found.variables),
        aliases=tuple(found.aliases),
        scopes=tuple(found.scopes),
        includes=tuple(found.includes),
        macros=tuple(found.macros),
        registered=tuple(found.registered),
        problems=tuple(found.problems),
        directives=directives.found(text),
    )
