# SPDX-License-Identifier: Apache-2.0
"""Lines that are read from a stream: how many there are is not known, nor what they are."""

from __future__ import annotations

import pytest
from ros2_cpp_kit import component, explicit

READ = "std::vector<std::string> lines; std::string line; while (std::getline(std::cin, line)) {{ {} }}"
AFTER = 'p_ = create_publisher<String>("after", 1);'
KEPT = READ.format("lines.push_back(line);")


@pytest.mark.parametrize(
    "body",
    (
        f"{KEPT} if (lines.empty()) {{ return; }} {AFTER}",
        f"{KEPT} if (lines.size() < 2) {{ return; }} {AFTER}",
        f"{KEPT} if (lines[0].empty()) {{ return; }} {AFTER}",
        f"std::string line; if (!std::getline(std::cin, line)) {{ return; }} {AFTER}",
        f"std::string line; if (std::getline(std::cin, line)) {{ return; }} {AFTER}",
        f"std::ifstream file(path_); if (!file.is_open()) {{ return; }} {AFTER}",
    ),
)
def test_what_is_read_decides_nothing(body: str) -> None:
    (end,) = explicit(component(body, "rclcpp::PublisherBase::SharedPtr p_; std::string path_;"))
    assert (end.name, end.unknowns) == ("/after", ())


def test_made_for_each_line() -> None:
    body = READ.format('p_ = create_publisher<String>("a/" + line, 1);')
    (end,) = explicit(component(body, "rclcpp::PublisherBase::SharedPtr p_;"))
    assert (end.name, [each.statement for each in end.conditions]) == ("/a/?", ["while"])
