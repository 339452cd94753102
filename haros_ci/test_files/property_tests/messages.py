# SPDX-License-Identifier: Apache-2.0
"""Messages as dicts, drawn by Hypothesis. What a predicate compares with, and what lies beside it, is drawn often."""

from __future__ import annotations

import copy
import math
import struct
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

from hypothesis import strategies as st

Strategy = Any
if TYPE_CHECKING:  # Python 3.8 does not evaluate these
    Message = dict[str, Any]
    #: The way to a value: names of fields, indices of arrays; ``LENGTH`` at its end is the number of items.
    Path = tuple[Union[str, int], ...]

LENGTH = "len()"
#: Items of an array without a size, and characters of a text.
MOST_ITEMS, MOST_CHARACTERS = 4, 8
#: Fixed arrays with more items get the same value in all of them.
MOST_APART = 8


def whole(low: int, high: int, near: Sequence[float] = ()) -> Strategy:
    """Whole numbers from *low* to *high*; often these, 0, and those *near* which a predicate changes."""
    beside = {number + step for number in map(math.floor, filter(math.isfinite, near)) for step in (-1, 0, 1)}
    special = _nearest_zero({low, high, 0, *beside}, low, high)
    return st.integers(low, high) | st.sampled_from(special) if special else st.integers(low, high)


def floats(
    low: float = -math.inf,
    high: float = math.inf,
    near: Sequence[float] = (),
    *,
    bits: int = 64,
    open_low: bool = False,
    open_high: bool = False,
    finite: bool = True,
) -> Strategy:
    """Floating point numbers of 32 or 64 *bits*; often the ends, 0, those *near* and their neighbours. Without *finite* also infinities."""
    low, high = _inside(low, high, bits, open_low, open_high)
    if low > high:
        return st.nothing()
    beside = [value for number in near for value in neighbours(number, bits)]
    ends = [end for end in (low, high) if math.isfinite(end)]
    special = _nearest_zero({0.0, *ends, *beside}, low, high)
    infinite = not finite and (math.isinf(low) or math.isinf(high))
    bounds = {
        "min_value": None if math.isinf(low) else low,
        "max_value": None if math.isinf(high) else high,
    }
    drawn = st.floats(allow_nan=False, allow_infinity=infinite, width=bits, **bounds)
    return drawn | st.sampled_from(special) if special else drawn


def _inside(low: float, high: float, bits: int, open_low: bool, open_high: bool) -> tuple[float, float]:
    """The least and the greatest number of that many bits between the ends."""
    least, greatest = rounded(low, bits), rounded(high, bits)
    if least < low or (open_low and least == low):
        least = beyond(least, 1, bits)
    if greatest > high or (open_high and greatest == high):
        greatest = beyond(greatest, -1, bits)
    return least, greatest


def neighbours(number: float, bits: int = 64) -> list[float]:
    """*number* and those next to it, below and above."""
    middle = rounded(number, bits)
    return [beyond(middle, -1, bits), middle, beyond(middle, 1, bits)]


def rounded(number: float, bits: int) -> float:
    """The nearest number of that many bits; infinity where it is too great."""
    if bits == 64 or not math.isfinite(number):
        return float(number)
    try:
        return float(struct.unpack("<f", struct.pack("<f", number))[0])
    except OverflowError:
        return math.copysign(math.inf, number)


def beyond(number: float, direction: int, bits: int) -> float:
    """The next number above (*direction* 1) or below (-1): ``math.nextafter`` for both widths, and for Python before 3.9."""
    if math.isinf(number) or math.isnan(number):
        return number
    code, kind = ("<f", "<i") if bits == 32 else ("<d", "<q")
    if number == 0:
        smallest: float = struct.unpack(code, struct.pack(kind, 1))[0]
        return math.copysign(smallest, direction)
    raw = struct.unpack(kind, struct.pack(code, number))[0]
    step = 1 if (number > 0) is (direction > 0) else -1
    return float(struct.unpack(code, struct.pack(kind, raw + step))[0])


def _nearest_zero(values: Any, low: float, high: float) -> list[Any]:
    """Those between the ends, the simplest ones first: Hypothesis shrinks to them."""
    return sorted((value for value in values if low <= value <= high), key=lambda value: (abs(value), value < 0))


def non_finite() -> Strategy:
    """What ``--non-finite`` adds to floating point numbers."""
    return st.sampled_from([math.inf, -math.inf, math.nan])


def texts(near: Sequence[str] = (), most: int = MOST_CHARACTERS) -> Strategy:
    """Short texts of printable ASCII; often those *near*."""
    drawn = st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=min(most, MOST_CHARACTERS))
    return drawn | st.sampled_from(sorted(set(near))) if near else drawn


def times(unsigned: bool = True) -> Strategy:
    """Times and durations of ROS 1."""
    seconds = st.integers(0, 2**31 - 1) if unsigned else st.integers(-(2**31), 2**31 - 1)
    return st.fixed_dictionaries({"secs": seconds, "nsecs": st.integers(0, 999_999_999)})


def array(item: Strategy, least: int = 0, most: int = MOST_ITEMS) -> Strategy:
    """Arrays of *least* to *most* items; long fixed ones have one value in all items."""
    if least == most and most > MOST_APART:
        return item.map(lambda value: [copy.deepcopy(value) for _ in range(most)])
    return st.lists(item, min_size=least, max_size=most)


def message(fields: Mapping[str, Strategy]) -> Strategy:
    """Messages with these fields."""
    return st.fixed_dictionaries(dict(fields))


#: A time that is not set, of ROS 1 and of ROS 2.
NO_TIMES: tuple[Message, ...] = ({"secs": 0, "nsecs": 0}, {"sec": 0, "nanosec": 0})


def stamped(made: Any, now: int) -> Any:
    """*made* with *now*, in nanoseconds, for every ``stamp`` that is not set."""
    if isinstance(made, list):
        return [stamped(item, now) for item in made]
    if not isinstance(made, dict):
        return made
    seconds, rest = divmod(now, 1_000_000_000)
    return {
        name: dict(zip(value, (seconds, rest))) if name == "stamp" and value in NO_TIMES else stamped(value, now)
        for name, value in made.items()
    }


def no(predicate: Callable[[Any], bool]) -> Callable[[Any], bool]:
    """Whether *predicate* does not hold."""
    return lambda made: not predicate(made)


def having(base: Strategy, values: Mapping[Path, Strategy]) -> Strategy:
    """Messages of *base* that have these values."""

    def drawn(draw: Callable[[Strategy], Any]) -> Any:
        made = copy.deepcopy(draw(base))
        for path, strategy in values.items():
            put(made, path, draw(strategy))
        return made

    return st.composite(drawn)()


def put(made: Any, path: Path, value: Any) -> None:
    """Set what *path* leads to; an array that is too short grows by copies of its last item."""
    for name in path[:-1]:
        made = _item(made, name) if isinstance(name, int) else made[name]
    last = path[-1]
    if last == LENGTH:
        _resize(made, max(int(value), 0))
    elif isinstance(last, int):
        _item(made, last)
        made[last] = value
    else:
        made[last] = value


def _item(made: list[Any], index: int) -> Any:
    if len(made) <= index:
        _resize(made, index + 1)
    return made[index]


def _resize(made: list[Any], size: int) -> None:
    del made[size:]
    filler = made[-1] if made else 0
    made.extend(copy.deepcopy(filler) for _ in range(size - len(made)))
