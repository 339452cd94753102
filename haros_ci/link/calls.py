# SPDX-License-Identifier: Apache-2.0
"""Calls: into the workspace's functions they are followed, into libraries the API rows and models say what they do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from haros_ci.link import api_rows, construct, expressions, library, operators
from haros_ci.link.run import DEPTH, Frame, Root, Run
from haros_ci.link.types import INTEGERS, NO_TYPE, REALS, STRINGS, is_smart_pointer, is_type, pointee
from haros_ci.link.values import (
    NONE,
    Callable,
    Cell,
    Choice,
    ClassValue,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
    join,
)
from haros_ci.model.location import Location
from haros_ci.model.program import Expression, Function, Type


@dataclass(frozen=True, slots=True, eq=False)
class Argument:
    """An argument: its value, its cell where it is an lvalue, its static type, its keyword in Python."""

    value: Value
    cell: Cell | None = None
    type: Type | None = None
    keyword: str = ""


def is_scalar(kind: Type) -> bool:
    """Whether a default-constructed variable of the type has no value."""
    name = kind[0]
    return name in INTEGERS or name in REALS or name in ("bool", "void", "") or set(name.split()) <= INTEGERS


def arguments(run: Run, frame: Frame, written: Any) -> tuple[Argument, ...]:
    """The arguments of a call, evaluated from left to right; unpacked sequences are spread where known."""
    result: list[Argument] = []
    for expression in written:
        tag = expression[0]
        if tag == "star":
            items = expressions.elements(run, frame, expression[1])
            if items is None:
                result.append(Argument(run.opaque("unpacked arguments", frame), keyword="*"))
            else:
                result += [Argument(item.value if isinstance(item, Cell) else item) for item in items]
            continue
        if tag == "starstar":
            result.append(Argument(run.opaque("unpacked arguments", frame), keyword="**"))
            continue
        keyword = ""
        if tag == "kw":
            keyword, expression = expression[1], expression[2]
        cell = expressions.cell_of(run, frame, expression) if expression[0] in LVALUES else None
        value = cell.value if cell is not None else expressions.evaluate(run, frame, expression)
        kind = cell.type if cell is not None and cell.type is not None else None
        if kind is None and expression[0] in TYPED:
            kind = expressions.static_type(run, frame, expression)
        result.append(Argument(value, cell, kind or operators.value_type(value), keyword))
    return tuple(result)


#: Steps that may go into one function that makes nothing; after that its results are not known.
SPENT = 3_000
LVALUES = frozenset(("name", "field", "index", "*"))
TYPED = frozenset(("str", "num", "bool", "op", "cast"))


def call(run: Run, frame: Frame, expression: Expression) -> Value:
    """The value of a call, with all that it makes, stores and registers on the way."""
    _, callee, written, targs, line, column = expression
    location = Location(frame.source.path, line, column)
    receiver: Value | None = None
    receiver_cell: Cell | None = None
    name = ""
    if callee[0] == "field":
        name = callee[2]
        receiver_cell = expressions.cell_of(run, frame, callee[1]) if callee[1][0] in LVALUES else None
        if receiver_cell is not None:
            receiver = receiver_cell.value
        else:
            receiver = expressions.evaluate(run, frame, callee[1])
        smart = receiver_cell is not None and is_smart_pointer(receiver_cell.type)
        args = arguments(run, frame, written)
        if smart and receiver_cell is not None and name in library.POINTER_METHODS:
            return library.pointer_method(run, receiver_cell, name, args)
        if isinstance(receiver, Pointer):
            receiver_cell, receiver = receiver.cell, receiver.cell.value
        if isinstance(receiver, Choice):
            result: Value | None = None
            for option in receiver.options:
                found = method_call(run, frame, option, None, name, args, targs, location)
                result = found if result is None else join(result, found)
            return result if result is not None else NONE
        return method_call(run, frame, receiver, receiver_cell, name, args, targs, location)
    function = expressions.evaluate(run, frame, callee)
    if isinstance(function, Pointer):
        function = function.cell.value
    return apply(run, frame, function, arguments(run, frame, written), targs, location, callee)


def method_call(
    run: Run,
    frame: Frame,
    receiver: Value,
    cell: Cell | None,
    name: str,
    args: tuple[Argument, ...],
    targs: Any,
    location: Location,
) -> Value:
    """``receiver.name(args)``."""
    if isinstance(receiver, Library) and receiver.name == "super":
        return super_call(run, frame, name, args, location)
    modelled = library.method(run, frame, receiver, cell, name, args, location)
    if modelled is not None:
        return modelled
    if isinstance(receiver, Object):
        method = construct.method_of(run, receiver, name, len(args))
        if method is not None:
            return invoke(run, frame, method, args, location, targs)
        field = receiver.fields.get(name)
        if field is not None:
            return apply(run, frame, field.value, args, targs, location, ("name", name))
        for owner in owners(run, receiver):
            found = api_rows.call(run, frame, f"{owner}{frame.source.separator}{name}", receiver, args, targs, location)
            if found is not None:
                return found
        return library.unknown_call(run, frame, f"{receiver.name}::{name}", args)
    if isinstance(receiver, Opaque):
        kind = receiver.type or (cell.type if cell is not None else None)
        if kind is not None and kind[0]:
            kind = pointee(kind)
            owner_class = run.class_of(kind[0], frame.source)
            if owner_class is not None:
                summary = summary_object(run, owner_class, kind, receiver)
                if construct.method_of(run, summary, name, len(args)) is not None:
                    return method_call(run, frame, summary, None, name, args, targs, location)
            else:
                stand_in = Object(kind[0], kind[1], namespace=receiver if kind[0] in api_rows.HANDLES else None)
                for owner in owners(run, stand_in):
                    found = api_rows.call(
                        run, frame, f"{owner}{frame.source.separator}{name}", stand_in, args, targs, location
                    )
                    if found is not None:
                        return found
        elif name in api_rows.UNMISTAKABLE and frame.source.program.language != "python":
            stand_in = Object("ros::NodeHandle", namespace=receiver)
            found = api_rows.call(run, frame, f"ros::NodeHandle::{name}", stand_in, args, targs, location)
            if found is not None:
                return found
        return library.unknown_call(run, frame, name, args, receiver)
    function = expressions.attribute(run, receiver, name, frame)
    return apply(run, frame, function, args, targs, location, ("name", name))


def super_call(run: Run, frame: Frame, name: str, args: tuple[Argument, ...], location: Location) -> Value:
    """Python's ``super().name(...)``: the method of the next class up, of the workspace or of a library."""
    this = expressions._here(frame)
    function = frame.function
    owner = run.class_of(function.owner, frame.source) if function is not None and function.owner else None
    if this is None or owner is None:
        return library.unknown_call(run, frame, f"super().{name}", args)
    for base in owner[1].bases:
        found = construct._python_class(run, base, owner[0])
        if found is None:
            if name == "__init__":
                for library_base in construct.library_bases(run, *owner):
                    construct_library(run, frame, this, (library_base, (), ""), args, location)
            continue
        method = construct.class_method(run, *found, name)
        if method is not None:
            return invoke(run, frame, Callable(*method, this), args, location)
    return library.unknown_call(run, frame, f"super().{name}", args)


