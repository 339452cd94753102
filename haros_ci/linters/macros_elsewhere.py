# SPDX-License-Identifier: Apache-2.0
"""Macros with code in headers that cppcheck is not given: those of other packages of the workspace, and of directories that it does not look in.

It takes such a macro for a call of a function that it does not know, and what stands in it is compiled and has no findings.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.linters.dead_text import dead, is_in
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace

#: Headers that are looked at for one file.
_MOST = 300
_INCLUDE = re.compile(r"^[ \t]*(?:#|%:)[ \t]*(?:include(?:_next)?|import)[ \t]*[\"<]([^\">\n]{1,300})", re.M)
#: A macro with its words, over several lines, too.
DEFINED = re.compile(r"^[ \t]*(?:#|%:)[ \t]*define[ \t]+([A-Za-z_]\w{0,100})\b((?:[^\n\\]|\\\r?\n|\\.){0,8000})", re.M)
_CODE = re.compile(r"\b(?:return|throw|goto|delete)\b|[{;]")
_WORD = re.compile(r"[A-Za-z_]\w*")


class MacrosElsewhere:
    """The headers of *workspace* by their names, and the macros with code that they define; each header is read once."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._homes = {
            package.name: "" if package.path == "." else f"{package.path}/" for package in workspace.packages
        }
        self._by_name: dict[str, list[str]] = {}
        for file in workspace.files:
            if file.language == "cpp":
                self._by_name.setdefault(file.path.rpartition("/")[2], []).append(file.path)
        self._read: dict[str, tuple[tuple[str, ...], frozenset[str]]] = {}

    def used(self, file: SourceFile) -> Iterator[str]:
        """What *file* uses of them, in words: by the headers that it includes, and that these do."""
        words: frozenset[str] | None = None
        for path in self._unseen(file):
            macros = self._look(path)[1]
            if macros and words is None:
                words = frozenset(_WORD.findall(self._workspace.text(file.path)))
            yield from (f"the macro {name} of {path}" for name in sorted(macros & (words or frozenset())))

    def _unseen(self, file: SourceFile) -> list[str]:
        """The headers that the compiler finds by the names in *file*, and cppcheck does not."""
        home = self._homes.get(file.package or "", "")
        waiting, seen, unseen = [(file.path, True)], {file.path}, []
        while waiting and len(seen) < _MOST:
            path, is_given = waiting.pop()
            for name in self._look(path)[0]:
                beside = f"{path.rpartition('/')[0]}/{name}".lstrip("/")
                places = (beside, f"{home}include/{name}", f"{home}src/{name}", f"{home}{name}")
                own = next((place for place in places if place in self._workspace.names), None) if is_given else None
                others = self._by_name.get(name.rpartition("/")[2], ()) if own is None else ()
                for found in [own] if own else [other for other in others if f"/{other}".endswith(f"/{name}")]:
                    if found not in seen:
                        seen.add(found)
                        waiting.append((found, own is not None))
                        unseen += [] if own else [found]
        return unseen

    def _look(self, path: str) -> tuple[tuple[str, ...], frozenset[str]]:
        """What the file at *path* includes, and the macros with code that it defines."""
        found = self._read.get(path)
        if found is None:
            text = self._workspace.text(path)
            hidden = dead(text)
            names = (match[1] for match in _INCLUDE.finditer(text) if not is_in(match.start(), hidden))
            macros = (
                (match[1] for match in DEFINED.finditer(text) if _CODE.search(match[2])) if "define" in text else ()
            )
            found = self._read[path] = (tuple(dict.fromkeys(names)), frozenset(macros))
        return found
