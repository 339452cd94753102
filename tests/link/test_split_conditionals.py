# SPDX-License-Identifier: Apache-2.0
"""Conditionals that split a statement or braces, of which one branch is parsed: what stands in it is there where that is compiled."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, explicit, follow, main, node, ros2_cpp

from haros_ci.model.architecture import Endpoint


def made(body: str, definition: str = "") -> list[str]:
    """The publishers of a program with this in ``main``; ``!`` for what is ruled out, ``#`` for what stands under an ``#if``."""
    files = cpp_files(main(body))
    files["p/CMakeLists.txt"] += f"target_compile_definitions(n PRIVATE {definition})\n" if definition else ""
    return sorted(map(_view, (end for end in node(follow(files)).endpoints if end.kind == "publishers")))


def _view(end: Endpoint) -> str:
    under = "#" if any(condition.statement == "#if" for condition in end.conditions) else ""
    return end.name + under + ("!" if end.is_ruled_out else "")


ELSE = 'bool x = true;\n#ifdef A\nif (x) {\n  ADV("then", 1);\n} else\n#endif\n{\n  ADV("else", 1);\n}\n'
OPENED = '#ifdef A\nADV("own", 1);\nif (p()) {\n#else\nif (q()) {\n#endif\n  ADV("both", 1);\n}\nADV("end", 1);\n'
NAME = 'std::string s =\n#ifdef A\n"a"\n#else\n"b"\n#endif\n;\nADV(s, 1);\n'
ARGUMENT = 'ADV(\n#ifdef A\n"a"\n#else\n"b"\n#endif\n, 1);\n'
FURTHER = 'if (p()) ADV("one", 1);\n#ifdef A\nelse if (q()) { ADV("two", 1); }\n#endif\nelse { ADV("three", 1); }\n'
LONGER = 'std::string s = "a"\n#ifdef A\n"b"\n#endif\n;\nADV(s, 1);\n'
LAST = 'ADV("a", 1\n#ifdef A\n, true\n#endif\n);\n'
HEAD = '#ifdef A\nif (p())\n#endif\nADV("own", 1);\n'


@pytest.mark.parametrize(
    ("body", "definition", "expected"),
    [
        (ELSE, "", ["/else#", "/then#"]),
        (ELSE, "A", ["/else!", "/then#"]),
        (OPENED, "", ["/both", "/end", "/own#"]),
        (OPENED, "A", ["/both", "/end", "/own#"]),
        (NAME, "", ["/?"]),
        (NAME.replace('"b"', '"a"'), "", ["/a"]),
        (NAME, "A", ["/a"]),
        (ARGUMENT, "", ["/?"]),
        (ARGUMENT.replace('"b"', '"a"'), "", ["/a"]),
        (ARGUMENT.replace("#else", "#elif B"), "", ["/?"]),
        (ARGUMENT.replace('"b"', ""), "", ["/?"]),
        (ARGUMENT.replace('"b"', '"b", 1'), "", ["/?"]),
        (ARGUMENT.replace("#else\n", ""), "", ["/?"]),
        (ARGUMENT.replace('"b"', "f()"), "", ["/?"]),
        (ARGUMENT, "A", ["/a"]),
        (FURTHER, "", ["/one", "/three", "/two#"]),
        # what goes on in one with what is before it
        (LONGER, "", ["/?"]),
        (LONGER, "A", ["/ab"]),
        (LONGER.replace("#ifdef A", "#if 0"), "", ["/a"]),
        (LONGER.replace('"b"', "+ std::to_string(1)").replace('"a"', 'std::string("a")'), "A", ["/a1"]),
        (LAST, "", ["/a"]),
        (HEAD, "", ["/own"]),
        (HEAD, "A", ["/own#"]),
        (HEAD.replace("#ifdef A", "#if 0"), "", ["/own"]),
        # what does not stand in one
        (
            '#ifdef A\nADV("a", 1);\n#else\nADV("b", 1);\n#endif\n' + OPENED,
            "A",
            ["/a#", "/b#!", "/both", "/end", "/own#"],
        ),
        (OPENED.replace("#ifdef A", "#if 1"), "", ["/both", "/end", "/own#"]),
        ('if (p()) { ADV("a", 1); } else { ADV("b", 1); }\n' + NAME, "A", ["/a", "/a", "/b"]),
        (NAME.replace("#ifdef A", "#if 0"), "", ["/b"]),
    ],
)
def test_the_branch_that_is_parsed(body: str, definition: str, expected: list[str]) -> None:
    assert made(body, definition) == expected


#: An argument of a call that makes an image's publisher, under ``#ifdef A`` and under ``#else``, and the topic of the node ``/n``.
NODES = (("*this,", "this,", "/image"), ("this,", "*this,", "/image"), ("*this,", "elsewhere(),", "/image|/?/image"))


@pytest.mark.parametrize(("own", "other", "name"), NODES)
def test_a_node_that_both_branches_give(own: str, other: str, name: str) -> None:
    call = f"image_transport::create_publisher(\n#ifdef A\n{own}\n#else\n{other}\n#endif\n{{}});"
    head = "#include <image_transport/image_transport.hpp>\n"
    (end,) = explicit(ros2_cpp(call.format('"image", rclcpp::QoS(3)'), "", head).nodes[0])
    assert end.name in name.split("|") and end.qos is not None and end.qos.depth == 3


#: What one branch and the other one give as a quality of service, and what both have.
QUALITIES = (
    ("rclcpp::QoS(5)", "5", 5, "reliable"),
    ("rclcpp::SensorDataQoS()", "rclcpp::QoS(5)", 5, "?"),
    (
        "rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(rmw_qos_profile_sensor_data),\n rmw_qos_profile_sensor_data)",
        "rmw_qos_profile_sensor_data",
        5,
        "best_effort",
    ),
    ("rclcpp::QoS(1), options", "rclcpp::QoS(1)", "?", "?"),
)


@pytest.mark.parametrize(("own", "other", "depth", "reliability"), QUALITIES)
def test_what_both_branches_give_is_known(own: str, other: str, depth: object, reliability: str) -> None:
    found = ros2_cpp(f'create_publisher<String>("a",\n#ifdef A\n{own}\n#else\n{other}\n#endif\n);')
    (end,) = explicit(found.nodes[0])
    assert end.qos is not None and (end.qos.depth, end.qos.reliability) == (depth, reliability)


def test_what_is_called_is_called_by_the_name_that_is_read() -> None:
    body = 'ros::Publisher p =\n#ifdef A\nnh.advertise<std_msgs::String>(\n#else\nadvertise(\n#endif\n"a", 1);\n'
    assert [name.strip("#") for name in made(body)] == ["/a"]


NESTED = """#ifdef A
if (p()) {
#ifdef B
  if (q(1)) {
#else
  if (r(1)) {
#endif
    ADV("inner", 1);
  }
#else
if (s()) {
#endif
  ADV("outer", 1);
}
"""


def test_one_inside_of_another() -> None:
    assert made(NESTED) == ["/inner#", "/outer"]


def test_an_argument_that_may_be_there() -> None:
    """Name, type and size are known, and whether it is latched is not."""
    (end,) = (end for end in node(follow(cpp_files(main(LAST)))).endpoints if end.kind == "publishers")
    assert (end.name, end.queue_size) == ("/a", 1)
    assert [unknown.field for unknown in end.unknowns] == ["latched"]
