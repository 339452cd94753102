# SPDX-License-Identifier: Apache-2.0
"""Where the time of a command goes (``--timings``): each moment belongs to one stage, so that the stages add up to the whole.

A stage that begins within another interrupts it. Processes that are waited for count to the stage that waits, and what threads beside
the first one do to the stage that the first one is in.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from functools import wraps
from threading import get_ident
from typing import NamedTuple, ParamSpec, TypeVar

from haros_ci.records import dataclass, field

P = ParamSpec("P")
T = TypeVar("T")
#: What is in no stage.
OTHER = "other"
#: So many parts of a stage are listed, unless all are.
DEAREST = 10
#: Stages of which every part is listed.
IN_FULL = frozenset(("linters",))


class Spent(NamedTuple):
    """Seconds by the clock on the wall, and of processors."""

    wall: float
    cpu: float

    def plus(self, other: Spent) -> Spent:
        """Both together."""
        return Spent(self.wall + other.wall, self.cpu + other.cpu)

    def less(self, other: Spent) -> Spent:
        """What is left without *other*."""
        return Spent(self.wall - other.wall, self.cpu - other.cpu)


NOTHING = Spent(0.0, 0.0)


def now() -> Spent:
    """Seconds since some moment: on the wall, and of this process with the ended processes that it started."""
    try:
        from resource import RUSAGE_CHILDREN, getrusage
    except ImportError:
        return Spent(time.perf_counter(), time.process_time())
    children = getrusage(RUSAGE_CHILDREN)
    return Spent(time.perf_counter(), time.process_time() + children.ru_utime + children.ru_stime)


@dataclass(slots=True)
class Clock:
    """What each stage, and each part of one, has taken until the last change from one to another."""

    now: Callable[[], Spent] = now
    spent: dict[str, dict[str, Spent]] = field(default_factory=dict)
    #: Of parts that run side by side: how long each was busy, which says what it has of its stage, and its processor time.
    busy: dict[str, dict[str, Spent]] = field(default_factory=dict)
    #: What else there is to say at the end.
    remarks: dict[str, None] = field(default_factory=dict)
    thread: int = field(default_factory=get_ident)
    _open: list[tuple[str, str, bool]] = field(default_factory=lambda: [(OTHER, "", False)])
    _since: Spent = NOTHING

    def __post_init__(self) -> None:
        self._since = self.now()

    @contextmanager
    def stage(self, name: str, part: str, whole: bool) -> Iterator[None]:
        """As ``stage`` below."""
        if self._open[-1][2]:
            yield
            return
        self.spent.setdefault(name, {})
        self.charge()
        self._open.append((name, part, whole))
        try:
            yield
        finally:
            self.charge()
            self._open.pop()

    def charge(self) -> None:
        """Give the time since the last change to the stage that is open."""
        current = self.now()
        name, part, _ = self._open[-1]
        parts = self.spent.setdefault(name, {})
        parts[part] = parts.get(part, NOTHING).plus(current.less(self._since))
        self._since = current

    def total(self) -> Spent:
        """All stages together, which is all the time until the last change."""
        return _sum(part for parts in self.spent.values() for part in parts.values())

    def lines(self) -> Iterator[str]:
        """The table: stages in the order in which they began, the dearest parts of each below it, and the sum."""
        self.charge()
        yield "  wall s    CPU s  stage"
        stages = [*(name for name in self.spent if name != OTHER), OTHER]
        for name in stages:
            whole = _sum(self.spent[name].values())
            yield _line(whole, name)
            parts = {part: spent for part, spent in self.parts(name).items() if part}
            dear = sorted(parts, key=lambda part: (-parts[part].wall, part))
            shown = dear if name in IN_FULL else dear[:DEAREST]
            yield from (_line(parts[part], f"  {part}") for part in shown)
            if len(shown) < len(dear):
                rest = whole.less(_sum(parts[part] for part in shown))
                yield _line(rest, f"  the other {len(dear) - len(shown)}, and what is of none")
        yield _line(self.total(), "; ".join(("done", *self.remarks)))

    def parts(self, name: str) -> Mapping[str, Spent]:
        """The parts of a stage; those that run side by side share its time on the wall by how long each was busy."""
        busy = self.busy.get(name)
        if not busy:
            return self.spent[name]
        whole = _sum(self.spent[name].values()).wall
        every = _sum(busy.values()).wall
        return {part: Spent(whole * spent.wall / every if every else 0.0, spent.cpu) for part, spent in busy.items()}


_running: Clock | None = None


def _here() -> Clock | None:
    """The clock that runs in this thread."""
    return _running if _running is not None and _running.thread == get_ident() else None


@contextmanager
def running(clock: Clock | None) -> Iterator[None]:
    """*clock* runs in here, in place of any other; none does where it is None."""
    global _running
    before, _running = _running, clock
    try:
        yield
    finally:
        _running = before


def stage(name: str, part: str = "", *, whole: bool = False) -> AbstractContextManager[None]:
    """What is done in here belongs to stage *name*, and to this *part* of it.

    Of a *whole* one stages that begin within it are part, too.
    """
    clock = _here()
    return nullcontext() if clock is None else clock.stage(name, part, whole)


def timed(name: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Each call of the function is in stage *name*."""

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        @wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> T:
            if _running is None:
                return function(*args, **kwargs)
            with stage(name):
                return function(*args, **kwargs)

        return call

    return decorate


def side_by_side(name: str, part: str, spent: Spent) -> None:
    """A *part* of stage *name* was busy for so long, while others were."""
    if (clock := _here()) is not None:
        parts = clock.busy.setdefault(name, {})
        parts[part] = parts.get(part, NOTHING).plus(spent)


def remark(sentence: str) -> None:
    """Tell this in the last line."""
    if (clock := _here()) is not None:
        clock.remarks[sentence] = None


def _sum(spent: Iterable[Spent]) -> Spent:
    whole = NOTHING
    for item in spent:
        whole = whole.plus(item)
    return whole


def _line(spent: Spent, what: str) -> str:
    return f"{spent.wall:8.3f} {spent.cpu:8.3f}  {what}"
