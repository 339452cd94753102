# SPDX-License-Identifier: Apache-2.0
"""Locations as HAROS writes them: package, file in the package, line, column, function, class."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.haros_json.names import unique
from haros_ci.haros_json.texts import name, optional
from haros_ci.model.location import Location
from haros_ci.model.package import Package


class JsonPlaces:
    """Where the packages are, and under which ids they are shown."""

    def __init__(self, packages: Iterable[Package]) -> None:
        self.packages = tuple(sorted(packages, key=lambda one: (one.name, one.path)))
        ids = unique((one.name, one.path) for one in self.packages)
        #: The id of each package by its directory.
        self.ids: Mapping[str, str] = {one.path: ids[one.name, one.path] for one in self.packages}
        self._homes: dict[str, str | None] = {}

    def home(self, path: str) -> str | None:
        """The directory of the innermost package around *path*, a package's own included; None outside any."""
        if path in self.ids:
            return path
        directory = path.rpartition("/")[0] or "."
        if directory not in self._homes:
            self._homes[directory] = None if directory == "." and "." not in self.ids else self._above(directory)
        return self._homes[directory]

    def _above(self, directory: str) -> str | None:
        while directory not in self.ids:
            if directory == ".":
                return None
            directory = directory.rpartition("/")[0] or "."
        return directory

    def named(self, package: str) -> str | None:
        """The id of the package of that name, the first of several."""
        return next((self.ids[one.path] for one in self.packages if one.name == package), None)

    def split(self, path: str) -> tuple[str | None, str]:
        """The id of the innermost package around *path*, and the path in it."""
        home = self.home(path)
        if home is None:
            return None, path
        return self.ids[home], path if home in (".", path) else path.removeprefix(f"{home}/")

    def location(
        self,
        place: Location | None,
        *,
        function: str | None = None,
        class_name: str | None = None,
    ) -> dict[str, Any]:
        """*place* in HAROS's keys, all of them null for None; a package's directory is the package without a file."""
        package, file = (None, None) if place is None else self.split(place.path)
        if place is not None and place.path in self.ids:
            file = None
        return {
            "package": package,
            "file": optional(file),
            "line": place.line if place is not None else None,
            "column": place.column if place is not None else None,
            "function": name(function) if function else None,
            "class": name(class_name) if class_name else None,
        }
