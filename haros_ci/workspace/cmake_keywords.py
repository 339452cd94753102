# SPDX-License-Identifier: Apache-2.0
"""Arguments sorted under the keywords that precede them, as nearly every command of CMake has them."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from haros_ci.workspace.cmake_words import bare


def under(
    words: Iterable[str], flags: Collection[str], single: Collection[str], multiple: Collection[str]
) -> dict[str, list[str]]:
    """*words* by keyword; those before any, after a flag or a single value under ``""``; a given flag has ``[]``."""
    found: dict[str, list[str]] = {"": []}
    current, room = "", -1
    for word in words:
        plain = bare(word)
        if plain in flags:
            found.setdefault(plain, [])
            current, room = "", -1
        elif plain in single or plain in multiple:
            found.setdefault(plain, [])
            current, room = plain, 1 if plain in single else -1
        else:
            if not room:
                current, room = "", -1
            found.setdefault(current, []).append(word)
            room -= 1
    return found
