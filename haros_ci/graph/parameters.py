# SPDX-License-Identifier: Apache-2.0
"""The parameter server of a configuration, as a node sees it when it starts."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable
from dataclasses import replace
from functools import cached_property
from hashlib import blake2b
from typing import Any

from haros_ci.model.architecture import Condition, Parameter
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.substitutions.files import Files
from haros_ci.substitutions.names import Text, literal
from haros_ci.substitutions.yaml import YamlError, YamlValue, read_yaml
from haros_ci.values.abstract import NONE, Known, Opaque, Value, same


@dataclass(frozen=True, slots=True)
class Perhaps(Opaque):
    """Not known, and not even whether it is there at all."""


@dataclass(frozen=True, slots=True)
class SetByNode(Perhaps):
    """A parameter that nothing sets before nodes start, and that a node sets then: the server keeps it (wiki.ros.org/Parameter Server).

    *held* is its value once it is set. *is_default_first* where only names of which nothing is known may be this one: who reads it with
    a default of its own is taken to have that.
    """

    held: Value = NONE
    is_default_first: bool = False


@dataclass(frozen=True, slots=True)
class Setting:
    """A *node* sets the parameter *name* (``?`` for unknown parts) to a *value*, or deletes it: ``NONE``."""

    node: str
    name: str
    value: Known | Opaque

    def concerns(self, name: str) -> bool:
        """Whether it may set *name*, or what is below or above it."""
        if "?" in self.name or "?" in name:
            return "?" not in name and _fits(name, self.name.split("?"))
        return self.name == name or self.name.startswith(f"{name}/") or name.startswith(f"{self.name}/")


class ParameterServer:
    """Parameters by full name; a namespace is the map of what is below it (wiki.ros.org/Parameter Server).

    A name with ``?`` stands for every name that it may be. *settings* are what nodes set that have been followed.
    """

    settings: tuple[Setting, ...] = ()

    def __init__(self, parameters: Iterable[Parameter]) -> None:
        self._by_name: dict[str, list[Parameter]] = {}
        self._spaces: set[str] = set()
        self._vague: list[tuple[list[str], Parameter]] = []
        for parameter in parameters:
            if "?" in parameter.name:
                self._vague.append((parameter.name.split("?"), parameter))
                continue
            self._by_name.setdefault(parameter.name, []).append(parameter)
            space = parameter.name.rpartition("/")[0]
            while space:
                self._spaces.add(space)
                space = space.rpartition("/")[0]

    def get(self, name: str, under: tuple[Condition, ...] = ()) -> Value | None:
        """The value that *name* has where the conditions *under* hold, as they do for the node that asks.

        None if nothing sets it, Opaque if it is not known, Perhaps if it may not be set.
        """
        found = self._by_name.get(name)
        if found:
            return _value(found, under)
        is_space = name in self._spaces
        for parts, parameter in self._vague:
            inside, head = f"{name.rstrip('/')}/", parts[0]
            if _fits(name, parts) or head.startswith(inside) or (is_space and inside.startswith(head)):
                reason = next((f"it may be set: {why.reason}" for why in parameter.unknowns), "it may be set")
                return (Opaque if is_space else Perhaps)(reason, parameter.location)
        if is_space:
            tree: dict[str, Any] = {}
            for full, parameters in sorted(self._by_name.items()):
                if full.startswith(f"{name}/"):
                    value = _value(parameters, under)
                    if not isinstance(value, Known):
                        return value
                    inner = tree
                    *path, last = full[len(name) + 1 :].split("/")
                    for part in path:
                        inner = inner.setdefault(part, {}) if isinstance(inner, dict) else inner
                    if not isinstance(inner, dict):
                        return Opaque(f"{full} lies below a parameter that has a value", parameters[-1].location)
                    inner[last] = dict(value.value) if isinstance(value.value, dict) else value.value
            return Known(tree)
        return self._below(name)

    def get_for(self, node: str, name: str, under: tuple[Condition, ...] = ()) -> Value | None:
        """The same for a *node*, which may read it after others have set it."""
        found = self.get(name, under)
        others = [setting for setting in self.settings if setting.node != node and setting.concerns(name)]
        if found is None:
            others = [setting for setting in others if setting.value != NONE]
        if not others or (isinstance(found, Opaque) and not isinstance(found, Perhaps)):
            return found
        named = [setting for setting in others if not setting.name.startswith("/?")]
        first = (named or others)[0]
        why = f"{first.node} may set it"
        values = [setting.value if setting.name == name else Opaque(why) for setting in others]
        held = values[0]
        is_same = all(_are_same(value, held) for value in values)
        if found is None:
            return SetByNode(why, held=held if is_same else Opaque(why), is_default_first=not named)
        if not isinstance(found, Known):
            return found
        if any(setting.value == NONE for setting in others):
            return SetByNode(f"{first.node} may delete it", held=found)
        return Opaque(why) if named and not (is_same and _are_same(found, held)) else found

    def get_private(
        self, name: str, node: str, own: ParameterServer, under: tuple[Condition, ...] = ()
    ) -> Value | None:
        """The value of the parameter *name* below *node*, a name of which a part is not known.

        *own* is what the node's tag sets, by names below the node's. What stands elsewhere may be this parameter by its name.
        """
        found = own.get(name[len(node) :], under)
        if isinstance(found, Opaque):
            return found
        for other in self._elsewhere:
            if _meet(other.name, name):
                reason = next((f"it may be set: {why.reason}" for why in other.unknowns), "it may be set")
                return Perhaps(reason, other.location)
        return found

    @cached_property
    def _elsewhere(self) -> list[Parameter]:
        """What no tag of a node sets, for whose parameters only the node itself asks by a name that is not known."""
        every = (parameter for parameters in self._by_name.values() for parameter in parameters)
        return [one for one in (*every, *(parameter for _, parameter in self._vague)) if not one.is_of_node]

    def _below(self, name: str) -> Value | None:
        """What is inside a parameter that may be a map."""
        above = name.rpartition("/")[0]
        while above:
            for parameter in self._by_name.get(above, ()):
                for why in parameter.unknowns:
                    if why.field == "type":
                        return Perhaps(f"it may be set: {why.reason}", why.location or parameter.location)
            above = above.rpartition("/")[0]
        return None


#: A path below a directory of the workspace, as Python launch files have them.
_IN_WORKSPACE = regex(r"\$\(workspace ([^()$]*)\)/(.*)")


def _fits(name: str, parts: list[str]) -> bool:
    """Whether *name* may be one of which only *parts* are known, with anything between them."""
    first, *middle, last = parts
    if len(name) < len(first) + len(last) or not (name.startswith(first) and name.endswith(last)):
        return False
    at, end = len(first), len(name) - len(last)
    for part in middle:
        found = name.find(part, at, end)
        if found < 0:
            return False
        at = found + len(part)
    return True


def own_parameters(node: str, parameters: Iterable[Parameter]) -> ParameterServer:
    """What the tag of *node* sets, of whose name a part is not known, by names below it (``/rate``)."""
    found = []
    for parameter in parameters:
        if parameter.name.startswith(f"{node}/"):
            below = parameter.name[len(node) :]
            why = tuple(why for why in parameter.unknowns if "?" in below or why.field != "name")
            found.append(replace(parameter, name=below, unknowns=why))
    return ParameterServer(found)


def _meet(one: str, other: str) -> bool:
    """Whether two names may be the same, with any text for ``?``."""
    if "?" not in one or "?" not in other:
        return _fits(one, other.split("?")) if "?" in other else _fits(other, one.split("?"))
    heads, tails = (one.partition("?")[0], other.partition("?")[0]), (one.rpartition("?")[2], other.rpartition("?")[2])
    return (heads[0].startswith(heads[1]) or heads[1].startswith(heads[0])) and (
        tails[0].endswith(tails[1]) or tails[1].endswith(tails[0])
    )


def _value(parameters: list[Parameter], under: tuple[Condition, ...]) -> Value:
    parameter = parameters[-1]
    if not set(parameter.conditions) <= set(under):
        kind = Opaque if any(set(parameter.conditions) <= set(under) for parameter in parameters) else Perhaps
        return kind(f"the parameter {parameter.name} is set under a condition", parameter.location)
    if parameter.unknowns:
        return Opaque(parameter.unknowns[0].reason, parameter.unknowns[0].location or parameter.location)
    return Known(parameter.value)


@dataclass(frozen=True, slots=True)
class YamlFiles:
    """The YAML files of a workspace, by paths as values have them."""

    files: Files

    def __call__(self, path: str) -> Value | None:
        """The data of a file, or of the YAML text after a line feed; None if it is not here."""
        text = path[1:] if path.startswith("\n") else self.text(path)
        if text is None:
            return None
        try:
            return Known(plain(read_yaml(literal(text))))
        except YamlError as error:
            return Opaque(f"the YAML cannot be read: {error}")

    def text(self, path: str) -> str | None:
        """The text of a file; None if it is not here."""
        own = _IN_WORKSPACE.fullmatch(path)
        place = self.files.place(literal(path.replace("$(find-pkg-share ", "$(find "))) if own is None else None
        found = place.path if place is not None else posixpath.normpath(f"{own[1]}/{own[2]}") if own else None
        if found is None or not self.files.has(posixpath.normpath(found)):
            return None
        return self.files.workspace.text(found)

    def digest(self, path: str) -> str:
        """A digest of the text of a file, "" if it is not here: what is read of it is the same where this is."""
        text = self.text(path)
        return "" if text is None else blake2b(text.encode("utf-8", "surrogatepass"), digest_size=16).hexdigest()


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


def _are_same(one: Value, other: Value) -> bool:
    """Whether both are known and equal."""
    return isinstance(one, Known) and isinstance(other, Known) and same(one.value, other.value)
