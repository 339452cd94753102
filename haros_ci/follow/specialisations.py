# SPDX-License-Identifier: Apache-2.0
"""Which full specialisation of a template of functions a call means (en.cppreference.com/w/cpp/language/template_specialization)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.overloads import Found, plain, signature
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Type
from haros_ci.values.abstract import Callable

#: Why a call of a template is not followed.
NOT_SEEN = "{} has specialisations, of which none is for the template arguments of a call"


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
