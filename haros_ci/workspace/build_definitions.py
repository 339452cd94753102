# SPDX-License-Identifier: Apache-2.0
"""Macros that a build defines by flags: which of them have the name and the value of a setting, and which give a word of the code another meaning.

No linter is given them. A name in capitals with a number, a path or a text is a setting; ``kept=local`` and ``static=`` make other code of what is analysed.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from haros_ci.regex import regex

REFERENCE = r"\$\{[\w./+-]{1,100}\}"
_PLACE = regex(REFERENCE)
_REFERENCES = regex(r"\$?\{[\w./+-]{1,100}\}")
#: What a name of a macro is by custom: capitals, or capitals behind a name of a package (``rtde_EXPORTS``).
_NAME = regex(r"_*[A-Z][A-Z0-9_.+-]*|[A-Z]{2}\w*|[A-Za-z0-9_.+-]*(?:_+[A-Z]|[A-Z]+_)[A-Za-z0-9_.+-]*")
_JOINED = regex(r"\w\$?\{[^{}]{1,100}\}[a-z]")
_WORD = regex(r"[A-Za-z_]\w*")
_TRUTH = frozenset("ON OFF TRUE FALSE YES NO true false on off yes no".split())
#: A word that renames another one, wherever it stands in a command.
_RENAMES = regex(r"(?:-D)?([A-Za-z_]\w*)=([A-Za-z_]\w*|)")
#: A value by a generator expression that is a word itself.
_WORD_OF_GENEX = regex(r"=\$<(?:[^<>]|\$<[^<>]{0,200}>){0,200}:([A-Za-z_]\w*)>")
_CUT = regex(r"-D\w*\$<")
_BETWEEN = regex(r";|\s+(?=-)")
_IN_GENEX = regex(r"[\s;:<>$,]+")


def is_macro_name(name: str) -> bool:
    """Whether *name* is that of a macro by custom; what a variable stands for is taken for a word."""
    return _NAME.fullmatch(_REFERENCES.sub("x", name)) is not None


def odd_definitions(text: str) -> Iterator[str]:
    """The definitions in an argument, without ``-D`` or with it, that are not known to be settings; what a variable alone stands for is one."""
    if "$<" in text:
        if any(_is_odd(word) for word in _IN_GENEX.split(_PLACE.sub("{x}", text)) if "=" in word) or any(
            word not in _TRUTH for word in _WORD_OF_GENEX.findall(text)
        ):
            yield text
        return
    yield from (part for part in _BETWEEN.split(text) if _is_odd(part))


def put_together(text: str) -> bool:
    """Whether a flag ``-D`` in *text* gets its value, or the rest of its name, from a generator expression that has a word for it."""
    return "-D" in text and (
        _CUT.search(text) is not None or any(w not in _TRUTH for w in _WORD_OF_GENEX.findall(text))
    )


def odd_flag(word: str) -> bool:
    """Whether *word* is a flag that defines what is not known to be a setting."""
    return word.startswith("-D") and word != "-D" and _is_odd(word)


def renamings(texts: Iterable[str], *, are_kept: bool) -> Iterator[str]:
    """What in the arguments *texts* of any command would rename a word of the code, were it a definition.

    Where a variable keeps them (*are_kept*), a name in capitals with a value in small letters is one, too: elsewhere it is a test's environment.
    """
    for text in texts:
        if "=" in text:
            for word in re.split(r"[\s;]+", text):
                found = _RENAMES.fullmatch(word)
                if found is None or found[2] in _TRUTH:
                    continue
                if not is_macro_name(found[1]) or (are_kept and found[2].islower()):
                    yield word


def _is_odd(part: str) -> bool:
    part = part.strip()
    if part.startswith(("-", "/")) and not part.startswith("-D"):
        return False
    name, equals, value = part.removeprefix("-D").partition("=")
    if not equals and (not name or _REFERENCES.fullmatch(name)):
        return False
    if not equals and _JOINED.search(name):
        return True  # what a variable stands for may be the sign between
    is_word = _WORD.fullmatch(value) is not None and value not in _TRUTH
    return is_word or not is_macro_name(name)
