# SPDX-License-Identifier: Apache-2.0
"""C++: ``std::optional`` and ``boost::optional`` hold something or not; ``std::exchange`` gives what was there."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

TALKER = 'struct Talker { explicit Talker(ros::NodeHandle & nh, std::string topic = "t") { ADV(topic, 1); } };\n'
KNOWN = [
    ('std::optional<std::string> n{"t"}; ADV(n.value(), 1);', ["/t"]),
    ('boost::optional<std::string> n = std::string("t"); ADV(n.value(), 1);', ["/t"]),
    ('std::optional<std::string> n; ADV(n.value_or("t"), 1);', ["/t"]),
    ('std::optional<std::string> n = "a"; ADV(n.value_or("t"), 1);', ["/a"]),
    ('boost::optional<std::string> n = boost::none; ADV(n.get_value_or("t"), 1);', ["/t"]),
    ('std::optional<std::string> n; n.emplace("t"); ADV(*n, 1);', ["/t"]),
    ('std::optional<std::string> n = "a"; n.reset(); ADV(n.value_or("t"), 1);', ["/t"]),
    ('std::optional<std::string> n = "a"; n = std::nullopt; ADV(n.value_or("t"), 1);', ["/t"]),
    ('auto n = std::make_optional<std::string>("t"); ADV(*n, 1);', ["/t"]),
    ('auto n = std::make_optional(std::string("t")); ADV(n.value(), 1);', ["/t"]),
    ('std::optional<ros::NodeHandle> h; h.emplace("x"); auto p = h->advertise<std_msgs::String>("t", 1);', ["/x/t"]),
    ('std::optional<ros::NodeHandle> h("x"); auto p = h.value().advertise<std_msgs::String>("t", 1);', ["/x/t"]),
    ("std::optional<Talker> talker; talker.emplace(nh);", ["/t"]),
    ('std::optional<Talker> talker; talker.emplace(nh, "u");', ["/u"]),
    ("std::optional<Talker> talker(std::in_place, nh);", ["/t"]),
    ('std::string n = "t"; auto o = std::exchange(n, "u"); ADV(o, 1); ADV(n, 1);', ["/t", "/u"]),
]
UNKNOWN = [
    'std::optional<std::string> n; if (rand()) n = "a"; ADV(n.value_or("t"), 1);',
    "std::optional<std::string> n; ADV(n.value(), 1);",
    'std::optional<std::string> n = asked(); ADV(n.value_or("t"), 1);',
    'std::string n = asked(); auto o = std::exchange(n, "u"); ADV(o, 1);',
    "std::optional<std::string> n; n.emplace(asked()); ADV(*n, 1);",
    'Other<std::string> n; n.emplace("t"); ADV(n.value(), 1);',
]


@pytest.mark.parametrize(("body", "expected"), KNOWN)
def test_what_is_inside_is_known(body: str, expected: list[str]) -> None:
    assert names(cpp(body, TALKER)) == expected


@pytest.mark.parametrize("body", UNKNOWN)
def test_what_is_inside_is_not_known(body: str) -> None:
    assert names(cpp(body, "std::string asked();\n")) == ["/?"]


@pytest.mark.parametrize(
    ("body", "ruled_out"),
    [
        ('std::optional<int> n = 1; if (n.has_value()) ADV(std::string("t"), 1);', False),
        ('std::optional<int> n; if (n.has_value()) ADV(std::string("t"), 1);', True),
        ('std::optional<int> n = std::nullopt; if (n) ADV(std::string("t"), 1);', True),
        ('std::optional<int> n; n.emplace(1); if (!n.has_value()) ADV(std::string("t"), 1);', True),
        ('std::optional<int> n = asked(); if (n.has_value()) ADV(std::string("t"), 1);', False),
        ('std::optional<int> n; if (rand()) n = 1; if (n.has_value()) ADV(std::string("t"), 1);', False),
    ],
)
def test_whether_something_is_inside_decides(body: str, ruled_out: bool) -> None:
    (end,) = cpp(body, "int asked();\n").endpoints
    assert end.is_ruled_out is ruled_out
