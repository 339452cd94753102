# SPDX-License-Identifier: Apache-2.0
"""Operators: arithmetic on known data, text put together, streams, assignment, indexing, conversions."""

from __future__ import annotations

import operator
from collections.abc import Callable as Function_
from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow import activation, call_arguments, conversions, expressions, methods, overriding
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import formats, python_kinds, python_lists, python_numbers, python_paths, texts
from haros_ci.follow.walk import Walk
from haros_ci.index.types import STRINGS
from haros_ci.syntax import Expression
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    FALSE,
    LIST_LIMIT,
    NONE,
    TRUE,
    Callable,
    Cell,
    Character,
    Choice,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
    concatenate,
    data_of,
    join,
)
from haros_ci.values.given import plain
from haros_ci.values.questions import PLAIN

BINARY = {
    "-": operator.sub,
    "*": operator.mul,
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
    "&": operator.and_,
    "|": operator.or_,
    "^": operator.xor,
}
#: Comparisons, and what they are with their operands the other way round.
MIRRORED = {"==": "==", "!=": "!=", "<": ">", ">": "<", "<=": ">=", ">=": "<="}


def operation(walk: Walk, frame: Frame, expression: syntax.Operation) -> Value:
    """A unary or binary operator, overloaded ones of the workspace included."""
    symbol, operands = expression.operator, expression.operands
    if symbol in ("&&", "||"):
        return _logical(walk, frame, symbol, operands)
    left = expressions.evaluate(walk, frame, operands[0])
    if len(operands) == 1:
        if symbol == "!":
            return _negated(walk, frame, expressions.holds(walk, frame, operands[0], left))
        return _unary(walk, frame, symbol, left)
    if symbol in ("<<", ">>"):
        return _shift(walk, frame, symbol, operands, left)
    right = expressions.evaluate(walk, frame, operands[1])
    if symbol == ".*":
        return _bound(walk, frame, left, right)
    if isinstance(left, Object) and left.definition is not None:
        arguments = (call_arguments.PassedArgument(right, None, conversions.value_type(right)),)
        method = methods.method_of(walk, left, f"operator{symbol}", arguments)
        if method is not None:
            return activation.invoke(walk, frame, method, arguments)
    return binary(walk, frame, symbol, left, right)


def _bound(walk: Walk, frame: Frame, left: Value, right: Value) -> Value:
    """``a.*m``, ``a->*m``: the method that *m* points to, of the object *a*."""
    this = left.cell.value if isinstance(left, Pointer) else left
    if isinstance(right, Callable) and isinstance(this, Object) and right.function.owner:
        return overriding.final(walk, replace(right, this=this, templates=this.templates))
    return walk.opaque("it is a member that a pointer tells", frame)


