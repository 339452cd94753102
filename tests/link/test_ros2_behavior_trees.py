# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: nodes of behaviour trees (BehaviorTree.CPP), of trees that are known, and of all in the workspace."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import ROS2_CMAKE, ends, follow
from tree_kit import FROM_TEXT, HEAD, MAIN, NODE, PORT, REGISTER, SAY, UNKNOWN, tree

from haros_ci.model.architecture import Architecture


def found(text: str, targets: str = "", **files: str) -> Architecture:
    cmake = ROS2_CMAKE.format("p") + f"ament_auto_add_executable(n src/n.cpp)\n{targets}\nament_auto_package()\n"
    others = {f"p/{path.replace('__', '/').replace('_dot_', '.')}": content for path, content in files.items()}
    return follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": HEAD + text, **others}, 2)


def told(architecture: Architecture, kind: str = "publishers") -> dict[str, list[tuple[str, Any]]]:
    """By configuration: the endpoints that the code makes, with the fields that are not known of each."""
    return {
        each.name: sorted(
            (end.name, [unknown.field for unknown in end.unknowns])
            for node in each.nodes
            for end in ends(node, kind)
            if not end.implicit
        )
        for each in architecture.configurations
    }


def of_tree(tags: str, ports: str = PORT, before: str = "") -> dict[str, list[tuple[str, Any]]]:
    return told(found(SAY % ports + MAIN % (REGISTER + before + FROM_TEXT % tree(tags))))


@pytest.mark.parametrize(
    ("tags", "topics"),
    [
        ('<Say topic="a"/>', [("/a", [])]),
        ('<Sequence><Say topic="a"/><Inverter><Say topic="b"/></Inverter></Sequence>', [("/a", []), ("/b", [])]),
        ('<Action ID="Say" topic="a"/>', [("/a", [])]),
        ('<Say name="x" topic="a"/><Say name="y" topic="a"/>', [("/a", [])]),
        ("<Say/>", [("/unset", [])]),
        ('<Say topic="{where}"/>', [("/?", ["name"])]),
        ("<Other/>", []),
        ('<SubTree ID="Main"/><Say topic="a"/>', [("/a", [])]),
        ("", []),
    ],
)
def test_a_tree_that_is_known(tags: str, topics: list[tuple[str, Any]]) -> None:
    assert of_tree(tags) == {"p/n": topics}


@pytest.mark.parametrize(
    ("ports", "topics"),
    [
        ('BT::InputPort<std::string>("topic", "usual", "which topic")', [("/usual", [])]),
        ('BT::BidirectionalPort<std::string>("topic", "usual", "which topic")', [("/usual", [])]),
        ('BT::InputPort<std::string>("topic", "{where}", "which topic")', [("/?", ["name"])]),
        ('BT::OutputPort<std::string>("topic", "which topic")', [("/unset", [])]),
        ('BT::InputPort<std::string>("other", "usual", "which topic")', [("/unset", [])]),
        ("", [("/unset", [])]),
        ("elsewhere()", [("/?", ["name"])]),
    ],
)
def test_ports_that_the_tag_does_not_have(ports: str, topics: list[tuple[str, Any]]) -> None:
    assert of_tree("<Say/>", ports) == {"p/n": topics}


def test_ports_of_a_base_class() -> None:
    text = """
class Base : public BT::ConditionNode {
public:
  Base(const std::string & name, const BT::NodeConfiguration & conf) : BT::ConditionNode(name, conf) {}
  static BT::PortsList providedBasicPorts(BT::PortsList addition) {
    BT::PortsList basic = {BT::InputPort<std::string>("topic", "basic", "a topic")};
    basic.insert(addition.begin(), addition.end());
    return basic;
  }
};
class Derived : public Base {
public:
  Derived(const std::string & name, const BT::NodeConfiguration & conf) : Base(name, conf) {
    auto topic = getInput<std::string>("topic");
    if (!topic) { throw BT::RuntimeError("no topic"); }
    int count = 0;
    bool is_on = false;
    bool has_count = getInput("count", count).has_value();
    getInput("on", is_on);
    std::string rest = (has_count ? "/" : "!") + std::to_string(count) + (is_on ? "on" : "");
    NODE->create_publisher<std_msgs::msg::String>(topic.value() + rest, 1);
  }
  static BT::PortsList providedPorts() {
    return providedBasicPorts({BT::InputPort<int>("count", 1, "how many"), BT::InputPort<bool>("on")});
  }
};
""".replace("NODE", NODE)
    for tag, topics in (
        ("<D/>", [("/basic/1", [])]),
        ('<D topic="a" count="2" on="true"/>', [("/a/2on", [])]),
        ('<D topic="a" count="2" on="false"/>', [("/a/2", [])]),
        ('<D topic="a" count="two"/>', [("/?", ["name"])]),
    ):
        body = 'factory.registerNodeType<Derived>("D");' + FROM_TEXT % tree(tag)
        assert told(found(text + MAIN % body)) == {"p/n": topics}


