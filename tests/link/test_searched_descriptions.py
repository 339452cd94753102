# SPDX-License-Identifier: Apache-2.0
"""Where urdf::Model looks for a robot's description: from the namespace of a node handle upwards, not from the node's own name."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

HEAD = "#include <urdf/model.h>\n"
IN_GROUP = '<launch>{}<group ns="a"><node pkg="p" type="n" name="n">{}</node></group></launch>'
GLOBAL, OWN = '<param name="/description" value="x"/>', '<param name="description" value="x"/>'
FROM_NODE = ('m.initParam("description");', 'm.initParamWithNodeHandle("description");')


@pytest.mark.parametrize("code", FROM_NODE)
@pytest.mark.parametrize(
    ("launch", "expected"),
    [
        ("", "/description"),
        (IN_GROUP.format("", ""), "/a/description"),
        (IN_GROUP.format("", OWN), "/a/description"),
        (IN_GROUP.format(GLOBAL, OWN), "/description"),
        (IN_GROUP.format('<param name="/a/description" value="x"/>', ""), "/a/description"),
    ],
)
def test_the_search_begins_in_the_namespace_of_the_node(code: str, launch: str, expected: str) -> None:
    assert names(cpp("urdf::Model m; " + code, HEAD, launch), "getters") == [expected]


@pytest.mark.parametrize(
    ("handle", "launch", "expected"),
    [
        ('ros::NodeHandle("~")', "", "/n/description"),
        ('ros::NodeHandle("~")', IN_GROUP.format(GLOBAL, OWN), "/a/n/description"),
        ('ros::NodeHandle("~")', IN_GROUP.format(GLOBAL, ""), "/description"),
        ('ros::NodeHandle("b")', "", "/b/description"),
        ("nh", IN_GROUP.format(GLOBAL, OWN), "/description"),
    ],
)
def test_a_handle_that_is_given_says_where(handle: str, launch: str, expected: str) -> None:
    code = f'urdf::Model m; m.initParamWithNodeHandle("description", {handle});'
    assert names(cpp(code, HEAD, launch), "getters") == [expected]


@pytest.mark.parametrize("code", ['m.initParam("/description");', 'm.initParamWithNodeHandle("/description", nh);'])
def test_an_absolute_name_is_not_searched_for(code: str) -> None:
    assert names(cpp("urdf::Model m; " + code, HEAD, IN_GROUP.format("", OWN)), "getters") == ["/description"]
