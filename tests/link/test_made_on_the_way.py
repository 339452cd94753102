# SPDX-License-Identifier: Apache-2.0
"""C++: elements that a container makes and gives back, and entries that a map has from the first time they are named."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends

HOLDS = "struct Site { int a = 0; }; std::string f(); std::map<std::string, Site> sites;\n"
LOOP = 'for (auto& [name, site] : sites) { nh.advertise<std_msgs::String>("late", 1); }'
#: The body, and whether a loop over the map has no turn.
MAPS = {
    "a member of an entry whose key is not known": ("sites[f()].a = 1;", False),
    "an entry whose key is not known": ("sites[f()] = Site();", False),
    "one that is only read": ("int k = sites[f()].a;", False),
    "a member of an entry whose key is known": ('sites["a"].a = 1;', False),
    "nothing is put in": ("", True),
    "it is asked for": ("sites.count(f());", True),
    "it is looked for": ("sites.find(f());", True),
    "it is emptied after": ("sites[f()].a = 1; sites.clear();", True),
    "another map": ("std::map<std::string, Site> others; others[f()].a = 1;", True),
}


@pytest.mark.parametrize(("body", "is_empty"), MAPS.values(), ids=MAPS)
def test_a_loop_over_a_map(body: str, is_empty: bool) -> None:
    found = cpp(f"{body}\n{LOOP}", HOLDS)
    names = [(end.name, end.is_ruled_out) for end in ends(found, "publishers")]
    assert names == ([] if is_empty else [("/late", False)])


HANDLES = "struct Part { ros::Publisher pub; Part(ros::NodeHandle h, std::string name) { pub = h.advertise<std_msgs::String>(name, 1); } };\n"
#: The body, and the names of publishers.
ELEMENTS = {
    "a pointer": (
        'std::vector<std::shared_ptr<ros::NodeHandle>> v; auto h = v.emplace_back(std::make_shared<ros::NodeHandle>("s")); h->advertise<std_msgs::String>("a", 1);',
        ["/s/a"],
    ),
    "a reference": (
        'std::vector<ros::NodeHandle> v; auto& h = v.emplace_back("s"); h.advertise<std_msgs::String>("a", 1);',
        ["/s/a"],
    ),
    "in a list whose elements are not known": (
        'std::vector<std::shared_ptr<ros::NodeHandle>> v; v.insert(v.begin(), g()[0]); auto h = v.emplace_back(std::make_shared<ros::NodeHandle>("s")); h->advertise<std_msgs::String>("a", 1);',
        ["/s/a"],
    ),
    "a text is an element": (
        'std::vector<std::string> v; auto t = v.emplace_back("a"); nh.advertise<std_msgs::String>(t, 1);',
        ["/?"],
    ),
    "push_back gives nothing": (
        'std::vector<std::string> v; v.push_back("a"); nh.advertise<std_msgs::String>(v[0], 1);',
        ["/a"],
    ),
}


@pytest.mark.parametrize(("body", "expected"), ELEMENTS.values(), ids=ELEMENTS)
def test_what_is_put_behind_the_others(body: str, expected: list[str]) -> None:
    assert [
        end.name
        for end in ends(cpp(body, HANDLES + "std::vector<std::shared_ptr<ros::NodeHandle>> g();\n"), "publishers")
    ] == expected
