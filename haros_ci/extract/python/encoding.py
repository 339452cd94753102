# SPDX-License-Identifier: Apache-2.0
"""The encoding that a Python file declares (PEP 263), as far as it can make other code of the text than what is read here."""

from __future__ import annotations

import re

from haros_ci.regex import regex

#: In the first two lines, as CPython's tokenizer looks for it; the second counts if the first has no code.
_COOKIE = regex(r"^[ \t\f]*#.*?coding[:=][ \t]*([-\w.]{1,100})")
_NO_CODE = regex(r"^[ \t\f]*(?:#|$)")
#: Encodings in which each byte of ASCII is that character and a part of no other: the code is the same, whichever it is.
_SAME = regex(
    r"utf[-_]?8(?:[-_].*)?|u8|(?:us[-_]?)?ascii|646|latin[-_]?\d{0,2}|l\d|iso[-_]?8859.*|(?:cp|windows[-_]?|ibm)?(?:125\d|437|85\d|86\d)|koi8.*|euc[-_]?.*"
    r"|ujis|(?:iso[-_]?(?:ir)?[-_]?)\d+|mac.*|cyrillic|greek|arabic|hebrew|tis[-_]?620",
    re.IGNORECASE,
)


def other_encoding(text: str) -> str:
    """The encoding that *text* declares where code may be hidden in it from a reader of ASCII, such as UTF-7; "" otherwise."""
    first, _, rest = text[:2000].partition("\n")
    for line in (first, rest.partition("\n")[0]) if _NO_CODE.match(first) else (first,):
        if found := _COOKIE.match(line):
            return "" if _SAME.fullmatch(found[1]) else found[1]
    return ""
