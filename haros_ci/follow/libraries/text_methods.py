# SPDX-License-Identifier: Apache-2.0
"""Methods of std::string that search or change a text by positions (en.cppreference.com/w/cpp/string/basic_string)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import conversions
from haros_ci.follow.libraries import texts
from haros_ci.values.abstract import TEXT_LIMIT, Character, Known, Object, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.syntax import Expression

#: Searches for one of several characters: whether from the end, whether for one that is none of them.
OF = {
    "find_first_of": (False, False),
    "find_first_not_of": (False, True),
    "find_last_of": (True, False),
    "find_last_not_of": (True, True),
}


def changed(text: str, name: str, args: tuple[PassedArgument, ...]) -> str | None:
    """*text* after ``erase``, ``insert``, ``replace`` or ``resize`` with positions; None for all other forms."""
    data = [argument.value.value if isinstance(argument.value, Known) else None for argument in args]
    if not all(_is_count(item) or isinstance(item, (str, Character)) for item in data):
        return None
    counts = [item for item in data if isinstance(item, int) and _is_count(item)]
    start = counts[0] if counts else 0
    if start > len(text) or (data and not _is_count(data[0])):
        return None
    end = start + counts[1] if len(counts) > 1 else len(text)
    if name == "erase" and len(counts) == len(data) <= 2:
        return text[:start] + text[end:]
    if name == "insert" and len(data) == 2 and isinstance(data[1], str):
        return text[:start] + data[1] + text[start:]
    if name == "replace" and len(data) == 3 and len(counts) == 2 and isinstance(data[2], str):
        return text[:start] + data[2] + text[end:]
    if name == "resize" and len(data) == len(counts) == 1:
        return text[:start]
    return None


def found(text: str, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """Where a text or character is, or one of several characters: from a position on, if one is given; None if not known."""
    data = [argument.value.value if isinstance(argument.value, Known) else None for argument in args]
    if not 1 <= len(data) <= 2 or not isinstance(data[0], (str, Character)):
        return None
    expected = chr(data[0]) if isinstance(data[0], Character) else data[0]
    place = data[1] if len(data) > 1 else None
    if len(data) > 1 and not _is_count(place):
        return None
    begin = place if isinstance(place, int) else None
    if name in OF:
        is_last, is_other = OF[name]
        places = [number for number, item in enumerate(text) if (item in expected) != is_other]
        if begin is not None:
            places = [number for number in places if (number <= begin if is_last else number >= begin)]
        return Known((places[-1] if is_last else places[0]) if places else conversions.NPOS)
    if name not in ("find", "rfind"):
        return None
    if name == "find":
        at = text.find(expected, begin or 0)
    else:
        at = text.rfind(expected, 0, begin + len(expected) if begin is not None else len(text))
    return Known(conversions.NPOS if at < 0 else at)


def end_of(expression: Expression, iterator: Value) -> Value | None:
    """``*text.begin()`` or ``*text.rbegin()``: the first or last character, where the text is known."""
    if (
        not isinstance(iterator, Object)
        or type(expression) is not syntax.Call
        or type(expression.callee) is not syntax.Member
    ):
        return None
    name = expression.callee.name
    of = iterator.fields["[of]"].value if "[of]" in iterator.fields else None
    held = of.cell.value if isinstance(of, Pointer) else None
    if not isinstance(held, Known) or not issubclass(held.kind, str) or not held.value:
        return None
    if name not in ("begin", "cbegin", "rbegin", "crbegin"):
        return None
    return texts.number(Known(held.of(str)[-1 if "r" in name else 0]))


def _is_count(item: object) -> bool:
    return isinstance(item, int) and type(item) is int and (0 <= item <= TEXT_LIMIT or item == conversions.NPOS)
