# SPDX-License-Identifier: Apache-2.0
"""Values as variables of a type hold them, the types that they show by themselves, and whether they are true."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.index.types import INTEGERS, REALS, STRINGS, is_smart_pointer, pointee
from haros_ci.syntax import Type
from haros_ci.values.abstract import (
    Callable,
    Character,
    Choice,
    Known,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
    data_of,
)

#: Types of one byte, which streams write as characters.
CHARACTERS = frozenset(("char", "int8_t", "uint8_t", "byte"))
#: The bits of integer types by a word of their names, as on 64-bit systems; 32 for all others.
WIDTHS = (
    ("long", 64),
    ("size_t", 64),
    ("ssize_t", 64),
    ("short", 16),
    ("int16_t", 16),
    ("uint16_t", 16),
    ("int64_t", 64),
    ("uint64_t", 64),
)
#: What ``std::string::find`` returns where there is nothing.
NPOS = 2**64 - 1


def converted(value: Value, kind: Type | None) -> Value:
    """*value* as a variable of type *kind* holds it: an Opaque learns its type, numbers follow C++'s conversions."""
    if kind is None or kind.name in ("", "auto"):
        return value
    if kind.name == "XmlRpc::XmlRpcValue" and not isinstance(value, Opaque):
        known, data = data_of(value)
        return Known(data) if known else value
    if isinstance(value, Opaque):
        return value if value.type is not None and _is_class(value.type) else Opaque(value.reason, value.location, kind)
    if isinstance(value, Known):
        if value.__class__ is not Known and _is_as_declared(value.kind, kind):
            return value
        return _data_as(value, kind)
    return value


def _data_as(value: Known, kind: Type) -> Value:
    """*value* as a variable of type *kind* holds it; what is given from outside is looked at only where it becomes something else."""
    name, held = kind.name, value.kind
    is_number = issubclass(held, (int, float))
    if name in REALS and issubclass(held, int):
        return Known(float(value.of(int)))
    if is_number and "*" not in kind.marks and (name in INTEGERS or set(name.split()) <= INTEGERS):
        data = value.value
        assert isinstance(data, (int, float))
        return _integer(value, data, name)
    if name in STRINGS and name != "str" and issubclass(held, Character):
        return Known(chr(value.of(Character)))
    if name in STRINGS and name != "str" and "*" not in kind.marks and is_number:
        return Opaque("a number in a text", None, kind)
    if name == "bool" and is_number:
        return Known(bool(value.value))
    return value


def in_braces(value: Value, kind: Type | None) -> Value:
    """What C++'s braces with one element or none make of a number, truth value or text; any other *value* or *kind* leaves the value as it is.

    Without an element it begins with nothing: 0, false, "" (en.cppreference.com/w/cpp/language/value_initialization).
    """
    if kind is None or not isinstance(value, Sequence) or value.type is not None:
        return value
    cells, zero = value.content.value, zero_of(kind)
    if zero is None or not isinstance(cells, tuple) or len(cells) > 1:
        return value
    return converted(cells[0].value if cells else zero, kind)


def zero_of(kind: Type) -> Known | None:
    """What a variable of a C++ type holds that begins with nothing; None for what is no number, truth value or text."""
    name = kind.name
    if "*" in kind.marks or not name:
        return None
    if name in STRINGS:
        return Known("")
    if name in REALS:
        return Known(0.0)
    if name == "bool":
        return Known(False)
    return Known(0) if name in INTEGERS or set(name.split()) <= INTEGERS else None


def _is_as_declared(held: type, kind: Type) -> bool:
    """Whether data of the type *held* that is given from outside is the same in a variable of type *kind*."""
    name = kind.name
    if held is str:
        return name in STRINGS
    if held is int:
        words = name.rpartition("::")[2].split()
        is_small = any(word in CHARACTERS or word.startswith(("short", "int16", "uint16")) for word in words)
        return "*" not in kind.marks and not is_small and (name in INTEGERS or set(words) <= INTEGERS)
    return (held is float and name in REALS) or (held is bool and name == "bool")


