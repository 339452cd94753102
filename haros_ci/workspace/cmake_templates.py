# SPDX-License-Identifier: Apache-2.0
"""Templates of which ``configure_file()`` makes files, by the texts of CMake files: nothing is evaluated, and files are matched by their names without directories."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.workspace.language import language_of

_CONFIGURED = regex(
    r"\bconfigure_(?:package_config_)?file\s*\(\s*\"?([^\s()\"]{1,400})\"?\s+\"?([^\s()\"]{1,400})\"?", re.I
)
#: What is put behind ``.cmake`` in the name of a template: CMake's endings, and catkin's for the devel space and the installed one.
_OF_CMAKE = regex(r".+\.cmake(?:\.(?:develspace|installspace))?\.(?:in|em)")
#: What a template has and CMake does not read: a line that is a variable or a command of empy, and what stands for a value.
_LINES = regex(r"^[ \t]*(?:@\w+@[ \t]*|@\[.*)\r?$", re.M)
_VALUES = regex(r"@(\w+)@|@\([^()\n]{0,200}(?:\([^()\n]{0,200}\)[^()\n]{0,200}){0,8}\)|@\{[^{}\n]{0,200}\}")


def configured(text: str) -> Iterator[tuple[str, str]]:
    """The names, without directories, of what the CMake *text* makes a file of, and of that file."""
    for source, target in _CONFIGURED.findall(text):
        yield source.rpartition("/")[2], target.rpartition("/")[2]


def cmake_templates(workspace: Workspace) -> tuple[str, ...]:
    """The paths, sorted, of files of *workspace* that become CMake files and are called otherwise."""
    named = {
        source
        for file in workspace.files
        if file.language == "cmake" and "configure_" in (text := workspace.text(file.path))
        for source, target in configured(text)
        if language_of(target) == "cmake"
    }
    found = (
        path
        for path in workspace.names
        if language_of(name := path.rpartition("/")[2]) != "cmake" and (name in named or _OF_CMAKE.fullmatch(name))
    )
    return tuple(sorted(found))


def as_cmake(text: str) -> str:
    """The *text* of a template as CMake, with a variable for what is put in; lines stay."""
    return _VALUES.sub(lambda found: f"${{{found[1] or 'x'}}}", _LINES.sub("", text))
