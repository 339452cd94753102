# SPDX-License-Identifier: Apache-2.0
"""The properties and macros that a place of a xacro file sees (xacro's Table and NameSpace)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.robot.expressions import Invalid, Lists, Undefined
from haros_ci.robot.functions import BUILTINS, MATH, PYTHON_MODULE, Module
from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.texts import literal
from haros_ci.robot.unknown import UNKNOWN

MAX_CHAIN = 60


@dataclass(slots=True)
class _Entry:
    value: Any
    is_lazy: bool
    location: Location | None
    is_open: bool = False


@dataclass(slots=True)
class XacroGlobals:
    """What all scopes of one expansion share. *text* evaluates a text in a scope; *is_open* says that names may come from what is not read."""

    text: Callable[[str, XacroScope], Any]
    xacro: Module
    is_open: bool = False
    maybe: int = 0
    chain: int = 0
    #: Every name of a property that is set anywhere.
    ever: set[str] = field(default_factory=set)
    lists: Lists = field(default_factory=Lists)


class XacroScope:
    """Properties by name, with those around. A namespace (``ns=`` of an include) passes values on to its caller's scope."""

    def __init__(self, world: XacroGlobals, parent: XacroScope | None = None, *, is_namespace: bool = False) -> None:
        self.world = world
        self.parent = parent
        self.is_namespace = is_namespace
        self.entries: dict[str, _Entry] = {}
        self.namespaces: dict[str, XacroScope] = {}
        self.maybe = world.maybe

    def put(self, name: str, value: Any, *, lazy: bool, location: Location | None) -> None:
        """Set a property here; under an unknown condition that began after this scope, it may have either value."""
        self.world.ever.add(name)
        value = literal(value)
        if self.world.maybe > self.maybe:
            before = self.entries.get(name)
            if before is None or before.value != value:
                value = UNKNOWN
        self.lists.hold(value, self.maybe)
        self.entries[name] = _Entry(value, lazy and isinstance(value, str), location)

    def remove(self, name: str) -> None:
        scope: XacroScope | None = self
        while scope is not None:
            if self.world.maybe > scope.maybe:
                self.world.is_open = True
            scope.entries.pop(name, None)
            scope = scope.parent

    def has(self, name: str) -> bool:
        return self.is_set(name) or _offered(name, self.world) is not None

    def is_set(self, name: str) -> bool:
        """Whether it is a property here or around."""
        return any(name in scope.entries for scope in self._chain())

    def find(self, name: str) -> Any:
        """The value of a property; Undefined if there is none."""
        for scope in self._chain():
            if name in scope.entries:
                return scope._resolve(name)
        raise Undefined("property", name)

    def namespace(self, name: str) -> XacroScope | None:
        return next((scope.namespaces[name] for scope in self._chain() if name in scope.namespaces), None)

    def top(self) -> XacroScope:
        scope = self
        while scope.parent is not None:
            scope = scope.parent
        return scope

    def around(self) -> XacroScope | None:
        """The scope that ``scope="parent"`` means."""
        target = self.parent
        if not self.is_namespace:
            while target is not None and target.is_namespace:
                target = target.parent
        return target

    def look_up(self, name: str) -> Any:
        """A name inside an expression."""
        for scope in self._chain():
            if name in scope.entries:
                return scope._resolve(name)
            if name in scope.namespaces:
                return scope.namespaces[name]
        offered = _offered(name, self.world)
        if offered is not None:
            return offered
        if name in BUILTINS or self.world.is_open:
            return UNKNOWN
        raise Undefined("property", name)

    @property
    def lists(self) -> Lists:
        return self.world.lists

    def may_change(self, value: list[Any]) -> bool:
        """Whether an expression may change the list here: no unknown condition that began after it was made decides whether it does."""
        return self.lists.may_change(value, self.world.maybe)

    def member(self, name: str) -> Any:
        """``namespace.name`` inside an expression."""
        return self.look_up(name)

    def _chain(self) -> Iterator[XacroScope]:
        scope: XacroScope | None = self
        while scope is not None:
            yield scope
            scope = scope.parent

    def _resolve(self, name: str) -> Any:
        """The value, evaluated where the property is defined when it is first asked for."""
        entry = self.entries[name]
        if not entry.is_lazy:
            return self.lists.known(entry.value)
        if entry.is_open or self.world.chain > MAX_CHAIN:
            raise Invalid(f"the property {name} is defined by itself")
        entry.is_open = True
        self.world.chain += 1
        try:
            value = literal(self.world.text(entry.value, self))
        except Undefined as err:
            err.places.append(entry.location)
            raise
        finally:
            entry.is_open = False
            self.world.chain -= 1
        entry.value, entry.is_lazy = value, False
        self.lists.hold(value, self.maybe)
        return value


def _offered(name: str, world: XacroGlobals) -> Any:
    """What xacro itself offers under a name; None if it is nothing."""
    if name in MATH:
        return MATH[name]
    if name == "math":
        return MATH
    if name == "python":
        return PYTHON_MODULE
    if name == "xacro":
        return world.xacro
    if name in ("load_yaml", "abs_filename", "dotify"):
        return world.xacro.get(name)
    return PYTHON_MODULE.get(name)


@dataclass(frozen=True, slots=True)
class XacroMacro:
    """A macro: its *body* is its element as written. Not *certain*: another one may be meant by its name."""

    name: str
    body: XmlNode
    parameters: tuple[str, ...]
    defaults: Mapping[str, tuple[bool, str | None]]
    certain: bool = True


class Macros:
    """Macros by name, with those around, and namespaces of them."""

    def __init__(self, world: XacroGlobals, parent: Macros | None = None) -> None:
        self.world = world
        self.parent = parent
        self.found: dict[str, XacroMacro] = {}
        self.namespaces: dict[str, Macros] = {}
        self.maybe = world.maybe

    def get(self, name: str) -> XacroMacro | None:
        scope: Macros | None = self
        while scope is not None:
            if name in scope.found:
                return scope.found[name]
            scope = scope.parent
        return None

    def namespace(self, name: str) -> Macros | None:
        scope: Macros | None = self
        while scope is not None:
            if name in scope.namespaces:
                return scope.namespaces[name]
            scope = scope.parent
        return None

    def every(self) -> Iterator[str]:
        scope: Macros | None = self
        while scope is not None:
            yield from scope.found
            scope = scope.parent
