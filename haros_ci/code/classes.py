# SPDX-License-Identifier: Apache-2.0
"""Classes by name, their bases, methods and members, as the workspace's files tell; None where it is not one for sure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from haros_ci import syntax
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.index.index import Source
from haros_ci.index.types import pointee, resolve_type
from haros_ci.syntax import Class, Expression, Field, Function, Type
from haros_ci.syntax.codec import plain

#: A class and the file that defines it.
Owner = tuple[Source, Class]
#: Bases above each other that are looked at.
DEPTH = 12


def resolved(code: Codebase, kind: Type, scope: str, source: Source) -> Type:
    """A C++ type with its aliases replaced, seen from *scope* of *source*."""
    key = ("type", source.path, scope, plain(kind))
    if key not in code.kept:
        code.kept[key] = resolve_type(code.cpp, kind, scope, source, frozenset(), {})
    found: Type = code.kept[key]
    return found


def class_named(code: Codebase, name: str, source: Source) -> Owner | None:
    """The one class that a resolved name means for *source*."""
    key = ("class", name, source.path)
    if key not in code.kept:
        code.kept[key] = (
            _python_class(code, name, source) if source.separator == "." else _cpp_class(code, name, source)
        )
    found: Owner | None = code.kept[key]
    return found


def _cpp_class(code: Codebase, name: str, source: Source) -> Owner | None:
    found = code.cpp.near(code.cpp.classes, name.removeprefix("::"), source, frozenset())
    return found[0] if len(found) == 1 else None


def _python_class(code: Codebase, name: str, source: Source) -> Owner | None:
    """A class of the file, or of a module by its dotted name."""
    own = [class_ for class_ in code.python.classes.get(name, ()) if class_[0].path == source.path]
    if own:
        return own[0] if len(own) == 1 else None
    module, _, last = name.rpartition(".")
    found = [
        (where, class_)
        for where in code.python.modules.get(module, ())
        for class_ in _by_name(code, where).get(last, ())
    ]
    return found[0] if len(found) == 1 else None


def _by_name(code: Codebase, source: Source) -> Mapping[str, list[Class]]:
    """The classes of a file by their names."""
    key = ("classes by name", source.path)
    if key not in code.kept:
        made: dict[str, list[Class]] = {}
        for class_ in source.program.classes:
            made.setdefault(class_.name, []).append(class_)
        code.kept[key] = made
    found: Mapping[str, list[Class]] = code.kept[key]
    return found


def owner_of(code: Codebase, routine: Routine) -> Owner | None:
    """The class whose ``this`` a routine sees."""
    name = routine.owner
    if not name:
        return None
    own = _by_name(code, routine.source).get(name, ())
    if len(own) == 1:
        return routine.source, own[0]
    found = class_named(code, name, routine.source)
    if found is None and not routine.is_python:  # the namespace is opened by a using-directive
        for space in code.cpp.opened(routine.source):
            found = found or class_named(code, f"{space}::{name}", routine.source)
        if found is None:  # or a using-declaration has brought its name
            whole = resolved(code, Type(name), "", routine.source).name
            found = class_named(code, whole, routine.source) if whole != name else None
    return found


def bases(code: Codebase, owner: Owner) -> Iterator[tuple[Owner | None, str]]:
    """The bases of a class, nearest first: each with its class if the workspace defines it, and its name."""
    waiting: list[tuple[Owner, int]] = [(owner, 0)]
    seen: set[str] = set()
    while waiting:
        (source, definition), depth = waiting.pop(0)
        for base in definition.bases:
            scope = definition.name.rpartition(source.separator)[0]
            if source.separator == ".":
                name = dotted_name(source, base.name)
            else:
                name = resolved(code, base, scope, source).name
            if name in seen or depth > DEPTH:
                continue
            seen.add(name)
            above = class_named(code, name, source)
            yield above, name
            if above is not None:
                waiting.append((above, depth + 1))


def base_names(code: Codebase, owner: Owner) -> frozenset[str]:
    """The names of all bases of a class, as far as they are known."""
    key = ("bases", id(owner[1]))
    if key not in code.kept:
        code.kept[key] = frozenset(name for _, name in bases(code, owner))
    found: frozenset[str] = code.kept[key]
    return found


def dotted_name(source: Source, name: str) -> str:
    """A Python name through the imports of its file: ``Node`` is ``rclpy.node.Node``."""
    head, dot, rest = name.partition(".")
    targets = {alias.type.name for alias in source.program.aliases if alias.name == head}
    if len(targets) != 1:
        return name
    return absolute(source, targets.pop()) + dot + rest


def absolute(source: Source, target: str) -> str:
    """A relative import's target as an absolute one."""
    if not target.startswith("."):
        return target
    dots = len(target) - len(target.lstrip("."))
    parts = source.module.split(".")
    if not source.path.endswith("__init__.py"):
        parts = parts[:-1]
    return ".".join(part for part in (*parts[: len(parts) - dots + 1], target.lstrip(".")) if part)


def field_of(code: Codebase, owner: Owner, name: str) -> tuple[Owner, Field] | None:
    """A data member of a C++ class or of its bases."""
    every = [owner, *(above for above, _ in bases(code, owner) if above is not None)]
    for definition in every:
        found = [member for member in definition[1].fields if member.name == name]
        if found:
            return definition, found[0]
    return None


def methods(code: Codebase, owner: Owner, name: str) -> tuple[Routine, ...]:
    """The methods of that name with a body that a class has itself or from its nearest base that has one."""
    key = ("method", id(owner[1]), name)
    if key not in code.kept:
        every = [owner, *(above for above, _ in bases(code, owner) if above is not None)]
        code.kept[key] = next((found for definition in every if (found := _own_methods(code, definition, name))), ())
    known: tuple[Routine, ...] = code.kept[key]
    return known


def _own_methods(code: Codebase, owner: Owner, name: str) -> tuple[Routine, ...]:
    source, definition = owner
    whole = f"{definition.name}{source.separator}{name}"
    index = code.index(source)
    found = [function for function in index.functions.get(whole, ()) if _belongs(code, owner, function[0])]
    if not any(function.body is not None for _, function in found) and source.separator == "::":
        tail = "::".join(whole.split("::")[-2:])
        found += [
            other_definition
            for other_definition in index.by_tail.get(tail, ())
            if f"::{definition.name}".endswith(f"::{other_definition[1].owner}")
            and _belongs(code, owner, other_definition[0])
        ]
    made = (code.routine(where, function) for where, function in found if function.body is not None)
    return tuple(dict.fromkeys(routine for routine in made if routine is not None))


def _belongs(code: Codebase, owner: Owner, source: Source) -> bool:
    """Whether a definition in *source* can be of this very class, and not of another of its name."""
    if source.path == owner[0].path:
        return True
    return source.separator == "::" and owner[0].path in code.cpp.reach(source.path)


def accepts(function: Function, args: tuple[Expression, ...]) -> bool:
    """Whether a function can be called with so many arguments."""
    if any(isinstance(argument, (syntax.Star, syntax.DoubleStar)) for argument in args):
        return True
    needed = [p for p in function.parameters if p.default is None and not p.name.startswith("*")]
    collects = any(p.name.startswith("*") or "..." in p.type.marks or p.type.name == "..." for p in function.parameters)
    return collects or len(needed) <= len(args) <= len(function.parameters)


def pointed(kind: Type | None) -> str:
    """The name of the class that a type is of or points to; "" if it is not known."""
    return str(pointee(kind).name) if kind is not None else ""
