# SPDX-License-Identifier: Apache-2.0
"""Which headers a target includes, whatever the build: those inside conditions of the preprocessor are left out."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import Target
from haros_ci.model.location import Location

_LINE = re.compile(r"(?m)^[ \t]*#[ \t]*(include|if|ifdef|ifndef|endif|define)\b[ \t]*([^\n]*)")
_COMMENT = re.compile(r"/\*.*?\*/", re.S)
_NAME = re.compile(r'[<"]([^<>"\n]+)[>"]')
MAX_FILES = 2_000


def plain_includes(text: str) -> Iterator[tuple[str, int]]:
    """The headers that *text* includes outside of conditions, each with its line; an include guard is no condition."""
    text = _COMMENT.sub(lambda found: "\n" * found[0].count("\n"), text)
    depth, guard = 0, ""
    is_first = True
    line, at = 1, 0
    for found in _LINE.finditer(text):
        word, rest = found[1], found[2]
        line += text.count("\n", at, found.start())
        at = found.start()
        if word == "include":
            name = _NAME.match(rest)
            if name is not None and not depth:
                yield name[1], line
        elif word == "endif":
            depth = max(depth - 1, 0)
        elif word == "define":
            if guard and rest.split("(")[0].split()[:1] == [guard]:
                depth, guard = depth - 1, ""
        else:
            names = re.findall(r"\w+", rest.replace("defined", ""))
            guard = names[0] if is_first and word in ("ifndef", "if") and names else ""
            depth += 1
        is_first = False


class Included:
    """The headers that the targets of one package include, also by way of its own headers."""

    def __init__(self, package: ProjectPackage) -> None:
        self.package = package
        self._files = {file.path for file in package.files if file.language == "cpp"}
        self._by_name: dict[str, list[str]] = {}
        for path in self._files:
            self._by_name.setdefault(posixpath.basename(path), []).append(path)
        self._plain: dict[str, tuple[tuple[str, int], ...]] = {}

    def of(self, target: Target) -> Mapping[str, Location]:
        """By header as written: the first place that includes it for sure."""
        found: dict[str, Location] = {}
        sure = [path for path in target.sources if path not in target.conditional_sources]
        seen, todo = set(sure), list(reversed(sure))
        while todo and len(seen) < MAX_FILES:
            path = todo.pop()
            for name, line in self._in(path):
                own = self.own(name, path)
                if own is None:
                    found.setdefault(name, Location(path, line))
                elif own not in seen:
                    seen.add(own)
                    todo.append(own)
        return found

    def own(self, name: str, path: str) -> str | None:
        """The file of the package that ``#include`` of *name* in *path* means, None if there are none or several."""
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
        if beside in self._files:
            return beside
        ending = f"/{posixpath.normpath(name)}"
        fits = [each for each in self._by_name.get(posixpath.basename(name), ()) if f"/{each}".endswith(ending)]
        return fits[0] if len(fits) == 1 else None

    def _in(self, path: str) -> tuple[tuple[str, int], ...]:
        if path not in self._plain:
            program = self.package.project.programs.get(path)
            known = None if program is None else {name.strip('<>"') for name in program.includes}
            text = self.package.project.text(path)
            self._plain[path] = tuple(pair for pair in plain_includes(text) if known is None or pair[0] in known)
        return self._plain[path]
