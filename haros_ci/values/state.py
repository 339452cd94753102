# SPDX-License-Identifier: Apache-2.0
"""The one mutable thing of link: what cells hold, with a log, so that branches are tried, undone and joined."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from haros_ci.records import dataclass
from haros_ci.values.abstract import NONE, Cell, Choice, Known, Object, Opaque, Partial, Value, join
from haros_ci.values.cells import Content, Slot

#: What ``join`` does not know: contents of sequences and maps.
CONTENTS = frozenset((tuple, dict, Partial))
#: What says by ``==`` whether it is the same.
PLAIN = frozenset((Known, Opaque))
#: Elements of a sequence on some paths that are kept; the latest count.
OTHERS = 16
#: Whole contents of sequences and maps are kept for each write to them: elements up to which that goes on.
MOST_KEPT = 6_000_000
#: What cells held (or hold), by cell.
Writes = dict[Slot, object]


#: ``join`` of what cells hold.
_join: Callable[[object, object], object] = join  # type: ignore[assignment]  # where it is no content, it is a value


@dataclass(frozen=True, slots=True)
class Held:
    """The value of a parameter that a ROS 2 node has declared or set; not *is_certain* if it has on some paths only."""

    value: Value
    is_certain: bool = True


class State:
    """Writes to cells, each with what it replaced."""

    def __init__(self) -> None:
        self._log: list[tuple[Slot, object]] = []
        self.last_mark = 0  #: the last point that somebody may come back to
        self._contents: dict[Slot, int] = {}  # where in the log a sequence or map was written last
        self._kept = 0  # elements of these in the log

    @property
    def is_full(self) -> bool:
        """Whether the log holds more contents of sequences and maps than a node may have."""
        return self._kept > MOST_KEPT

    def write(self, cell: Cell[Content], value: Content) -> None:
        self.put(cell, value)

    def put(self, cell: Slot, value: object) -> None:
        """Let a cell hold what it has held before, or a join with that: what stands for it in ``Writes``."""
        old = cell.value
        if old.__class__ is dict or old.__class__ is tuple:
            self._note(cell, old)
        else:
            self._log.append((cell, old))
        cell.value = value

    def forget(self, cell: Slot, reason: Opaque) -> None:
        """What a cell holds is not known any more; this can be said of each kind of cell."""
        self.put(cell, reason)

    def _note(self, cell: Slot, old: dict[object, object] | tuple[object, ...]) -> None:
        """A sequence or map was *old*: each write copies it, so that between two marks the first one alone is kept."""
        at = self._contents.get(cell, -1)
        if not (self.last_mark <= at < len(self._log) and self._log[at][0] is cell):
            self._contents[cell] = len(self._log)
            self._kept += len(old)
            self._log.append((cell, old))

    def mark(self) -> int:
        """A point to come back to."""
        self.last_mark = len(self._log)
        return self.last_mark

    def since(self, mark: int) -> Writes:
        """The cells written since *mark*, with what they hold now."""
        return {cell: cell.value for cell, _ in self._log[mark:]}

    def is_as_at(self, mark: int, begun: int) -> bool:
        """Whether all cells that were there before the tick *begun* hold what they held at *mark*."""
        first: Writes = {}
        for cell, old in self._log[mark:]:
            if cell.born <= begun:
                first.setdefault(cell, old)
        return all(_is_same(old, cell.value) for cell, old in first.items())

    def has_set(self, mark: int) -> bool:
        """Whether what was no object before *mark* is one now."""
        return any(
            old == NONE and cell.value.__class__ is Object for cell, old in self._log[mark:] if old.__class__ is Known
        )

    def undo(self, mark: int) -> Writes:
        """Go back to *mark*; what was written since is returned."""
        writes = self.since(mark)
        while len(self._log) > mark:
            cell, old = self._log.pop()
            cell.value = old
            if size := _size(old):
                self._kept -= size
                self._contents.pop(cell, None)
        self.last_mark = min(self.last_mark, mark)
        return writes

    def settle(self, mark: int, begun: int) -> None:
        """What cells that were made after the tick *begun* hold stays, whichever branch made them: it is not made again."""
        kept = [entry for entry in self._log[mark:] if entry[0].born <= begun]
        self._kept -= sum(_size(old) for cell, old in self._log[mark:] if cell.born > begun)
        self._log[mark:] = kept
        self.last_mark = min(self.last_mark, len(self._log))

    def merge(self, branches: list[Writes]) -> None:
        """Let each cell hold the join of what it holds after each branch; a branch that leaves it alone counts, too."""
        if len(branches) == 1:
            for cell, value in branches[0].items():
                self.put(cell, value)
            return
        first, *rest = branches
        for cell in dict.fromkeys(cell for branch in branches for cell in branch):
            held = cell.value
            value = first.get(cell, held)
            if value.__class__ is tuple or value.__class__ is Partial:
                value = _content(branches, cell)
            else:
                for branch in rest:
                    other = branch.get(cell, held)
                    if other is not value:
                        value = joined(value, other)
            self.put(cell, value)


def _size(old: object) -> int:
    """How many elements of a sequence or map the log keeps in one entry."""
    return len(old) if isinstance(old, (dict, tuple)) else 0


def _is_same(one: object, other: object) -> bool:
    """Whether two values are one, as far as that is plain."""
    if isinstance(one, Choice) and isinstance(other, Choice) and len(one.options) == len(other.options):
        return all(map(_is_same, one.options, other.options))
    is_plain = one.__class__ is other.__class__ and one.__class__ in PLAIN
    return one is other or (is_plain and one == other)


def _content(branches: list[Writes], cell: Slot) -> object:
    """The content of a sequence after one branch or another; where all have added an element, that is one or the other."""
    contents = [branch.get(cell, cell.value) for branch in branches]
    if all(content is contents[0] for content in contents):
        return contents[0]
    lists = _alike(contents)
    if lists:
        return tuple(_element(branches, cells) for cells in zip(*lists, strict=True))
    value = contents[0]
    for content in contents[1:]:
        value = joined(value, content)
    ends = [end for content in contents if (end := last(content)) is not None]
    if isinstance(value, Opaque) and len(ends) == len(contents) and not set(certain(value)) & set(ends):
        end = _element(branches, ends)
        return Partial(value.reason, value.location, value.type, (*certain(value), end), possible(value), end)
    return value


def _alike(contents: list[object]) -> list[tuple[Cell, ...]]:
    """*contents* where all are of one number of cells that are known; empty if they are not."""
    lists = [content for content in contents if isinstance(content, tuple)]
    return lists if len(lists) == len(contents) and len({len(cells) for cells in lists}) == 1 else []


def _element(branches: list[Writes], cells: Iterable[Cell]) -> Cell:
    """An element that is another cell after each branch: one that holds what any of these do."""
    every = tuple(cells)
    if all(cell is every[0] for cell in every):
        return every[0]
    value = branches[0].get(every[0], every[0].value)
    for branch, cell in zip(branches[1:], every[1:], strict=True):
        value = joined(value, branch.get(cell, cell.value))
    return Cell(value, every[0].type)  # type: ignore[arg-type]  # joined of what elements hold, which are values


def joined(one: object, other: object) -> object:
    """``join``, also for the contents of sequences and maps (element by element, where they have the same shape)."""
    if one is other:
        return one
    if one.__class__ not in CONTENTS and other.__class__ not in CONTENTS:
        return _join(one, other)
    if isinstance(one, tuple) and isinstance(other, tuple):
        if len(one) == len(other) and all(a is b for a, b in zip(one, other, strict=True)):
            return one
        return partial("the list has other elements on other paths", one, other)
    if isinstance(one, dict) and isinstance(other, dict):
        if one.keys() == other.keys() and all(one[k] is other[k] for k in one):
            return one
        if not any(isinstance(value, Cell) for value in (*one.values(), *other.values())):
            missing = Opaque("it is set on some paths only")
            return {k: _entry(one.get(k, missing), other.get(k, missing)) for k in {**one, **other}}
        return Opaque("the map has other entries on other paths")
    if isinstance(one, (tuple, dict)) or isinstance(other, (tuple, dict)):
        return partial("its elements are not known on every path", one, other)
    if isinstance(one, Partial) or isinstance(other, Partial):
        reasons = [content.reason for content in (one, other) if isinstance(content, Opaque)]
        return partial(reasons[0], one, other)
    return _join(one, other)


def _entry(one: object, other: object) -> object:
    """What is held under one key: of what a ROS 2 node declares, the value stays known where only one way has it."""
    both = [value for value in (one, other) if isinstance(value, Held)]
    if not both:
        return _join(one, other)
    result = [held for held in both if held.value != NONE]
    if len(result) < 2:
        return Held(result[0].value, False) if result else both[0]
    return Held(join(result[0].value, result[1].value), result[0].is_certain and result[1].is_certain)


def certain(content: object) -> tuple[Cell, ...]:
    """The elements that a sequence of that content has for sure."""
    return content if isinstance(content, tuple) else content.some if isinstance(content, Partial) else ()


def possible(content: object) -> tuple[Cell, ...]:
    """Elements that a sequence of that content has on some paths."""
    return content.others if isinstance(content, Partial) else ()


def last(content: object) -> Cell | None:
    """The last element of a sequence of that content, as far as that is known."""
    if isinstance(content, tuple):
        return content[-1] if content else None
    return content.last if isinstance(content, Partial) else None


def partial(reason: str, one: object, other: object) -> Opaque:
    """The content of a sequence that has one or the other: what both have is in it, what one has may be."""
    first, second = certain(one), certain(other)
    some = tuple(cell for cell in first if any(cell is other_cell for other_cell in second))
    rest = dict.fromkeys((*first, *possible(one), *second, *possible(other)))
    others = tuple(cell for cell in rest if isinstance(cell, Cell) and cell not in some)[-OTHERS:]
    return Partial(reason, some=some, others=others) if some or others else Opaque(reason)
