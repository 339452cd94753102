# SPDX-License-Identifier: Apache-2.0
"""What is known while the CMake of a package is followed: variables by scope, targets, doubts, and how much is left."""

from __future__ import annotations

import re
from collections.abc import Sequence

from haros_ci.model.build import CMakeCommand
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.workspace.cmake_choices import may_be_given
from haros_ci.workspace.cmake_parse import CMakeArgument, ParsedCommand
from haros_ci.workspace.cmake_words import (
    MAYBE,
    UNKNOWN,
    absolute,
    cleaned,
    inside,
    is_certain,
    readable,
    split_list,
    unknown,
    written,
)
from haros_ci.workspace.tree import PathTree

#: What evaluation may cost in all: about one for each command and for each hundred characters it handles.
MAX_STEPS = 100_000
MAX_VALUE = 100_000
MAX_CALLS = 40
MAX_PROBLEMS = 100
MAX_MESSAGE = 500
#: CMAKE_MATCH_0 to CMAKE_MATCH_9 (cmake-variables(7)).
_GROUPS = 10

_PIECE = regex(r"\$(?:ENV|CACHE)?\{|\}|\\(?:.|$)|[^$\\}]+|\$", re.DOTALL)
_ESCAPED = {"\\n": "\n", "\\t": "\t", "\\r": "\r", "\\;": "\\;", "\\\n": ""}
_MISSING = "\ue000\ue000"
#: How configurations of packages call their variables, as catkin's and ament's do: the package, in small letters, and what it is.
_OF_A_PACKAGE = regex(r"(?!(?:catkin|ament_\w+)_FOUND)([a-z][a-z0-9]*(?:_[a-z0-9]+)*)_[A-Z][A-Z0-9_]*")
#: What says that a package was found, but those that a ROS has or has not: nothing finds these by the way.
_SAYS_FOUND = regex(r"(?!(?:catkin|CATKIN|ament_\w+|AMENT_\w+)_FOUND)\w+_FOUND", re.ASCII)


class CMakeBudgetExhausted(Exception):
    """The budget is used up."""


@dataclass(frozen=True, slots=True)
class Doubt:
    """A construct that cannot be decided; *text* is its condition.

    *leaving* is the return, break or continue in it that makes what follows doubtful, too. *branch* numbers the branches that are gone
    through.
    """

    path: str
    line: int
    text: str
    leaving: str = ""
    branch: int = field(default=0, compare=False)


@dataclass(slots=True)
class CMakeTarget:
    """A target as far as it is known. Sources and links map to whether they are certain."""

    name: str
    kind: str
    location: Location
    sources: dict[str, bool] = field(default_factory=dict)
    links: dict[str, bool] = field(default_factory=dict)
    properties: dict[str, str] = field(default_factory=dict)
    is_installed: bool = False
    is_conditional: bool = False
    is_test: bool = False


@dataclass(slots=True)
class EvaluatedCommand:
    """A command with its arguments evaluated; ``quoted`` tells which were in quotes or brackets."""

    name: str
    words: list[str]
    quoted: list[bool]
    location: Location
    command: ParsedCommand


@dataclass(frozen=True, slots=True)
class InstalledLater:
    """A file or directory of the build tree, *source*, that is installed as *path* below the prefix."""

    source: str
    path: str


Entry = tuple[dict[str, str | None], str, str | None]


