# SPDX-License-Identifier: Apache-2.0
"""ROS 2 processes: nodes under their final names, remapping rules, what they are given from outside."""

from __future__ import annotations

from dataclasses import replace

import pytest
from follow_kit import (
    ROS2_CMAKE,
    ROS2_HEAD,
    ROS2_NODE,
    Nothing,
    cpp_files,
    ends,
    explicit,
    follow,
    main,
    names,
    only,
    ros2_files,
    ros2_main,
    workspace,
)

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
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
    cmake = (
        ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package(INSTALL_TO_SHARE launch)\n"
    )
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


def test_rules_among_the_programs_own_words_count() -> None:
    """rcl takes them, with a warning (rcl/arguments.c: a remap rule in its deprecated form)."""
    assert published(program(TWO, NODE_XML.format(' args="-r t:=u"', ""))) == {"/a": ["/u"], "/x/b": ["/x/u"]}
    assert published(program(TWO, NODE_XML.format(' args="-p t -f t=u"', "")))["/a"] == ["/t"]
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
        ('.arguments({"-r", "t:=u"})', "", {"/a": ["/u"]}),
        ('.arguments({"-p", "t=u"})', "", {"/a": ["/t"]}),
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


def parameter(found: Node, name: str = "a") -> tuple[object, object]:
    """A declared parameter's default and the value that it has."""
    (end,) = (end for end in explicit(found, "parameters") if end.name.endswith(f":{name}"))
    return end.value, end.effective


DECLARE = 'auto v = declare_parameter("a", "d");'
USE = DECLARE + PUB.format("v")


def from_yaml(text: str, attributes: str = ' name="n" namespace="/s"', more: str = "", body: str = USE) -> Node:
    """The node with a parameter file of that *text*, then *more*."""
    inner = f'<param from="$(find-pkg-share p)/launch/y.yaml"/>{more}'
    files = ros2_files(
        ROS2_HEAD + ROS2_NODE % (body, ""), {"l.launch.xml": NODE_XML.format(attributes, inner), "y.yaml": text}
    )
    return only(follow(files, 2)).nodes[0]


def section(key: str, value: str = "y") -> str:
    return f'{key}:\n  ros__parameters:\n    a: "{value}"\n'


@pytest.mark.parametrize(
    ("text", "expected"),
    (
        (section("n"), "d"),  # a key without a namespace is /n
        (section("/s/n"), "y"),
        (section('"/**"'), "y"),
        (section('"/*/n"'), "y"),
        (section('"/**/n"'), "y"),
        (section('"/s/*"'), "y"),
        (section('"/s/**"'), "y"),
        ("s:\n  n:\n    ros__parameters:\n      a: 'y'\n", "y"),
        ("/s:\n  n:\n    ros__parameters: {a: 'y'}\n", "y"),
        (section('"/*"'), "d"),
        (section('"/*/*/n"'), "d"),
        (section('"/*/other"'), "d"),
        (section("/other"), "d"),
        (section("/s"), "d"),
        (section("/s/nn"), "d"),
        (section('"/**"', "x") + section("/s/n"), "y"),
        (section("/s/n", "x") + section('"/**"'), "y"),  # of what matches the last counts, even a wildcard
        (section('"/**/n"', "x") + section('"/*/n"'), "y"),
        (section("/other", "x") + section('"/**"'), "y"),
        ("", "d"),
    ),
)
def test_sections_of_parameter_files(text: str, expected: str) -> None:
    found = from_yaml(text)
    assert parameter(found) == ("d", expected)
    assert names_of(found) == [f"/s/{expected}"]


@pytest.mark.parametrize(
    ("text", "more", "expected"),
    (
        (section("/s/n"), '<param name="a" value="z"/>', "z"),
        (section('"/**"'), '<param name="a" value="z"/>', "z"),
        (section('"/**"'), '<param name="b" value="z"/>', "y"),
    ),
)
def test_the_last_source_counts(text: str, more: str, expected: str) -> None:
    assert parameter(from_yaml(text, more=more))[1] == expected


