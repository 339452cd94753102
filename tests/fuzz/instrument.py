# SPDX-License-Identifier: Apache-2.0
"""Coverage of the program's own modules: each block of their syntax trees sets a byte when it is entered.

``sys.monitoring`` is there from Python 3.12 on, and ``sys.settrace`` costs ten times what most readers do. A module that
is compiled with one more statement at the head of each block runs at nearly its own speed on every Python that is
supported. The texts that a function compares with are words of its format: they are kept as a dictionary for mutations.
"""

from __future__ import annotations

import ast
import builtins
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import CodeType, ModuleType
from typing import Any

#: More blocks than the program has; a module that is loaded later counts no further.
SIZE = 1 << 16
NAME = "__haros_ci_hit__"
_NO_TABLE = ("haros_ci.linters.catalogue", "haros_ci.extract.apis")  # nothing but tables
_LONGEST = 40
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)


class Coverage:
    """Which blocks have been entered since the start; *hits* are those of the present input."""

    def __init__(self) -> None:
        self.hits = bytearray(SIZE)
        self.count = 0
        self.words: dict[int, list[bytes]] = {}
        self._seen = 0
        self._none = bytes(SIZE)

    def clear(self) -> None:
        self.hits[:] = self._none

    def new(self) -> list[int]:
        """The blocks that no input before has entered; from now on they count as entered."""
        now = int.from_bytes(self.hits, "little")
        fresh = now & ~self._seen
        self._seen |= now
        found = []
        for place, value in enumerate(fresh.to_bytes(SIZE, "little")) if fresh else ():
            if value:
                found.append(place)
        return found

    @property
    def reached(self) -> int:
        return self._seen.bit_count()


class _Blocks(ast.NodeTransformer):
    def __init__(self, coverage: Coverage) -> None:
        self.coverage = coverage

    def visit(self, node: ast.AST) -> Any:
        super().generic_visit(node)
        if isinstance(node, _FUNCTIONS):
            place = self._enter(node.body, after_docstring=ast.get_docstring(node, clean=False) is not None)
            self.coverage.words[place] = sorted(set(_words(node)))
        elif isinstance(node, (ast.If, ast.For, ast.While, ast.ExceptHandler, ast.match_case)):
            self._enter(node.body)
            if getattr(node, "orelse", None):
                self._enter(node.orelse)  # type: ignore[union-attr]
        elif isinstance(node, ast.IfExp):
            node.body, node.orelse = self._value(node.body), self._value(node.orelse)
        elif isinstance(node, ast.BoolOp):
            node.values[1:] = [self._value(value) for value in node.values[1:]]
        return node

    def _next(self) -> int:
        self.coverage.count = min(self.coverage.count + 1, SIZE - 1)
        return self.coverage.count

    def _enter(self, body: list[ast.stmt], *, after_docstring: bool = False) -> int:
        place = self._next()
        at = 1 if after_docstring else 0
        near = _position(body[min(at, len(body) - 1)])
        hits, index = ast.Name(NAME, ast.Load(), **near), ast.Constant(place, **near)
        target = ast.Subscript(hits, index, ast.Store(), **near)
        body.insert(at, ast.Assign([target], ast.Constant(1, **near), **near))
        return place

    def _value(self, value: ast.expr) -> ast.expr:
        """*value*, and a byte set before it is evaluated: ``__setitem__`` gives None, so ``or`` goes on."""
        near = _position(value)
        put = ast.Attribute(ast.Name(NAME, ast.Load(), **near), "__setitem__", ast.Load(), **near)
        call = ast.Call(put, [ast.Constant(self._next(), **near), ast.Constant(1, **near)], [], **near)
        return ast.BoolOp(ast.Or(), [call, value], **near)


def _position(node: ast.expr | ast.stmt) -> dict[str, Any]:
    return {name: getattr(node, name) for name in ("lineno", "col_offset", "end_lineno", "end_col_offset")}


def _words(function: ast.AST) -> list[bytes]:
    found = []
    for node in ast.walk(function):
        if isinstance(node, ast.Constant) and isinstance(node.value, (str, bytes)):
            value = node.value.encode("utf-8", "surrogatepass") if isinstance(node.value, str) else node.value
            if 0 < len(value) <= _LONGEST and value.count(b" ") < 3:
                found.append(value)
    return found


class _Loader(SourceFileLoader):
    coverage: Coverage

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        tree = ast.parse(self.get_data(path), path)
        return compile(_Blocks(self.coverage).visit(tree), path, "exec", dont_inherit=True)


class _Finder(MetaPathFinder):
    def __init__(self, coverage: Coverage) -> None:
        self.coverage = coverage

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if not fullname.startswith(("haros_ci.", "haros_ci_checks.")) or fullname.startswith(_NO_TABLE):
            return None
        spec = PathFinder.find_spec(fullname, path, target)
        if spec is not None and isinstance(spec.loader, SourceFileLoader):
            spec.loader = _Loader(fullname, spec.loader.get_filename(fullname))
            spec.loader.coverage = self.coverage
        return spec


def install() -> Coverage:
    """Instrument every module of haros_ci that is imported from now on."""
    coverage = Coverage()
    setattr(builtins, NAME, coverage.hits)
    sys.meta_path.insert(0, _Finder(coverage))
    return coverage
