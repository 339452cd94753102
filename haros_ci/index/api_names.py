# SPDX-License-Identifier: Apache-2.0
"""Names of APIs: how calls look in code of the functions and classes that API rows tell of."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.index import behavior_tree_files
from haros_ci.index.index import Index
from haros_ci.index.mentions import CONTAINERS, COUNTED
from haros_ci.model.api import Entry, Row
from haros_ci.model.architecture import KINDS
from haros_ci.model.once import once

#: Words for methods of all sorts of classes.
EVERYDAY = frozenset("start add call create configure init del search".split())
#: Functions of classes that have the names of others in namespaces.
MAKERS = frozenset(("make_shared", "make_unique"))


def api_names(index: Index, rows: tuple[Row, ...]) -> frozenset[str]:
    """How the calls look by which something is made."""
    found, calls = making_rows(rows)
    if any("<nodelet/loader.h>" in source.program.includes for source in index.sources.values()):
        found |= {".load"}
    if behavior_tree_files.users(index):
        found |= behavior_tree_files.CALLS
    opened = {space for source in index.sources.values() for _, space in source.program.scopes}
    return found | {name for space, name in calls if space in opened}


@once
def called_back(rows: tuple[Row, ...]) -> frozenset[str]:
    """How the calls look that are given what is called back."""
    return frozenset(name for row in rows if row.calls for name in spellings(row))


@once
def making_rows(rows: tuple[Row, ...]) -> tuple[frozenset[str], tuple[tuple[str, str], ...]]:
    """How the calls of those rows look that make something, and the namespace and name of each."""
    making = [row for row in rows if _makes(row)]
    calls = [row.call.rpartition("::") for row in making]
    return frozenset(name for row in making for name in spellings(row)), tuple(
        (space, name) for space, _, name in calls
    )


def spellings(row: Row) -> Iterable[str]:
    """How a call of the row's function looks: a class by its name, a method after a dot, a function with its namespace.

    Words that any class may have as a method are left out: what they make is callbacks at most.
    """
    name = row.call
    parts = name.replace(".", "::").split("::")
    last = parts[-1]
    if last in COUNTED:
        return tuple(f"{last}/{count}" for count in row.args)
    if last[:1].isupper() or len(parts) == 1:
        return (last, f".{last}")
    if parts[-2][:1].isupper() and last in MAKERS:
        return ("::".join(parts[-2:]),)
    if parts[-2][:1].isupper():
        return () if last in CONTAINERS or last in EVERYDAY else (last, f".{last}")
    # A function of a namespace or module: Python's are called on the module.
    return ("::".join(parts[-2:]), f".{last}") if "." in name else ("::".join(parts[-2:]),)


def _makes(row: Row) -> bool:
    return bool(row.entry or row.unseen) or any(entry.kind in KINDS or _is_node(entry) for entry in row.makes)


def _is_node(entry: Entry) -> bool:
    """Whether an object becomes a node of a ROS 2 process."""
    return entry.kind == "node" and "anonymous" not in entry.values
