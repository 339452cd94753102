# SPDX-License-Identifier: Apache-2.0
"""Python's tables of functions: dictionaries in which what is called, or made, stands under a key."""

from __future__ import annotations

from haros_ci.follow import callbacks, methods
from haros_ci.follow.libraries import python_modules
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.values.abstract import Callable, ClassValue, Mapped, Object, Value, join

#: What a table holds: functions, classes, and objects whose methods are called.
HELD = (Callable, ClassValue, Object)


def entry(table: Value, default: Value | None = None) -> Value | None:
    """What stands under a key that is not known: any of the entries, as a key that is not there is an error.

    None for all that is not a table, whole and known. *default* is what ``get`` gives for other keys.
    """
    cells = table.content.value if isinstance(table, Mapped) else None
    if not isinstance(cells, dict) or not all(isinstance(cell.value, HELD) for cell in cells.values()):
        return None
    result: Value | None = default
    for cell in cells.values():
        result = cell.value if result is None else join(result, cell.value)
    return result if cells else None


def kept(walk: Walk, table: Value, value: Value) -> None:
    """*value* is kept in *table* under a key that is not known, which hides what stands there: it may all be called."""
    cells = table.content.value if isinstance(table, Mapped) else None
    for callable_ in (*(cell.value for cell in cells.values()), value) if isinstance(cells, dict) else (value,):
        if isinstance(callable_, Callable):
            callbacks.register(walk, callable_)
        elif isinstance(callable_, ClassValue) and walk.relevance.named(callable_.definition.name):
            message = (
                f"class {callable_.definition.name} is kept under a key that is not known: who makes it is not seen"
            )
            walk.gaps.setdefault(message, Location(callable_.source.path, callable_.definition.line))


def subclasses(walk: Walk, base: ClassValue) -> list[ClassValue]:
    """``Base.__subclasses__()``: the classes of what is imported that name *base* as their base, by file and line."""
    files = python_modules.imported(walk, [base.source, *(frame.source for frame in walk.modules.values())])
    found = [
        (source, definition)
        for classes in walk.index.classes.values()
        for source, definition in classes
        if source.path in files and source.separator == "."
    ]
    return [
        ClassValue(source, definition)
        for source, definition in sorted(found, key=lambda item: (item[0].path, item[1].line))
        if any(
            owner is not None and owner[1] is base.definition
            for owner in (methods.python_class(walk, type_, source) for type_ in definition.bases)
        )
    ]
