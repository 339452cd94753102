# SPDX-License-Identifier: Apache-2.0
"""Programs that a process starts by way of others: ``bash -c "sleep 1 && ros2 run p e"``, ``env A=b ros2 run p e``."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.regex import regex

#: Commands of one process that are looked at, and how deep they may lie in each other.
MAX_COMMANDS = 20
_DEPTH = 4
_SHELLS = frozenset(("bash", "sh", "dash", "zsh", "ksh"))
#: Programs that start what their last words say, and words that stand before a command in a shell.
_BEFORE = frozenset(
    "env exec nice ionice nohup sudo stdbuf setsid time timeout command xterm taskset chrt then do else if while ! { (".split()
)
_SEPARATOR = regex(r"(?:&&|\|\||[;|&])\Z")
_BEGINS = frozenset(("ros2", "rosrun"))


def commands(words: list[str], split: Callable[[str], list[str]]) -> list[list[str]]:
    """The commands in *words*, each as it is started in the end; *split* parts a line as a shell does. One that starts no other is what it was."""
    found: list[list[str]] = []
    if len(words) == 1 and " " in words[0] and not words[0].startswith("$("):  # a whole line, for a shell
        words = split(words[0])
    _collect(words, split, found, 0)
    return found


def _collect(words: list[str], split: Callable[[str], list[str]], found: list[list[str]], depth: int) -> None:
    for part in _parts(words):
        if len(found) >= MAX_COMMANDS:
            return
        begin = _begin(part)
        name = part[begin].rpartition("/")[2] if begin < len(part) else ""
        line = _line_of(part[begin + 1 :]) if name in _SHELLS and depth < _DEPTH else None
        if line is not None:
            _collect(split(line), split, found, depth + 1)
        else:
            found.append(part[begin:] if name in _BEGINS else part)


def _parts(words: list[str]) -> list[list[str]]:
    """*words* parted where a shell begins another command; those of a program that is no shell stay together unless another command stands behind."""
    parts: list[list[str]] = [[]]
    for word in words:
        if _SEPARATOR.match(word):
            parts.append([])
            continue
        is_last = word.endswith(";") and len(word) > 1
        parts[-1].append(word[:-1] if is_last else word)
        if is_last:
            parts.append([])
    parts = [part for part in parts if part]
    started = [part for part in parts[1:] if part[_begin(part) :][:1] and part[_begin(part)] in _BEGINS]
    return parts if started else [words] if words else []


def _begin(words: list[str]) -> int:
    """Where the program's name stands behind ``env`` and the like, with their options and values."""
    at = 0
    while at < len(words) and words[at].rpartition("/")[2] in _BEFORE:
        inner = range(at + 1, len(words))
        known = (i for i in inner if words[i].rpartition("/")[2] in _BEFORE | _SHELLS | _BEGINS)
        at = next(known, len(words))
    return at if at < len(words) else 0


def _line_of(options: list[str]) -> str | None:
    """What ``-c`` gives to a shell."""
    for i, word in enumerate(options[:-1]):
        if word.startswith("-") and not word.startswith("--") and "c" in word:
            return options[i + 1]
        if not word.startswith("-"):
            return None
    return None
