# SPDX-License-Identifier: Apache-2.0
"""The gate for what tools write: no word of it that stands in no file of the workspace, unless the tool itself knows it.

Tools quote what they read. Should one read what it must not, in spite of view and sandbox, its words end here. Words between
quotes, and words that look like no plain word of a sentence (with digits, underscores or capitals inside, or very long), must
stand in a file of the workspace, be a name of Python's, or be part of the tool. Others become ``…``.
"""

from __future__ import annotations

import mmap
import os
import sys
from collections.abc import Iterable, Iterator
from functools import cached_property, lru_cache
from pathlib import Path

from haros_ci.linters.linter import Linter, Program, Unit
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

CUT = "…"
#: Where code is quoted, as tools do it; an apostrophe within a word is none.
_QUOTED = regex(r"(?<!\w)'[^'\n]*'(?!\w)|\"[^\"\n]*\"|`[^`\n]*`|‘[^‘’\n]*’")
_WORD = regex(r"\w{3,}")
#: A word of a sentence: small letters, perhaps with a capital at the beginning, or a short abbreviation or number.
_PLAIN = regex(r"[A-Z]?[a-z]{1,23}|[A-Z]{1,5}s?|\d{1,5}")
_SHORT_NUMBER = regex(r"\d{1,5}")
#: Further modules whose messages a Python tool hands on.
_COMPANIONS = {
    "pylint": ("astroid",),
    "flake8": ("pycodestyle.py", "pyflakes", "mccabe.py"),
    "cmake-lint": ("cmakelang",),
    "codespell": ("codespell_lib",),
}
_TEXTS = frozenset((".py", ".txt", ".cfg"))
#: Bytes of one file of a tool that are looked through, and of all of its files.
_LARGEST, _MOST = 200_000_000, 400_000_000


class Gate:
    """For the messages of one tool on one workspace."""

    def __init__(self, workspace: Workspace, linter: Linter, program: Program) -> None:
        self._workspace = workspace
        self._tool = Vocabulary(linter.NAME, program)
        self._known: dict[str, bool] = {}

    def cut(self, message: str, unit: Unit) -> str:
        """*message* about *unit*, the words that come from elsewhere replaced."""
        doubtful = {
            word
            for match in _QUOTED.finditer(message)
            for word in _WORD.findall(match[0])
            if not _SHORT_NUMBER.fullmatch(word)
        }
        doubtful.update(word for word in _WORD.findall(message) if not _PLAIN.fullmatch(word))
        foreign = {word for word in doubtful if not self._knows(word, unit)}
        return _WORD.sub(lambda m: CUT if m[0] in foreign else m[0], message) if foreign else message

    def _knows(self, word: str, unit: Unit) -> bool:
        text = self._workspace.text
        if word in text(unit.file.path) or _is_of_path(word, unit.file.path):
            return True
        known = self._known.get(word)
        if known is None:
            near = any(word in text(path) or word in path for path in (*unit.dependencies, *unit.covers))
            near = near or any(word in self._workspace.setting(path) for path in unit.settings)
            known = near or word in _names_of_python() or word in self._tool or self._stands_somewhere(word)
            self._known[word] = known
        return known

    def _stands_somewhere(self, word: str) -> bool:
        return any(word in file.path or word in self._workspace.text(file.path) for file in self._workspace.files)


def _is_of_path(word: str, path: str) -> bool:
    """Whether a word is made of parts of *path*, as the names of header guards are."""
    lower = path.lower()
    return all(part in lower for part in word.lower().split("_"))


class Vocabulary:
    """The words in a tool's own files."""

    def __init__(self, name: str, program: Program) -> None:
        self._name = name
        self._argv = program.argv

    def __contains__(self, word: str) -> bool:
        spellings = {word.encode(), word.lower().encode()}
        return any(data.find(spelling) >= 0 for data in self._files for spelling in spellings)

    @cached_property
    def _files(self) -> tuple[bytes | mmap.mmap, ...]:
        found: list[bytes | mmap.mmap] = []
        size = 0
        for place in dict.fromkeys(self._places()):
            try:
                with open(place, "rb") as stream:
                    length = os.fstat(stream.fileno()).st_size
                    if not 0 < length <= _LARGEST or size + length > _MOST:
                        continue
                    small = length < 1_000_000
                    found.append(stream.read() if small else mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ))
                    size += length
            except (OSError, ValueError):
                continue
        return tuple(found)

    def _places(self) -> Iterator[str]:
        if self._argv[0] != sys.executable:
            program = Path(os.path.realpath(self._argv[0]))
            yield str(program)
            yield from _sources((program.parent / "cfg",))  # the libraries that cppcheck knows
            return
        own = [argument for argument in self._argv[1:] if os.path.isabs(argument)]
        yield from (argument for argument in own if os.path.isfile(argument))
        module = self._name.replace("-", "_")
        names = (module, f"{module}.py", *_COMPANIONS.get(self._name, ()))
        yield from _sources(Path(entry, name) for entry in own if os.path.isdir(entry) for name in names)
        yield from _sources((Path(__file__).parent,))  # our adapters' words


def _sources(places: Iterable[Path]) -> Iterator[str]:
    """Those of *places* that are files, and the texts below those that are directories."""
    for place in places:
        if place.is_file():
            yield str(place)
        elif place.is_dir():
            yield from sorted(str(path) for path in place.rglob("*") if path.suffix in _TEXTS)


@lru_cache(maxsize=1)
def _names_of_python() -> frozenset[str]:
    """What Python calls its own things, as far as that is known without reading them."""
    import builtins
    import keyword

    names = {*dir(builtins), *keyword.kwlist, *keyword.softkwlist}
    for module in sys.stdlib_module_names:
        names.update(module.split("."))
        loaded = sys.modules.get(module)
        if loaded is not None:
            names.update(dir(loaded))
    for kind in (str, bytes, list, dict, set, int, float, object, BaseException, type, os.PathLike):
        names.update(dir(kind))
    return frozenset(names)
