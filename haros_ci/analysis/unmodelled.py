# SPDX-License-Identifier: Apache-2.0
"""Plug-in libraries whose code is in the workspace and of which the model shows nothing."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.model.architecture import Architecture
from haros_ci.model.build import Build
from haros_ci.report.summary import plural

#: Bases of plug-ins that are nodes themselves: one that no launch file loads is shown as a configuration of its own.
_NODES = frozenset(("nodelet::Nodelet", "rclcpp_components::NodeFactory"))
MOST = 5


def unmodelled(found: Architecture, builds: Mapping[str, Build]) -> tuple[str, ...]:
    """A sentence on the packages with plug-ins (controllers, planners, layers, displays) that no node of *found* is seen to load.

    What they publish, subscribe to and read is missing from the model. None where there is no such package.
    """
    shown = {name for one in found.configurations for node in one.nodes for name in _names(node.package, node.type)}
    shown |= {node.class_name for one in found.configurations for node in one.nodes if node.class_name}
    missing: dict[str, str] = {}
    for package, build in sorted(builds.items()):
        for plugin in build.plugins:
            if plugin.base not in _NODES and plugin.name not in shown and plugin.type not in shown:
                missing.setdefault(package, plugin.base)
    if not missing:
        return ()
    return (
        f"Not modelled: plug-ins of {plural(len(missing), 'package')} ({_listed(missing.items())}). No node is seen to load them, so the topics, "
        "services and parameters that they may use are not in the model",
    )


def _names(package: str, type_: str) -> tuple[str, ...]:
    return type_, f"{package}/{type_}", f"{package}::{type_}"


def _listed(items: Iterable[tuple[str, str]]) -> str:
    every = [f"{package}: {base}" for package, base in items]
    more = f"; and {len(every) - MOST} more" if len(every) > MOST else ""
    return "; ".join(every[:MOST]) + more
