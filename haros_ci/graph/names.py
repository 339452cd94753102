# SPDX-License-Identifier: Apache-2.0
"""ROS 1 graph names (wiki.ros.org/Names): resolution in a namespace, private names, remapping."""

from __future__ import annotations

import re
from collections.abc import Mapping

from haros_ci.model.location import Location
from haros_ci.values.abstract import Choice, Known, Opaque, Text, Value, opaque_of, written

#: What stands for a part of a name that is not known.
UNKNOWN = "?"


def pattern(value: Value) -> tuple[str, str | None, Location | None]:
    """A name as text, with ``?`` for its unknown parts; then why and where, None if all of it is known."""
    if isinstance(value, Known) and value.value is None:
        return UNKNOWN, "it is None", None
    if isinstance(value, Known):
        return written(value.value), None, None
    why = opaque_of(value) or Opaque("it is not known")
    if isinstance(value, Text):
        text = "".join(part if isinstance(part, str) else UNKNOWN for part in value.parts)
        return re.sub(r"\?{2,}", UNKNOWN, text), why.reason, why.location
    if isinstance(value, Choice):
        texts = [pattern(option)[0] for option in value.options]
        private = "~/" if all(text.startswith("~/") for text in texts) else "~"
        first = {text[:1] for text in texts}
        head = "/" if "/" in first else private if first == {"~"} else ""
        return f"{head}{UNKNOWN}", why.reason, why.location
    return UNKNOWN, why.reason, why.location


def resolve(name: str, namespace: str, node: str) -> str:
    """*name* as an absolute one: ``/x`` is, ``~x`` is private to *node*, anything else is below *namespace*."""
    if name.startswith("/"):
        full = name
    elif name.startswith("~"):
        full = f"{node}/{name[1:]}"
    else:
        full = f"{namespace}/{name}"
    return clean(full)


def clean(name: str) -> str:
    """Without doubled and trailing slashes, with one in front."""
    if name[:1] == "/" and name[-1] != "/" and "//" not in name:
        return name
    return "/" + "/".join(part for part in name.split("/") if part)


def remapped(name: str, remaps: Mapping[str, str]) -> str:
    """ROS 1 remaps a fully resolved name once; the result is not looked up again."""
    return remaps.get(name, name)


def resolve_target(target: str, namespace: str, node: str) -> str:
    """What a remapping gives; a name whose beginning is not known may be absolute."""
    return clean(f"/{target}") if target.startswith("?") else resolve(target, namespace, node)
