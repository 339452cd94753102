# SPDX-License-Identifier: Apache-2.0
"""What to write instead of what HPL does not have: forms of its older dialect (before hpl-specs 0.2), of C, and slips."""

from __future__ import annotations

from difflib import get_close_matches

from haros_ci.behaviour.scanner import Scanner

FUNCTIONS = (
    "abs", "acos", "asin", "atan", "atan2", "bool", "ceil", "cos", "deg", "float", "floor", "gcd", "int", "len", "log", "max", "min",
    "pitch", "prod", "rad", "roll", "sin", "sqrt", "str", "sum", "tan", "yaw",
)  # fmt: skip
UNITS = ("s", "ms", "hz")
_UNIT_WORDS = {
    "sec": "s",
    "secs": "s",
    "second": "s",
    "seconds": "s",
    "S": "s",
    "msec": "ms",
    "millis": "ms",
    "Hz": "hz",
    "HZ": "hz",
}
PATTERNS = ("some", "no", "causes", "forbids", "requires", "within", "until", "after", "globally")


def in_predicate(scanner: Scanner) -> str:
    """Help where a predicate cannot go on."""
    text = scanner.next_text()
    if text == ",":
        return "HPL has no comma between conditions: write 'and'"
    if text.startswith("$"):
        return f"write @{text[1:].partition('.')[0] or 'alias'}: the older $ is no part of HPL any more"
    if scanner.peek() == "not":
        return "write 'not' before the whole comparison: not x in {0, 1}"
    if scanner.peek() == "to":
        return "write a range in brackets: [0 to 100]"
    return _SIGNS.get(text, "")


_SIGNS = {
    "||": "write 'or'",
    "&&": "write 'and'",
    "==": "write =",
    "!": "write 'not'",
    "<>": "write !=",
    "=>": "write 'implies', or >= for a comparison",
    "'": 'write texts in double quotes: "…"',
}


def in_set(scanner: Scanner) -> str:
    """Help where a range has a comma: brackets are for ranges."""
    return "brackets are for ranges; write a set in braces: {0, 1}" if scanner.is_sign(",") else in_predicate(scanner)


def after_event(scanner: Scanner) -> str:
    """Help where something stands after an event that cannot."""
    text, word = scanner.next_text(), scanner.peek()
    if text in ("||", "|") or word == "or":
        return "write one of several events in parentheses: (/a or /b)"
    if word == "as":
        return "write the alias before the predicate: /topic as A {…}"
    if text == ",":
        return "one property ends before the next begins with its scope, such as globally"
    near = get_close_matches(word, PATTERNS, 1, 0.75) if word else []
    return f"did you mean {near[0]!r}?" if near else ""


def unit(scanner: Scanner) -> str:
    """Help where a time has no unit of the language."""
    word = scanner.peek()
    return f"write {_UNIT_WORDS.get(word, '')!r}" if word in _UNIT_WORDS else "write a time as 100 ms, 2 s or 10 hz"


def topic(scanner: Scanner) -> str:
    """Help where a topic should stand."""
    text = scanner.next_text()
    if text == "/":
        return "a name has no empty part"
    if text == "(":
        return "parentheses are for one of several events: (/a or /b)"
    return ""


def scope(scanner: Scanner) -> str:
    """Help where a property does not begin with a scope."""
    word = scanner.peek()
    near = get_close_matches(word, ("globally", "after", "until"), 1, 0.6) if word else []
    return f"did you mean {near[0]!r}?" if near else "a property begins as globally: no /topic"


def function(name: str) -> str:
    """Help for a function that the language does not have."""
    near = get_close_matches(name, FUNCTIONS, 1)
    return f"did you mean {near[0]!r}?" if near else f"there are {', '.join(FUNCTIONS)}"
