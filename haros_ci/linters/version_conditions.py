# SPDX-License-Identifier: Apache-2.0
"""Conditions on versions to which cppcheck has an answer that compilers do not give.

For cppcheck every library is as new as a test asks for, and the compiler is GCC 13.2 (:mod:`ros_macros`). A version that no library has
makes the other branch the one that is compiled; so does a test that another GCC of the platforms of ROS answers otherwise.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import NamedTuple

from haros_ci.linters.ros_macros import PLATFORM, TRUE_TESTS, VERSION_NUMBERS
from haros_ci.model.preprocessor_conditions import holds
from haros_ci.regex import regex

_DIRECTIVE = regex(r"^[ \t]*(?:#|%:)[ \t]*(if|ifdef|ifndef|elif|elifdef|elifndef|else|endif)\b([^\n]*)", re.M)
_TEST = regex(rf"\b({'|'.join((*TRUE_TESTS, *VERSION_NUMBERS))})\s*\(([^()]*)\)")
_NUMBER = regex(r"\d+")
#: Behind the first number of a version of these there is none; 60 for the others. (ROS 1 ended with 1.17.)
_NEVER = {
    **{"ROS_VERSION_MINIMUM": 2, "PCL_VERSION_COMPARE": 3, "PCL_VERSION_CALC": 3, "GLIB_CHECK_VERSION": 3},
    **{"GST_CHECK_VERSION": 3, "GTK_CHECK_VERSION": 7, "EIGEN_VERSION_AT_LEAST": 20, "QT_VERSION_CHECK": 9},
}
_NO_VERSION = 60
#: The compilers of the platforms of ROS since Humble, and newer ones.
_OF_GCC = regex(r"\b__GNU(?:C__|G__|C_MINOR__|C_PATCHLEVEL__)|\b__VERSION__")
_VERSIONS = (("11", "4", "0"), ("13", "3", "0"), ("14", "2", "0"), ("15", "1", "0"))
#: Conditions of one text that are looked at, and branches of one.
_MOST_CHAINS, _MOST_BRANCHES = 200, 20
_CODE = regex(r"^(?![ \t]*(?:#|%:))[^\n]*[;{}]", re.M)


class Branch(NamedTuple):
    """A branch: its condition as ``#if`` would have it, and where its text begins and ends."""

    condition: str
    begin: int
    end: int


def version_conditions(code: str) -> Iterator[str]:
    """Those in *code*, without comments and with spliced lines joined, by what they ask, in words; takes linear time."""
    if _TEST.search(code) is not None:
        for match in _DIRECTIVE.finditer(code):
            for name, words in _TEST.findall(match[2]):
                numbers = [int(number[:9]) for number in _NUMBER.findall(words)]
                if numbers and numbers[0] >= _NEVER.get(name, _NO_VERSION):
                    yield f"a condition on a version that there is not ({name})"
    if _OF_GCC.search(code) is not None and any(_is_read_otherwise(code, chain) for chain in chains(code, _OF_GCC)):
        yield "a condition on the version of the compiler"


def chains(code: str, asks: re.Pattern[str]) -> Iterator[list[Branch]]:
    """The branches of each ``#if`` of which a condition, or that of one of its ``#elif``, *asks* for it; the first ones of many."""
    return (chain[:_MOST_BRANCHES] for chain in islice(_chains(code, asks), _MOST_CHAINS))


def has_code(code: str, branches: Iterable[Branch]) -> bool:
    """Whether more than directives stand in one of *branches*."""
    return any(_CODE.search(code, branch.begin, branch.end) for branch in branches)


def _chains(code: str, asks: re.Pattern[str]) -> Iterator[list[Branch]]:
    stack: list[list[Branch]] = []
    for match in _DIRECTIVE.finditer(code):
        word = match[1]
        if word.startswith("if"):
            stack.append([])
        if not stack:
            continue
        chain = stack[-1]
        if chain:
            chain[-1] = chain[-1]._replace(end=match.start())
        if word == "endif":
            stack.pop()
            if any(asks.search(branch.condition) for branch in chain):
                yield chain
        else:
            condition = (
                match[2] if word in ("if", "elif") else "1" if word == "else" else f"defined({match[2].strip()})"
            )
            chain.append(Branch(f"!{condition}" if word.endswith("ndef") else condition, match.end(), match.start()))


def _is_read_otherwise(code: str, chain: list[Branch]) -> bool:
    """Whether some GCC compiles a branch with code in it that cppcheck does not look at, by the version alone."""
    given = {name: value for name, value in PLATFORM.items() if name != "__VERSION__"}
    for at, branch in enumerate(chain):
        if not _OF_GCC.search(branch.condition):
            continue
        known = holds(branch.condition, given, frozenset())
        others = [
            holds(
                branch.condition,
                {**given, "__GNUC__": a, "__GNUG__": a, "__GNUC_MINOR__": b, "__GNUC_PATCHLEVEL__": c},
                frozenset(),
            )
            for a, b, c in _VERSIONS
        ]
        if all(other == known for other in others):
            continue
        unread = chain[at + 1 :] if known else [branch]
        if has_code(code, unread):
            return True
    return False