def test_a_section_of_the_nodes_name_beats_a_parameter_without_one() -> None:
    """Where launch knows no full name, what it is given inline goes below the wildcard (launch_ros issues 154, 233)."""
    both = section('"/**"', "x") + section("/n")
    assert parameter(from_yaml(both, "", '<param name="a" value="z"/>'))[1] == "y"
    assert parameter(from_yaml(both.replace("/n", "/s/n"), more='<param name="a" value="z"/>'))[1] == "z"
    assert parameter(from_yaml(section("/n"), "", '<param name="a" value="z"/>'))[1] == "z"
    assert parameter(from_yaml(section('"/**"'), "", '<param name="a" value="z"/>'))[1] == "z"


@pytest.mark.parametrize(
    ("said", "expected"),
    (
        ("-p a:=z", "z"),
        ("-p n:a:=z", "z"),
        ("-p other:a:=z", "d"),
        ("-p b:=z", "d"),
        ("-p a:=x -p a:=z", "z"),
        ("-p 'a:=two words'", "two words"),
    ),
)
def test_parameters_of_the_command_line(said: str, expected: str) -> None:
    assert parameter(one(DECLARE, f' ros_args="{said}"')) == ("d", expected)


def test_what_launch_gives_comes_after_the_command_line() -> None:
    """launch_ros puts its own arguments behind those of ``args`` and ``ros_args``."""
    named = ' name="n" namespace="/s" ros_args="-p {}"'
    assert parameter(from_yaml(section('"/**"'), named.format("a:=z")))[1] == "y"
    assert parameter(from_yaml(section('"/**"'), named.format("b:=z")))[1] == "y"
    assert parameter(one(DECLARE, ' namespace="/s" ros_args="-p n:a:=z"'))[1] == "d"  # of /n, not of /s/n


@pytest.mark.parametrize(
    ("options", "said", "expected"),
    (
        ('.parameter_overrides({{"a", "o"}})', "-p a:=z", "o"),
        ('.append_parameter_override("a", "o")', "-p a:=z", "o"),
        ('.arguments({"--ros-args", "-p", "a:=o"})', "", "o"),
        ('.arguments({"--ros-args", "-p", "a:=o"})', "-p a:=z", "o"),
        ('.arguments({"--ros-args", "-p", "other:a:=o"})', "-p a:=z", "z"),
        ('.arguments({"--ros-args", "-p", "a:=o"}).parameter_overrides({{"a", "q"}})', "", "q"),
        (".use_global_arguments(false)", "-p a:=z", "d"),
        ('.use_global_arguments(false).parameter_overrides({{"a", "o"}})', "-p a:=z", "o"),
        (".allow_undeclared_parameters(true)", "-p a:=z", "z"),
        ('.parameter_overrides({{"b", "o"}})', "-p a:=z", "z"),
    ),
)
def test_parameters_in_options(options: str, said: str, expected: str) -> None:
    body = (
        f'auto a = std::make_shared<rclcpp::Node>("a", rclcpp::NodeOptions(){options});'
        'auto v = a->declare_parameter("a", "d"); auto p = a->create_publisher<String>(v, 1);'
    )
    (found,) = program(body, NODE_XML.format(f' ros_args="{said}"' if said else "", "")).nodes
    assert parameter(found) == ("d", expected)
    assert names_of(found) == [f"/{expected}"]


def unsure(found: Node) -> None:
    """What the parameter ``a`` is, is not told, nor the name that is made of it."""
    assert parameter(found)[1] is None
    assert "d" not in "".join(names_of(found)) and "z" not in "".join(names_of(found))
    assert all(any(u.field == "name" for u in end.unknowns) for end in explicit(found))


NO_FILE = '<param from="$(find-pkg-share elsewhere)/y.yaml"/>'


@pytest.mark.parametrize(
    ("attributes", "inner"),
    (
        ("", NO_FILE),
        (' name="n" namespace="/s"', NO_FILE),
        ("", '<param name="a" value="$(env NOT_SET)"/>'),
        ("", '<param name="a" value="$(command c)"/>'),
        ("", f'{NO_FILE}<param name="b" value="z"/>'),
        (' args="--ros-args --params-file /elsewhere/y.yaml"', ""),
        (' ros_args="--params-file /elsewhere/y.yaml"', ""),
        (' ros_args="-p a:=$(env NOT_SET)"', ""),
        (' ros_args="$(env NOT_SET)"', ""),
        (' args="--ros-args $(env NOT_SET)"', ""),
    ),
)
def test_values_that_are_not_known(attributes: str, inner: str) -> None:
    unsure(one(USE, attributes, inner))