def summary_object(run: Run, owner: Any, kind: Type, receiver: Opaque) -> Object:
    """Some object of a class, of which only the class is known."""
    source, definition = owner
    templates = dict(zip(definition.templates, kind[1], strict=False))
    return Object(definition.name, kind[1], owner, location=receiver.location, templates=templates)


def owners(run: Run, value: Object) -> list[str]:
    """The class names under which rows may know an object's methods: its own, then its libraries' bases."""
    found = [value.name] if value.definition is None else construct.library_bases(run, *value.definition)
    for name in found:
        for row in run.rows.get(name, ()):
            if row.is_class:
                found += [base for base in row.bases if base not in found]
    return found


def apply(
    run: Run, frame: Frame, function: Value, args: tuple[Argument, ...], targs: Any, location: Location, callee: Any
) -> Value:
    """Call *function*, whatever kind of value it is."""
    if isinstance(function, Callable):
        if function.function.body is None and function.function.kind != "constructor":
            source, definition = construct.with_body(run, [(function.source, function.function)])
            if definition.body is None:
                found = api_rows.call(run, frame, definition.name, function.this, args, targs, location)
                if found is not None:
                    return found
            function = Callable(source, definition, function.this, function.bound, function.frame, function.templates)
        if _takes_self(function, args):
            this = args[0].value
            assert isinstance(this, Object)
            function = Callable(function.source, function.function, this, function.bound, None, this.templates)
            args = args[1:]
        return invoke(run, frame, choose(run, frame, function, args), args, location, targs)
    if isinstance(function, ClassValue):
        owner = (function.source, function.definition)
        resolved = tuple(run.type_in(t, frame) for t in targs if isinstance(t, (tuple, list)) and len(t) == 3)
        return construct.instance(run, frame, owner, resolved, args, location)
    if isinstance(function, Library):
        return library_call(run, frame, function, args, targs, location, callee)
    if isinstance(function, Object):
        method = construct.method_of(run, function, "operator()" if frame.source.separator == "::" else "__call__")
        if method is not None:
            return invoke(run, frame, method, args, location, targs)
    if isinstance(function, Choice):
        result: Value | None = None
        for option in function.options:
            found_ = apply(run, frame, option, args, targs, location, callee)
            result = found_ if result is None else join(result, found_)
        return result if result is not None else NONE
    return library.unknown_call(run, frame, expressions._dotted(callee) or "a function", args)


