# SPDX-License-Identifier: Apache-2.0
"""Calls whose target only the run decides: virtual methods of unknown objects, unknown functions, unknown plug-ins."""

from __future__ import annotations

import re

from haros_ci import syntax
from haros_ci.follow import bases, call_arguments, methods, python_names
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.index.types import pointee
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.syntax import Class, Function, Statement
from haros_ci.values.abstract import Callable, Cell, Known, Library, Object, Opaque, Text, Value

FUNCTIONS = frozenset(("()", "std::function", "boost::function"))

#: Functions that import a module by its name (docs.python.org/3/library/importlib.html), and why it is not known.
IMPORTS = frozenset(("__import__", "importlib.import_module"))
IMPORTED = "it is imported by a name that is not known"
#: Modules that are generated: what is in them only carries data.
INTERFACES = ("msg", "srv", "action")
#: Functions that give the class of a message, service or action by its name, and the module that it is in where the name has none
#: (rosidl_runtime_py/utilities.py, roslib/message.py).
CLASSES = {
    **{f"rosidl_runtime_py.utilities.get_{word}": "" for word in ("message", "service", "action", "interface")},
    "roslib.message.get_message_class": "msg",
    "roslib.message.get_service_class": "srv",
}
#: The name of an interface, with or without its module.
_INTERFACE = regex(r"([a-z][a-z0-9_]*)/(?:(msg|srv|action)/)?([A-Z][A-Za-z0-9]*)", re.ASCII)


def as_declared(
    walk: Walk, this: Object, cell: Cell | None, name: str, args: tuple[call_arguments.PassedArgument, ...]
) -> Callable | None:
    """The method of the class that a pointer or reference in *cell* says, where that is not virtual ([class.virtual]); None where the object's class decides."""
    kind = cell.type if cell is not None else None
    if kind is None or this.definition is None or kind.name == this.name or this.definition[0].separator != "::":
        return None
    kind = pointee(kind)
    if kind.name in ("", "auto", this.name):
        return None
    key = ("declared", kind.name, id(this.definition[1]), name)
    if key not in walk.found:
        walk.found[key] = _not_virtual(walk, this.definition, kind.name, name)
    owner: tuple[Source, Class] | None = walk.found[key]
    found = methods.class_method(walk, *owner, name, args) if owner is not None else None
    return Callable(found[0], found[1], this, templates=this.templates) if found is not None else None


def _not_virtual(walk: Walk, own: tuple[Source, Class], kind: str, name: str) -> tuple[Source, Class] | None:
    """The class *kind*, a base of *own*, if its method *name* is seen not to be virtual, and to be another one than that of *own*."""
    owner = walk.class_of(kind, own[0])
    if owner is None or owner[1].templates or owner[1] is own[1] or not bases.derives(walk, own, owner[1]):
        return None
    meant, declared = (methods.class_method(walk, *class_, name) for class_ in (own, owner))
    if declared is None or meant is None or meant[1].owner == declared[1].owner:
        return None
    every = bases.classes(walk, *own)
    is_virtual = any(_is_virtual(walk, f"{class_.name}::{name}") for _, class_ in every)
    return None if is_virtual or methods.library_bases(walk, *owner) else owner


def virtual(walk: Walk, owner: tuple[Source, Class], name: str, location: Location) -> None:
    """A method of some object of class *owner*: what a class derived from it would make, is not known to be made."""
    if owner[0].separator != "::":
        return
    key = ("overrider", owner[1].name, owner[0].path, name, walk.relevance.made)
    if key not in walk.found:
        walk.found[key] = _overrider(walk, owner, name)
    if walk.found[key] is not None:
        message = (
            f"{owner[1].name}::{name} is called on an object whose class is not known; it may be {walk.found[key]}"
        )
        walk.gaps.setdefault(message, location)


