# SPDX-License-Identifier: Apache-2.0
"""Idioms of Python that pylint takes for slips: a thread to be replaced, a class attribute for subclasses, statements of several parts."""

from __future__ import annotations

import ast
import builtins
import re
import textwrap
import warnings
from functools import lru_cache

from haros_ci.linters.python_bindings import is_of_tests
from haros_ci.regex import regex
from haros_ci.results.python_nodes import dotted, is_same
from haros_ci.results.scope import scopes

#: Lines of one statement, and characters of a line, that are looked at.
_MOST = 12
_LONGEST = 400
#: How far above a loop a dictionary is made.
_MADE = 60
_THREAD = regex(r"[ \t]*((?:\w+\.)?\w+)[ \t]*(?::[^=\n]{0,80})?=[ \t]*(?:[\w.]+\.)?\w*Thread\([ \t]*\)")
_ATTRIBUTE = regex(r"(?:self|cls)\.(\w+)[ \t]*\(")
_ABSTRACT = regex(r"\bABC(?:Meta)?\b|\babstract|\bNotImplementedError\b", re.IGNORECASE)
_WORD = regex(r"[^\W\d]\w*")
#: How methods call the object, the class, and the class of a class.
_OBJECTS = frozenset(("self", "cls", "mcs", "mcls", "metacls", "klass", "this"))
#: A call on one line with ``*x`` or ``**x`` among its arguments, none of which has brackets of its own before it.
_CALL_UNPACKED = regex(r"[\w.]{1,200}\((?:[^()\n]{0,200},)?[ \t]{0,20}\*{1,2}[ \t]{0,20}[\w(\[{]")


def is_unpacked(text: str, line: int, column: int) -> bool:
    """Whether the call that begins there is given a list or dict of which each element is an argument: ``f(*args)``. *text* is without comments."""
    lines = text.split("\n")
    rest = lines[line - 1][column : column + _LONGEST] if 0 < line <= len(lines) else ""
    return _CALL_UNPACKED.match(rest) is not None


def is_placeholder(text: str, line: int) -> bool:
    """Whether the thread without a target that *line* makes is given another value, a thread with one, in the same class."""
    lines = text.split("\n")
    made = _THREAD.match(lines[line - 1][:_LONGEST]) if 0 < line <= len(lines) else None
    if made is None:
        return False
    again = re.compile(
        rf"[ \t]*{re.escape(made[1])}[ \t]*(?::[^=\n]{{0,80}})?=[ \t]*(?:[\w.]+\.)?\w*(?:Thread|Timer)\([ \t]*(?![ \t)])"
    )
    inside = scopes(text, "python")
    owner = _class_of(inside.at(line))
    return any(
        again.match(item[:_LONGEST]) and number != line and _class_of(inside.at(number)) == owner
        for number, item in enumerate(lines, start=1)
    )


def is_left_to_subclasses(text: str, line: int, column: int) -> bool:
    """Whether what is called there is an attribute of an abstract class that is None in it: subclasses set a class or function."""
    lines = text.split("\n")
    called = _ATTRIBUTE.match(lines[line - 1][:_LONGEST], column) if 0 < line <= len(lines) else None
    if called is None:
        return False
    inside = scopes(text, "python")
    none = re.compile(rf"[ \t]+{re.escape(called[1])}[ \t]*(?::[^=\n]{{0,80}})?=[ \t]*None\b")
    bodies: dict[str, list[str]] = {}
    owners = set()  # the class itself, or one of the file that it inherits
    for number, item in enumerate(lines, start=1):
        owner = _class_of(inside.at(number))
        bodies.setdefault(owner, []).append(item[:_LONGEST].partition("#")[0])
        if owner and inside.at(number) == owner and none.match(item[:_LONGEST]):
            owners.add(owner)
    return any(_ABSTRACT.search(body) for owner in owners for body in bodies[owner])


def is_choice_of_calls(text: str, line: int) -> bool:
    """Whether the statement there is a conditional expression that calls one thing or another: an if statement, only shorter."""
    statement = _statement(text, line)
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.IfExp) and _only_calls(statement.value)