def _takes_self(function: Callable, args: tuple[Argument, ...]) -> bool:
    """Whether this is ``Base.method(self, ...)`` of Python."""
    definition = function.function
    return (
        function.source.program.language == "python"
        and function.this is None
        and bool(definition.owner)
        and not definition.is_static
        and bool(args)
        and isinstance(args[0].value, Object)
    )


def library_call(
    run: Run, frame: Frame, function: Library, args: tuple[Argument, ...], targs: Any, location: Location, callee: Any
) -> Value:
    """A function, method or constructor of a library."""
    name = function.name
    if function.this is None and frame.this is not None and callee[0] == "name" and "::" not in callee[1]:
        for owner in owners(run, frame.this):  # an inherited method without ``this->``
            found = api_rows.call(run, frame, f"{owner}::{callee[1]}", frame.this, args, targs, location)
            if found is not None:
                return found
    modelled = library.function(run, frame, name, args, targs, location)
    if modelled is not None:
        return modelled
    kinds = tuple(run.type_in(t, frame) if is_type(t) else t for t in targs)
    found = api_rows.call(run, frame, name, function.this, args, targs, location, kinds)
    if found is not None:
        return found
    modelled = library.construct(run, frame, (name, kinds, ""), args)
    if modelled is not None:
        return modelled
    if callee[0] == "name" and "::" not in name and frame.source.separator == "::":
        resolved = run.type_in((callee[1], tuple(targs), ""), frame)
        if resolved[0] != name or is_smart_pointer(resolved) or resolved[0] in STRINGS:
            return construct.create(run, frame, resolved, args, location)
    return library.unknown_call(run, frame, name, args)


def new(run: Run, frame: Frame, expression: Expression) -> Value:
    """``new T(...)``: the object itself stands for its address."""
    _, kind, written, line, column = expression
    resolved = run.type_in(kind, frame)
    return construct.create(
        run, frame, (resolved[0], resolved[1], ""), arguments(run, frame, written), Location(frame.source.path, line, column)
    )


