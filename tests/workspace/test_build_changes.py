# SPDX-License-Identifier: Apache-2.0
"""Packages whose build files nothing here reads: named where a change brings them."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.build_changes import brought_builders


def space(*builders: str) -> Workspace:
    packages = tuple(Package(name=f"p{i}", path=f"p{i}", build_type=one) for i, one in enumerate(builders))
    return Workspace(Path("/"), packages, (), None, None)  # type: ignore[arg-type]  # nothing of it is read


@pytest.mark.parametrize(
    ("base", "head", "paths"),
    [
        (("",), ("meson",), ["p0/package.xml"]),
        ((), ("ament_cargo", "ament_cmake"), ["p0/package.xml"]),
        (("meson",), ("ament_gradle",), ["p0/package.xml"]),
        (("meson",), ("meson",), []),
        (("meson",), ("ament_cmake",), []),
        ((), ("ament_cmake", "ament_python", "catkin", "cmake", ""), []),
        (("meson",), (), []),
    ],
)
def test_builders(base: tuple[str, ...], head: tuple[str, ...], paths: list[str]) -> None:
    assert [problem.path for problem in brought_builders(space(*head), space(*base))] == paths
