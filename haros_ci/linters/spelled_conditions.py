# SPDX-License-Identifier: Apache-2.0
"""Directives and conditions in forms that cppcheck does not read as a compiler does: written for it in those that it does, or named.

``%:`` begins no directive for it, and it takes lines behind it for code of another form; a line that ends with a backslash before the one
by which it goes on swallows what follows. In conditions ``true`` and ``0b1`` are 0 to it, two
signs behind each other too, and all numbers have a sign.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.linters.version_conditions import chains, has_code
from haros_ci.regex import regex

#: A line that goes on in the next ones, to its end: no part of it can be read in two ways.
_REST = r"(?:[^\n\\]|\\[ \t]*\n|\\)*"
_SPLICE = r"(?:\\[ \t]*\n)*"
_DIGRAPH = regex(rf"(?:^|\*/)[ \t\f\v]*(%){_SPLICE}(:)", re.M)
_DEFINITION = regex(rf"(?:#|%:)[ \t]*define\b{_REST}")
_HASH_OR_TEXT = regex(r"\"(?:[^\"\\\n]|\\[^\n])*\"|'(?:[^'\\\n]|\\[^\n]){1,12}'|%:")
_GOES_ON = regex(r"\\[ \t]*\r?\n")
#: Of its words cppcheck takes those of the first line alone.
_WARNING = regex(rf"(?:#|%:)[ \t]*warning\b({_REST})")
_WORDS = regex(r"[^\s\\]|\\(?![ \t]*\r?\n)")
_CONDITION = regex(rf"(?:#|%:)[ \t]*(?:el)?if\b({_REST})")
_WORD = regex(
    r"'(?:[^'\\\n]|\\[^\n]){1,12}'"
    r"|(?<![\w'.])(?P<number>0[bB][01]{1,64}(?:'[01]{1,64}){0,64}|\d[\da-fA-FxX]{0,40}(?:'[\da-fA-F]{1,40}){1,40})(?P<suffix>[uUlLzZ]{0,3})(?![\w'.])"
    r"|\btrue\b"
)
#: GCC has these names where CMake leaves its own additions to the language on, as it does by default.
_SYSTEM = regex(r"\bdefined[ \t]*(?:\([ \t]*(?:linux|unix)[ \t]*\)|[ \t](?:linux|unix)\b)")
_IF_SYSTEM = regex(r"(?:#|%:)[ \t]*(?:el)?(if(n?)def[ \t]+(?:linux|unix)\b)")
_OWN_SYSTEM = regex(r"(?:define|undef)[ \t]+(?:linux|unix)\b")
_TWICE = regex(r"!([ \t]*)!")
_MORE_THAN_TRUTH = regex(r"[-=<>+*/%^~?,]|(?<!&)&(?!&)|(?<!\|)\|(?!\|)")

#: In what a macro stands for such a word takes the next line with it; and what is a raw text only where lines are not joined.
_SAID = regex(r"(?:#|%:)[ \t]*(?:warning|error)\b[^\n]*\\[ \t]*\r?\n")
_RAW = regex(r"[\w.'](?:\\[ \t]*\r?\n)+(?:u8|[uUL])?R\"")
_SIGNS = regex(r"[-+!~][ \t]*[-+!~](?!=)")
_UNSIGNED = regex(r"\b\d[\da-fA-FxX']{0,40}[lL]{0,2}[uU][lLzZ]{0,2}\b")
_ARITHMETIC = regex(r"[-+*~]")
_CALL = regex(r"\b\w+[ \t]*\([^()]*\)")
_DEEPEST = 8
_HAS = regex(r"\b__has_(?!include(?:_next)?[ \t]*\([ \t]*\")\w+")


def spelled(text: str) -> str:
    """*text* of C++ with such directives and conditions in the usual form; of the same length, or itself. Takes linear time."""
    if "%" in text:
        text = _DIGRAPH.sub(_with_hash, text)
        if "%:" in text:
            text = _DEFINITION.sub(lambda match: _HASH_OR_TEXT.sub(_hash, match[0]), text)
    if "\\" in text:
        text = _with_one_backslash(text)
        if "warning" in text:
            text = _WARNING.sub(_without_words, text)
    if _is_usual(text):
        return text
    text = _CONDITION.sub(lambda match: match[0][: match.start(1) - match.start()] + _condition(match[1]), text)
    if ("linux" in text or "unix" in text) and _OWN_SYSTEM.search(text) is None:
        text = _IF_SYSTEM.sub(_if_system, text)
        text = _CONDITION.sub(lambda match: _SYSTEM.sub(lambda inner: "1".ljust(len(inner[0])), match[0]), text)
    return text


def odd_conditions(code: str) -> Iterator[str]:
    """Those in *code*, without comments and with spliced lines joined, that cppcheck may answer otherwise, by what they are, in words."""
    for match in _CONDITION.finditer(code):
        condition = _condition(match[1])
        if _SIGNS.search(condition) is not None:
            yield "a condition with two signs behind each other"
        if _UNSIGNED.search(condition) is not None and _ARITHMETIC.search(condition) is not None:
            yield "a condition that calculates with numbers without a sign"
        if "," in condition and "," in _without_calls(condition):
            yield "a condition with a comma"
    if "__has_" in code and any(has_code(code, chain) for chain in chains(code, _HAS)):
        yield "a condition on what a compiler has, and code under it,"


def odd_lines(text: str) -> Iterator[str]:
    """Lines of *text* that go on in the next one in a place where cppcheck does not see that, in words; takes linear time."""
    if "\\" not in text:
        return
    if ("warning" in text or "error" in text) and any(_SAID.search(match[0]) for match in _DEFINITION.finditer(text)):
        yield "a macro with #warning or #error in it"
    if "warning" in text and any("\n" in match[1] and "*/" in match[1] for match in _WARNING.finditer(text)):
        yield "a #warning over several lines"
    if _RAW.search(text) is not None:
        yield "a raw text that begins in a word"


def _is_usual(text: str) -> bool:
    return not any(word in text for word in ("true", "0b", "0B", "linux", "unix", "!")) and "'" not in text


def _with_one_backslash(text: str) -> str:
    """*text* with no backslash before one by which a line goes on."""
    parts: list[str] = []
    done = 0
    for match in _GOES_ON.finditer(text):
        at = match.start()
        line = text.rfind("\n", 0, at) + 1
        kept = line + len(text[line:at].rstrip("\\ \t"))
        if "\\" in text[kept:at]:
            parts += (text[done:kept], text[kept:at].replace("\\", " "))
            done = at
    return "".join((*parts, text[done:])) if parts else text


def _without_words(match: re.Match[str]) -> str:
    whole, words = match[0], match[1]
    return whole if "\n" not in words or "*/" in words else whole[: -len(words)] + _WORDS.sub(" ", words)


def _with_hash(match: re.Match[str]) -> str:
    whole, begin = match[0], match.start()
    first, second = match.start(1) - begin, match.start(2) - begin
    return f"{whole[:first]}#{whole[first + 1 : second]} "


def _hash(match: re.Match[str]) -> str:
    return "# " if match[0] == "%:" else match[0]


def _condition(text: str) -> str:
    """The condition in words that cppcheck knows."""
    text = _WORD.sub(_word, text)
    if "!" in text and _TWICE.search(text) is not None and _MORE_THAN_TRUTH.search(text) is None:
        text = _TWICE.sub(lambda match: f" {match[1]} ", text)
    return text


def _word(match: re.Match[str]) -> str:
    word = match[0]
    if word == "true":
        return "1   "
    if match["number"] is None:
        return word
    digits = match["number"].replace("'", "").lower()
    base = 2 if digits.startswith("0b") else 16 if digits.startswith("0x") else 8 if digits.startswith("0") else 10
    try:
        plain = f"{int(digits, base)}{match['suffix']}"
    except ValueError:
        return word
    return plain.ljust(len(word)) if len(plain) <= len(word) else word


def _if_system(match: re.Match[str]) -> str:
    kept = match[0][: match.start(1) - match.start()]
    return kept + f"if {'0' if match[2] else '1'}".ljust(len(match[1]))


def _without_calls(text: str) -> str:
    for _ in range(_DEEPEST):
        text, number = _CALL.subn("0", text)
        if not number:
            break
    return text
