# SPDX-License-Identifier: Apache-2.0
"""Cells: variables, members, elements, and what holds the elements of a sequence or the entries of a map."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Generic, TypeVar

from haros_ci.syntax import Type

#: What a cell holds: a ``Value`` where nothing else is said (a default as of PEP 696, which Python itself has from 3.13 on).
if TYPE_CHECKING:
    from typing_extensions import TypeVar as TypeVar_

    from haros_ci.values.abstract import Value

    Content = TypeVar_("Content", default=Value)
else:
    Content = TypeVar("Content")

#: Counts the cells.
tick = count().__next__


class Slot:
    """A cell, whatever it holds: this is how ``State`` sees it, which writes and joins any."""

    __slots__ = ("born", "type", "value")
    born: int
    type: Type | None
    value: object


class Cell(Slot, Generic[Content]):
    """A variable, member or element: it holds a Value, and may have a declared type.

    The content of a sequence or map is a cell, too: of a tuple of cells, of a dict (``Elements``, ``Entries``). Written through
    ``State.write`` only. *born* is less than that of every cell that is made later.
    """

    __slots__ = ()
    value: Content

    def __init__(self, value: Content, type: Type | None = None) -> None:  # noqa: A002 - the field is called so
        self.value = value
        self.type = type
        self.born = tick()

    def __repr__(self) -> str:
        return f"Cell({self.value!r}, {self.type!r})"


class Named:
    """What the rooms above know an object by, such as a node of a process: their classes derive from it."""

    __slots__ = ()


class Closure:
    """The variables around a lambda; ``follow.frames`` has the class that derives from it."""

    __slots__ = ()
