# SPDX-License-Identifier: Apache-2.0
"""Paths as launch text has them: ``$(find-pkg-share pkg)/x`` and ``$(workspace dir)/x`` are absolute."""

from __future__ import annotations

import posixpath
import re
from typing import Any

from haros_ci.launch.python.values import PartialText, PathValue, Unknown, Value, merged, mystery, phrase, text_of, why
from haros_ci.model.launch_actions import PREFIX, WORKSPACE
from haros_ci.regex import regex

MARKER = regex(r"\$\((find-pkg-share|find-pkg-prefix|workspace) ([^()$]*)\)")


PACKAGE = regex(r"[A-Za-z0-9_-][A-Za-z0-9_.-]*")


def rooted(text: str) -> tuple[str, str, str]:
    """The marker's kind and directory, and what follows it; kind is "" for any other path."""
    match = MARKER.match(text)
    if match is None or not (match.end() == len(text) or text[match.end()] == "/"):
        return "", "", text
    return match[1], match[2], text[match.end() :]


def normal(text: str) -> str | None:
    """*text* without ``.`` and ``..``; None if it leaves its root."""
    kind, root, rest = rooted(text)
    if not kind:
        return posixpath.normpath(text) if text else "."
    base = [] if kind != "workspace" or root in ("", ".") else [part for part in root.split("/") if part]
    if kind == "find-pkg-share":
        base = ["share", root]
    size = len(base)
    lowest = size
    parts = list(base)
    for part in rest.split("/"):
        if part == "..":
            if not parts:
                return None
            parts.pop()
            lowest = min(lowest, len(parts))
        elif part not in ("", "."):
            parts.append(part)
    if kind == "find-pkg-share" and lowest == size:
        return "/".join([f"$(find-pkg-share {root})", *parts[size:]])
    if kind == "workspace":
        return "/".join([WORKSPACE.format("/".join(base[:lowest]) or "."), *parts[lowest:]])
    return "/".join([PREFIX.format(root), *parts])


def absolute(text: str) -> bool:
    return text.startswith("/") or bool(rooted(text)[0])


def joined_path(parts: list[Value]) -> Value:
    """``os.path.join``; the part before an absolute one counts no more."""
    result: list[Any] = []
    for index, part in enumerate(parts):
        value = part.text if isinstance(part, PathValue) else part
        if isinstance(value, str) and absolute(value):
            result = [value]
        elif isinstance(value, (str, PartialText, Unknown)):
            if index and result and not (isinstance(result[-1], str) and result[-1].endswith("/")):
                result.append("/")
            result.extend(phrase(value))
        else:
            result.append(mystery(f"{why(value)} in a path"))
    return text_of(merged(result))


def directory(text: Value) -> Value:
    """``os.path.dirname``."""
    if isinstance(text, PartialText):
        last = text.phrase[-1]
        if isinstance(last, str) and "/" in last:
            return text_of(merged((*text.phrase[:-1], last.rsplit("/", 1)[0])))
        return PartialText((mystery(why(text)),))
    kind, _, rest = rooted(text)
    if not kind:
        return posixpath.dirname(text)
    if rest in ("", "/"):
        up = normal(f"{text}/..")
        return PartialText((mystery("it is outside the workspace"),)) if up is None else up
    return text[: len(text) - len(rest)] + posixpath.dirname(rest).rstrip("/")


def base_name(text: Value) -> Value:
    """``os.path.basename``."""
    if isinstance(text, PartialText):
        last = text.phrase[-1]
        if isinstance(last, str) and "/" in last:
            return last.rsplit("/", 1)[1]
        return PartialText((mystery(why(text)),))
    kind, root, rest = rooted(text)
    return posixpath.basename(rest if rest or not kind else root)


def parent_path(path: Value) -> Value:
    """``Path.parent``: the directory, and the same for a root."""
    if not isinstance(path, PathValue):
        return path
    text = directory(path.text)
    return PathValue("." if text == "" else text)


def clean(text: Value) -> Value:
    """``os.path.normpath``, ``abspath``, ``realpath``; a relative one is that, since the directory is not known."""
    if not isinstance(text, str):
        return text
    found = normal(text)
    return PartialText((mystery("it is outside the workspace"),)) if found is None else found


def readable(value: Value) -> str | Unknown:
    """A path that may be read: it stands under a marker and stays there; Unknown otherwise."""
    text = value.text if isinstance(value, PathValue) else value
    if not isinstance(text, str):
        return Unknown(f"the path is not known: {why(text)}", getattr(text, "location", None))
    kind, root, _ = rooted(text)
    outside = root.startswith("/") or ".." in root.split("/") or (kind != "workspace" and not PACKAGE.fullmatch(root))
    if not kind or outside or "\0" in text:
        return Unknown(f"{text[:100]} is not in the workspace", None)
    found = normal(text)
    if found is None or not rooted(found)[0]:
        return Unknown(f"{text[:100]} is not in the workspace", None)
    if rooted(found)[0] == "find-pkg-prefix":
        match = re.fullmatch(r"\$\(find-pkg-prefix ([^()]*)\)/share/([^/]+)(/.*)?", found)
        if match is None:
            return Unknown(f"{text[:100]} is not in the workspace", None)
        found = f"$(find-pkg-share {match[2]}){match[3] or ''}"
    return found
