# SPDX-License-Identifier: Apache-2.0
"""Whole systems: launch files start nodes of several packages, each with its own names, parameters and remappings."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from follow_kit import (
    CMAKE,
    CPP_HEAD,
    PYTHON_HEAD,
    Nothing,
    cpp_files,
    ends,
    follow,
    main,
    names,
    node,
    only,
    python_files,
    types,
    workspace,
)

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture, Node
from haros_ci.model.location import Location

TALKER = (
    CPP_HEAD
    + """
class Talker {
  ros::NodeHandle nh_, pnh_;
  ros::Publisher pub_;
  ros::Timer timer_;
public:
  Talker() : pnh_("~") {
    std::string topic;
    int queue;
    pnh_.param<std::string>("topic", topic, "chatter");
    pnh_.param("queue", queue, 10);
    pub_ = nh_.advertise<std_msgs::String>(topic, queue);
    timer_ = nh_.createTimer(ros::Duration(1), &Talker::tick, this);
  }
  void tick(const ros::TimerEvent&) { std_msgs::String m; pub_.publish(m); }
};
int main(int argc, char** argv) { ros::init(argc, argv, "talker"); Talker t; ros::spin(); }
"""
)
LISTENER = (
    PYTHON_HEAD
    + """
def heard(m):
    rospy.loginfo(m.data)

def main():
    rospy.init_node("listener")
    rospy.Subscriber("chatter", String, heard, queue_size=rospy.get_param("~queue", 5))
    rospy.spin()

if __name__ == "__main__":
    main()
