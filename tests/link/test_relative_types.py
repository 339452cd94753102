# SPDX-License-Identifier: Apache-2.0
"""C++ of ROS 2: types of interfaces in the namespace of their own package, and numbers that are made by the name of their type."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_main

INCLUDES = '#include "p/srv/set_float32.hpp"\n#include "p/msg/state.hpp"\n'
NODE = (
    'class N : public rclcpp::Node { public: N() : Node("n") {\n'
    '  s_ = create_service<srv::SetFloat32>("s", [](srv::SetFloat32::Request::SharedPtr, srv::SetFloat32::Response::SharedPtr) {});\n'
    '  p_ = create_publisher<msg::State>("t", 1);\n}};\n'
)


@pytest.mark.parametrize("space", ["p", "p::inner"])
def test_in_the_namespace_of_the_package(space: str) -> None:
    head = "".join(f"namespace {part} {{ " for part in space.split("::"))
    text = INCLUDES + head + NODE + "}" * (space.count("::") + 1)
    (found,) = ros2_main(f"rclcpp::spin(std::make_shared<{space}::N>());", before=text).nodes
    (service,), (publisher,) = explicit(found, "servers"), explicit(found)
    assert (service.type, publisher.type) == ("p/srv/SetFloat32", "p/msg/State")


@pytest.mark.parametrize(
    "text",
    [
        INCLUDES + "namespace q { " + NODE + "}",
        "namespace p { " + NODE + "}",
        INCLUDES + "namespace p { struct A {}; }\nnamespace q { " + NODE + "}",
    ],
)
def test_in_another_namespace(text: str) -> None:
    space = "p" if text.startswith("namespace p") else "q"
    (found,) = ros2_main(f"rclcpp::spin(std::make_shared<{space}::N>());", before=text).nodes
    (publisher,) = explicit(found)
    assert publisher.type is None and [u.field for u in publisher.unknowns] == ["type"]


@pytest.mark.parametrize(
    ("depth", "expected"),
    [
        ("std::size_t{1}", 1),
        ("size_t(2)", 2),
        ("std::uint32_t{3}", 3),
        ("int{4}", 4),
        ("int(5.5)", 5),
        ("uint8_t{6}", 6),
        ("unsigned(7)", 7),
        ("f(8)", "?"),
        ("Depth{9}", "?"),
    ],
)
def test_numbers_by_the_name_of_their_type(depth: str, expected: object) -> None:
    body = f'auto n = rclcpp::Node::make_shared("n"); auto p = n->create_publisher<String>("t", rclcpp::QoS(rclcpp::KeepLast{{{depth}}}));'
    (found,) = ros2_main(body).nodes
    (publisher,) = explicit(found)
    assert publisher.qos is not None and publisher.qos.depth == expected
