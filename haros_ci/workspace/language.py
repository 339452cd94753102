# SPDX-License-Identifier: Apache-2.0
"""Which language a file is in, by its name or its first line."""

from __future__ import annotations

import re

from haros_ci.regex import regex

#: How much of a file script_language wants to see.
HEAD = 128

NAMES = {
    "CMakeLists.txt": "cmake",
    "package.xml": "package",
    "setup.cfg": "setup",
    "model.config": "world",
    **dict.fromkeys(("Dockerfile", "Containerfile"), "dockerfile"),
}

#: Launch files by both conventions, ``x.launch.xml`` and ``x_launch.xml``; Python ones are Python.
LAUNCH_ENDINGS = tuple(f"{mark}launch.{kind}" for mark in "._" for kind in ("xml", "yaml", "yml"))

SUFFIXES = {
    **dict.fromkeys(("c", "cc", "cpp", "cxx", "c++", "h", "hh", "hpp", "hxx", "h++"), "cpp"),
    **dict.fromkeys(("ipp", "tpp", "txx", "inl", "cu", "cuh"), "cpp"),
    **dict.fromkeys(("py", "pyw"), "python"),
    "launch": "launch",
    "cmake": "cmake",
    "cfg": "setup",
    **dict.fromkeys(("yaml", "yml"), "yaml"),
    **dict.fromkeys(("msg", "srv", "action"), "interface"),
    **dict.fromkeys(("xml", "urdf", "xacro", "srdf", "sdf"), "xml"),
    **dict.fromkeys(("world", "gazebo"), "world"),
    **dict.fromkeys(("sh", "bash"), "shell"),
    "dockerfile": "dockerfile",
    "md": "markdown",
    "hpl": "hpl",
}

#: Environment hooks that are templates or of ament's own form, and files of environment variables.
_ENVIRONMENT = regex(r".*\.(?:(?:sh|bash)(?:\.develspace)?\.(?:em|in)|dsv(?:\.in)?|env)|(?:.*\.)?env\.\w+|\.env")

#: ``#!/usr/bin/python3``, ``#!/usr/bin/env python``, ``#!/usr/bin/env -S python3 -u``, ``#!/usr/bin/env --split-string="python3"``, ``#!/bin/sh -e``
_SHEBANG = regex(
    rb"#![ \t]*(?:\S*/env[ \t]+(?:-\S+[ \t]+|\w+=\S*[ \t]+)*(?:-\w{0,8}S|--split-string=)?)?"
    rb"[\"']?(?:[^\s\"']*/)?(?:(python|pypy)[\d.]*|(?:ba|da|k)?sh)(?:[\s\"']|$)"
)


#: Templates of which CMake writes descriptions: the ending of what is written, perhaps a word, and that of a template.
_DESCRIPTION = regex(r".+\.(?:urdf|xacro|sdf|world|gazebo|model|xml)(?:\.\w{1,30})?\.(?:in|cmake|template|tmpl)")


_KEPT = regex(r".+(?:\.(?:bak|backup|old|orig|rej|sav|save|swp|tmp)[\d_-]{0,20}|~)", re.IGNORECASE)


def language_of(name: str) -> str | None:
    """The language that the file name *name* (without directories) tells; None if it tells none."""
    if name in NAMES:
        return NAMES[name]
    if name.endswith(LAUNCH_ENDINGS):
        return "launch"
    return "dockerfile" if name.startswith("Dockerfile.") else SUFFIXES.get(suffix_of(name))


def sets_environment(name: str) -> bool:
    """Whether a file called *name* may set environment variables, as data that no tool reads."""
    return _ENVIRONMENT.fullmatch(name) is not None


def describes(name: str) -> bool:
    """Whether a file called *name* is a template of a description of robots or worlds, as data that no tool reads."""
    return _DESCRIPTION.fullmatch(name) is not None


def suffix_of(name: str) -> str:
    """What follows the last dot, in lower case; "" if there is no dot but perhaps a leading one."""
    stem, _, suffix = name.rpartition(".")
    return suffix.lower() if stem else ""


def is_kept_copy(name: str) -> bool:
    """Whether a file called *name* is a copy that somebody, an editor or git has kept of another one (``node.py.bak``): no source, whatever it begins with."""
    return _KEPT.fullmatch(name) is not None


def script_language(head: bytes) -> str | None:
    """``python`` or ``shell`` if a file that begins with *head* asks for such an interpreter."""
    found = _SHEBANG.match(head)
    return None if found is None else "python" if found[1] else "shell"
