# SPDX-License-Identifier: Apache-2.0
"""Flags of compilers that change warnings, speed and the dialect alone; all others may make a compiler read another file (gcc(1), clang(1))."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.regex import regex
from haros_ci.workspace.build_definitions import REFERENCE, odd_definitions, odd_flag, put_together

_PATH = rf"(?:[\w./+~:\"\\-]|{REFERENCE})"
#: What the code is written in, or which of its words are keywords, is not for a flag to say: linters read UTF-8, and C++ as it is by default.
_READS_OTHERWISE = r"(?:input-charset=(?!(?i:utf-?8)\Z)|directives-only|(?:no-)?operator-names|(?:no-)?asm\Z|(?:no-)?gnu-keywords|no-char8|traditional)"
#: Sizes of types and the sign of char are what linters take them to be (gcc(1), "Code Gen Options", "x86 Options"); names are what the code calls them (ld(1)).
_SIZES = r"short-(?:enums|wchar|double)|pack-struct|unsigned-(?:char|bitfields)|no-signed-(?:char|bitfields)"
_OTHER_MACHINE = r"(?:32|x32|16|iamcu|ilp32|abi=ilp32\w*|long-double-\w+|data-model=\w+)\Z"
_OF_SIZES = regex(rf"-f(?:{_SIZES})(?:=\d+)?|-m{_OTHER_MACHINE}")
_RENAMES = r"[^\s]*(?:--?(?:defsym|wrap|just-symbols)\b|,-T|,@)"
#: What a flag may be. A word without a dash is a name, a path or a keyword; behind a flag that is not here it is named with that.
_HARMLESS = regex(
    rf"-W(?![pa],|{_RENAMES})[\w=+#,./:${{}}-]*|-O\w*|-g[\w-]*|-g\w+=\w+|-std=(?:[\w+]|{REFERENCE})+|-pedantic(?:-errors)?|-pg|-pipe|-pthreads?|-ansi|-rdynamic|-pie|-diag[\w-]*|-static[\w+-]*|-shared|-coverage|--coverage"
    rf"|-f(?!plugin|module|include|preprocess|{_READS_OTHERWISE}|{_SIZES})[\w+-]+(?:=[\w.,+-]*)?|-f\w+-prefix-map=\S*|-m(?!{_OTHER_MACHINE})[\w.+-]+(?:=[\w.,+${{}}-]+)?|-l\S*|-L\S*|-I{_PATH}*|-isystem{_PATH}*|-iquote{_PATH}*|-D[\w.+-]*(?:=(?:{_PATH}|[,@*])*)?|-U\w*|-[AC-WYZac-wyz]|-undefined|-Qunused-arguments"
    rf"|-no-?\w+|--?param=?\S*|-arch|-framework|-Xlinker|-rpath\S*|-Bstatic|-Bdynamic|-gencode\S*|--?expt-[\w-]+|-std|--compiler-options|-Xcompiler\S*|-dev|/(?!FI|Y|clang)[A-Z]\S*|--",
    re.DOTALL,
)
#: What a macro may be: a number, a name, a path or a text; code and the name of what is included are neither.
_PLAIN = regex(
    r"\s*(?:-[DU])?[\w.+-]*(?:=(?:[\w.+:/,@~*-]*|'?(?:\\*\")[^\"()]*(?:\\*\")'?))?(?:\s+-[DU][\w.+-]*(?:=[\w.+:/,-]*)?)*\s*",
    re.DOTALL,
)
_OTHER = regex(
    r"-\d[\w.]*|@\w+@|--(?!include|imacros|language|config|specs|sysroot|defsym|wrap|just-symbols)[\w=./-]+|-(?=\Z)"
)
#: CMake's word for what is handed to the linker ("target_link_options").
_LINKER = regex(r"\ALINKER:(?:SHELL:)?")
_BETWEEN = regex(r"[\s;]+")
_IN_GENEX = regex(r"[\s;:<>$]+|,(?=\$|>|-)")


def odd_flags(text: str, *, are_definitions: bool = False) -> Iterator[str]:
    """The words of an argument that may be flags and are not known to be harmless; *are_definitions* says that words without a dash define macros."""
    if are_definitions:
        odd = next(odd_definitions(text), "")
        if odd or ("=" in text and "$<" not in text and not _has_plain_values(text)):
            yield odd or text
            return
    if "$<" in text:
        if put_together(text):
            yield text
            return
        text = re.sub(REFERENCE, "X", text)
        words = [word for word in _IN_GENEX.split(text) if word.startswith(("-", "@"))]
        yield from (word for word in words if not _is_harmless(word) or odd_flag(word))
        return
    words = [_LINKER.sub("-Wl,", word.removeprefix("SHELL:")) for word in _BETWEEN.split(text) if word]
    for word, after in zip(words, [*words[1:], ""], strict=True):
        is_odd = word.startswith(("-", "@", "/FI", "/Y")) and not _is_harmless(word) and not _OTHER.fullmatch(word)
        is_odd |= odd_flag(f"-D{after}" if word == "-D" else word)
        if is_odd or text == "-":
            yield f"{word} {after}".strip()


#: What such a flag does.
OF_SIZES = "changes the size or the sign of types, which linters do not take into account"


def changes_sizes(word: str) -> bool:
    """Whether the *word* is a flag that changes what types are, and nothing that is read."""
    return _OF_SIZES.fullmatch(word) is not None


def _has_plain_values(text: str) -> bool:
    """Whether what *text* gives macros are numbers, names, paths and texts."""
    return all(_PLAIN.fullmatch(part) for part in re.sub(REFERENCE, "x", text).split(";"))


def _is_harmless(word: str) -> bool:
    return _HARMLESS.fullmatch(word) is not None