@pytest.mark.parametrize("attributes", (' name="n" namespace="/s"', ' name="n"', ""))
@pytest.mark.parametrize("inner", (f'{NO_FILE}<param name="a" value="z"/>', f'<param name="a" value="z"/>{NO_FILE}'))
def test_what_a_launch_file_says_itself_is_known(attributes: str, inner: str) -> None:
    assert parameter(one(USE, attributes, inner))[1] == "z"


def test_a_file_that_is_not_read_may_override_one_that_is() -> None:
    assert parameter(from_yaml(section('"/**"'), more=NO_FILE))[1] is None
    assert parameter(from_yaml(section('"/**"')))[1] == "y"


def test_a_parameter_under_a_condition_is_not_certain() -> None:
    launch = '<launch><arg name="x"/><set_parameter name="a" value="z" if="$(var x)"/><node pkg="p" exec="n"/></launch>'
    (found,) = launched(USE, launch).nodes
    unsure(found)


@pytest.mark.parametrize(
    ("inner", "is_there", "value"),
    (
        ("", False, False),
        ('<param name="use_sim_time" value="true"/>', True, True),
        ('<param name="use_sim_time" value="false"/>', False, False),
    ),
)
def test_the_clock(inner: str, is_there: bool, value: bool) -> None:
    found = one("", "", inner)
    assert ("/clock" in names(found, "subscribers")) is is_there
    (sim,) = (end for end in ends(found, "parameters") if end.name == "/n:use_sim_time")
    assert (sim.value, sim.effective, sim.implicit, sim.unknowns) == (False, value, True, ())


@pytest.mark.parametrize(
    "inner", (NO_FILE, '<param name="use_sim_time" value="$(env NOT_SET)"/>'), ids=("file", "value")
)
def test_a_clock_that_is_not_certain(inner: str) -> None:
    found = one("", "", inner)
    (sim,) = (end for end in ends(found, "parameters") if end.name == "/n:use_sim_time")
    assert sim.effective is None and [each.field for each in sim.unknowns] == ["value"]
    assert all(end.unknowns for end in ends(found, "subscribers") if end.name == "/clock")


SERVICES = ["describe_parameters", "get_parameter_types", "get_parameters", "list_parameters", "set_parameters"]


def test_what_every_node_has() -> None:
    found = one("")
    assert names(found) == ["/parameter_events", "/rosout"]
    assert names(found, "servers") == [
        *(f"/n/{each}" for each in sorted([*SERVICES, "set_parameters_atomically", "get_type_description"])),
    ]
    assert all(end.implicit for end in found.endpoints)


@pytest.mark.parametrize(
    ("option", "gone"),
    (
        ("start_parameter_services(false)", "/n/set_parameters"),
        ("start_parameter_event_publisher(false)", "/parameter_events"),
        ("enable_rosout(false)", "/rosout"),
    ),
)
def test_what_options_switch_off(option: str, gone: str) -> None:
    found = ros2_main(f'auto a = std::make_shared<rclcpp::Node>("n", rclcpp::NodeOptions().{option});').nodes[0]
    assert gone not in {end.name for end in found.endpoints}
    other = ros2_main(
        f'auto a = std::make_shared<rclcpp::Node>("n", rclcpp::NodeOptions().{option.replace("false", "true")});'
    ).nodes[0]
    assert gone in {end.name for end in other.endpoints}


def test_implicit_endpoints_are_remapped() -> None:
    found = one("", "", '<remap from="/rosout" to="/log"/><remap from="~/get_parameters" to="/got"/>')
    assert names(found) == ["/log", "/parameter_events"]
    assert "/got" in names(found, "servers") and "/n/get_parameters" not in names(found, "servers")


