# SPDX-License-Identifier: Apache-2.0
"""Names, places and conditions as HAROS's queries see them (``metamodel.py``: RosName, Location, SourceCondition)."""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar

from haros_ci.model.architecture import Condition
from haros_ci.model.architecture import Qos as ModelQos
from haros_ci.model.location import Location as Place
from haros_ci.query.values import UNKNOWN, QueryEntity, Value

if TYPE_CHECKING:
    from haros_ci.query.source import QueryPackage, QuerySourceFile, SourceModel


def readers(*names: str) -> dict[str, Any]:
    """Attributes that a query may read, and how."""
    return {name: attrgetter(name) for name in names}


def kept(get: Callable[[Any], Value]) -> Any:
    """A property that is worked out once for each entity, which keeps it in its ``cache``."""
    name = get.__name__

    def value(self: Any) -> Value:
        if name not in self.cache:
            self.cache[name] = get(self)
        return self.cache[name]

    return property(value)


class RosName(QueryEntity):
    """A name, resolved (*full*) and as the source has it (*given*); equal to its full text."""

    __slots__ = ("full", "given_text")
    KIND = "RosName"
    ATTRIBUTES: ClassVar[dict[str, Any]] = readers(
        "full", "own", "namespace", "given", "is_global", "is_private", "is_unresolved", "pattern"
    )

    def __init__(self, full: str, value: str | None) -> None:
        self.full = full
        self.given_text = value

    @property
    def given(self) -> Value:
        return UNKNOWN if self.given_text is None else self.given_text

    @property
    def own(self) -> str:
        return self.full.rpartition("/")[2]

    @property
    def namespace(self) -> str:
        return self.full.rpartition("/")[0] or "/"

    @property
    def is_global(self) -> bool:
        """Whether it was given with a leading ``/``; False where that is not known."""
        return self.given_text is not None and self.given_text.startswith("/")

    @property
    def is_private(self) -> bool:
        return self.given_text is not None and self.given_text.startswith("~")

    @property
    def is_unresolved(self) -> bool:
        return "?" in self.full

    @property
    def pattern(self) -> str:
        """A regular expression with the unknown parts open: a whole part between slashes may be missing."""
        text = self.full.replace("/?/", "\0").replace("?", "\1")
        return text.replace("\0", "(/.+?)?/").replace("\1", "(.+?)") + "$"

    def __eq__(self, other: object) -> bool:
        if isinstance(other, RosName):
            return self.full == other.full
        return self.full == other if isinstance(other, str) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.full)

    def words(self) -> str:
        return self.full


class QueryLocation(QueryEntity):
    """A place in the source, with the entities that it is in."""

    __slots__ = ("file", "package", "place")
    KIND = "Location"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers("package", "file", "line", "column", "largest_scope", "smallest_scope"),
        "function": lambda self: None,
        "class_": lambda self: None,
    }

    def __init__(self, place: Place, package: QueryPackage | None, file: QuerySourceFile | None) -> None:
        self.place = place
        self.package = package
        self.file = file

    @property
    def line(self) -> int | None:
        return self.place.line

    @property
    def column(self) -> int | None:
        return self.place.column

    @property
    def largest_scope(self) -> Value:
        return self.package

    @property
    def smallest_scope(self) -> Value:
        return self.file or self.package

    def words(self) -> str:
        return f"in {self.place}"


class Location2(QueryEntity):
    """A place in words: the names of package and file, line and column."""

    __slots__ = ("column", "file", "line", "package")
    KIND = "Location2"
    ATTRIBUTES: ClassVar[dict[str, Any]] = readers("package", "file", "line", "column")

    def __init__(self, package: str | None, file: str | None, line: int | None, column: int | None) -> None:
        self.package = package
        self.file = file
        self.line = line
        self.column = column

    def _key(self) -> tuple[object, ...]:
        return (self.package, self.file, self.line, self.column)

    def __eq__(self, other: object) -> bool:
        return self._key() == other._key() if isinstance(other, Location2) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._key())

    def words(self) -> str:
        return f"{self.package}/{self.file}:{self.line}:{self.column}"


class RuntimeLocation(QueryEntity):
    """The place of what exists only when the system runs: its configuration."""

    __slots__ = ("configuration",)
    KIND = "RuntimeLocation"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers("configuration"),
        "largest_scope": attrgetter("configuration"),
        "smallest_scope": attrgetter("configuration"),
    }

    def __init__(self, configuration: QueryEntity) -> None:
        self.configuration = configuration

    def words(self) -> str:
        return f"in configuration {getattr(self.configuration, 'name', '?')}"


class SourceCondition(QueryEntity):
    """A statement that an entity stands under."""

    __slots__ = ("made", "world")
    KIND = "SourceCondition"
    ATTRIBUTES: ClassVar[dict[str, Any]] = readers("statement", "condition", "location", "location2", "language")

    def __init__(self, made: Condition, world: SourceModel) -> None:
        self.made = made
        self.world = world

    @property
    def statement(self) -> str:
        return self.made.statement

    @property
    def condition(self) -> str:
        return self.made.condition

    @property
    def location(self) -> Value:
        return self.world.location(self.made.location)

    @property
    def location2(self) -> Value:
        return self.world.location2(self.made.location)

    @property
    def language(self) -> str:
        file = self.world.files.get(self.made.location.path)
        return file.language if file is not None else "unknown"

    def __eq__(self, other: object) -> bool:
        return self.made == other.made if isinstance(other, SourceCondition) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.made)

    def words(self) -> str:
        return f"{self.statement} {self.condition}"


class QueryQos(QueryEntity):
    """The quality of service of a ROS 2 end: None is the middleware's default."""

    __slots__ = ("made",)
    KIND = "Qos"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        name: (lambda self, name=name: _known(getattr(self.made, name)))
        for name in ("history", "depth", "reliability", "durability", "deadline", "lifespan", "liveliness", "lease")
    }

    def __init__(self, made: ModelQos) -> None:
        self.made = made

    def __eq__(self, other: object) -> bool:
        return self.made == other.made if isinstance(other, QueryQos) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.made)

    def words(self) -> str:
        named = ((name, getattr(self.made, name)) for name in self.ATTRIBUTES)
        return f"Qos({', '.join(f'{name}={value}' for name, value in named if value is not None)})"


def _known(value: Value) -> Value:
    return UNKNOWN if value == "?" else value
