# SPDX-License-Identifier: Apache-2.0
"""What earlier runs have followed is taken up where it holds, and what this run follows is handed on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from haros_ci.index.index import Source
from haros_ci.index.relevance import Relevance
from haros_ci.keeping import kept
from haros_ci.keeping.kept import Followed
from haros_ci.model.api import Row
from haros_ci.syntax import Program
from haros_ci.systems.system import Types

#: Parameter libraries, whose facts are not kept.
YAML = (".yaml", ".yml")


@dataclass(frozen=True, slots=True)
class Keeper:
    """Where results are kept between runs.

    *files* are the digests of all C++ and Python files; *get* and *put* take a key of what all results depend on; *program*
    gives the facts of a file as it was under another digest, None if they are not known any more.
    """

    files: Mapping[str, str]
    get: Callable[[str], Any]
    put: Callable[[str, Any], None]
    program: Callable[[str, str], Program | None]


def key_of(types: Types, rows: Mapping[tuple[str, int], Iterable[Row]]) -> str:
    """The key of all that every node depends on: API rows, interfaces, plug-ins, what is relevant by itself."""
    cpp, python = types.programs.cpp, types.programs.python
    plugins = [(name, source.path, definition.name) for name, (source, definition) in sorted(types.plugins.items())]
    return kept.digest_of(
        [(version, tuple(items)) for version, items in sorted(rows.items())],
        [sorted(index.interfaces) for index in (cpp, python)],
        [sorted(index.packages) for index in (cpp, python)],
        sorted(cpp.defined.items(), key=repr),
        plugins,
        [(base, [definition.name for _, definition in found]) for base, found in sorted(types.of_base.items())],
        sorted(types.configs.items()),
        [(version, each.rules()) for version, each in sorted(types.relevance.items())],
        [(source.path, source.module, source.package) for _, source in sorted(types.programs.sources.items())],
        [source.program for _, source in sorted(types.programs.sources.items()) if source.path.endswith(YAML)],
    )


def take_up(types: Types, keeper: Keeper, key: str) -> list[tuple[Any, Followed]]:
    """Put what holds of the record under *key* where nodes are looked up; it is returned."""
    record = kept.read(keeper.get(key))
    if record is None:
        return []
    sources = types.programs.sources

    def before(path: str, digest: str) -> Source | None:
        program = keeper.program(path, digest)
        return replace(sources[path], program=program) if program is not None and path in sources else None

    def relevance(path: str) -> Sequence[Relevance]:
        language = "python" if sources[path].program.language == "python" else "cpp"
        return [each for version, each in types.relevance.items() if version[0] == language]

    change = kept.change_of(record.files, keeper.files, before, sources.get, relevance)

    indexes = (types.programs.cpp, types.programs.python)

    def visible(paths: frozenset[str]) -> frozenset[str]:
        return types.programs.cpp.visible_from(paths, types.plugin_files)

    holding: dict[int, bool] = {}
    found = []
    for followed_key, followed in record.followed:
        consulted = followed.consulted
        assert consulted is not None
        if id(consulted) not in holding:
            holding[id(consulted)] = kept.holds(consulted, change, indexes, visible)
        if holding[id(consulted)]:
            types.followed.setdefault(followed_key, []).append(followed)
            found.append((followed_key, followed))
    return found


def hand_on(
    keeper: Keeper, key: str, old: Sequence[tuple[Any, Followed]], fresh: Sequence[tuple[Any, Followed]]
) -> None:
    """Keep what held and what is new; nothing is written where nothing is new."""
    if any(each.consulted is not None for _, each in fresh):
        keeper.put(key, kept.written(keeper.files, (*old, *fresh)))
