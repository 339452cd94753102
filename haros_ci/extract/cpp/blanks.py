# SPDX-License-Identifier: Apache-2.0
"""Replacing text that the grammar cannot read by spaces of the same length, so that positions stay."""

from __future__ import annotations

import re

from haros_ci.regex import regex

_LEXEME = regex(
    r"""
      /(?: /[^\\\n]*(?:\\.[^\\\n]*)* | \*.*?(?:\*/|\Z) )          # comments
    | R"([^()\\\s"]{0,16})\(.*?(?:\)\1"|\Z)                        # raw strings
    | "[^"\\\n]*(?:\\.[^"\\\n]*)*"?                                # strings
    | '(?<![0-9A-Fa-f]')[^'\\\n]*(?:\\.[^'\\\n]*)*'?               # characters, not digit separators
    """,
    re.VERBOSE | re.DOTALL,
)
_VISIBLE = regex(r"[^\n]")
_CLASS_HEAD = regex(
    r"""
    \b(?:class|struct|union)\s{1,20}
    ((?: [A-Z][A-Z0-9_]*(?:\([^()]{0,200}\))? | \w{1,80}_(?:EXPORT|PUBLIC|LOCAL|DECL|API) )\s{1,20})
    (?= (?!final\b)[A-Za-z_]\w{0,200}\s{0,20} (?: :(?!:) | \{ | final\b ) )
    """,
    re.VERBOSE,
)
_ATTRIBUTE = regex(
    r"(?P<attribute>\[\[[\w\s:,]{0,100}(?:\((?:[^()\[\]\"]|\"[^\"\\\n]{0,400}\"){0,200}\)\s{0,9})?\]\])|"
    + _LEXEME.pattern,
    re.VERBOSE | re.DOTALL,
)
_EXPORT = regex(
    r"^[ \t]*#[^\n]*"
    r"|\b[A-Z][A-Z0-9_]{0,80}_(?:API|EXPORT|PUBLIC|LOCAL|DECL|IMPORT|DEPRECATED)\b(?=\s{1,40}[A-Za-z_~:\[])",
    re.MULTILINE,
)
_EXPORTS = ("_PUBLIC", "_EXPORT", "_API", "_LOCAL", "_DECL", "_IMPORT", "_DEPRECATED")
_QT = regex(
    r"\b(?:(?<=public )|(?<=private )|(?<=protected ))(?:Q_SLOTS|slots)\b"
    r"|\b(?:Q_SIGNALS|signals)[ \t]*:(?!:)|\bQ_OBJECT\b|\bQ_GADGET\b|\b(?:Q_EMIT|emit)\b(?=[ \t]+[A-Za-z_])"
)
#: What the grammar does not know, each with what to blank as the groups: ``new T *[n]``, ``= typename A::B()``,
#: ``a->template f(x)``, ``a->operator ()(x)``, ``SIGNAL(f(int))``, ``typeid(unsigned int)``,
#: ``unsigned(x)``, ``T name FOO_UNUSED,``, and a macro alone on its line.
_UNKNOWN = regex(
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
    | (?:<<|,)\s{0,200}(?P<dependent>typename)(?=\s{1,9}\w{1,80}(?:::\w{1,80}){1,9}\s{0,9}\()
    | \(\s{0,9}(?P<member>(?:\w{1,80}::){1,9})(?=\*\s{0,9}\w{0,80}\s{0,9}\)\s{0,9}\()
    | \b[A-Z][A-Z0-9_]{1,80}\([^;{}]{0,400}(?P<ended>;)(?=\s{0,9}\)\s{0,9};)
    """,
    re.VERBOSE,
)
#: An include with blanks after it, where its comment was: with them the grammar takes a call in the next line for its path.
_INCLUDE = regex(r"""^([ \t]*\#[ \t]*include\b)([ \t]*(?:<[^<>\n]{1,400}>|"[^"\n]{1,400}"))([ \t]+)$""", re.MULTILINE)
#: ``a->operator[](i)``, which is ``a[i]``.
_ELEMENT = regex(r"(?<=[\w)\]])((?:->|\.)\s{0,9}operator\s{0,9}\[\s{0,9}\]\s{0,9}\()([^(){};]{0,400})\)")
#: ``#if VERSION(<, 1, 2)``: an operator as an argument, and the names that stand for operators meanwhile.
_COMPARED = regex(r"^([ \t]*#[ \t]*(?:el)?if\b[^\n(]{0,200}\()([<>]=?|[=!]=)(?=[ \t]*,)", re.MULTILINE)
_COMPARISONS = {"<": "$", ">": "_", "<=": "$$", ">=": "$_", "==": "_$", "!=": "$0"}
_OPERATORS = {name: symbol for symbol, name in _COMPARISONS.items()}
_STAND_IN = regex(r"(?<=\()(?:[$_]{1,2}|\$0)(?=[ \t]*,)")
#: A macro with arguments on lines of its own, without a semicolon before the next statement.
_UNENDED = regex(
    r"([;{}]\s{0,2000}[A-Z][A-Z0-9]{0,40}_[A-Z0-9_]{1,80}\((?:[^(){};]|\([^(){};]{0,200}\)){0,400}\)[ \t]{0,2000}"
    r"(?:(?<=[ \t])|\n\s{0,2000}[ \t]))(?<=[ \t])(?=\s{0,2000}"
    r"(?!(?:void|virtual|static|explicit|template|class|struct|union|typedef|using|public|private|protected|friend|enum|"
    r"namespace|inline|constexpr|extern)\b)[A-Za-z_]\w{0,80}\b)"
)
#: ``const T & x(a.b);``, which is no function: a parameter has no dot.
_REFERENCE = regex(
    r"([\w>]\s{0,9}&\s{0,9}\w{1,80})\(((?=[^;={}]{0,200}?(?:\w\.\w|->))(?:[^(),;={}]|\([^();={}]{0,100}\)){1,200})\)(?=\s{0,9};)"
)
_DIGRAPH = regex(r"^([ \t]*)%:", re.M)
#: Brackets in other letters (``<:``, ``%>``; [lex.digraph]); ``<::`` is one only before ``:`` or ``>`` ([lex.pptoken]).
_BRACKET = regex(r"(?P<digraph><%|%>|<::>|<:(?!:(?![:>]))|(?<!:):>)|" + _LEXEME.pattern, re.VERBOSE | re.DOTALL)
_DIGRAPHS = {"<%": "{ ", "%>": "} ", "<:": "[ ", ":>": "] ", "<::>": "[  ]"}
_NAME = regex(r"\s(?=\s{0,40}(?!(?:and|or|u8|[RLuU])\b)[A-Za-z_]\w{0,80}\s{0,40}[\"),;])")
_FOREACH = regex(r"\b(?:BOOST_FOREACH|BOOST_REVERSE_FOREACH|Q_FOREACH|foreach)(?=\s{0,9}\()")
#: Macros without semicolons in a row.
_IN_A_ROW = 4
_BRACKETS = regex(r"[()\[\]{},;]")
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
    """*text* without comments, attributes, export macros and Qt's words; ``BOOST_FOREACH(a, b)`` as ``for (a: b)``, ``%:if`` as ``# if``, ``<:`` as ``[ ``."""
    text = without_comments(text)
    if "%:" in text:
        text = _DIGRAPH.sub(r"\1# ", text)
    if any(digraph in text for digraph in _DIGRAPHS):
        text = _BRACKET.sub(lambda match: _DIGRAPHS[match["digraph"]] if match["digraph"] else match.group(), text)
    text = _INCLUDE.sub(r"\1\3\2", text)
    if "[[" in text:
        text = _ATTRIBUTE.sub(lambda match: _spaces(match.group()) if match["attribute"] else match.group(), text)
    code = text
    text = _CLASS_HEAD.sub(lambda match: match.group().replace(match.group(1), " " * len(match.group(1)), 1), text)
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
    after = _ELEMENT.sub(lambda match: f"{'['.ljust(len(match.group(1)))}{match.group(2)}]", after)
    after = _COMPARED.sub(lambda match: match.group(1) + _COMPARISONS[match.group(2)], after)
    for _ in range(_IN_A_ROW):
        before, after = after, _UNENDED.sub(_ended, after)
        if before == after:
            break
    after = after.replace("->*", " .*")
    return _joined(_with_strings_of(text, after))


def compared(text: str) -> str:
    """A condition's *text* as it was: with the operators that ``simplified`` has put names in place of."""
    return _STAND_IN.sub(lambda match: _OPERATORS[match.group()], text) if text.startswith("#") else text


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


def _ended(match: re.Match[str]) -> str:
    """*match* with a semicolon in place of its last blank, if there is a new line behind the macro."""
    text = match.group()
    follows = match.string[match.end() : match.end() + 1]
    return f"{text[:-1]};" if "\n" in text[text.rindex(")") :] or follows == "\n" else text


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
