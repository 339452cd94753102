# SPDX-License-Identifier: Apache-2.0
"""Values of parameter files with a tag: ``!!str 10`` is a text for rcl."""

from __future__ import annotations

import pytest

from haros_ci.launch.ros2.parameter_yaml import Map, Scalar, rcl_value, read_trees
from haros_ci.substitutions.names import literal


@pytest.mark.parametrize(
    ("written", "type"),
    [
        ("!!str 10", "str"),
        ("!!str true", "str"),
        ("!!str 1.5", "str"),
        ("!!str word", "str"),
        ("10", "int"),
        ("true", "bool"),
        ("1e3", "double"),
        ("'10'", "str"),
        ("word", "str"),
        ("~", "str"),
    ],
)
def test_types(written: str, type: str) -> None:
    (tree,) = read_trees(literal(f"rate: {written}\n"))
    assert isinstance(tree, Map)
    value = tree.entries["rate"]
    assert isinstance(value, Scalar)
    assert rcl_value(value)[0] == type
