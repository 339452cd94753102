# SPDX-License-Identifier: Apache-2.0
"""Names of Python that are bound somewhere in their scope, but never when the code runs that uses them: pylint and ruff take them for defined."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

from haros_ci.linters.bindings import CALLED, DEAD, DECLARED, HANDLED, LATER, UNCALLED, Names, Scope, Use
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex

#: What may bind any name of a module: then nothing is said of its names.
_MAKES = regex(r"\b(?:globals|vars|locals)\(\)[ \t]*[\[.]|(?<![\w.])exec(?:file)?[ \t]*\(|\bimport[ \t]*\(?[ \t]*\*")
#: Longer files are not looked at.
MAX_TEXT = 300_000
_LATE = regex(r"^from __future__ import [^\n]*\bannotations\b", re.M)
_OF_MODULES = frozenset({*dir(builtins), "__file__", "__path__", "__builtins__", "__annotations__"})
_DELETED = "it is deleted before"


class NeverBound(NamedTuple):
    """A *name* that has no value at *line*, where it is used, and *why*; the binding that it has is at *bound*."""

    name: str
    line: int
    why: str
    bound: int


def never_bound(text: str, is_called: Callable[[str], bool] = lambda name: True) -> Iterator[NeverBound]:
    """Each such name of a file, where it is used first; *is_called* tells of a function whether other files have its name."""
    if len(text) > MAX_TEXT or _MAKES.search(text) is not None:
        return
    every = nodes(text)
    if not every or not isinstance(every[0], ast.Module):
        return
    names = Names(every, is_late=_LATE.search(text) is not None, is_called=is_called)
    names.read(every[0])
    seen = set()
    for use in sorted(names.uses, key=lambda one: (one.line, one.name)):
        found = _judged(names, use)
        if found is not None and (found.name, found.why) not in seen:
            seen.add((found.name, found.why))
            yield found


def _judged(names: Names, use: Use) -> NeverBound | None:
    """Why the name has no value there; None if it may have one."""
    scope = _owner(names, use)
    if scope is None or scope.kind not in ("module", "function"):
        return None
    if scope is names.module and use.name in _OF_MODULES:
        return None
    first, last, whys = scope.summary(use.name)
    if not last:
        why = next((one for one in (UNCALLED, HANDLED, DEAD, DECLARED) if one in whys), DEAD)
        return None if whys == {DECLARED} and scope is names.module else NeverBound(use.name, use.line, why, first)
    if _is_at_once(use, scope) and use.line < scope.start(first):
        return NeverBound(use.name, use.line, LATER, first)
    if _is_called_before(names, use, scope, first):
        return NeverBound(use.name, use.line, CALLED, first)
    at = scope.deleted.get(use.name, 0)
    if last <= at and _is_behind(names, use, scope, at):
        return NeverBound(use.name, use.line, _DELETED, at)
    return None


def _is_at_once(use: Use, scope: Scope) -> bool:
    """Whether the use is run in the order of the lines of *scope*: no function or comprehension stands between."""
    inner: Scope | None = use.scope
    while inner is not None and inner is not scope and inner.kind == "class":
        inner = inner.parent
    return inner is scope


def _is_called_before(names: Names, use: Use, scope: Scope, first: int) -> bool:
    """Whether the function of *use* is defined in *scope*, uses the name whenever it runs, and is called there before the line *first*."""
    inner = use.scope
    if inner.parent is not scope or not inner.name or inner.start(use.line) not in inner.sure:
        return False
    if len(scope.bound.get(inner.name, ())) != 1:
        return False
    return any(
        call.scope is scope and inner.line < call.line and scope.start(call.line) < scope.start(first)
        for call in names.calls.get(inner.name, ())
    )


def _is_behind(names: Names, use: Use, scope: Scope, at: int) -> bool:
    """Whether the code of *use* runs after *at*, a line of *scope*: behind it, or in a function that nothing calls before."""
    inner: Scope | None = use.scope
    while inner is not None and inner.parent is not scope and inner is not scope:
        inner = inner.parent
    if inner is None or inner is scope or inner.kind != "function":
        return use.line > at
    if inner.line > at:
        return True
    return inner.name not in scope.deleted and names.first_uses.get(inner.name, at + 1) > at


def _owner(names: Names, use: Use) -> Scope | None:
    """The scope whose name that is, by the rules of Python; None for a built-in or unknown one."""
    scope: Scope | None = use.scope
    is_first = True
    while scope is not None:
        if use.name in scope.outer:
            return names.module if scope.outer[use.name] == "global" and use.name in names.module.bound else None
        if use.name in scope.bound and (scope.kind != "class" or is_first):
            return scope
        is_first = is_first and scope.kind == "comprehension"
        scope = scope.parent
    return None