MANAGED = (
    "#include <rclcpp_lifecycle/lifecycle_node.hpp>\nclass L : public rclcpp_lifecycle::LifecycleNode {\npublic:\n"
    'explicit L(const rclcpp::NodeOptions & o) : LifecycleNode("l", o) {}\n'
    "CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {\n"
    'p_ = create_publisher<String>("t", 1); return CallbackReturn::SUCCESS; }\n};\n'
)


def test_lifecycle_nodes() -> None:
    found = ros2_main("auto l = std::make_shared<L>(rclcpp::NodeOptions());", MANAGED).nodes[0]
    assert (found.name, found.kind, found.class_name) == ("/l", "lifecycle", "L")
    assert names_of(found) == ["/t"]
    assert "/l/change_state" in names(found, "servers") and "/l/transition_event" in names(found)


def test_a_component_in_a_container() -> None:
    found = by_name(
        launched(
            USE, CONTAINER.format(' name="m" namespace="/s"', '<remap from="z" to="y"/><param name="a" value="z"/>')
        )
    )
    assert sorted(found) == ["/c/box", "/s/m"]
    (node,), (box,) = found["/s/m"], found["/c/box"]
    assert (node.kind, node.container, node.process, node.class_name) == ("component", "/c/box", "/c/box", "N")
    assert names_of(node) == ["/s/y"] and parameter(node) == ("d", "z")
    assert box.process == "/c/box"


def test_a_component_without_a_name_keeps_its_own() -> None:
    found = by_name(launched(PUB.format('"t"'), CONTAINER.format("", "")))
    assert sorted(found) == ["/c/box", "/n"] and names_of(found["/n"][0]) == ["/t"]


def test_the_rules_of_a_component_are_not_for_other_nodes_of_its_code() -> None:
    body = (
        'auto o = std::make_shared<rclcpp::Node>("o", rclcpp::NodeOptions().use_global_arguments(false));'
        'auto q = o->create_publisher<String>("t", 1); auto w = o->declare_parameter("a", "d");' + PUB.format('"t"')
    )
    found = launched(body, CONTAINER.format(' name="m"', '<remap from="t" to="u"/><param name="a" value="z"/>'))
    assert published(found) == {"/c/box": [], "/m": ["/u"], "/o": ["/t"]}
    assert parameter(by_name(found)["/o"][0]) == ("d", "d")


def test_the_containers_rules_are_for_nodes_that_its_components_make_by_themselves() -> None:
    body = 'auto o = std::make_shared<rclcpp::Node>("o"); auto q = o->create_publisher<String>("t", 1);'
    found = launched(body, CONTAINER.format(' name="m"', ""))
    assert sorted(each.name for each in found.nodes) == ["/c/box", "/c/box", "/m"]


def test_the_node_of_a_transform_listener_keeps_its_name() -> None:
    body = "buffer_ = std::make_shared<tf2_ros::Buffer>(get_clock()); l_ = std::make_shared<tf2_ros::TransformListener>(*buffer_);"
    members = "std::shared_ptr<tf2_ros::Buffer> buffer_; std::shared_ptr<tf2_ros::TransformListener> l_;"
    found = launched(body, NODE_XML.format(' name="m" namespace="/s"', ""), members)
    (own, hidden) = sorted((each for each in found.nodes), key=lambda each: "listener" in each.name)
    assert own.name == "/s/m" and "transform_listener_impl" in hidden.name
    assert names_of(hidden, "subscribers") == ["/tf", "/tf_static"] and names_of(own, "subscribers") == []
    assert not [name for name in names(hidden, "servers") if name.endswith("_parameters")]


@pytest.mark.parametrize(
    ("code", "read_only", "limits"),
    (
        ("", False, None),
        ("d.read_only = true;", True, None),
        ("d.read_only = false;", False, None),
        ('d.description = "words";', False, None),
        ("d.read_only = outside();", None, None),
        (
            "rcl_interfaces::msg::FloatingPointRange r; r.from_value = 0.5; r.to_value = 2.0; r.step = 0.1;"
            "d.floating_point_range = {r};",
            False,
            (0.5, 2.0, 0.1),
        ),
        (
            "rcl_interfaces::msg::IntegerRange r; r.from_value = 1; r.to_value = 9; r.step = 1;"
            "d.integer_range = {r}; d.read_only = true;",
            True,
            (1.0, 9.0, 1.0),
        ),
    ),
)
def test_descriptors(code: str, read_only: bool | None, limits: object) -> None:
    value = "1" if "IntegerRange" in code else "1.0"
    found = one(f'rcl_interfaces::msg::ParameterDescriptor d; {code} declare_parameter("a", {value}, d);')
    (end,) = explicit(found, "parameters")
    assert (end.read_only, end.range) == (read_only, limits)


