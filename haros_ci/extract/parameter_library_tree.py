# SPDX-License-Identifier: Apache-2.0
"""What the YAML of generate_parameter_library declares: structs and parameters, and the faults that a build reports."""

from __future__ import annotations

import re

from haros_ci.bounded_yaml import Scalar, YamlFault
from haros_ci.extract.parameter_library_yaml import Value, parse_yaml
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

MAX_PROBLEMS = 100
#: What a key begins with whose struct there is once for each element of the array that the rest of it names.
MAP = "__map_"

_BASES = {"bool": bool, "int": int, "double": float, "string": str}
_TYPE = regex(r"(bool|int|double|string)(_array)?(_fixed_\d+)?\Z", re.ASCII)
_KEYS = frozenset(("type", "default_value", "description", "read_only", "additional_constraints", "validation"))
_NAME = regex(r"[A-Za-z_]\w*\Z", re.ASCII)
_ROOT = regex(r"[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*\Z", re.ASCII)

Element = bool | int | float | str


@dataclass(frozen=True, slots=True)
class Declared:
    """One parameter: *path* from the root struct on, *base* and *is_array* its type, *default* None if it has none.

    *is_sure* is False where the default is not of the type. *checks* are validators with their arguments. *keys* are
    the paths of the arrays that the maps around it take their keys from.
    """

    path: tuple[str, ...]
    base: str
    is_array: bool
    default: Element | tuple[Element, ...] | None
    is_sure: bool
    description: str
    read_only: bool
    constraints: str
    checks: tuple[tuple[str, tuple[Scalar, ...]], ...]
    line: int
    column: int
    keys: tuple[tuple[str, ...], ...] = ()


@dataclass(slots=True)
class Struct:
    """A level of the YAML; *path* is empty for the root, whose struct is called Params."""

    path: tuple[str, ...]
    line: int
    column: int
    parameters: list[Declared] = field(default_factory=list)
    structs: list[Struct] = field(default_factory=list)

    @property
    def is_map(self) -> bool:
        return bool(self.path) and self.path[-1].startswith(MAP)


@dataclass(slots=True)
class Library:
    """A file: *name* is the root key, *order* its parameters as they are declared, *problems* are (line, message)."""

    name: str = ""
    root: Struct = field(default_factory=lambda: Struct((), 1, 1))
    order: list[Declared] = field(default_factory=list)
    problems: list[tuple[int, str]] = field(default_factory=list)


def read_library(text: str) -> Library:
    """The library that *text* describes, as generate_parameter_library reads it (its README, "Parameter schema")."""
    library = Library()
    try:
        top = parse_yaml(text)
    except YamlFault as fault:
        library.problems.append((fault.line, f"{fault.message}; the parameters of this library are missing"))
        return library
    if top is None or not isinstance(top.data, dict) or len(top.data) != 1:
        line = 1 if top is None else top.line
        message = "a parameter library has one key at the top, the namespace; its parameters are missing"
        library.problems.append((line, message))
        return library
    (name, value), *_ = top.data.items()
    if not isinstance(name, str) or not _ROOT.match(name):
        library.problems.append((value.line, f"the namespace {str(name)[:60]!r} is no C++ name; use letters and _"))
        return library
    if not isinstance(value.data, dict) or not value.data:
        library.problems.append((value.line, f"{name} holds no parameters; add one"))
        return library
    library.name = name
    library.root = Struct((), value.line, value.column)
    _TreeReader(library).struct(library.root, value.data)
    return library


