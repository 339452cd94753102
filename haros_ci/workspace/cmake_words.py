# SPDX-License-Identifier: Apache-2.0
"""CMake's values: lists in one string, what is not known in them, and places as paths."""

from __future__ import annotations

import posixpath
import re

from haros_ci.regex import regex

#: Stands before an element that is there in some branches of an undecided condition only.
MAYBE = "\ue000"
#: Stands for the ``$`` of a reference whose value only a build knows: ``<UNKNOWN>{Eigen3_LIBRARIES}``.
UNKNOWN = "\ue001"
#: The workspace and the build tree as absolute paths.
SOURCE_ROOT = "/\ue002"
BINARY_ROOT = "/\ue003"

_PRIVATE = regex("[\ue000-\ue007]")
_FALSE = frozenset(("", "0", "OFF", "NO", "FALSE", "N", "IGNORE", "NOTFOUND"))
_TRUE = frozenset(("1", "ON", "YES", "TRUE", "Y"))
_NUMBER = regex(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)\Z", re.ASCII)


def cleaned(text: str) -> str:
    """Text of a file without the characters that mean something here."""
    return text if text.isascii() else _PRIVATE.sub("?", text)


def readable(value: str) -> str:
    """*value* as a person would write it: without marks, unknown references as ``${NAME}``, places relative."""
    value = value.replace(f"{SOURCE_ROOT}/", "").replace(SOURCE_ROOT, ".")
    value = value.replace(f"{BINARY_ROOT}/", "build/").replace(BINARY_ROOT, "build")
    return value.replace(MAYBE, "").replace(UNKNOWN, "$")


def written(value: str) -> str:
    """*value* without marks, unknown references as ``${NAME}``, the workspace as ``${ROOT}`` and the build tree as ``${BUILD}``."""
    if value.isascii():
        return value
    value = value.replace(SOURCE_ROOT, "${ROOT}").replace(BINARY_ROOT, "${BUILD}")
    return value.replace(MAYBE, "").replace(UNKNOWN, "$")


def unknown(name: str) -> str:
    """The value of a variable that is not known."""
    return f"{UNKNOWN}{{{name}}}"


def is_certain(value: str) -> bool:
    """Whether nothing in *value* depends on what is not known."""
    return MAYBE not in value and UNKNOWN not in value


def split_list(value: str) -> list[str]:
    r"""The elements, empty ones included: ``;`` separates unless escaped or in square brackets (cmake-language(7))."""
    if ";" not in value:
        return [value] if value else []
    if "[" not in value and "\\" not in value:
        return value.split(";")
    found: list[str] = []
    part: list[str] = []
    depth = 0
    previous = ""
    for character in value:
        if character == ";" and previous == "\\":
            part[-1] = ";"
        elif character == ";" and not depth:
            found.append("".join(part))
            part = []
        else:
            depth += (character == "[") - (character == "]" and depth > 0)
            part.append(character)
        previous = character
    found.append("".join(part))
    return found


def join_list(elements: list[str]) -> str:
    """The list as one string."""
    return ";".join(elements)


def bare(element: str) -> str:
    """An element without the mark of doubt."""
    return element[1:] if element[:1] == MAYBE else element


def merge(values: list[str | None]) -> str | None:
    """One value for what a variable may have after the branches of an undecided condition.

    What all have stays as it is; other elements are kept in order, once, marked as doubtful.
    """
    first = values[0]
    if all(value == first for value in values):
        return first
    lists = [[bare(element) for element in split_list(value or "")] for value in values]
    doubtful = {e[1:] for value in values for e in split_list(value or "") if e[:1] == MAYBE}
    certain = set(lists[0]).intersection(*lists[1:]) - doubtful
    merged: dict[str, None] = {}
    for elements in lists:
        merged.update(dict.fromkeys(elements))
    return join_list([element if element in certain else MAYBE + element for element in merged])


def truth(value: str) -> bool | None:
    """True or False for a constant of ``if``; None for any other word."""
    upper = value.upper()
    if upper in _TRUE:
        return True
    if upper in _FALSE or upper.endswith("-NOTFOUND"):
        return False
    return float(value) != 0 if len(value) < 40 and _NUMBER.match(value) else None


def place(path: str, directory: str) -> str:
    """*path* as CMake resolves it against *directory*, normalised."""
    joined = path if path.startswith("/") else f"{directory}/{path}"
    normal = posixpath.normpath(joined)
    return normal[1:] if normal.startswith("//") else normal


def inside(path: str) -> str | None:
    """The root-relative path of an absolute one; None if it is not in the source tree."""
    if path == SOURCE_ROOT:
        return "."
    return path[len(SOURCE_ROOT) + 1 :] if path.startswith(f"{SOURCE_ROOT}/") else None


def absolute(path: str) -> str:
    """A root-relative path as CMake sees it."""
    return SOURCE_ROOT if path == "." else f"{SOURCE_ROOT}/{path}"
