# SPDX-License-Identifier: Apache-2.0
"""Statements and expressions of Python that pylint takes for mistakes, and that do what is meant or no harm."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from typing import TypeGuard

from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex
from haros_ci.results.python_nodes import dotted, is_same

#: An operand; what NumPy 2 declares as functions that return their own arguments, as C does the work.
_OPERAND = regex(r"[-+~ \t(]*([A-Za-z_]\w*(?:\.\w+)*)")
_PRODUCT = regex(r"\b([A-Za-z_]\w*)[ \t]*=[ \t]*\w+\.(?:inner|vdot)[ \t]*\(")
_OF_PRODUCT = regex(r"\w+\.(?:inner|vdot)")
#: Characters of a line that are looked at.
_LONGEST = 400
_DEL = regex(r"[ \t]*del[ \t]+\(?\w+(?:[ \t]*,[ \t]*\w+)*\)?;?")
_NAN = regex(r"\bnan\b", re.IGNORECASE)
#: A field of ``str.format``; two braces are one of the text.
_FIELD = regex(r"(?<!\{)(?:\{\{)*\{(?!\{)")


def gives_names(text: str) -> bool:
    """Whether the module has a function ``__getattr__`` of its own that returns something: it gives names when they are asked for (PEP 562)."""
    tree = next(iter(nodes(text)), None) if "__getattr__" in text else None
    for node in tree.body if isinstance(tree, ast.Module) else ():
        if isinstance(node, ast.FunctionDef) and node.name == "__getattr__":
            return any(isinstance(inner, ast.Return) and inner.value is not None for inner in ast.walk(node))
        if isinstance(node, ast.Assign) and any(
            isinstance(name, ast.Name) and name.id == "__getattr__"
            for target in node.targets
            for name in ast.walk(target)
        ):
            return True
    return False


def has_items(text: str, line: int) -> bool:
    """Whether the comma at the end of *line* is the last of several: who unpacks so, or lists so, means a tuple."""
    lines = text.split("\n")
    here = lines[line - 1][:_LONGEST].partition("#")[0].rstrip() if 0 < line <= len(lines) else ""
    bare = re.sub(r"'[^']*'|\"[^\"]*\"", "", here)
    for _ in range(5):
        bare = re.sub(r"[(\[{][^()\[\]{}]*[)\]}]", "", bare)
    return bare.rpartition("=")[2].count(",") > 1


def unbinds(text: str, line: int) -> bool:
    """Whether the statement at *line* is ``del name``: it takes the name away, and leaves what is iterated over as it is."""
    lines = text.split("\n")
    return 0 < line <= len(lines) and _DEL.fullmatch(lines[line - 1][:_LONGEST].partition("#")[0].rstrip()) is not None


def is_stop_on_condition(text: str, line: int) -> bool:
    """Whether the call at *line* ends a block of calls that stands under a test alone (``if np.any(np.isnan(q)): breakpoint()``): what should not be is waited for."""
    for node in nodes(text):
        if isinstance(node, ast.If) and node.body[-1].lineno == line and not isinstance(node.test, ast.Constant):
            return all(isinstance(inner, ast.Expr) and isinstance(inner.value, ast.Call) for inner in node.body)
    return False


def is_product(text: str, line: int, column: int) -> bool:
    """Whether what stands there is a product of NumPy's inner() or vdot(), which pylint takes for the pair of its arguments (astroid knows the other functions)."""
    lines = text.split("\n")
    used = _OPERAND.match(lines[line - 1][column : column + _LONGEST]) if 0 < line <= len(lines) else None
    if used is None:
        return False
    name = used[1].partition(".")[0]
    return _OF_PRODUCT.fullmatch(used[1]) is not None or any(found[1] == name for found in _PRODUCT.finditer(text))


def is_text(text: str, line: int) -> bool:
    """Whether strings alone follow at *line* up to the end of the block: they stand there as comments."""
    for node in nodes(text):
        for body in _blocks(node):
            rest = [other_node for other_node in body if other_node.lineno >= line]
            if rest and rest[0].lineno == line and rest[0] is not body[0]:
                return all(_is_string(other_node) for other_node in rest)
    return False


def is_in_description(text: str, line: int) -> bool:
    """Whether *line* is in a string that is a statement of its own: a docstring, or a comment in quotes."""
    return any(
        isinstance(node, ast.stmt) and _is_string(node) and node.lineno <= line <= (node.end_lineno or 0)
        for node in nodes(text)
    )


def is_one_text(text: str, line: int) -> bool:
    """Whether the literals side by side on *line* are words of a text, and all that a call is given: no comma was forgotten between them."""
    found = False
    for node in nodes(text):
        arguments: list[ast.expr] = []
        if isinstance(node, ast.Call):
            arguments = node.args
        elif isinstance(node, ast.List | ast.Tuple | ast.Set):
            arguments = node.elts
        for other_node in arguments:
            if other_node.lineno != line or not _is_joined(text, other_node):
                continue
            if not isinstance(node, ast.Call) or len(node.args) > 1 or node.keywords or not _has_blank(other_node):
                return False
            found = other_node.end_lineno == line
            if not found:
                return False
    return found


def _has_blank(node: ast.expr) -> bool:
    """Whether one of the literals of a string has a blank."""
    return any(isinstance(p, ast.Constant) and isinstance(p.value, str) and " " in p.value for p in ast.walk(node))


