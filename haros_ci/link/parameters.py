# SPDX-License-Identifier: Apache-2.0
"""The parameter server of a configuration, as a node sees it when it starts."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable
from typing import Any

from haros_ci.link.roslaunch_files import Files
from haros_ci.link.roslaunch_names import Text, literal
from haros_ci.link.roslaunch_yaml import YamlError, YamlValue, read_yaml
from haros_ci.link.values import Known, Opaque, Value
from haros_ci.model.architecture import Parameter


class ParameterServer:
    """Parameters by full name; a namespace is the map of what is below it (wiki.ros.org/Parameter Server)."""

    def __init__(self, parameters: Iterable[Parameter]) -> None:
        self._by_name: dict[str, list[Parameter]] = {}
        self._spaces: set[str] = set()
        for parameter in parameters:
            self._by_name.setdefault(parameter.name, []).append(parameter)
            space = parameter.name.rpartition("/")[0]
            while space:
                self._spaces.add(space)
                space = space.rpartition("/")[0]

    def get(self, name: str) -> Value | None:
        """The value that *name* has; None if nothing sets it, Opaque if it is set but not known to what."""
        found = self._by_name.get(name)
        if found:
            return _value(found)
        if name in self._spaces:
            tree: dict[str, Any] = {}
            for full, parameters in sorted(self._by_name.items()):
                if full.startswith(f"{name}/"):
                    value = _value(parameters)
                    if not isinstance(value, Known):
                        return value
                    inner = tree
                    *path, last = full[len(name) + 1 :].split("/")
                    for part in path:
                        inner = inner.setdefault(part, {})
                    inner[last] = value.value
            return Known(tree)
        return None


def _value(parameters: list[Parameter]) -> Value:
    parameter = parameters[-1]
    if len(parameters) > 1 or parameter.conditions:
        return Opaque(f"the parameter {parameter.name} is set under a condition", parameter.location)
    if parameter.unknowns:
        return Opaque(parameter.unknowns[0].reason, parameter.unknowns[0].location or parameter.location)
    return Known(parameter.value)


def yaml_reader(files: Files) -> Any:
    """A function from a path as values have it (or ``"\\n"`` and YAML text itself) to its data; None if not here."""

    def read(path: str) -> Value | None:
        text = path[1:] if path.startswith("\n") else None
        if text is None:
            place = files.place(literal(path))
            if place.path is None or not files.has(posixpath.normpath(place.path)):
                return None
            text = files.workspace.text(place.path)
        try:
            return Known(plain(read_yaml(literal(text))))
        except YamlError as error:
            return Opaque(f"the YAML cannot be read: {error}")

    return read


def plain(value: YamlValue) -> Any:
    """YAML as plain data; what is not known in it is None."""
    data = value.data
    if isinstance(data, YamlValue):
        return plain(data)
    if isinstance(data, (list, tuple)):
        return [plain(item) if isinstance(item, YamlValue) else item for item in data]
    if isinstance(data, dict):
        return {
            str(_plain_key(key)): plain(item) if isinstance(item, YamlValue) else item for key, item in data.items()
        }
    if isinstance(data, (str, int, float, bool)) or data is None:
        return data
    return None


def _plain_key(key: Any) -> Any:
    return key.raw if isinstance(key, Text) else key
