# SPDX-License-Identifier: Apache-2.0
"""What a project file lets nodes do: who may publish, subscribe to, call or serve what."""

from __future__ import annotations

from haros_ci.records import dataclass

#: The lists of ``access``, with the kinds of ends that each is about.
VERBS = {
    "publish": ("publishers",),
    "subscribe": ("subscribers",),
    "call": ("clients", "action_clients"),
    "serve": ("servers", "action_servers"),
}


@dataclass(frozen=True, slots=True)
class AccessRule:
    """One entry of a list of ``access``: of what fits *name*, those of *nodes* alone may do *verb*.

    *name* is a full name of a topic, service or action, *nodes* are full names of nodes, or ``package/executable``; in all of them ``*`` stands
    for anything but ``/``, and ``**`` for any number of parts between slashes. *line* is where it stands in the project file.
    """

    verb: str
    name: str
    nodes: tuple[str, ...]
    line: int
