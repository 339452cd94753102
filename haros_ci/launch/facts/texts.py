# SPDX-License-Identifier: Apache-2.0
"""Files, packages and absolute paths that a text of a launch file names."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.regex import regex

#: A directory as launch text has it, and the path behind it. ROS 1: ``$(find pkg)``, ``$(workspace)``.
_MARKED = regex(
    r"\$\((find-pkg-share|find-pkg-prefix|find|workspace)(?: ([^\s()?\ue000]+))?\)((?:/[^\s'\";,:=|&<>`$(){}\[\]*?!%\\\ue000]*)*)"
)
_PACKAGE = regex(r"\$\((?:find-pkg-share|find-pkg-prefix|find) ([^\s()?\ue000]+)\)")
_END = regex(r"[\s'\",;:)\]}]|\Z")
_SUFFIX = regex(r"[A-Za-z][A-Za-z0-9_]{0,11}")
#: A command whose program is xacro, by its name or its place; and one that runs a program of a package.
_XACRO = regex(r"\s*(?:/[\w./-]*/)?xacro(?=\s|$)")
_RUN = regex(r"\s*(?:ros2\s+run|rosrun)\s+(\w+)(?=\s)", re.ASCII)
_WORD = regex(r"(?<![^\s'\"=:,\[(])(?:file://)?(~|/)([^\s'\"$?\ue000,;:\])]*)(?=[\s'\",;:\])]|\Z)")
_HOME = regex(r"~(/|\Z)|/(home|Users)/[^/]+/|/root/")
#: Where programs and devices of every machine lie.
_SYSTEM = tuple(f"/{name}/" for name in "dev tmp opt usr etc proc sys var bin sbin lib run mnt media".split())


def without_comments(text: str) -> str:
    """*text*, which may be that of a whole robot description, without the comments of XML: what they name nothing reads."""
    at = text.find("<!--")
    parts, last = [], 0
    while at >= 0:
        end = text.find("-->", at + 4)
        if end < 0:
            break
        parts.append(text[last:at])
        last = end + 3
        at = text.find("<!--", last)
    return "".join((*parts, text[last:]))


def named_files(text: str) -> Iterator[tuple[str, bool]]:
    """The paths below packages in *text*, each as it begins (``$(find-pkg-share pkg)/x``), and whether all of it is known."""
    if "$(" not in text:
        return
    for match in _MARKED.finditer(text):
        yield match[0].rstrip("/."), bool(_END.match(text, match.end()))


def is_file_name(path: str) -> bool:
    """Whether *path* ends in the name of a file: with a suffix."""
    stem, _, suffix = path.rpartition("/")[2].rpartition(".")
    return bool(stem) and _SUFFIX.fullmatch(suffix) is not None


def named_packages(text: str) -> Iterator[str]:
    """The packages in *text* whose directories are asked for."""
    if "$(" in text:
        yield from (match[1] for match in _PACKAGE.finditer(text))


def package_run(command: str) -> str:
    """The package whose program the *command* runs, where its name alone tells: xacro, and ``ros2 run`` and ``rosrun`` of a package; else ""."""
    if _XACRO.match(command) is not None:
        return "xacro"
    found = _RUN.match(command)
    return found[1] if found is not None else ""


def absolute_paths(text: str, is_path: bool = False) -> Iterator[tuple[str, str]]:
    """Pairs of ``home`` or ``absolute`` and a path in *text* that is surely one.

    That is one below ``/home``, else one with a file's suffix, outside of the directories that every machine has; ROS names
    (``~/input``, ``/clock@pkg/msg/T[gz.msgs.T``) are none. With *is_path* the whole text is one.
    """
    if "/" not in text and "~" not in text:
        return
    for match in _WORD.finditer(text):
        path = match[1] + match[2]
        if (match[1] == "~") != match[2].startswith("/") or "@" in path:  # ~user, or //host; topic@type of a bridge
            continue
        if _HOME.match(path):
            if is_file_name(path) or is_path or path.startswith(("/home/", "/Users/")):  # ~/x is a name, too
                yield "home", path
        elif match[1] == "/" and not path.startswith(_SYSTEM) and path.count("/") > 1:
            if is_file_name(path) or (is_path and path.strip("/")):
                yield "absolute", path