@pytest.mark.parametrize(
    ("name", "expected"),
    (("word()", "/?"), ('"a_" + word()', "/a_?"), ("std::string(argv[1])", "/?"), ('std::string("x")', "/x")),
)
def test_a_node_named_by_an_unknown(name: str, expected: str) -> None:
    body = (
        f"auto a = std::make_shared<rclcpp::Node>({name});"
        'auto p = a->create_publisher<String>("t", 1); auto q = a->create_publisher<String>("~/u", 1);'
    )
    (found,) = program(body, NODE_XML.format(' args="$(env NOT_SET)"', ""), "std::string word();\n").nodes
    assert (found.name, names_of(found)) == (expected, sorted(["/t", f"{expected}/u"]))
    assert ["name" in {u.field for u in found.unknowns}] == ["?" in expected]
    for end in explicit(found):
        assert ("name" in {u.field for u in end.unknowns}) == ("?" in end.name)
    assert program(body, NODE_XML.format(' name="m"', ""), "std::string word();\n").nodes[0].name == "/m"


def test_node_types_that_nothing_starts() -> None:
    files = ros2_files(ROS2_HEAD + ROS2_NODE % (PUB.format('"t"'), ""))
    (found,) = follow(files, 2).configurations
    assert (found.name, [each.name for each in found.nodes]) == ("p/n", ["/n"])
    files["p/CMakeLists.txt"] = files["p/CMakeLists.txt"].replace(
        'rclcpp_components_register_node(n_lib PLUGIN "N" EXECUTABLE n)', 'rclcpp_components_register_nodes(n_lib "N")'
    )
    (found,) = follow(files, 2).configurations
    assert (found.name, found.nodes[0].kind, found.nodes[0].class_name) == ("p/N", "component", "N")
    files["p/launch/l.launch.xml"] = CONTAINER.format("", "")
    assert [each.name for each in follow(files, 2).configurations] == ["p/launch/l.launch.xml"]


def test_two_equal_nodes() -> None:
    body = (
        'auto a = std::make_shared<rclcpp::Node>("a"); auto b = std::make_shared<rclcpp::Node>("a");'
        'auto p = a->create_publisher<String>("t", 1); auto q = b->create_publisher<String>("u", 1);'
    )
    found = ros2_main(body)
    assert sorted(name for each in found.nodes for name in names_of(each)) == ["/t", "/u"]
    launch = '<launch><node pkg="p" exec="n"/><node pkg="p" exec="n"/></launch>'
    twice = launched(PUB.format('"t"'), launch)
    assert [(each.name, names_of(each)) for each in twice.nodes] == [("/n", ["/t"]), ("/n", ["/t"])]


def test_a_node_made_in_a_loop_or_on_two_ways_is_told_once() -> None:
    body = 'for (int i = 0; i < count(); i++) { nodes.push_back(std::make_shared<rclcpp::Node>("a")); }'
    assert [
        each.name for each in ros2_main(body, "int count();\nstd::vector<rclcpp::Node::SharedPtr> nodes;\n").nodes
    ] == ["/a"]


def test_values_that_compare_equal_are_kept_apart() -> None:
    """``1`` and ``True`` are one in Python; two nodes that are given them are not the same."""
    launch = "<launch>%s</launch>" % "".join(
        f'<node pkg="p" exec="n" name="{name}"><param name="a" value="{value}"/></node>'
        for name, value in (("x", "1"), ("x", "true"), ("x", "1.0"))
    )
    found = launched('auto v = declare_parameter("a", rclcpp::ParameterValue());', launch)
    assert [repr(parameter(each)[1]) for each in found.nodes] == ["1", "True", "1.0"]


