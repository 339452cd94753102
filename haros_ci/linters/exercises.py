# SPDX-License-Identifier: Apache-2.0
"""Templates in Python, in files that nothing installs, starts or imports: a block that a comment leaves to students to write, names that a generator fills in."""

from __future__ import annotations

import re

from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: What Python says of a block without a statement (Parser/pegen; 3.8 says less).
_EMPTY = regex(r"expected an indented block|unexpected (?:unindent|EOF)|unindent does not match")
#: What asks somebody else to write the block.
_ASKS = regex(
    r"\byour (?:code|solution|answer|implementation|work)\b|\b(?:add|write|put|insert|enter|fill in|complete) (?:the |some |more )?(?:code|solution|lines?)\b"
    r"|\b(?:todo|exercise|task|student)s?\b.{0,40}\b(?:here|below)\b",
    re.IGNORECASE,
)
#: A name that a generator fills in where Python has a name: ``from {package} import {name}``, ``class ${Name}``, ``import @(module)``, ``{% if … %}``.
_FILLED_IN = regex(
    r"^[ \t]*(?:(?:from|import|class|def)[ \t]+[\w.]{0,100}(?:\{\{?[ \t]*[\w-]{1,100}[ \t]*\}|\$\{?\w|@\(|<%)|\{%)",
    re.MULTILINE,
)
_IMPORT = regex(r"^[ \t]*(?:from|import)\b[^\n]*", re.MULTILINE)
#: Lines above the place that are looked at.
_NEAR = 40
_LONGEST = 400
#: Files of a workspace that are looked at; in a larger one any may be named.
_MOST = 3_000


def is_exercise(path: str, line: int, message: str, workspace: Workspace) -> bool:
    """Whether Python misses a block before *line* where a comment leaves it to somebody to write, in a file that nothing else names."""
    if not _EMPTY.search(message):
        return False
    lines = workspace.text(path).split("\n")
    asks = False
    for above in reversed(lines[max(line - 1 - _NEAR, 0) : max(line - 1, 0)]):
        bare = above[:_LONGEST].strip()
        if bare.startswith("#"):
            asks = asks or _ASKS.search(bare) is not None
        elif bare:
            return asks and bare.partition("#")[0].rstrip().endswith(":") and not _is_named(path, workspace)
    return False


def is_template(path: str, workspace: Workspace) -> bool:
    """Whether a generator fills in names of the file, which nothing else names."""
    return _FILLED_IN.search(workspace.text(path)) is not None and not _is_named(path, workspace)


def _is_named(path: str, workspace: Workspace) -> bool:
    """Whether a launch file, CMake or setup.py has the name of the file, or Python imports it."""
    if len(workspace.files) > _MOST:
        return True
    name = path.rpartition("/")[2]
    stem = re.compile(rf"\b{re.escape(name.removesuffix('.py'))}\b")
    for file in workspace.files:
        if file.path == path or file.language not in ("launch", "cmake", "python"):
            continue
        text = workspace.text(file.path)
        if name.removesuffix(".py") not in text:
            continue
        is_whole = file.language != "python" or file.path.endswith(("setup.py", ".launch.py", "_launch.py"))
        if stem.search(text) if is_whole else any(stem.search(found) for found in _IMPORT.findall(text)):
            return True
    return False
