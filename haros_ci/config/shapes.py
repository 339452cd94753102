# SPDX-License-Identifier: Apache-2.0
"""Reading a project file's values as what they should be, with errors that name file, line and the way out."""

from __future__ import annotations

from haros_ci.config.suggestion import did_you_mean, quoted, suggestion
from haros_ci.config.yaml_lines import YamlValue
from haros_ci.errors import UserError
from haros_ci.model import globs
from haros_ci.records import dataclass, field

MAX_NOTES = 20
MAX_ENTRIES = 1_000
#: The largest numbers by their unit: what clocks and limits of processes can hold, with room to spare.
LARGEST = {"seconds": 1_000_000}
LARGEST_COUNT = 1_000_000_000_000


@dataclass(frozen=True, slots=True)
class NamedShape:
    """A text of the file and its line."""

    text: str
    line: int


@dataclass(slots=True)
class File:
    """How messages name the project file, and whether it is ours alone (*strict*) or may be HAROS's, too.

    It gathers the notes on what was read but has no effect; beyond MAX_NOTES they are only counted.
    """

    name: str
    strict: bool
    remarks: list[str] = field(default_factory=list)
    unsaid: int = 0

    @property
    def notes(self) -> tuple[str, ...]:
        return (*self.remarks, *([f"{self.name}: and {self.unsaid} more notes"] if self.unsaid else []))

    def note(self, message: str, line: int | None = None, help: str | None = None) -> None:
        if len(self.remarks) < MAX_NOTES:
            where = self.name if line is None else f"{self.name}:{line}"
            self.remarks.append(f"{where}: {message}" + (f"; {help}" if help else ""))
        else:
            self.unsaid += 1

    def error(self, line: int, message: str, help: str | None = None) -> UserError:
        return UserError(f"{self.name}:{line}: {message}", help=help)

    def unknown(self, key: str, line: int, known: tuple[str, ...]) -> None:
        if self.strict:
            raise self.error(line, f"unknown key {quoted(key)}", suggestion(key, known))
        near = did_you_mean(key, known) if len(self.remarks) < MAX_NOTES else None
        self.note(f"key {quoted(key)} has no effect", line, near)

    def map(self, value: YamlValue, what: str, form: str, known: tuple[str, ...] | None = None) -> dict[str, YamlValue]:
        """A map with text keys (HAROS takes any scalar); keys with an empty value are left out, as if not there.

        A key that is not *known* is an error; in a HAROS file, which may hold any, a note.
        """
        if value.data is None:
            return {}
        if not isinstance(value.data, dict):
            raise self.error(value.line, f"{what} must be a map, not {kind(value)}", f"write {form}")
        for key, item in value.data.items():
            if self.strict and not isinstance(key, str):
                raise self.error(item.key_line, f"key {quoted(key)} in {what} must be text", "put it in quotes")
            if known is not None and key not in known:
                self.unknown(str(key), item.key_line, known)
        return {str(key): item for key, item in value.data.items() if item.data is not None}

    def texts(self, value: YamlValue, what: str) -> tuple[NamedShape, ...]:
        """A list of non-empty texts."""
        form = f"write {what}: [{quoted(value.data) if isinstance(value.data, str) else '…'}]"
        if not isinstance(value.data, tuple):
            raise self.error(value.line, f"'{what}' must be a list, not {kind(value)}", form)
        self.bounded(value, what)
        return tuple(NamedShape(self.text(item, f"an entry of '{what}'"), item.line) for item in value.data)

    def names(self, value: YamlValue, what: str) -> tuple[NamedShape, ...]:
        """A list as HAROS takes it: of any scalars; a lone scalar is a list of one, a map is its keys."""
        self.bounded(value, what)
        if isinstance(value.data, dict):
            return tuple(NamedShape(str(key), item.key_line) for key, item in value.data.items())
        items = value.data if isinstance(value.data, tuple) else (value,)
        for item in items:
            if isinstance(item.data, (dict, tuple)):
                raise self.error(item.line, f"an entry of '{what}' must be text, not {kind(item)}")
        return tuple(NamedShape(str(item.data), item.line) for item in items if item.data not in (None, ""))

    def bounded(self, value: YamlValue, what: str) -> None:
        """Every entry is held against every rule or file, so lists have an end."""
        if isinstance(value.data, (dict, tuple)) and len(value.data) > MAX_ENTRIES:
            raise self.error(value.line, f"'{what}' has more than {MAX_ENTRIES} entries", "use globs or tags")

    def text(self, value: YamlValue, what: str) -> str:
        if not isinstance(value.data, str):
            raise self.error(value.line, f"{what} must be text, not {kind(value)}", "put it in quotes")
        if not value.data.strip():
            raise self.error(value.line, f"{what} is empty", "write something or leave it out")
        return value.data

    def choice(self, value: YamlValue, what: str, known: tuple[str, ...]) -> str:
        if not isinstance(value.data, str) or value.data not in known:
            shown = quoted(value.data) if not isinstance(value.data, (dict, tuple)) else kind(value)
            help_ = suggestion(str(value.data), known) if isinstance(value.data, str) else None
            raise self.error(value.line, f"{what} cannot be {shown}", help_ or f"one of: {', '.join(known)}")
        return value.data

    def flag(self, value: YamlValue, what: str) -> bool:
        if not isinstance(value.data, bool):
            raise self.error(value.line, f"{what} must be true or false, not {kind(value)}", "write true or false")
        return value.data

    def number(self, value: YamlValue, what: str, unit: str) -> float:
        """A finite number above 0."""
        number = value.data
        if isinstance(number, bool) or not isinstance(number, (int, float)):
            raise self.error(value.line, f"{what} must be a number of {unit}, not {kind(value)}", "write a bare number")
        if not number > 0:  # nor is NaN
            raise self.error(value.line, f"{what} must be above 0, not {quoted(number)}", f"write a number of {unit}")
        if number > LARGEST.get(unit, LARGEST_COUNT):
            most = f"{LARGEST.get(unit, LARGEST_COUNT):,}"
            raise self.error(value.line, f"{what} is too large a number of {unit}", f"write at most {most}")
        return number

    def count(self, value: YamlValue, what: str, unit: str) -> int:
        """A whole number above 0."""
        number = self.number(value, what, unit)
        if not isinstance(number, int):
            raise self.error(value.line, f"{what} must be a whole number of {unit}", "leave out the fraction")
        return number

    def glob(self, glob: NamedShape) -> str:
        fault = globs.fault(glob.text)
        if fault is not None:
            raise self.error(glob.line, f"{quoted(glob.text)}: {fault}", "write it like src/third_party/**")
        return glob.text

    def path(self, value: YamlValue, what: str, *, anywhere: bool) -> str:
        """A path relative to the workspace root; one that leads out of it only if *anywhere*."""
        path = self.text(value, what)
        if not anywhere and (path.startswith(("/", "~")) or ".." in path.split("/")):
            raise self.error(
                value.line,
                f"{what} must lie in the workspace, not at {quoted(path)}",
                "give the path on the command line, or trust the file with --trust-config",
            )
        return path


def kind(value: YamlValue) -> str:
    """What a value is, in words."""
    match value.data:
        case None:
            return "empty"
        case bool():
            return f"{str(value.data).lower()} (true or false)"
        case int() | float():
            return "a number"
        case str():
            return "a text"
        case dict():
            return "a map"
        case _:
            return "a list"
