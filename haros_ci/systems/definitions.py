# SPDX-License-Identifier: Apache-2.0
"""The macros with which targets of CMake compile their sources, as far as its commands leave no doubt.

cmake.org: target_compile_definitions, add_compile_definitions, add_definitions, set_target_properties (COMPILE_DEFINITIONS,
COMPILE_FLAGS), target_compile_options, add_compile_options, CMAKE_CXX_FLAGS. What stands under a condition that is not decided, or
depends on what only a build knows, may be defined.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from haros_ci.index.compiled import CompiledAs
from haros_ci.model.build import Build, CMakeCommand, Target
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

_SCOPES = ("PRIVATE", "PUBLIC", "INTERFACE")
_LINK_SCOPES = {"PUBLIC": "PUBLIC", "LINK_PUBLIC": "PUBLIC", "LINK_INTERFACE_LIBRARIES": "INTERFACE"}
_LINK_SCOPES |= {"PRIVATE": "PRIVATE", "LINK_PRIVATE": "PRIVATE", "INTERFACE": "INTERFACE"}
#: ``A``, ``A=1``, ``-DA``: a name, and what comes after it.
_DEFINITION = regex(r"(?:[-/]D\s*)?([A-Za-z_]\w*)(=.*)?\Z", re.DOTALL)
_FLAG = regex(r"(?:^|(?<=[\s;\"']))[-/]([DU])\s*([A-Za-z_]\w*)(=[^\s;]*)?(?=[\s;\"']|\Z)")
_VALUE = regex(r"[\w.+-]{0,40}")
_FLAGS = ("COMPILE_FLAGS", "COMPILE_OPTIONS")
#: Commands that say something of macros for some files, or take it back: what they name may or may not be defined.
_DOUBTFUL = ("remove_definitions", "set_source_files_properties", "set_directory_properties")
#: Commands that make targets, by their names.
_MAKING = regex(r"add_(?:\w{0,20}_)?(?:executable|library)|add_(?:gtest|gmock|nodelet|node|component|plugin)")
#: Libraries that are linked by those that are linked.
_DEEPEST = 200

Definition = tuple[str, str | None]


@dataclass(slots=True)
class _Macros:
    """*sure* are defined, with their values, None for one that is not known; *maybe* may be. *is_open* if any other may be, too."""

    sure: dict[str, str | None] = field(default_factory=dict)
    maybe: set[str] = field(default_factory=set)
    is_open: bool = False

    def add(self, found: Iterable[Definition], is_sure: bool) -> None:
        for name, value in found:
            if not is_sure:
                self.maybe.add(name)
            elif self.sure.get(name, value) != value:
                self.sure[name] = None
            else:
                self.sure[name] = value

    def join(self, other: _Macros, is_sure: bool = True) -> None:
        """Add what *other* has."""
        self.add(other.sure.items(), is_sure)
        self.maybe |= other.maybe
        self.is_open = self.is_open or other.is_open


@dataclass(slots=True)
class _OfTarget:
    """What commands say of one target: of itself, of who links it, and what it links: (name, is certain, is passed on)."""

    own: _Macros = field(default_factory=_Macros)
    passed: _Macros = field(default_factory=_Macros)
    links: list[tuple[str, bool, bool]] = field(default_factory=list)
    #: Its definitions were set anew: those of its directory may be gone.
    is_replaced: bool = False


def compiled_files(builds: Mapping[str, Build]) -> dict[str, tuple[CompiledAs, ...]]:
    """Each source file as the targets of all packages compile it, where anything is known of their macros."""
    readers = {name: _Reader(build) for name, build in sorted(builds.items())}
    every = {f"{name}::{target}": found for name, reader in readers.items() for target, found in reader.targets.items()}
    found: dict[str, list[CompiledAs]] = {}
    for reader in readers.values():
        for target, unit in reader.compiled(every):
            for path in (*target.sources, *target.conditional_sources):
                found.setdefault(path, []).append(unit)
    return {
        path: tuple(dict.fromkeys(units))
        for path, units in found.items()
        if any(u.macros or u.undefined for u in units)
    }


class _Reader:
    """The commands of one package, in their order."""

    def __init__(self, build: Build) -> None:
        self.build = build
        self.root = min({command.directory for command in build.commands}, key=len, default="")
        self.targets: dict[str, _OfTarget] = {target.name: _OfTarget() for target in build.targets}
        for target in build.targets:
            if target.kind == "alias":
                self.targets[target.name].links += [(name, True, True) for name in target.links]
        #: Of directories: (directory, number of the command, macros).
        self.directories: list[tuple[str, int, _Macros]] = []
        #: Where targets are made: their directory, and the number of the command.
        self.made: dict[str, tuple[str, int]] = {}
        #: Macros that the build defines in other ways.
        self.general: set[str] = set()
        #: The branches that are not decided around what makes a target, where one command does.
        self.under: dict[str, tuple[int, ...]] = {}
        for command in build.commands:
            if command.arguments and _MAKING.search(command.name):
                self.under[command.arguments[0]] = () if command.arguments[0] in self.under else command.under
        locations = {(target.name, target.location): target.name for target in build.targets}
        for number, command in enumerate(build.commands):
            name = locations.get((command.arguments[0], command.location)) if command.arguments else None
            if name is not None:
                self.made.setdefault(name, (command.directory, number))
            run = _COMMANDS.get(command.name)
            if run is not None:
                run(self, command, number)
            elif command.name in _DOUBTFUL:
                self.doubt(command.arguments)

    def around(self, name: str) -> tuple[int, ...]:
        """The branches that are not decided around what makes a target."""
        return self.under.get(name, ())

    def doubt(self, words: Iterable[str]) -> None:
        for word in words:
            for part in word.split(";"):
                match = _DEFINITION.match(part)
                self.general |= {match[1]} if match is not None else set()
            self.general |= {match[2] for match in _FLAG.finditer(word)}

    def compiled(self, every: Mapping[str, _OfTarget]) -> Iterator[tuple[Target, CompiledAs]]:
        """The targets that have sources, and how they are compiled."""
        targets = [target for target in self.build.targets if target.sources]
        macros = {target.name: self.of(target, every) for target in targets}
        named = {name for own in macros.values() for name in own.sure}
        for target in targets:
            own = macros[target.name]
            others = named - own.sure.keys() - own.maybe if not own.is_open else set[str]()
            sure = {name: value for name, value in own.sure.items() if name not in own.maybe}
            yield (
                target,
                CompiledAs(f"{target.package}/{target.name}", tuple(sorted(sure.items())), tuple(sorted(others))),
            )

    def of(self, target: Target, every: Mapping[str, _OfTarget]) -> _Macros:
        """The macros of a target: its own, those of its directory, of flags, and of what it links."""
        own = self.targets[target.name]
        found = _Macros()
        found.join(own.own)
        directory, made = self.made.get(target.name, ("", -1))
        for place, number, macros in self.directories:
            if place == directory or (number < made and (place == "." or directory.startswith(f"{place}/"))):
                found.join(macros, is_sure=not own.is_replaced)
            elif not directory or place == "." or directory.startswith(f"{place}/"):
                found.join(macros, is_sure=False)
        found.join(_flags(self.build.flags), is_sure=directory == self.root and self.build.are_flags_known)
        for passed, is_sure in self.passed_on(own, every):
            found.join(passed, is_sure)
        found.maybe |= self.general
        return found

    def passed_on(self, own: _OfTarget, every: Mapping[str, _OfTarget]) -> Iterator[tuple[_Macros, bool]]:
        """What is linked, and by that in turn, passes on."""
        waiting = [(name, is_sure) for name, is_sure, _ in own.links]
        seen: set[str] = set()
        while waiting and len(seen) < _DEEPEST:
            name, is_sure = waiting.pop()
            linked = self.targets.get(name) or every.get(name)
            if linked is None or name in seen:
                continue
            seen.add(name)
            yield linked.passed, is_sure
            waiting += [(other, is_sure and sure) for other, sure, is_passed in linked.links if is_passed]


def _definitions(words: Iterable[str]) -> tuple[list[Definition], bool]:
    """The macros that *words* define, and whether one of the words is not known."""
    found: list[Definition] = []
    is_open = False
    parts = [part for word in words for part in (word.split(";") if "$<" not in word else (word,)) if part]
    for word in parts:
        match = _DEFINITION.match(word)
        if match is None or "${" in match[1] or "$<" in word:
            is_open = is_open or "$" in word
        else:
            found.append((match[1], _value(match[2])))
    return found, is_open


def _value(text: str | None) -> str | None:
    """What a macro is defined as: 1 if nothing says it; None for a value that a shell may change."""
    if text is None:
        return "1"
    return text[1:] if _VALUE.fullmatch(text[1:]) is not None else None


def _flags(text: str) -> _Macros:
    """The macros that options of a compiler define."""
    found = _Macros(is_open=False)
    for match in _FLAG.finditer(text):
        found.add([(match[2], _value(match[3]))], match[1] == "D")
    return found


def _is_sure(command: CMakeCommand, around: Iterable[int] = ()) -> bool:
    """Whether a command runs in each build that makes a target of which *around* are the branches around it."""
    return not command.is_test and -1 not in command.under and set(command.under) <= set(around)


def _scoped(words: Sequence[str], scopes: Mapping[str, str], first: str) -> Iterator[tuple[str, list[str]]]:
    """*words* by the keyword before them."""
    scope, found = first, list[str]()
    for word in words:
        if word in scopes:
            yield scope, found
            scope, found = scopes[word], []
        else:
            found.append(word)
    yield scope, found


def _read(words: Iterable[str], is_flags: bool) -> _Macros:
    if is_flags:
        words = list(words)
        found = _flags(" ".join(word for word in words if "$<" not in word))
        found.maybe |= {match[2] for word in words if "$<" in word for match in _FLAG.finditer(word)}
        return found
    listed, is_open = _definitions(words)
    found = _Macros(is_open=is_open)
    found.add(listed, True)
    return found


def _of_target(is_flags: bool) -> Callable[[_Reader, CMakeCommand, int], None]:
    """target_compile_definitions and target_compile_options."""

    def run(reader: _Reader, command: CMakeCommand, number: int) -> None:
        target = reader.targets.get(command.arguments[0]) if command.arguments else None
        for scope, words in (
            _scoped(command.arguments[1:], {name: name for name in _SCOPES}, "PUBLIC") if target else ()
        ):
            macros = _read(words, is_flags)
            if target is not None and scope != "INTERFACE":
                target.own.join(macros, _is_sure(command, reader.around(command.arguments[0])))
            if target is not None and scope != "PRIVATE":
                target.passed.join(macros, _is_sure(command))

    return run


def _of_directory(is_flags: bool) -> Callable[[_Reader, CMakeCommand, int], None]:
    """add_definitions, add_compile_definitions and add_compile_options."""

    def run(reader: _Reader, command: CMakeCommand, number: int) -> None:
        found = _Macros()
        found.join(_read(command.arguments, is_flags), _is_sure(command))
        found.is_open = False  # ${PCL_DEFINITIONS} and their like are of packages outside
        reader.directories.append((command.directory, number, found))

    return run


def _set_target_properties(reader: _Reader, command: CMakeCommand, number: int) -> None:
    """set_target_properties(targets PROPERTIES name value ...)."""
    words = command.arguments
    if "PROPERTIES" in words:
        at = words.index("PROPERTIES")
        pairs = words[at + 1 :]
        for key, value in zip(pairs[::2], pairs[1::2], strict=False):
            _property(reader, command, words[:at], key, (value,), is_added=False)


def _set_property(reader: _Reader, command: CMakeCommand, number: int) -> None:
    """set_property(TARGET names [APPEND] PROPERTY key values...)."""
    words = command.arguments
    if "PROPERTY" not in words[:-1]:
        return
    at = words.index("PROPERTY")
    if words[0] != "TARGET":
        reader.doubt(words[at + 2 :])
        return
    is_added = "APPEND" in words[:at] or "APPEND_STRING" in words[:at]
    names = [word for word in words[1:at] if word not in ("APPEND", "APPEND_STRING")]
    _property(reader, command, names, words[at + 1], words[at + 2 :], is_added=is_added)


def _property(
    reader: _Reader, command: CMakeCommand, names: Iterable[str], key: str, words: Iterable[str], *, is_added: bool
) -> None:
    if key not in ("COMPILE_DEFINITIONS", "INTERFACE_COMPILE_DEFINITIONS", *_FLAGS):
        if "DEFINITIONS" in key:
            reader.doubt(words)
        return
    macros = _read(words, key in _FLAGS)
    for name in [name for name in names if name in reader.targets]:
        is_own = not key.startswith("INTERFACE")
        target, is_sure = reader.targets[name], _is_sure(command, reader.around(name) if is_own else ())
        changed = target.own if is_own else target.passed
        if not is_added:  # what was there is gone, if this is run
            changed.maybe |= changed.sure.keys()
            target.is_replaced = target.is_replaced or key == "COMPILE_DEFINITIONS"
            if is_sure:
                changed.maybe -= macros.sure.keys()
        changed.join(macros, is_sure)


def _link(reader: _Reader, command: CMakeCommand, number: int) -> None:
    """target_link_libraries."""
    target = reader.targets.get(command.arguments[0]) if command.arguments else None
    for scope, words in _scoped(command.arguments[1:], _LINK_SCOPES, "PUBLIC") if target else ():
        if target is not None and scope != "INTERFACE":
            target.links += [(word, _is_sure(command), scope == "PUBLIC") for word in words]
        elif target is not None:
            target.links += [(word, False, True) for word in words]


_COMMANDS: Mapping[str, Callable[[_Reader, CMakeCommand, int], None]] = {
    "target_compile_definitions": _of_target(False),
    "target_compile_options": _of_target(True),
    "add_compile_definitions": _of_directory(False),
    "add_definitions": _of_directory(True),
    "add_compile_options": _of_directory(True),
    "set_target_properties": _set_target_properties,
    "set_property": _set_property,
    "target_link_libraries": _link,
}