def test_builders_give_what_the_tree_does_not_know() -> None:
    text = """
class Named : public BT::ActionNodeBase {
public:
  Named(
    const std::string & name, const std::string & topic, const BT::NodeConfig & config, rclcpp::Node::SharedPtr node)
  : BT::ActionNodeBase(name, config) { node->create_publisher<std_msgs::msg::String>(topic + "/" + name, 1); }
  static BT::PortsList providedPorts() { return {}; }
};
"""
    body = """
  BT::NodeBuilder builder = [&](const std::string & name, const BT::NodeConfig & config) {
      return std::make_unique<Named>(name, "by", config, node); };
  factory.registerBuilder<Named>("Named", builder);
"""
    tags = '<Named/><Named name="own"/>'
    assert told(found(text + MAIN % (body + FROM_TEXT % tree(tags)))) == {"p/n": [("/by/?", ["name"])]}
    assert told(found(text + MAIN % (body + FROM_TEXT % tree("<Named/>")))) == {"p/n": [("/by/Named", [])]}


def test_further_arguments_of_the_constructor() -> None:
    text = """
class Given : public BT::StatefulActionNode {
public:
  Given(const std::string & name, const BT::NodeConfig & config, rclcpp::Node::SharedPtr node)
  : BT::StatefulActionNode(name, config), node_(node) {}
  BT::NodeStatus onStart() override { return done("started"); }
  BT::NodeStatus onRunning() override { return done("running"); }
  BT::NodeStatus done(const std::string & topic) {
    node_->create_publisher<std_msgs::msg::String>(topic, 1);
    return BT::NodeStatus::RUNNING;
  }
  void onHalted() override {}
  rclcpp::Node::SharedPtr node_;
};
"""
    body = 'factory.registerNodeType<Given>("Given", node);' + FROM_TEXT % tree("<Given/>")
    assert told(found(text + MAIN % body)) == {"p/n": [("/running", []), ("/started", [])]}


def test_what_is_made_when_it_is_ticked() -> None:
    text = """
class Late : public BT::ActionNodeBase {
public:
  using BT::ActionNodeBase::ActionNodeBase;
  void initialize() {
    std::string topic; getInput("topic", topic);
    if (!sub_) {
      sub_ = NODE->create_subscription<std_msgs::msg::String>(topic, 1, [](std_msgs::msg::String::SharedPtr) {});
    }
  }
  BT::NodeStatus tick() override {
    if (!BT::isStatusActive(status())) { initialize(); }
    return BT::NodeStatus::RUNNING;
  }
  static BT::PortsList providedPorts() { return {BT::InputPort<std::string>("topic")}; }
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr sub_;
};
""".replace("NODE", NODE)
    body = 'factory.registerNodeType<Late>("Late");'
    made = found(text + MAIN % (body + FROM_TEXT % tree('<Late topic="late"/>')))
    assert told(made, "subscribers") == {"p/n": [("/late", [])]}
    assert told(found(text + MAIN % body), "subscribers") == {"p/n": []}


def test_functions_as_nodes() -> None:
    body = """
  factory.registerSimpleAction("Do", [&](BT::TreeNode &) {
      node->create_publisher<std_msgs::msg::String>("done", 1);
      return BT::NodeStatus::SUCCESS; });
  factory.registerSimpleCondition("Ask", [&](BT::TreeNode &) {
      node->create_publisher<std_msgs::msg::String>("asked", 1);
      return BT::NodeStatus::SUCCESS; });
"""
    assert told(found(MAIN % (body + FROM_TEXT % tree("<Do/>")))) == {"p/n": [("/done", [])]}