def _is_joined(text: str, node: ast.expr) -> bool:
    """Whether *node* is a string of several literals."""
    if not isinstance(node, ast.JoinedStr) and not (isinstance(node, ast.Constant) and isinstance(node.value, str)):
        return False
    source = ast.get_source_segment(text, node) or ""
    try:
        tokens = list(tokenize.generate_tokens(io.StringIO(f"({source})").readline))
    except (tokenize.TokenError, SyntaxError, ValueError):
        return False
    start = getattr(
        tokenize, "FSTRING_START", -1
    )  # since Python 3.12; those inside of another are no literals of this one
    depth = count = 0
    for token in tokens:
        count += token.type in (tokenize.STRING, start) and depth == 0
        depth += (token.type == start) - (token.type == getattr(tokenize, "FSTRING_END", -1))
    return count > 1


def is_surplus(text: str, line: int, column: int) -> bool:
    """Whether ``str.format`` has more arguments there than fields, of which there are some: it ignores the rest, where ``%`` raises."""
    found, place = False, (line, _byte(text, line, column))
    for node in nodes(text):
        if (getattr(node, "lineno", 0), getattr(node, "col_offset", -1)) != place:
            continue
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mod):
            return False
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "format":
            value = node.func.value
            found = (
                isinstance(value, ast.Constant) and isinstance(value.value, str) and bool(_FIELD.search(value.value))
            )
    return found


def is_of_another(text: str, line: int) -> bool:
    """Whether ``super(A, it)`` at *line* speaks of another object than the one whose method it stands in, whose class is not the one around it."""
    for function in nodes(text):
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        if not function.lineno <= line <= (function.end_lineno or 0):
            continue
        first = next(iter((*function.args.posonlyargs, *function.args.args)), None)
        for node in ast.walk(function):
            if _is_super(node) and node.lineno == line and len(node.args) == 2:
                argument = node.args[1]
                return not isinstance(argument, ast.Name) or first is None or argument.id != first.arg
    return False


def is_test_for_nan(text: str, line: int) -> bool:
    """Whether a value is compared with itself there by ``!=``, which is true of NaN alone, in a file that knows NaN, or says so."""
    if _NAN.search(text) is None:
        return False
    return any(
        isinstance(node, ast.Compare)
        and node.lineno <= line <= (node.end_lineno or 0)
        and len(node.ops) == 1
        and isinstance(node.ops[0], ast.NotEq)
        and is_same(node.left, node.comparators[0])
        for node in nodes(text)
    )


def is_made_by_hand(text: str, line: int, column: int) -> bool:
    """Whether ``Class.__new__(Class)`` stands there: the class is given, which pylint takes for an argument that is missing."""
    place = (line, _byte(text, line, column))
    return any(
        isinstance(node, ast.Call)
        and (node.lineno, node.col_offset) == place
        and isinstance(node.func, ast.Attribute)
        and node.func.attr == "__new__"
        and bool(node.args)
        for node in nodes(text)
    )


def is_index_of_array(text: str, line: int, column: int) -> bool:
    """Whether the index of what begins at *line* and *column* is, or is made of, what a function of NumPy gave, or is one into that: ``rows[np.unravel_index(k, shape)[0]]``.

    Arrays take several indices at once (``np.dot(a, b)[0, i]``). pylint knows a few of these functions, and not what is in the arrays that they return.
    """
    if "numpy" not in text:
        return False
    names: set[str] = set()  # of modules, and of functions by themselves
    given: set[str] = set()
    for node in nodes(text):
        if isinstance(node, ast.Import):
            names.update(
                (alias.asname or alias.name) for alias in node.names if alias.name.partition(".")[0] == "numpy"
            )
        elif isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == "numpy":
            names.update((alias.asname or alias.name) for alias in node.names)
        elif isinstance(node, ast.Assign) and _is_called_on(node.value, names):
            given.update(
                inner.id for target in node.targets for inner in ast.walk(target) if isinstance(inner, ast.Name)
            )
    place = (line, _byte(text, line, column))
    every = [node for node in nodes(text) if isinstance(node, ast.Subscript)]
    here = [node for node in every if (node.lineno, node.col_offset) == place]
    # Before Python 3.12 what stands in a formatted text has no place of its own.
    here = here or [node for node in every if node.slice.lineno <= line <= (node.slice.end_lineno or 0)]
    return any(
        (isinstance(n, ast.Name) and n.id in given) or _is_called_on(n, names)
        for node in here
        for n in (*ast.walk(node.slice), *((node.value,) if isinstance(node.slice, ast.Tuple) else ()))
    )


def _is_called_on(node: ast.AST, names: set[str]) -> bool:
    """Whether *node* is a call of one of *names*, or of an attribute of one."""
    return isinstance(node, ast.Call) and dotted(node.func).partition(".")[0] in names


def _is_super(node: ast.AST) -> TypeGuard[ast.Call]:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "super"


def called_at(text: str, start: tuple[int, int], end: tuple[int, int] | None) -> str:
    """The last name of what is called from *start* to *end*, lines from 1 and columns from 0; the outermost call without an *end*; "" if none is."""
    begin = (start[0], _byte(text, *start))
    stop = end and (end[0], _byte(text, *end))
    for node in nodes(text):  # from the outermost to the innermost
        if not isinstance(node, ast.Call) or (node.lineno, node.col_offset) != begin:
            continue
        if stop is None or (node.end_lineno, node.end_col_offset) == stop:
            name = node.func
            return name.attr if isinstance(name, ast.Attribute) else name.id if isinstance(name, ast.Name) else ""
    return ""


def _byte(text: str, line: int, column: int) -> int:
    """The column in bytes, which the nodes of Python count in."""
    lines = text.split("\n")
    return len(lines[line - 1][:column].encode("utf-8", "replace")) if 0 < line <= len(lines) else column


def _blocks(node: ast.AST) -> Iterator[list[ast.stmt]]:
    for name in ("body", "orelse", "finalbody"):
        block = getattr(node, name, None)
        if isinstance(block, list) and block:
            yield block


def _is_string(statement: ast.stmt) -> bool:
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )
