# SPDX-License-Identifier: Apache-2.0
"""Types of messages that are one to ROS 1, as it compares their MD5 sums: with the same fields, they connect under whatever names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from haros_ci.interfaces.definitions import Definitions
from haros_ci.interfaces.md5 import md5
from haros_ci.workspace.interfaces import read_interface

if TYPE_CHECKING:
    from haros_ci.model.package import Package
    from haros_ci.model.workspace import Workspace

#: Definitions of a workspace that are read; in a larger one no sum is known.
MOST = 5_000


class SumsOfMessages:
    """The MD5 sums of the messages of ROS 1 that the *packages* of a workspace define, and of the common ones."""

    def __init__(self, workspace: Workspace | None, packages: Mapping[str, Package]) -> None:
        self._workspace, self._packages = workspace, packages
        self._known: Definitions | None = None

    def are_one(self, one: str, other: str) -> bool:
        """Whether two types (``pkg/T``) have one sum (roscpp's Publication::validateHeader, rospy's tcpros_pubsub); False where one is not known."""
        sums = {self._sum(one), self._sum(other)}
        return len(sums) == 1 and None not in sums

    def _sum(self, name: str) -> str | None:
        if self._known is None:
            self._known = self._read()
        found = self._known.find("msg", name)
        return None if found is None else md5(found, self._known)

    def _read(self) -> Definitions:
        found = []
        workspace = self._workspace
        names = () if workspace is None else [name for name in workspace.names if name.endswith(".msg")]
        if workspace is not None and len(names) <= MOST:
            homes = {package.path: package.name for package in self._packages.values()}
            for name in sorted(names):
                home, _, inner = name.partition("/msg/")
                package = homes.get(home) if inner else homes.get(".") if name.startswith("msg/") else None
                if package is not None and "/" not in inner:
                    found.append(read_interface(name, workspace.text(name), package)[0])
        return Definitions(found, 1)