def test_entries_of_the_blackboard() -> None:
    text = """
class Read : public BT::SyncActionNode {
public:
  Read(const std::string & name, const BT::NodeConfig & conf) : BT::SyncActionNode(name, conf) {
    std::string topic("unset");
    if (conf.blackboard->get("key", topic)) {
      NODE->create_publisher<std_msgs::msg::String>(topic, 1);
    }
  }
};
""".replace("NODE", NODE)
    register = 'factory.registerNodeType<Read>("Read");'
    for before, topics in (
        ('blackboard->set("key", std::string("said"));', [("/said", [])]),
        ('blackboard->set<std::string>("key", "one"); blackboard->set<std::string>("key", "two");', [("/two", [])]),
        ("", [("/?", ["name"])]),
        ('blackboard->set("key", std::string("said")); blackboard->set(argv[1], 1);', [("/?", ["name"])]),
    ):
        assert told(found(text + MAIN % (register + before + FROM_TEXT % tree("<Read/>")))) == {"p/n": topics}


def test_a_tree_in_a_file_with_subtrees() -> None:
    trees = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence><Say topic="a"/><SubTree ID="Inner"/></Sequence></BehaviorTree>
<BehaviorTree ID="Inner"><Say topic="b"/></BehaviorTree>
<BehaviorTree ID="Unused"><Say topic="c"/></BehaviorTree></root>"""
    body = """
  auto share = ament_index_cpp::get_package_share_directory("p");
  auto tree = factory.createTreeFromFile(share + "/trees/main.xml", blackboard);
"""
    made = found(SAY % PORT + MAIN % (REGISTER + body), trees__main_dot_xml=trees)
    assert told(made) == {"p/n": [("/a", []), ("/b", [])]}
    by_name = """
  factory.registerBehaviorTreeFromFile(ament_index_cpp::get_package_share_directory("p") + "/trees/main.xml");
  auto tree = factory.createTree("Unused", blackboard);
"""
    assert told(found(SAY % PORT + MAIN % (REGISTER + by_name), trees__main_dot_xml=trees)) == {"p/n": [("/c", [])]}


def test_a_subtree_that_is_elsewhere() -> None:
    outer = tree('<Say topic="a"/><SubTree ID="Inner"/>')
    made = found(SAY % PORT + MAIN % (REGISTER + FROM_TEXT % outer))
    assert told(made) == {"p/n": [("/a", [])], "p/n (behaviour trees)": [("/a", [])]}
    assert [unknown.field for unknown in made.configurations[0].nodes[0].unknowns] == ["endpoints"]
    before = 'factory.registerBehaviorTreeFromText(R"(%s)");' % tree('<Say topic="b"/>', "Inner")
    assert told(found(SAY % PORT + MAIN % (REGISTER + before + FROM_TEXT % outer))) == {"p/n": [("/a", []), ("/b", [])]}


def test_several_trees_of_which_none_is_said_to_be_executed() -> None:
    text = tree('<Say topic="a"/>') + tree('<Say topic="b"/>', "Other")
    text = text.replace('</root><root BTCPP_format="4">', "")
    made = told(found(SAY % PORT + MAIN % (REGISTER + FROM_TEXT % text)))
    assert made["p/n"] == []


def test_one_place_creates_several_trees() -> None:
    body = """
  for (const auto & name : std::vector<std::string>{"one", "two"}) {
    auto path = ament_index_cpp::get_package_share_directory("p") + "/" + name + ".xml";
    auto tree = factory.createTreeFromFile(path, blackboard);
  }
"""
    files = {f"{name}_dot_xml": tree(f'<Say topic="{name}"/>') for name in ("one", "two")}
    assert told(found(SAY % PORT + MAIN % (REGISTER + body), **files)) == {"p/n": [("/one", []), ("/two", [])]}


def test_a_tree_of_which_the_code_reads_the_name() -> None:
    body = """
  std::string share = ament_index_cpp::get_package_share_directory("p"), main = share + "/trees/main.xml";
  tinyxml2::XMLDocument doc;
  if (doc.LoadFile(main.c_str()) != tinyxml2::XML_SUCCESS) { return 1; }
  std::string name = doc.RootElement()->Attribute("main_tree_to_execute");
  for (const auto & entry : std::filesystem::directory_iterator(share + "/trees")) {
    factory.registerBehaviorTreeFromFile(entry.path().string());
  }
  auto tree = factory.createTree(name, blackboard);
