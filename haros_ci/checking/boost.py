# SPDX-License-Identifier: Apache-2.0
"""The keys of rosdep for the parts of Boost: a part that is a library has a key of its own, which brings the headers, too."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.checking.project import ProjectPackage
from haros_ci.regex import regex

#: The headers, and what brings every part.
HEADERS, WHOLE = "libboost-dev", "boost"
#: Keywords that find_package() takes after REQUIRED besides components.
_WORDS = frozenset(
    "REQUIRED QUIET EXACT MODULE CONFIG NO_MODULE COMPONENTS OPTIONAL_COMPONENTS NO_POLICY_SCOPE GLOBAL NAMES CONFIGS HINTS PATHS".split()
)
_VERSION = regex(r"[\d.<>=]+")
#: Parts without a library.
_PLAIN = frozenset(("headers", "boost"))


def boost_keys(package: ProjectPackage) -> tuple[str, ...]:
    """What *package* is to declare for the parts of Boost that its CMake asks for; the headers where it asks for none.

    One key for all where a part has none of its own.
    """
    knowledge = package.project.knowledge
    parts = sorted({re.sub(r"_", "-", part.lower()) for part in _parts(package)} - _PLAIN)
    keys = [_key(part) for part in parts]
    if not keys:
        return (HEADERS,)
    return tuple(dict.fromkeys(keys)) if all(map(knowledge.is_key, keys)) else (WHOLE,)


def brings_boost(package: ProjectPackage) -> frozenset[str]:
    """The keys of rosdep that bring Boost's headers, alone or with parts."""
    return package.project.knowledge.keys_like(r"boost|libboost-(?:[a-z-]+-)?(?:all-)?dev")


def _key(part: str) -> str:
    python = re.fullmatch(r"(python|numpy)[\d.]*", part)
    return f"libboost-{python[1] if python is not None else part}-dev"


def _parts(package: ProjectPackage) -> Iterator[str]:
    for command in package.commands("find_package"):
        if (
            command.arguments[:1] != ("Boost",)
            or command.is_conditional
            or command.is_test
            or "REQUIRED" not in command.arguments
        ):
            continue
        for word in (*command.after("COMPONENTS", *_WORDS), *command.after("REQUIRED", *_WORDS)):
            if _VERSION.fullmatch(word) is None and "$" not in word:
                yield word
