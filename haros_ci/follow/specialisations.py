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


def specialised(walk: Walk, frame: Frame, function: Callable, targs: Sequence[syntax.Argument]) -> Callable | None:
    """The specialisation of *function* for the template arguments of a call; None where it has none that is certain."""
    definition = function.function
    if not targs or not definition.name or function.source.separator == "." or function.frame is not None:
        return None
    found = _meant(
        walk, frame, walk.index.near(walk.index.functions, definition.name, function.source, walk.files), targs
    )
    return None if found is None else replace(function, source=found[0], function=found[1])


def _meant(walk: Walk, frame: Frame, candidates: Sequence[Found], targs: Sequence[syntax.Argument]) -> Found | None:
    """The one of *candidates* that returns the first template argument of the call, or something of it; None where that is not one alone.

    Functions with the same parameters that return other types are no overloads of one another, which C++ forbids, so they are specialisations.
    """
    found = [item for item in candidates if item[1].body is not None and not item[1].templates]
    returned = {plain(item[1].returns) for item in found}
    if len(found) < 2 or len(returned) < len(found) or len({signature(item[1]) for item in found}) > 1:
        return None
    if not isinstance(targs[0], Type):
        return None
    sought = plain(walk.type_in(targs[0], frame))
    fitting = [item for item in found if sought in (plain(kind) for kind in _parts(item[1].returns))]
    return fitting[0] if len(fitting) == 1 else None


def _parts(kind: Type, depth: int = 0) -> list[Type]:
    """A type, and the arguments of its templates."""
    inner = [
        part for item in kind.arguments if isinstance(item, Type) and depth < 4 for part in _parts(item, depth + 1)
    ]
    return [kind, *inner]