"""
    main = tree('<Say topic="a"/><SubTree ID="Inner"/>').replace("<root", '<root main_tree_to_execute="Main"')
    others = {"trees__inner_dot_xml": tree('<Say topic="b"/>', "Inner"), "trees__unused_dot_xml": tree("<Say/>", "No")}
    made = found(SAY % PORT + MAIN % (REGISTER + body), trees__main_dot_xml=main, **others)
    assert told(made) == {"p/n": [("/a", []), ("/b", [])]}


def test_names_of_the_library_without_its_namespace() -> None:
    text = SAY % PORT + MAIN % (REGISTER + FROM_TEXT % tree('<Say topic="a"/>'))
    text = "using namespace BT;\n" + text.replace("BT::", "")
    assert told(found(text)) == {"p/n": [("/a", [])]}


def test_a_tree_that_is_not_known_has_a_configuration_of_its_own() -> None:
    made = found(
        SAY % PORT + MAIN % (REGISTER + UNKNOWN),
        trees__one_dot_xml=tree('<Say topic="a"/>'),
        trees__two_dot_xml=tree('<Say topic="b"/>', "Two"),
        test__three_dot_xml=tree('<Say topic="c"/>'),
        other_dot_xml='<root><Say topic="d"/></root>',
        broken_dot_xml='<root><BehaviorTree><Say topic="e"/>',
    )
    doubtful = [("/a", ["conditions"]), ("/b", ["conditions"])]
    assert told(made) == {"p/n": [], "p/n (behaviour trees)": doubtful}
    assert [unknown.field for unknown in made.configurations[0].nodes[0].unknowns] == ["endpoints"]


def test_a_node_that_no_tree_has() -> None:
    text = SAY % 'BT::InputPort<std::string>("topic", "usual", "which")' + MAIN % (REGISTER + UNKNOWN)
    assert told(found(text)) == {"p/n": [], "p/n (behaviour trees)": [("/usual", ["conditions"])]}
    empty = (SAY % PORT).replace('topic("unset")', "topic") + MAIN % (REGISTER + UNKNOWN)
    assert told(found(empty)) == {"p/n": [], "p/n (behaviour trees)": [("/?", ["name", "conditions"])]}


LIBRARY = HEAD + SAY % PORT + 'BT_REGISTER_NODES(factory)\n{\n  factory.registerNodeType<Say>("Say");\n}\n'
LIBRARIES = "ament_auto_add_library(say SHARED src/say.cpp)"


def test_plug_ins_of_a_library_that_is_known() -> None:
    body = 'factory.registerFromPlugin("libsay.so");' + FROM_TEXT % tree('<Say topic="a"/>')
    assert told(found(MAIN % body, LIBRARIES, src__say_dot_cpp=LIBRARY)) == {"p/n": [("/a", [])]}
    other = 'factory.registerFromPlugin("libother.so");' + FROM_TEXT % tree('<Say topic="a"/>')
    assert told(found(MAIN % other, LIBRARIES, src__say_dot_cpp=LIBRARY)) == {"p/n": []}


def test_plug_ins_of_libraries_that_are_not_known() -> None:
    load = """
  BT::SharedLibrary loader;
  for (auto & p : node->declare_parameter<std::vector<std::string>>("libraries")) {
    factory.registerFromPlugin(loader.getOSName(p));
  }
