# SPDX-License-Identifier: Apache-2.0
"""Replacing text that the grammar cannot read by spaces of the same length, so that positions stay."""

from __future__ import annotations

import re

_LEXEME = re.compile(
    r"""
      /(?: /[^\\\n]*(?:\\.[^\\\n]*)* | \*.*?(?:\*/|\Z) )          # comments
    | R"([^()\\\s"]{0,16})\(.*?(?:\)\1"|\Z)                        # raw strings
    | "[^"\\\n]*(?:\\.[^"\\\n]*)*"?                                # strings
    | '(?<![0-9A-Fa-f]')[^'\\\n]*(?:\\.[^'\\\n]*)*'?               # characters, not digit separators
    """,
    re.VERBOSE | re.DOTALL,
)
_VISIBLE = re.compile(r"[^\n]")
_CLASS_HEAD = re.compile(
    r"""
    \b(?:class|struct|union)\s{1,20}
    ((?: [A-Z][A-Z0-9_]*(?:\([^()]{0,200}\))? | \w{1,80}_(?:EXPORT|PUBLIC|LOCAL|DECL|API) )\s{1,20})
    (?= (?!final\b)[A-Za-z_]\w{0,200}\s{0,20} (?: :(?!:) | \{ | final\b ) )
    """,
    re.VERBOSE,
)
_ATTRIBUTE = re.compile(r"\[\[[\w\s:,]{0,100}(?:\([^()\[\]]{0,200}\)\s{0,9})?\]\]")
_EXPORT = re.compile(
    r"^[ \t]*#[^\n]*"
    r"|\b[A-Z][A-Z0-9_]{0,80}_(?:API|EXPORT|PUBLIC|LOCAL|DECL|IMPORT|DEPRECATED)\b(?=\s{1,40}[A-Za-z_~:\[])",
    re.MULTILINE,
)
_EXPORTS = ("_PUBLIC", "_EXPORT", "_API", "_LOCAL", "_DECL", "_IMPORT", "_DEPRECATED")
_QT = re.compile(
    r"\b(?:(?<=public )|(?<=private )|(?<=protected ))(?:Q_SLOTS|slots)\b"
    r"|\b(?:Q_SIGNALS|signals)[ \t]*:(?!:)|\bQ_OBJECT\b|\bQ_GADGET\b|\b(?:Q_EMIT|emit)\b(?=[ \t]+[A-Za-z_])"
)
#: What the grammar does not know, each with what to blank as the groups: ``new T *[n]``, ``= typename A::B()``,
#: ``a->template f(x)``, ``a->operator ()(x)``, ``SIGNAL(f(int))``, ``typeid(unsigned int)``,
#: ``unsigned(x)``, ``T name FOO_UNUSED,``, and a macro alone on its line.
_UNKNOWN = re.compile(
    r"""
      \bnew\s[\w: ]{1,200}(?P<stars>\*[*\s]{0,9})(?=\[)
    | (?:[=(]|\breturn)\s{0,200}(?P<typename>typename)(?=\s)
    | (?:->|\.)\s{0,9}(?P<template>template)(?=\s{1,9}\w{1,200}\s{0,9}\()
    | \w(?P<operator>(?:->|\.)\s{0,9}operator\s{0,9}\(\s{0,9}\))
    | \b(?:SIGNAL|SLOT)\((?P<signature>[^()]{0,200}\([^()]{0,200}\))\s{0,9}\)
    | \btypeid\((?P<typeid>(?:unsigned|signed|long|short|int|bool|char|float|double)\b[a-z ]{0,40})\)
    | \b(?P<sized>unsigned|signed|long|short)(?=\s{0,9}\(\s{0,9}[^\s*])
    | (?:[;}:]|\{(?!\s{0,2000}\w{1,80}\s{0,200}\}))\s{0,2000}
      (?P<macro>[A-Z][A-Z0-9]{0,40}_[A-Z0-9_]{1,80})[ \t\r]{0,200}(?=\n\s{0,2000}[A-Za-z_~\#}])
    | \w\s(?P<unused>[A-Z_]{0,80}UNUSED)(?=\s{0,9}[,)])
    """,
    re.VERBOSE,
)
#: ``const T & x(a.b);``, which is no function: a parameter has no dot.
_REFERENCE = re.compile(
    r"([\w>]\s{0,9}&\s{0,9}\w{1,80})\(((?=[^;={}]{0,200}?(?:\w\.\w|->))(?:[^(),;={}]|\([^();={}]{0,100}\)){1,200})\)(?=\s{0,9};)"
)
_NAME = re.compile(r"\s(?=\s{0,40}(?!(?:and|or|u8|[RLuU])\b)[A-Za-z_]\w{0,80}\s{0,40}[\"),;])")
_FOREACH = re.compile(r"\b(?:BOOST_FOREACH|BOOST_REVERSE_FOREACH|Q_FOREACH|foreach)(?=\s{0,9}\()")
_BRACKETS = re.compile(r"[()\[\]{},;]")
_FOREACH_WINDOW = 500


