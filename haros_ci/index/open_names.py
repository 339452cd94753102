# SPDX-License-Identifier: Apache-2.0
"""Names of messages and classes through namespaces that using-directives open, and through those around them."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.index.common_messages import COMMON
from haros_ci.index.index import Index, Source
from haros_ci.regex import regex

#: Namespaces of interfaces inside of their packages, and where rosidl puts underscores into the names of their headers (rosidl_cmake).
INTERFACES = frozenset(("msg", "srv", "action"))
_UPPER_WORD, _LOWER_UPPER = regex(r"(.)([A-Z][a-z]+)"), regex(r"([a-z0-9])([A-Z])")


def through(index: Index, name: str, source: Source) -> str:
    """``a::B`` of which the namespace ``a`` has using-directives: the class or interface of an open namespace that it is ([namespace.qual])."""
    head, _, last = name.rpartition("::")
    spaces = () if name in index.library else index.opened_in(source, head)
    if not spaces:
        return name
    classes = [f"{space}::{last}" for space in spaces if f"{space}::{last}" in index.classes]
    if classes:
        return classes[0] if len(classes) == 1 else name
    interface = of_interfaces(index, last, source, {*spaces})
    included = index.messages(source).get(last, "")
    return interface or (included if included.rpartition("::")[0] in spaces else name)


def of_interfaces(index: Index, name: str, source: Source, spaces: set[str]) -> str | None:
    """An unqualified message, service or action of ROS 2 by its header, or as one that is widely known; None if it is neither."""
    kinds = {space: space.partition("::")[2] for space in spaces}
    if not any(kind in INTERFACES for kind in kinds.values()) or not name[:1].isupper():
        return None
    stem = _LOWER_UPPER.sub(r"\1_\2", _UPPER_WORD.sub(r"\1_\2", name)).lower()
    headers = index.messages(source)
    homes = {space for space, kind in kinds.items() if headers.get(f"{kind}/{stem}") == space}
    known = {space for space, kind in kinds.items() if kind == "msg" and name in COMMON.get(space[:-5], ())}
    homes = homes or known
    return f"{homes.pop()}::{name}" if len(homes) == 1 else None


def around(scope: str) -> Iterator[str]:
    """The scopes around what stands in *scope*, and itself: a package's code may lie in the namespace of its interfaces."""
    while scope:
        yield scope
        scope = scope.rpartition("::")[0]


def inside_interfaces(index: Index, name: str, source: Source, spaces: set[str]) -> str:
    """``msg::Type`` with the namespace of its package, open or around it, as far as that is known."""
    head, _, tail = name.partition("::")
    if head not in INTERFACES:
        return name
    inside = tail.partition("::")[0]
    interface = of_interfaces(index, inside, source, {f"{space}::{head}" for space in spaces})
    return interface + tail[len(inside) :] if interface is not None else name
