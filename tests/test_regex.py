# SPDX-License-Identifier: Apache-2.0
"""Regular expressions that are compiled when they are first used: all of them compile, and do what compiled ones do."""

from __future__ import annotations

import ast
import pickle
import pkgutil
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import haros_ci_checks
import pytest

import haros_ci
import haros_ci.extract.cpp.read  # its modules cannot be imported in any order
from haros_ci.regex import regex

LAZY = type(regex(""))
PACKAGE, CHECKS = Path(haros_ci.__path__[0]), Path(haros_ci_checks.__path__[0])


def _defined() -> Iterator[Any]:
    """What modules and their classes define, and what stands in their tuples, lists and tables."""
    for package in (haros_ci, haros_ci_checks):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if ".parts" in module.name or module.name.endswith(("__main__", "_worker")):
                continue
            for value in vars(import_module(module.name)).values():
                yield from vars(value).values() if isinstance(value, type) else (value,)


def _regexes() -> list[Any]:
    todo, found = list(_defined()), []
    for value in todo:
        if isinstance(value, LAZY):
            found.append(value)
        elif isinstance(value, (tuple, list, set, frozenset)):
            todo.extend(value)
        elif isinstance(value, dict):
            todo.extend(value.values())
    return found


def test_all_that_modules_define_compile() -> None:
    found = _regexes()
    assert len(found) > 1_000
    wrong = []
    for expression in found:
        try:
            re.compile(expression.pattern, expression.flags)
        except re.error as error:
            wrong.append(f"{expression.pattern!r}: {error}")
    assert not wrong


def test_it_does_what_a_compiled_one_does() -> None:
    lazy, compiled = regex(r"(?P<name>\w)(\d+)", re.IGNORECASE), re.compile(r"(?P<name>\w)(\d+)", re.IGNORECASE)
    text = "a1 b22 -"
    assert lazy.findall(text) == compiled.findall(text)
    assert [found.span() for found in lazy.finditer(text)] == [found.span() for found in compiled.finditer(text)]
    assert lazy.sub(r"\2", text) == compiled.sub(r"\2", text) == "1 22 -"
    assert lazy.subn("", text) == compiled.subn("", text)
    assert lazy.split("x1y") == compiled.split("x1y")
    found, other = lazy.search(text, 2), lazy.match("-")
    assert (found and found["name"], other) == ("b", None)
    assert lazy.fullmatch("c3") is not None
    assert (lazy.pattern, lazy.flags, lazy.groups) == (compiled.pattern, compiled.flags, compiled.groups)
    assert dict(lazy.groupindex) == dict(compiled.groupindex) == {"name": 1}


def test_its_pattern_is_there_before_it_is_compiled() -> None:
    assert regex("(").pattern == "("


def test_a_mistake_is_raised_when_it_is_used() -> None:
    with pytest.raises(re.error):
        regex("(").search("a")


def test_it_goes_to_other_processes() -> None:
    again = pickle.loads(pickle.dumps(regex(r"a.", re.DOTALL)))
    assert again.findall("a\n") == ["a\n"]


def test_what_it_does_not_have_is_an_attribute_error() -> None:
    assert not hasattr(regex("a"), "replace")


def _at_import(tree: ast.AST) -> Iterator[ast.AST]:
    """What runs when a module is imported."""
    todo = [tree]
    while todo:
        node = todo.pop()
        yield node
        inner = ast.iter_child_nodes(node)
        todo += [node.args] if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) else list(inner)


def test_modules_compile_nothing_when_they_are_imported() -> None:
    found = []
    for path in (*PACKAGE.rglob("*.py"), *CHECKS.glob("*.py")):
        # parts are copied into files of users, workers are processes of their own that load nothing else of ours
        if "parts" in path.parts or path.name.endswith("_worker.py") or path.name in ("regex.py", "records.py"):
            continue
        for node in _at_import(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "re.compile":
                found.append(f"{path.name}:{node.lineno}: write regex(), of haros_ci.regex or haros_ci.api")
            elif isinstance(node, ast.ImportFrom) and node.module == "dataclasses":
                if {"dataclass", "field"} & {alias.name for alias in node.names}:
                    found.append(
                        f"{path.name}:{node.lineno}: import dataclass and field from haros_ci.records or haros_ci.api"
                    )
    assert not found
