# SPDX-License-Identifier: Apache-2.0
"""Macros without parameters as values: what their definitions stand for, or the one that counts."""

from __future__ import annotations

from haros_ci.follow import expressions
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index import compiled
from haros_ci.index import macros as macros_
from haros_ci.records import dataclass
from haros_ci.syntax import Expression
from haros_ci.values.abstract import Value, join

#: Macros that are expanded for one that stands in the code: of several that have several definitions each, all would be met with all.
MOST = 200
_NUMBER = ("expanded",)


@dataclass(frozen=True, slots=True)
class ObjectMacro:
    """An object-like macro: what its definitions stand for."""

    bodies: tuple[Expression, ...]


def expanded(walk: Walk, frame: Frame, macro: ObjectMacro, name: str) -> Value:
    """A macro's value where it stands; names in it mean there what they mean."""
    looking = ("expanding", frame.source.path, name)
    if looking in walk.found:
        return walk.opaque(f"the macro {name} is defined by itself", frame)
    number = walk.found.get(_NUMBER, 0)
    if number >= MOST:
        return walk.opaque(f"the macro {name} stands for too many others", frame)
    walk.found[_NUMBER] = number + 1
    walk.found[looking] = True
    try:
        values = [expressions.evaluate(walk, frame, body) for body in macro.bodies]
    finally:
        del walk.found[looking]
        if not number:
            del walk.found[_NUMBER]
    value = values[0]
    for other in values[1:]:
        value = join(value, other)
    return value


def meant(walk: Walk, frame: Frame, name: str) -> Value | ObjectMacro | None:
    """The macro of that name, as far as the build does not define it otherwise; None if there is none."""
    index = walk.index
    macros = index.near(index.macros, name, frame.source, walk.files)
    if not macros:
        return None
    text = compiled.value_of(index, name, frame.source.path, walk.files, walk.target)
    if text is not None:
        return ObjectMacro((macros_.expression(text),))
    packages = {frame.source.package, *(source.package for source, _ in macros)}
    if any(name in index.defined.get(package, ()) for package in packages):
        return walk.opaque(f"the build defines {name}", frame)
    return ObjectMacro(tuple(macros_.expression(body) for body in dict.fromkeys(body for _, body in macros)))
