# SPDX-License-Identifier: Apache-2.0
"""Frozen dataclasses as JSON and back, checked field by field: what lies in a shard file is data, not trust."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from functools import cache, partial
from math import isfinite
from types import NoneType, UnionType
from typing import Any, Union, get_args, get_origin, get_type_hints

#: The largest whole number that every reader of JSON gets right.
LARGEST = 2**53


class NotThat(ValueError):
    """The value is not of its type; the message says where and why."""


def plain(value: Any) -> Any:
    """*value* as JSON: a dataclass is an object of those fields that differ from their defaults, a set a sorted array."""
    if is_dataclass(value):
        found = {}
        for field in fields(value):
            part = getattr(value, field.name)
            if field.default is MISSING or part != field.default:
                found[field.name] = plain(part)
        return found
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, frozenset):
        return sorted(map(plain, value))
    if isinstance(value, tuple):
        return [plain(part) for part in value]
    return value


def read(type_: Any, value: object) -> Any:
    """The *value* of JSON as an instance of *type_*. Raises NotThat."""
    return _reader(type_)(value)


@cache
def _reader(type_: Any) -> Callable[[object], Any]:
    origin, arguments = get_origin(type_), get_args(type_)
    if is_dataclass(type_):
        return partial(_dataclass, type_)
    if origin in (Union, UnionType):
        return partial(_union, tuple(map(_reader, arguments)))
    if origin is tuple and arguments[-1] is Ellipsis:
        return partial(_series, tuple, _reader(arguments[0]))
    if origin is tuple:
        return partial(_fixed, tuple(map(_reader, arguments)))
    if origin is frozenset:
        return partial(_series, frozenset, _reader(arguments[0]))
    if isinstance(type_, type) and issubclass(type_, Enum):
        return partial(_enum, type_)
    return {str: _text, int: _whole, float: _real, bool: _truth, NoneType: _nothing}[type_]


@cache
def _members(type_: Any) -> dict[str, tuple[Callable[[object], Any], bool]]:
    hints = get_type_hints(type_)
    needed = {f.name: f.default is MISSING and f.default_factory is MISSING for f in fields(type_)}
    readers = {name: _reader(hints[name]) for name in needed}
    return {n: (partial(_path, reader) if n == "path" else reader, needed[n]) for n, reader in readers.items()}


def _dataclass(type_: Any, value: object) -> Any:
    if not isinstance(value, dict):
        raise NotThat(f"not a {type_.__name__}")
    members = _members(type_)
    if not value.keys() <= members.keys():
        raise NotThat(f"a {type_.__name__} has no such member")
    for name, (_, needed) in members.items():
        if needed and name not in value:
            raise NotThat(f"a {type_.__name__} without '{name}'")
    return type_(**{name: members[name][0](part) for name, part in value.items()})


def _union(readers: tuple[Callable[[object], Any], ...], value: object) -> Any:
    for reader in readers:
        try:
            return reader(value)
        except NotThat as err:
            reason = err
    raise reason


def _series(make: Callable[[Any], Any], reader: Callable[[object], Any], value: object) -> Any:
    if not isinstance(value, list):
        raise NotThat("not an array")
    return make([reader(part) for part in value])


def _fixed(readers: tuple[Callable[[object], Any], ...], value: object) -> Any:
    if not isinstance(value, list) or len(value) != len(readers):
        raise NotThat(f"not an array of {len(readers)}")
    return tuple(reader(part) for reader, part in zip(readers, value, strict=True))


def _enum(type_: type[Enum], value: object) -> Any:
    try:
        return type_(value)
    except ValueError:
        raise NotThat(f"not a {type_.__name__}") from None


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise NotThat("not a text")
    return value


def _path(reader: Callable[[object], str | None], value: object) -> str | None:
    """A path below the root; None where its type allows that."""
    path = reader(value)
    if path is not None and not is_inside(path):
        raise NotThat("a path that leads out of the workspace")
    return path


def is_inside(path: str) -> bool:
    """Whether *path* is relative and stays below where it starts."""
    return not path.startswith(("/", "\\")) and "\0" not in path and ".." not in path.split("/")


def _whole(value: object) -> int:
    if type(value) is not int or abs(value) > LARGEST:
        raise NotThat("not a whole number of sane size")
    return value


def _real(value: object) -> float:
    if not isinstance(value, (int, float)) or isinstance(value, bool) or abs(value) > LARGEST or not isfinite(value):
        raise NotThat("not a number of sane size")
    return value


def _truth(value: object) -> bool:
    if not isinstance(value, bool):
        raise NotThat("neither true nor false")
    return value


def _nothing(value: object) -> None:
    if value is not None:
        raise NotThat("not null")
