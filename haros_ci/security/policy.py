# SPDX-License-Identifier: Apache-2.0
"""Policy files of SROS2: ``<policy><enclaves><enclave path><profiles><profile ns node>`` with lists of topics, services and actions.

``xi:include`` with a file beside it and a pointer of the form ``xpointer(/policy/enclaves/*)`` is followed, as sros2 does. A
profile with an include that cannot be followed is not whole: nothing can be said to be missing in it.
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Iterator

from haros_ci.model.element import Element
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.security.permissions import ENDS, LISTS, Permission

MAX_DEPTH = 8
MAX_PROFILES = 2_000
MAX_RULES = 20_000
MAX_INCLUDES = 2_000
#: Elements that includes may bring.
MAX_INCLUDED = 20_000
MAX_NAME = 300
_POINTER = regex(r"xpointer\((/[\w/]+)/\*\)")
#: An element with the path of the file that it stands in.
Placed = tuple[Element, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeProfile:
    """What a policy says of one node, in one enclave. *is_whole* is False if some of it could not be read."""

    enclave: str
    node: str
    rules: tuple[Permission, ...]
    location: Location
    is_whole: bool = True


@dataclass(frozen=True, slots=True)
class Policy:
    """A policy file. *is_whole* is False if enclaves or profiles may be missing."""

    path: str
    profiles: tuple[NodeProfile, ...]
    is_whole: bool = True

    def of(self, node: str) -> tuple[NodeProfile, ...]:
        """The profiles of a node, by its full name."""
        return tuple(profile for profile in self.profiles if profile.node == node)

    def rules(self, enclave: str) -> tuple[Permission, ...]:
        """All that nodes in *enclave* are allowed and denied: a process has the rules of every profile in its enclave."""
        return tuple(rule for profile in self.profiles if profile.enclave == enclave for rule in profile.rules)

    def is_told(self, enclave: str) -> bool:
        """Whether all that is said of *enclave* was read."""
        return self.is_whole and all(profile.is_whole for profile in self.profiles if profile.enclave == enclave)


def read_policy(path: str, element: Callable[[str], Element | None]) -> Policy | None:
    """The policy at *path*; None if the file is no policy. *element* gives the root of an XML file."""
    root = element(path)
    return _PolicyReader(element).policy(path, root) if root is not None and root.tag == "policy" else None


class _PolicyReader:
    def __init__(self, element: Callable[[str], Element | None]) -> None:
        self.element = element
        self.is_whole = True
        self.count = 0
        self.included_elements = 0

    def policy(self, path: str, root: Element) -> Policy:
        profiles = tuple(
            self.profile(enclave.attributes.get("path", ""), profile)
            for enclaves in self.children((root, path), "enclaves")
            for enclave, place in self.children(enclaves, "enclave")
            for group in self.children((enclave, place), "profiles")
            for profile in self.children(group, "profile")
        )
        return Policy(path, profiles[:MAX_PROFILES], self.is_whole and len(profiles) <= MAX_PROFILES)

    def profile(self, enclave: str, placed: Placed) -> NodeProfile:
        element, path = placed
        space, name = (element.attributes.get(item, "").strip() for item in ("ns", "node"))
        outer, self.is_whole = self.is_whole, True
        base = space if space.endswith("/") else f"{space}/"
        rules: list[Permission] = []
        for rows, place in self.children(placed, *LISTS):
            word, verbs = LISTS[rows.tag]
            for verb in verbs:
                decision = rows.attributes.get(verb, "").strip()
                for row, where in self.children((rows, place), word) if decision in ("ALLOW", "DENY") else ():
                    full = expanded(" ".join(row.text.split()), base, name)
                    if len(full) > MAX_NAME or len(rules) >= MAX_RULES:
                        self.is_whole = False
                        continue
                    rules.append(
                        Permission(
                            kind=ENDS[verb],
                            name=full,
                            allows=decision == "ALLOW",
                            location=Location(where, row.line),
                            is_included=where != path,
                        )
                    )
        is_whole, self.is_whole = self.is_whole, outer
        return NodeProfile(
            enclave=enclave,
            node=base + name,
            rules=tuple(rules),
            location=Location(path, element.line),
            is_whole=is_whole,
        )

    def children(self, placed: Placed, *tags: str, depth: int = 0) -> Iterator[Placed]:
        """The children with *tags*, those that an include brings among them."""
        element, path = placed
        for child in element.children:
            if child.tag in tags:
                yield child, path
            elif child.tag.rpartition(":")[2] == "include":
                yield from self.included(child, path, tags, depth)

    def included(self, include: Element, path: str, tags: tuple[str, ...], depth: int) -> Iterator[Placed]:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(path), include.attributes.get("href", "")))
        pointer = _POINTER.fullmatch(include.attributes.get("xpointer", "").strip())
        self.count += 1
        is_over = self.count > MAX_INCLUDES or self.included_elements > MAX_INCLUDED
        root = self.element(target) if not target.startswith(("/", "..")) and not is_over else None
        if root is None or pointer is None or depth >= MAX_DEPTH:
            self.is_whole = False
            return
        first, *rest = pointer[1].strip("/").split("/")
        found: list[Placed] = [(root, target)] if root.tag == first else []
        for tag in rest:
            self.included_elements += sum(len(parent.children) for parent, _ in found) // 64
            found = [child for parent in found for child in self.children(parent, tag, depth=depth + 1)]
        for parent in found:
            for child in self.children(parent, *tags, depth=depth + 1):
                self.included_elements += 1
                if self.included_elements > MAX_INCLUDED:
                    self.is_whole = False
                    return
                yield child


def expanded(name: str, base: str, node: str) -> str:
    """The full name that a rule is about: ``~`` is the node's own, a relative one in the namespace *base* (ends with ``/``)."""
    if name.startswith("/"):
        return name
    return f"{base}{node}{name[1:]}" if name.startswith("~") else base + name
