# SPDX-License-Identifier: Apache-2.0
"""Flags of compilers in files that no reader here looks at: presets of CMake, settings of colcon, Dockerfiles.

By ``-include part.txt`` or ``-DX`` there, code is compiled that nothing has analysed.
"""

from __future__ import annotations

import re

#: CMake's presets and what they include ("cmake-presets(7)"); colcon's packages, metadata and defaults (colcon.readthedocs.io, "Configuration").
_NAMES = re.compile(
    r"CMake\w*Presets\.json|.*presets?\.json|colcon\.pkg|.*\.meta|defaults\.ya?ml|.*colcon.*\.ya?ml|Dockerfile(?:\..*)?|.*\.[Dd]ockerfile",
    re.I,
)
#: Variables and options that change what is compiled.
_FLAGS = re.compile(
    r"(?<![A-Za-z0-9])CMAKE_(?:[A-Z]{1,8}_FLAGS|PROJECT_\w{0,80}INCLUDE|TOOLCHAIN_FILE|[A-Z]{1,8}_COMPILER_LAUNCHER)|(?<![A-Za-z0-9])(?:CPP|CXX|C)FLAGS\b"
    r"|(?<![\w-])--?(?:include|imacros)\b|\bCPLUS_INCLUDE_PATH\b"
    r"|(?<![\w-])-D(?:\s|[\"',])*(?!CMAKE_|BUILD_|DEBIAN_|[A-Z0-9_]*PYTHON)[A-Za-z_]"
    r"|\\u00[2-7]|\\x[2-7]"  # what is spelled so that nobody finds it
)


def may_have_flags(name: str) -> bool:
    """Whether a file called *name*, without directories, may tell a compiler what to compile, and nothing reads it."""
    return _NAMES.fullmatch(name) is not None


def has_flags(text: str) -> bool:
    """Whether *text* sets flags or definitions for a compiler; of variables of CMake only those that hold some."""
    return _FLAGS.search(text) is not None
