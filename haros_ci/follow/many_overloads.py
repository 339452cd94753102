# SPDX-License-Identifier: Apache-2.0
"""A call of a function that has very many overloads: comparing its arguments with all of them takes time of their number's square."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow.overloads import MOST, Found
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location


def one_of(walk: Walk, candidates: list[Found]) -> Found:
    """What stands for a function of which there are more overloads than are compared: nothing is known of what it does."""
    source, function = candidates[0]
    if any(walk.relevance.makes(one, where) for where, one in candidates[:MOST]):
        reason = f"{function.name} has more overloads than are compared with the arguments of a call"
        walk.gaps.setdefault(reason, Location(source.path, function.line))
    key = ("one of many", id(function))
    if key not in walk.found:
        body = (syntax.Return(syntax.Unknown("which overload is called is not known")),)
        walk.found[key] = syntax.replace(function, body=body)
    return source, walk.found[key]