"""
)
FILES = {
    "a/CMakeLists.txt": CMAKE.format("a") + "add_executable(talker src/talker.cpp)\n",
    "a/src/talker.cpp": TALKER,
    "b/CMakeLists.txt": CMAKE.format("b") + "catkin_install_python(PROGRAMS scripts/listener.py)\n",
    "b/scripts/listener.py": LISTENER,
}


def started(launch: str, **others: str) -> Architecture:
    more = {f"b/launch/{name}.launch": text for name, text in others.items()}
    return follow(FILES | {"b/launch/all.launch": f"<launch>{launch}</launch>"} | more)


def by_name(found: Architecture) -> dict[str, Node]:
    return {each.name: each for each in only(found).nodes}


def test_node_types_that_nothing_starts_are_alone() -> None:
    found = follow(FILES)
    assert [c.name for c in found.configurations] == ["a/talker", "b/listener.py"]
    talker, listener = (c.nodes[0] for c in found.configurations)
    assert (talker.name, listener.name) == ("/talker", "/listener")
    assert types(talker) == [("/chatter", "std_msgs/String")]
    assert types(listener, "subscribers") == [("/chatter", "std_msgs/String")]
    assert [e.queue_size for e in ends(talker)] == [10]
    assert [e.queue_size for e in ends(listener, "subscribers")] == [5]


def test_a_node_type_that_a_launch_file_starts_is_not_alone() -> None:
    found = started('<node pkg="a" type="talker" name="t"/>')
    assert [c.name for c in found.configurations] == ["b/launch/all.launch", "b/listener.py"]


def test_two_nodes_of_one_type_have_their_own_parameters() -> None:
    found = started(
        '<node pkg="a" type="talker" name="one"><param name="topic" value="x"/></node>'
        '<node pkg="a" type="talker" name="two"><param name="queue" value="3"/></node>'
        '<node pkg="b" type="listener.py" name="l"><remap from="chatter" to="x"/></node>'
    )
    nodes = by_name(found)
    assert {name: names(each) for name, each in nodes.items()} == {"/one": ["/x"], "/two": ["/chatter"], "/l": []}
    assert [e.queue_size for e in ends(nodes["/two"])] == [3]
    (heard,) = ends(nodes["/l"], "subscribers")
    assert (heard.name, heard.original_name) == ("/x", "/chatter")


def test_namespaces_of_groups_and_includes() -> None:
    found = started(
        (
            '<group ns="g"><include file="$(find b)/launch/part.launch" ns="h"><arg name="t" '
            'value="y"/></include></group>'
        ),
        part=(
            '<launch><arg name="t" default="x"/><node pkg="a" type="talker" name="t"><param '
            'name="topic" value="$(arg t)"/></node></launch>'
        ),
    )
    (talker,) = found.configurations[0].nodes
    assert (talker.name, names(talker)) == ("/g/h/t", ["/g/h/y"])
    assert names(talker, "getters") == ["/g/h/t/queue", "/g/h/t/topic"]


def test_a_remapping_of_a_group_reaches_its_nodes_only() -> None:
    found = started(
        '<group><remap from="chatter" to="quiet"/><node pkg="a" type="talker" name="one"/></group>'
        '<node pkg="a" type="talker" name="two"/>'
    )
    assert {name: names(each) for name, each in by_name_of_first(found).items()} == {
        "/one": ["/quiet"],
        "/two": ["/chatter"],
    }


def by_name_of_first(found: Architecture) -> dict[str, Node]:
    return {each.name: each for each in found.configurations[0].nodes}


def test_a_node_under_a_condition_that_is_not_known_has_it() -> None:
    found = started('<node pkg="a" type="talker" name="t" if="$(env SIM)"/>')
    (talker,) = found.configurations[0].nodes
    assert [c.statement for c in talker.conditions] == ["if"]
    assert names(talker) == ["/chatter"]


def test_a_parameter_under_a_condition_leaves_the_name_open() -> None:
    found = started('<node pkg="a" type="talker" name="t"><param name="topic" value="x" if="$(env SIM)"/></node>')
    assert names(found.configurations[0].nodes[0]) == ["/?"]


def test_a_node_that_is_not_of_the_workspace_is_there_without_endpoints() -> None:
    (rviz,) = started('<node pkg="rviz" type="rviz" name="r"/>').configurations[0].nodes
    assert (rviz.name, rviz.package, rviz.type, rviz.endpoints) == ("/r", "rviz", "rviz", ())


NO_PROGRAM = "package a is in the workspace, but no C++ or Python program called"


@pytest.mark.parametrize(
    ("attributes", "reason"),
    [
        ('pkg="x" type="n"', "the code of x/n is not in the workspace"),
        ('pkg="$(env X)" type="n"', "which program it is, is not known"),
        ('pkg="a" type="gone"', f"{NO_PROGRAM} gone was found in it"),
        ('pkg="a" type="empty"', "no main function was found in the sources of a/empty (a/CMakeLists.txt:6)"),
        ('pkg="a" type="run.sh"', f"{NO_PROGRAM} run.sh was found in it"),
        (
            'pkg="nodelet" type="nodelet" args="load a/Gone m"',
            "the class a::Gone of the nodelet a/Gone was not found in the workspace",
        ),
        ('pkg="nodelet" type="nodelet" args="load x/Gone m"', "the code of x/Gone is not in the workspace"),
        (
            'pkg="nodelet" type="nodelet" args="load a/Else m"',
            "no plug-in description of the workspace names the nodelet a/Else",
        ),
    ],
)
def test_why_a_node_cannot_be_followed(attributes: str, reason: str) -> None:
    cmake = "add_executable(empty src/empty.cpp)\n"
    found = follow(
        {
            "a/CMakeLists.txt": FILES["a/CMakeLists.txt"] + cmake,
            "a/package.xml": '<package><name>a</name><export><nodelet plugin="${prefix}/p.xml"/></export></package>',
            "a/p.xml": '<library path="x"><class name="a/Gone" type="a::Gone" base_class_type="nodelet::Nodelet"/></library>',
            "a/src/empty.cpp": "int other() {}",
            "a/launch/l.launch": f'<launch><node name="t" {attributes}/></launch>',
        }
    )
    assert [unknown.reason for unknown in only(found).nodes[0].unknowns if unknown.field == "endpoints"] == [reason]


def test_a_node_that_is_built_for_tests_is_followed_where_it_is_started() -> None:
    cmake = CMAKE.format("a") + "if(CATKIN_ENABLE_TESTING)\nadd_executable(talker src/talker.cpp)\nendif()\n"
    alone = {"a/CMakeLists.txt": cmake, "a/src/talker.cpp": TALKER}
    assert follow(alone).configurations == ()
    launch = '<launch><node pkg="a" type="talker" name="t"/></launch>'
    found = node(follow(alone | {"a/launch/l.launch": launch}))
    assert (names(found), found.unknowns) == (["/chatter"], ())


LINKS = (("a/all.launch", "b/launch/all.launch"), ("a/bin/hear", "b/scripts/listener.py"), ("a/more", "b/launch"))


@pytest.mark.parametrize(
    ("launch", "expected"),
    [
        ('<include file="$(find a)/all.launch"/>', ["b/listener.py"]),
        ('<include file="$(find a)/more/all.launch"/>', ["b/listener.py"]),
        ('<node pkg="a" type="hear" name="h"/>', ["a/hear"]),
        ('<node pkg="b" type="listener.py" name="h"/>', ["b/listener.py"]),
        ('<include file="$(find a)/less/all.launch"/>', []),
        ('<include file="$(find a)/loop/all.launch"/>', []),
    ],
)
def test_what_links_lead_to(launch: str, expected: list[str]) -> None:
    files = {
        "b/CMakeLists.txt": FILES["b/CMakeLists.txt"],
        "b/scripts/listener.py": LISTENER,
        "b/launch/all.launch": '<launch><node pkg="b" type="listener.py" name="l"/></launch>',
        "a/CMakeLists.txt": CMAKE.format("a"),
        "a/launch/top.launch": f"<launch>{launch}</launch>",
    }
    made = replace(workspace(files), links=(*LINKS, ("a/loop", "a/loop/again")))
    found = architecture(made, Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=False)
    (top,) = (each for each in found.configurations if each.name == "a/launch/top.launch")
    assert [f"{each.package}/{each.type}" for each in top.nodes] == expected
    assert [names(each, "subscribers") for each in top.nodes] == [["/chatter"]] * len(expected)


@pytest.mark.parametrize(
    ("body", "count"),
    [
        ('ros::init(argc, argv, "n"); ros::NodeHandle nh; ros::spin();', 1),
        ('if (argc > 2) ros::init(argc, argv, "n");', 1),
        ("int x = 1;", 0),
        ("ros::Time::init();", 0),
    ],
)
def test_a_program_that_names_itself_is_a_node(body: str, count: int) -> None:
    text = f"{CPP_HEAD}int main(int argc, char** argv) {{ {body} }}"
    assert [c.nodes[0].name for c in follow(cpp_files(text)).configurations] == ["/n"] * count


RELAY = """#include <nodelet/nodelet.h>
#include <std_msgs/String.h>
namespace p {
class Relay : public nodelet::Nodelet {
  ros::Publisher out_;
  void onInit() override { out_ = getNodeHandle().advertise<std_msgs::String>("out", 1); }
};
}
"""


@pytest.mark.parametrize(
    ("attribute", "look_up", "expected"),
    [
        ("", "p::Relay", ("p", "p::Relay")),
        ('name="Relay"', "Relay", ("p", "Relay")),
        ('name="p/relay"', "p/relay", ("p", "relay")),
        ('name="q/relay"', "q/relay", ("q", "relay")),
    ],
)
def test_nodelets_by_any_look_up_name(attribute: str, look_up: str, expected: tuple[str, str]) -> None:
    files = {
        "p/CMakeLists.txt": CMAKE.format("p") + "add_library(x src/relay.cpp)\n",
        "p/package.xml": '<package><name>p</name><export><nodelet plugin="${prefix}/p.xml"/></export></package>',
        "p/p.xml": f'<library path="x"><class {attribute} type="p::Relay" base_class_type="nodelet::Nodelet"/></library>',
        "p/src/relay.cpp": RELAY,
    }
    started = f'<launch><node pkg="nodelet" type="nodelet" name="t" args="standalone {look_up}"/></launch>'
    for more in ({}, {"p/launch/l.launch": started}):
        found = node(follow(files | more))
        assert (found.package, found.type, found.class_name, names(found)) == (*expected, "p::Relay", ["/out"])
        is_unnamed = not more and ":" in look_up  # the program nodelet makes no name of it
        assert [unknown.field for unknown in found.unknowns] == ["name"] * is_unnamed


def test_a_script_without_rospy_is_no_node() -> None:
    assert follow(python_files("#!/usr/bin/env python\nprint(1)\n")).configurations == ()
    named = 'import rospy\nrospy.init_node("me")\n'
    assert [c.nodes[0].name for c in follow(python_files(f"#!/usr/bin/env python\n{named}")).configurations] == ["/me"]


def test_known_nodes_are_not_of_packages_that_are_here() -> None:
    launch = '<launch><node pkg="%s" type="joy_node" name="t"/></launch>'
    settings = Settings(root=Path("/nowhere"))
    for package in ("joy", "a"):
        files = {f"{package}/launch/l.launch": launch % "joy", **FILES}
        made = architecture(workspace(files), settings, Nothing(), environment={})
        (started,) = made.configurations[0].nodes
        assert bool(ends(started)) == (package != "joy")
        assert bool([u for u in started.unknowns if u.field == "endpoints"]) == (package == "joy")


def test_the_same_executable_of_another_package_is_another() -> None:
    other = {
        "c/CMakeLists.txt": CMAKE.format("c") + "add_executable(talker src/talker.cpp)\n",
        "c/src/talker.cpp": TALKER.replace('"chatter"', '"other"'),
        "c/launch/l.launch": '<launch><node pkg="c" type="talker" name="t"/>'
        '<node pkg="a" type="talker" name="u"/></launch>',
    }
    found = follow(FILES | other)
    assert {n.name: names(n) for n in found.configurations[0].nodes} == {"/t": ["/other"], "/u": ["/chatter"]}


def test_places_are_those_of_the_source() -> None:
    (talker,) = started('<node pkg="a" type="talker" name="t"/>').configurations[0].nodes
    (publisher,) = ends(talker)
    line = TALKER.split("\n").index("    pub_ = nh_.advertise<std_msgs::String>(topic, queue);") + 1
    assert publisher.location == Location("a/src/talker.cpp", line, 12)


def test_nothing_depends_on_the_order_of_files() -> None:
    launch = {
        "b/launch/all.launch": (
            '<launch><node pkg="a" type="talker" name="t"/><node pkg="b" type="listener.py" name="l"/></launch>'
        )
    }
    forwards, backwards = FILES | launch, dict(reversed(list((FILES | launch).items())))
    assert workspace(forwards).files == workspace(backwards).files
    assert follow(forwards) == follow(backwards)


def test_a_function_of_another_executable_is_not_this_ones() -> None:
    """Two executables of one package define ``topic``; each has its own."""
    files = {
        "p/CMakeLists.txt": CMAKE.format("p")
        + "add_executable(one main.cpp one.cpp)\nadd_executable(two main.cpp two.cpp)\n",
        "p/main.cpp": main("ADV(topic(), 1);", "std::string topic();"),
        "p/one.cpp": '#include <string>\nstd::string topic() { return "of_one"; }\n',
        "p/two.cpp": '#include <string>\nstd::string topic() { return "of_two"; }\n',
    }
    found = follow(files)
    assert {c.name: names(c.nodes[0]) for c in found.configurations} == {"p/one": ["/of_one"], "p/two": ["/of_two"]}


def test_a_function_of_another_package_is_not_this_ones_unless_linked() -> None:
    files = {
        "p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n main.cpp)\n",
        "p/main.cpp": main("ADV(topic(), 1);", "std::string topic();"),
        "q/CMakeLists.txt": CMAKE.format("q") + "add_executable(m other.cpp)\n",
        "q/other.cpp": main("", 'std::string topic() { return "of_q"; }'),
    }
    found = follow(files)
    assert {c.name: names(c.nodes[0]) for c in found.configurations} == {"p/n": ["/?"], "q/m": []}


def test_a_constant_of_another_package_is_not_this_ones() -> None:
    files = {
        "p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n main.cpp)\n",
        "p/main.cpp": main("ADV(TOPIC, 1);", "#include <elsewhere/topics.h>"),
        "q/include/q/constants.h": '#include <string>\nconst std::string TOPIC = "of_q";\n',
        "q/CMakeLists.txt": CMAKE.format("q"),
    }
    assert names(node(follow(files))) == ["/?"]


def test_a_macro_of_another_package_is_not_this_ones() -> None:
    files = {
        "p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n main.cpp)\n",
        "p/main.cpp": main("ADV(TOPIC, 1);", "#include <elsewhere/topics.h>"),
        "q/include/q/constants.h": '#define TOPIC "of_q"\n',
        "q/CMakeLists.txt": CMAKE.format("q"),
    }
    assert names(node(follow(files))) == ["/?"]


def test_a_static_variable_of_another_file_is_not_this_ones() -> None:
    found = node(
        follow(
            cpp_files(
                main("other(); ADV(s, 1);", 'static std::string s = "a"; void other();'),
                other__cpp='#include <string>\nstatic std::string s = "x";\nvoid other() { s = "b"; }\n',
            )
        )
    )
    assert names(found) == ["/a"]


def test_an_external_variable_is_the_one_that_is_defined() -> None:
    found = node(
        follow(
            cpp_files(
                main("other(); ADV(s, 1);", 'std::string s = "a"; void other();'),
                other__cpp='#include <string>\nextern std::string s;\nvoid other() { s = "b"; }\n',
            )
        )
    )
    assert names(found) in (["/b"], ["/?"])


def test_a_parameter_that_another_node_sets_is_not_the_default() -> None:
    """The other node may or may not have set it when this one reads it."""
    setter = python_files(PYTHON_HEAD + 'rospy.init_node("s")\nrospy.set_param("/t", "b")\n')
    reader = main('std::string s; nh.param<std::string>("/t", s, "a"); ADV(s, 1);')
    files = setter | {
        "q/CMakeLists.txt": CMAKE.format("q") + "add_executable(r main.cpp)\n",
        "q/main.cpp": reader,
        "q/launch/l.launch": '<launch><node pkg="p" type="n.py" name="s"/><node pkg="q" type="r" name="r"/></launch>',
    }
    found = follow(files)
    assert {n.name: names(n) for n in found.configurations[0].nodes} == {"/s": [], "/r": ["/?"]}


def test_a_compile_definition_is_not_the_default() -> None:
    files = cpp_files(main("ADV(TOPIC, 1);", '#ifndef TOPIC\n#define TOPIC "a"\n#endif'))
    files["p/CMakeLists.txt"] += 'target_compile_definitions(n PRIVATE TOPIC="b")\n'
    assert names(node(follow(files))) in (["/b"], ["/?"])