def choose(run: Run, frame: Frame, function: Callable, args: tuple[Argument, ...]) -> Callable:
    """The overload of a free function or method that takes these arguments."""
    definition = function.function
    if not definition.name or definition.kind == "lambda" or function.frame is not None:
        return function
    candidates = run.index.near(run.index.functions, definition.name, function.source, run.files)
    if len(candidates) < 2:
        return function
    source, chosen = construct.overload(candidates, len(args) + len(function.bound))
    return Callable(source, chosen, function.this, function.bound, function.frame, function.templates)


def invoke(
    run: Run,
    frame: Frame,
    function: Callable,
    args: tuple[Argument, ...],
    location: Location | None,
    targs: Any = (),
) -> Value:
    """Follow a function of the workspace with these arguments."""
    run.step()
    definition = function.function
    if definition.body is None:
        source, definition = construct.with_body(run, [(function.source, definition)])
        function = Callable(source, definition, function.this, function.bound, function.frame, function.templates)
    inner_scope = definition.owner or definition.name.rpartition(function.source.separator)[0]
    templates: Mapping[str, Type] = function.templates
    if definition.templates:
        explicit = {n: run.type_in(t, frame) for n, t in zip(definition.templates, targs, strict=False) if is_type(t)}
        templates = {**templates, **_deduced(definition, args), **explicit}
    inner = Frame(
        function.source, inner_scope, definition, function.this, templates=templates, outer=function.frame,
        mark=run.state.mark(),
    )
    returns = run.type_in(definition.returns, inner)
    if definition.body is None:
        found = library.unknown_call(run, frame, definition.name, args)
        return operators.converted(found, returns) if returns[0] not in ("", "void", "auto") else found
    if len(run.active) >= DEPTH or run.active.count(definition) > 1:
        return run.opaque("calls are nested too deeply to be followed", frame, None, returns)
    given = _with_bound(function.bound, args)
    makes_nothing = run.relevance.changes(definition, function.source) is not None
    if makes_nothing and (
        run.spent.get(id(definition), 0) > SPENT or _is_inert(run, function, definition, returns, given)
    ):
        return _skipped(run, inner, function, definition, returns, given)
    bind(run, frame, inner, definition, given, ())
    before = run.steps
    value = operators.converted(follow_body(run, inner, definition), returns)
    if makes_nothing:
        run.spent[id(definition)] = run.spent.get(id(definition), 0) + run.steps - before
    return value


def _is_inert(
    run: Run, function: Callable, definition: Function, returns: Type, args: tuple[Argument, ...]
) -> bool:
    """Whether a function need not be followed: it makes nothing, and gives and changes numbers only."""
    changed = run.relevance.changes(definition, function.source)
    if changed is None or (returns[0] and not is_scalar(returns) and returns[0] != "bool"):
        return False
    if not returns[0] and function.source.program.language == "python" and _returns_value(definition.body):
        return False
    for argument in args:
        value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
        if isinstance(value, (Sequence, Mapped, Callable, ClassValue, Choice)) or (
            isinstance(value, Known) and isinstance(value.value, (str, list, dict)) and argument.cell is not None
        ):
            return False
        if isinstance(value, Object) and not _only_numbers(value, changed):
            return False
    return function.this is None or _only_numbers(function.this, changed)


def _only_numbers(this: Object, changed: frozenset[str]) -> bool:
    for name in changed:
        cell = this.fields.get(name)
        if cell is None:
            continue
        if isinstance(cell.value, Known) and isinstance(cell.value.value, (int, float)):
            continue
        if isinstance(cell.value, Opaque) and (cell.type is None or is_scalar(cell.type) or cell.value.type is None):
            continue
        if isinstance(cell.value, Object) and cell.value.definition is None and cell.value.namespace is None:
            continue
        return False
    return True


def _returns_value(block: Any) -> bool:
    waiting = [block]
    while waiting:
        node = waiting.pop()
        if isinstance(node, (tuple, list)) and node:
            if node[0] == "return" and len(node) == 2 and node[1] is not None:
                return True
            waiting.extend(node)
    return False


