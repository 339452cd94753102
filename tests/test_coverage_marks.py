# SPDX-License-Identifier: Apache-2.0
"""A node of which the model may lack something says so, and checks are silent then."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.coverage_nodes import NOT_IN
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

MANIFEST = (
    "<package format='3'><name>demo</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@example.com'>a</maintainer><license>MIT</license><depend>rclcpp</depend><depend>std_msgs</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "add_executable(talker src/talker.cpp)\ninstall(TARGETS talker DESTINATION lib/demo)\nament_package()\n"
)
HEAD = "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\nusing std_msgs::msg::String;\n"
MAIN = "int main(int c, char** v) { rclcpp::init(c, v); rclcpp::spin(std::make_shared<Talker>()); }\n"
#: A class whose constructor makes a publisher, with *more* in it and *members* beside it.
CLASS = """class Talker : public rclcpp::Node {{
public:
  Talker() : Node("talker") {{
    pub_ = create_publisher<String>("chatter", 1);
    {more}
  }}
  {members}
  rclcpp::Publisher<String>::SharedPtr pub_;
  rclcpp::Publisher<String>::SharedPtr other_;
}};
"""
CALL = 'other_ = create_publisher<String>("other", 1);'


def talker(root: Path, more: str = "", members: str = "", before: str = "", after: str = "") -> Node:
    """The node ``/talker`` of a program with these parts."""
    (root / "src").mkdir()
    (root / "package.xml").write_text(MANIFEST)
    (root / "CMakeLists.txt").write_text(CMAKE)
    text = HEAD + before + CLASS.format(more=more, members=members) + after + MAIN
    (root / "src" / "talker.cpp").write_text(text)
    workspace = discover(root, (".",))
    made = varied(workspace, Settings(root=root), MemoryCache(), alternatives=False)
    (configuration,) = made.architecture.configurations
    (node,) = configuration.nodes
    return node


def reasons(root: Path, more: str = "", members: str = "", before: str = "", after: str = "") -> list[str]:
    """Why the node ``/talker`` may have more, by calls that the model does not account for."""
    node = talker(root, more, members, before, after)
    return [unknown.reason for unknown in node.unknowns if unknown.reason.endswith(NOT_IN)]


@pytest.mark.parametrize(
    "more",
    [f"unknown_library::later([this]() {{ {CALL} }});", f"if (Registry::find([this] {{ {CALL} return 1; }})) {{}}"],
)
def test_a_call_that_is_not_followed_is_said(tmp_path: Path, more: str) -> None:
    found = reasons(tmp_path, more)
    assert not found or "create_publisher" in found[0]


def test_a_pointer_to_a_method_is_followed(tmp_path: Path) -> None:
    members = f"void more(Later & l) {{ {CALL} }} void again() {{ unknown_library::later(this, &Talker::more); }}"
    node = talker(tmp_path, "unknown_library::later(this, &Talker::again);", members)
    assert [endpoint.name for endpoint in node.endpoints if not endpoint.implicit] == ["/chatter", "/other"]


@pytest.mark.parametrize(
    ("more", "members", "before", "after"),
    [
        ("", "", "", ""),
        ("", f"void more() {{ {CALL} }}", "", ""),
        (CALL, "", "", ""),
        ("more();", f"void more() {{ {CALL} }}", "", ""),
        (f"if (get_name()[0] == 'x') {{ {CALL} }}", "", "", ""),
        ("// " + CALL, "", "", ""),
        ('RCLCPP_INFO(get_logger(), "create_publisher(x)");', "", "", ""),
        ("", "", 'struct Other { void f(rclcpp::Node& node) { node.create_publisher<String>("x", 1); } };\n', ""),
        ("", "", "", 'void alone(rclcpp::Node& node) { node.create_publisher<String>("x", 1); }\n'),
        ("factory_.create_publisher(1);", "struct Factory { void create_publisher(int) {} } factory_;", "", ""),
    ],
)
def test_what_is_accounted_for_or_of_nobody_is_not_said(
    tmp_path: Path, more: str, members: str, before: str, after: str
) -> None:
    assert reasons(tmp_path, more, members, before, after) == []


SCRIPT = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.first = self.create_publisher(String, "chatter", 1)
        {}
    def more(self):
        self.other = self.create_publisher(String, "other", 1)
rclpy.init()
node = Talker()
"""


@pytest.mark.parametrize(
    ("more", "count"), [("pass", 0), ("pass  # self.more()", 0), ("self.register(self.more)", 1), ("self.more()", 0)]
)
def test_a_method_of_python_that_nothing_names_is_not_said(tmp_path: Path, more: str, count: int) -> None:
    (tmp_path / "scripts").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    install = "install(PROGRAMS scripts/talker.py DESTINATION lib/demo)"
    (tmp_path / "CMakeLists.txt").write_text(CMAKE.replace("add_executable(talker src/talker.cpp)", install))
    (tmp_path / "scripts" / "talker.py").write_text(SCRIPT.format(more))
    workspace = discover(tmp_path, (".",))
    made = varied(workspace, Settings(root=tmp_path), MemoryCache(), alternatives=False)
    (configuration,) = made.architecture.configurations
    found = [u for node in configuration.nodes for u in node.unknowns if u.reason.endswith(NOT_IN)]
    ends = [end.name for node in configuration.nodes for end in node.endpoints if end.kind == "publishers"]
    assert len(found) == (0 if "/other" in ends else count)