def _spaces(text: str) -> str:
    return " " * len(text) if "\n" not in text else _VISIBLE.sub(" ", text)


def _lexeme(match: re.Match[str]) -> str:
    text = match.group()
    return _spaces(text) if text[0] == "/" else text


def without_comments(text: str) -> str:
    """*text* with its comments blanked."""
    return _LEXEME.sub(_lexeme, text)


def skeleton(text: str) -> str:
    """*text*, free of comments, with its strings and characters blanked, too."""
    return _LEXEME.sub(lambda match: _spaces(match.group()), text)


def readable(text: str) -> str:
    """*text* without comments, attributes, export macros and Qt's words; ``BOOST_FOREACH(a, b)`` as ``for (a: b)``."""
    code = text = without_comments(text)
    text = _CLASS_HEAD.sub(lambda match: match.group().replace(match.group(1), " " * len(match.group(1)), 1), text)
    if "[[" in text:
        text = _ATTRIBUTE.sub(lambda match: _spaces(match.group()), text)
    if any(word in text for word in _EXPORTS):
        text = _EXPORT.sub(lambda match: match.group() if "#" in match.group() else " " * len(match.group()), text)
    if "Q_" in text or "slots" in text or "emit" in text or "signals" in text:
        text = _QT.sub(lambda match: " " * len(match.group()), text)
    if "FOREACH" in text or "foreach" in text:
        text = _loops(text)
    return _with_strings_of(code, text)


def simplified(text: str) -> str:
    """*text*, free of comments, without what the grammar of expressions lacks and meaning does not need."""
    after = _UNKNOWN.sub(_without_group, text)
    after = _REFERENCE.sub(lambda match: f"{match.group(1)}={match.group(2)} ", after)
    return _joined(_with_strings_of(text, after))


def _joined(text: str) -> str:
    """*text* with ``"a"+NAME "b"`` for ``"a" NAME "b"``, which the grammar knows only after a name."""
    spaces = [
        match.end() for match in _LEXEME.finditer(text) if match.group()[0] == '"' and _NAME.match(text, match.end())
    ]
    pieces = [text[start + 1 : end] for start, end in zip([-1, *spaces], [*spaces, len(text)], strict=True)]
    return "+".join(pieces)


def _with_strings_of(before: str, after: str) -> str:
    """*after* with the strings that *before* has at the same places: they are text, not code."""
    if before == after:
        return after
    pieces: list[str] = []
    done = 0
    for match in _LEXEME.finditer(before):
        start, end = match.span()
        if match.group()[0] != "/" and after[start:end] != match.group():
            pieces += [after[done:start], match.group()]
            done = end
    return "".join([*pieces, after[done:]])


def _without_group(match: re.Match[str]) -> str:
    assert match.lastgroup is not None
    start, end = match.span(match.lastgroup)
    text, offset = match.group(), match.start()
    return text[: start - offset] + _spaces(text[start - offset : end - offset]) + text[end - offset :]


def _loops(text: str) -> str:
    pieces: list[str] = []
    done = 0
    for match in _FOREACH.finditer(text):
        comma = _first_comma(text, match.end())
        if match.start() >= done and comma:
            pieces += [text[done : match.start()], "for".ljust(match.end() - match.start())]
            pieces += [text[match.end() : comma], ":"]
            done = comma + 1
    return "".join([*pieces, text[done:]])


def _first_comma(text: str, start: int) -> int:
    """Where the first comma between the parentheses after *start* is; 0 if there is none near."""
    depth = 0
    for match in _BRACKETS.finditer(text, start, start + _FOREACH_WINDOW):
        bracket = match.group()
        if bracket in "([{":
            depth += 1
        elif bracket in ")]}":
            depth -= 1
            if depth == 0:
                return 0
        elif bracket == "," and depth == 1:
            return match.start()
    return 0