CALLBACK = (
    'std::string topic_ = "t";\nrcl_interfaces::msg::SetParametersResult on_set('
    "const std::vector<rclcpp::Parameter> & ps) {\nfor (const auto & p : ps) {\n"
    'if (p.get_name() == "a") { topic_ = p.as_string(); }\n}\nreturn rcl_interfaces::msg::SetParametersResult();\n}\n'
)


def test_callbacks_of_parameters_do_not_disturb_names() -> None:
    body = (
        'topic_ = declare_parameter("a", "t"); h_ = add_on_set_parameters_callback('
        "std::bind(&N::on_set, this, std::placeholders::_1)); timer_ = create_wall_timer(1s, [this]() {"
        + PUB.format("topic_")
        + "});"
    )
    found = one(body, members=CALLBACK)
    assert [(end.name, end.unknowns) for end in explicit(found)] == [("/t", ())]


WRAPPER = (
    "class B : public rclcpp::Node {\npublic:\nusing rclcpp::Node::Node;\n"
    "template <class T> auto create_publisher(const std::string & name, int depth) {\n"
    "return rclcpp::Node::create_publisher<T>(name, rclcpp::QoS(depth));\n}\n"
    "void add(const std::string & name) { p_ = rclcpp::Node::create_publisher<String>(name, 1); }\n};\n"
)


def test_what_a_wrapper_makes_stands_at_the_outer_call() -> None:
    found = ros2_main('B b("b");\nauto p = b.create_publisher<String>("t", 3);\nb.add("u");', WRAPPER).nodes[0]
    places = {end.name: end.location.line if end.location else None for end in explicit(found)}
    text = (ROS2_HEAD + WRAPPER).count("\n")
    assert places["/t"] == text + 5
    assert places["/u"] == (ROS2_HEAD + WRAPPER[: WRAPPER.index("void add")]).count("\n") + 1
    assert [end.qos.depth for end in explicit(found) if end.qos and end.name == "/t"] == [3]


def test_mixed_workspaces() -> None:
    older = {
        path.replace("p/", "old/", 1): text.replace("project(p)", "project(old)")
        for path, text in cpp_files(
            main('auto p = ADV("t", 1);'), '<launch><node pkg="old" type="n" name="o"/></launch>'
        ).items()
    }
    newer = ros2_files(
        ROS2_HEAD + ROS2_NODE % (PUB.format('"t"'), ""), {"l.launch.xml": NODE_XML.format(' name="m"', "")}
    )
    both = workspace({**older, **newer})
    packages = tuple(replace(each, ros=1 if each.name == "old" else 2) for each in both.packages)
    settings = Settings(root=both.root)
    found = architecture(replace(both, packages=packages), settings, Nothing(), environment={}, known_nodes=False)
    assert [(each.name, [(n.name, n.ros) for n in each.nodes]) for each in found.configurations] == [
        ("old/launch/l.launch", [("/o", 1)]),
        ("p/launch/l.launch.xml", [("/m", 2)]),
    ]
    assert names_of(found.configurations[0].nodes[0]) == ["/t"] and names_of(found.configurations[1].nodes[0]) == ["/t"]


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        ('auto n = std::make_shared<rclcpp::Node>("two");', ["/two/x"]),
        ('auto n = rclcpp::Node::make_shared("two");', ["/two/x"]),
        ('auto n = std::make_unique<rclcpp::Node>("two");', ["/two/x"]),
        ("auto n = std::make_shared<M>();", ["/m/x"]),
        ("auto n = std::make_shared<G>();", ["/inner/x"]),  # a method of its own
    ],
)
def test_the_pointer_in_a_variable_without_a_type(made: str, expected: list[str]) -> None:
    classes = (
        'struct M : rclcpp::Node { M() : Node("m") {} };\n'
        'struct G { rclcpp::Node::SharedPtr get() { return std::make_shared<rclcpp::Node>("inner"); } };\n'
    )
    found = ros2_main(f'{made} auto p = n.get()->create_publisher<String>("~/x", 1);', classes)
    if "G" in made:
        found = ros2_main(f'{made} auto p = n->get()->create_publisher<String>("~/x", 1);', classes)
    assert [end.name for node in found.nodes for end in explicit(node)] == expected