"""
    known = found(MAIN % (load + FROM_TEXT % tree('<Say topic="a"/>')), LIBRARIES, src__say_dot_cpp=LIBRARY)
    assert told(known) == {"p/n": [("/a", [])]}
    assert known.configurations[0].nodes[0].unknowns == ()
    other = tree('<Sequence><Say topic="a"/><Else/><Inverter/></Sequence>')
    elsewhere = found(MAIN % (load + FROM_TEXT % other), LIBRARIES, src__say_dot_cpp=LIBRARY)
    (unknown,) = elsewhere.configurations[0].nodes[0].unknowns
    assert unknown.reason == "the node Else of a behaviour tree is not in the workspace"
    files = {"src__say_dot_cpp": LIBRARY, "t_dot_xml": tree('<Say topic="a"/>')}
    made = found(MAIN % (load + UNKNOWN), LIBRARIES, **files)
    assert told(made) == {"p/n": [], "p/n (behaviour trees)": [("/a", ["conditions"])]}


def test_two_libraries_with_nodes_of_one_name() -> None:
    twin = LIBRARY.replace("class Say", "namespace twin { class Say").replace("BT_REG", "}\nBT_REG", 1)
    twin = twin.replace("registerNodeType<Say>", "registerNodeType<twin::Say>")
    twin = twin.replace("(topic, 1)", '(topic + "/twin", 1)')
    files = {"src__say_dot_cpp": LIBRARY, "src__twin_dot_cpp": twin}
    targets = LIBRARIES + "\nament_auto_add_library(twin SHARED src/twin.cpp)"
    body = "factory.registerFromPlugin(argv[1]);" + FROM_TEXT % tree('<Say topic="a"/>')
    made = told(found(MAIN % body, targets, **files))
    assert made == {"p/n": [("/a", ["conditions"]), ("/a/twin", ["conditions"])]}


def test_one_of_two_registrations() -> None:
    other = (SAY % PORT).replace("Say", "Tell").replace("(topic, 1)", '(topic + "/told", 1)')
    body = 'if (argc > 1) { factory.registerNodeType<Say>("S"); } else { factory.registerNodeType<Tell>("S"); }'
    made = told(found(SAY % PORT + other + MAIN % (body + FROM_TEXT % tree('<S topic="a"/>'))))
    assert made == {"p/n": [("/a", ["conditions"]), ("/a/told", ["conditions"])]}


def test_each_blackboard_has_its_own_nodes() -> None:
    body = (
        REGISTER
        + """
  for (const auto & name : std::vector<std::string>{"one", "two"}) {
    auto board = BT::Blackboard::create();
    board->set<rclcpp::Node::SharedPtr>("node", std::make_shared<rclcpp::Node>(name));
    auto tree = factory.createTreeFromText(R"(FIRST)", board);
    auto again = factory.createTreeFromText(R"(SECOND)", board);
  }
"""
    )
    body = body.replace("FIRST", tree('<Say topic="~/a"/>')).replace("SECOND", tree('<Say topic="~/b"/>'))
    made = told(found(SAY % PORT + MAIN % body))
    assert made == {"p/n": [("/one/a", []), ("/one/b", []), ("/two/a", []), ("/two/b", [])]}


def test_what_makes_no_tree_makes_no_node() -> None:
    assert told(found(SAY % PORT + MAIN % REGISTER, trees__one_dot_xml=tree('<Say topic="a"/>'))) == {"p/n": []}
    no_factory = "struct Factory { void createTree(std::string) {} };\n" + MAIN % 'Factory own; own.createTree("Main");'
    assert told(found(SAY % PORT + no_factory, trees__one_dot_xml=tree('<Say topic="a"/>'))) == {"p/n": []}


def test_many_nodes_that_differ() -> None:
    tags = "".join(f'<Say topic="t{number}"/>' for number in range(20))
    assert of_tree(tags) == {"p/n": [("/?", ["name"])]}
    tags = "".join(f'<Say topic="same" other="{number}"/>' for number in range(20))
    assert of_tree(tags) == {"p/n": [("/same", [])]}


REGISTERING = """#define REGISTER_NODE(space, Type) \\
  BT_REGISTER_NODES(factory) \\
  { \\
    factory.registerBuilder<space::Type>(#Type, built<space::Type>()); \\
  }
template <class T> static auto built() {
  return [](const std::string & name, const BT::NodeConfiguration & config) { return std::make_unique<T>(name, config); };
}
"""


def test_plug_ins_that_a_macro_of_a_header_registers() -> None:
    library = f'#include "p/registering.hpp"\n{HEAD}namespace talk {{{SAY % PORT}}}\nREGISTER_NODE(talk, Say)\n'
    body = 'factory.registerFromPlugin("libsay.so");' + FROM_TEXT % tree('<Say topic="a"/>')
    files = {"src__say_dot_cpp": library, "include__p__registering_dot_hpp": HEAD + REGISTERING}
    assert told(found(MAIN % body, LIBRARIES, **files)) == {"p/n": [("/a", [])]}
    other = 'factory.registerFromPlugin("libsay.so");' + FROM_TEXT % tree('<Hear topic="a"/>')
    assert told(found(MAIN % other, LIBRARIES, **files)) == {"p/n": []}
