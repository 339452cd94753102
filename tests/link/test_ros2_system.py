# SPDX-License-Identifier: Apache-2.0
"""ROS 2 processes: nodes under their final names, remapping rules, what they are given from outside."""

from __future__ import annotations

import pytest
from follow_kit import (
    CMAKE,
    CPP_MAIN,
    ROS2_CMAKE,
    ROS2_HEAD,
    ROS2_NODE,
    cpp_files,
    ends,
    explicit,
    follow,
    main,
    names,
    only,
    ros2_cpp,
    ros2_files,
    ros2_main,
    workspace,
)

from haros_ci.model.architecture import Configuration, Node

PUB = "auto p = create_publisher<String>({}, 1);"
NODE_XML = '<launch><node pkg="p" exec="n"{}>{}</node></launch>'
CONTAINER = (
    '<launch><node_container pkg="rclcpp_components" exec="component_container" name="box" namespace="/c">'
    '<composable_node pkg="p" plugin="N"{}>{}</composable_node></node_container></launch>'
)


def by_name(found: Configuration) -> dict[str, list[Node]]:
    every: dict[str, list[Node]] = {}
    for each in found.nodes:
        every.setdefault(each.name, []).append(each)
    return every


def published(found: Configuration, kind: str = "publishers") -> dict[str, list[str]]:
    """The names of what the code makes, by node."""
    return {each.name: sorted(end.name for end in explicit(each, kind)) for each in found.nodes}


def launched(body: str, launch: str, members: str = "", **files: str) -> Configuration:
    """The configuration of an XML launch file that starts the component ``N`` with *body* in its constructor."""
    return only(follow(ros2_files(ROS2_HEAD + ROS2_NODE % (body, members), {"l.launch.xml": launch}, **files), 2))


def one(body: str, attributes: str = "", inner: str = "", members: str = "") -> Node:
    """The only node of a launch file with one ``node`` tag."""
    found = launched(body, NODE_XML.format(attributes, inner), members)
    assert len(found.nodes) == 1, [each.name for each in found.nodes]
    return found.nodes[0]


