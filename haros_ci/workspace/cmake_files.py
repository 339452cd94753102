# SPDX-License-Identifier: Apache-2.0
"""CMake's commands on paths and files: nothing is written, and only files of the workspace are looked at."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Mapping
from types import MappingProxyType

from haros_ci.workspace.cmake_state import CMakeState, EvaluatedCommand
from haros_ci.workspace.cmake_strings import separate_arguments
from haros_ci.workspace.cmake_words import absolute, inside, is_certain, join_list, place, unknown

_CODE = (".c", ".C", ".c++", ".cc", ".cpp", ".cxx", ".cu", ".m", ".mm")


def _file(state: CMakeState, call: EvaluatedCommand) -> None:
    words = call.words
    if len(words) < 2:
        return
    what = words[0].upper()
    if what in ("GLOB", "GLOB_RECURSE"):
        _glob(state, words[1], words[2:], recurse=what == "GLOB_RECURSE")
    elif what == "RELATIVE_PATH" and len(words) == 4:
        sure = is_certain(words[2]) and is_certain(words[3])
        state.put(words[1], posixpath.relpath(words[3] or "/", words[2] or "/") if sure else unknown(words[1]))
    elif what == "REAL_PATH" and len(words) > 2:
        state.put(words[2], place(words[1], state.source_directory()) if is_certain(words[1]) else unknown(words[2]))
    elif what in ("READ", "STRINGS", "TIMESTAMP", "SIZE", "READ_SYMLINK", "MD5", "SHA1", "SHA256") and len(words) > 2:
        state.put(words[2], unknown(words[2]))
    elif what in ("TO_CMAKE_PATH", "TO_NATIVE_PATH") and len(words) > 2:
        state.put(words[2], words[1].replace(":", ";") if what == "TO_CMAKE_PATH" else words[1])


def _glob(state: CMakeState, name: str, rest: list[str], *, recurse: bool) -> None:
    """file(GLOB v [LIST_DIRECTORIES b] [RELATIVE p] [CONFIGURE_DEPENDS] pattern...); sorted, as CMake 3.6 and later."""
    relative: str | None = None
    directories = not recurse
    patterns: list[str] = []
    words = iter(rest)
    for word in words:
        if word == "RELATIVE":
            relative = place(next(words, ""), state.source_directory())
        elif word == "LIST_DIRECTORIES":
            directories = next(words, "").upper() in ("TRUE", "ON", "1", "YES")
        elif word not in ("CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS"):
            patterns.append(word)
    found: list[str] = []
    for pattern in patterns:
        inner = inside(place(pattern, state.source_directory())) if is_certain(pattern) else None
        if not is_certain(pattern):
            state.put(name, unknown(name))
            return
        if inner is None:
            continue
        before = state.tree.looked_at
        found += [absolute(path) for path in state.tree.glob(inner, recurse=recurse, directories=directories)]
        state.spend(5 + (state.tree.looked_at - before) // 10)
    if relative is not None:
        found = [posixpath.relpath(path, relative) for path in found]
    state.put(name, join_list(sorted(set(found))))


def _component(state: CMakeState, call: EvaluatedCommand) -> None:
    """get_filename_component(variable name mode [BASE_DIR dir])."""
    if len(call.words) < 3:
        return
    name, path, mode = call.words[0], call.words[1], call.words[2]
    if not is_certain(path) or mode == "PROGRAM":
        state.put(name, unknown(name))
        return
    base = call.words[call.words.index("BASE_DIR") + 1] if "BASE_DIR" in call.words[:-1] else state.source_directory()
    head, _, tail = path.rstrip("/").rpartition("/")
    dot = tail.find(".", 1)
    last = tail.rfind(".")
    values = {
        "DIRECTORY": head,
        "PATH": head,
        "NAME": tail,
        "EXT": tail[dot:] if dot >= 0 else "",
        "NAME_WE": tail[:dot] if dot >= 0 else tail,
        "LAST_EXT": tail[last:] if last > 0 else "",
        "NAME_WLE": tail[:last] if last > 0 else tail,
    }
    if mode in ("ABSOLUTE", "REALPATH"):
        state.put(name, place(path, place(base, state.source_directory())) if is_certain(base) else unknown(name))
    else:
        state.put(name, values.get(mode, unknown(name)))


def _source_directory(state: CMakeState, call: EvaluatedCommand) -> None:
    """aux_source_directory(dir variable)."""
    if len(call.words) < 2 or not is_certain(call.words[0]):
        return
    inner = inside(place(call.words[0], state.source_directory()))
    paths = state.tree.glob(f"{inner}/*", recurse=False, directories=False) if inner else []
    found = [posixpath.join(call.words[0], path.rpartition("/")[2]) for path in paths if path.endswith(_CODE)]
    before = state.get(call.words[1])
    state.put(call.words[1], join_list([*([before] if before else []), *found]))


FILE_COMMANDS: Mapping[str, Callable[[CMakeState, EvaluatedCommand], None]] = MappingProxyType(
    {
        "file": _file,
        "get_filename_component": _component,
        "aux_source_directory": _source_directory,
        "separate_arguments": separate_arguments,
    }
)
