# SPDX-License-Identifier: Apache-2.0
"""Python code that asks a message for a field: which message it is for certain, and whether it has the field.

An object is known where it is the parameter of a callback that is registered for one type, or a local variable or attribute of
``self`` that is never assigned anything but what one constructor makes. Generated classes have ``__slots__``: reading or writing any other attribute raises AttributeError.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence, Set

from haros_ci import syntax
from haros_ci.checking.code_text import alone
from haros_ci.checking.file_words import functions_of, own_names, receivers_of, shared_in, word_count
from haros_ci.checking.interface_users import defined_in
from haros_ci.checking.project import Project
from haros_ci.code.body import nodes
from haros_ci.code.callbacks import Callback, callbacks
from haros_ci.code.classes import owner_of
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.kinds import dotted, values_by_attribute
from haros_ci.interfaces.definitions import Definitions
from haros_ci.interfaces.structs import Struct, Structs
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Block, Expression

_INTERFACE = regex(r"\.(?:msg|srv|action)(?:\.|\Z)")
#: Code that asks which ROS it runs in is for both.
_EITHER = regex(r"ros_version|ros_distro", re.I)
#: Functions by which code finds out what an object has, or gives it more.
ASKING = frozenset(("hasattr", "getattr", "setattr", "isinstance", "type", "vars", "dir", "cast", "delattr"))
#: Where the type and the callback are among the arguments of a registration, and which parts its parameters get.
_REGISTERED = {
    ("create_subscription", 2): ((0, "msg_type"), ("2", "callback"), ("",)),
    ("create_service", 2): ((0, "srv_type"), ("2", "callback"), (".Request", ".Response")),
    ("Subscriber", 1): ((1, "data_class"), ("2", "callback"), ("",)),
    ("Service", 1): ((1, "service_class"), ("2", "handler"), ("Request",)),
}


@dataclass(frozen=True, slots=True)
class Missing:
    """*field* of *struct* is asked for in *routine*, as *written*; ``T(field=…)`` if it is given to the constructor."""

    struct: Struct
    field: str
    written: str
    routine: Routine
    location: Location


@dataclass(frozen=True, slots=True)
class Typed:
    """A Python function with the generated classes that its file sees, and those of its variables by name (``msg``, ``self.msg``)."""

    routine: Routine
    structs: Structs
    variables: dict[str, Struct]

    def struct_of(self, code: Codebase, call: syntax.Call) -> Struct | None:
        """The class of which *call* makes an object."""
        return self.structs.named(_imported(code, self.routine, call.callee))


def missing_fields(project: Project) -> Iterator[Missing]:
    """Every field that is asked for and not there, once for each function."""
    for typed in typed_routines(project):
        yield from _in_routine(project.code, typed)


def typed_routines(project: Project) -> Iterator[Typed]:
    """The functions of Python files that import interfaces and are for one ROS."""
    code = project.code
    found = defined_in(project)
    hidden = _handmade(project)
    structs = {ros: Structs(Definitions((i for i, of in found if of in (ros, None)), ros), hidden) for ros in (1, 2)}
    parameters = _parameters(code, structs)
    conditions = {p.name: [dependency.condition or "" for dependency in p.raw.dependencies] for p in project.packages}
    both = {name for name, group in conditions.items() if any("ROS_VERSION" in condition for condition in group)}
    for source in code.sources:
        if source.program.language != "python" or source.path.endswith(".pyi"):
            continue
        if not any(_INTERFACE.search(str(alias.type.name)) for alias in source.program.aliases):
            continue
        ros = code.ros_of(source)
        if ros not in structs or source.package in both or _EITHER.search(alone(code, source.path)):
            continue
        for routine in code.routines(source.path):
            yield Typed(routine, structs[ros], _variables(code, routine, structs[ros], parameters.get(id(routine), {})))


def _variables(code: Codebase, routine: Routine, structs: Structs, parameters: dict[str, Struct]) -> dict[str, Struct]:
    typed = {**parameters, **_locals(code, routine, structs)}
    typed = {name: struct for name, struct in typed.items() if not _is_asked(code, routine, name)}
    return {**typed, **_attributes(code, routine, structs)}


def _handmade(project: Project) -> frozenset[str]:
    """Packages whose Python modules of interfaces, or a part of them, people wrote."""
    found = (
        re.search(r"(?:^|/)(\w+)/(?:msg|srv|action)(?:\.py|/__init__\.py)\Z", name) for name in project.workspace.names
    )
    return frozenset(match[1] for match in found if match is not None)


def _in_routine(code: Codebase, other_typed: Typed) -> Iterator[Missing]:
    routine, structs, typed = other_typed.routine, other_typed.structs, other_typed.variables
    seen: set[tuple[str, str]] = set()
    for call in code.body(routine).calls:
        struct = other_typed.struct_of(code, call.whole)
        if struct is None or any(place.kind == "try" for place in call.around):
            continue
        keywords = [one.name for one in call.args if isinstance(one, syntax.Keyword)]
        lacking = [name for name in keywords if not struct.has(name) and (struct.name, name) not in seen]
        seen.update((struct.name, name) for name in lacking)
        if lacking:
            written = f"{struct.name}({', '.join(f'{name}=…' for name in lacking)})"
            yield Missing(struct, lacking[0], written, routine, Location(routine.path, call.line, call.column))
    if not typed:
        return
    for expression in expressions(routine.function.body or ()):
        for node in nodes(expression):
            found = _lacking(node, typed, structs)
            if found is not None and (found[0].name, found[1]) not in seen:
                seen.add((found[0].name, found[1]))
                yield Missing(*found, routine, _location(code, routine, found[2]))


def _lacking(node: Expression, typed: dict[str, Struct], structs: Structs) -> tuple[Struct, str, str] | None:
    """For ``msg.a.b``: the first part that is not there, with the class that lacks it and the text up to it."""
    chain: list[str] = []
    while isinstance(node, syntax.Member):
        chain.append(str(node.name))
        node = node.object
    if not chain or not isinstance(node, (syntax.Name, syntax.This)):
        return None
    written = node.name if isinstance(node, syntax.Name) else f"self.{chain.pop()}"
    struct = typed.get(written)
    for name in reversed(chain):
        if struct is None:
            return None
        written += f".{name}"
        if not struct.has(name):
            return struct, name, written
        struct = structs.of_field(struct, name)
    return None


def _locals(code: Codebase, routine: Routine, structs: Structs) -> dict[str, Struct]:
    """Local variables that are assigned nothing but what one constructor makes."""
    body = code.body(routine)
    values: dict[str, list[Expression | None]] = {
        parameter.name.lstrip("*"): [None] for parameter in routine.function.parameters
    }
    for target, operator, value, _ in body.sets:
        for node in nodes(target):
            if isinstance(node, syntax.Name):
                values.setdefault(str(node.name), []).append(value if node is target and operator == "=" else None)
            elif isinstance(node, (syntax.Member, syntax.Subscript)) and node is target:
                break  # what is set is a part of an object
    for name, variables in body.variables.items():
        for variable in variables:
            values.setdefault(name, []).append(variable.assigned)
    found = {
        name: _made(code, structs, [(routine, literal) for literal in arguments]) for name, arguments in values.items()
    }
    return {name: struct for name, struct in found.items() if struct is not None}


def _attributes(code: Codebase, routine: Routine, structs: Structs) -> dict[str, Struct]:
    """Attributes of ``self``, as ``self.name``, that all methods of the class and of its bases fill with one constructor."""
    owner = owner_of(code, routine) if routine.owner else None
    if owner is None:
        return {}
    key = ("message attributes", id(owner[1]), structs.known.ros)
    if key not in code.kept:
        made: dict[str, Struct] = {}
        values = values_by_attribute(code, owner)
        for name in sorted(values.keys() & _members(code, routine.path)):
            struct = _made(code, structs, values[name])
            if struct is not None and not _is_shared(code, routine.path, f"{owner[1].name}.{name}"):
                made[f"self.{name}"] = struct
        code.kept[key] = made
    found: dict[str, Struct] = code.kept[key]
    return found


def _members(code: Codebase, path: str) -> Set[str]:
    """The names of the members that a file sets, of whatever object."""
    key = ("members that are set", path)
    if key not in code.kept:
        every = (target for routine in code.routines(path) for target, *_ in code.body(routine).sets)
        code.kept[key] = frozenset(target.name for target in every if isinstance(target, syntax.Member))
    found: frozenset[str] = code.kept[key]
    return found


def _is_shared(code: Codebase, path: str, name: str) -> bool:
    """Whether other code than the class's may set the attribute, or it is a method or property."""
    last = name.rpartition(".")[2]
    receivers = receivers_of(code, path).get(last, ())
    is_function = name in functions_of(code, path)
    return is_function or any(receiver != "self" for receiver in receivers) or "setattr(" in code.text(path)


