# SPDX-License-Identifier: Apache-2.0
"""What the conditions of Python come to that are the same in each run, as far as the text of one file tells."""

from __future__ import annotations

import ast
import operator
from collections.abc import Iterable, Mapping

from haros_ci.results.python_nodes import dotted

#: How deep a condition, or an ``if`` that leaves its block, is looked into.
DEEPEST = 20
#: The version of Python that every robot with Python 3 has at least, as conditions ask for it.
_OLDEST = (3, 6)
_COMPARED = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_LEAVES = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_EMPTY = ("list", "tuple", "dict", "set", "frozenset", "str", "bytes", "int", "float", "bool")


def constants_of(nodes: Iterable[ast.AST]) -> dict[str, object]:
    """The names of a module that one assignment alone gives a value, which is written there: ``DEBUG = False``."""
    values: dict[str, object] = {}
    others: set[str] = set()
    for node in nodes:
        if isinstance(node, ast.Module):
            for one in node.body:
                target = one.targets[0] if isinstance(one, ast.Assign) and len(one.targets) == 1 else None
                target = one.target if isinstance(one, ast.AnnAssign) else target
                value = one.value if isinstance(one, ast.Assign | ast.AnnAssign) else None
                if isinstance(target, ast.Name) and isinstance(value, ast.Constant) and target.id not in values:
                    values[target.id] = value.value
                    others.discard(target.id)
                elif isinstance(target, ast.Name):
                    others.add(target.id)
    stores: dict[str, int] = {}
    for node in nodes:
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            stores[node.id] = stores.get(node.id, 0) + 1
        elif isinstance(node, ast.Global):
            others.update(node.names)
        elif isinstance(node, ast.arg):
            others.add(node.arg)
        elif isinstance(node, ast.alias):
            others.add((node.asname or node.name).partition(".")[0])
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.ExceptHandler):
            others.add(node.name or "")
    return {name: value for name, value in values.items() if stores.get(name) == 1 and name not in others}


def truth(test: ast.expr, given: Mapping[str, object], depth: int = 0) -> bool | None:
    """What *test* always comes to with the constants *given*; None where that is not known."""
    if depth > DEEPEST:
        return None
    if isinstance(test, ast.Constant):
        return bool(test.value)
    if isinstance(test, ast.Name):
        if test.id in ("TYPE_CHECKING", "MYPY"):
            return False
        return True if test.id == "__debug__" else bool(given[test.id]) if test.id in given else None
    if isinstance(test, ast.Attribute):
        return False if test.attr == "TYPE_CHECKING" else None
    if isinstance(test, ast.List | ast.Tuple | ast.Set):
        return None if any(isinstance(one, ast.Starred) for one in test.elts) else bool(test.elts)
    if isinstance(test, ast.Dict):
        return None if None in test.keys else bool(test.keys)
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = truth(test.operand, given, depth + 1)
        return None if inner is None else not inner
    if isinstance(test, ast.BoolOp):
        decides = isinstance(test.op, ast.Or)
        parts = [truth(one, given, depth + 1) for one in test.values]
        return decides if decides in parts else None if None in parts else not decides
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        return _compared(test.left, test.ops[0], test.comparators[0], given)
    if isinstance(test, ast.Call) and isinstance(test.func, ast.Name) and test.func.id in _EMPTY and not test.keywords:
        if not test.args:
            return False
        return truth(test.args[0], given, depth + 1) if test.func.id == "bool" and len(test.args) == 1 else None
    return None


def is_empty(values: ast.expr, given: Mapping[str, object]) -> bool:
    """Whether a loop over *values* has no turn."""
    if isinstance(values, ast.Call) and isinstance(values.func, ast.Name) and values.func.id == "range":
        return len(values.args) == 1 and isinstance(values.args[0], ast.Constant) and values.args[0].value == 0
    is_text = isinstance(values, ast.Constant) and isinstance(values.value, str | bytes)
    is_group = isinstance(values, ast.List | ast.Tuple | ast.Set | ast.Dict | ast.Call)
    return (is_text or is_group) and truth(values, given) is False


def leaves(statement: ast.stmt, given: Mapping[str, object], depth: int = 0) -> bool:
    """Whether what stands behind *statement* in its block is never run."""
    if isinstance(statement, _LEAVES):
        return True
    if isinstance(statement, ast.Assert):
        return isinstance(statement.test, ast.Constant) and not statement.test.value
    if isinstance(statement, ast.If) and depth < DEEPEST:
        known = truth(statement.test, given)
        blocks = ((statement.body, known is not False), (statement.orelse, known is not True))
        return all(any(leaves(one, given, depth + 1) for one in block) for block, is_run in blocks if is_run)
    return False


def _compared(left: ast.expr, sign: ast.cmpop, right: ast.expr, given: Mapping[str, object]) -> bool | None:
    compare = _COMPARED.get(type(sign))
    if compare is None:
        return None
    if isinstance(left, ast.Name) and left.id == "__name__":
        other = right.value if isinstance(right, ast.Constant) else "__main__"
        return isinstance(sign, ast.NotEq) if isinstance(other, str) and not _is_module(other) else None
    is_first = isinstance(left, ast.Subscript) and isinstance(left.slice, ast.Constant) and left.slice.value == 0
    text = f"{dotted(left.value)}.major" if isinstance(left, ast.Subscript) and is_first else dotted(left)
    if text in ("sys.version_info.major", "version_info.major"):
        major = _constant(right, {})
        return bool(compare(3, major)) if isinstance(major, int) else None
    if text in ("sys.version_info", "version_info") and isinstance(right, ast.Tuple):
        least = tuple(one.value for one in right.elts if isinstance(one, ast.Constant) and isinstance(one.value, int))
        answers = {bool(compare((3, minor, 9), least)) for minor in range(_OLDEST[1], 30)}
        return answers.pop() if len(answers) == 1 and len(least) == len(right.elts) and least else None
    first, second = _constant(left, given), _constant(right, given)
    if isinstance(first, bool) or isinstance(second, bool):
        return None
    if isinstance(first, int) and isinstance(second, int):
        return bool(compare(first, second))
    return bool(compare(first, second)) if isinstance(first, str) and isinstance(second, str) else None


def _is_module(name: str) -> bool:
    """Whether a module can be called so when it is run or imported: then the answer is not known here."""
    return name == "__main__" or "." in name or name.startswith("__")


def _constant(node: ast.expr, given: Mapping[str, object]) -> object:
    if isinstance(node, ast.Constant):
        return node.value
    return given.get(node.id) if isinstance(node, ast.Name) else None
