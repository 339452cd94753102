# SPDX-License-Identifier: Apache-2.0
"""Expressions: the value of each, the cell of those that have one, and their static types."""

from __future__ import annotations

import builtins
from typing import Any

from haros_ci.link import calls, construct, library_cpp, library_python, operators
from haros_ci.link.common_messages import COMMON
from haros_ci.link.index import Source
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import SEQUENCES, is_smart_pointer, pointee
from haros_ci.link.values import (
    NONE,
    Callable,
    Cell,
    Choice,
    ClassValue,
    Known,
    Library,
    Mapped,
    Module,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
    concatenate,
    join,
)
from haros_ci.model.location import Location
from haros_ci.model.program import Expression, Type


def evaluate(run: Run, frame: Frame, expression: Expression) -> Value:
    """The value of *expression*; never raises, whatever it is."""
    run.step()
    return EVALUATORS[expression[0]](run, frame, expression)


def cell_of(run: Run, frame: Frame, expression: Expression) -> Cell | None:
    """The cell that *expression* names (an lvalue); None if it names none."""
    tag = expression[0]
    if tag == "name":
        return _named_cell(run, frame, expression[1])
    if tag == "field":
        if frame.source.program.language == "python":
            dotted = _dotted(expression)
            if dotted and frame.find(dotted.partition(".")[0]) is None and dotted.partition(".")[0] != "this":
                return None
        return member(run, evaluate(run, frame, expression[1]), expression[2], frame)
    if tag == "index":
        return operators.element(run, frame, evaluate(run, frame, expression[1]), evaluate(run, frame, expression[2]))
    if tag == "*":
        value = evaluate(run, frame, expression[1])
        if isinstance(value, Pointer):
            return value.cell
        return cell_of(run, frame, expression[1])
    if tag in ("&", "kw"):
        return cell_of(run, frame, expression[-1])
    if tag == "cast":
        return cell_of(run, frame, expression[2])
    return None


def member(run: Run, value: Value, name: str, frame: Frame) -> Cell | None:
    """The cell of a data member; made where the class declares it (or Python may), None where there is none."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if not isinstance(value, Object):
        return None
    cell = value.fields.get(name)
    if cell is None and value.definition is not None:
        source, definition = value.definition
        found = construct.field_of(run, source, definition, name, value.templates)
        if found is not None:
            where, declared, kind = found
            if declared.is_static:
                return global_cell(run, where, f"{definition.name}{where.separator}{name}", declared.init, kind)
            cell = value.fields[name] = Cell(run.opaque(f"the member {name} is not set before", frame, None, kind), kind)
    return cell


def _named_cell(run: Run, frame: Frame, name: str) -> Cell | None:
    cell = frame.find(name)
    if cell is not None:
        return cell
    if frame.source.program.language == "python":
        module = module_frame(run, frame.source)
        return module.scopes[0].get(name)
    this = frame.this
    if this is None and frame.outer is not None:
        this = frame.outer.this
    if this is not None and "::" not in name:
        cell = member(run, this, name, frame) or library_cpp.protected(run, this, name)
        if cell is not None:
            return cell
    key = ("variable", name, frame.scope, frame.source.path)
    if key not in run.found:
        run.found[key] = _variable(run, frame, name)
    found = run.found[key]
    return global_cell(run, *found) if found is not None else None


def _variable(run: Run, frame: Frame, name: str) -> tuple[Source, str, Any, Type] | None:
    """The namespace-scope variable or static member that *name* means: its file, qualified name, initialiser, type."""
    for candidate in run.index.scopes(name, frame.scope, frame.source):
        found = run.index.near(run.index.variables, candidate, frame.source, run.files)
        if found:
            where, variable = found[0]
            return where, variable.name, variable.init, variable.type
        head, colons, last = candidate.rpartition("::")
        if colons:
            owner = run.class_of(head, frame.source)
            if owner is not None:
                static = construct.field_of(run, owner[0], owner[1], last, {})
                if static is not None and static[1].is_static:
                    return static[0], candidate, static[1].init, static[2]
    return None


def global_cell(run: Run, source: Source, name: str, init: Any, kind: Type) -> Cell:
    """The one cell of a namespace-scope variable or static member, made when it is first used."""
    key = (source.path, name)
    cell = run.globals.get(key)
    if cell is None:
        frame = Frame(source, name.rpartition(source.separator)[0])
        resolved = run.type_in(kind, frame)
        cell = run.globals[key] = Cell(run.opaque(f"{name} is not set", frame, None, resolved), resolved)
        if init is not None:
            cell.value = construct.initial(run, frame, resolved, init, Location(source.path))
        elif not init:
            for where, variable in run.index.variables.get(name, ()):  # a static member's definition elsewhere
                if variable.init is not None:
                    cell.value = construct.initial(run, Frame(where, frame.scope), resolved, variable.init, Location(where.path))
                    break
    return cell


def _name(run: Run, frame: Frame, expression: Expression) -> Value:
    name = expression[1]
    cell = _named_cell(run, frame, name)
    if cell is not None:
        return cell.value
    if frame.source.program.language == "python":
        return _python_name(run, frame, name)
    key = ("name", name, frame.scope, frame.source.path)
    if key not in run.found or frame.templates:
        run.found[key] = _global_name(run, frame, name)
    value: Value = run.found[key]
    if isinstance(value, Callable) and frame.this is not None and "::" not in name and _is_virtual(run, frame, value):
        method = construct.method_of(run, frame.this, name)
        if method is not None:
            return method
    if isinstance(value, Callable) and value.function.owner and not value.function.is_static and frame.this is not None:
        return Callable(value.source, value.function, frame.this, templates=frame.templates)
    return value


def _is_virtual(run: Run, frame: Frame, value: Callable) -> bool:
    """Whether the call of a method goes to the object's own class: not inside a constructor, where it is not yet of it."""
    if frame.function is None or frame.function.kind in ("constructor", "destructor"):
        return False
    return any(function.is_virtual for _, function in run.index.functions.get(value.function.name, ()))


