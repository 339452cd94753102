# SPDX-License-Identifier: Apache-2.0
"""From the URIs of a foreign log to paths in the workspace."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from haros_ci.regex import regex
from haros_ci.results.json_shape import mapping, natural, string

_SCHEME = regex(r"[A-Za-z][A-Za-z0-9+.-]*:")
_DEEPEST_BASE = 10
_LONGEST = 4_096


class UriError(ValueError):
    """The place is not in the workspace; *kind* says how."""

    def __init__(self, kind: str) -> None:
        super().__init__(kind)
        self.kind = kind


def workspace_path(
    location: Mapping[str, object], artifacts: Sequence[object], bases: Mapping[str, object], root: str
) -> str:
    """The path of an artifactLocation (§3.4) relative to the workspace root. Raises UriError.

    A relative URI whose base is absolute or not given is taken as relative to the root. An absolute one counts only
    if it lies below *root* or below one of the log's own absolute *bases* (§3.14.14).
    """
    location = dict(location)
    index = natural(location, "index")
    if not string(location, "uri") and index is not None and index < len(artifacts):
        location = mapping(mapping(artifacts[index]), "location")
    uri = string(location, "uri")
    if not uri:
        raise UriError("no file")
    if len(uri) > _LONGEST:
        raise UriError("a name too long")
    if _is_absolute(uri):
        return _below(uri, bases, root)
    base, seen = string(location, "uriBaseId"), 0
    while base and (outer := mapping(dict(bases), base)) and seen < _DEEPEST_BASE:
        prefix = string(outer, "uri")
        if _is_absolute(prefix):
            break
        uri = f"{prefix.rstrip('/')}/{uri}" if prefix else uri
        base, seen = string(outer, "uriBaseId"), seen + 1
    return _clean(uri)


def _is_absolute(uri: str) -> bool:
    return bool(_SCHEME.match(uri)) or uri.startswith(("/", "\\"))


def _below(uri: str, bases: Mapping[str, object], root: str) -> str:
    """What is left of an absolute URI below the root, or below a base that the log names."""
    path = _absolute_path(uri)
    anchors = [root] + [_absolute_path(string(mapping(entry), "uri")) for entry in bases.values()]
    for anchor in sorted((a.rstrip("/") for a in anchors if a.rstrip("/")), key=len, reverse=True):
        if path.startswith(f"{anchor}/"):
            return _checked(path[len(anchor) + 1 :])
    raise UriError("an absolute path elsewhere")


def _absolute_path(uri: str) -> str:
    """The POSIX path of a file URI without host, or of a plain absolute path; "" for any other."""
    if uri.lower().startswith("file://"):
        host, _, path = uri[7:].partition("/")
        return _decoded(f"/{path}") if host in ("", "localhost") else ""
    return _decoded(uri) if uri.startswith("/") else ""


def _clean(uri: str) -> str:
    uri = re.split(r"[?#]", uri, maxsplit=1)[0]
    return _checked(_decoded(uri.replace("\\", "/")))


def _decoded(uri: str) -> str:
    from urllib.parse import unquote

    return unquote(uri, errors="surrogateescape")


def _checked(path: str) -> str:
    parts = [part for part in path.split("/") if part not in ("", ".")]
    if path.startswith("/") or ".." in parts:
        raise UriError("a path out of the workspace")
    if not parts or "\0" in path:
        raise UriError("no file")
    return "/".join(parts)
