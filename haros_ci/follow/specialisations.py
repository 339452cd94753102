# SPDX-License-Identifier: Apache-2.0
"""Specialisations of templates (en.cppreference.com/w/cpp/language/template_specialization).

Which full one of a template of functions a call means; and where a class template is meant itself, as none of its specialisations fits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.overloads import Found, plain, signature
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Type
from haros_ci.values.abstract import Callable, Opaque

#: Types inside types that are compared.
DEPTH = 4

#: Why a call of a template is not followed.
NOT_SEEN = "{} has specialisations, of which none is for the template arguments of a call"


#: What is said of a class template whose specialisations cannot be distinguished.
OF_CLASS = "the class template {} has specialisations, and which one is meant is not followed"


def of_class(
    walk: Walk, owner: tuple[Source, Class], targs: Sequence[syntax.Argument], location: Location
) -> tuple[Source, Class] | None:
    """The class template itself, for template arguments that fit none of its specialisations, or a class that has none; else None.

    What a specialisation makes is not followed: its methods have the names of the template's.
    """
    source, definition = owner
    if source.separator == ".":
        return owner
    every = walk.index.near(walk.index.classes, definition.name, source, walk.files)
    written = [item for item in every if item[1].specialises]
    if not written:
        return owner
    primary = next((item for item in every if not item[1].specialises), None)
    if primary is None or not targs or any(_fits(walk, item, targs) for item in written):
        if any(_makes(walk, where, definition.name) for where in dict.fromkeys(item[0] for item in every)):
            walk.gaps.setdefault(OF_CLASS.format(definition.name), location)
        return None
    return primary


def hides(walk: Walk, frame: Frame, name: str, found: Sequence[Found]) -> Opaque | None:
    """What a name such as ``C<T>::f`` means that is written outside of the class template C: not known where C has specialisations."""
    owner = found[0][1].owner
    if "::" not in name or not are_several(walk, frame, owner):
        return None
    reason = OF_CLASS.format(owner)
    if any(walk.relevance.makes(function, source) for source, function in found):
        walk.gaps.setdefault(reason, Location(frame.source.path, frame.function.line if frame.function else None))
    return walk.opaque(reason, frame)


def are_several(walk: Walk, frame: Frame, owner: str) -> bool:
    """Whether a class template that is named outside of itself has specialisations."""
    if not owner or frame.source.separator == "." or frame.scope == owner or frame.scope.startswith(f"{owner}::"):
        return False
    return any(item[1].specialises for item in walk.index.near(walk.index.classes, owner, frame.source, walk.files))


def _makes(walk: Walk, source: Source, owner: str) -> bool:
    """Whether a method of a class that stands in the file of the class may make something."""
    return any(
        function.owner == owner and walk.relevance.makes(function, source) for function in source.program.functions
    )


def _fits(walk: Walk, item: tuple[Source, Class], targs: Sequence[syntax.Argument]) -> bool:
    """Whether a specialisation may be for these template arguments."""
    source, definition = item
    scope = definition.name.rpartition("::")[0]
    written = [
        walk.resolved(one, scope, source, {}) if isinstance(one, Type) else one for one in definition.specialises
    ]
    return len(written) != len(targs) or all(
        _may_be(one, other, definition.templates) for one, other in zip(written, targs, strict=True)
    )


def _may_be(written: object, given: object, templates: tuple[str, ...], depth: int = 0) -> bool:
    """Whether a template argument may be what is written in a specialisation, with the *templates* of that for anything."""
    if isinstance(written, (Type, syntax.Name)) and written.name in templates:
        return True
    if not isinstance(written, Type) or not isinstance(given, Type) or depth > DEPTH:
        return written == given or not isinstance(written, type(given))
    if last_part(written.name) != last_part(given.name) or written.marks != given.marks:
        return False
    return len(written.arguments) != len(given.arguments) or all(
        _may_be(one, other, templates, depth + 1) for one, other in zip(written.arguments, given.arguments, strict=True)
    )


def last_part(name: str) -> str:
    """The name without its scopes."""
    return name.rpartition("::")[2]


def specialised(walk: Walk, frame: Frame, function: Callable, targs: Sequence[syntax.Argument]) -> Callable | None:
    """The specialisation of *function* for the template arguments of a call; None where it has none that is certain.

    Where there are specialisations, none is for these arguments, and the template itself has no body, it is *function* without one.
    """
    definition = function.function
    if not targs or not definition.name or function.source.separator == "." or function.frame is not None:
        return None
    candidates = walk.index.near(walk.index.functions, definition.name, function.source, walk.files)
    if len(candidates) < 2:
        return None
    found = _meant(walk, frame, candidates, targs)
    return None if found is None else replace(function, source=found[0], function=found[1])


def is_missing(specialised: Callable | None) -> bool:
    """Whether no body is seen of what a call means (``specialised``)."""
    return specialised is not None and specialised.function.body is None


def _meant(walk: Walk, frame: Frame, candidates: Sequence[Found], targs: Sequence[syntax.Argument]) -> Found | None:
    """The one of *candidates* that is for the template arguments of a call, as is written behind its name, or as it returns the first of them or something of it.

    Functions with the same parameters that return other types are no overloads of one another, which C++ forbids, so they are specialisations.
    Else it is the template itself, where that is certain.
    """
    if not isinstance(targs[0], Type):
        return None
    bodies = [item for item in candidates if item[1].body is not None and not item[1].templates]
    first = plain(walk.type_in(targs[0], frame))
    sought = [first, *(plain(walk.type_in(item, frame)) if isinstance(item, Type) else item for item in targs[1:])]
    written = [item for item in bodies if item[1].specialises]
    exact = [item for item in written if _arguments(walk, item)[: len(sought)] == sought]
    if exact:
        return exact[0]
    if len({signature(item[1]) for item in bodies}) > 1:
        return None
    returned = {plain(item[1].returns) for item in bodies}
    if len(bodies) >= 2 and len(returned) == len(bodies):
        fitting = [item for item in bodies if first in (plain(kind) for kind in _parts(item[1].returns))]
        if len(fitting) == 1:
            return fitting[0]
    elif not written or len(written) < len(bodies):
        return None
    return _primary(candidates, signature(bodies[0][1]))


def _primary(candidates: Sequence[Found], parameters: object) -> Found | None:
    """The template that is specialised; its declaration where it has no body."""
    found = [item for item in candidates if item[1].templates and signature(item[1]) == parameters]
    return next((item for item in found if item[1].body is not None), found[0] if found else None)


def _arguments(walk: Walk, found: Found) -> list[object]:
    """The template arguments of which a function is written to be a specialisation; values as they are written."""
    source, function = found
    scope = function.name.rpartition("::")[0]
    return [
        plain(walk.resolved(item, scope, source, {})) if isinstance(item, Type) else item
        for item in function.specialises
    ]


def _parts(kind: Type, depth: int = 0) -> list[Type]:
    """A type, and the arguments of its templates."""
    inner = [
        part for item in kind.arguments if isinstance(item, Type) and depth < 4 for part in _parts(item, depth + 1)
    ]
    return [kind, *inner]
