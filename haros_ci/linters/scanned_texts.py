# SPDX-License-Identifier: Apache-2.0
"""Texts that ``sscanf()`` reads words of into memory of their own length: no word is longer."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.linters.call_arguments import arguments
from haros_ci.linters.function_text import function_text
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments

_CALL = regex(r"\bsscanf\s*\(")
_TEXT = regex(r"(?:L|u8)?\"((?:[^\"\\\n]|\\.)*)\"")
#: A conversion; those with ``*`` take no argument.
_CONVERSION = regex(r"%(\*)?(\d*)(?:hh|h|ll|l|j|z|t|L|m)?(\[\^?\]?[^\]]*\]|[a-zA-Z%])")
_NAME = regex(r"(?:&\s*)?(?:\(\s*(?:&\s*)?)?([A-Za-z_]\w*)\s*(?:\)|\[\s*0\s*\])*")
_STRING = regex(r"([A-Za-z_][\w.>-]*?)\s*(?:\.|->)\s*(?:c_str|data)\s*\(\s*\)")
_WORD = regex(r"[A-Za-z_]\w*")


def is_large_enough(line: int, whole: str) -> bool:
    """Whether each word that the ``sscanf()`` at *line* reads without a width goes to memory as long as the text that it is read of.

    ``char word[text.size() + 1]; sscanf(text.c_str(), "%s", word);``, and two arrays of which the second is no shorter.
    """
    text = without_comments(whole, "c")
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    above = function_text(line, text)
    rest = "\n".join(lines[line - 1 :])
    call = _CALL.search(lines[line - 1])
    given = arguments(rest, call.end() - 1) if call is not None else []
    form = "".join(found[1] for found in _TEXT.finditer(given[1])) if len(given) > 1 else ""
    if not form or _TEXT.sub("", given[1]).strip():
        return False
    wide = list(_wide(form))
    targets = [given[index + 2] for index in wide if index + 2 < len(given)]
    return (
        bool(wide) and len(targets) == len(wide) and all(_fits(given[0].strip(), one.strip(), above) for one in targets)
    )


def _wide(form: str) -> Iterator[int]:
    """The numbers of the arguments that words without a width go to."""
    index = 0
    for star, width, kind in (found.groups() for found in _CONVERSION.finditer(form)):
        if star or kind == "%":
            continue
        if (kind[0] == "[" or kind in "sS") and not width:
            yield index
        index += 1


def _fits(source: str, target: str, above: str) -> bool:
    """Whether *target*, an array that is declared *above*, has room for all of *source*."""
    name = _NAME.fullmatch(target)
    room = _length(name[1], above) if name is not None else ""
    text = _STRING.fullmatch(source)
    if text is not None:
        size = rf"{re.escape(text[1])}\s*(?:\.|->)\s*(?:size|length)\s*\(\s*\)\s*\+\s*[1-9]\d*"
        return re.fullmatch(size, room) is not None
    array = _NAME.fullmatch(source)
    length = _length(array[1], above) if array is not None else ""
    if room.isdigit() and length.isdigit():
        return int(room) >= int(length)
    return bool(room) and room == length and _WORD.fullmatch(room) is not None


def _length(name: str, above: str) -> str:
    """What the nearest declaration of the array *name* says of its length; "" without one."""
    found = re.findall(
        rf"\bchar\s+(?:\w+(?:\s*\[[^\];]{{0,100}}\])?\s*,\s*){{0,10}}{name}\s*\[([^\];]{{1,100}})\]", above
    )
    again = re.findall(rf"[*&]\s*{name}\s*[=,;)]", above)
    return found[-1].strip() if found and not again else ""