def _made(code: Codebase, structs: Structs, values: Sequence[tuple[Routine, Expression | None]]) -> Struct | None:
    """What all of *values* make, if each is a call of one and the same constructor."""
    made = set()
    for routine, value in values:
        made.add(_imported(code, routine, value.callee) if isinstance(value, syntax.Call) else "")
    return structs.named(made.pop()) if len(made) == 1 else None


def _imported(code: Codebase, routine: Routine, expression: Expression) -> str:
    """The dotted name that *expression* has through imports; "" where the file defines the name itself, too."""
    head = expression
    while isinstance(head, syntax.Member):
        head = head.object
    own = isinstance(head, syntax.Name) and head.name in own_names(code, routine)
    return "" if own else dotted(code, routine, expression)


def _is_asked(code: Codebase, routine: Routine, name: str) -> bool:
    """Whether code looks what the object has, or another function may set the variable."""
    for call in code.body(routine).calls:
        if call.name in ASKING and any(
            isinstance(argument, syntax.Name) and argument.name == name for argument in call.args
        ):
            return True
    return name in shared_in(code, routine.path)


def _parameters(code: Codebase, structs: dict[int, Structs]) -> dict[int, dict[str, Struct]]:
    """The parameters of callbacks that are registered for one type, by the identity of their routines."""
    by_routine: dict[int, list[Callback]] = {}
    for callback in callbacks(code):
        if callback.routine.is_python:
            by_routine.setdefault(id(callback.routine), []).append(callback)
    made = {}
    for key, registered in by_routine.items():
        routine = registered[0].routine
        names = [_types(code, callback) for callback in registered]
        if any(name != names[0] for name in names) or not names[0] or _is_used_besides(code, routine, len(registered)):
            continue
        ros = registered[0].ros
        typed = {}
        for parameter, name in zip(routine.function.parameters, names[0]):
            struct = structs[ros].named(name) if ros in structs else None
            if struct is not None and not _is_set(code, routine, parameter.name):
                typed[parameter.name] = struct
        if typed:
            made[key] = typed
    return made


