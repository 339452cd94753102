# SPDX-License-Identifier: Apache-2.0
"""What the conditions of Python come to that are the same in each run, as far as the text of one file tells."""

from __future__ import annotations

import ast
import operator
from collections.abc import Iterable, Iterator, Mapping

from haros_ci.results.constant_values import UNKNOWN, value_of
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


def constants_of(nodes: Iterable[ast.AST]) -> dict[str, object]:
    """The names that one assignment alone gives a value, in a module or in a function, which is written there: ``DEBUG = False``."""
    every = tuple(nodes)
    others: set[str] = set()
    stores: dict[str, int] = {}
    for node in every:
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            stores[node.id] = stores.get(node.id, 0) + 1
        elif isinstance(node, ast.Global | ast.Nonlocal):
            others.update(node.names)
        elif isinstance(node, ast.arg):
            others.add(node.arg)
        elif isinstance(node, ast.alias):
            others.add((node.asname or node.name).partition(".")[0])
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.ExceptHandler):
            others.add(node.name or "")
    blocks = [node.body for node in every if isinstance(node, ast.Module)]
    if "*" not in others:  # else a module may have the name of a variable of a function from elsewhere
        blocks += [node.body for node in every if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    values: dict[str, object] = {}
    for one in (statement for block in blocks for statement in block):
        targets = one.targets if isinstance(one, ast.Assign) else [one.target] if isinstance(one, ast.AnnAssign) else []
        names = [it.id for it in targets if isinstance(it, ast.Name) and it.id not in others and stores[it.id] == 1]
        if names and isinstance(one, ast.Assign | ast.AnnAssign) and one.value is not None:
            value = value_of(one.value, values)
            values.update(dict.fromkeys(names, value) if _is_plain(value) else {})
    return values


def _is_plain(value: object) -> bool:
    """Whether nothing can be added to it later, as to a list."""
    return value is None or isinstance(value, bool | int | float | str | bytes)


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
    if isinstance(test, ast.List | ast.Tuple | ast.Set | ast.Dict):
        return _is_filled(test)
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = truth(test.operand, given, depth + 1)
        return None if inner is None else not inner
    if isinstance(test, ast.BoolOp):
        decides = isinstance(test.op, ast.Or)
        parts = [truth(one, given, depth + 1) for one in test.values]
        return decides if decides in parts else None if None in parts else not decides
    if isinstance(test, ast.IfExp):
        known = truth(test.test, given, depth + 1)
        return None if known is None else truth(test.body if known else test.orelse, given, depth + 1)
    if isinstance(test, ast.JoinedStr):
        texts = [bool(one.value) for one in test.values if isinstance(one, ast.Constant)]
        return any(texts) or (None if len(texts) < len(test.values) else False)
    if isinstance(test, ast.Lambda):
        return True
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        asked = _asked(test.left, test.ops[0], test.comparators[0])
        if asked is not None:
            return asked
    value = value_of(test, given)
    return None if value is UNKNOWN else bool(value)


def _is_filled(group: ast.List | ast.Tuple | ast.Set | ast.Dict) -> bool | None:
    """Whether something is written in *group*; None where some of it comes from elsewhere (``[*found]``)."""
    if isinstance(group, ast.Dict):
        return None if None in group.keys else bool(group.keys)
    return None if any(isinstance(one, ast.Starred) for one in group.elts) else bool(group.elts)


def is_empty(values: ast.expr, given: Mapping[str, object]) -> bool:
    """Whether a loop over *values* has no turn."""
    if isinstance(values, ast.Call) and isinstance(values.func, ast.Name) and values.func.id == "range":
        numbers = [value_of(one, given) for one in values.args]
        if values.keywords or not all(isinstance(one, int) for one in numbers) or not 0 < len(numbers) < 4:
            return False
        try:
            return not range(*(one for one in numbers if isinstance(one, int)))
        except ValueError:  # a step of 0
            return False
    is_text = isinstance(values, ast.Constant) and isinstance(values.value, str | bytes)
    is_group = isinstance(values, ast.List | ast.Tuple | ast.Set | ast.Dict | ast.Call)
    return (is_text or is_group) and truth(values, given) is False


def matches(pattern: ast.pattern, subject: object, given: Mapping[str, object], depth: int = 0) -> bool | None:
    """Whether a case with *pattern* takes the value *subject* of a ``match``; None where that is not known."""
    if depth > DEEPEST:
        return None
    if isinstance(pattern, ast.MatchAs):
        return True if pattern.pattern is None else matches(pattern.pattern, subject, given, depth + 1)
    if not _is_plain(subject):
        return None
    if isinstance(pattern, ast.MatchOr):
        parts = [matches(one, subject, given, depth + 1) for one in pattern.patterns]
        return True if True in parts else None if None in parts else False
    if isinstance(pattern, ast.MatchSingleton):
        return subject is pattern.value
    if isinstance(pattern, ast.MatchValue):
        value = value_of(pattern.value, given)
        return bool(subject == value) if _is_plain(value) else None
    return False if isinstance(pattern, ast.MatchSequence | ast.MatchMapping) else None


def cases(statement: ast.Match, given: Mapping[str, object]) -> Iterator[tuple[ast.match_case, bool]]:
    """The cases of a ``match``, each with whether it may be run."""
    subject = value_of(statement.subject, given)
    is_over = False
    for case in statement.cases:
        found = matches(case.pattern, subject, given)
        guard = True if case.guard is None else truth(case.guard, given)
        yield case, not is_over and found is not False and guard is not False
        is_over = is_over or (found is True and guard is True)


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


def _asked(left: ast.expr, sign: ast.cmpop, right: ast.expr) -> bool | None:
    """The answer of a question on the name of the module, or on the version of Python."""
    compare = _COMPARED.get(type(sign))
    if compare is None:
        return None
    if isinstance(left, ast.Name) and left.id == "__name__":
        other = right.value if isinstance(right, ast.Constant) else "__main__"
        return isinstance(sign, ast.NotEq) if isinstance(other, str) and not _is_module(other) else None
    is_first = isinstance(left, ast.Subscript) and isinstance(left.slice, ast.Constant) and left.slice.value == 0
    text = f"{dotted(left.value)}.major" if isinstance(left, ast.Subscript) and is_first else dotted(left)
    if text in ("sys.version_info.major", "version_info.major"):
        major = value_of(right, {})
        return bool(compare(3, major)) if isinstance(major, int) else None
    if text in ("sys.version_info", "version_info") and isinstance(right, ast.Tuple):
        least = tuple(one.value for one in right.elts if isinstance(one, ast.Constant) and isinstance(one.value, int))
        answers = {bool(compare((3, minor, 9), least)) for minor in range(_OLDEST[1], 30)}
        return answers.pop() if len(answers) == 1 and len(least) == len(right.elts) and least else None
    return None


def _is_module(name: str) -> bool:
    """Whether a module can be called so when it is run or imported: then the answer is not known here."""
    return name == "__main__" or "." in name or name.startswith("__")
