# SPDX-License-Identifier: Apache-2.0
"""Python's methods of texts, and ``re.sub`` with a set of characters, on a text of which a part is not known: what is sure of the rest.

docs.python.org/3/library/stdtypes.html#string-methods, re.html. What a method may take from a known part, or join with what is not
known beside it, counts as not known.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable
from typing import TYPE_CHECKING

from haros_ci.follow.libraries import own_files
from haros_ci.regex import regex
from haros_ci.values.abstract import (
    TEXT_LIMIT,
    Cell,
    Choice,
    Known,
    Opaque,
    Partial,
    Sequence,
    Text,
    Value,
    concatenate,
    join,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Parts of a text: known and not known.
Parts = tuple[str | Opaque, ...]
#: Patterns that match one character, or a run of such: a set without nested ones or differences, an escape for a kind, a plain letter.
_SET = regex(
    r"(?:\[\^?(?:[\w/ .,:;@#%!?=*()^$+{}~<>'\"|&-]|\\[wdsWDS/.-]){1,100}\]|\\[wdsWDS/.-]|[A-Za-z0-9_/ ,:;@#%!=-])(\+?)"
)
_SETS_OF_SETS = ("--", "||", "&&", "~~")
_BLANK = " \t\n\r\x0b\x0c"
_OF_PATHS = ("abspath", "basename", "dirname", "split", "splitext")
_LETTERS: dict[str, Callable[[str], str]] = {"lower": str.lower, "upper": str.upper, "swapcase": str.swapcase}


def method(text: Text, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """What a method of *text* gives; None where nothing of it is sure."""
    texts = [_plain(argument.value) for argument in args if not argument.keyword]
    if len(texts) < len(args):
        return None
    if name in _LETTERS and not args:
        change = _LETTERS[name]
        return _each(text.parts, lambda part: change(part) if part.isascii() else None)
    if name == "replace" and len(texts) == 2 and texts[0] and texts[1] is not None:
        return _replaced(text.parts, texts[0], texts[1])
    if name in ("strip", "lstrip", "rstrip") and (not args or texts[0]):
        return _stripped(text.parts, (texts[0] if args else None) or _BLANK, name)
    separator = texts[0] if texts else None
    if separator is None or len(separator) != 1:
        return None
    if name in ("partition", "rpartition") and len(args) == 1:
        return _cut(text.parts, separator, name == "rpartition", True)
    if name in ("split", "rsplit") and len(args) == 2 and args[1].value == Known(1):
        return _cut(text.parts, separator, name == "rsplit", False)
    return _split(text, separator) if name in ("split", "rsplit") and len(args) == 1 else None


def substituted(args: tuple[PassedArgument, ...]) -> Value | None:
    """``re.sub(pattern, repl, string)`` of a pattern for single characters or runs of them; None for others, and where nothing is sure."""
    if len(args) != 3 or any(argument.keyword for argument in args):
        return None
    pattern, new = _plain(args[0].value), _plain(args[1].value)
    if pattern is None or new is None or "\\" in new or any(pair in pattern for pair in _SETS_OF_SETS):
        return None
    found = _SET.fullmatch(pattern)
    if found is None:
        return None
    try:
        compiled = re.compile(pattern)
    except re.error:
        return None
    return _substituted(compiled, bool(found[1]), new, args[2].value)


def _substituted(pattern: re.Pattern[str], is_run: bool, new: str, value: Value) -> Value | None:
    if isinstance(value, Choice):
        options = [_substituted(pattern, is_run, new, option) for option in value.options]
        result = options[0]
        for option in options[1:]:
            result = join(result, option) if result is not None and option is not None else None
        return result
    if not isinstance(value, Text) and _plain(value) is None:
        return None
    parts: Parts = value.parts if isinstance(value, Text) else (_plain(value) or "",)
    made: list[str | Opaque] = []
    for number, part in enumerate(parts):
        if isinstance(part, str):
            if is_run and number > 0:
                part = part[_run(pattern, part) :]
            if is_run and number < len(parts) - 1:
                part = part[: len(part) - _run(pattern, part[::-1])]
            part = pattern.sub(lambda _: new, part)
        made.append(part)
    return _whole(made)


def _run(pattern: re.Pattern[str], part: str) -> int:
    """How many characters *part* begins with that a pattern for runs matches."""
    found = pattern.match(part)
    return found.end() if found is not None else 0


def _plain(value: Value) -> str | None:
    return value.of(str) if isinstance(value, Known) and issubclass(value.kind, str) else None


def _whole(parts: list[str | Opaque]) -> Value | None:
    """The text of *parts*, of which those side by side that are not known are one; None where all is not known."""
    made: list[str | Opaque] = []
    for part in parts:
        if part == "" or (isinstance(part, Opaque) and made and isinstance(made[-1], Opaque)):
            continue
        made.append(part)
    if not any(isinstance(part, str) for part in made) and made:
        return None
    if sum(len(part) for part in made if isinstance(part, str)) > TEXT_LIMIT:
        return Opaque("it is a long text")
    return concatenate(tuple(Known(part) if isinstance(part, str) else part for part in made))


def _each(parts: Parts, change: Callable[[str], str | None]) -> Value | None:
    """The text with *change* made to its known parts; where that gives None, the part is not known."""
    unknown = next(part for part in parts if isinstance(part, Opaque))
    made: list[str | Opaque] = []
    for part in parts:
        after = change(part) if isinstance(part, str) else part
        made.append(unknown if after is None else after)
    return _whole(made)


def _replaced(parts: Parts, old: str, new: str) -> Value | None:
    """The text with *new* for *old*, which does not reach from a known part into what is not known."""
    if len(new) * (sum(len(part) for part in parts if isinstance(part, str)) + 1) > 100 * TEXT_LIMIT:
        return Opaque("it is a long text")
    unknown = next(part for part in parts if isinstance(part, Opaque))
    made: list[str | Opaque] = []
    for number, part in enumerate(parts):
        if isinstance(part, str):
            begins = number > 0 and any(part.startswith(old[at:]) for at in range(1, len(old)))
            ends = number < len(parts) - 1 and any(part.endswith(old[:at]) for at in range(1, len(old)))
            is_inside = 0 < number < len(parts) - 1 and part in old[1:-1]
            made.append(unknown if begins or ends or is_inside else part.replace(old, new))
        else:
            made.append(part)
    return _whole(made)


def _stripped(parts: Parts, letters: str, name: str) -> Value | None:
    held = list(parts)
    if name != "rstrip":
        held = _stripped_left(held, lambda part: part.lstrip(letters))
    if name != "lstrip":
        held = _stripped_left(held[::-1], lambda part: part.rstrip(letters))[::-1]
    return _whole(held)


def _stripped_left(parts: list[str | Opaque], strip: Callable[[str], str]) -> list[str | Opaque]:
    """*parts* without what is taken from the front; what may be taken behind a part that is not known is not known, too."""
    made: list[str | Opaque] = []
    for number, part in enumerate(parts):
        rest = strip(part) if isinstance(part, str) else part
        made.append(rest)
        if isinstance(rest, str) and rest:
            return [*made, *parts[number + 1 :]]
    return made


def _cut(parts: Parts, separator: str, is_last: bool, with_separator: bool) -> Value | None:
    """The text before and behind the first or last separator, where that stands in the known part that counts."""
    at = len(parts) - 1 if is_last else 0
    part = parts[at]
    if not isinstance(part, str) or separator not in part:
        return None
    before, _, behind = part.rpartition(separator) if is_last else part.partition(separator)
    left, right = _text([*parts[:at], before]), _text([behind, *parts[at + 1 :]])
    middle = (Known(separator),) if with_separator else ()
    return Sequence(Cell(tuple(Cell(item) for item in (left, *middle, right))))


def _split(text: Text, separator: str) -> Value | None:
    """The pieces of *text*: how many there are is not known, the last one may be."""
    last: list[str | Opaque] = []
    for part in reversed(text.parts):
        if isinstance(part, str) and separator in part:
            last.append(part.rpartition(separator)[2])
            break
        last.append(part)
        if isinstance(part, Opaque):
            break
    value = _text(last[::-1])
    if isinstance(value, Opaque):
        return None
    cell: Cell = Cell(value)
    unknown = text.unknown
    return Sequence(Cell(Partial(unknown.reason, unknown.location, None, (cell,), (), cell)))


def _text(parts: list[str | Opaque]) -> Value:
    return concatenate(tuple(Known(part) if isinstance(part, str) else part for part in parts))


#: The functions of paths that are known of a path whose last part is.
PATHS = frozenset(f"{module}.{name}" for module in ("os.path", "posixpath") for name in _OF_PATHS)


def of_path(name: str, text: Text) -> Value | None:
    """What a function of paths gives for a path that ends with a known name; None for others, and for a path that may end with another one."""
    last = text.parts[-1]
    if name not in PATHS or not isinstance(last, str) or "/" not in last:
        return None
    before, _, base = last.rpartition("/")
    head = (*text.parts[:-1], *([before] if before else ()))
    directory = head[0] if len(head) == 1 else Text(head)
    if base in ("", ".", ".."):
        return None
    match name.rpartition(".")[2]:
        case "basename":
            return Known(base)
        case "abspath":
            if isinstance(text.parts[0], own_files.Directory):
                return text
            return Text((Opaque("where a file lies is not known"), f"/{base}"))
        case "splitext":
            stem, ending = posixpath.splitext(base)
            return Sequence(Cell((Cell(Text((*text.parts[:-1], f"{before}/{stem}"))), Cell(Known(ending)))))
    if before.endswith("/") or isinstance(directory, str):
        return None
    return directory if name.endswith("dirname") else Sequence(Cell((Cell(directory), Cell(Known(base)))))