def _skipped(
    run: Run, inner: Frame, function: Callable, definition: Function, returns: Type, args: tuple[Argument, ...]
) -> Value:
    """What is known after a function that was not followed: the numbers that it may change are not."""
    changed = run.relevance.changes(definition, function.source) or frozenset[str]()
    reason = f"{definition.name} may change it"
    objects = [a.value.cell.value if isinstance(a.value, Pointer) else a.value for a in args] + [function.this]
    for this in objects:
        if isinstance(this, Object):
            for name in changed & this.fields.keys():
                _forget(run, this.fields[name], run.opaque(reason, inner, definition.line, this.fields[name].type))
    for parameter, argument in zip(definition.parameters, args, strict=False):
        marks = parameter.type[2]
        if parameter.name in changed and "c" not in marks and ("&" in marks or "*" in marks):
            target = argument.value.cell if isinstance(argument.value, Pointer) else argument.cell
            if target is not None:
                _forget(run, target, run.opaque(reason, inner, definition.line, target.type))
    if returns[0] == "void":
        return NONE
    return run.opaque(f"what {definition.name} returns is computed", inner, definition.line, returns if returns[0] else None)


def _forget(run: Run, cell: Cell, unknown: Opaque) -> None:
    value = cell.value
    if isinstance(value, (Sequence, Mapped)):
        run.state.write(value.content, unknown)
    elif isinstance(value, (Known, Choice)) or type(value).__name__ == "Text":
        run.state.write(cell, unknown)


def _with_bound(bound: tuple[Value | None, ...], args: tuple[Argument, ...]) -> tuple[Argument, ...]:
    """The arguments of a bound function: a placeholder (None) takes the next one that is given."""
    rest = list(args)
    spread = [Argument(value) if value is not None else rest.pop(0) if rest else None for value in bound]
    return (*(a if a is not None else Argument(Opaque("an argument that is given from outside")) for a in spread), *rest)


def _deduced(definition: Function, args: tuple[Argument, ...]) -> dict[str, Type]:
    found: dict[str, Type] = {}
    for parameter, argument in zip(definition.parameters, args, strict=False):
        kind = argument.type
        if kind is None:
            continue
        if parameter.type[0] in definition.templates:
            found.setdefault(parameter.type[0], (kind[0], kind[1], ""))
        elif parameter.type[1]:
            for inner, actual in zip(parameter.type[1], kind[1], strict=False):
                if is_type(inner) and inner[0] in definition.templates and is_type(actual):
                    found.setdefault(inner[0], actual)
    return found


def bind(run: Run, frame: Frame, inner: Frame, function: Function, args: tuple[Argument, ...], _: Any) -> None:
    """Declare the parameters of *function* in *inner*: references are the caller's cells, the rest are copies."""
    positional = [argument for argument in args if not argument.keyword]
    named = {argument.keyword: argument for argument in args if argument.keyword}
    for number, parameter in enumerate(function.parameters):
        kind = run.type_in(parameter.type, inner)
        if parameter.name.startswith("*"):
            rest = tuple(Cell(argument.value) for argument in positional) if not parameter.name.startswith("**") else None
            value: Value = Sequence(Cell(rest)) if rest is not None else run.opaque("keyword arguments", frame)  # type: ignore[arg-type]
            inner.declare(parameter.name.lstrip("*"), Cell(value))
            positional = []
            continue
        argument = positional.pop(0) if positional else named.get(parameter.name)
        if argument is None:
            default = parameter.default or _declared_default(run, function, number)
            if default is not None:
                value = operators.converted(expressions.evaluate(run, inner, default), kind)
            else:
                value = run.opaque("an argument that is given from outside", inner, function.line, kind)
            inner.declare(parameter.name, Cell(value, kind if kind[0] else None))
            continue
        if "&" in kind[2] and argument.cell is not None and "c" not in kind[2]:
            inner.declare(parameter.name, argument.cell)
            continue
        value = argument.value
        if kind[0] and isinstance(value, Known) and isinstance(value.value, str) and not is_smart_pointer(kind):
            owner = run.class_of(kind[0], inner.source) if kind[0] not in STRINGS else None
            if owner is not None:
                value = construct.create(run, inner, (kind[0], kind[1], ""), (argument,), Location(inner.source.path))
        if kind[0]:
            value = operators.converted(value, kind)
        declared = kind if kind[0] and kind[0] != "auto" and kind[0] not in inner.templates else argument.type
        inner.declare(parameter.name, Cell(value, declared))