def _global_name(run: Run, frame: Frame, name: str) -> Value:
    """What a name that is no variable means in C++: a function, macro, class, or a library's name."""
    index = run.index
    for candidate in index.scopes(name, frame.scope, frame.source):
        functions = index.near(index.functions, candidate, frame.source, run.files)
        if functions:
            return Callable(*construct.with_body(run, functions))
    macros = index.near(index.macros, name, frame.source, run.files)
    if macros:
        return operators.macro(macros[0][1])
    resolved = run.type_in((name, (), ""), frame)
    found = run.class_of(resolved[0], frame.source)
    if found is not None:
        return ClassValue(*found)
    if "::" in name:
        method = construct.tail_method(run, resolved[0] if "::" in resolved[0] else name, frame.source)
        if method is not None:
            return Callable(method[0], method[1])
    return Library(resolved[0])


def _python_name(run: Run, frame: Frame, name: str) -> Value:
    program = frame.source.program
    if name in ("True", "False", "None"):
        return Known({"True": True, "False": False, "None": None}[name])
    found = run.index.near(run.index.classes, name, frame.source, run.files)
    if found and found[0][0].path == frame.source.path:
        return ClassValue(*found[0])
    functions = [f for f in run.index.functions.get(name, ()) if f[0].path == frame.source.path]
    if functions:
        return Callable(functions[-1][0], functions[-1][1])
    for alias in program.aliases:
        if alias.name == name:
            return imported(run, frame, alias.type[0])
    for alias in program.aliases:
        if alias.name == "*":
            value = imported(run, frame, f"{alias.type[0].removesuffix('.*')}.{name}")
            if not isinstance(value, Library):
                return value
    if not hasattr(builtins, name):
        return Library(_starred(run, frame.source, name) or name)
    return Library(name)


def _starred(run: Run, source: Source, name: str) -> str | None:
    """The message type that ``from pkg.msg import *`` brings in: defined in the workspace, or else by the one package outside."""
    outside = []
    for alias in source.program.aliases:
        module = alias.type[0].removesuffix(".*")
        package, _, kind = module.rpartition(".")
        if alias.name != "*" or kind not in ("msg", "srv"):
            continue
        if f"{package}/{name}" in run.index.interfaces:
            return f"{module}.{name}"
        if name in COMMON.get(package, ()):
            return f"{module}.{name}"
        if package not in run.index.packages and package not in COMMON:
            outside.append(f"{module}.{name}")
    return outside[0] if len(outside) == 1 and name[:1].isupper() else None


def imported(run: Run, frame: Frame, target: str) -> Value:
    """What a dotted Python name means: a module, class, function or variable of the workspace, or a library's name."""
    if target.startswith("."):
        dots = len(target) - len(target.lstrip("."))
        base = frame.source.module.split(".")
        if not frame.source.path.endswith("__init__.py"):
            base = base[:-1]
        base = base[: len(base) - dots + 1]
        target = ".".join((*base, target.lstrip("."))) if target.lstrip(".") else ".".join(base)
    head = target
    rest: list[str] = []
    while head:
        modules = run.index.modules.get(head)
        if modules:
            source = min(modules, key=lambda s: (s.package != frame.source.package, s.path))
            value: Value = Module(source)
            for part in reversed(rest):
                value = attribute(run, value, part, frame)
            return value
        head, dot, last = head.rpartition(".")
        if not dot:
            break
        rest.append(last)
    return Library(target)


