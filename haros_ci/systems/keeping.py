# SPDX-License-Identifier: Apache-2.0
"""What earlier runs have followed is taken up where it holds, and what this run follows is handed on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from haros_ci.index.idle import Idle
from haros_ci.index.index import Source
from haros_ci.index.relevance import Relevance
from haros_ci.keeping import consulted, kept
from haros_ci.keeping.kept import Earlier, Followed
from haros_ci.model.api import Row
from haros_ci.model.once import once
from haros_ci.records import dataclass
from haros_ci.syntax import Program
from haros_ci.systems.following import Types

#: Parameter libraries, whose facts are not kept.
YAML = (".yaml", ".yml")


@dataclass(frozen=True, slots=True)
class Keeper:
    """Where results are kept between runs.

    *files* are the digests of all C++ and Python files; *get* and *put* take a key of what all results depend on; *program*
    gives the facts of a file as it was under another digest, None if they are not known any more.
    """

    files: Mapping[str, str]
    get: Callable[[str], Earlier | None]
    put: Callable[[str, Any], None]
    program: Callable[[str, str], Program | None]


@once
def of_rows(rows: tuple[Row, ...]) -> str:
    """The key of one language's and version's API rows."""
    return kept.digest_of(rows)


def key_of(types: Types, rows: Mapping[tuple[str, int], Iterable[Row]], idle: Idle) -> str:
    """The key of all that every node depends on: API rows, interfaces, plug-ins, what is relevant and what is idle by itself."""
    cpp, python = types.programs.cpp, types.programs.python
    plugins = [(name, plugin.source.path, *plugin.key) for name, plugin in sorted(types.plugins.items())]
    return kept.digest_of(
        [(version, of_rows(tuple(items))) for version, items in sorted(rows.items())],
        [sorted(index.interfaces) for index in (cpp, python)],
        [sorted(index.packages) for index in (cpp, python)],
        sorted(cpp.defined.items(), key=repr),
        sorted(cpp.compiled.items()),
        sorted(cpp.conditional),
        plugins,
        [(base, [item.key for item in found]) for base, found in sorted(types.of_base.items())],
        sorted(types.declared.items()),
        sorted(types.configs.items()),
        [(version, relevance.rules()) for version, relevance in sorted(types.relevance.items())],
        sorted(idle.own),
        [(source.path, source.module, source.package) for _, source in sorted(types.programs.sources.items())],
        [source.program for _, source in sorted(types.programs.sources.items()) if source.path.endswith(YAML)],
    )


def take_up(types: Types, keeper: Keeper, key: str, idle: Idle) -> list[tuple[Any, Followed]]:
    """Put what holds of the record under *key* where nodes are looked up; it is returned. Files as they were are compared without what is *idle*, too."""
    earlier = keeper.get(key)
    if earlier is None:
        return []
    sources = types.programs.sources
    cpp = types.programs.cpp

    def before(path: str, digest: str) -> Source | None:
        program = keeper.program(path, digest)
        return (
            replace(sources[path], program=idle.program(program)) if program is not None and path in sources else None
        )

    def relevance(path: str) -> Sequence[Relevance]:
        language = "python" if sources[path].program.language == "python" else "cpp"
        return [relevance for version, relevance in types.relevance.items() if version[0] == language]

    def visible(paths: frozenset[str]) -> frozenset[str]:
        return cpp.visible_from(paths, types.plugin_files)

    def counting(language: str, version: int, files: frozenset[str]) -> Relevance | None:
        found = types.relevance.get((language, version))
        if found is not None and files:
            if files not in types.views:
                types.views[files] = found.within(visible(files))
            return types.views[files]
        return found

    change = consulted.change_of(earlier.files, keeper.files, before, sources.get, relevance, cpp.aliases)
    now = consulted.Now((cpp, types.programs.python), sources, visible, counting, cache(types.read_yaml.digest))
    found = kept.read(earlier, lambda other_consulted: consulted.holds(other_consulted, change, now), change.lines)
    for followed_key, followed in found:
        types.followed.setdefault(followed_key, []).append(followed)
    return found


def hand_on(
    keeper: Keeper, key: str, old: Sequence[tuple[Any, Followed]], fresh: Sequence[tuple[Any, Followed]]
) -> None:
    """Keep what held and what is new; nothing is written where nothing is new."""
    if any(followed.consulted is not None for _, followed in fresh):
        keeper.put(key, kept.written(keeper.files, (*old, *fresh)))