def _declared_default(run: Run, function: Function, number: int) -> Expression | None:
    """A default argument that stands at the function's declaration, and not at its definition."""
    for _, declared in run.index.functions.get(function.name, ()):
        if declared is not function and len(declared.parameters) == len(function.parameters):
            default = declared.parameters[number].default
            if default is not None:
                return default
    return None


def follow_body(run: Run, inner: Frame, function: Function) -> Value:
    """Execute a function's body in its frame and join what all its ways out return and leave behind."""
    from haros_ci.link import statements

    run.active.append(function)
    mark = inner.mark
    try:
        ended = statements.execute(run, inner, function.body or ())
    except RecursionError:
        return run.opaque("the code is nested too deeply to be followed", inner, function.line)
    finally:
        run.active.pop()
    if inner.exits:
        branches = list(inner.exits)
        if ended == statements.NEXT and not inner.is_dead:
            branches.append(run.state.since(mark))
        run.state.undo(mark)
        run.state.merge(branches)
    if not inner.returned:
        return NONE
    value = inner.returned[0]
    for other in inner.returned[1:]:
        value = join(value, other)
    return value


def register(run: Run, value: Value, others: tuple[Argument, ...] = ()) -> None:
    """*value* will be called back: remember it with the object among *others* that it is a method of."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object) and value.definition is not None:
        separator = value.definition[0].separator
        found = construct.method_of(run, value, "operator()" if separator == "::" else "__call__")
        if found is None:
            return
        value = found
    if isinstance(value, Choice):
        for option in value.options:
            register(run, option, others)
        return
    if not isinstance(value, Callable):
        return
    function = value.function
    if value.this is None and function.owner and value.frame is None:
        for argument in others:
            inner = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
            if isinstance(inner, Object) and inner.definition is not None:
                value = Callable(value.source, function, inner, value.bound, value.frame, inner.templates)
                break
    key = (id(value.function), id(value.this), len(value.bound))
    if key not in run.known_roots:
        run.known_roots.add(key)
        run.roots.append(Root(value, tuple(run.conditions)))


def framework_entries(run: Run, this: Object) -> None:
    """Methods that a framework will call on *this*, as its library base classes say (``entry`` of a row)."""
    for owner in owners(run, this):
        for row in run.rows.get(owner, ()):
            for name in row.entry:
                method = construct.method_of(run, this, name)
                if method is not None and row.is_class:
                    register(run, method)


def library_object(
    run: Run, frame: Frame, kind: Type, args: tuple[Argument, ...], location: Location
) -> Value:
    """An instance of a library's class."""
    modelled = library.construct(run, frame, kind, args)
    if modelled is not None:
        return modelled
    if not kind[0] or "()" in kind[0]:
        return args[0].value if args else run.opaque("it is not known", frame)
    if len(args) == 1 and isinstance(args[0].value, Object) and args[0].value.name == kind[0]:
        return args[0].value  # a copy
    if len(args) == 1 and isinstance(args[0].value, Callable):
        return args[0].value  # boost::function and its kin
    this = Object(kind[0], kind[1], location=location)
    construct_library(run, frame, this, kind, args, location)
    return this


def construct_library(
    run: Run, frame: Frame, this: Object, kind: Type, args: tuple[Argument, ...], location: Location
) -> None:
    """What the constructor of a library's class makes, on *this*."""
    api_rows.construct(run, frame, this, kind, args, location)


__all__ = ["Argument", "arguments", "bind", "call", "follow_body", "invoke", "new", "register", "NO_TYPE"]
