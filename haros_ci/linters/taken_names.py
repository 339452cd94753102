# SPDX-License-Identifier: Apache-2.0
"""Names that a Python file takes from modules: by imports, and as their attributes."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex
from haros_ci.results.constant_tests import constants_of, leaves, truth
from haros_ci.results.python_nodes import dotted, mentions

_MISSING = regex(r"\b(?:ImportError|ModuleNotFoundError|AttributeError|Exception|BaseException)\b")


def taken(text: str) -> Iterator[tuple[str, str, int]]:
    """The modules, as imports have them, the names that the file takes from them, and the lines; of what is run, and awaits no error."""
    every = nodes(text)
    given = constants_of(every)
    skipped: set[int] = set()
    imported: dict[str, str] = {}
    found: list[tuple[str, str, int]] = []
    for node in every:  # from the outermost to the innermost
        is_skipped = id(node) in skipped
        if not is_skipped:
            skipped.update(id(one) for one in _unrun(node, given))
        else:
            skipped.update(id(one) for one in ast.iter_child_nodes(node))
            continue
        if isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            package, _, last = (node.module or "").rpartition(".")
            if last and (package or node.level):
                found.append(("." * node.level + package, last, node.lineno))
            for alias in node.names:
                found.append((module, alias.name, node.lineno))
                imported[alias.asname or alias.name] = f"{module}.{alias.name}" if node.module else module + alias.name
        elif isinstance(node, ast.Import):
            for alias in node.names:
                package, _, name = alias.name.rpartition(".")
                if package:
                    found.append((package, name, node.lineno))
                imported[alias.asname or alias.name] = alias.name
                if (
                    alias.name == "os"
                ):  # the one package of Python's own that brings a module along under a name of the system's
                    imported[f"{alias.asname or 'os'}.path"] = "os.path"
        elif isinstance(node, ast.Call) and dotted(node.func).rpartition(".")[2] == "import_module":
            given_name = node.args[0].value if node.args and isinstance(node.args[0], ast.Constant) else None
            package, _, name = given_name.rpartition(".") if isinstance(given_name, str) else ("", "", "")
            if package.strip("."):
                found.append((package, name, node.lineno))
    yield from found
    yield from _attributes(every, skipped, imported)


def _attributes(
    every: Iterable[ast.AST], skipped: set[int], imported: dict[str, str]
) -> Iterator[tuple[str, str, int]]:
    """What is taken from modules as attributes of the names that stand for them, where these stand for nothing else."""
    others: set[str] = set()
    given: set[tuple[str, str]] = set()
    count: dict[str, int] = {}
    used: list[tuple[str, str, int]] = []
    for node in every:
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            others.add(node.id)
        elif isinstance(node, ast.arg):
            others.add(node.arg)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.ExceptHandler):
            others.add(node.name or "")
        elif isinstance(node, ast.alias):
            name = node.asname or node.name.partition(".")[0]
            count[name] = count.get(name, 0) + 1
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            if node.func.id in ("hasattr", "getattr", "setattr", "delattr"):
                others.update(one.id for one in node.args[:1] if isinstance(one, ast.Name))
        elif isinstance(node, ast.Attribute) and (name := dotted(node.value)) in imported:
            if not isinstance(node.ctx, ast.Load):
                given.add((name, node.attr))
            elif id(node) not in skipped:
                used.append((name, node.attr, node.lineno))
    for name, attribute, line in used:
        first, dot, _ = name.partition(".")
        if first not in others and (dot or count.get(name) == 1) and (name, attribute) not in given:
            yield imported[name], attribute, line


def _unrun(node: ast.AST, given: dict[str, object]) -> Iterator[ast.AST]:
    """The parts of *node* that are not run, or that may fail: somebody awaits it."""
    if isinstance(node, ast.If | ast.While):
        known = truth(node.test, given)
        yield from node.body if known is False else ()
        yield from node.orelse if known is True else ()
    elif isinstance(node, ast.Try) and any(one.type is None or mentions(one.type, _MISSING) for one in node.handlers):
        yield from (*node.body, *node.handlers)
    for name in ("body", "orelse", "finalbody"):
        block = getattr(node, name, None)
        if isinstance(block, list):
            last = next(
                (i for i, one in enumerate(block) if isinstance(one, ast.stmt) and leaves(one, given)), len(block)
            )
            yield from block[last + 1 :]
