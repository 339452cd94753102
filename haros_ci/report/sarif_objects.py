# SPDX-License-Identifier: Apache-2.0
"""From sarif-om objects to JSON: the only place that knows that library's traps.

``attr.asdict`` would write snake_case names, nulls and the -1 sentinels, none of which is SARIF. So names come from
the attributes' ``schema_property_name`` (``schema_uri`` is ``$schema``), and None and defaults are left out; but
never ``level``, as an absent one means the rule's level, not the library's default (§3.27.10), and never an empty
array that was set, as ``results: []`` and ``suppressions: []`` say something (§3.14.23, §3.27.23).
"""

from __future__ import annotations

import json
from typing import Any

import attr
import sarif_om as om

__all__ = ["dumps", "om", "properties", "write"]

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_ALWAYS = frozenset({"level"})
_tables: dict[type, tuple[dict[str, str], dict[str, object]]] = {}


def properties(thing: Any) -> dict[str, Any]:
    """The SARIF properties of one sarif-om object; their values may be such objects again, which ``dumps`` unfolds."""
    keys, defaults = _tables.get(type(thing)) or _learn(type(thing))
    written = {keys[name]: value for name, value in thing.__dict__.items() if value is not None}
    for key, default in defaults.items():
        if key in written and written[key] == default:
            del written[key]
    return written


def dumps(value: object) -> str:
    """Compact ASCII JSON of plain values and sarif-om objects: safe under every output encoding."""
    return _ENCODER.encode(value)


def write(runs: list[tuple[dict[str, Any], list[str]]]) -> str:
    """A log from runs and their results' JSON, one result a line so that two logs can be compared as text."""
    written = []
    for run, results in runs:
        lines = ",\n".join(results)
        written.append(f'{dumps(run)[:-1]},"results":[{lines and chr(10) + lines + chr(10)}]}}')
    head = properties(om.SarifLog(schema_uri=SCHEMA, version="2.1.0", runs=None))
    return f'{dumps(dict(sorted(head.items())))[:-1]},"runs":[{",".join(chr(10) + run for run in written)}\n]}}\n'


def _learn(kind: type) -> tuple[dict[str, str], dict[str, object]]:
    """Attribute → property name, and property name → default that may be left out, of one sarif-om class."""
    keys: dict[str, str] = {}
    defaults: dict[str, object] = {}
    for field in attr.fields(kind):
        keys[field.name] = key = field.metadata["schema_property_name"]
        default: Any = field.default
        if isinstance(default, attr.Factory):  # type: ignore[arg-type]  # attrs has it as a function for type checkers
            default = default.factory()
        if default is not None and default is not attr.NOTHING and field.name not in _ALWAYS:
            defaults[key] = default
    _tables[kind] = keys, defaults
    return keys, defaults


_ENCODER = json.JSONEncoder(separators=(",", ":"), ensure_ascii=True, allow_nan=False, default=properties)
