# SPDX-License-Identifier: Apache-2.0
"""Definitions of the packages that every distribution of ROS has (``common_ros1.txt``, ``common_ros2.txt``).

Each line of the files is a definition: its name, then fields and constants, separated by tabs; ``---`` divides the parts of a
service or action. A name that occurs more than once was defined differently in different distributions.
``python -m haros_ci.interfaces.collect`` writes them from checkouts.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files

from haros_ci.model.build import Interface, InterfaceField


def variants(ros: int, kind: str, name: str) -> tuple[Interface, ...]:
    """The definitions of ``pkg/T`` in the distributions of ROS 1 or 2; empty if it is in none that is covered."""
    package, _, short = name.partition("/")
    return tuple(definition(line) for line in _lines(ros).get(f"{package}/{kind}/{short}", ()))


def packages(ros: int) -> frozenset[str]:
    """Names of the packages that are covered."""
    return frozenset(name.partition("/")[0] for name in _lines(ros))


@lru_cache(maxsize=2)
def _lines(ros: int) -> Mapping[str, tuple[str, ...]]:
    text = files("haros_ci.interfaces").joinpath(f"common_ros{ros}.txt").read_text(encoding="utf-8")
    made: dict[str, tuple[str, ...]] = {}
    for line in text.splitlines():
        if line and line[0] != "#":
            name = line.partition("\t")[0]
            made[name] = (*made.get(name, ()), line)
    return made


@lru_cache(maxsize=4_096)
def definition(line: str) -> Interface:
    """The definition in one line."""
    name, *parts = line.split("\t")
    package, kind, short = name.split("/")
    sections: list[list[InterfaceField]] = [[]]
    for part in parts:
        if part == "---":
            sections.append([])
        else:
            sections[-1].append(_field(part))
    return Interface(name=f"{package}/{short}", kind=kind, path="", sections=tuple(map(tuple, sections)))


def _field(text: str) -> InterfaceField:
    kind, _, rest = text.partition(" ")
    name, equals, value = rest.partition("=")
    return InterfaceField(name=name, type=kind, line=0, is_constant=bool(equals), written=kind, value=value)


def line_of(interface: Interface) -> str:
    """*interface* as one line: without default values, which are not on the wire."""
    package, _, name = interface.name.partition("/")
    parts = [f"{package}/{interface.kind}/{name}"]
    for number, section in enumerate(interface.sections):
        parts += ["---"] if number else []
        parts += [f"{f.type} {f.name}={f.value}" if f.is_constant else f"{f.type} {f.name}" for f in section]
    return "\t".join(parts)