def _integer(value: Known, data: float, name: str) -> Value:
    """A number in an integer variable: the fraction is dropped, what is too large is known where C++ says so."""
    if isinstance(data, float) and not abs(data) < 2**63:
        return Opaque("the number is too large", None, syntax.Type(name))
    number = int(data)
    words = name.rpartition("::")[2].split()
    is_signed = not any(word.startswith(("u", "size_t", "byte")) for word in words)
    if any(word in CHARACTERS for word in words):
        if is_signed and number not in range(-128 if words != ["char"] else 0, 128):
            return Opaque("the number is too large for a character", None, syntax.Type(name))
        return Known(Character(number % 256 if not is_signed else number))
    bits = next((size for end, size in WIDTHS if words[-1].startswith(end) or end in words), 32)
    if is_signed:
        if not -(1 << bits - 1) <= number < 1 << bits - 1:
            if number == NPOS:
                return Known(-1)
            return Opaque("the number is too large", None, syntax.Type(name))
    elif not 0 <= number < 1 << bits:
        if isinstance(data, float):
            return Opaque("the number is too large", None, syntax.Type(name))
        number %= 1 << bits
    return value if type(value.value) is int and value.value == number else Known(number)


def _is_class(kind: Type) -> bool:
    return (
        kind.name not in STRINGS
        and kind.name not in INTEGERS
        and kind.name not in REALS
        and kind.name not in ("bool", "auto", "")
    )


#: The types that data shows by itself.
SHOWN: dict[type, Type] = {
    bool: syntax.Type("bool"),
    int: syntax.Type("int"),
    float: syntax.Type("double"),
    str: syntax.Type("std::string"),
    list: syntax.Type("list"),
    dict: syntax.Type("dict"),
}


def value_type(value: object) -> Type | None:
    """The static type that a value shows by itself."""
    if isinstance(value, Known):
        return SHOWN.get(int if value.kind is Character else value.kind)
    if isinstance(value, Text):
        return syntax.Type("std::string")
    if isinstance(value, Object):
        return syntax.Type(value.name, value.arguments, "")
    if isinstance(value, Opaque):
        return value.type
    if isinstance(value, Sequence):
        return value.type or syntax.Type("list")
    if isinstance(value, Mapped):
        return syntax.Type("dict")
    if isinstance(value, Choice):
        first, *others = [value_type(option) for option in value.options]
        return first if all(kind == first for kind in others) else None
    if isinstance(value, Pointer):
        return value.cell.type or value_type(value.cell.value)
    if isinstance(value, Callable):
        return syntax.Type("function")
    return None


def smart(kind: Type | None) -> Type | None:
    """What a smart pointer's type points to; None for other types."""
    return pointee(kind) if kind is not None and is_smart_pointer(kind) else None


def truth(value: Value) -> bool | None:
    """Whether a condition holds, None if that is not known."""
    if isinstance(value, Known):
        return bool(value.value) if value.__class__ is Known else bool(value.ask("truth"))
    if isinstance(value, Object):
        return None if _decides(value) else True
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        return bool(value.content.value)
    return None


def flag(value: object) -> bool | None:
    """What a value is for a flag; a pointer to an object of the workspace, as ``this``, is true."""
    is_known = isinstance(value, Known) or (isinstance(value, Object) and value.definition is not None)
    return truth(value) if is_known and isinstance(value, (Known, Object)) else None


def _decides(value: Object) -> bool:
    """Whether an object has a say in whether it is true."""
    if value.definition is None:
        return value.name.rpartition("::")[2] == "optional"
    source, definition = value.definition
    words = {f"{definition.name}{source.separator}{word}" for word in ("operator bool", "__bool__", "__len__")}
    return any(function.name in words for function in source.program.functions)
