# SPDX-License-Identifier: Apache-2.0
"""Operators: arithmetic on known data, text put together, streams, assignment, indexing, conversions."""

from __future__ import annotations

import ast
import operator
from collections.abc import Iterable
from typing import Any

from haros_ci.link import calls, construct, expressions
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import INTEGERS, MAPS, REALS, SEQUENCES, STRINGS, is_smart_pointer, pointee
from haros_ci.link.values import (
    FALSE,
    NONE,
    TRUE,
    Callable,
    Cell,
    Choice,
    Known,
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
from haros_ci.model.program import Expression, Type

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
#: Longer texts are not put together.
TEXT_LIMIT = 4_000


def operation(run: Run, frame: Frame, expression: Expression) -> Value:
    """A unary or binary operator, overloaded ones of the workspace included."""
    symbol, operands = expression[1], expression[2]
    if symbol in ("&&", "||"):
        return _logical(run, frame, symbol, operands)
    left = expressions.evaluate(run, frame, operands[0])
    if len(operands) == 1:
        return _unary(run, frame, symbol, left)
    if symbol in ("<<", ">>"):
        return _shift(run, frame, symbol, operands, left)
    right = expressions.evaluate(run, frame, operands[1])
    if isinstance(left, Object) and left.definition is not None:
        method = construct.method_of(run, left, f"operator{symbol}")
        if method is not None:
            return calls.invoke(run, frame, method, (calls.Argument(right),), None)
    return binary(run, frame, symbol, left, right)


def binary(run: Run, frame: Frame, symbol: str, left: Value, right: Value) -> Value:
    """*symbol* applied to two values; Opaque where it cannot be computed."""
    if isinstance(left, Choice) and not isinstance(right, Choice):
        return _over(left, lambda option: binary(run, frame, symbol, option, right))
    if isinstance(right, Choice):
        return _over(right, lambda option: binary(run, frame, symbol, left, option))
    if symbol == "+" and (_is_text(left) or _is_text(right)):
        joined = concatenate((left, right))
        return joined if _short(joined) else run.opaque("it is a long text", frame)
    if symbol == "%" and isinstance(left, Known) and isinstance(left.value, str):
        return _formatted(run, frame, left.value, right)
    if isinstance(left, Known) and isinstance(right, Known):
        return _computed(run, frame, symbol, left.value, right.value)
    if symbol == "+" and isinstance(left, Sequence) and isinstance(right, Sequence):
        one, other = left.content.value, right.content.value
        if isinstance(one, tuple) and isinstance(other, tuple):
            return Sequence(Cell((*one, *other)))  # type: ignore[arg-type]
    if symbol in ("==", "!="):
        if isinstance(left, Object) and isinstance(right, Object) and left is right:
            return TRUE if symbol == "==" else FALSE
        if (isinstance(left, Object) and right == NONE) or (isinstance(right, Object) and left == NONE):
            return FALSE if symbol == "==" else TRUE
        known, one_data = data_of(left)
        also, other_data = data_of(right)
        if known and also:
            return _computed(run, frame, symbol, one_data, other_data)
    if symbol in ("in", "not in"):
        known, item = data_of(left)
        also, items = data_of(right)
        if known and also and isinstance(items, (list, dict, str)):
            try:
                return Known((item in items) == (symbol == "in"))
            except TypeError:
                pass
    kind = value_type(left) or value_type(right)
    comparison = symbol in ("==", "!=", "<", ">", "<=", ">=", "in", "not in", "is", "is not")
    return run.opaque("it is computed from what is not known", frame, None, ("bool", (), "") if comparison else kind)


def _over(choice: Choice, function: Any) -> Value:
    result: Value | None = None
    for option in choice.options:
        found = function(option)
        result = found if result is None else join(result, found)
    return result if result is not None else NONE


def _computed(run: Run, frame: Frame, symbol: str, left: Any, right: Any) -> Value:
    try:
        if symbol == "+":
            return Known(left + right)
        if symbol in ("is", "is not"):
            return Known((left is right) == (symbol == "is"))
        if symbol == "/":
            both = isinstance(left, int) and isinstance(right, int) and frame.source.program.language != "python"
            return Known(int(left / right) if both else left / right)
        if symbol == "//":
            return Known(left // right)
        if symbol == "%":
            return Known(left % right)
        if symbol == "**" and abs(left) < 1e6 and abs(right) < 64:
            return Known(left**right)
        if symbol in ("in", "not in"):
            return Known((left in right) == (symbol == "in"))
        if symbol == "*" and (isinstance(left, (str, list)) or isinstance(right, (str, list))):
            return run.opaque("it is a repeated text", frame)
        if symbol in BINARY:
            result = BINARY[symbol](left, right)
            if not isinstance(result, int) or abs(result) < 2**256:
                return Known(result)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        pass
    return run.opaque("it cannot be computed", frame)


def _formatted(run: Run, frame: Frame, text: str, right: Value) -> Value:
    """Python's ``%`` with ``%s`` and ``%d`` only."""
    arguments = [right]
    if isinstance(right, Sequence):
        if not isinstance(right.content.value, tuple):
            return run.opaque("it is formatted from a list that is not known", frame)
        arguments = [cell.value for cell in right.content.value]
    pieces = text.replace("%%", "\0").replace("%d", "%s").replace("%i", "%s").split("%s")
    if len(pieces) != len(arguments) + 1 or any("%" in piece for piece in pieces):
        return run.opaque("its format is not understood", frame)
    values: list[Value] = [Known(pieces[0].replace("\0", "%"))]
    for argument, piece in zip(arguments, pieces[1:], strict=True):
        values += [argument, Known(piece.replace("\0", "%"))]
    return concatenate(tuple(values))


def _logical(run: Run, frame: Frame, symbol: str, operands: Any) -> Value:
    from haros_ci.link.statements import truth

    left = expressions.evaluate(run, frame, operands[0])
    right = expressions.evaluate(run, frame, operands[1])
    one, other = truth(left), truth(right)
    if frame.source.program.language == "python":
        if one is not None:
            return (right if one else left) if symbol == "&&" else (left if one else right)
        return run.opaque("it is one or the other", frame)
    if symbol == "&&" and (one is False or other is False):
        return FALSE
    if symbol == "||" and (one is True or other is True):
        return TRUE
    if one is not None and other is not None:
        return Known(one and other if symbol == "&&" else one or other)
    return run.opaque("it is computed from what is not known", frame, None, ("bool", (), ""))


def _unary(run: Run, frame: Frame, symbol: str, value: Value) -> Value:
    from haros_ci.link.statements import truth

    if symbol == "!":
        holds = truth(value)
        if holds is None:
            return run.opaque("it is computed from what is not known", frame, None, ("bool", (), ""))
        return FALSE if holds else TRUE
    if isinstance(value, Known) and isinstance(value.value, (int, float)):
        if symbol == "-":
            return Known(-value.value)
        if symbol == "~" and isinstance(value.value, int):
            return Known(~value.value)
        if symbol == "+":
            return value
    return run.opaque("it is computed from what is not known", frame, None, value_type(value))


def _shift(run: Run, frame: Frame, symbol: str, operands: Any, left: Value) -> Value:
    """``<<`` and ``>>``: overloads of the workspace, streams, YAML's extraction, integers."""
    cell = expressions.cell_of(run, frame, operands[1])
    right = cell.value if cell is not None else expressions.evaluate(run, frame, operands[1])
    if isinstance(left, Object):
        if left.definition is not None:
            method = construct.method_of(run, left, f"operator{symbol}")
            if method is not None:
                return calls.invoke(run, frame, method, (calls.Argument(right, cell),), None)
        text = left.fields.get("[text]")
        if text is not None and symbol == "<<":
            run.state.write(text, concatenate((text.value, right)))
            return left
        if text is not None and cell is not None:
            return _token(run, frame, left, text, cell)
    if symbol == ">>" and cell is not None:
        if isinstance(left, Known) and not isinstance(left.value, int):
            run.state.write(cell, converted(left, cell.type))
        else:
            run.state.write(cell, run.opaque("it is read from a stream", frame, None, cell.type))
        return left
    if isinstance(left, Known) and isinstance(right, Known) and type(left.value) is type(right.value) is int:
        if 0 <= right.value < 64:
            return Known(left.value << right.value if symbol == "<<" else left.value >> right.value)
    return left


def _token(run: Run, frame: Frame, stream: Value, text: Cell, cell: Cell) -> Value:
    """The next word of a string stream; false (as the stream then is) where there is none."""
    if isinstance(text.value, Known) and cell.type is not None and cell.type[0] in STRINGS:
        head, *rest = str(text.value.value).split(None, 1) or [""]
        run.state.write(text, Known(rest[0] if rest else ""))
        if not head:
            return FALSE
        run.state.write(cell, Known(head))
        return stream
    run.state.write(text, run.opaque("it is read bit by bit", frame))
    run.state.write(cell, run.opaque("it is read from a stream", frame, None, cell.type))
    return run.opaque("whether a stream has more", frame)


def assignment(run: Run, frame: Frame, expression: Expression) -> Value:
    """``=`` and its kin: the target holds the value from here on."""
    _, symbol, target, source = expression
    if target[0] in ("list",):
        return _unpack(run, frame, target, expressions.evaluate(run, frame, source))
    value = expressions.evaluate(run, frame, source)
    cell = _target(run, frame, target)
    if cell is None:
        return value
    if symbol != "=":
        value = binary(run, frame, symbol[:-1], cell.value, value)
    elif isinstance(value, Sequence) and frame.source.program.language != "python" and source[0] in ("name", "field"):
        value = Sequence(Cell(value.content.value), value.type)
    if cell.type is not None:
        value = converted(value, cell.type)
        if isinstance(cell.value, Sequence) and isinstance(value, Sequence) and value.type is None:
            value.type = cell.value.type
    run.state.write(cell, value)
    return value


def _unpack(run: Run, frame: Frame, target: Expression, value: Value) -> Value:
    items = value.content.value if isinstance(value, Sequence) else None
    known = isinstance(items, tuple) and len(items) == len(target[1])
    for index, item in enumerate(target[1]):
        if item[0] == "list":
            _unpack(run, frame, item, items[index].value if known else run.opaque("it is unpacked", frame))
            continue
        cell = _target(run, frame, item)
        if cell is not None:
            run.state.write(cell, items[index].value if known else run.opaque("it is unpacked from what is not known", frame))
    return value


def _target(run: Run, frame: Frame, target: Expression) -> Cell | None:
    """The cell to assign to; Python makes it where there is none."""
    python = frame.source.program.language == "python"
    if python and target[0] == "name":
        module = run.modules.get(frame.source.path)
        if module is frame:
            cell = frame.scopes[0].get(target[1])
        else:
            cell = frame.find(target[1])
        if cell is None:
            cell = Cell(NONE)
            frame.scopes[0][target[1]] = cell
        return cell
    cell = expressions.cell_of(run, frame, target)
    if cell is None and target[0] == "field":
        owner = expressions.evaluate(run, frame, target[1])
        if isinstance(owner, Pointer):
            owner = owner.cell.value
        if isinstance(owner, Object):
            cell = owner.fields[target[2]] = Cell(run.opaque("it is not set before", frame))
    return cell


def indexed(run: Run, frame: Frame, expression: Expression) -> Value:
    """``a[b]``."""
    container = expressions.evaluate(run, frame, expression[1])
    key = expressions.evaluate(run, frame, expression[2])
    if isinstance(container, Pointer):
        container = container.cell.value
    cell = element(run, frame, container, key)
    if cell is not None:
        return cell.value
    if isinstance(container, Known) and isinstance(key, Known):
        try:
            return Known(container.value[key.value])
        except (LookupError, TypeError):
            if isinstance(container.value, (dict, list)):
                return NONE  # yaml-cpp: an undefined node
    if isinstance(container, Object) and container.definition is not None:
        method = construct.method_of(run, container, "operator[]")
        if method is not None:
            return calls.invoke(run, frame, method, (calls.Argument(key),), None)
    if isinstance(container, Sequence) and isinstance(container.content.value, tuple) and container.content.value:
        return any_of(cell.value for cell in container.content.value)
    kind = None
    if isinstance(container, Sequence) and container.type is not None and container.type[1]:
        kind = container.type[1][0]
    elif isinstance(container, Opaque) and container.type is not None and container.type[0] in (SEQUENCES | MAPS):
        kind = container.type[1][-1] if container.type[1] else None
    return run.opaque("an element that is not known", frame, None, kind)


def any_of(values: Iterable[Value]) -> Value:
    """One of *values*, there is no telling which."""
    result: Value | None = None
    for value in values:
        result = value if result is None else join(result, value)
    return result if result is not None else NONE


def element(run: Run, frame: Frame, container: Value, key: Value) -> Cell | None:
    """The cell of one element of a sequence or map; a map of C++ makes what is not there."""
    if isinstance(container, Pointer):
        container = container.cell.value
    if isinstance(container, Sequence) and isinstance(container.content.value, tuple):
        cells = container.content.value
        if isinstance(key, Known) and isinstance(key.value, int) and -len(cells) <= key.value < len(cells):
            found: Cell = cells[key.value]
            return found
        return None
    if isinstance(container, Mapped) and isinstance(container.content.value, dict) and isinstance(key, Known):
        try:
            cell = container.content.value.get(key.value)
        except TypeError:
            return None
        if cell is None and isinstance(key.value, (str, int)):
            cell = Cell(run.opaque("an entry that is not there", frame))
            run.state.write(container.content, {**container.content.value, key.value: cell})
        return cell
    return None


def converted(value: Value, kind: Type | None) -> Value:
    """*value* as a variable of type *kind* holds it: an Opaque learns its type, numbers follow C++'s conversions."""
    if kind is None or kind[0] in ("", "auto"):
        return value
    if kind[0] == "XmlRpc::XmlRpcValue" and not isinstance(value, Opaque):
        known, data = data_of(value)
        return Known(data) if known else value
    if isinstance(value, Opaque):
        return value if value.type is not None and _is_class(value.type) else Opaque(value.reason, value.location, kind)
    if isinstance(value, Known):
        data, name = value.value, kind[0]
        if name in REALS and isinstance(data, (int, bool)):
            return Known(float(data))
        if name in INTEGERS and isinstance(data, float) and abs(data) < 2**63:
            return Known(int(data))
        if name in INTEGERS and isinstance(data, bool) and "*" not in kind[2]:
            return Known(int(data))
        if name == "bool" and isinstance(data, (int, float)):
            return Known(bool(data))
    return value


def _is_class(kind: Type) -> bool:
    return kind[0] not in STRINGS and kind[0] not in INTEGERS and kind[0] not in REALS and kind[0] not in ("bool", "auto", "")


def value_type(value: Value) -> Type | None:
    """The static type that a value shows by itself."""
    if isinstance(value, Known):
        for python, name in ((bool, "bool"), (int, "int"), (float, "double"), (str, "std::string"), (list, "list"), (dict, "dict")):
            if isinstance(value.value, python):
                return (name, (), "")
        return None
    if isinstance(value, Text):
        return ("std::string", (), "")
    if isinstance(value, Object):
        return (value.name, value.arguments, "")
    if isinstance(value, Opaque):
        return value.type
    if isinstance(value, Sequence):
        return value.type or ("list", (), "")
    if isinstance(value, Mapped):
        return ("dict", (), "")
    if isinstance(value, Choice):
        return value_type(value.options[0])
    if isinstance(value, Pointer):
        return value.cell.type or value_type(value.cell.value)
    if isinstance(value, Callable):
        return ("function", (), "")
    return None


def macro(body: str) -> Value:
    """An object-like macro's value, where it is a literal."""
    text = body.strip().strip("()").strip()
    try:
        found = ast.literal_eval(text.rstrip("fFlLuU") if not text.startswith(('"', "'")) else text)
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        return Opaque(f"a macro: {text[:80]}")
    return Known(found) if isinstance(found, (str, int, float)) else Opaque(f"a macro: {text[:80]}")


def _is_text(value: Value) -> bool:
    if isinstance(value, Opaque):
        return value.type is not None and value.type[0] in STRINGS
    return isinstance(value, Text) or (isinstance(value, Known) and isinstance(value.value, str))


def _short(value: Value) -> bool:
    return not isinstance(value, Known) or len(value.value) <= TEXT_LIMIT


def smart(kind: Type | None) -> Type | None:
    """What a smart pointer's type points to; None for other types."""
    return pointee(kind) if kind is not None and is_smart_pointer(kind) else None