class _TreeReader:
    def __init__(self, library: Library) -> None:
        self.library = library
        self.declared: set[tuple[str, ...]] = set()

    def problem(self, line: int, message: str) -> None:
        if len(self.library.problems) < MAX_PROBLEMS:
            self.library.problems.append((line, message))

    def struct(self, struct: Struct, entries: dict[Scalar, Value]) -> None:
        """A map whose first value is a map is a struct; what is no map in it is passed over, as the generator does."""
        for key, value in entries.items():
            if not isinstance(value.data, dict):
                continue
            shown = ".".join((*struct.path, str(key)))[:100]
            if not isinstance(key, str) or not _NAME.match(key):
                hint = "use letters, digits and _, and quote yes, no, on and off"
                self.problem(value.line, f"{shown!r} is no name of C++; {hint}")
            elif not value.data:
                self.problem(value.line, f"{shown} is empty; give it a type, or remove it")
            elif self.is_struct(value.data):
                inner = Struct((*struct.path, key), value.line, value.column)
                struct.structs.append(inner)
                self.struct(inner, value.data)
            else:
                self.parameter(struct, key, value, value.data)

    def is_struct(self, entries: dict[Scalar, Value]) -> bool:
        provided = entries.get("type")
        if provided is not None and isinstance(provided.data, str) and _TYPE.match(provided.data):
            return False
        return isinstance(next(iter(entries.values())).data, dict)

    def parameter(self, struct: Struct, name: str, value: Value, entries: dict[Scalar, Value]) -> None:
        path = (*struct.path, name)
        shown = ".".join(path)[:100]
        kind = entries["type"].data if "type" in entries else None
        if not isinstance(kind, str):
            self.problem(value.line, f"no type for the parameter {shown}; add one")
            return
        if kind == "none":
            return
        match = _TYPE.match(kind)
        if match is None:
            hint = "use bool, int, double or string"
            self.problem(value.line, f"{kind[:60]!r}, the type of {shown}, is not known; {hint}")
            return
        if isinstance(next(iter(entries.values())).data, dict):
            self.problem(value.line, f"{shown} begins with a map, and is taken for a struct; put its type first")
        for key, item in entries.items():
            if key not in _KEYS:
                self.problem(item.line, f"{str(key)[:60]!r} is no attribute of a parameter ({shown}); remove it")
        keys = self.keys_of(path, shown, value.line)
        if keys is None:
            return
        base, is_array = match[1], match[2] is not None
        default, is_sure = None, True
        provided = entries.get("default_value")
        if provided is not None and provided.data is not None:
            default = _default(base, is_array, provided)
            if default is None:
                is_sure = False
                self.problem(provided.line, f"the default of {shown} is not of the type {kind}; correct it")
        made = Declared(
            path=path,
            base=base,
            is_array=is_array,
            default=default,
            is_sure=is_sure,
            description=_text(entries.get("description")),
            read_only=bool(entries["read_only"].data) if "read_only" in entries else False,
            constraints=_text(entries.get("additional_constraints")),
            checks=_checks(entries.get("validation")),
            line=value.line,
            column=value.column,
            keys=keys,
        )
        struct.parameters.append(made)
        self.library.order.append(made)
        if not keys:
            self.declared.add(path)

    def keys_of(self, path: tuple[str, ...], shown: str, line: int) -> tuple[tuple[str, ...], ...] | None:
        """The arrays that the maps on *path* take their keys from, looked for from their scope outwards."""
        at = [number for number, part in enumerate(path) if part.startswith(MAP)]
        if not at:
            return ()
        if at != list(range(at[0], at[-1] + 1)) or at[-1] == len(path) - 1:
            self.problem(line, f"{shown}: a struct between maps cannot be generated; put the maps next to each other")
            return None
        found = []
        for number in at:
            name = path[number].removeprefix(MAP)
            scope = path[: at[0]]
            while scope and (*scope, name) not in self.declared:
                scope = scope[:-1]
            if (*scope, name) not in self.declared:
                self.problem(line, f"{shown}: no parameter {name!r} before it names the keys; declare a string_array")
                return None
            found.append((*scope, name))
        return tuple(found)


def _text(value: Value | None) -> str:
    return "" if value is None or isinstance(value.data, tuple | dict) or value.data is None else str(value.data)


def _element(base: str, data: object) -> Element | None:
    """*data* as a value of the type, None otherwise; integers are doubles, too."""
    if base == "double" and isinstance(data, int) and not isinstance(data, bool):
        return float(data) if abs(data) < 10**300 else None
    if base == "int" and isinstance(data, bool):
        return None
    return data if isinstance(data, _BASES[base]) and isinstance(data, bool | int | float | str) else None


def _default(base: str, is_array: bool, provided: Value) -> Element | tuple[Element, ...] | None:
    if not is_array:
        return _element(base, provided.data)
    if not isinstance(provided.data, tuple):
        return None
    items = [_element(base, item.data) for item in provided.data]
    kept = tuple(item for item in items if item is not None)
    return kept if len(kept) == len(items) else None


def _checks(value: Value | None) -> tuple[tuple[str, tuple[Scalar, ...]], ...]:
    """Validators by name, without ``<>``, with those of their arguments that are scalars."""
    if value is None or not isinstance(value.data, dict):
        return ()
    found = []
    for name, provided in value.data.items():
        arguments = provided.data if isinstance(provided.data, tuple) else (provided,)
        scalars = tuple(item.data for item in arguments if not isinstance(item.data, tuple | dict))
        if isinstance(name, str) and len(scalars) == len(arguments):
            found.append((name.removesuffix("<>"), scalars))
    return tuple(found)
