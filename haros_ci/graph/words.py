# SPDX-License-Identifier: Apache-2.0
"""The command line of a node: words, private parameters, remappings (wiki.ros.org/Remapping Arguments)."""

from __future__ import annotations

import shlex
from math import isfinite

from haros_ci.records import dataclass
from haros_ci.regex import regex


@dataclass(frozen=True, slots=True)
class CommandLineArguments:
    """``_name:=value`` and ``from:=to`` as pairs, ``__name:=value`` as pairs, and what the program itself is given."""

    private: tuple[tuple[str, str], ...]
    remaps: tuple[tuple[str, str], ...]
    special: tuple[tuple[str, str], ...]
    rest: tuple[str, ...]


#: A remapping rule of ROS 2 as it may stand among the other arguments of a program (rcl ``rcl_parse_arguments``, "in its deprecated form"); ``?`` is not known.
_TOKENS = r"[A-Za-z_?][\w?]*(?:/[A-Za-z_?][\w?]*)*"
_NAME = rf"(?:rostopic://|rosservice://)?(?:/|~/)?{_TOKENS}"
_BARE_RULE = regex(
    rf"(?:[A-Za-z_?][\w?]*:)?(?:(?:__node|__name):=[A-Za-z_?][\w?]*|__ns:=(?:/|[/?]{_TOKENS})|(?!__(?:node|name|ns):=){_NAME}:={_NAME})"
)
#: A directory as paths in values begin with it, of a package or of the workspace: one word.
_FOUND = regex(r"\$\([\w-]+ [^()\n]{0,300}\)")

#: Stands in a word of a command line for a part that is not known, where it is certain that the word is one.
PART = "\ue003"
_QUOTED = regex(r"'[^']*'|\"[^\"]*\"")


def with_parts(text: str, words: tuple[str, ...]) -> tuple[str, ...]:
    """*words* of *text* with ``PART`` for what is not known in them, if all that is not known stands in quotes: it may be several words elsewhere."""
    if "?" not in text or "?" in _QUOTED.sub("", text):
        return words
    return tuple(word.replace("?", PART) for word in words)


def shell_words(text: str) -> list[str]:
    """*text* as a shell has it; where its quotes do not match, what is between spaces. ``$(find p)/x`` is one word."""
    text = _FOUND.sub(lambda found: found[0].replace(" ", "\0"), text)
    try:
        words = shlex.split(text)
    except ValueError:
        words = text.split()
    return [word.replace("\0", " ") for word in words]


def split(text: str) -> CommandLineArguments:
    """The words of *text* (``shell_words``) by what they are."""
    words = shell_words(text)
    private: list[tuple[str, str]] = []
    remaps: list[tuple[str, str]] = []
    special: list[tuple[str, str]] = []
    rest: list[str] = []
    for word in words:
        left, assigned, right = word.partition(":=")
        if not assigned:
            rest.append(word)
        elif left.startswith("__"):
            special.append((left[2:], right))
        elif left.startswith("_"):
            private.append((left[1:], right))
        else:
            remaps.append((left, right))
    return CommandLineArguments(tuple(private), tuple(remaps), tuple(special), tuple(rest))


def scalar(text: str) -> int | float | bool | str:
    """The value of a parameter on the command line: a number or a truth value where it looks like one."""
    if "_" not in text:
        for kind in (int, float):
            try:
                value = kind(text)
            except ValueError:
                continue
            return value if isfinite(value) else text
    return {"true": True, "false": False}.get(text.lower(), text)


def is_rule(word: str) -> bool:
    """Whether a *word* among the arguments of a program is a remapping rule of ROS 2."""
    return _BARE_RULE.fullmatch(word) is not None
