# SPDX-License-Identifier: Apache-2.0
"""Values that Python code gives to fields of messages, and which no object of the field's type is (rosidl_generator_py, genpy).

A value is known where it is a literal, a text that is put together, a call of ``int`` and the like, or a local variable that is
only ever given such. What stands in a ``try`` is left out, for the code may be ready for it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.checking.message_fields import Typed, expressions, typed_routines
from haros_ci.checking.project import Project
from haros_ci.code.body import names_in, nodes
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.kinds import dotted
from haros_ci.interfaces.definitions import FieldType, field_type
from haros_ci.interfaces.structs import Struct
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Expression

#: What calls return, by dotted names.
_RETURNED = {
    **dict.fromkeys(("int", "len", "ord", "time.time_ns"), "int"),
    **dict.fromkeys(("float", "time.time", "math.sin", "math.cos", "math.atan2", "math.sqrt", "math.radians"), "float"),
    **dict.fromkeys(("str", "repr", "json.dumps"), "str"),
    "bool": "bool",
}
#: What literals are.
_LITERALS: dict[type[syntax.Node], str] = {
    syntax.Boolean: "bool",
    syntax.String: "str",
    syntax.Format: "str",
    syntax.Null: "none",
    syntax.ListLiteral: "list",
}
_INTEGERS = {f"{sign}int{bits}": bits for sign in ("", "u") for bits in (8, 16, 32, 64)}
_FLOATS = frozenset(("float32", "float64"))
_TEXTS = frozenset(("string", "wstring"))
_TIMES = frozenset(("time", "duration", "builtin_interfaces/Time", "builtin_interfaces/Duration"))
#: What sets names besides assignments.
_SHARED = regex(r"\b(?:global|nonlocal|as|for)\s([^\n:]{1,200})")
#: Functions with more assignments are tables.
_MANY_SETS = 2_000
#: Lists with more items are tables.
_MANY = 200


@dataclass(frozen=True, slots=True)
class WrongValue:
    """*written* (``msg.data``), a field of *type*, is given *value* of *kind* in *routine*."""

    written: str
    type: str
    kind: str
    value: str
    ros: int
    routine: Routine
    location: Location


def wrong_values(project: Project) -> Iterator[WrongValue]:
    """Every value that the field which it is given to cannot have."""
    code = project.code
    for typed in typed_routines(project):
        for target, kind, value, written in _assigned(code, typed):
            if not _fits(kind, value, target, typed.structs.known.ros):
                shown = _shown(value)
                at = _location(code, typed.routine, written, shown)
                yield WrongValue(written, target, kind, shown, typed.structs.known.ros, typed.routine, at)


def _assigned(code: Codebase, typed: Typed) -> Iterator[tuple[str, str, Expression, str]]:
    """The types of fields that are given values, with the kind of the value, the value, and how the field is written."""
    for expression in expressions(typed.routine.function.body or ()):
        for node in nodes(expression):
            if isinstance(node, syntax.Assignment) and node.operator == "=":
                field = _field(node.target, typed)
                kind = kind_of(code, typed.routine, node.value) if field is not None else ""
                if field is not None and kind:
                    yield field[0], kind, node.value, field[1]
            elif isinstance(node, syntax.Call) and (struct := typed.struct_of(code, node)) is not None:
                maker = struct.name.rpartition(".")[2]
                for argument in node.arguments:
                    if isinstance(argument, syntax.Keyword) and argument.name in struct.fields:
                        kind = kind_of(code, typed.routine, argument.value)
                        if kind:
                            yield struct.fields[argument.name], kind, argument.value, f"{maker}({argument.name}="


def _field(target: Expression, typed: Typed) -> tuple[str, str] | None:
    """The type of the field that *target* is, and how it is written; None if that is not known."""
    chain: list[str] = []
    while isinstance(target, syntax.Member):
        chain.append(target.name)
        target = target.object
    if not chain or not isinstance(target, (syntax.Name, syntax.This)):
        return None
    written = target.name if isinstance(target, syntax.Name) else f"self.{chain.pop()}"
    struct: Struct | None = typed.variables.get(written)
    while struct is not None and chain:
        name = chain.pop()
        written += f".{name}"
        if not chain:
            return (struct.fields[name], written) if name in struct.fields else None
        struct = typed.structs.of_field(struct, name)
    return None


def kind_of(code: Codebase, routine: Routine, value: Expression, steps: int = 3) -> str:
    """``int``, ``float``, ``bool``, ``str``, ``none``, ``list`` or ``Time`` (an object of the client library); "" if it is not known."""
    if isinstance(value, syntax.Number):
        return "int" if isinstance(value.value, int) else "float"
    if isinstance(value, syntax.Operation):
        return _computed(code, routine, value, steps)
    if isinstance(value, syntax.Call):
        return _called(code, routine, value)
    if isinstance(value, syntax.Name):
        return _variable(code, routine, value.name, steps - 1) if steps > 0 else ""
    return _LITERALS.get(type(value), "")


def _computed(code: Codebase, routine: Routine, value: syntax.Operation, steps: int) -> str:
    """Of numbers: a sign, a product, a quotient."""
    kinds = {kind_of(code, routine, operand, steps - 1) for operand in value.operands} if steps > 0 else {""}
    if not kinds <= {"int", "float"} or value.operator not in ("+", "-", "*", "/"):
        return ""
    return "float" if "float" in kinds or value.operator == "/" else "int"


def _called(code: Codebase, routine: Routine, call: syntax.Call) -> str:
    callee = call.callee
    is_now = isinstance(callee, syntax.Member) and callee.name == "now" and not call.arguments
    if is_now and code.ros_of(routine.source) == 2:
        return "Time" if _is_clock(callee) else ""
    name = dotted(code, routine, callee)
    if not name and isinstance(callee, syntax.Name):
        name = callee.name
    is_own = any(function.name == name for function in routine.source.program.functions)
    return "" if is_own else _RETURNED.get(name, "")


def _is_clock(callee: Expression) -> bool:
    """Whether *callee* is a method of what ``get_clock()`` returns."""
    value = callee.object if isinstance(callee, syntax.Member) else None
    made = value.callee if isinstance(value, syntax.Call) else None
    return isinstance(made, syntax.Member) and made.name == "get_clock"


def _variable(code: Codebase, routine: Routine, name: str, steps: int) -> str:
    """The kind of all that a local variable is given, if it is the same each time."""
    body = code.body(routine)
    if routine.function.kind == "module" or name in body.variables or name in body.nested or name in body.imports:
        return ""
    if any(parameter.name.lstrip("*") == name for parameter in routine.function.parameters):
        return ""
    if len(body.sets) > _MANY_SETS:
        return ""
    kinds: set[str] = set()
    for target, operator, value, _ in body.sets:
        if isinstance(target, syntax.Name) and target.name == name:
            kinds.add(kind_of(code, routine, value, steps) if operator == "=" else "")
        elif not isinstance(target, (syntax.Member, syntax.Subscript)) and name in names_in(target):
            return ""
    return kinds.pop() if len(kinds) == 1 and name not in _shared(code, routine) else ""


def _shared(code: Codebase, routine: Routine) -> frozenset[str]:
    """Names in the lines of a routine that loops, ``with`` and handlers set, and those of other functions."""
    key = ("shared names", id(routine.function))
    if key not in code.kept:
        found = _SHARED.findall(code.lines(routine, routine.function.line))
        code.kept[key] = frozenset(word for part in found for word in re.findall(r"\w+", part))
        code.kept["keep", id(routine.function)] = routine.function  # so that its identity stays its own
    names: frozenset[str] = code.kept[key]
    return names


def _fits(kind: str, value: Expression, written: str, ros: int) -> bool:
    """Whether an object of *kind* can stand in a field of the type *written*, or that is not known."""
    expected = field_type(written)
    if kind == "none" and ros == 1:
        return True  # it is looked at when the message is sent, and may be set before
    if expected is None or expected.base in ("byte", "char", "octet"):
        return True
    if kind == "Time":
        return expected.base not in _TIMES or bool(expected.form)
    if expected.form:
        return _fits_list(kind, value, expected, ros)
    return _fits_one(kind, expected, ros)


def _fits_list(kind: str, value: Expression, expected: FieldType, ros: int) -> bool:
    if kind == "list" and isinstance(value, syntax.ListLiteral):
        items = value.items
        if len(items) > _MANY or expected.base not in _FLOATS or ros == 1:
            return True
        return not any(isinstance(item, syntax.Number) and isinstance(item.value, int) for item in items)
    return kind in ("list", "str") if ros == 1 else kind == "list"


def _fits_one(kind: str, expected: FieldType, ros: int) -> bool:
    base = expected.base
    if base in _FLOATS:
        return kind == "float" or (ros == 1 and kind in ("int", "bool"))
    if base in _INTEGERS:
        return kind in ("int", "bool")
    if base in ("bool", "boolean"):
        return kind == "bool" or (ros == 1 and kind == "int")
    if base in _TEXTS:
        return kind == "str" or (ros == 1 and kind == "list")
    return not (expected.is_nested or base in _TIMES)


def _shown(value: Expression) -> str:
    """The value as text, where it is short."""
    if isinstance(value, (syntax.Number, syntax.Boolean, syntax.String)):
        text = repr(value.value)
    elif isinstance(value, syntax.Null):
        text = "None"
    else:
        return ""
    return text if len(text) <= 40 else ""


def _location(code: Codebase, routine: Routine, written: str, value: str) -> Location:
    """Where the field is given the value, if that is written out; else where it is first set, or the routine's head."""
    start = routine.function.line
    parts = re.split(r"[.(]", written.rstrip("="))
    head = (
        "" if written.endswith("=") else r"(?<![\w.])" + "".join(rf"{re.escape(part)}\s*\.\s*" for part in parts[:-1])
    )
    pattern = re.compile(rf"{head}\b{re.escape(parts[-1])}\s*=(?!=)\s*")
    text = code.text(routine.path) if routine.function.kind == "module" else code.lines(routine, start)
    found: list[tuple[bool, int, int, int]] = []
    for number, line in enumerate(text.split("\n"), start or 1):
        match = pattern.search(line.partition("#")[0])
        if match is not None:
            same = re.match(rf"[+-]?\s*{re.escape(value)}(?![\w.])", line[match.end() :]) if value else None
            found.append(
                (same is None, number, match.start() + 1, len(line[: match.end()].rstrip().rstrip("=").rstrip()) + 1)
            )
    if not found:
        return Location(routine.path, start or 1)
    _, number, begin, end = min(found)
    return Location(routine.path, number, begin, number, end)