def program(body: str, launch: str, before: str = "") -> Configuration:
    """The configuration of an XML launch file that starts a program with *body* in ``main``."""
    text = f"{ROS2_HEAD}{before}\nint main(int argc, char ** argv) {{\nrclcpp::init(argc, argv);\n{body}\n}}\n"
    cmake = ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package(INSTALL_TO_SHARE launch)\n"
    return only(follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": text, "p/launch/l.launch.xml": launch}, 2))


TWO = (
    'auto a = std::make_shared<rclcpp::Node>("a"); auto b = std::make_shared<rclcpp::Node>("b", "/x");'
    'auto p = a->create_publisher<String>("t", 1); auto q = b->create_publisher<String>("t", 1);'
)


def test_several_nodes_in_one_process() -> None:
    found = ros2_main(TWO)
    assert published(found) == {"/a": ["/t"], "/x/b": ["/x/t"]}
    assert {each.process for each in found.nodes} == {"/a"}


def test_a_name_from_launch_renames_every_node_of_the_process() -> None:
    found = program(TWO, NODE_XML.format(' name="m" namespace="/s"', ""))
    assert [each.name for each in found.nodes] == ["/s/m"]
    assert [end.name for end in explicit(found.nodes[0])] == ["/s/t", "/s/t"]


@pytest.mark.parametrize(
    ("said", "expected"),
    (
        ("", {"/a": ["/t"], "/x/b": ["/x/t"]}),
        ("-r __ns:=/s", {"/s/a": ["/s/t"], "/s/b": ["/s/t"]}),
        ("-r a:__node:=c", {"/c": ["/t"], "/x/b": ["/x/t"]}),
        ("-r b:__name:=c", {"/a": ["/t"], "/x/c": ["/x/t"]}),
        ("-r a:__node:=c -r c:__ns:=/s", {"/s/c": ["/s/t"], "/x/b": ["/x/t"]}),  # rcl looks the new name's rules up
        ("-r a:__node:=c -r a:__ns:=/s", {"/c": ["/t"], "/x/b": ["/x/t"]}),
        ("-r b:__ns:=/s", {"/a": ["/t"], "/s/b": ["/s/t"]}),
        ("-r t:=u", {"/a": ["/u"], "/x/b": ["/x/u"]}),
        ("-r t:=/u", {"/a": ["/u"], "/x/b": ["/u"]}),
        ("-r /t:=/u", {"/a": ["/u"], "/x/b": ["/x/t"]}),
        ("-r b:t:=u", {"/a": ["/t"], "/x/b": ["/x/u"]}),
        ("-r other:t:=u", {"/a": ["/t"], "/x/b": ["/x/t"]}),
        ("-r t:=u -r t:=v", {"/a": ["/u"], "/x/b": ["/x/u"]}),
        ("-r t:=u -r u:=v", {"/a": ["/u"], "/x/b": ["/x/u"]}),
        ("-r a:__node:=c -r c:t:=u", {"/c": ["/u"], "/x/b": ["/x/t"]}),
        ("-r a:__node:=c -r a:t:=u", {"/c": ["/t"], "/x/b": ["/x/t"]}),
        ("-r rostopic://t:=u", {"/a": ["/u"], "/x/b": ["/x/u"]}),
        ("-r a:rostopic://t:=u", {"/a": ["/u"], "/x/b": ["/x/t"]}),
        ("-r rosservice://t:=u", {"/a": ["/t"], "/x/b": ["/x/t"]}),
        ("-r t:={node}/t", {"/a": ["/a/t"], "/x/b": ["/x/b/t"]}),
        ("-r t:=~/t", {"/a": ["/a/t"], "/x/b": ["/x/b/t"]}),
        ("-r t", {"/a": ["/t"], "/x/b": ["/x/t"]}),
        ("--remap t:=u --", {"/a": ["/u"], "/x/b": ["/x/u"]}),
        ("--log-level debug -r t:=u", {"/a": ["/u"], "/x/b": ["/x/u"]}),
        ("--disable-stdout-logs -r t:=u", {"/a": ["/u"], "/x/b": ["/x/u"]}),
        ("-p t:=u", {"/a": ["/t"], "/x/b": ["/x/t"]}),
    ),
)
def test_rules_of_the_command_line(said: str, expected: dict[str, list[str]]) -> None:
    launch = NODE_XML.format(f' ros_args="{said}"', "") if said else NODE_XML.format("", "")
    assert published(program(TWO, launch)) == expected
    if said:
        assert published(program(TWO, NODE_XML.format(f' args="--ros-args {said}"', ""))) == expected


def test_words_before_ros_args_are_the_programs_own() -> None:
    assert published(program(TWO, NODE_XML.format(' args="-r t:=u"', ""))) == {"/a": ["/t"], "/x/b": ["/x/t"]}
    assert published(program(TWO, NODE_XML.format(' args="--ros-args -r t:=u -- -r x:=y"', "")))["/a"] == ["/u"]


@pytest.mark.parametrize(
    ("call", "kind", "rule", "expected"),
    (
        ('create_service<S>("t", f)', "servers", "t:=u", "/u"),
        ('create_service<S>("t", f)', "servers", "rosservice://t:=u", "/u"),
        ('create_service<S>("t", f)', "servers", "rostopic://t:=u", "/t"),
        ('create_client<S>("t")', "clients", "rosservice://t:=u", "/u"),
        ('create_client<S>("t")', "clients", "rostopic://t:=u", "/t"),
        ('create_client<S>("t")', "clients", "rostopic://t:=u -r t:=v", "/v"),
        ('create_subscription<String>("t", 1, f)', "subscribers", "rosservice://t:=u", "/t"),
        ('create_subscription<String>("t", 1, f)', "subscribers", "rostopic://t:=u", "/u"),
        ('create_subscription<String>("t", 1, f)', "subscribers", "rosservice://t:=u -r t:=v", "/v"),
    ),
)
def test_rules_for_topics_or_services_alone(call: str, kind: str, rule: str, expected: str) -> None:
    before = "#include <std_srvs/srv/empty.hpp>\nusing S = std_srvs::srv::Empty;\nvoid f();\n"
    body = f'auto a = std::make_shared<rclcpp::Node>("a"); auto e = a->{call};'
    found = program(body, NODE_XML.format(f' ros_args="-r {rule}"', ""), before)
    assert published(found, kind) == {"/a": [expected]}


@pytest.mark.parametrize(
    ("options", "said", "expected"),
    (
        ('.arguments({"--ros-args", "-r", "t:=u"})', "", {"/a": ["/u"]}),
        ('.arguments({"--ros-args", "-r", "t:=u"})', "-r t:=v", {"/a": ["/u"]}),
        ('.arguments({"--ros-args", "-r", "__node:=c"})', "-r __node:=d", {"/c": ["/t"]}),
        ('.arguments({"--ros-args", "-r", "__ns:=/s"})', "-r __node:=d", {"/s/d": ["/s/t"]}),
        (".use_global_arguments(false)", "-r t:=v -r __node:=d", {"/a": ["/t"]}),
        (".use_global_arguments(true)", "-r t:=v -r __node:=d", {"/d": ["/v"]}),
        ('.use_global_arguments(false).arguments({"--ros-args", "-r", "t:=u"})', "-r t:=v", {"/a": ["/u"]}),
        ('.arguments({"-r", "t:=u"})', "", {"/a": ["/t"]}),
        ('.arguments({"--ros-args", "-r", "other:t:=u"})', "-r t:=v", {"/a": ["/v"]}),
        (".allow_undeclared_parameters(true)", "", {"/a": ["/t"]}),
    ),
)
def test_options_of_a_node(options: str, said: str, expected: dict[str, list[str]]) -> None:
    body = (
        f'auto a = std::make_shared<rclcpp::Node>("a", rclcpp::NodeOptions(){options});'
        'auto p = a->create_publisher<String>("t", 1);'
    )
    assert published(program(body, NODE_XML.format(f' ros_args="{said}"' if said else "", ""))) == expected


def test_options_whose_arguments_are_not_known_leave_the_name_open() -> None:
    found = ros2_main(
        "auto o = rclcpp::NodeOptions(); o.arguments(words());"
        'auto a = std::make_shared<rclcpp::Node>("a", o); auto p = a->create_publisher<String>("t", 1);',
        "std::vector<std::string> words();\n",
    )
    (node,) = found.nodes
    assert "?" in node.name and any(each.field == "name" for each in node.unknowns)
    (end,) = explicit(node)
    assert any(each.field == "name" for each in end.unknowns)


@pytest.mark.parametrize(
    ("name", "expected"),
    (
        ('"t"', "/s/t"),
        ('"/t"', "/t"),
        ('"~/t"', "/s/n/t"),
        ('"t/u"', "/s/t/u"),
        ('"{node}/t"', "/s/n/t"),
        ('"/{node}/t"', "/n/t"),
        ('"{ns}/t"', "/s/t"),
        ('"{namespace}/t"', "/s/t"),
        ("get_name()", "/s/n"),
        ("get_namespace()", "/s"),
        ("get_fully_qualified_name()", "/s/n"),
        ('std::string(get_name()) + "/t"', "/s/n/t"),
    ),
)
def test_names_are_expanded_for_the_final_node(name: str, expected: str) -> None:
    assert names_of(one(PUB.format(name), ' namespace="/s"')) == [expected]


def names_of(found: Node, kind: str = "publishers") -> list[str]:
    return sorted(end.name for end in explicit(found, kind))


def test_sub_nodes() -> None:
    found = ros2_main(
        'auto a = std::make_shared<rclcpp::Node>("a", "/x"); auto s = a->create_sub_node("s");'
        'auto u = s->create_sub_node("u"); auto p = s->create_publisher<String>("t", 1);'
        'auto q = u->create_publisher<String>("t", 1); auto r = s->create_publisher<String>("~/t", 1);'
        'auto o = s->create_publisher<String>("/t", 1);'
    )
    assert published(found) == {"/x/a": ["/t", "/x/a/t", "/x/s/t", "/x/s/u/t"]}
