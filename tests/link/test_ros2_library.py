# SPDX-License-Identifier: Apache-2.0
"""ROS 2: classes of libraries that no process of the workspace makes: what they bring into the node of whoever uses them."""

from __future__ import annotations

from dataclasses import replace

import pytest
from follow_kit import ROS2_CMAKE, ROS2_HEAD, explicit, follow, names, types, well_formed

from haros_ci.model.architecture import Architecture, Node
from haros_ci.systems.ros2_library import METHODS, USER

CMAKE = ROS2_CMAKE.format("p") + "ament_auto_add_library(tools SHARED src/tools.cpp)\n"
END = "ament_auto_package()\n"
PUB = "create_publisher<String>(%s, 1);"


def built(header: str, source: str = "", cmake: str = "", **others: str) -> Architecture:
    """A package whose library has this public header and source; *others* are sources, ``__`` for a dot."""
    files = {f"p/src/{name.replace('__', '.')}": text for name, text in others.items()}
    return follow(
        {
            "p/CMakeLists.txt": CMAKE + cmake + END,
            "p/include/p/tools.hpp": ROS2_HEAD + header,
            "p/src/tools.cpp": "#include <p/tools.hpp>\n" + source,
            **files,
        },
        2,
    )


def told(found: Architecture) -> list[str]:
    """The configurations of libraries."""
    return sorted(each.name for each in found.configurations if each.name.endswith(" (library)"))


def brought(found: Architecture) -> Node:
    """The node of whoever uses the only class of a library."""
    (one,) = [each for each in found.configurations if each.name.endswith(" (library)")]
    assert {node.kind for node in one.nodes} == {"library"}
    for node in one.nodes:
        well_formed(replace(node, endpoints=tuple(end for end in node.endpoints if not end.implicit)))
    return one.nodes[0]


def made_by(constructor: str, before: str = "", members: str = "") -> Node:
    """What the class ``Tool`` with this constructor, written in its class, brings."""
    return brought(built(f"{before}\nclass Tool {{ public:\n{constructor}\n{members}\n}};\n"))


def test_names_in_the_node_of_whoever_uses_the_class() -> None:
    found = built(
        "namespace p { class Tool { public: Tool(const rclcpp::Node::SharedPtr & node, const std::string & prefix,"
        ' const std::string & last = "end"); rclcpp::Node::SharedPtr node_; }; }',
        "namespace p { Tool::Tool(const rclcpp::Node::SharedPtr & n, const std::string & prefix, const std::string & last)"
        " : node_(n) {\n"
        + "".join("node_->" + PUB % name for name in ('"a"', '"/b"', '"~/c"', "prefix", "last"))
        + "}}",
    )
    assert told(found) == ["p/p::Tool (library)"]
    node = brought(found)
    assert (node.name, node.package, node.type, node.class_name) == ("/?", "p", "p::Tool", "p::Tool")
    assert ("name", USER) in [(unknown.field, unknown.reason) for unknown in node.unknowns]
    assert sorted(end.name for end in explicit(node)) == ["/?", "/?/c", "/a", "/b", "/end"]
    assert {end.type for end in explicit(node)} == {"std_msgs/msg/String"}
    reasons = {
        end.name: [unknown.reason for unknown in end.unknowns if unknown.field == "name"] for end in node.endpoints
    }
    assert (
        reasons["/?/c"] == [USER]
        and reasons["/a"] == []
        and reasons["/?"] == ["an argument that is given from outside"]
    )
    assert [end for end in node.endpoints if end.implicit] == []


@pytest.mark.parametrize(
    ("parameter", "body"),
    [
        ("rclcpp::Node * node", "node->"),
        ("rclcpp::Node & node", "node."),
        ("std::shared_ptr<rclcpp::Node> node", "node->"),
        ("const rclcpp::Node::WeakPtr & parent", "auto node = parent.lock(); node->"),
        ("rclcpp_lifecycle::LifecycleNode::SharedPtr node", "node->"),
        ("rclcpp_lifecycle::LifecycleNode::WeakPtr parent", "auto node = parent.lock(); node->"),
    ],
)
def test_how_a_node_is_taken(parameter: str, body: str) -> None:
    node = made_by(f'explicit Tool({parameter}) {{ {body}create_publisher<String>("a", 1); }}')
    assert names(node) == ["/a"]


