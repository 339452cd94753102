# SPDX-License-Identifier: Apache-2.0
"""What the words of a macro stand for: code, another word of the code around it, or what a tool need not know (a number, a text, a call, an attribute)."""

from __future__ import annotations

import re

from haros_ci.regex import regex

_CODE = regex(r"\b(?:return|throw|goto|delete)\b|[{;]")
_PARAMETERS = regex(r"\(([^()\n]{0,2000})\)")
#: What is no word of the code around: texts, characters, numbers, attributes.
_IDLE = regex(
    r"\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.){1,12}'|\b\d[\w.']*|\[\[[^\[\]]{0,400}\]\]"
    r"|\b(?:__attribute__|__attribute|__declspec|__pragma|_Pragma|alignas)\s*\((?:[^()]|\((?:[^()]|\([^()]{0,200}\)){0,200}\)){0,400}\)"
)
_NAME = regex(r"(::\s*)?\b([A-Za-z_]\w*)\b(?=\s*(\(|::|<|##)?)")
#: Keywords that name types or qualify them, and words that a value is made of without naming one.
_QUIET = frozenset(
    """
    auto bool char const constexpr double enum explicit extern float friend inline int long mutable namespace noexcept override final register short signed sizeof static
    static_cast const_cast reinterpret_cast dynamic_cast struct class template thread_local typename union unsigned using virtual void volatile wchar_t alignas alignof char8_t
    char16_t char32_t consteval constinit decltype defined do else if for while switch case default break continue restrict __restrict __restrict__ __inline __inline__ __volatile__
    __extension__ asm std true false __func__ __FILE__ __LINE__ __PRETTY_FUNCTION__ __VA_ARGS__ __COUNTER__ this typeof __typeof__ string
    """.split()
)
_KEYWORDS = frozenset(
    """
    auto bool break case catch char class const constexpr const_cast continue decltype default delete do double dynamic_cast else enum explicit export extern
    float for friend goto if inline int long mutable namespace new noexcept nullptr operator private protected public register reinterpret_cast return short signed sizeof static
    static_assert static_cast struct switch template this thread_local throw true false try typedef typeid typename union unsigned using virtual void volatile while
    override final and or not xor bitand bitor compl alignas alignof co_await co_return co_yield
    """.split()
)
_CAPITALS = regex(r"_*[A-Z][A-Z0-9_]*")
_TYPE = regex(r"\w+_t")
#: What a word may stand in and still be the word alone.
_AROUND = regex(r"[\s()&*!~+-]+")
#: Operators and statements that are spelled as words.
SPELLED = frozenset("not compl bitand bitor and or xor return throw delete goto new co_return nullptr NULL".split())


def gives_code(words: str) -> bool:
    """Whether *words* of a macro hold a statement or a block."""
    return _CODE.search(words) is not None


def is_word_for_a_word(name: str, words: str) -> bool:
    """Whether the macro *name* makes another word, or none, of a keyword, or stands with its *words* for a word or a sign of the code around it.

    Numbers, texts, types, attributes, names in capitals and calls are none; nor is an expression of its own parameters with more than one of them.
    """
    if name in _KEYWORDS:
        return True
    parameters: frozenset[str] = frozenset()
    opening = _PARAMETERS.match(words)
    if opening is not None:
        parameters = frozenset(word.strip() for word in opening[1].split(","))
        words = words[opening.end() :]
    words = _IDLE.sub(" 0 ", words.replace("\\\n", " ").replace("\\\r\n", " ")).strip()
    if not words:
        return False
    if opening is not None and _calls_itself(name, words, opening[1]):
        return True
    if not re.search(r"\w", words):
        return opening is None
    alone = _AROUND.sub("", words)
    if alone in parameters:
        return True
    if alone in SPELLED:
        return True
    return any(
        not behind and not before and word not in parameters and _is_of_the_code(word)
        for before, word, behind in _NAME.findall(words)
    )


def _calls_itself(name: str, words: str, parameters: str) -> bool:
    """Whether a macro with *parameters* stands for a call of what is called as itself, with other arguments ([cpp.rescan])."""
    if name not in words:
        return False
    calls = re.findall(rf"\b{re.escape(name)}\s*\(([^()]*)", words)
    handed = "".join(parameters.split()).replace("...", "__VA_ARGS__")
    return any("".join(call.split()) != handed for call in calls)


def _is_of_the_code(word: str) -> bool:
    is_quiet = word in _QUIET or _CAPITALS.fullmatch(word) is not None or _TYPE.fullmatch(word) is not None
    return not is_quiet or word in SPELLED
