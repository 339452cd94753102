# SPDX-License-Identifier: Apache-2.0
"""Scripts that code of their package gives to an interpreter: they need neither a shebang nor the execute bit for that."""

from __future__ import annotations

import re

from haros_ci.checking.project import ProjectPackage

_PROSE = (".md", ".rst", "README.txt")
#: A file that is given to an interpreter, or sourced.
_GIVEN = r"""(?:\bpython[\d.]*|(?i:python)\w*EXECUTABLE\}?|\b(?:source|sh|bash)|^\s*\.)["']?[\s,][^\n;]{0,200}%s"""
_CMAKE = (".cmake", ".cmake.in", "CMakeLists.txt", ".cmake.em")


def is_given_to_another(path: str, package: ProjectPackage) -> bool:
    """Whether code of the package gives the file to an interpreter, or reads it: ``python3 x.py``, ``. x.sh``; by a variable of CMake, too."""
    name = path.rpartition("/")[2]
    inside = "" if package.path == "." else f"{package.path}/"
    texts = {
        other: package.project.text(other)
        for other in package.project.workspace.names
        if other.startswith(inside) and other != path and not other.endswith(_PROSE)
    }
    texts = {other: text for other, text in texts.items() if name in text}
    pattern = re.compile(_GIVEN % rf"\b{re.escape(name)}\b", re.MULTILINE)
    if any(pattern.search(text) for text in texts.values()):
        return True
    called = re.compile(
        rf"""\bset\s*\(\s*(\w+)\s+["']?[^\s"'()]{{0,300}}(?<![\w.-]){re.escape(name)}["']?\s*[)\s]""", re.IGNORECASE
    )
    for other, text in texts.items():
        if other.endswith(_CMAKE):
            variables = {match[1] for match in called.finditer(text)}
            if any(re.search(_GIVEN % rf"\$\{{{variable}\}}", text, re.MULTILINE) for variable in sorted(variables)):
                return True
    return False
