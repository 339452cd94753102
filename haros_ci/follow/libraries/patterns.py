# SPDX-License-Identifier: Apache-2.0
"""Shell patterns: what ``fnmatch`` of C gives for a pattern and a text that are known (fnmatch(3))."""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from haros_ci.values.abstract import Known, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

NAMES = frozenset(("fnmatch", "std::fnmatch"))
#: What it gives where the text does not match: FNM_NOMATCH of glibc.
NO_MATCH = 1
#: Characters of a pattern and of a text up to which they are compared.
LONGEST = 200


def matched(args: tuple[PassedArgument, ...]) -> Value | None:
    """0 for a match and FNM_NOMATCH for none; None where the flags decide, or the pattern has brackets or escapes."""
    if len(args) != 3:
        return None
    pattern, text, flags = (argument.value for argument in args)
    if not isinstance(pattern, Known) or not isinstance(text, Known):
        return None
    if not issubclass(pattern.kind, str) or not issubclass(text.kind, str):
        return None
    is_plain = isinstance(flags, Known) and flags.value == 0
    is_match = _is_match(pattern.of(str), text.of(str), is_plain)
    return None if is_match is None else Known(0 if is_match else NO_MATCH)


def _is_match(pattern: str, text: str, is_plain: bool) -> bool | None:
    """Whether a text matches a pattern, where it *is_plain* without flags; None where that is not known."""
    if max(len(pattern), len(text)) > LONGEST or any(letter in pattern for letter in "[]\\()"):
        return None
    if not is_plain and ("/" in text or text.startswith(".")):  # FNM_PATHNAME, FNM_LEADING_DIR, FNM_PERIOD
        return None
    is_match = fnmatchcase(text, pattern)
    if not is_plain and is_match != fnmatchcase(text.lower(), pattern.lower()):  # FNM_CASEFOLD
        return None
    return is_match
