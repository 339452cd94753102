# SPDX-License-Identifier: Apache-2.0
"""The table of plug-ins of Gazebo: data files in ``plugins``, a row for each library (docs/known-nodes.md)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from haros_ci.model.architecture import KINDS
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.load import parse
from haros_ci.systems.known.shape import read_package, shown

_HERE = Path(__file__).parent / "plugins"
#: Where a plug-in can stand: in a world, a model, a sensor or a visual, or on the server's command line.
PLACES = ("world", "model", "sensor", "visual", "system")
OWN_KEYS = ("source", "at", "namespace", "elements", "requires", "beside", "called")
SPACE_KEYS = ("missing", "empty", "slash", "above", "below", "ignored")
_ELEMENT = regex(r"[A-Za-z]\w{0,60}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Space:
    """Which namespace a ROS 1 plug-in takes: *missing* without ``<robotNamespace>``, *empty* for an empty one, *slash* for ``/``.

    *above* stands before it, *below* behind it. In all of them ``{model}`` and elements in braces are filled in. *ignored*: none at all.
    """

    missing: str = ""
    empty: str = ""
    slash: str | None = None
    above: str = ""
    below: str = ""
    ignored: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownPlugin:
    """A plug-in by its *library*, without ``lib`` and ``.so``; *at* is one of ``PLACES``.

    *package* is whose data file it is in; *elements* are those that it reads, with their defaults (None: without one); it makes nothing without those that it *requires*.
    *node* has its endpoints, in whose names ``~x`` is the element ``<x>``. *beside* are the package and type of a known node that it makes besides.
    *called* is what its node is called, where that is not the name of the plug-in.
    """

    library: str
    package: str
    source: str
    at: str
    node: KnownNode
    space: Space = Space()
    elements: Mapping[str, Any]
    requires: tuple[str, ...] = ()
    beside: tuple[str, str] | None = None
    called: str = ""


@lru_cache(maxsize=2)
def plugins(ros: int) -> Mapping[str, KnownPlugin]:
    """The table of ROS 1 or 2, by library."""
    found: dict[str, KnownPlugin] = {}
    for path in _files(ros):
        rows, _ = read_rows(parse(path.read_text(encoding="utf-8")), path.name, ros)
        found.update(rows)
    return MappingProxyType(found)


@lru_cache(maxsize=1)
def silent() -> frozenset[str]:
    """The libraries that are known to make nothing in ROS."""
    data = parse((_HERE / "silent.yaml").read_text(encoding="utf-8"))
    assert isinstance(data, dict)
    return frozenset(name for names in data.values() for name in names)


def problems(ros: int) -> tuple[Problem, ...]:
    """What has a wrong shape in the data files."""
    return tuple(
        problem
        for path in _files(ros)
        for problem in read_rows(parse(path.read_text(encoding="utf-8")), path.name, ros)[1]
    )


def library_of(filename: str) -> str:
    """``libgazebo_ros_laser.so``, with or without a directory, as the table has it."""
    return filename.strip().rpartition("/")[2].removeprefix("lib").removesuffix(".so")


def read_rows(data: object, where: str, ros: int) -> tuple[dict[str, KnownPlugin], list[Problem]]:
    """The rows of a data file, and what is wrong with others, which are left out."""
    if not isinstance(data, Mapping):
        return {}, [Problem(where, "it must be a map of libraries")]
    found: dict[str, KnownPlugin] = {}
    notes: list[Problem] = []
    for library, row in data.items():
        made = _row(shown(library), row, where, ros)
        if isinstance(made, KnownPlugin):
            found[made.library] = made
        else:
            notes += made
    return found, notes


def _row(library: str, row: object, where: str, ros: int) -> KnownPlugin | list[Problem]:
    if not isinstance(row, Mapping):
        return [Problem(where, f"{library}: it must be a map")]
    wrong = (*_wrong_origin(row), *_wrong_elements(row), *_wrong_naming(row, ros))
    notes = [Problem(where, f"{library}: {item}") for item in wrong]
    ends = {key: row[key] for key in row if key in KINDS}
    nodes, more = read_package({library: ends}, "plugins", where, ros=ros)
    notes += more
    if notes or library not in nodes:
        return notes
    beside = row.get("beside")
    return KnownPlugin(
        library=library,
        package=where.partition(".")[0],
        source=str(row["source"]),
        at=str(row["at"]),
        node=nodes[library],
        space=Space(**row.get("namespace", {})),
        elements=MappingProxyType(dict(row.get("elements", {}))),
        requires=tuple(row.get("requires", [])),
        beside=tuple(beside.split("/", 1)) if isinstance(beside, str) else None,  # type: ignore[arg-type]  # the text has one slash, as the table is tested
        called=row.get("called", ""),
    )


def _wrong_origin(row: Mapping[Any, Any]) -> Iterator[str]:
    """What is wrong with the keys of a row, its source and its place."""
    for key in row:
        if key not in (*OWN_KEYS, *KINDS):
            yield f"nothing is called {shown(key)!r} here"
    source = row.get("source")
    if not isinstance(source, str) or not source:
        yield "source must name the file that it was read from"
    if row.get("at") not in PLACES:
        yield f"at must be one of: {', '.join(PLACES)}"


def _wrong_elements(row: Mapping[Any, Any]) -> Iterator[str]:
    """What is wrong with the elements that a plug-in reads, and with those that it requires."""
    elements = row.get("elements", {})
    if not isinstance(elements, Mapping) or not all(
        isinstance(key, str) and _ELEMENT.fullmatch(key) and isinstance(value, (str, bool, int, float, type(None)))
        for key, value in elements.items()
    ):
        yield "elements must be a map of names and plain defaults"
        elements = {}
    requires = row.get("requires", [])
    if not isinstance(requires, list) or not all(require in elements for require in requires):
        yield "requires must be a list of some of its elements"


def _wrong_naming(row: Mapping[Any, Any], ros: int) -> Iterator[str]:
    """What is wrong with the namespace of a plug-in, and with the node that it makes besides."""
    space = row.get("namespace", {})
    if not isinstance(space, Mapping) or not all(key in SPACE_KEYS for key in space) or (space and ros != 1):
        yield f"namespace can have, in ROS 1: {', '.join(SPACE_KEYS)}"
    beside = row.get("beside")
    if beside is not None and (not isinstance(beside, str) or beside.count("/") != 1):
        yield "beside must be package/type of a known node"
    called = row.get("called", "")
    if not isinstance(called, str) or (called and ros == 1):
        yield "called must be a name, in ROS 2"


def _files(ros: int) -> list[Path]:
    return [path for path in sorted((_HERE / "ros2" if ros == 2 else _HERE).glob("*.yaml")) if path.stem != "silent"]