def test_templates_over_nodes() -> None:
    one = made_by(
        'template<typename NodeT> explicit Tool(NodeT node) { node->template create_publisher<String>("a", 1); }'
    )
    other = brought(
        built(
            "template<class NodeT> class Tool { public:\n"
            'Tool(int, NodeT & node) { node.template create_publisher<String>("a", 1); }\n};\n'
        )
    )
    assert names(one) == names(other) == ["/a"]


def test_other_template_parameters_stand_for_nothing_that_is_known() -> None:
    node = made_by(
        "template<typename NodeT, class Other> Tool(NodeT & node, Other other) {\n"
        'node.template create_publisher<Message>("a", 1); node.template create_publisher<Other>("b", 1);\n'
        'node.template create_publisher<String>("c", 1); }',
        "using Message = std_msgs::msg::Bool; using Other = std_msgs::msg::Bool; class NodeT {};\ntemplate<class Message>",
    )
    assert types(node) == [("/a", None), ("/b", None), ("/c", "std_msgs/msg/String")]


def test_parts_of_a_node() -> None:
    node = made_by(
        "Tool(rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr topics,"
        " rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parameters) {\n"
        'rclcpp::create_publisher<String>(parameters, topics, "a", 1); }'
    )
    assert names(node) == ["/a"]


def test_of_several_constructors_the_one_of_which_most_is_known() -> None:
    node = made_by(
        "Tool(const rclcpp::Node::SharedPtr & node, const Names & names) {"
        " node->create_publisher<String>(names.first, 1); }\n"
        'Tool(const rclcpp::Node::SharedPtr & node, const std::string & group, const std::string & x = "b")'
        " : Tool(node, Names(group, x)) {}",
        'struct Names { Names(std::string group, std::string x) : first("a/" + x), group(group) {}'
        " std::string first; std::string group; };",
    )
    assert names(node) == ["/a/b"]


def test_a_constructor_that_nobody_uses_yet() -> None:
    found = built(
        "class Tool { public:\n"
        'explicit Tool(rclcpp::Node & node) { node.create_publisher<String>("a", 1); }\n'
        'Tool(rclcpp::Node & node, int) { node.create_publisher<String>("b", 1); }\n};\n',
        cmake="ament_auto_add_executable(n src/n.cpp)\n",
        n__cpp='#include <p/tools.hpp>\nint main() { rclcpp::Node node("n"); Tool tool(node); }\n',
    )
    assert told(found) == ["p/Tool (library)"]
    assert names(brought(found)) == ["/b"]


def test_a_method_that_takes_the_node() -> None:
    node = brought(
        built(
            'class Tool { public: Tool() : name_("a") {}\n'
            "void initialize(const rclcpp::Node::SharedPtr & node);\nstd::string name_; };",
            "void Tool::initialize(const rclcpp::Node::SharedPtr & node) { node->create_publisher<String>(name_, 1); }",
        )
    )
    assert names(node) == ["/a"]


def test_a_node_of_its_own() -> None:
    node = brought(
        built(
            'class Tool { public: explicit Tool(const std::string & space = ""); class Impl; Impl * impl_; };',
            "class Tool::Impl { public: explicit Impl(const std::string & space) {\n"
            'node_ = std::make_shared<rclcpp::Node>("helper", space); node_->create_publisher<String>("a", 1); }\n'
            "rclcpp::Node::SharedPtr node_; };\n"
            "Tool::Tool(const std::string & space) { impl_ = new Impl(space); }",
        )
    )
    assert (node.name, [end.name for end in explicit(node)]) == ("/helper", ["/a"])
    assert [end.name for end in node.endpoints if end.implicit and end.name == "/rosout"] == ["/rosout"]


def test_a_node_that_nobody_makes() -> None:
    node = brought(
        built(
            "class Tool : public rclcpp::Node { public:\n"
            'Tool(const std::string & name, const rclcpp::NodeOptions & options) : rclcpp::Node(name, "s", options) {'
            ' create_publisher<String>("a", 1); }\n};\n'
        )
    )
    assert (node.name, [end.name for end in explicit(node)]) == ("/s/?", ["/s/a"])


