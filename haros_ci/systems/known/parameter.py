# SPDX-License-Identifier: Apache-2.0
"""The parameters that a known ROS 2 node declares: their full names, defaults and the values that they have."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.graph.names import UNKNOWN
from haros_ci.model.architecture import Endpoint, Unknown
from haros_ci.regex import regex
from haros_ci.systems.known.entry import KnownEndpoint
from haros_ci.systems.known.start import Start, filled

_NAME = regex(r"[\w?][\w?./-]*")


def declared(known: KnownEndpoint, start: Start, unknowns: list[Unknown]) -> Endpoint | None:
    """One declaration of ROS 2: ``/ns/node:dotted.name``, its default, and as *effective* what is set, else the default."""
    name, messages = filled(known.name, start)
    name = name.lstrip("~")
    if not name:
        return None
    if not _NAME.fullmatch(name):
        messages, name = [*messages, Unknown("name", f"{name[:60]!r} is no name of a parameter")], UNKNOWN
    unknowns = list(dict.fromkeys([*unknowns, *messages]))
    if known.type is None:
        unknowns.append(Unknown("type", known.type_reason))
    if known.value_reason:
        unknowns.append(Unknown("value", known.value_reason))
    effective = None
    if UNKNOWN in name:
        unknowns.append(Unknown("effective", "the name of the parameter is not known"))
    else:
        effective = start.value(name)
    if isinstance(effective, Unknown):
        unknowns.append(replace(effective, field="effective"))
        effective = None
    elif effective is None and known.value_reason:
        unknowns.append(Unknown("effective", known.value_reason))
    elif effective is None and UNKNOWN not in name:
        effective = known.value
    full = start.full(name)
    return Endpoint(
        kind=known.kind,
        name=full,
        original_name=full,
        type=known.type,
        location=None,
        value=known.value,
        implicit=known.implicit,
        source="known-node",
        unknowns=tuple(unknowns),
        effective=effective,
        read_only=known.read_only,
        written=name,
    )
