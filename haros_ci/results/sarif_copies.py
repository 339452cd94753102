# SPDX-License-Identifier: Apache-2.0
"""The findings that one of a log of our own stands for (``haros_ci.results.copied``), read as hostile input."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.model.location import Location
from haros_ci.results.fingerprint import restore_identity
from haros_ci.results.json_shape import items, mapping, natural, string, strings
from haros_ci.results.result import Result
from haros_ci.results.sarif_uri import UriError, workspace_path

#: Copies of one finding that are read.
MOST = 10_000
_MOST_NAMES = 1_001
_LONGEST_TEXT = 8_000


def spread(result: Result, more: dict[str, object]) -> tuple[Result, ...]:
    """*result*, read from a log, as it was before it stood for others, and those others; *more* are its properties."""
    entries = [mapping(entry) for entry in items(more, "copies")[:MOST]]
    if not entries:
        return (result,)
    copies = [copy for entry in entries if (copy := _copy(result, entry)) is not None]
    places = {(copy.location.path, copy.location.line) for copy in copies}
    related = tuple(near for near in result.related if (near.location.path, near.location.line) not in places)
    own = string(more, "ownMessage")[:_LONGEST_TEXT] or result.message
    return (replace(result, message=own, related=related), *copies)


def _copy(result: Result, entry: dict[str, object]) -> Result | None:
    """One of them; None where it stands outside the workspace or says nothing."""
    try:
        path = workspace_path({"uri": string(entry, "uri")}, [], {}, "")
    except UriError:
        return None
    message = string(entry, "message")[:_LONGEST_TEXT]
    if not message:
        return None
    scope = string(entry, "scope")
    hashes = mapping(entry, "fingerprints").items()
    return replace(
        result,
        message=message,
        location=Location(path, natural(entry, "line") or None),
        related=(),
        scope=scope,
        subject=strings(entry, "subject")[:_MOST_NAMES],
        roles=strings(entry, "roles")[:_MOST_NAMES],
        flow=(),
        edges=(),
        identity=restore_identity(
            {k: v for k, v in hashes if isinstance(v, str) and len(v) <= 100},
            scope=scope,
            template=string(entry, "template"),
            snippet=string(entry, "snippet"),
        ),
    )