def binary(walk: Walk, frame: Frame, symbol: str, left: Value, right: Value) -> Value:  # noqa: C901 - one branch for each pair of kinds of operands
    """*symbol* applied to two values; Opaque where it cannot be computed."""
    if isinstance(left, Choice) and not isinstance(right, Choice):
        return _over(left, lambda option: binary(walk, frame, symbol, option, right))
    if isinstance(right, Choice):
        return _over(right, lambda option: binary(walk, frame, symbol, left, option))
    if symbol == "+" and (_is_text(left) or _is_text(right)):
        for value in (left, right):
            if isinstance(value, Known) and not issubclass(value.kind, (str, Character)):
                return walk.opaque("a number is added to a text", frame)
        return concatenate((left, right))
    if symbol == "/" and frame.source.separator == ".":
        if python_paths.is_path(left) and (_is_text(right) or isinstance(right, Opaque)):
            return python_paths.divided(walk, frame, left, right)
    elif symbol == "/" and _is_text(left) and _is_text(right):  # std::filesystem::path
        return concatenate((left, Known("/"), right))
    if symbol == "%" and isinstance(left, Known) and issubclass(left.kind, str):
        return formats.percent(walk, frame, left.of(str), right)
    if isinstance(left, Sequence) or isinstance(right, Sequence):
        whole = _of_lists(walk, frame, symbol, left, right)
        if whole is not None:
            return whole
    if isinstance(left, Known) and isinstance(right, Known):
        if (left.__class__ is not Known or right.__class__ is not Known) and symbol in MIRRORED:
            answer = _compared(symbol, left, right)
            if answer is not None:
                return answer
        return _computed(walk, frame, symbol, left.value, right.value)
    if isinstance(left, Object) and symbol in ("+", "-") and isinstance(right, Known) and type(right.value) is int:
        further = iterators.moved(left, right.value if symbol == "+" else -right.value)
        if further is not None:
            return further
    if symbol in ("==", "!=", "is", "is not") and (is_same := python_kinds.same(left, right)) is not None:
        return TRUE if is_same is (symbol in ("==", "is")) else FALSE
    if symbol in ("==", "!="):
        if (result := iterators.compared(symbol, left, right)) is not None:
            return result
        if isinstance(left, Object) and isinstance(right, Object) and left is right:
            return TRUE if symbol == "==" else FALSE
        if isinstance(left, Library) and left == right and left.this is None:  # a library's constant
            return TRUE if symbol == "==" else FALSE
        if (isinstance(left, Object) and right == NONE) or (isinstance(right, Object) and left == NONE):
            return FALSE if symbol == "==" else TRUE
        if any(
            isinstance(a, Pointer) and isinstance(b, Object) and b.name == "[end]"
            for a, b in ((left, right), (right, left))
        ):
            return FALSE if symbol == "==" else TRUE  # an element, and what is behind the last one
        if isinstance(left, Library) and isinstance(right, Library):
            words = [library.name.rpartition("::")[2] for library in (left, right)]
            if all(word.startswith("PARAMETER_") for word in words):  # constants of rclcpp::ParameterType
                return TRUE if (words[0] == words[1]) is (symbol == "==") else FALSE
        if not isinstance(left, (Opaque, Text)) and not isinstance(right, (Opaque, Text)):
            known, one_data = data_of(left)
            also, other_data = data_of(right)
            if known and also:
                return _computed(walk, frame, symbol, one_data, other_data)
    if symbol in ("in", "not in") and (is_in := _is_in(left, right)) is not None:
        return Known(is_in == (symbol == "in"))
    return walk.opaque("it is computed from what is not known", frame, None, _computed_type(frame, symbol, left, right))


def _is_in(left: Value, right: Value) -> bool | None:
    """Whether Python's ``left in right`` holds; None if that is not known. Of a dict the keys have to be known, and no value."""
    known, item = data_of(left)
    content = right.content.value if isinstance(right, Mapped) else None
    also, items = (True, content) if isinstance(content, dict) else data_of(right)
    if not known or not also or not isinstance(items, (list, dict, str)):
        return None
    try:
        return item in items
    except TypeError:
        return None


def _computed_type(frame: Frame, symbol: str, left: Value, right: Value) -> syntax.Type | None:
    """The type that an operator gives for two values; None where what is not known decides it (for C++: [expr.arith.conv])."""
    if symbol in ("==", "!=", "<", ">", "<=", ">=", "in", "not in", "is", "is not"):
        return syntax.Type("bool")
    kinds = [conversions.value_type(left), conversions.value_type(right)]
    if frame.source.separator == ".":
        return python_numbers.operation(
            symbol, kinds, right.value if isinstance(right, Known) and right.__class__ is Known else None
        )
    names = [kind.name if kind is not None else "" for kind in kinds]
    for name in ("std::string", "double", "float"):
        if name in names:
            return syntax.Type(name)
    return kinds[0] if all(names) else None


