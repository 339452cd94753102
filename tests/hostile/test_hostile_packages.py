# SPDX-License-Identifier: Apache-2.0
"""Packages, builds, plug-ins and policies in numbers that make anything that compares each with each never end."""

from __future__ import annotations

import pytest
from hostile_kit import Trap, assert_harmless, assert_the_rest_is_analysed

HEAD = """<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>
{more}
<export><build_type>ament_cmake</build_type></export></package>
"""
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject({name})\nfind_package(ament_cmake REQUIRED)\n{more}\nament_package()\n"
GOOD = """<robot name="g"><link name="a"/>
<joint name="j" type="fixed"><parent link="a"/>
<child link="missing"/></joint></robot>
"""
Files = dict[str, str]


def package(name: str, depends: str = "", commands: str = "") -> Files:
    return {
        f"{name}/package.xml": HEAD.format(name=name, more=depends),
        f"{name}/CMakeLists.txt": CMAKE.format(name=name, more=commands),
    }


def lines(count: int, *each: str) -> str:
    return "\n".join(line.replace("@", str(number)) for number in range(count) for line in each)


def cycle(count: int) -> Files:
    return {
        path: text
        for number in range(count)
        for path, text in package(f"p{number}", f"<depend>p{(number + 1) % count}</depend>").items()
    }


INCLUDE = '<xi:include href="{}" xpointer="xpointer(/policy/{}/*)"/>\n'
POLICY = (
    '<policy version="0.2.0" xmlns:xi="http://www.w3.org/2001/XInclude"><enclaves><enclave path="/a"><profiles>'
    "{}</profiles></enclave></enclaves></policy>"
)
ACCESS = "<topics publish='ALLOW' subscribe='ALLOW'>{}</topics>"
MANY: dict[str, Files] = {
    "find_package": package("bad", commands=lines(4_000, "find_package(p@ REQUIRED)")),
    "dependencies": package("bad", lines(4_000, "<depend>p@</depend>")),
    "targets": package(
        "bad", commands=lines(1_000, "add_executable(t@ t@.cpp)", "install(TARGETS t@ DESTINATION lib/bad)")
    ),
    "installed": package(
        "bad", commands=lines(1_000, "install(DIRECTORY d@ DESTINATION share/bad)", "install(FILES f@ DESTINATION s)")
    ),
    "exported": package("bad", commands=lines(1_000, "ament_export_libraries(bad@)", "ament_export_targets(e@)")),
    "blank lines of a .gitmodules": {
        **package("bad", commands=lines(1_000, "install(DIRECTORY d@ DESTINATION share/bad)")),
        ".gitmodules": "\n" * 1_000_000,
        ".gitignore": "\n" * 1_000_000,
    },
    "a circle": cycle(300),
    "plug-ins": {
        **package("bad", commands="pluginlib_export_plugin_description_file(b p.xml)\nadd_library(l SHARED l.cpp)"),
        "bad/p.xml": '<library path="l">\n'
        + lines(1_000, '<class type="n::C@" base_class_type="b::B@"/>')
        + "</library>",
        "bad/l.cpp": lines(1_000, "PLUGINLIB_EXPORT_CLASS(n::D@, b::B@)"),
    },
    "components": {
        **package(
            "bad",
            commands="add_library(l SHARED l.cpp)\n" + lines(800, 'rclcpp_components_register_nodes(l "n::C@")'),
        ),
        "bad/l.cpp": lines(800, "RCLCPP_COMPONENTS_REGISTER_NODE(n::D@)"),
    },
    "patterns of a policy": {
        **package("bad", commands="add_executable(t t.cpp)\ninstall(TARGETS t DESTINATION lib/bad)"),
        "bad/t.cpp": '#include <rclcpp/rclcpp.hpp>\nint main(){rclcpp::init(0,0);auto n=std::make_shared<rclcpp::Node>("a");\n'
        + lines(20, 'n->create_publisher<std_msgs::msg::String>("t@",1);')
        + "rclcpp::spin(n);}\n",
        "bad/launch/l.launch.xml": "<launch>\n"
        + lines(300, '<node pkg="bad" exec="t" name="n@" args="--ros-args --enclave /a"/>')
        + "</launch>",
        "bad/policy.xml": POLICY.format(
            lines(
                300,
                '<profile ns="/" node="n@">'
                + ACCESS.format(lines(40, "<topic>t#_@*a*b*c</topic>").replace("_", "_@_"))
                + "</profile>",
            )
        ),
    },
    "includes of a policy": {
        **package("bad"),
        **{
            f"bad/p{number}.policy.xml": POLICY.format(
                '<profile ns="/" node="n">\n'
                + INCLUDE.format("big.xml", "a") * 900
                + '</profile><profile ns="/" node="m">\n'
                + INCLUDE.format(f"p{number}.policy.xml", "enclaves") * 60
                + "</profile>"
            )
            for number in range(10)
        },
        "bad/big.xml": "<policy>\n" + lines(6_000, "<a>" + ACCESS.format("<topic>x@</topic>") + "</a>") + "</policy>",
    },
}


@pytest.mark.parametrize("name", sorted(MANY))
def test_much_of_it_does_not_take_long(trap: Trap, name: str) -> None:
    """It takes a second or two; what compares each with each would take minutes."""
    trap.timeout = 45
    for path, text in {**package("good"), "good/urdf/good.urdf": GOOD, **MANY[name]}.items():
        trap.write(path, text)
    outcome = trap.run("--profile=architecture")
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome, ("good/urdf/good.urdf", 2, "broken-robot-model"))
