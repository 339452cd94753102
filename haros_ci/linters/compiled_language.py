# SPDX-License-Identifier: Apache-2.0
"""Files of C by their names that a build compiles as C++: CMake's property ``LANGUAGE`` says so (cmake-properties(7)), and linters go by names."""

from __future__ import annotations

import re

from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments

_SET = regex(r"\b(?:set_source_files_properties|set_property)\s*\(([^()]{1,20000})\)", re.I)
_AS_CPP = regex(r"(?<!\w)LANGUAGE[\s\"\];]+[\[\"=]*CXX\b")
_WORD = regex(r"[^\s\";\[\]]{1,1000}")


def compiled_as_cpp(workspace: Workspace) -> frozenset[str]:
    """The paths of such files of *workspace*: all ``.c`` of a package where a variable names them."""
    every = [file for file in workspace.files if file.language == "cpp" and file.path.endswith(".c")]
    found: set[str] = set()
    for lists in workspace.files if every else ():
        if lists.language != "cmake" or "LANGUAGE" not in (text := workspace.text(lists.path)):
            continue
        for words in _SET.findall(without_comments(text, "cmake")):
            if _AS_CPP.search(words) is None:
                continue
            names = {word.rpartition("/")[2] for word in _WORD.findall(words)}
            own = [file.path for file in every if file.package == lists.package]
            if any("$" in name or "*" in name for name in names):
                found.update(own)
            elsewhere = [file.path for file in every if file.package != lists.package]
            for name in names:
                near = [path for path in own if path.rpartition("/")[2] == name]
                found.update(near or [path for path in elsewhere if path.rpartition("/")[2] == name])
    return frozenset(found)
