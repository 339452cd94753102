# SPDX-License-Identifier: Apache-2.0
"""How a node is started: its name, arguments and parameters, and what they make of a text with holes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from haros_ci.graph.names import UNKNOWN, clean, resolve
from haros_ci.model.architecture import Unknown
from haros_ci.records import dataclass
from haros_ci.systems.known.text import Hole, Template
from haros_ci.values.abstract import Choice, Known, Mapped, Opaque, Sequence, Text, data_of, opaque_of

#: What stands in the name of a parameter for the item of a list.
ITEM = "{item}"
_VALUES = (Choice, Known, Mapped, Opaque, Sequence, Text)


@dataclass(frozen=True, slots=True)
class Start:
    """One node being started; *item* is that of a list, None outside one.

    *ros* is 1 or 2. *below* gives the names of the parameters that are set for the node and begin with a text, *file*
    the content of a YAML file; either is None where that is not known.
    """

    name: str
    namespace: str
    arguments: tuple[str, ...]
    parameter: Callable[[str], object | None]
    remap: Callable[[str], str]
    distribution: str | None
    item: object = None
    ros: int = 1
    below: Callable[[str], Iterable[str] | Unknown] | None = None
    file: Callable[[str], object | None] | None = None

    def full(self, name: str) -> str:
        """The full name of a parameter: all those of ROS 2 are of the node, ``/ns/node:dotted.name``."""
        return resolve(name, self.namespace, self.name) if self.ros == 1 else f"{self.name}:{name.lstrip('~')}"

    def value(self, name: str) -> object | None:
        """A parameter: None if it is not set, an Unknown if its value is no data."""
        if ITEM in name:
            if not isinstance(self.item, str) or UNKNOWN in self.item:
                return Unknown("value", "which item of the list it is, is not known")
            name = name.replace(ITEM, self.item)
        if self.ros == 2 and name.startswith("/"):
            return None
        found = self.parameter(self.full(name))
        if isinstance(found, _VALUES):
            known, data = data_of(found)
            if known:
                plain: object = data
                return plain
            why = opaque_of(found)
            return Unknown("value", why.reason if why else "it is not plain data", why.location if why else None)
        return found

    def words(self, first: int) -> tuple[tuple[str, ...], Unknown | None]:
        """The arguments from *first* up to one that is not known; remappings do not count (wiki.ros.org/Remapping)."""
        words = [word for word in own_arguments(self.arguments, self.ros) if ":=" not in word]
        for n, word in enumerate(words):
            if UNKNOWN in word:
                return tuple(words[first:n]), Unknown("name", "an argument on the command line is not known")
        return tuple(words[first:]), None

    def word(self, kind: str, about: str) -> str | Unknown | None:
        """An argument by its place, or what follows an option (if nothing does, the option); None if not there."""
        words, why = self.words(0)
        if kind == "arg":
            return words[int(about)] if int(about) < len(words) else why
        for n, word in enumerate(words):
            option, equals, value = word.partition("=")
            if option.startswith("-") and option.lstrip("-") == about.lstrip("-"):
                if equals:
                    return value
                return words[n + 1] if n + 1 < len(words) else why or about
        return why

    def member(self, about: str) -> object | None:
        """The item of the list, or with *about* that member of it, where it is a map."""
        return self.item.get(about) if about and isinstance(self.item, Mapping) else self.item

    def searched(self, name: str) -> str | Unknown:
        """The parameter that ``searchParam`` finds from the namespace upwards (wiki.ros.org/Parameter Server)."""
        if self.ros == 2:
            return Unknown("name", "ROS 2 has no search for parameters")
        parts = [part for part in self.namespace.split("/") if part]
        places = [clean("/".join([*parts[:n], name])) for n in range(len(parts), -1, -1)]
        for place in places:
            found = self.parameter(place)
            if isinstance(found, Unknown) and found.field == "presence":
                return replace(found, field="name")
            if found is not None:
                return place
        return places[0] if len(places) == 1 else Unknown("name", f"{name} is searched for, and set nowhere")


def own_arguments(arguments: tuple[str, ...], ros: int) -> tuple[str, ...]:
    """*arguments* that are not ROS's own: in ROS 2 those are from ``--ros-args`` up to ``--`` or the end."""
    if ros == 1:
        return arguments
    own: list[str] = []
    inside = False
    for word in arguments:
        if word == "--ros-args":
            inside = True
        elif not inside:
            own.append(word)
        elif word == "--":
            inside = False
    return tuple(own)


def called(kind: str, about: str) -> str:
    """What a hole or a condition asks for, in the words of a person."""
    if kind == "arg":
        return f"argument {int(about) + 1} on the command line"
    if kind == "item":
        return f"{about} of an item of the list"
    return f"option {about}" if kind == "option" else about


def filled(template: Template, start: Start) -> tuple[str, list[Unknown]]:
    """*template* as text, ``?`` for what is not known, and why."""
    text, unknowns = "", []
    for part in template:
        if isinstance(part, str):
            text += part
            continue
        value = _content(part, start)
        if value is None and part.default is not None:
            inner, messages = filled(part.default, start)
            text += inner
            unknowns += messages
        elif isinstance(value, str):
            text += value
        else:
            unknowns.append(replace(value or Unknown("name", _missing(part)), field="name"))
            text += UNKNOWN
    return text, unknowns


def _missing(hole: Hole) -> str:
    if hole.kind == "item":
        return f"an item of the list has no {hole.about}"
    return f"{called(hole.kind, hole.about)} is not {'set' if hole.kind == 'param' else 'given'}"


def _content(hole: Hole, start: Start) -> str | Unknown | None:
    if hole.kind == "unknown":
        return Unknown("name", hole.about)
    if hole.kind in ("arg", "option"):
        return start.word(hole.kind, hole.about)
    if hole.kind == "search":
        return start.searched(hole.about)
    if hole.kind in ("beside", "resolved"):
        full = clean(start.remap(resolve(hole.about, start.namespace, start.name)))
        return full if hole.kind == "resolved" else full.rpartition("/")[0]
    value = start.member(hole.about) if hole.kind == "item" else start.value(hole.about)
    if value is None or isinstance(value, (str, Unknown)):
        return value
    return Unknown("name", f"{hole.about if hole.kind == 'param' else 'an item of the list'} is no text")