def module_frame(run: Run, source: Source) -> Frame:
    """A Python module's own scope; its body is followed once, when the module is first used."""
    frame = run.modules.get(source.path)
    if frame is None:
        from haros_ci.link import statements

        frame = run.modules[source.path] = Frame(source, "")
        body = next((f for f in source.program.functions if f.kind == "module"), None)
        if body is not None and body.body:
            for statement in body.body:
                run.step()
                if statements.STATEMENTS[statement[0]](run, frame, statement) != statements.NEXT:
                    break
    return frame


def attribute(run: Run, value: Value, name: str, frame: Frame) -> Value:
    """``value.name`` where it is no data member: a method, a module's content, a library's member."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Module):
        inner = module_frame(run, value.source)
        if name in inner.scopes[0]:
            return inner.scopes[0][name].value
        deeper = run.index.modules.get(f"{value.source.module}.{name}")
        if deeper:
            return Module(deeper[0])
        return _python_name(run, inner, name)
    if isinstance(value, Library):
        if value.name == "sys" and name == "argv":
            return library_python.argv(run)
        return Library(f"{value.name}.{name}" if frame.source.program.language == "python" else f"{value.name}::{name}")
    if isinstance(value, Object):
        cell = member(run, value, name, frame)
        if cell is not None:
            return cell.value
        method = construct.method_of(run, value, name)
        if method is not None:
            return method
        return Library(f"{value.name}{frame.source.separator}{name}", value)
    if isinstance(value, ClassValue):
        found = construct.field_of(run, value.source, value.definition, name, {})
        if found is not None:
            separator = value.source.separator
            return global_cell(run, found[0], f"{value.definition.name}{separator}{name}", found[1].init, found[2]).value
        method = construct.class_method(run, value.source, value.definition, name)
        if method is not None:
            return Callable(method[0], method[1])
        return Library(f"{value.definition.name}.{name}")
    if isinstance(value, Choice):
        result: Value | None = None
        for option in value.options:
            found_ = attribute(run, option, name, frame)
            result = found_ if result is None else join(result, found_)
        return result if result is not None else NONE
    if isinstance(value, Opaque):
        kind = value.type
        if kind is not None and kind[0]:
            owner = run.class_of(pointee(kind)[0], frame.source)
            if owner is not None:
                declared = construct.field_of(run, owner[0], owner[1], name, {})
                if declared is not None:
                    return Opaque(value.reason, value.location, declared[2])
                method = construct.class_method(run, owner[0], owner[1], name)
                if method is not None:
                    return Callable(method[0], method[1])
            return Library(f"{pointee(kind)[0]}{frame.source.separator}{name}", value)
        return Opaque(value.reason, value.location)
    return Library(name, value)


def _field(run: Run, frame: Frame, expression: Expression) -> Value:
    value = evaluate(run, frame, expression[1])
    cell = member(run, value, expression[2], frame)
    if cell is not None:
        return cell.value
    return attribute(run, value, expression[2], frame)


def _dotted(expression: Expression) -> str:
    parts: list[str] = []
    while expression[0] == "field":
        parts.append(expression[2])
        expression = expression[1]
    if expression[0] != "name":
        return ""
    return ".".join((expression[1], *reversed(parts)))


def _this(run: Run, frame: Frame, expression: Expression) -> Value:
    around: Frame | None = frame
    while around is not None:
        if around.this is not None:
            return around.this
        around = around.outer
    return run.opaque("the object is not known", frame)


def _conditional(run: Run, frame: Frame, expression: Expression) -> Value:
    from haros_ci.link.statements import truth

    holds = truth(evaluate(run, frame, expression[1]))
    one, other = evaluate(run, frame, expression[2]), evaluate(run, frame, expression[3])
    return join(one, other) if holds is None else one if holds else other


def _list(run: Run, frame: Frame, expression: Expression) -> Value:
    items: list[Cell] = []
    for item in expression[1]:
        if item[0] == "star":
            return Sequence(Cell(run.opaque("a list with unpacked elements", frame)))
        items.append(Cell(evaluate(run, frame, item)))
    return Sequence(Cell(tuple(items)))  # type: ignore[arg-type]


def _dict(run: Run, frame: Frame, expression: Expression) -> Value:
    pairs = {}
    for key, item in expression[1]:
        found = evaluate(run, frame, key) if key else NONE
        if not isinstance(found, Known) or isinstance(found.value, (list, dict)):
            return Mapped(Cell(run.opaque("a dictionary with computed keys", frame)))
        pairs[found.value] = Cell(evaluate(run, frame, item))
    return Mapped(Cell(pairs))  # type: ignore[arg-type]


def _lambda(run: Run, frame: Frame, expression: Expression) -> Value:
    return Callable(frame.source, frame.source.program.functions[expression[1]], _here(frame), frame=frame)


def _here(frame: Frame) -> Object | None:
    return frame.this if frame.this is not None or frame.outer is None else _here(frame.outer)


def _address(run: Run, frame: Frame, expression: Expression) -> Value:
    cell = cell_of(run, frame, expression[1])
    if cell is None or isinstance(cell.value, (Object, Callable)):
        return evaluate(run, frame, expression[1])
    return Pointer(cell)


def _dereference(run: Run, frame: Frame, expression: Expression) -> Value:
    value = evaluate(run, frame, expression[1])
    if isinstance(value, Pointer):
        return value.cell.value
    if isinstance(value, Opaque) and value.type is not None and is_smart_pointer(value.type):
        return Opaque(value.reason, value.location, pointee(value.type))
    return value


def _cast(run: Run, frame: Frame, expression: Expression) -> Value:
    value = evaluate(run, frame, expression[2])
    return operators.converted(value, run.type_in(expression[1], frame))


def _format(run: Run, frame: Frame, expression: Expression) -> Value:
    return concatenate(tuple(evaluate(run, frame, part) for part in expression[1]))


def _unknown(run: Run, frame: Frame, expression: Expression) -> Value:
    text = expression[1] if len(expression) > 1 and isinstance(expression[1], str) else expression[0]
    return run.opaque(f"it is computed: {text}", frame)


def elements(run: Run, frame: Frame, expression: Expression) -> list[Value | Cell] | None:
    """The elements that a loop goes through; None if they are not known."""
    value = evaluate(run, frame, expression)
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        return list(value.content.value)
    if isinstance(value, Mapped) and isinstance(value.content.value, dict):
        return [Known(key) for key in value.content.value]
    if isinstance(value, Known) and isinstance(value.value, (list, dict)):
        return [Known(item) for item in value.value]
    return None


def element_type(run: Run, frame: Frame, expression: Expression) -> Type | None:
    """The static type of a container's elements."""
    kind = static_type(run, frame, expression)
    if kind is not None and kind[0] in SEQUENCES and kind[1]:
        found: Type = kind[1][0]
        return found
    return None


