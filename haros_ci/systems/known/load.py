# SPDX-License-Identifier: Apache-2.0
"""The data files of this directory, and a project file's ``known_nodes`` of the same shape."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from haros_ci.model.workspace import Problem
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.shape import PACKAGE, read_package, shown

_HERE = Path(__file__).parent


@lru_cache(maxsize=512)
def load_known(package: str, ros: int = 1) -> Mapping[str, KnownNode] | None:
    """The known node types of *package* by executable or look-up name; None if there is no file on it.

    Of ROS 2 a node type that is a component, too, is there by its class as well.
    """
    if not re.fullmatch(PACKAGE, package):
        return None
    path = _directory(ros) / f"{package}.yaml"
    if not path.is_file():
        return None
    nodes, _ = read_package(parse(path.read_text(encoding="utf-8")), package, path.name, ros=ros)
    return MappingProxyType(by_every_name(nodes))


def known_packages(ros: int = 1) -> tuple[str, ...]:
    """The packages that there is a file on for ROS 1 or 2, sorted."""
    return tuple(sorted(path.stem for path in _directory(ros).glob("*.yaml")))


def by_every_name(nodes: Mapping[str, KnownNode]) -> dict[str, KnownNode]:
    """*nodes*, those that are components by their class, too."""
    return {**{node.component: node for node in nodes.values() if node.component}, **nodes}


def _directory(ros: int) -> Path:
    return _HERE / "ros2" if ros == 2 else _HERE


def load_user(data: Mapping[Any, Any], where: str) -> tuple[Mapping[str, Mapping[str, KnownNode]], tuple[Problem, ...]]:
    """``known_nodes`` of the project file *where*: package -> node type -> what one entry of a data file is.

    What has a wrong shape is left out, with a problem that says where and how it is written.
    """
    if not isinstance(data, Mapping):
        return MappingProxyType({}), (Problem(where, "known_nodes must be a map of packages"),)
    found: dict[str, Mapping[str, KnownNode]] = {}
    problems: list[Problem] = []
    for package, nodes in data.items():
        if not isinstance(package, str) or not re.fullmatch(PACKAGE, package):
            problems.append(Problem(where, f"known_nodes: {shown(package)!r} is no name of a package"))
            continue
        read, notes = read_package(nodes, package, where, f"known_nodes.{package}.")
        problems += notes
        if read:
            found[package] = MappingProxyType(by_every_name(read))
    return MappingProxyType(found), tuple(problems)


def parse(text: str) -> object:
    """YAML of our own data files, with libyaml where PyYAML has it; they need none of the limits of ``bounded_yaml``."""
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return yaml.load(text, Loader=loader)
