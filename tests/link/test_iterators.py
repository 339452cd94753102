# SPDX-License-Identifier: Apache-2.0
"""Iterators of lists and maps: loops over what is known, ``find``; what stays unknown."""

from __future__ import annotations

from follow_kit import ROS2_CMAKE, ROS2_HEAD, ends, follow


def names(body: str, before: str = "") -> list[str]:
    """The names of the publishers that a program makes whose ``main`` has a *node* and this body."""
    cmake = ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
    main = (
        "void topic(rclcpp::Node & node, const std::string & name) "
        "{ node.create_publisher<std_msgs::msg::String>(name, 1); }\n"
        'int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::Node node("n");\n'
        'std::vector<std::string> names{"a", "b"}; std::map<std::string, std::string> map; map["k"] = "x"; map["l"] = "y";\n'
    )
    text = ROS2_HEAD + before + main + body + "}"
    found = follow({"p/CMakeLists.txt": cmake, "p/src/n.cpp": text}, 2)
    nodes = [node for each in found.configurations for node in each.nodes]
    return sorted(end.name for node in nodes for end in ends(node, "publishers") if not end.implicit)


def test_loops_with_iterators() -> None:
    loop = "for (auto it = names.{}; it != names.{}; {}) topic(node, {});"
    assert names(loop.format("begin()", "end()", "++it", "*it")) == ["/a", "/b"]
    assert names(loop.format("cbegin()", "cend()", "it++", "*it")) == ["/a", "/b"]
    assert names(loop.format("begin() + 1", "end()", "++it", "it->c_str()")) == ["/b"]
    assert names("auto it = names.begin(); while (it != names.end()) { topic(node, *it); ++it; }") == ["/a", "/b"]
    assert names("for (auto it = names.end(); it != names.begin();) { --it; topic(node, *it); }") == ["/a", "/b"]


def test_loops_over_pointers_and_maps() -> None:
    before = (
        "struct One { explicit One(std::string n) : name(n) {} virtual ~One() {}\n"
        "  virtual void start(rclcpp::Node & node) { node.create_publisher<std_msgs::msg::String>(name, 1); }\n"
        "  std::string name; };\n"
        "struct Two : One { explicit Two(std::string n) : One(n) {}\n"
        "  void start(rclcpp::Node & node) override { node.create_publisher<std_msgs::msg::String>(name + 2, 1); } };\n"
    ).replace("name + 2", 'name + "2"')
    fill = 'std::vector<std::shared_ptr<One>> all; all.push_back(std::make_shared<One>("o")); all.push_back(std::make_shared<Two>("t"));'
    body = (
        fill
        + "std::vector<std::shared_ptr<One>> * them = &all;\n"
        + (
            "for (std::vector<std::shared_ptr<One>>::iterator it = them->begin(); it != them->end(); ++it) (*it)->start(node);"
        )
    )
    assert names(body, before) == ["/o", "/t2"]
    over = "for (auto it = map.begin(); it != map.end(); ++it) topic(node, it->first + it->second);"
    assert names(over) == ["/kx", "/ly"]


def test_find_in_a_map() -> None:
    body = 'auto it = map.find("{}"); if (it != map.end()) topic(node, it->second); else topic(node, "none");'
    assert names(body.format("k")) == ["/none", "/x"]  # what is not taken is told, too
    assert names('auto it = map.find("z"); topic(node, it == map.end() ? "none" : "some");') == ["/none"]


def test_what_is_not_known() -> None:
    assert names("for (auto it = names.rbegin(); it != names.rend(); ++it) topic(node, *it);") == ["/?"]
    assert names(
        "names.push_back(argv[1]); for (auto it = names.begin(); it != names.end(); ++it) topic(node, *it);"
    ) == [
        "/?",
        "/a",
        "/b",
    ]
    assert names("auto it = map.find(argv[1]); topic(node, it->second);") == ["/?"]
    erased = "auto it = names.begin(); it = names.erase(it); topic(node, *it);"
    assert names(erased) == ["/?"]
    assert names("std::shuffle(names.begin(), names.end(), generator); topic(node, names[0]);") == ["/?"]