def test_a_node_class_of_the_workspace_as_a_base() -> None:
    found = built(
        "class Base : public rclcpp::Node { public: explicit Base(const std::string & name) : rclcpp::Node(name) {}\n"
        'int rate(const std::string & name) { return declare_parameter(name + ".rate", 5); } };\n'
        'class Tool { public: explicit Tool(Base * node) { node->rate("x"); node->create_publisher<String>("a", 1); } };\n',
        cmake="ament_auto_add_executable(n src/n.cpp)\n",
        n__cpp='#include <p/tools.hpp>\nclass N : public Base { public: N() : Base("n") {} };\nint main() { N node; }\n',
    )
    node = brought(found)
    assert (node.type, names(node)) == ("Tool", ["/a"])
    assert [(end.name, end.value, end.effective) for end in explicit(node, "parameters")] == [("/?:x.rate", 5, 5)]


def test_what_depends_on_arguments() -> None:
    node = made_by(
        "Tool(rclcpp::Node & node, bool is_second, bool is_third = false) {\n"
        'if (is_second) { node.create_publisher<String>("b", 1); }\n'
        'if (is_third) { node.create_publisher<String>("c", 1); }\n'
        "}"
    )
    assert [(end.name, [c.condition for c in end.conditions]) for end in explicit(node)] == [
        ("/b", ["is_second"]),
        ("/c", ["is_third"]),
    ]


def test_parameters_that_the_class_does_not_declare_may_have_any_value() -> None:
    node = made_by(
        "explicit Tool(rclcpp::Node & node) {\n"
        'std::string one = node.declare_parameter("one", std::string("a")), other = "b";\n'
        'node.get_parameter_or("other", other, std::string("c"));\n'
        "node.create_publisher<String>(one, 1); node.create_publisher<String>(other, 1);\n}"
    )
    assert sorted(end.name for end in explicit(node)) == ["/?", "/a"]


def test_callbacks_are_followed_and_methods_are_not() -> None:
    node = made_by(
        "explicit Tool(rclcpp::Node * node) : node_(node) {\n"
        'sub_ = node->create_subscription<String>("in", 1, [this](const String &) { start(); }); }\n'
        'void start() { node_->create_publisher<String>("out", 1); }',
        members="rclcpp::Node * node_; rclcpp::Subscription<String>::SharedPtr sub_;",
    )
    assert (names(node, "subscribers"), names(node)) == (["/in"], ["/out"])
    assert METHODS not in [unknown.reason for unknown in node.unknowns]
    other = made_by(
        'explicit Tool(rclcpp::Node * node) : node_(node) { node->create_publisher<String>("a", 1); }\n'
        'void start() { node_->create_publisher<String>("out", 1); }',
        members="rclcpp::Node * node_;",
    )
    assert names(other) == ["/a"]
    assert METHODS in [unknown.reason for unknown in other.unknowns if unknown.field == "endpoints"]


def test_nodes_of_libraries_beside_the_one_that_is_given() -> None:
    found = built(
        "#include <tf2_ros/transform_listener.h>\nclass Tool { public: explicit Tool(rclcpp::Node & node) :"
        ' buffer_(node.get_clock()), listener_(buffer_) { node.create_publisher<String>("a", 1); }\n'
        "tf2_ros::Buffer buffer_; tf2_ros::TransformListener listener_; };"
    )
    (one,) = [each for each in found.configurations if each.name == "p/Tool (library)"]
    assert (one.nodes[0].name, names(one.nodes[0])) == ("/?", ["/a"])
    assert [sorted(names(node, "subscribers"))[-2:] for node in one.nodes[1:]] == [["/tf", "/tf_static"]]