@lru_cache(maxsize=2)
def nodes(text: str) -> tuple[ast.AST, ...]:
    """All that a Python file is made of, from the outermost to the innermost; nothing of one that is not understood."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    return tuple(ast.walk(tree))


def is_to_fail(text: str, line: int) -> bool:
    """Whether a test calls there what is to raise a TypeError: in the block, or in a lambda, of ``pytest.raises`` or ``assertRaises``."""
    if "aises" not in text:
        return False
    for node in nodes(text):
        if isinstance(node, ast.With | ast.AsyncWith):
            calls = [item.context_expr for item in node.items]
            is_inside = node.body[0].lineno <= line <= (node.end_lineno or 0)
            if is_inside and any(_awaits_type_error(call, text) for call in calls):
                return True
        elif isinstance(node, ast.Call) and node.lineno <= line <= (node.end_lineno or 0):
            if _awaits_type_error(node, text):
                return any(
                    isinstance(argument, ast.Lambda) and argument.lineno <= line <= (argument.end_lineno or 0)
                    for argument in node.args
                )
    return False


def _awaits_type_error(node: ast.expr, text: str) -> bool:
    """Whether *node* is a call of ``raises`` or ``assertRaises`` of a test framework in *text*; another exception that Python has built in is not what a wrong call raises."""
    if not isinstance(node, ast.Call) or not is_of_tests(node.func, nodes(text)):
        return False
    arguments = [*node.args[:1], *(keyword.value for keyword in node.keywords if keyword.arg == "expected_exception")]
    kinds = [elt for one in arguments for elt in (one.elts if isinstance(one, ast.Tuple) else [one])]
    named = [getattr(builtins, kind.id, None) if isinstance(kind, ast.Name) else None for kind in kinds]
    return not named or any(not isinstance(item, type) or issubclass(TypeError, item) for item in named)


def is_one_of_several(text: str, line: int) -> bool:
    """Whether the assignment there sets several variables, and only some of them to themselves: the others change."""
    statement = _statement(text, line)
    if not isinstance(statement, ast.Assign) or not isinstance(statement.value, ast.Tuple):
        return False
    target, values = statement.targets[0], statement.value.elts
    if not isinstance(target, ast.Tuple) or len(target.elts) != len(values):
        return False
    return any(not is_same(one, other) for one, other in zip(target.elts, values, strict=True))


def _only_calls(node: ast.expr) -> bool:
    """Whether both ends of a conditional expression are calls, or one is and the other does nothing."""
    if not isinstance(node, ast.IfExp):
        return isinstance(node, (ast.Call, ast.Await))
    ends = [other_node for other_node in (node.body, node.orelse) if not isinstance(other_node, ast.Constant)]
    return bool(ends) and all(_only_calls(end) for end in ends)


def _statement(text: str, line: int) -> ast.stmt | None:
    """The simple statement that begins at *line*, counted from 1; None if it is not one alone, or of too many lines."""
    lines = [part[: _LONGEST + 1] for part in text.split("\n")[max(line - 1, 0) : line - 1 + _MOST]]
    if line < 1 or any(len(item) > _LONGEST for item in lines[:1]):
        return None
    for end in range(1, len(lines) + 1):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = ast.parse(textwrap.dedent("\n".join([lines[0], *lines[1:end]])).lstrip()).body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
        return found[0] if len(found) == 1 else None
    return None


def _class_of(scope: str) -> str:
    """The class that *scope*, a class or one of its methods, is of."""
    return scope.partition(".")[0]


def is_stub(text: str, line: int) -> bool:
    """Whether the expression at *line* is ``None`` or ``...``, and the whole body of a function: it stands for ``pass``."""
    lines = text.split("\n")
    here = lines[line - 1].partition("#")[0].strip() if 0 < line <= len(lines) else ""
    if not here.endswith(("None", "...")):
        return False
    for function in nodes(text):
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            body = function.body[1:] if ast.get_docstring(function, clean=False) is not None else function.body
            if len(body) == 1 and isinstance(body[0], ast.Expr) and body[0].lineno == line:
                value = body[0].value
                return isinstance(value, ast.Constant) and value.value in (None, ...)
    return False


def is_instead_of_import(text: str, line: int) -> bool:
    """Whether the function or class at *line* takes the name of what the file imports and does not use before: the import alone is too much."""
    tree = nodes(text)
    defined = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
    node = next((one for one in tree if isinstance(one, defined) and _first_line(one) <= line <= one.lineno), None)
    if node is None or node.col_offset:
        return False
    above = [one for one in tree if 0 < getattr(one, "lineno", 0) < _first_line(node)]
    bound = [one for one in above if isinstance(one, defined) and one.name == node.name]
    imported = [
        one
        for one in above
        if isinstance(one, (ast.Import, ast.ImportFrom))
        and any(_bound(alias) in (node.name, "*") for alias in one.names)
    ]
    return bool(imported) and not bound and not any(isinstance(one, ast.Name) and one.id == node.name for one in above)


def _first_line(node: ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) -> int:
    return min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])


def _bound(alias: ast.alias) -> str:
    return alias.asname or alias.name.partition(".")[0]


def is_no_object(text: str, line: int, column: int) -> bool:
    """Whether what is assigned there is called neither ``self`` nor ``cls``: the method lacks its first parameter, and assigns to its second one.

    Or it is what a method of the base class gives back of the object, and is returned: ``self = super().cuda()``.
    """
    if _is_given_back(text, line):
        return True
    lines = text.split("\n")
    found = _WORD.match(lines[line - 1], column) if 0 < line <= len(lines) else None
    return found is not None and found[0] not in _OBJECTS


def _is_given_back(text: str, line: int) -> bool:
    for node in nodes(text):
        body = node.body if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) else []
        found = next((one for one in body if isinstance(one, ast.Assign) and one.lineno == line), None)
        if found is None or not isinstance(found.value, ast.Call) or not isinstance(found.value.func, ast.Attribute):
            continue
        base, last = found.value.func.value, body[-1]
        is_base = isinstance(base, ast.Call) and isinstance(base.func, ast.Name) and base.func.id == "super"
        given = last.value if isinstance(last, ast.Return) else None
        return is_base and isinstance(given, ast.Name) and any(dotted(one) == given.id for one in found.targets)
    return False


def is_of_known_key(text: str, line: int) -> bool:
    """Whether the statement at *line* sets a key that the dictionary has been made with, by a literal above: its size stays, and the loop goes on."""
    statement = _statement(text, line)
    target = statement.targets[0] if isinstance(statement, ast.Assign) else None
    target = statement.target if isinstance(statement, ast.AugAssign) else target
    if not isinstance(target, ast.Subscript) or not isinstance(target.slice, ast.Constant):
        return False
    held, key = target.value, target.slice.value
    made = [node for node in nodes(text) if isinstance(node, ast.Assign) and 0 < line - node.lineno <= _MADE]
    last = [node for node in made if any(is_same(one, held) for one in node.targets)][-1:]
    return any(
        isinstance(node.value, ast.Dict)
        and any(isinstance(one, ast.Constant) and one.value == key for one in node.value.keys)
        for node in last
    )
