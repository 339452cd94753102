# SPDX-License-Identifier: Apache-2.0
"""CMake's configure_file(): the XML that it would write of a template, as far as variables are known, and where the file is found then."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

from haros_ci.model.build import NOT_KNOWN, WrittenFile
from haros_ci.regex import regex
from haros_ci.workspace.cmake_state import CMakeState, EvaluatedCommand, InstalledLater
from haros_ci.workspace.cmake_words import (
    BINARY_ROOT,
    SOURCE_ROOT,
    absolute,
    bare,
    cleaned,
    inside,
    is_certain,
    place,
)

#: Characters of a template, and of all that one package writes.
MAX_TEMPLATE = 300_000
MAX_WRITTEN = 3_000_000
_AT = r"@([A-Za-z0-9/_.+-]{1,200})@"
_AT_ONLY = regex(_AT)
_ALL = regex(rf"{_AT}|\$\{{([A-Za-z0-9/_.+-]{{1,200}})\}}|(\$(?:ENV|CACHE)?\{{)")
_CMAKE_LINE = regex(r"^[ \t]*#[ \t]*cmakedefine", re.M)
#: A value below the prefix of the installation, of which only the machine that builds tells where it lies.
_OF_THE_BUILD = regex(r"install(?:/|$)")
#: The tag of an element that may hold a text: none that holds others.
_OPENED = regex(
    r"<(?!xacro:|(?:robot|gazebo|plugin|sdf|world|model|link|joint|sensor|visual|collision|ros2_control|transmission|launch)[\s>])"
    r"[A-Za-z_][\w.:-]*(?:\s[^<>]*)?(?<!/)>"
)


def _configure(state: CMakeState, call: EvaluatedCommand) -> None:
    """configure_file(input output [COPYONLY] [ESCAPE_QUOTES] [@ONLY] …)."""
    if len(call.words) < 2 or not is_certain(call.words[1]):
        return
    source, target = bare(call.words[0]), call.words[1]
    where = place(target, state.get("CMAKE_CURRENT_BINARY_DIR") or BINARY_ROOT)
    if target.endswith("/") or (inner := inside(where)) is not None and inner in state.tree.directories:
        where = f"{where}/{source.rpartition('/')[2]}"
    template = inside(place(source, state.source_directory())) if is_certain(source) else None
    text = None if template is None or state.doubts or state.testing else _written(state, template, call.words[2:])
    before = state.configured.get(where, (template, text))
    state.configured[where] = (template or "", text if before == (template, text) else None)


def _written(state: CMakeState, template: str, options: list[str]) -> str | None:
    """What is written of *template*, with ``NOT_KNOWN`` for each value that is not known; None if that is not known, or is no XML."""
    if template not in state.tree.listed:
        return None
    text = cleaned(state.tree.workspace.text(template))
    if not text.lstrip().startswith("<") or len(text) > MAX_TEMPLATE or _CMAKE_LINE.search(text):
        return None
    if "COPYONLY" in options:
        return text
    if "ESCAPE_QUOTES" in options:
        return None
    state.spend(len(text) // 100)
    pattern = _AT_ONLY if "@ONLY" in options else _ALL
    if pattern is _ALL and any(found[3] for found in pattern.finditer(text)):
        return None  # CMake refuses a reference that is no name
    made = pattern.sub(lambda found: _value(state, found[1] or found[2]), text)
    return made if len(made) <= MAX_TEMPLATE and _stands_in_values(made) else None


def _value(state: CMakeState, name: str) -> str:
    """What stands for the variable *name*; one that nothing in the package sets is not known."""
    value = state.get(name)
    if value is None:
        return "" if any(name in scope for scope in state.scopes) else NOT_KNOWN
    is_own = not name.startswith("CMAKE_") or name == "CMAKE_PROJECT_NAME"
    is_place = SOURCE_ROOT in value or BINARY_ROOT in value or _OF_THE_BUILD.match(value) is not None
    return value if is_own and is_certain(value) and not is_place else NOT_KNOWN


def _stands_in_values(text: str) -> bool:
    """Whether all that is not known stands in tags, or is the text of an element that has none in it: no elements are hidden by it. Takes linear time."""
    opened = closed = leaf = -1
    start = 0
    while (at := text.find(NOT_KNOWN, start)) >= 0:
        opened, closed = max(opened, text.rfind("<", start, at)), max(closed, text.rfind(">", start, at))
        if opened < closed != leaf:
            tag = _OPENED.match(text, opened)
            if tag is None or tag.end() != closed + 1 or not text.startswith("</", text.find("<", at)):
                return False
            leaf = closed
        start = at + 1
    return True


def install_made(state: CMakeState, word: str, kind: str, destination: str, name: str) -> None:
    """Remember that *word*, a file or directory of the build tree, is installed."""
    source = place(word, state.source_directory())
    if source == BINARY_ROOT or source.startswith(f"{BINARY_ROOT}/"):
        base = name or source.rpartition("/")[2]
        if kind == "directory":
            final = destination if word.endswith(("/", "/.")) else f"{destination}/{source.rpartition('/')[2]}"
        else:
            final = f"{destination}/{base}"
        if not state.doubts and not state.testing:
            state.installed_later[InstalledLater(source, posixpath.normpath(final))] = None


def written_files(state: CMakeState) -> tuple[WrittenFile, ...]:
    """The files that the package writes, under the paths by which launch files find them: what is put into its share directory as if it lay in the package."""
    found: dict[str, WrittenFile | None] = {}
    left = MAX_WRITTEN
    for where, (template, text) in state.configured.items():
        if text is None or (left := left - len(text)) < 0:
            continue
        for path in _paths(state, where):
            made = WrittenFile(path=path, template=template, text=text)
            found[path] = made if found.get(path, made) == made else None
    return tuple(made for made in found.values() if made is not None)


def _paths(state: CMakeState, where: str) -> list[str]:
    """Where in the workspace the file *where* is looked for."""
    own = inside(where)
    if own is not None:
        return [own]
    share = f"share/{state.package.name}/"
    inner = [where.removeprefix(f"{BINARY_ROOT}/devel/{share}")] if f"/devel/{share}" in where else []
    for later in state.installed_later:
        if where == later.source:
            inner.append(later.path.removeprefix(share) if later.path.startswith(share) else "")
        elif where.startswith(f"{later.source}/"):
            path = f"{later.path}/{where[len(later.source) + 1 :]}"
            inner.append(path.removeprefix(share) if path.startswith(share) else "")
    paths = (inside(place(one, absolute(state.package.path))) for one in inner if one)
    return [path for path in paths if path is not None and path not in state.tree.files]


CONFIGURING: Mapping[str, Callable[[CMakeState, EvaluatedCommand], None]] = MappingProxyType(
    {"configure_file": _configure}
)