def _types(code: Codebase, callback: Callback) -> tuple[str, ...]:
    """The dotted names of the types that the callback's parameters have, in order; () if they are not known."""
    row = _REGISTERED.get((callback.call.name, callback.ros or 0))
    if row is None or any(
        isinstance(argument, syntax.Keyword) and argument.name == "raw" for argument in callback.call.args
    ):
        return ()
    (position, keyword), roles, parts = row
    arguments = [argument for argument in callback.call.args if not isinstance(argument, syntax.DoubleStar)]
    taken = next(
        (literal for literal in arguments if isinstance(literal, syntax.Keyword) and literal.name == callback.role),
        None,
    )
    value = taken.value if taken is not None else arguments[int(callback.role)] if callback.role.isdigit() else None
    written = callback.call.argument(position, keyword)
    if callback.role not in roles or written is None or value is None or isinstance(value, syntax.Call):
        return ()
    name = _imported(code, callback.maker, written)
    return tuple(f"{name}{part}" for part in parts) if name else ()


def _is_used_besides(code: Codebase, routine: Routine, times: int) -> bool:
    """Whether the function's name stands elsewhere than in its definition and its registrations: it may be called with anything."""
    if routine.function.kind == "lambda":
        return False
    return word_count(code, routine.path)[routine.function.name.rpartition(".")[2]] > times + 1


def _is_set(code: Codebase, routine: Routine, name: str) -> bool:
    body = code.body(routine)
    targets = (
        node
        for target, *_ in body.sets
        for node in nodes(target)
        if not isinstance(target, (syntax.Member, syntax.Subscript))
    )
    return name in body.variables or any(isinstance(node, syntax.Name) and node.name == name for node in targets)


def _location(code: Codebase, routine: Routine, written: str) -> Location:
    """Where *written* first stands in the routine; its head if it is not found."""
    line = routine.function.line
    pattern = re.compile(r"(?<![\w.])" + r"\s*\.\s*".join(map(re.escape, written.split("."))) + r"\b")
    is_module = routine.function.kind == "module"
    text = code.text(routine.path) if is_module else code.lines(routine, line)
    places = []
    for number, part in enumerate(text.split("\n"), line):
        found = pattern.search(part.partition("#")[0])
        if found is not None:
            places.append((is_module and part[:1].isspace(), number, found.start() + 1, found.end() + 1))
    if places:
        _, number, start, end = min(places)
        return Location(routine.path, number, start, number, end)
    return Location(routine.path, line or 1)


def expressions(block: Block) -> Iterator[Expression]:
    """All expressions of a function's own body but those that a try stands around."""
    for statement in block:
        if isinstance(statement, (syntax.Do, syntax.Step, syntax.Return, syntax.Throw)):
            yield from (statement.value,) if statement.value is not None else ()
        elif isinstance(statement, syntax.Variable) and statement.init is not None:
            yield from syntax.started(statement.init)
        elif isinstance(statement, syntax.If):
            yield statement.test
            yield from expressions(statement.then)
            yield from expressions(statement.other)
        elif isinstance(statement, syntax.Loop):
            yield from expressions(statement.before)
            yield from (statement.test,) if statement.test is not None else ()
            yield from expressions(statement.body)
        elif isinstance(statement, syntax.Each):
            yield statement.iterable
            yield from expressions(statement.body)
        elif isinstance(statement, syntax.Switch):
            yield statement.value
            for case in statement.cases:
                yield from expressions(case.body)
        elif isinstance(statement, syntax.Try):
            for handler in statement.handlers:
                yield from expressions(handler.body)
        elif isinstance(statement, syntax.Nested):
            yield from expressions(statement.body)
