# SPDX-License-Identifier: Apache-2.0
"""From what a node has made to its endpoints: final names, types that the configuration tells, what is unknown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from haros_ci.follow.made import MadeEntity
from haros_ci.follow.ros.paces import endpoints_only
from haros_ci.index.ros_types import data_type
from haros_ci.model.architecture import KINDS, Condition, Endpoint, Unknown
from haros_ci.values.abstract import Known, Value

#: Why a name is unknown that the code itself knows.
UNNAMED = "the name of the node or of its namespace is not known"


def endpoints(
    made: Iterable[MadeEntity],
    remap: Callable[[MadeEntity], str],
    parameter: Callable[[str], Value | None],
    unnamed: str = UNNAMED,
) -> tuple[Endpoint, ...]:
    """Endpoints with their final names, by kind and place; *unnamed* says why the node's own name is not known.

    A getter whose variable has no known type has the type of what the configuration sets (*parameter*).
    """
    order = {kind: number for number, kind in enumerate(KINDS)}
    found = [
        Endpoint(
            kind=item.kind,
            name=final,
            original_name=item.name,
            type=item.type,
            location=item.location,
            conditions=_distinct(item.conditions, is_early=False),
            early_ways=_distinct(item.conditions, is_early=True),
            queue_size=item.queue_size,
            latched=item.latched,
            value=item.value,
            implicit=item.implicit,
            qos=item.qos,
            effective=item.effective,
            read_only=item.read_only,
            range=item.range,
            written=item.written,
            is_dynamic=item.is_dynamic,
            is_strict=item.is_strict,
            is_ruled_out=item.dead > 0,
            source="exact-tier" if item.is_exact else "source",
            unknowns=(
                *(Unknown(*unknown) for unknown in dict.fromkeys(item.unknowns)),
                *_typed_by_others(item, final, unnamed),
            ),
        )
        for item, final in ((item, remap(item)) for item in endpoints_only(made))
    ]
    found = [_typed(end, parameter) if end.kind == "getters" and end.type is None else end for end in found]
    return tuple(
        sorted(
            _typed_by_each_other(found),
            key=lambda e: (
                order[e.kind],
                e.location.sort_key if e.location else (),
                e.name,
                e.type or "",
                repr(e.value),
            ),
        )
    )


def by(remaps: Mapping[str, str]) -> Callable[[MadeEntity], str]:
    """The final name of what is made under *remaps* of absolute names, as ROS 1 has them."""
    return lambda item: remaps.get(item.name, item.name)


def _typed_by_others(item: MadeEntity, final: str, unnamed: str) -> tuple[Unknown, ...]:
    if "?" in item.name and not any(field == "name" for field, _, _ in item.unknowns):
        return (Unknown("name", unnamed),)
    if "?" not in item.name and "?" in final:
        return (Unknown("name", "the launch file remaps it to a name that is not known"),)
    return ()


def _typed(end: Endpoint, parameter: Callable[[str], Value | None]) -> Endpoint:
    value = parameter(end.name)
    kind = data_type(value.value) if isinstance(value, Known) else None
    if kind is None:
        return end
    return replace(end, type=kind, unknowns=tuple(u for u in end.unknowns if u.field != "type"))


def _typed_by_each_other(found: list[Endpoint]) -> list[Endpoint]:
    """A ROS 2 parameter has one type: what a declaration leaves open a reading tells, and the other way round."""
    reported: dict[str, set[str | None]] = {}
    open_ = {
        end.name for end in found if end.kind in ("getters", "parameters") and end.type is None and ":" in end.name
    }
    for end in found if open_ else ():
        if end.name in open_ and end.kind in ("getters", "parameters") and end.type is not None:
            reported.setdefault(end.name, set()).add(end.type)
    if not reported:
        return found
    return [
        _of_type(end, *reported[end.name]) if _is_open(end) and len(reported.get(end.name, ())) == 1 else end
        for end in found
    ]


def _is_open(end: Endpoint) -> bool:
    return end.kind in ("getters", "parameters") and end.type is None and "?" not in end.name and not end.is_dynamic


def _of_type(end: Endpoint, kind: str | None) -> Endpoint:
    return replace(end, type=kind, unknowns=tuple(unknown for unknown in end.unknowns if unknown.field != "type"))


def _distinct(conditions: tuple[Condition, ...], *, is_early: bool) -> tuple[Condition, ...]:
    return tuple(dict.fromkeys(item for item in conditions if item.is_early is is_early))
