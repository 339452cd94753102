# SPDX-License-Identifier: Apache-2.0
"""What a ROS 2 launch file says whether or not it is performed: arguments that it declares, reads and hands on, its includes."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch_actions import SHARE, WORKSPACE, Action, Description, Phrase, Substitution
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

_VAR = regex(r"\$\(\s*var\s+(?:'([^']*)'|\"([^\"]*)\"|([^\s)'\"]+))")
_QUOTED = regex(r"'([^'\"\\\n]*)'|\"([^'\"\\\n]*)\"")
_DECLARED = regex(r"Declare\w*Launch\w*Arg\w*\s*\(\s*(?:name\s*=\s*)?\Z")
MAX_FILES = 500


@dataclass(frozen=True, slots=True)
class FileFacts:
    """Of one launch file: names *declared* and *read*, those *mentioned* in Python elsewhere than where they are declared.

    *includes* are paths of launch files. All of it is certain only if *is_whole*.
    """

    declared: frozenset[str]
    read: frozenset[str]
    mentioned: frozenset[str]
    includes: tuple[str, ...]
    is_whole: bool


@dataclass(slots=True)
class Statics:
    """Launch files by their paths, each read once."""

    load: Callable[[str], Description | None]
    places: Places
    known: dict[str, FileFacts] = field(default_factory=dict)
    closures: dict[str, FileFacts] = field(default_factory=dict)

    def of(self, path: str) -> FileFacts:
        """What the file at *path* says itself."""
        if path not in self.known:
            description = self.load(path)
            if description is None:
                self.known[path] = FileFacts(frozenset(), frozenset(), frozenset(), (), False)
            else:
                self.known[path] = _Walk(path, self.places).description(description)
        return self.known[path]

    def closure(self, path: str) -> FileFacts:
        """What the file at *path* and all that it includes say: configurations are inherited by what is included."""
        if path not in self.closures:
            seen: dict[str, None] = {path: None}
            todo = [path]
            is_whole = True
            while todo and len(seen) < MAX_FILES:
                entry = self.of(todo.pop())
                is_whole = is_whole and entry.is_whole
                todo += [include for include in entry.includes if include not in seen]
                seen.update(dict.fromkeys(entry.includes))
            every = [self.of(item) for item in seen]
            self.closures[path] = FileFacts(
                frozenset().union(*(entry.declared for entry in every)),
                frozenset().union(*(entry.read for entry in every)),
                frozenset().union(*(entry.mentioned for entry in every)),
                tuple(seen),
                is_whole and not todo,
            )
        return self.closures[path]

    def is_used(self, name: str, path: str) -> bool | None:
        """Whether the argument *name* that the file at *path* declares is read by what sees it; None if that is not known."""
        whole = self.closure(path)
        inner = [self.of(include) for include in whole.includes if include != path]
        if name in whole.read or any(name in entry.declared for entry in inner):
            return True
        return False if whole.is_whole and name not in whole.mentioned else None


@dataclass(slots=True)
class _Walk:
    path: str
    places: Places
    declared: set[str] = field(default_factory=set)
    read: set[str] = field(default_factory=set)
    includes: dict[str, None] = field(default_factory=dict)
    is_whole: bool = True

    def description(self, description: Description) -> FileFacts:
        text = self.places.workspace.text(self.path)
        mentioned: frozenset[str] = frozenset()
        if description.problems:
            self.is_whole = False
        for action in description.actions:
            self.action(action)
        if self.path.endswith(".py"):
            mentioned = frozenset(_mentioned(text))
        else:
            self.scan(text)
        return FileFacts(frozenset(self.declared), frozenset(self.read), mentioned, tuple(self.includes), self.is_whole)

    def scan(self, text: str) -> None:
        """All ``$(var x)`` in a text, whatever attribute it is in."""
        for match in _VAR.finditer(text):
            name = match[1] or match[2] or match[3] or ""
            if "$(" in name:
                self.is_whole = False
            self.read.add(name)

    def action(self, action: Action) -> None:
        if action.kind in ("?", "opaque") or action.function is not None:
            self.is_whole = False
        if action.kind == "arg":
            self.name(action.get("name"), self.declared)
        elif action.kind == "include":
            self.include(action)
        for _, phrase in action.phrases:
            self.phrase(phrase)
        for pair in (*action.arguments, *action.environment, *(remap[:2] for remap in action.remaps)):
            for phrase in pair:
                self.phrase(phrase)
        for source in action.parameters:
            self.is_whole = self.is_whole and source.kind != "?"
            self.phrase(source.path)
            self.data(source.values)
            if source.substitutes:
                self.parameters(source.path)
        for test in action.tests:
            self.is_whole = self.is_whole and test.kind != "?"
            for phrase in test.phrases:
                self.phrase(phrase)
            if test.kind in ("equals", "not-equals") and test.phrases:
                self.name(test.phrases[0], self.read)
        for child in action.children:
            self.action(child)

    def include(self, action: Action) -> None:
        path = constant_path(action.get("file") or (), self.path)
        place = self.places.find(path) if path is not None else None
        if place is None or place.path is None:
            self.is_whole = False
        else:
            self.includes[place.path] = None

    def parameters(self, phrase: Phrase) -> None:
        """A parameter file in which substitutions are performed."""
        path = constant_path(phrase, self.path)
        found, content, _ = self.places.read(path) if path is not None else (None, "", "")
        if found is None:
            self.is_whole = False
        self.scan(content)

    def name(self, phrase: Phrase | None, names: set[str]) -> None:
        if phrase and all(isinstance(part, str) for part in phrase):
            names.add("".join(part for part in phrase if isinstance(part, str)))
        else:
            self.is_whole = False

    def phrase(self, phrase: Phrase) -> None:
        for part in phrase:
            if isinstance(part, str):
                continue
            if part.kind in ("?", "file-content", "moveit"):
                self.is_whole = False
            elif part.kind == "var":
                self.name(part.arguments[0] if part.arguments else None, self.read)
            for argument in part.arguments:
                self.phrase(argument)
            self.data(part.data)

    def data(self, data: Any) -> None:
        """Phrases inside of plain data."""
        if isinstance(data, Substitution):
            self.phrase((data,))
        elif isinstance(data, Mapping):
            for item in (*data.keys(), *data.values()):
                self.data(item)
        elif isinstance(data, (list, tuple)):
            for item in data:
                self.data(item)


def constant_path(phrase: Phrase, file: str) -> str | None:
    """The path that *phrase* is in the launch file *file* whatever is set; None if it depends on something."""
    parts: list[str] = []
    for part in phrase:
        if isinstance(part, str):
            parts.append(part)
            continue
        inner = [constant_path(argument, file) for argument in part.arguments]
        if any(item is None for item in inner):
            return None
        known = [item for item in inner if item is not None]
        if part.kind == "find-pkg-share" and len(known) == 1:
            parts.append(SHARE.format(known[0]))
        elif part.kind == "dirname":
            parts.append(WORKSPACE.format(posixpath.dirname(file) or "."))
        elif part.kind == "join":
            parts.append("/".join(item.rstrip("/") for item in known))
        else:
            return None
    return "".join(parts)


def _mentioned(text: str) -> Iterator[str]:
    """The quoted texts of a Python file, but for names in declarations of arguments."""
    for match in _QUOTED.finditer(text):
        if not _DECLARED.search(text, max(0, match.start() - 80), match.start()):
            yield match[1] if match[1] is not None else match[2]
