# SPDX-License-Identifier: Apache-2.0
"""Parameters of a ROS 2 node whose name is not known: a section of a parameter file may be for it."""

from __future__ import annotations

import pytest

from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.parameters import Perhaps
from haros_ci.model.launch import ParameterRule
from haros_ci.model.location import Location
from haros_ci.values.abstract import Known

PLACE = Location("a.yaml", 1)
#: Sections with their parameters, the node, and what it is given for ``rate``: None for nothing, "?" for what is not known.
CASES = {
    "a section of one node": ({"/camera": {"rate": 1}}, "/?", "?"),
    "a section of one node, without a slash": ({"camera": {"rate": 1}}, "/?", "?"),
    "a section of one node beside that of all": ({"/**": {"rate": 2}, "/camera": {"rate": 1}}, "/?", "?"),
    "a node in a namespace": ({"/a/camera": {"rate": 1}}, "/a/?", "?"),
    "a part of the name is known": ({"/camera_1": {"rate": 1}}, "/camera_?", "?"),
    "a section of all nodes": ({"/**": {"rate": 2}}, "/?", 2),
    "another parameter": ({"/camera": {"size": 1}}, "/?", None),
    "another namespace": ({"/b/camera": {"rate": 1}}, "/a/?", None),
    "another name": ({"/lidar": {"rate": 1}}, "/camera_?", None),
    "the name is known": ({"/camera": {"rate": 1}}, "/lidar", None),
    "nothing is given": ({}, "/?", None),
    "its own section": ({"/camera": {"rate": 1}, "/lidar": {"rate": 3}}, "/camera", 1),
}


@pytest.mark.parametrize(("sections", "node", "expected"), CASES.values(), ids=CASES)
def test_what_it_is_given(sections: dict[str, dict[str, int]], node: str, expected: int | str | None) -> None:
    rules = [
        ParameterRule(type=None, location=PLACE, node=pattern, name=name, value=value)
        for pattern, section in sections.items()
        for name, value in section.items()
    ]
    found = Parameters(rules).get(node, "rate")
    if expected == "?":
        assert isinstance(found, Perhaps) and found.location == PLACE
    else:
        assert found == (Known(expected) if expected is not None else None)
