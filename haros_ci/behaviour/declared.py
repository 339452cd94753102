# SPDX-License-Identifier: Apache-2.0
"""Where properties stand: under ``hpl`` of configurations and nodes of a project file, as in HAROS, and in files that are named there.

``properties`` are promises, ``assumptions`` (or ``axioms``) what is taken for granted. HAROS has no ``files``: names of ``.hpl`` files with
properties, as ``package/path`` or as paths from the root; nor ``rules`` (``behaviour/rules.py``), which are promises, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.parser import parse_property, read_file
from haros_ci.behaviour.rules import FORM, parse_rule
from haros_ci.behaviour.sources import Lines, Source, Value, read_yaml, source_of
from haros_ci.behaviour.text import canonical
from haros_ci.behaviour.tree import Place, Property
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

PROPERTIES, AXIOMS, FILES, RULES = ("properties",), ("assumptions", "axioms"), "files", "rules"
KEYS = (*PROPERTIES, *AXIOMS, FILES, RULES)
#: Properties of one project that are read.
MOST_STATED = 5_000
#: Files of properties that one project names.
MOST_FILES = 100

#: The text of a file by the name that a project file gives it, and its path; None if it is not there.
FindFile = Callable[[str], tuple[str, str] | None]


@dataclass(frozen=True, slots=True)
class Owner:
    """What a property is about: ``configuration`` or ``node`` (``package/executable``) of this name, or everything (``workspace``, "")."""

    kind: str
    name: str

    def __str__(self) -> str:
        return f"the {self.kind} {self.name}" if self.name else "the workspace"


WORKSPACE = Owner("workspace", "")


@dataclass(frozen=True, slots=True)
class Stated:
    """One text at *location*: a property of *owner* as *parsed*, or the *fault* why it is none. *is_axiom* if it is taken for granted."""

    owner: Owner
    is_axiom: bool
    source: Source
    location: Location
    parsed: Property | None = None
    fault: HplFault | None = None

    @property
    def identity(self) -> str:
        """The property's id, else its canonical text; the text itself if it is none."""
        if self.parsed is None:
            return " ".join(self.source.text.split())[:200]
        given = self.parsed.metadata_of("id")
        return canonical(self.parsed) if given is None else given.value

    def at(self, place: Place) -> Location:
        """Where a part of it stands."""
        return self.source.location(place)


def in_project(text: str, path: str, find: FindFile) -> tuple[Stated, ...]:
    """The properties that the project file *path*, with this *text*, states and names; () where it has none."""
    if "hpl" not in text:
        return ()
    lines = Lines(text)
    top = read_yaml(lines)
    reader = _Reader(path, lines, find)
    found: list[Stated] = []
    for key, kind in (("configurations", "configuration"), ("nodes", "node")):
        for name, entry in _map(_map(top).get(key)).items():
            for one in reader.entry(Owner(kind, str(name)), _map(entry).get("hpl")):
                if len(found) >= MOST_STATED:
                    return tuple(found)
                found.append(one)
    return tuple(found)


def in_file(text: str, path: str, owner: Owner = WORKSPACE, *, is_axiom: bool = False) -> Iterator[Stated]:
    """The properties of a ``.hpl`` file, and its faults."""
    source = Source(path, text, Lines(text))
    properties, faults = read_file(text)
    for property_ in properties:
        yield Stated(owner, is_axiom, source, source.location(property_.at), property_)
    for fault in faults:
        yield Stated(owner, is_axiom, source, source.location(fault.at), fault=fault)


@dataclass(frozen=True, slots=True)
class _Reader:
    path: str
    lines: Lines
    find: FindFile
    named: list[str] = field(default_factory=list)

    def entry(self, owner: Owner, value: Value | None) -> Iterator[Stated]:
        """What stands under one ``hpl``."""
        if value is None or value.data is None:
            return
        if not isinstance(value.data, dict):
            yield self.refused(owner, value, "'hpl' must be a map", "write hpl: {properties: ['globally: no /topic']}")
            return
        for key, item in value.data.items():
            if key not in KEYS:
                continue  # HAROS passes over it
            if not isinstance(item.data, tuple):
                if item.data is not None:
                    example = FORM.removeprefix("for example ") if key == RULES else "globally: no /topic"
                    yield self.refused(owner, item, f"{key!r} must be a list", f"write {key}: ['{example}']")
                continue
            for element in item.data:
                yield from self.file(owner, element) if key == FILES else (self.one(owner, key, element),)

    def one(self, owner: Owner, key: object, value: Value) -> Stated:
        is_axiom, parse = key in AXIOMS, parse_rule if key == RULES else parse_property
        if not value.is_text:
            help_ = (
                "put it in quotes: YAML takes 'globally:' as a key"
                if isinstance(value.data, dict)
                else "put it in quotes"
            )
            return self.refused(owner, value, "a property must be text", help_)
        source = source_of(self.path, self.lines, value)
        location = source.location(Place(1, 1, 0, len(source.text)))
        try:
            return Stated(owner, is_axiom, source, location, parse(source.text))
        except HplFault as fault:
            return Stated(owner, is_axiom, source, source.location(fault.at), fault=fault)

    def file(self, owner: Owner, value: Value) -> Iterator[Stated]:
        self.named.append(str(value.data)[:1_000])
        if len(self.named) > MOST_FILES:
            if len(self.named) == MOST_FILES + 1:
                yield self.refused(owner, value, f"more than {MOST_FILES} files of properties", "join them")
            return
        found = self.find(str(value.data)) if value.is_text else None
        if found is None:
            message = (
                f"there is no file {value.data} of properties in the workspace"
                if value.is_text
                else "the name of a file must be text"
            )
            yield self.refused(
                owner, value, message, "name it as package/path/file.hpl, or from the root of the workspace"
            )
            return
        yield from in_file(found[1], found[0], owner)

    def refused(self, owner: Owner, value: Value, message: str, help: str) -> Stated:
        """A value that is no property; of one that has many lines the place is where it begins."""
        source = (
            source_of(self.path, self.lines, value)
            if value.is_text
            else Source(self.path, "", self.lines, (value.begin,))
        )
        place = Place(1, 1, 0, len(source.text))
        return Stated(owner, False, source, source.location(place), fault=HplFault(message, place, help))


def _map(value: Value | None) -> Mapping[object, Value]:
    return value.data if value is not None and isinstance(value.data, dict) else {}  # type: ignore[return-value]  # keys of a project file are texts
