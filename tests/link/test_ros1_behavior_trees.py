# SPDX-License-Identifier: Apache-2.0
"""ROS 1 C++: nodes of behaviour trees (BehaviorTree.CPP), of trees that are known, and of all in the workspace."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, cpp_files, ends, follow
from tree_kit import tree

from haros_ci.model.architecture import Architecture

HEAD = '#include "behaviortree_cpp_v3/bt_factory.h"\n' + CPP_HEAD
#: Publishes in its constructor what its port says, on a handle of its own.
SAY = """
class Say : public BT::SyncActionNode {
public:
  Say(const std::string& name, const BT::NodeConfiguration& config) : BT::SyncActionNode(name, config) {
    std::string topic("unset");
    getInput("topic", topic);
    ros::NodeHandle nh;
    pub_ = nh.advertise<std_msgs::String>(topic, 1);
  }
  static BT::PortsList providedPorts() { return {BT::InputPort<std::string>("topic", "which topic")}; }
  BT::NodeStatus tick() override { return BT::NodeStatus::SUCCESS; }
  ros::Publisher pub_;
};
"""
MAIN = """
int main(int argc, char** argv) {
  ros::init(argc, argv, "host");
  ros::NodeHandle node("~");
  BT::BehaviorTreeFactory factory;
  auto blackboard = BT::Blackboard::create();
  %s
  ros::spin();
}
"""
REGISTER = 'factory.registerNodeType<Say>("Say");\n'
TEXT = 'auto tree = factory.createTreeFromText(R"(%s)", blackboard);'
UNKNOWN = 'std::string file; node.getParam("tree", file); auto tree = factory.createTreeFromFile(file, blackboard);'
LIBRARY = HEAD + SAY + "BT_REGISTER_NODES(factory)\n{\n  " + REGISTER + "}\n"
LOAD = 'std::string library; node.getParam("library", library); factory.registerFromPlugin(library);\n'
LAUNCH = """<launch><node pkg="p" type="n" name="m">
<param name="tree" value="$(find p)/trees/a.xml"/><param name="library" value="libsay.so"/></node></launch>
"""


def found(text: str, launch: str = "", library: str = "", **trees: str) -> Architecture:
    files = cpp_files(HEAD + text, launch) | {f"p/trees/{name}.xml": content for name, content in trees.items()}
    if library:
        files["p/say/say.cpp"] = library
        files["p/CMakeLists.txt"] += "add_library(say SHARED say/say.cpp)\n"
    return follow(files, 1)


def topics(architecture: Architecture) -> dict[str, list[tuple[str, list[str]]]]:
    """By configuration: the topics that the code publishes, with the fields that are not known of each."""
    return {
        configuration.name: sorted(
            (end.name, [unknown.field for unknown in end.unknowns])
            for node in configuration.nodes
            for end in ends(node, "publishers")
            if not end.implicit
        )
        for configuration in architecture.configurations
    }


@pytest.mark.parametrize(
    ("tags", "expected"),
    [
        ('<Say topic="a"/>', [("/a", [])]),
        ('<Sequence><Say topic="a"/><Inverter><Say topic="b"/></Inverter></Sequence>', [("/a", []), ("/b", [])]),
        ("<Say/>", [("/unset", [])]),
        ("<Other/>", []),
        ("", []),
    ],
)
def test_a_tree_that_is_known(tags: str, expected: list[tuple[str, list[str]]]) -> None:
    assert topics(found(SAY + MAIN % (REGISTER + TEXT % tree(tags)))) == {"p/n": expected}


def test_a_tree_that_a_parameter_names() -> None:
    made = found(SAY + MAIN % (REGISTER + UNKNOWN), LAUNCH, a=tree('<Say topic="a"/>'), b=tree('<Say topic="b"/>'))
    assert topics(made)["p/launch/l.launch"] == [("/a", [])]


def test_a_library_that_a_parameter_names() -> None:
    made = found(MAIN % (LOAD + UNKNOWN), LAUNCH, LIBRARY, a=tree('<Say topic="a"/>'))
    assert topics(made)["p/launch/l.launch"] == [("/a", [])]


def test_a_tree_that_is_not_known_has_a_configuration_of_its_own() -> None:
    trees = {"one": tree('<Say topic="a"/>'), "two": tree('<Say topic="b"/>', "Two")}
    made = found(SAY + MAIN % (REGISTER + UNKNOWN), **trees)
    doubtful = [("/a", ["conditions"]), ("/b", ["conditions"])]
    assert topics(made) == {"p/n": [], "p/n (behaviour trees)": doubtful}
    assert [unknown.field for unknown in made.configurations[0].nodes[0].unknowns] == ["endpoints"]


def test_a_node_that_no_tree_has() -> None:
    assert topics(found(SAY + MAIN % (REGISTER + UNKNOWN))) == {
        "p/n": [],
        "p/n (behaviour trees)": [("/unset", ["conditions"])],
    }


def test_a_program_that_ends_without_its_parameters() -> None:
    body = f'std::string file; if (!node.getParam("tree", file)) return 1;\n{REGISTER}{UNKNOWN.partition(";")[2].partition(";")[2]}'
    made = found(SAY + MAIN % body, a=tree('<Say topic="a"/>'))
    assert topics(made) == {"p/n": [], "p/n (behaviour trees)": [("/a", ["conditions"])]}


@pytest.mark.parametrize(
    ("header", "is_known"),
    [
        ("behaviortree_cpp_v3/xml_parsing.h", True),
        ("behaviortree_cpp/loggers/bt_cout_logger.h", True),
        ("behaviortree_cpp_v3/action_node.h", False),
        ("other/xml_parsing.h", False),
    ],
)
def test_headers_that_bring_the_factory(header: str, is_known: bool) -> None:
    files = cpp_files((HEAD + SAY + MAIN % (REGISTER + UNKNOWN)).replace("behaviortree_cpp_v3/bt_factory.h", header))
    made = follow(files | {"p/trees/a.xml": tree('<Say topic="a"/>')}, 1)
    assert ("p/n (behaviour trees)" in topics(made)) is is_known


def test_libraries_that_are_not_known() -> None:
    made = found(MAIN % (LOAD + UNKNOWN), "", LIBRARY, a=tree('<Say topic="a"/>'))
    assert topics(made) == {"p/n": [], "p/n (behaviour trees)": [("/a", ["conditions"])]}


@pytest.mark.parametrize(
    "body",
    [
        'nh.advertise<std_msgs::String>("a", 1);',
        REGISTER + 'nh.advertise<std_msgs::String>("a", 1);',
        REGISTER + 'nh.advertise<std_msgs::String>("a", 1);' + TEXT % tree("<Inverter/>"),
    ],
)
def test_a_program_that_creates_no_tree_or_one_that_makes_nothing(body: str) -> None:
    made = found(SAY + MAIN % ("ros::NodeHandle nh;\n" + body), a=tree('<Say topic="b"/>'))
    assert topics(made) == {"p/n": [("/a", [])]}