class CMakeState:
    """Everything that commands read and change."""

    def __init__(self, tree: PathTree, package: Package) -> None:
        self.tree = tree
        self.package = package
        self.steps = MAX_STEPS
        self.cache: dict[str, str | None] = {}
        self.scopes: list[dict[str, str | None]] = [{}]
        self.environment: dict[str, str] = {}
        self.unknown_prefixes: set[str] = set()
        self.is_choosing = False  # a condition is looked at that decides between packages
        self.functions: dict[str, tuple[ParsedCommand, str]] = {}
        self.targets: dict[str, CMakeTarget] = {}
        self.installed: dict[tuple[str, str, str, str], Location] = {}
        #: By the place of what configure_file() writes: the template, and the text, None where it is not known.
        self.configured: dict[str, tuple[str, str | None]] = {}
        self.installed_later: dict[InstalledLater, None] = {}
        self.plugin_files: dict[str, Location] = {}
        self.noted: set[str] = set()
        self.components: list[tuple[str, str, Location]] = []
        self.interfaces: dict[str, Location] = {}
        self.configs: dict[str, Location] = {}
        self.parameter_libraries: dict[tuple[str, str, str], Location] = {}
        self.auto_found: dict[str, None] = {}
        self.python_packages: dict[str, str] = {}
        self.defined: set[str] = set()
        self.testing = 0
        self.declares_interfaces = False
        self.file = ""
        self.site: Location | None = None
        self.calls = 0
        self.branches = 0
        self.depth = 0
        self.doubts: list[Doubt] = []
        self.hidden: dict[Doubt, dict[str, None]] = {}
        self.problems: dict[Problem, None] = {}
        self.journal: list[Entry] | None = None
        self.seen_files: set[str] = set()
        self.guarded: set[str] = set()
        self.pending: list[tuple[str, str, str]] = []
        self.lent: set[str] = set()
        self.commands: dict[CMakeCommand, None] = {}

    def keep(self, call: EvaluatedCommand) -> None:
        """Remember that a command was followed."""
        command = CMakeCommand(
            name=call.name,
            arguments=tuple(written(word) for word in call.words),
            location=call.location,
            directory=inside(self.source_directory()) or ".",
            is_conditional=bool(self.doubts) or any(MAYBE in word for word in call.words),
            is_test=bool(self.testing),
            under=(*(doubt.branch for doubt in self.doubts), *([-1] if any(MAYBE in w for w in call.words) else [])),
        )
        self.commands[command] = None

    def spend(self, cost: int = 1) -> None:
        self.steps -= cost
        if self.steps < 0:
            raise CMakeBudgetExhausted

    def get(self, name: str) -> str | None:
        """A variable's value, None if it is not set; what an outer package would set is unknown."""
        for scope in reversed(self.scopes):
            if name in scope:
                value = scope[name]
                if value is not None:
                    return value
                break
        else:
            if self.is_choosing and name not in self.cache and may_be_given(name):
                return unknown(name)
        value = self.cache.get(name)
        if value is None and self.unknown_prefixes and (self.is_foreign(name) or _may_be_found(name)):
            return unknown(name)
        return value

    def seen_from(self, scope: dict[str, str | None], name: str) -> str | None:
        """The value that *scope*, one of the open ones or the cache, has for a variable or inherits."""
        if scope is self.cache:
            return scope.get(name)
        depth = next((number for number, item in enumerate(self.scopes) if item is scope), -1)
        for item in reversed(self.scopes[: depth + 1]):
            if name in item:
                return item[name]
        return scope.get(name, self.cache.get(name))

    def is_foreign(self, name: str) -> bool:
        """Whether the variable is named after a package that was looked for, or after another one, which that may look for in turn."""
        at = name.find("_")
        while at > 0:
            if name[:at] in self.unknown_prefixes:
                return True
            at = name.find("_", at + 1)
        match = _OF_A_PACKAGE.fullmatch(name) if self.unknown_prefixes else None
        return match is not None and match[1] not in (self.package.name, self.get("PROJECT_NAME"))

    def put_groups(self, match: Sequence[str] | None) -> None:
        """Set CMAKE_MATCH_<n> to the groups of a match; a text that does not match leaves them, and of an unknown one nobody knows them."""
        if match is None:
            for name in ("COUNT", *map(str, range(_GROUPS))):
                self.put(f"CMAKE_MATCH_{name}", unknown(f"CMAKE_MATCH_{name}"))
        elif match:
            self.put("CMAKE_MATCH_COUNT", str(len(match) - 1))
            for number, group in enumerate(match):
                self.put(f"CMAKE_MATCH_{number}", group)

    def put(self, name: str, value: str | None, scope: dict[str, str | None] | None = None) -> None:
        """Set a variable, or unset it with None."""
        if value is not None:
            self.spend(len(value) // 200)
            if len(value) > MAX_VALUE:
                raise CMakeBudgetExhausted
        target = self.scopes[-1] if scope is None else scope
        if self.journal is not None:
            self.journal.append((target, name, target.get(name, _MISSING)))
        target[name] = value

    def roll_back(self, journal: list[Entry]) -> dict[tuple[int, str], Entry]:
        """Undo what *journal* tells; what the variables were before that, by scope and name."""
        after = {(id(scope), name): (scope, name, scope.get(name, _MISSING)) for scope, name, _ in journal}
        for scope, name, old in reversed(journal):
            if old == _MISSING:
                scope.pop(name, None)
            else:
                scope[name] = old
        return after

    def where(self, command: ParsedCommand) -> Location:
        """Where the user wrote it: the outermost call of a function, or the command itself."""
        return self.site or Location(self.file, command.line, command.column)

    def source_directory(self) -> str:
        return self.get("CMAKE_CURRENT_SOURCE_DIR") or absolute(self.package.path)

    def problem(self, location: Location, message: str) -> None:
        if len(self.problems) < MAX_PROBLEMS:
            self.problems[Problem(location.path, message[:MAX_MESSAGE], location.line)] = None

    def missing(self, call: EvaluatedCommand, message: str) -> None:
        """A problem with what a command names, unless it may not be run at all."""
        if not self.doubts:
            self.problem(call.location, readable(message))

    def record(self, what: str) -> None:
        """Note *what* with the undecided construct around it, if there is one."""
        for doubt in self.doubts[-1:]:
            self.hidden.setdefault(doubt, {})[what] = None

    def evaluate(self, text: str) -> str:
        """*text* with references replaced, inner ones first, and escapes resolved (cmake-language(7))."""
        parts: list[str] = []
        stack: list[tuple[str, int, list[str]]] = []
        for match in _PIECE.finditer(text):
            piece = match[0]
            if piece[0] == "$" and piece[-1] == "{":
                stack.append((piece, match.start(), parts))
                parts = []
            elif piece == "}" and stack:
                opening, start, outer = stack.pop()
                is_whole = (not start or text[start - 1] == ";") and text[match.end() : match.end() + 1] in ("", ";")
                outer.append(self._refer(opening, "".join(parts), is_whole))
                parts = outer
            elif piece[0] == "\\":
                parts.append(_ESCAPED.get(piece, piece[1:]))
            else:
                parts.append(piece)
        while stack:
            opening, _, outer = stack.pop()
            parts = [*outer, opening, *parts]
        value = "".join(parts)
        self.spend(len(value) // 100)
        if len(value) > MAX_VALUE:
            raise CMakeBudgetExhausted
        return value

    def _refer(self, opening: str, name: str, is_whole: bool) -> str:
        """The value of one reference. A doubtful one cannot be part of another word: there it is unknown."""
        if not is_certain(name):
            return unknown(name.replace(UNKNOWN, "$") if len(name) < 200 else "...")
        if opening == "$ENV{":
            return self.environment.get(name, unknown(f"ENV:{name}"))
        value = self.cache.get(name) if opening == "$CACHE{" else self.get(name)
        if value is None:
            return ""
        self.spend(len(value) // 100)
        return value if is_whole or is_certain(value) else unknown(name)

    def expand(
        self, command: ParsedCommand, arguments: tuple[CMakeArgument, ...], macro: dict[str, str] | None
    ) -> EvaluatedCommand:
        """The arguments of *command* as words: unquoted ones are split at semicolons and vanish if empty."""
        words: list[str] = []
        quoted: list[bool] = []
        for argument in arguments:
            text = argument.text
            if argument.is_plain:
                words.append(cleaned(text))
                quoted.append(argument.is_quoted)
                continue
            text = cleaned(text)
            if macro is not None and not argument.is_literal:
                text = substitute(text, macro)
            if argument.is_quoted:
                words.append(text if argument.is_literal else self.evaluate(text))
                quoted.append(True)
            else:
                elements = [element for element in split_list(self.evaluate(text)) if element]
                words += elements
                quoted += [False] * len(elements)
        self.spend(1 + len(words) // 10)
        return EvaluatedCommand(command.name, words, quoted, self.where(command), command)


def _may_be_found(name: str) -> bool:
    """Whether looking for one package may say this of another: Qt4 sets QT_FOUND, and a package finds what it depends on."""
    return name.endswith("_FOUND") and _SAYS_FOUND.fullmatch(name) is not None


_MACRO_REFERENCE = regex(r"\$\{(\w+)\}")


def substitute(text: str, macro: dict[str, str]) -> str:
    """*text* with a macro's parameters replaced, as text, before anything else is evaluated."""
    return _MACRO_REFERENCE.sub(lambda match: macro.get(match[1], match[0]), text)


def condition_text(command: ParsedCommand) -> str:
    """The arguments of a command as written, on one line."""
    words = [f'"{a.text}"' if a.is_quoted else a.text for a in command.arguments]
    return readable(" ".join(words).replace("\n", " "))[:120]
