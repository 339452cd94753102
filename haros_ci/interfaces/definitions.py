# SPDX-License-Identifier: Apache-2.0
"""Definitions by name: those of a workspace, and the common ones that every ROS distribution has alike."""

from __future__ import annotations

import re
from collections.abc import Iterable

from haros_ci.interfaces.common import variants
from haros_ci.model.build import Interface
from haros_ci.records import dataclass
from haros_ci.regex import regex

_TYPE = regex(r"(?P<base>[\w/]+)(?:<=(?P<length>\d{1,9}))?(?P<array>\[(?P<bound><=)?(?P<size>\d{0,9})\])?\Z", re.ASCII)


@dataclass(frozen=True, slots=True)
class FieldType:
    """A field's type in parts: *base* (``int32``, ``pkg/T``), a string's *length* limit or 0, and how it is repeated.

    *form* is "" for one value, ``array`` for a fixed *size*, ``bounded`` up to *size*, ``sequence`` for any number.
    """

    base: str
    length: int = 0
    form: str = ""
    size: int = 0

    @property
    def is_nested(self) -> bool:
        return "/" in self.base


def field_type(written: str) -> FieldType | None:
    """The parts of a type as ``InterfaceField.type`` has it; None for any other text."""
    match = _TYPE.match(written)
    if match is None:
        return None
    size = int(match["size"] or 0)
    form = "" if match["array"] is None else "bounded" if match["bound"] else "array" if size else "sequence"
    return FieldType(match["base"], int(match["length"] or 0), form, size)


class Definitions:
    """The definitions that code of one ROS version sees. A name with several different definitions has none that is certain."""

    def __init__(self, found: Iterable[Interface], ros: int) -> None:
        self.ros = ros
        self._own: dict[tuple[str, str], tuple[Interface, ...]] = {}
        for interface in found:
            same = self._own.get((interface.kind, interface.name), ())
            self._own[interface.kind, interface.name] = (*same, interface)
        self._packages = frozenset(interface.name.partition("/")[0] for interface in self._own_all())
        #: Hashes that are known, by kind and name: a memory for md5 and rihs01.
        self.hashes: dict[tuple[str, str], str | None] = {}

    def _own_all(self) -> Iterable[Interface]:
        return (interface for same in self._own.values() for interface in same)

    def variants(self, kind: str, name: str) -> tuple[Interface, ...]:
        """All definitions of ``pkg/T`` that it can be: the workspace's, else those of the distributions; empty if not known."""
        own = self._own.get((kind, name))
        if own is not None:
            return own
        if name.partition("/")[0] in self._packages:
            return ()
        return variants(self.ros, kind, name)

    def find(self, kind: str, name: str) -> Interface | None:
        """The one definition of ``pkg/T``; None if it is not known, or not the same everywhere."""
        found = self.variants(kind, name)
        is_old = self.ros == 1
        if (
            not found
            or not all(interface.is_whole for interface in found)
            or len({on_wire(interface, is_old) for interface in found}) > 1
        ):
            return None
        return found[0]


def on_wire(interface: Interface, with_constants: bool) -> tuple[tuple[tuple[str, str, str], ...], ...]:
    """What its hash depends on, besides nested types: constants in ROS 1, wherever they stand, but not in ROS 2."""
    return tuple(
        (
            *((f.type, f.name, f.value) for f in section if with_constants and f.is_constant),
            *((f.type, f.name, "") for f in section if not f.is_constant),
        )
        for section in interface.sections
    )
