# SPDX-License-Identifier: Apache-2.0
"""Names as seen from a node, so that they compare where the node has another name; and which names may be the same."""

from __future__ import annotations

import re
from collections.abc import Sized
from difflib import SequenceMatcher

UNKNOWN = "?"
#: So many pairs of names are likened in one configuration, node or list of calls: 200 that are gone and 200 that are new.
MOST_PAIRS = 40_000


def relative(name: str, node: str) -> str:
    """*name* of an end as the code of *node* may have it: ``~/x`` below the node, ``x`` in its namespace, else whole.

    Parameters of ROS 2 (``/ns/node:x``) are ``x``.
    """
    if name.startswith(f"{node}:"):
        return name[len(node) + 1 :]
    if name.startswith(f"{node}/"):
        return f"~{name[len(node) :]}"
    namespace = node.rpartition("/")[0] + "/"
    return name[len(namespace) :] if name.startswith(namespace) else name


def is_known(name: str) -> bool:
    return UNKNOWN not in name


def may_be_same(one: str, other: str) -> bool:
    """Whether two names, either with unknown parts, can be the same."""
    if one == other:
        return True
    if is_known(one) and is_known(other):
        return False
    return _matches(one, other) or _matches(other, one)


def _matches(pattern: str, name: str) -> bool:
    if is_known(pattern) or len(pattern) > 1000 or pattern.count(UNKNOWN) > 8:
        return not is_known(pattern)
    expression = ".*".join(re.escape(part) for part in pattern.split(UNKNOWN))
    return re.fullmatch(expression, name) is not None


def too_many(removed: Sized, new: Sized) -> bool:
    """Whether more pairs of what is gone and what is new would be compared than is done: then nothing is taken for renamed."""
    return len(removed) * len(new) > MOST_PAIRS


def likeness(one: str, other: str) -> float:
    """How alike two names are, from 0 to 1."""
    return SequenceMatcher(None, one[:200], other[:200]).ratio()
