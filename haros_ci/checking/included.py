# SPDX-License-Identifier: Apache-2.0
"""Which headers a target includes, whatever the build: those inside conditions of the preprocessor are left out."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping

from haros_ci.checking.includes import includes, is_compiled
from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import Target
from haros_ci.model.location import Location

MAX_FILES = 2_000


class IncludedHeaders:
    """The headers that the targets of one package include, also by way of its own headers."""

    def __init__(self, package: ProjectPackage) -> None:
        self.package = package
        self._files = {file.path for file in package.files if file.language == "cpp"}
        self._by_name: dict[str, list[str]] = {}
        for path in self._files:
            self._by_name.setdefault(posixpath.basename(path), []).append(path)
        self._plain: dict[str, tuple[tuple[str, Location], ...]] = {}

    def of(self, target: Target) -> Mapping[str, Location]:
        """By header as written: the first place that includes it for sure."""
        found: dict[str, Location] = {}
        sure = [path for path in target.sources if path not in target.conditional_sources]
        sure = [path for path in sure if is_compiled(self.package, path)]
        seen, todo = set(sure), list(reversed(sure))
        while todo and len(seen) < MAX_FILES:
            path = todo.pop()
            for name, place in self._in(path):
                own = self.own(name, path)
                if own is None:
                    found.setdefault(name, place)
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
        fits = [
            other_path
            for other_path in self._by_name.get(posixpath.basename(name), ())
            if f"/{other_path}".endswith(ending)
        ]
        return fits[0] if len(fits) == 1 else None

    def _in(self, path: str) -> tuple[tuple[str, Location], ...]:
        if path not in self._plain:
            program = self.package.project.programs.get(path)
            known = None if program is None else {name.strip('<>"') for name in program.includes}
            found = (
                (include.header, include.location) for include in includes(path, self.package.project.glance(path))
            )
            self._plain[path] = tuple(pair for pair in found if known is None or pair[0] in known)
        return self._plain[path]
