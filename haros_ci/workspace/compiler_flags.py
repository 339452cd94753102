# SPDX-License-Identifier: Apache-2.0
"""Flags of compilers in files that no reader here looks at: presets of CMake, settings of colcon, Dockerfiles, packages of pkg-config.

By ``-include part.txt`` or ``-DX`` there, code is compiled that nothing has analysed.
"""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.workspace.build_flags import odd_flags

#: CMake's presets and what they include ("cmake-presets(7)"); colcon's packages, metadata and defaults (colcon.readthedocs.io, "Configuration").
_NAMES = regex(
    r"CMake\w*Presets\.json|.*presets?\.json|colcon\.pkg|.*\.meta|defaults\.ya?ml|.*colcon.*\.ya?ml|Dockerfile(?:\..*)?|.*\.[Dd]ockerfile",
    re.I,
)
#: What pkg-config reads (pc(5)), as it is or as a template; each line has a value behind a name.
_PACKAGE = regex(r".*\.pc(?:\.(?:in|cmake|em))?", re.I)
_VALUES = regex(
    r"^[ \t]*(?!(?:Name|Description|URL|Version|Requires|Conflicts)\b)[\w.]+[ \t]*[:=]((?:[^\n\\]|\\\r?\n|\\.){0,4000})",
    re.M,
)
_PLACE = regex(r"@\w{1,100}@")
#: Variables and options that change what is compiled.
_FLAGS = regex(
    r"(?<![A-Za-z0-9])CMAKE_(?:[A-Z]{1,8}_FLAGS|PROJECT_\w{0,80}INCLUDE|TOOLCHAIN_FILE|[A-Z]{1,8}_COMPILER_LAUNCHER)|(?<![A-Za-z0-9])(?:CPP|CXX|C)FLAGS\b"
    r"|(?<![\w-])--?(?:include|imacros)\b|\bCPLUS_INCLUDE_PATH\b"
    r"|(?<![\w-])-D(?:\s|[\"',])*(?!CMAKE_|BUILD_|DEBIAN_|[A-Z0-9_]*PYTHON)[A-Za-z_]"
    r"|\\u00[2-7]|\\x[2-7]"  # what is spelled so that nobody finds it
)


def may_have_flags(name: str) -> bool:
    """Whether a file called *name*, without directories, may tell a compiler what to compile, and nothing reads it."""
    return _NAMES.fullmatch(name) is not None or _PACKAGE.fullmatch(name) is not None


def has_flags(name: str, text: str) -> bool:
    """Whether *text* of a file called *name* sets flags or definitions for a compiler; of variables of CMake only those that hold some, of a package's flags only those that are not known to be harmless."""
    if _PACKAGE.fullmatch(name):
        text = _PLACE.sub("X", text)
        values = (value.replace("\\\n", " ").replace("\\\r\n", " ") for value in _VALUES.findall(text))
        return any(word for value in values for word in odd_flags(value))
    return _FLAGS.search(text) is not None