MAIN = 'int main() { rclcpp::Node node("n"); }'
QUIET = {
    "made by a process": (
        'class Tool { public: explicit Tool(rclcpp::Node & node) { node.create_publisher<String>("a", 1); } };',
        'int main() { rclcpp::Node node("n"); Tool tool(node); }',
    ),
    "made of what processes make": (
        'class Part { public: explicit Part(rclcpp::Node & node) { node.create_publisher<String>("a", 1); } };\n'
        "class Tool { public: explicit Tool(rclcpp::Node & node) : part_(node) {}\nPart part_; };",
        'int main() { rclcpp::Node node("n"); Part part(node); }',
    ),
    "nothing is made": (
        "class Tool { public: explicit Tool(rclcpp::Node & node) : n_(&node) {}\nrclcpp::Node * n_; };",
        "",
    ),
    "inside another class": (
        "class Outer { public:\nclass Tool { public: explicit Tool(rclcpp::Node & node) {"
        ' node.create_publisher<String>("a", 1); } };\n};',
        "",
    ),
    "for one node of the workspace": (
        'class N : public rclcpp::Node { public: N() : rclcpp::Node("n") {} };\n'
        'class Tool { public: explicit Tool(N & node) { node.create_publisher<String>("a", 1); } };',
        "int main() { N node; }",
    ),
    "a base class of a node": (
        'class Tool : public rclcpp::Node { public: explicit Tool(int) : rclcpp::Node("t") {'
        ' create_publisher<String>("a", 1); }\nexplicit Tool(std::string name) : rclcpp::Node(name) {} };',
        'class N : public Tool { public: N() : Tool("n") {} };\nint main() { N node; }',
    ),
    "a node that it gets from elsewhere": (
        "rclcpp::Node::SharedPtr shared_node();\n"
        'class Tool { public: Tool() { shared_node()->create_publisher<String>("a", 1); } };',
        "",
    ),
    "nothing is known of it": (
        "template<class ServiceT> class Tool { public: Tool(rclcpp::Node & node, const std::string & name) {"
        " node.create_client<ServiceT>(name); } };",
        "",
    ),
    "no node among its arguments": (
        "struct Graph { struct Node { int id; }; };\nclass Tool { public: explicit Tool(Graph::Node & node) { id = node.id; }\nint id; };",
        "",
    ),
    "declared only": ("class Tool { public: explicit Tool(rclcpp::Node & node); };", ""),
}


@pytest.mark.parametrize(("header", "main"), QUIET.values(), ids=QUIET)
def test_what_is_not_for_others(header: str, main: str) -> None:
    text = f"#include <p/tools.hpp>\n{main or MAIN}\n"
    assert told(built(header, cmake="ament_auto_add_executable(n src/n.cpp)\n", n__cpp=text)) == []


TOOL = 'class Tool { public: explicit Tool(rclcpp::Node & node) { node.create_publisher<String>("a", 1); } };\n'


@pytest.mark.parametrize(
    ("use", "expected"),
    (
        ("Tool tool(node);", []),
        ("if (outside()) { Tool tool(node); }", []),
        ("const bool on = false; if (on) { Tool tool(node); }", ["p/Tool (library)"]),
        ("const bool on = false; if (on) { Tool tool(node); } Tool other(node);", []),
        ("const bool on = true; if (on) { Tool tool(node); }", []),
    ),
)
def test_what_a_process_makes_under_other_arguments_only_is_made_by_none(use: str, expected: list[str]) -> None:
    text = f'#include <p/tools.hpp>\nint main(int argc, char ** argv) {{ rclcpp::Node node("n"); {use} }}\n'
    assert told(built(TOOL, cmake="ament_auto_add_executable(n src/n.cpp)\n", n__cpp=text)) == expected


@pytest.mark.parametrize(
    "path",
    ["p/src/tools.hpp", "p/test/include/p/tools.hpp", "p/examples/include/tools.hpp", "p_tests/include/p/tools.hpp"],
)
def test_headers_that_are_not_for_others(path: str) -> None:
    package = path.partition("/")[0]
    files = {f"{package}/CMakeLists.txt": ROS2_CMAKE.format(package) + END, path: ROS2_HEAD + TOOL}
    assert told(follow(files, 2)) == []
    assert told(follow({**files, f"{package}/include/p/more.hpp": ROS2_HEAD + TOOL.replace("Tool", "More")}, 2)) == (
        ["p/More (library)"] if package == "p" else []
    )


def test_code_that_no_library_has() -> None:
    header = "class Tool { public: explicit Tool(rclcpp::Node & node); };\n"
    source = 'Tool::Tool(rclcpp::Node & node) { node.create_publisher<String>("a", 1); }\n'
    assert told(built(header, source)) == ["p/Tool (library)"]
    text = f"#include <p/tools.hpp>\n{source}"
    assert told(built(header, cmake="ament_auto_add_executable(n src/n.cpp)\n", n__cpp=text + "int main() {}\n")) == []
    assert told(built(header, n__cpp=text)) == []


