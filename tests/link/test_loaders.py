# SPDX-License-Identifier: Apache-2.0
"""Nodelets that a program loads into itself: they are parts of the node, under names and remappings of their own."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, ends, follow, names, only

from haros_ci.model.architecture import Architecture, Node

RELAY = """#include <nodelet/nodelet.h>
#include <std_msgs/String.h>
namespace p {
class Relay : public nodelet::Nodelet {
  ros::Publisher out_, state_;
  ros::Subscriber in_;
  void onInit() override {
    std::string topic = "out";
    getPrivateNodeHandle().getParam("topic", topic);
    out_ = getNodeHandle().advertise<std_msgs::String>(topic, 1);
    state_ = getPrivateNodeHandle().advertise<std_msgs::String>("state", 1);
    in_ = getNodeHandle().subscribe("in", 1, &Relay::got, this);
  }
  void got(const std_msgs::String::ConstPtr&) {
    getPrivateNodeHandle().advertise<std_msgs::String>("late", 1);
  }
};
}
"""
PLUGINS = """<library path="lib/librelay">
  <class name="p/relay" type="p::Relay" base_class_type="nodelet::Nodelet"/>
</library>"""
HEAD = CPP_HEAD + "#include <nodelet/loader.h>\n"
EMPTY = "nodelet::M_string remap; nodelet::V_string argv_;\n"


def files(body: str, launch: str = "", before: str = "") -> dict[str, str]:
    main = (
        f'{HEAD}{before}\nint main(int argc, char** argv) {{\nros::init(argc, argv, "n");\n{body}\nros::spin();\n}}\n'
    )
    found = {
        "p/CMakeLists.txt": CMAKE.format("p")
        + "add_library(relay src/relay.cpp)\nadd_executable(n src/main.cpp)\ntarget_link_libraries(n)\n",
        "p/package.xml": '<package><name>p</name><export><nodelet plugin="${prefix}/p.xml"/></export></package>',
        "p/p.xml": PLUGINS,
        "p/src/relay.cpp": RELAY,
        "p/src/main.cpp": main,
    }
    return found | {"p/launch/l.launch": launch or '<launch><node pkg="p" type="n" name="n" ns="s"/></launch>'}


def loaded(body: str, launch: str = "", before: str = "") -> Node:
    return first(follow(files(body, launch, before)))


def first(found: Architecture) -> Node:
    """The node of the launch file; the nodelet can be started by itself, too."""
    assert [each.name for each in found.configurations] == ["p/launch/l.launch", "p/relay"]
    (started,) = found.configurations[0].nodes
    return started


def test_a_nodelet_under_the_nodes_own_name() -> None:
    found = loaded(
        "nodelet::Loader loader; nodelet::M_string remap(ros::names::getRemappings()); nodelet::V_string nargv;\n"
        'std::string name = ros::this_node::getName(); loader.load(name, "p/relay", remap, nargv);'
    )
    assert names(found) == ["/s/n/late", "/s/n/state", "/s/out"]
    assert names(found, "subscribers") == ["/s/in"]
    assert (found.kind, found.unknowns) == ("node", ())
    assert [end.location.path for end in ends(found) if end.location] == ["p/src/relay.cpp"] * 3


L = "nodelet::Loader loader(false);\n" + EMPTY


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('loader.load("/a/b", "p/relay", remap, argv_);', ["/a/b/late", "/a/b/state", "/a/out"]),
        ('loader.load("b", "p/relay", remap, argv_);', ["/s/b/late", "/s/b/state", "/s/out"]),
        ('loader.load("~b", "p/relay", remap, argv_);', ["/s/n/b/late", "/s/n/b/state", "/s/n/out"]),
        (
            'loader.load(ros::this_node::getName() + "_r", "p/relay", remap, argv_);',
            ["/s/n_r/late", "/s/n_r/state", "/s/out"],
        ),
        ('remap["out"] = "x"; loader.load("b", "p/relay", remap, argv_);', ["/s/b/late", "/s/b/state", "/s/x"]),
        ('remap["out"] = "/x"; loader.load("b", "p/relay", remap, argv_);', ["/s/b/late", "/s/b/state", "/x"]),
        ('remap["state"] = "x"; loader.load("b", "p/relay", remap, argv_);', ["/s/b/late", "/s/b/x", "/s/out"]),
        (
            'remap["out"] = "x"; remap.clear(); loader.load("b", "p/relay", remap, argv_);',
            ["/s/b/late", "/s/b/state", "/s/out"],
        ),
        (
            'for (int i = 0; i < 2; i++) loader.load("b" + std::to_string(i), "p/relay", remap, argv_);',
            ["/s/b0/late", "/s/b0/state", "/s/b1/late", "/s/b1/state", "/s/out"],
        ),
        (
            'ros::param::set("b/topic", "x"); loader.load("b", "p/relay", remap, argv_);',
            ["/s/b/late", "/s/b/state", "/s/x"],
        ),
    ],
)
def test_names_and_remappings(code: str, expected: list[str]) -> None:
    found = loaded(L + code)
    assert sorted(set(names(found))) == expected
    assert found.unknowns == ()


def test_a_map_that_the_node_has_set_is_no_default() -> None:
    code = 'XmlRpc::XmlRpcValue all; all["topic"] = name(); ros::param::set("b", all);'
    found = loaded(L + code + 'loader.load("b", "p/relay", remap, argv_);', "", "std::string name();")
    assert names(found) == ["/?", "/s/b/late", "/s/b/state"]


def test_a_function_that_only_loads() -> None:
    found = loaded(
        L + 'several(loader, "left"); several(loader, "right");',
        before="void several(nodelet::Loader& manager, const std::string& side) {\n"
        'nodelet::M_string remap; nodelet::V_string argv_; remap["out"] = side + "/out";\n'
        'manager.load(side + "_relay", "p/relay", remap, argv_); }',
    )
    assert sorted(set(names(found))) == [
        "/s/left/out",
        "/s/left_relay/late",
        "/s/left_relay/state",
        "/s/right/out",
        "/s/right_relay/late",
        "/s/right_relay/state",
    ]


def test_the_launch_files_parameters_and_remappings_reach_it() -> None:
    launch = '<launch><node pkg="p" type="n" name="n"><param name="topic" value="t"/><remap from="t" to="u"/></node></launch>'
    found = loaded(L + 'loader.load(ros::this_node::getName(), "p/relay", remap, argv_);', launch)
    assert names(found) == ["/n/late", "/n/state", "/u"]
    assert [end.original_name for end in ends(found)] == ["/t", "/n/state", "/n/late"]


def test_a_condition_around_the_call_is_one_of_what_is_made() -> None:
    found = loaded(L + 'if (argc > 1) { loader.load("b", "p/relay", remap, argv_); }', "")
    assert {c.statement for end in ends(found) for c in end.conditions} <= {"if"}
    unknown = loaded(L + 'bool b = ok(); if (b) { loader.load("b", "p/relay", remap, argv_); }', "", "bool ok();")
    assert [[c.condition for c in end.conditions] for end in ends(unknown)] == [["b"]] * 3


@pytest.mark.parametrize(
    ("code", "reason"),
    [
        (
            'loader.load("b", "elsewhere/thing", remap, argv_);',
            "it loads the nodelet elsewhere/thing, which is not in the workspace",
        ),
        ('loader.load("b", std::string(argv[1]), remap, argv_);', "it loads a nodelet of which the type is not known"),
        ("loader.load(name(), kind(), remap, argv_);", "it loads a nodelet of which the type is not known"),
    ],
)
def test_what_is_not_known_is_said(code: str, reason: str) -> None:
    found = loaded(L + code, "", "std::string name(); std::string kind();")
    assert [(unknown.field, unknown.reason) for unknown in found.unknowns] == [("endpoints", reason)]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('loader.load(name(), "p/relay", remap, argv_);', {"/?/late", "/?/state", "/?"}),
        ('loader.load("b", "p/relay", given(), argv_);', {"/?"}),
        ('remap["out"] = name(); loader.load("b", "p/relay", remap, argv_);', {"/s/b/late", "/s/b/state", "/?"}),
    ],
)
def test_names_that_are_not_known(code: str, expected: set[str]) -> None:
    found = loaded(L + code, "", "std::string name(); nodelet::M_string given();")
    made = ends(found)
    assert {end.name for end in made} <= expected and any("?" in end.name for end in made)
    for end in made:
        assert ("?" in end.original_name) == any(unknown.field == "name" for unknown in end.unknowns)


def test_an_anonymous_name_is_below_its_namespace() -> None:
    code = 'loader.load(ros::this_node::getName(), "p/relay", remap, argv_);'
    found = loaded(L + code, '<launch><node pkg="p" type="n" name="$(anon n)" ns="s"/></launch>')
    assert names(found) == ["/?", "/s/n_?/late", "/s/n_?/state"]  # a parameter below an unknown name may be set


def test_a_load_of_something_else_is_none() -> None:
    found = loaded(
        'Loader loader; loader.load("b", "p/relay");', before="struct Loader { void load(std::string, std::string); };"
    )
    assert (names(found), found.unknowns) == ([], ())


def test_nodelets_that_load_themselves_end() -> None:
    body = "nodelet::Loader loader(false); nodelet::M_string m; nodelet::V_string v;"
    again = RELAY.replace("std::string topic", f'{body} loader.load("b", "p/relay", m, v); std::string topic')
    found = follow(files(L + 'loader.load("b", "p/relay", remap, argv_);') | {"p/src/relay.cpp": again})
    assert sorted(set(names(first(found)))) == ["/s/b/late", "/s/b/state", "/s/out"]
    reasons = [unknown.reason for unknown in first(found).unknowns]
    assert reasons == ["nodelets load each other too deeply to be followed"]


@pytest.mark.parametrize(
    ("attribute", "name", "reasons"),
    [
        ('name="p/relay"', "/p_relay", []),
        ('name="relay"', "/relay", []),
        ("", "/?", ["its look-up name has a colon, which no node name may have: whoever loads it names it"]),
        (
            'name="p::Relay"',
            "/?",
            ["its look-up name has a colon, which no node name may have: whoever loads it names it"],
        ),
    ],
)
def test_a_nodelet_that_nothing_loads_has_the_name_that_the_program_nodelet_makes(
    attribute: str, name: str, reasons: list[str]
) -> None:
    """nodelet.cpp, ``getDefaultName``: slashes become underscores, and roscpp refuses a colon."""
    files = {
        "p/package.xml": '<package><name>p</name><export><nodelet plugin="${prefix}/p.xml"/></export></package>',
        "p/CMakeLists.txt": CMAKE.format("p") + "add_library(relay src/relay.cpp)\n",
        "p/p.xml": f'<library path="lib/librelay"><class {attribute} type="p::Relay" base_class_type="nodelet::Nodelet"/></library>',
        "p/src/relay.cpp": RELAY,
    }
    (node,) = only(follow(files)).nodes
    assert node.name == name
    assert [unknown.reason for unknown in node.unknowns if unknown.field == "name"] == reasons
    assert all(end.name.startswith((f"{name}/", "/out", "/in")) or "?" in end.name for end in node.endpoints)
