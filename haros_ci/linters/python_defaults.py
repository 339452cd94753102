# SPDX-License-Identifier: Apache-2.0
"""Whether a mutable default of a Python function can be changed at all, so that calls would share the change."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterator
from functools import lru_cache

_Function = ast.FunctionDef | ast.AsyncFunctionDef

#: Methods that leave a list, dictionary or set as it is.
_READING = frozenset(
    "copy count difference get index intersection isdisjoint issubset issuperset items keys union values".split()
)
#: Types whose calls pylint and ruff take for mutable defaults.
_MUTABLE = frozenset("Counter OrderedDict bytearray defaultdict deque dict list set".split())
#: Functions of the standard library that change what they are given (heapq, bisect, operator, random).
_CHANGING = frozenset(
    """
    heapify heappop heappush heappushpop heapreplace insort insort_left insort_right iadd iand iconcat imul ior isub ixor setitem delitem shuffle
    append insert setdefault setattr partial __init__
    """.split()
)
#: Functions and parameters of theirs that have been looked at: each once.
_Seen = set[tuple[int, str]]


def is_only_read(text: str, line: int, column: int | None = None) -> bool:
    """Whether the function at *line* (from 1) of *text* only reads its mutable defaults.

    With *column* (from 0) that of the one default that stands there. A default that is changed, returned, stored,
    renamed or handed to a class is not only read; one that is handed to a function is, unless that function is of this
    module and does one of these. Where *text* is no Python or there is no such function, nothing is known: False.
    """
    functions = _functions(text)
    of_module = {node.name: node for node in functions}
    for function in functions:
        names = [
            name
            for name, default in _defaults(function)
            if (
                function.lineno == line
                if column is None
                else (default.lineno, _column(text, default)) == (line, column)
            )
        ]
        if names:
            seen: _Seen = set()
            return not any(_is_at_risk(function, name, of_module, seen) for name in names)
    return False


@lru_cache(maxsize=4)
def _functions(text: str) -> tuple[_Function, ...]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return tuple(node for node in ast.walk(ast.parse(text)) if isinstance(node, _Function))
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return ()


def _column(text: str, node: ast.expr) -> int:
    """The column in code points of *node*, whose own counts bytes."""
    line = text.split("\n")[node.lineno - 1]
    return len(line.encode("utf-8", "replace")[: node.col_offset].decode("utf-8", "ignore"))


def _last_name(node: ast.expr) -> str:
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""


def _defaults(function: _Function) -> Iterator[tuple[str, ast.expr]]:
    """Each parameter with a default that is made by a display or a call."""
    arguments = function.args
    placed = [*arguments.posonlyargs, *arguments.args]
    pairs = [*zip(placed[len(placed) - len(arguments.defaults) :], arguments.defaults, strict=True)]
    pairs += [
        (name, default) for name, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True) if default
    ]
    for name, default in pairs:
        made = isinstance(default, ast.List | ast.Dict | ast.Set | ast.ListComp | ast.DictComp | ast.SetComp)
        if made or (isinstance(default, ast.Call) and _last_name(default.func) in _MUTABLE):
            yield name.arg, default


def _is_at_risk(function: _Function, name: str, of_module: dict[str, _Function], seen: _Seen) -> bool:
    """Whether *function* does more with its parameter *name* than to read it; False where it has been *seen*."""
    if (function.lineno, name) in seen:
        return False
    seen.add((function.lineno, name))
    parents = {child: node for node in ast.walk(function) for child in ast.iter_child_nodes(node)}
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and node.id == name:
            if isinstance(node.ctx, ast.Store | ast.Del):
                if isinstance(parents[node], ast.AugAssign):
                    return True
            elif _is_more_than_read(node, parents, of_module, seen):
                return True
    return False


def _is_more_than_read(
    node: ast.expr, parents: dict[ast.AST, ast.AST], of_module: dict[str, _Function], seen: _Seen
) -> bool:
    parent = parents[node]
    if isinstance(parent, ast.Subscript) and parent.value is node:
        return not isinstance(parent.ctx, ast.Load)
    if isinstance(parent, ast.Attribute):
        called = parents[parent]
        return not (isinstance(called, ast.Call) and called.func is parent and parent.attr in _READING)
    if isinstance(parent, ast.keyword):
        call = parents[parent]
        return isinstance(call, ast.Call) and _keeps(call, parent, of_module, seen)
    if isinstance(parent, ast.Call):
        return _keeps(parent, node, of_module, seen)
    if isinstance(parent, ast.BoolOp | ast.IfExp | ast.NamedExpr | ast.Starred):
        return isinstance(parent, ast.NamedExpr) or _is_more_than_read(parent, parents, of_module, seen)
    if isinstance(parent, ast.Assign) and all(isinstance(target, ast.Tuple | ast.List) for target in parent.targets):
        return False  # taken apart
    if isinstance(parent, ast.Assign | ast.AnnAssign | ast.Return | ast.Yield | ast.YieldFrom | ast.Await | ast.Lambda):
        return True
    return isinstance(parent, ast.Tuple | ast.List | ast.Set | ast.Dict | ast.AugAssign) and not _is_tested(
        parent, parents
    )


def _is_tested(node: ast.AST, parents: dict[ast.AST, ast.AST]) -> bool:
    """Whether a display is only looked at: in a comparison, a format, or a loop; ``total += default`` copies."""
    return isinstance(node, ast.AugAssign) or isinstance(
        parents[node], ast.Compare | ast.BinOp | ast.For | ast.comprehension
    )


def _keeps(call: ast.Call, argument: ast.AST, of_module: dict[str, _Function], seen: _Seen) -> bool:
    """Whether what is called may keep or change *argument*: a class, or a function here that does."""
    callee = call.func
    name = _last_name(callee)
    if name == "extend":
        return False
    if not name or name[:1].isupper() or name in _CHANGING:
        return True
    own = of_module.get(name)
    if own is None:
        return False
    placed = [parameter.arg for parameter in (*own.args.posonlyargs, *own.args.args)]
    if isinstance(argument, ast.keyword):
        parameter = argument.arg
    else:
        index = call.args.index(argument) if argument in call.args else len(placed)
        index += isinstance(callee, ast.Attribute) and placed[:1] in (["self"], ["cls"])
        parameter = placed[index] if index < len(placed) else None
    return parameter is None or _is_at_risk(own, parameter, of_module, seen)
