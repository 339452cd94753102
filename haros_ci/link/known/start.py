# SPDX-License-Identifier: Apache-2.0
"""How a node is started: its name, arguments and parameters, and what they make of a text with holes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from haros_ci.link.known.text import Hole, Template
from haros_ci.link.names import UNKNOWN, clean, resolve
from haros_ci.link.values import Choice, Known, Mapped, Opaque, Sequence, Text, data_of, opaque_of
from haros_ci.model.architecture import Unknown

_VALUES = (Choice, Known, Mapped, Opaque, Sequence, Text)


@dataclass(frozen=True, slots=True)
class Start:
    """One node being started; *item* is that of a list, None outside one."""

    name: str
    namespace: str
    arguments: tuple[str, ...]
    parameter: Callable[[str], object | None]
    remap: Callable[[str], str]
    distribution: str | None
    item: object = None

    def value(self, name: str) -> object | None:
        """A parameter: None if it is not set, an Unknown if its value is no data."""
        found = self.parameter(resolve(name, self.namespace, self.name))
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
        words = [word for word in self.arguments if ":=" not in word]
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

    def searched(self, name: str) -> str | Unknown:
        """The parameter that ``searchParam`` finds from the namespace upwards (wiki.ros.org/Parameter Server)."""
        parts = [part for part in self.namespace.split("/") if part]
        places = [clean("/".join([*parts[:n], name])) for n in range(len(parts), -1, -1)]
        for place in places:
            found = self.parameter(place)
            if isinstance(found, Unknown) and found.field == "presence":
                return replace(found, field="name")
            if found is not None:
                return place
        return places[0] if len(places) == 1 else Unknown("name", f"{name} is searched for, and set nowhere")


def called(kind: str, about: str) -> str:
    """What a hole or a condition asks for, in the words of a person."""
    if kind == "arg":
        return f"argument {int(about) + 1} on the command line"
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
            inner, said = filled(part.default, start)
            text += inner
            unknowns += said
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
    value = start.item if hole.kind == "item" else start.value(hole.about)
    if hole.kind == "item" and hole.about and isinstance(value, Mapping):
        value = value.get(hole.about)
    if value is None or isinstance(value, (str, Unknown)):
        return value
    return Unknown("name", f"{hole.about if hole.kind == 'param' else 'an item of the list'} is no text")