def _of_lists(walk: Walk, frame: Frame, symbol: str, left: Value, right: Value) -> Value | None:
    """``+``, and Python's ``*`` and operators of sets; None if that is not known."""
    if symbol == "+" and isinstance(left, Sequence) and isinstance(right, Sequence):
        one, other = left.content.value, right.content.value
        if not isinstance(one, tuple) or not isinstance(other, tuple):
            return None
        if len(one) + len(other) > LIST_LIMIT:
            return Sequence(Cell(walk.opaque("it is a long list", frame)))
        return Sequence(Cell((*one, *other)))
    if frame.source.separator != ".":
        return None
    return python_lists.repeated(left, right) if symbol == "*" else python_lists.combined(symbol, left, right)


def _compared(symbol: str, left: Known, right: Known) -> Value | None:
    """What a comparison with a value that is given from outside gives, which is looked at no further; None where it must be."""
    if symbol in ("==", "!="):
        return Known((left == right) is (symbol == "=="))
    if left.__class__ is Known:
        symbol, left, right = MIRRORED[symbol], right, left
    operand = plain(right.value) if right.__class__ is Known else None
    if operand.__class__ not in PLAIN:
        return None
    try:
        return Known(left.ask(symbol, operand))
    except TypeError:
        return None


def _over(choice: Choice, function: Function_[[Value], Value]) -> Value:
    result: Value | None = None
    for option in choice.options:
        found = function(option)
        result = found if result is None else join(result, found)
    return result if result is not None else NONE


def _computed(walk: Walk, frame: Frame, symbol: str, left: object, right: object) -> Value:  # noqa: C901 - one branch for each operator
    is_python = frame.source.program.language == "python"
    if not is_python and isinstance(left, int) and isinstance(right, int) and conversions.NPOS in (left, right):
        left, right = left % (conversions.NPOS + 1), right % (conversions.NPOS + 1)
    try:
        if symbol == "+":
            if isinstance(left, list) and isinstance(right, list) and len(left) + len(right) > LIST_LIMIT:
                return walk.opaque("it is a long list", frame)
            return Known(operator.add(left, right))
        if symbol in ("is", "is not"):
            return Known((left is right) == (symbol == "is"))
        if symbol == "/":
            if not is_python and isinstance(left, int) and isinstance(right, int):
                quotient = abs(left) // abs(right)
                return Known(quotient if (left < 0) == (right < 0) else -quotient)
            return Known(operator.truediv(left, right))
        if symbol == "//":
            return Known(operator.floordiv(left, right))
        if symbol == "%" and not is_python and isinstance(left, int) and isinstance(right, int):
            return Known(abs(left) % abs(right) * (-1 if left < 0 else 1))
        if symbol == "%":
            return Known(operator.mod(left, right))
        if symbol == "**" and isinstance(left, (int, float)) and isinstance(right, (int, float)):
            return (
                Known(left**right)
                if abs(left) < 1e6 and abs(right) < 64
                else walk.opaque("it cannot be computed", frame)
            )
        if symbol in ("in", "not in") and isinstance(right, (str, list, dict)):
            return Known((left in right) == (symbol == "in"))
        if symbol == "*" and (isinstance(left, (str, list)) or isinstance(right, (str, list))):
            return walk.opaque("it is a repeated text", frame)
        if symbol in BINARY:
            result = BINARY[symbol](left, right)
            if not isinstance(result, int) or abs(result) < 2**256:
                return Known(result)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        pass
    return walk.opaque("it cannot be computed", frame)