def _overrider(walk: Walk, owner: tuple[Source, Class], name: str) -> str | None:
    """The first class, by name, that defines virtual method *name* of *owner* anew so that it may make something."""
    declared = methods.class_method(walk, *owner, name)
    if declared is None or not _is_virtual(walk, declared[1].name):
        return None
    for other in sorted(walk.index.classes):
        found = [item for item in walk.index.functions.get(f"{other}::{name}", ()) if item[1].body is not None]
        if other == owner[1].name or not any(_adds(walk, where, function, name) for where, function in found):
            continue
        for where, definition in walk.index.classes[other]:
            if walk.index.sees(owner[0], where, walk.files) and bases.derives(walk, (where, definition), owner[1]):
                return other
    return None


def _adds(walk: Walk, source: Source, function: Function, name: str) -> bool:
    """Whether a method may make something but for what it has its base class do."""
    if not walk.relevance.makes(function, source):
        return False
    rest = tuple(statement for statement in function.body or () if not _is_of_base(statement, name))
    key = ("rest", id(function))
    if key not in walk.found:
        walk.found[key] = (function, rest)
    return walk.relevance.matters(walk.found[key][1], source, function)


def _is_of_base(statement: Statement, name: str) -> bool:
    """Whether a statement is ``Base::name(...);``."""
    if (
        type(statement) is not syntax.Do
        or type(statement.value) is not syntax.Call
        or type(statement.value.callee) is not syntax.Name
    ):
        return False
    return bool(statement.value.callee.name.endswith(f"::{name}"))


def _is_virtual(walk: Walk, name: str) -> bool:
    return any(function.is_virtual for _, function in walk.index.functions.get(name, ()))


def function(walk: Walk, called: Opaque, name: str, location: Location) -> None:
    """A function object or pointer that is not known is called: what it makes is not known."""
    if called.reason == IMPORTED:
        walk.gaps.setdefault(f"{name or 'a function'} is called: {IMPORTED}", location)
    walk.calls_unknown = True
    if called.type is not None and called.type.name in FUNCTIONS and "not set" not in called.reason:
        walk.gaps.setdefault(f"{name or 'a function'} is called, which is not known: {called.reason}", location)


def plugin(walk: Walk, called: str | None, reason: str, location: Location) -> None:
    """A plug-in is loaded that is not known, or not in the workspace: what it makes is not known."""
    if called == "":
        return  # pluginlib throws
    what = f"the plug-in {called[:200]}" if called is not None else "a plug-in"
    walk.gaps.setdefault(f"{what} is loaded: {reason}", location)


def module(walk: Walk, frame: Frame, name: str, args: tuple[call_arguments.PassedArgument, ...]) -> Value | None:
    """The Python module that one of ``IMPORTS`` gives: ``__import__`` alone gives the package that it is in."""
    expected = args[0].value if args else None
    if isinstance(expected, Known) and issubclass(expected.kind, str) and not expected.of(str).startswith("."):
        is_top = name == "__import__" and len(args) == 1
        return python_names.imported(walk, frame, expected.of(str).partition(".")[0] if is_top else expected.of(str))
    tail = expected.parts[-1] if isinstance(expected, Text) else None
    if isinstance(tail, str) and tail.endswith(tuple(f".{kind}" for kind in INTERFACES)):
        return None
    return walk.opaque(IMPORTED, frame) if args else None


def interface(name: str, args: tuple[call_arguments.PassedArgument, ...]) -> Library | None:
    """The class that one of ``CLASSES`` gives for a name that is known."""
    given = args[0].value if len(args) in (1, 2) else None
    found = _INTERFACE.fullmatch(given.of(str)) if isinstance(given, Known) and issubclass(given.kind, str) else None
    module = (found[2] or CLASSES[name]) if found is not None else ""
    return Library(f"{found[1]}.{module}.{found[3]}") if found is not None and module else None


def of_module(walk: Walk, value: Opaque, name: Value, frame: Frame) -> Value:
    """``getattr`` of a module that is not known."""
    if isinstance(name, Known) and name.value in INTERFACES:
        return walk.opaque("the type of a message that is not known", frame)
    return value
