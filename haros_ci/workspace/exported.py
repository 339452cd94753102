# SPDX-License-Identifier: Apache-2.0
"""Which targets of other packages a target is linked with, once the builds of all packages are known."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from haros_ci.model.build import Build, Target
from haros_ci.regex import regex

_LIBRARIES = regex(r"\$\{(\w+)_(?:LIBRARIES|TARGETS)\}\Z")
_KINDS = ("library", "object", "interface")


def linked(builds: Mapping[str, Build], others: Collection[str] = ()) -> dict[str, Build]:
    """*builds* with ``${package_LIBRARIES}`` and ``${package_TARGETS}`` among links as ``package::target``.

    These are the libraries that a package of the workspace installs (ament_export_libraries and ament_export_targets
    name what is installed). A package that has none, or is not in the workspace, stays as written. *others* are
    packages that know no such rule, those of ROS 1.
    """
    exported = {
        name: tuple(
            f"{name}::{target.name}"
            for target in build.targets
            if target.is_installed and not target.is_test and target.kind in _KINDS
        )
        for name, build in builds.items()
    }
    made = {}
    for name, build in builds.items():
        targets = build.targets if name in others else tuple(_target(target, exported) for target in build.targets)
        made[name] = build if targets == build.targets else replace(build, targets=targets)
    return made


def _target(target: Target, exported: Mapping[str, tuple[str, ...]]) -> Target:
    if not any(link.startswith("${") for link in target.links):
        return target
    links: dict[str, None] = {}
    for link in target.links:
        match = _LIBRARIES.match(link)
        found = exported.get(match[1], ()) if match is not None and match[1] != target.package else ()
        links.update(dict.fromkeys(found or (link,)))
    return replace(target, links=tuple(links))
