# SPDX-License-Identifier: Apache-2.0
"""Macros that a text uses without defining them, recognised by their names and positions.

Two kinds stop a parser that does not see their definition and can be known without it. *Decorations*
(``NAV2_PUBLIC``) stand before a declaration and have no arguments;
ROS and its build tools end their names in one of a few words. *Registrations*
(``G2O_USE_OPTIMIZATION_LIBRARY(csparse)``) stand at the beginning of a
line, without a semicolon, and what follows is a declaration. A name that is used in any other way anywhere in the
workspace is neither:
``RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL`` is a value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.regex import regex

#: Marks of :func:`marks`: a decoration, a registration, a name that is no decoration, one that is no registration.
DECORATION, REGISTRATION, NO_DECORATION, NO_REGISTRATION = "d:", "r:", "!d:", "!r:"

#: Names of decorations, by the endings that ROS and its build tools give them.
_DECORATION = regex(
    r"\b[A-Z][A-Z0-9]*_(?:[A-Z0-9_]*_)?(?:PUBLIC|LOCAL|EXPORT|IMPORT|DECL|HIDDEN|PUBLIC_TYPE|VISIBLE|VISIBILITY|EXPORTS)\b"
)
#: What stands before a value, on its line.
_BEFORE_A_VALUE = regex(r"(?:[=!|?+/,(.]|::|\breturn|\bcase)[ \t]*$")
#: What follows a value; or the arguments of a macro, which a decoration has not.
_AFTER_A_VALUE = regex(r"\s*(?:[-(),;.=!?|&+*/<>}\]^%]|:(?!:))")
_CALL = regex(r"\b[A-Z][A-Z0-9]*_[A-Z0-9_]*[A-Z0-9](?=[ \t]*\()")
_GAP = regex(r"(?:\s+|//[^\n]*|/\*(?:[^*]|\*(?!/)){0,4000}\*/)*")
_BRACKET = regex(r"[()\"';{}]")
_DIRECTIVE = regex(r"(?:#|%:)(?:[^\n\\]|\\\r?\n|\\.)*")
#: What may stand behind the parameters of a function, and words that are operators ([lex.digraph]).
_GOES_ON = regex(
    r"(?:noexcept|const|volatile|override|final|try|requires|mutable|and|or|xor|bitand|bitor|and_eq|or_eq|xor_eq|not_eq|throw|restrict|__restrict)\b"
)
#: What stands at the end of the line before where a statement or a declaration has begun: a registration is one of its own.
_HAS_BEGUN = regex(
    r"(?:[=*&,(+/|^!<?.%~\[-]|\b(?:return|throw|co_return|co_yield|delete|new|case|goto|else|do))[ \t]*\Z|\b(?!public\b|signals\b|slots\b)[a-z]\w*[ \t]*\Z"
)
#: The arguments of a registration are no longer than this, in characters, and nest no deeper.
_LONGEST, _DEEPEST = 2_000, 8
_MOST_DIRECTIVES = 20


def marks(text: str) -> list[str]:
    """What *text* tells of names, each mark once, sorted; takes time in proportion to its length."""
    return sorted({*_decorations(text), *_registrations(text)})


def is_decoration(name: str) -> bool:
    """Whether *name* alone is that of a decoration."""
    return _DECORATION.fullmatch(name) is not None


def decorations(macros: Iterable[str]) -> set[str]:
    """The names of decorations by the marks of all texts together."""
    return _names(macros, DECORATION, NO_DECORATION)


def registrations(macros: Iterable[str]) -> set[str]:
    """The names of registrations by the marks of all texts together."""
    return _names(macros, REGISTRATION, NO_REGISTRATION)


def _names(macros: Iterable[str], mark: str, other: str) -> set[str]:
    all_of_them = set(macros)
    found = {item.removeprefix(mark) for item in all_of_them if item.startswith(mark)}
    return {name for name in found if other + name not in all_of_them}


def _decorations(text: str) -> Iterator[str]:
    for match in _DECORATION.finditer(text):
        before = text[max(text.rfind("\n", 0, match.start()) + 1, match.start() - 200) : match.start()]
        is_directive = before.lstrip().startswith("#")
        if is_directive or "//" in before or before.lstrip().startswith("*"):
            continue
        follows = text[match.end() : match.end() + 200]
        is_value = bool(_BEFORE_A_VALUE.search(before)) or bool(follows.strip() and _AFTER_A_VALUE.match(follows))
        yield (NO_DECORATION if is_value else DECORATION) + match[0]


def _registrations(text: str) -> Iterator[str]:
    for match in _CALL.finditer(text):
        start = text.rfind("\n", 0, match.start()) + 1
        before = text[max(start, match.start() - 200) : match.start()]
        if before.lstrip().startswith(("#", "//", "*")):
            continue
        follows = "" if before else _after_call(text, match.end())
        if follows is None or follows[:1] == ";":
            continue
        is_one = not before and (not follows or follows[0].isalpha() or follows[0] in "_}~" or follows[:2] == "[[")
        is_one = is_one and not _GOES_ON.match(follows) and not _HAS_BEGUN.search(_line_before(text, start))
        yield (REGISTRATION if is_one else NO_REGISTRATION) + match[0]


def _after_call(text: str, at: int) -> str | None:
    """What begins after the arguments that begin at *at*, directives aside: "" at the end of the text, None without an end."""
    depth, limit = 0, at + _LONGEST
    while match := _BRACKET.search(text, at, limit):
        at, character = match.end(), match[0]
        if character in "\"'":
            end = text.find(character, at, limit)
            if end < 0:
                return None
            at = end + 1
        elif character in ";{}":
            return None
        else:
            depth += 1 if character == "(" else -1
            if depth > _DEEPEST:
                return None
            if depth == 0:
                return _beginning(text, at)
    return None


def _beginning(text: str, at: int) -> str:
    """The first characters at *at* or behind it that are no blanks, comments and directives; of many directives the next one."""
    for _ in range(_MOST_DIRECTIVES):
        gap = _GAP.match(text, at)
        assert gap is not None
        at = gap.end()
        directive = _DIRECTIVE.match(text, at)
        if directive is None:
            break
        at = directive.end()
    return text[at : at + 20]


def _line_before(text: str, start: int) -> str:
    """The code of the last line before *start* that is not blank, "" for a comment or a directive; of a long one the end."""
    end = len(text[max(0, start - 2_000) : start].rstrip()) + max(0, start - 2_000)
    line = text[max(text.rfind("\n", 0, end) + 1, end - 400) : end].partition("//")[0].rstrip()
    return "" if line.lstrip().startswith(("#", "%:", "*")) or line.endswith("*/") else line