def _logical(walk: Walk, frame: Frame, symbol: str, operands: tuple[Expression, ...]) -> Value:
    left = expressions.evaluate(walk, frame, operands[0])
    first = expressions.holds(walk, frame, operands[0], left)
    reason = f"it stands behind {symbol}"
    mark = walk.state.mark()
    with walk.doubted(reason if first is None or first is not (symbol == "&&") else None):
        right = expressions.evaluate(walk, frame, operands[1])
    if first is None:
        walk.state.merge([{}, walk.state.undo(mark)])
    elif first is not (symbol == "&&"):  # not evaluated at all
        walk.state.undo(mark)
    one, other = first, expressions.holds(walk, frame, operands[1], right)
    if frame.source.program.language == "python":
        if one is not None:
            return (right if one else left) if symbol == "&&" else (left if one else right)
        return walk.opaque("it is one or the other", frame)
    if symbol == "&&" and (one is False or other is False):
        return FALSE
    if symbol == "||" and (one is True or other is True):
        return TRUE
    if one is not None and other is not None:
        return Known(one and other if symbol == "&&" else one or other)
    return walk.opaque("it is computed from what is not known", frame, None, syntax.Type("bool"))


def _negated(walk: Walk, frame: Frame, holds: bool | None) -> Value:
    if holds is None:
        return walk.opaque("it is computed from what is not known", frame, None, syntax.Type("bool"))
    return FALSE if holds else TRUE


def _unary(walk: Walk, frame: Frame, symbol: str, value: Value) -> Value:
    if isinstance(value, Known) and issubclass(value.kind, (int, float)):
        if symbol == "-" and isinstance(value.value, (int, float)):
            return Known(-value.value)
        if symbol == "~" and isinstance(value.value, int):
            return Known(~value.value)
        if symbol == "+":
            return value
    return walk.opaque("it is computed from what is not known", frame, None, conversions.value_type(value))


def _shift(walk: Walk, frame: Frame, symbol: str, operands: tuple[Expression, ...], left: Value) -> Value:
    """``<<`` and ``>>``: overloads of the workspace, streams, YAML's extraction, integers."""
    cell = expressions.cell_of(walk, frame, operands[1])
    right = cell.value if cell is not None else expressions.evaluate(walk, frame, operands[1])
    if isinstance(left, Object):
        if left.definition is not None:
            kind = cell.type if cell is not None else conversions.value_type(right)
            arguments = (call_arguments.PassedArgument(right, cell, kind),)
            method = methods.method_of(walk, left, f"operator{symbol}", arguments)
            if method is not None:
                return activation.invoke(walk, frame, method, arguments)
        text = left.fields.get("[text]")
        if text is not None and symbol == "<<":
            texts.insert(walk, frame, left, right)
            return left
        if text is not None and cell is not None:
            return _token(walk, frame, left, text, cell)
    if symbol == ">>" and cell is not None:
        if isinstance(left, Known) and not issubclass(left.kind, int):
            walk.state.write(cell, conversions.converted(left, cell.type))
        else:
            walk.state.write(cell, walk.opaque("it is read from a stream", frame, None, cell.type))
        return left
    if isinstance(left, Known) and isinstance(right, Known) and type(left.value) is type(right.value) is int:
        if 0 <= right.value < 64 and abs(left.value) < 2**192:
            return Known(left.value << right.value if symbol == "<<" else left.value >> right.value)
    return left


def _token(walk: Walk, frame: Frame, stream: Value, text: Cell, cell: Cell) -> Value:
    """The next word of a string stream; false (as the stream then is) where there is none."""
    if isinstance(text.value, Known) and cell.type is not None and cell.type.name in STRINGS:
        head, *rest = str(text.value.value).split(None, 1) or [""]
        walk.state.write(text, Known(rest[0] if rest else ""))
        if not head:
            return FALSE
        walk.state.write(cell, Known(head))
        return stream
    walk.state.write(text, walk.opaque("it is read bit by bit", frame))
    walk.state.write(cell, walk.opaque("it is read from a stream", frame, None, cell.type))
    return walk.opaque("whether a stream has more", frame)


def _is_text(value: Value) -> bool:
    if isinstance(value, Opaque):
        return value.type is not None and value.type.name in STRINGS
    return isinstance(value, Text) or (isinstance(value, Known) and issubclass(value.kind, str))