def static_type(run: Run, frame: Frame, expression: Expression) -> Type | None:
    """The declared (resolved) type of *expression*, as far as it can be told without running it."""
    tag = expression[0]
    if tag in LITERAL_TYPES:
        return LITERAL_TYPES[tag]
    if tag == "num":
        return ("int", (), "") if isinstance(expression[1], int) else ("double", (), "")
    if tag in ("&", "*", "kw"):
        return static_type(run, frame, expression[-1])
    if tag == "cast":
        return run.type_in(expression[1], frame)
    if tag == "op" and expression[1] in ("==", "!=", "<", ">", "<=", ">=", "!", "&&", "||"):
        return ("bool", (), "")
    if tag == "op":
        kinds = [static_type(run, frame, item) for item in expression[2]]
        known = [kind for kind in kinds if kind is not None]
        for name in ("std::string", "double", "float"):
            if any(kind[0] == name for kind in known):
                return (name, (), "")
        return known[0] if len(known) == len(kinds) and known else None
    cell = cell_of(run, frame, expression)
    if cell is not None and cell.type is not None and cell.type[0] not in ("", "auto"):
        return cell.type
    value = cell.value if cell is not None else evaluate(run, frame, expression)
    return operators.value_type(value)


LITERAL_TYPES: dict[str, Type] = {
    "str": ("std::string", (), ""),
    "bool": ("bool", (), ""),
    "format": ("std::string", (), ""),
    "list": ("list", (), ""),
    "dict": ("dict", (), ""),
}

EVALUATORS = {
    "str": lambda run, frame, e: Known(e[1]),
    "num": lambda run, frame, e: Known(e[1]),
    "bool": lambda run, frame, e: Known(e[1]),
    "none": lambda run, frame, e: NONE,
    "name": _name,
    "this": _this,
    "field": _field,
    "index": lambda run, frame, e: operators.indexed(run, frame, e),
    "call": lambda run, frame, e: calls.call(run, frame, e),
    "new": lambda run, frame, e: calls.new(run, frame, e),
    "op": lambda run, frame, e: operators.operation(run, frame, e),
    "set": lambda run, frame, e: operators.assignment(run, frame, e),
    "if": _conditional,
    "lambda": _lambda,
    "list": _list,
    "dict": _dict,
    "format": _format,
    "&": _address,
    "*": _dereference,
    "cast": _cast,
    "type": lambda run, frame, e: Library(run.type_in(e[1], frame)[0]),
    "kw": lambda run, frame, e: evaluate(run, frame, e[2]),
    "star": _unknown,
    "starstar": _unknown,
    "?": _unknown,
}
