# SPDX-License-Identifier: Apache-2.0
"""Classes: the look-up of their members and methods through their bases, and which of several overloads is meant."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import bases, expressions, linear, many_overloads, members, overloads, python_names
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Field, Function, Type
from haros_ci.values.abstract import Callable, ClassValue, Object, Value
from haros_ci.values.iterators import class_meant

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

    #: The arguments of a call, None where no call is meant.
    Given = Sequence[PassedArgument] | None

NOTHING = bases.NOTHING

Member = tuple[Source, Field, Type]
Found = tuple[Source, Function]


def field_of(
    walk: Walk, source: Source, definition: Class, name: str, templates: Mapping[str, syntax.Argument]
) -> Member | None:
    """The data member *name* of a class or its bases: where it is declared, and its resolved type."""
    key = ("field", id(definition), name, walk.numbered(templates) if templates else 0)
    if key not in walk.found:
        walk.found[key] = _field_of(walk, source, definition, name, templates)
    found: Member | None = walk.found[key]
    return found


def _field_of(
    walk: Walk, source: Source, definition: Class, name: str, templates: Mapping[str, syntax.Argument]
) -> Member | None:
    every: Iterable[bases.Owner]
    if source.separator == "." and len(definition.bases) > 1:
        every = ((*owner, NOTHING) for owner in linear.of_workspace(linear.order(walk, source, definition)))
    else:
        every = bases.of_workspace(bases.lineage(walk, source, definition, templates))
    for where, known, bound in every:
        for declared in known.fields:
            if declared.name == name:
                return where, declared, walk.resolved(declared.type, known.name, where, bound)
    return None


def class_method(
    walk: Walk,
    source: Source,
    definition: Class,
    name: str,
    arguments: Given = None,
    templates: Mapping[str, syntax.Argument] = NOTHING,
) -> Found | None:
    """The method *name* of a class or its bases; the *arguments* of the call choose between overloads.

    *templates* are what the template parameters of the class stand for, of which a base class may be one.
    """
    if source.separator == ".":
        every = linear.of_workspace(linear.order(walk, source, definition))
    else:
        every = (owner[:2] for owner in bases.of_workspace(bases.lineage(walk, source, definition, templates)))
    found_in = (own_method(walk, where, known, name, arguments) for where, known in every)
    return next((found for found in found_in if found is not None), None)


def own_method(walk: Walk, source: Source, definition: Class, name: str, arguments: Given = None) -> Found | None:
    """The method or constructor *name* that stands in a class itself; the *arguments* of the call choose between overloads."""
    if source.separator == "::":
        overloaded = _cpp_methods(walk, source, definition, name)
        return overload(walk, overloaded, arguments) if overloaded else None
    candidates = walk.index.near(walk.index.functions, f"{definition.name}.{name}", source, walk.files)
    candidates = overloads.python_methods([item for item in candidates if item[0].path == source.path])
    if not candidates:
        return None
    where, function = overload(walk, candidates, arguments)
    return where, overloads.decorated(walk, function)


def other_constructor(
    walk: Walk, source: Source, definition: Class, running: Function, arguments: Given
) -> Found | None:
    """The constructor that *running* delegates to: another one of its class ([class.base.init], paragraph 6)."""
    kinds = [parameter.type for parameter in running.parameters]
    every = _cpp_methods(walk, source, definition, definition.name.rpartition("::")[2])
    others = [item for item in every if [parameter.type for parameter in item[1].parameters] != kinds]
    return overload(walk, others, arguments) if others else None


def python_class(walk: Walk, base: Type, source: Source) -> tuple[Source, Class] | None:
    value: Value = expressions.evaluate(
        walk, python_names.module_frame(walk, source), syntax.Name(base.name.split(".")[0])
    )
    for part in base.name.split(".")[1:]:
        value = members.attribute(walk, value, part, Frame(source, ""))
    value = class_meant(value)
    return (value.source, value.definition) if isinstance(value, ClassValue) else None


def as_node(walk: Walk, name: str, source: Source, definition: Class) -> str:
    """The node of rclpy for a class ``Node`` of a library that is not known: it derives from it, and what else it makes is not known."""
    if not name.endswith(".Node") or name in walk.rows or walk.context.process is None:
        return name
    message = f"the base class {name} is not in the workspace: what it makes and calls is not known"
    walk.gaps.setdefault(message, Location(source.path, definition.line))
    return "rclpy.node.Node"


def library_bases(
    walk: Walk, source: Source, definition: Class, templates: Mapping[str, syntax.Argument] = NOTHING
) -> list[str]:
    """The names of all base classes that are not of the workspace; *templates* are what its template parameters stand for."""
    if source.separator == "::":
        return [entry for entry in bases.lineage(walk, source, definition, templates) if isinstance(entry, str)]
    place = (id(definition), len(walk.modules))
    if walk.is_called_back and place in walk.outside_bases:
        return walk.outside_bases[place]
    every = bases.depth_first(walk, (source, definition, NOTHING), _python_bases)
    bases.note_cut(walk, every, bases.MOST, source, definition)
    found = [entry for entry in every if isinstance(entry, str)]
    if walk.is_called_back and len(walk.modules) == place[1]:
        walk.outside_bases[place] = found
    return found


def _python_bases(walk: Walk, owner: bases.Owner) -> Iterator[bases.Entry]:
    source, definition, _ = owner
    for base in walk.bases(source, definition, NOTHING):
        found = python_class(walk, base, source)
        if found is not None:
            yield *found, NOTHING
            continue
        head, *rest = base.name.split(".")
        value = class_meant(expressions.evaluate(walk, Frame(source, ""), syntax.Name(head)))
        yield as_node(walk, ".".join((getattr(value, "name", head), *rest)), source, definition)


def method_of(walk: Walk, this: Object, name: str, arguments: Given = None) -> Callable | None:
    """The method *name* of an object, bound to it."""
    if this.definition is None:
        return None
    source, definition = this.definition
    templates = this.templates if definition.templates else NOTHING
    found = class_method(walk, source, definition, name, arguments, templates)
    if found is None:
        return None
    return Callable(found[0], found[1], this, templates=this.templates)


def templates_of(walk: Walk, this: Object, owner: str) -> Mapping[str, syntax.Argument] | None:
    """What the template parameters of *owner*, a base class of the object *this*, stand for; None if it has none."""
    if this.definition is None or this.definition[1].name == owner:
        return None
    if not any(class_.templates for _, class_ in walk.index.classes.get(owner, ())):
        return None
    every = bases.of_workspace(bases.lineage(walk, *this.definition, this.templates))
    return next((bound for _, known, bound in every if known.name == owner), None)


def overload(walk: Walk, candidates: list[Found], arguments: Given) -> Found:
    """The definition that takes the *arguments* of the call, with its body if it has one; of several bodies none for certain."""
    if len(candidates) > overloads.MOST:  # each call would compare its arguments with all of them
        return many_overloads.one_of(walk, candidates)
    candidates = overloads.compiled(walk, candidates)
    fitting = candidates
    if arguments is not None:
        fitting = [item for item in candidates if overloads.takes(item[1], len(arguments))] or candidates
    best = next((item for item in fitting if item[1].body is not None), fitting[0])
    if arguments is not None and len({overloads.signature(item[1]) for item in fitting}) > 1:
        best = overloads.chosen(walk, fitting, arguments)
    if best[1].body is None:
        bodies = [
            item
            for item in candidates
            if item[1].body is not None and len(item[1].parameters) == len(best[1].parameters)
        ]
        requested = overloads.signature(best[1])
        elsewhere = [item for item in _defined(walk, best) if item not in candidates]
        candidates = [*candidates, *elsewhere]
        alike = (item for item in (*bodies, *elsewhere) if overloads.signature(item[1]) == requested)
        best = next(alike, (*elsewhere, *bodies, best)[0])
    return overloads.any_of(walk, best, candidates) if best[1].body is not None else best


def _cpp_methods(walk: Walk, source: Source, definition: Class, name: str) -> list[Found]:
    """The declarations and definitions of a method of a class of C++, as seen from *source*."""
    key = ("methods", definition.name, name, source.path)
    if key not in walk.found:
        candidates = walk.index.near(walk.index.functions, f"{definition.name}::{name}", source, walk.files)
        candidates = _of_this(walk, source, definition, candidates)
        if not any(function.body is not None for _, function in candidates):
            loose = _of_this(walk, source, definition, _loose(walk, definition.name, name))
            candidates = [*overloads.nearest(walk, loose, source), *candidates]
        walk.found[key] = _of_branches(walk, candidates)
    found: tuple[list[Found], Location | None] = walk.found[key]
    if found[1] is not None:
        message = f"{definition.name}::{name} is defined in two branches of an #if, and only one of them is followed"
        walk.gaps.setdefault(message, found[1])
    return found[0]


def _of_this(walk: Walk, source: Source, definition: Class, candidates: list[Found]) -> list[Found]:
    """Those of *candidates* that are not seen to be of another class of that name, which stands in their file or in what it includes."""
    known = walk.index.classes.get(definition.name, ())
    others = {where.path for where, other in known if where.path != source.path and (other.fields or other.bases)}
    if not others:
        return candidates
    return [
        item
        for item in candidates
        if item[0].path == source.path
        or (reach := walk.index.reach(item[0].path))
        and source.path in reach
        or (item[0].path not in others and others.isdisjoint(reach))
    ]


def _of_branches(walk: Walk, candidates: list[Found]) -> tuple[list[Found], Location | None]:
    """With the definitions elsewhere of what a header declares in one branch of an ``#if``, and defines in another.

    Those come first of which a definition may make something; then the place of one that may, too, and is not followed.
    """
    for declared in candidates:
        inside = _in_other_branches(declared[1], candidates)
        elsewhere = _alike(declared[1], _defined(walk, declared)) if inside else []
        elsewhere = [item for item in elsewhere if item not in candidates]
        if elsewhere:
            making = [item for item in (*elsewhere, *inside) if walk.relevance.makes(item[1], item[0])]
            whole = [*making[:1], *(item for item in (*candidates, *elsewhere) if item not in making[:1])]
            others = [item for item in making if item[0] is not making[0][0]]
            return whole, Location(others[0][0].path, others[0][1].line) if others else None
    return candidates, None


def _in_other_branches(declared: Function, candidates: list[Found]) -> list[Found]:
    """Of *candidates* the definitions of what is *declared* only, under other guards than it is."""
    if declared.body is not None or not declared.guards:
        return []
    return [
        item for item in _alike(declared, candidates) if item[1].body is not None and item[1].guards != declared.guards
    ]


def _alike(function: Function, found: list[Found]) -> list[Found]:
    requested = overloads.signature(function)
    return [item for item in found if overloads.signature(item[1]) == requested]


def _defined(walk: Walk, declared: Found) -> list[Found]:
    """The definitions with as many parameters of a C++ function that is declared only, nearest first."""
    source, function = declared
    if source.separator == ".":
        return []
    loose = _loose(walk, function.owner, function.name.rpartition("::")[2]) if function.owner else []
    bodies = [
        item
        for item in (*walk.index.functions.get(function.name, ()), *loose)
        if item[1].body is not None and len(item[1].parameters) == len(function.parameters)
    ]
    return overloads.nearest(walk, bodies, source)


def with_body(walk: Walk, candidates: list[Found]) -> Found:
    """The first that has a body, looked for under the same name in the files of the node if need be."""
    for item in candidates:
        if item[1].body is not None:
            return overloads.any_of(walk, item, candidates)
    found = _defined(walk, candidates[0])
    requested = overloads.signature(candidates[0][1])
    alike = [item for item in found if overloads.signature(item[1]) == requested] or found
    return overloads.any_of(walk, alike[0], alike) if alike else candidates[0]


def _loose(walk: Walk, owner: str, name: str) -> list[Found]:
    """The definitions of the method *name* of the class *owner* that name the class under a using-directive, or in full
    within its own namespace (``namespace a { void a::C::m() {} }``); not those of another class of that name."""
    return [
        item
        for item in walk.index.by_tail.get(f"{owner.rpartition('::')[2]}::{name}", ())
        if item[1].body is not None
        and item[1].owner
        and (f"::{owner}".endswith(f"::{item[1].owner}") or _is_in_full(item[1].owner, owner))
        and (item[1].owner == owner or not _is_class(walk, item))
    ]


def _is_class(walk: Walk, method: Found) -> bool:
    """Whether what a *method* is defined with is a class as it stands there."""
    classes = walk.index.classes.get(method[1].owner, ())
    return bool(classes) and walk.index.includes(method[0], classes)


def _is_in_full(written: str, owner: str) -> bool:
    """Whether *written* is the full name of *owner* behind that of a namespace around it."""
    space, sign, _ = written.partition(f"::{owner}")
    return bool(sign) and written == f"{space}::{owner}" and owner.startswith(f"{space}::")


def tail_method(walk: Walk, name: str, source: Source) -> Found | None:
    """``C::m`` where the class is known under a using-directive only."""
    tail = "::".join(name.split("::")[-2:])
    found = [
        item
        for item in walk.index.near(walk.index.by_tail, tail, source, walk.files)
        if f"::{item[1].name}".endswith(f"::{name}") or f"::{name}".endswith(f"::{item[1].name}")
    ]
    return overload(walk, found, None) if found else None
