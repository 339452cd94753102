# SPDX-License-Identifier: Apache-2.0
"""What a change does, as JSON, schema version 1: keys are added, never renamed (docs/diff.md)."""

from __future__ import annotations

from typing import Any

from haros_ci.model.changes import Change, Changes
from haros_ci.model.location import Location
from haros_ci.report.escape import json_document

SCHEMA_VERSION = 1


def render(found: Changes, base: str, head: str | None) -> str:
    """The document, with a final newline; *base* and *head* are commits, None the work tree."""
    document = {
        "schema_version": SCHEMA_VERSION,
        "base": base,
        "head": head,
        "changes": [_change(change) for change in found.changes],
        "graph": [
            {"node": e.node, "channel": e.channel, "kind": e.kind, "gives": e.is_giver, "state": e.state or "unchanged"}
            for e in found.edges
        ],
        "not_known": found.not_known,
    }
    return json_document(document, 1) + "\n"


def _change(change: Change) -> dict[str, Any]:
    return {
        "what": change.what,
        "action": change.action,
        "aspect": change.aspect or None,
        "name": change.name,
        "names": list(change.names),
        "old_names": list(change.old_names),
        "before": change.before,
        "after": change.after,
        "nodes": list(change.nodes),
        "programs": list(change.programs),
        "configurations": list(change.configurations),
        "users": list(change.users),
        "details": list(change.details),
        "base": _location(change.base),
        "head": _location(change.head),
    }


def _location(location: Location | None) -> dict[str, Any] | None:
    if location is None:
        return None
    return {"path": location.path, "line": location.line, "column": location.column}