def test_components_and_plug_ins_have_configurations_of_their_own() -> None:
    node = (
        'class N : public rclcpp::Node { public: explicit N(const rclcpp::NodeOptions & o) : rclcpp::Node("n", o) {'
        ' create_publisher<String>("a", 1); } };\n'
    )
    found = built(node, cmake='rclcpp_components_register_node(tools PLUGIN "N" EXECUTABLE n)\n')
    assert [each.name for each in found.configurations] == ["p/n"]
    plugin = (
        "namespace core { class Task { public: virtual void initialize(rclcpp::Node * node) = 0; }; }\n"
        "class Quick : public core::Task { public: void initialize(rclcpp::Node * node) override {"
        ' node->create_publisher<String>("a", 1); } };\n'
    )
    xml = '<library path="tools"><class name="p/Quick" type="Quick" base_class_type="core::Task"/></library>'
    files = {
        "p/CMakeLists.txt": CMAKE + "pluginlib_export_plugin_description_file(p plugins.xml)\n" + END,
        "p/plugins.xml": xml,
        "p/include/p/tools.hpp": ROS2_HEAD + plugin,
        "p/src/tools.cpp": "#include <p/tools.hpp>\n",
    }
    assert told(follow(files, 2)) == []


def test_ros_1_has_none() -> None:
    text = '#include <ros/ros.h>\nclass Tool { public: explicit Tool(ros::NodeHandle & node) { node.advertise<A>("a", 1); } };\n'
    cmake = "project(p)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    assert told(follow({"p/CMakeLists.txt": cmake, "p/include/p/tools.hpp": text}, 1)) == []


SETUP = 'from setuptools import setup\nsetup(name="p", packages=["p"], entry_points={"console_scripts": [%s]})\n'
IMPORTS = "from abc import ABC\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"


def python(text: str, points: str = "", path: str = "p/p/tools.py", **others: str) -> Architecture:
    more = {f"p/p/{name}.py": content for name, content in others.items()}
    return follow({"p/setup.py": SETUP % points, "p/p/__init__.py": "", path: IMPORTS + text, **more}, 2)


@pytest.mark.parametrize("parameter", ["node", "node: Node", "node: rclpy.node.Node", 'node: "Node"', "parent_node"])
def test_python_classes(parameter: str) -> None:
    name = parameter.partition(":")[0]
    found = python(
        f"class Tool:\n    def __init__(self, {parameter}, last='end'):\n        self.node = {name}\n"
        "        self.node.create_publisher(String, 'a/' + last, 1)\n"
    )
    assert told(found) == ["p/p.tools.Tool (library)"]
    assert types(brought(found)) == [("/a/end", "std_msgs/msg/String")]


def test_python_nodes_that_nobody_makes() -> None:
    text = (
        "class Base(ABC, Node):\n    def __init__(self, topic, name='base'):\n        super().__init__(name)\n"
        "        self.create_subscription(String, 'in', self.heard, 1)\n        self.create_publisher(String, topic, 1)\n"
    )
    node = brought(python(text))
    assert (node.name, names(node, "subscribers")) == ("/base", ["/in"])
    assert [end.name for end in explicit(node)] == ["/?"]
    derived = text + "class Own(Base):\n    def __init__(self):\n        super().__init__('out', 'own')\n"
    assert told(python(derived)) == ["p/p.tools.Own (library)"]


PYTHON_TOOL = "class Tool:\n    def __init__(self, node):\n        node.create_publisher(String, 'a', 1)\n"


def test_python_classes_that_are_not_for_others() -> None:
    main = "def main():\n    rclpy.init()\n    Tool(rclpy.create_node('n'))\n"
    assert told(python(PYTHON_TOOL + main, '"n = p.tools:main"')) == []
    assert told(python(PYTHON_TOOL, path="p/test/tools.py")) == []
    assert told(python(PYTHON_TOOL, path="p/p/test_tools.py")) == []
    assert told(python(PYTHON_TOOL, path="p/scripts/tools.py")) == []
    assert told(python(PYTHON_TOOL, path="p/launch/tools.launch.py")) == []
    assert told(python("class Tool:\n    def __init__(self, node):\n        self.children = node.children\n")) == []
    assert told(python(PYTHON_TOOL.replace("node", "graph"))) == []
    assert told(python(PYTHON_TOOL)) == ["p/p.tools.Tool (library)"]


def test_what_only_the_program_of_a_module_does_is_not_of_its_classes() -> None:
    main = (
        "def main():\n    rclpy.init()\n    node = rclpy.create_node('other')\n    node.create_publisher(String, 'b', 1)\n"
        "if __name__ == '__main__':\n    main()\n"
    )
    (one,) = [each for each in python(PYTHON_TOOL + main).configurations if each.name.endswith(" (library)")]
    assert [end.name for node in one.nodes for end in node.endpoints if end.name.endswith("b")] == []
    assert len(one.nodes) == 1
