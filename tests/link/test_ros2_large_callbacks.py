# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: large functions that callbacks call for one object after the other."""

from __future__ import annotations

from follow_kit import explicit, ros2_main

LONG = "  total = step(total);\n" * 900
NODE = """
int step(int before) { return before + 1; }
class Part {
public:
  void open(rclcpp_lifecycle::LifecycleNode * node, const std::string & name) {
    int total = 0;
LONG    pub_ = node->create_publisher<std_msgs::msg::String>(name, 1);
  }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
class Host : public rclcpp_lifecycle::LifecycleNode {
public:
  Host() : rclcpp_lifecycle::LifecycleNode("host") {}
  CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {
    one_.open(this, "one");
    two_.open(this, "two");
    three_.open(this, "three");
    return CallbackReturn::SUCCESS;
  }
  Part one_, two_, three_;
};
""".replace("LONG", LONG)


def test_what_has_made_something_is_followed_again() -> None:
    found = ros2_main("rclcpp::spin(std::make_shared<Host>()->get_node_base_interface());", NODE)
    assert sorted(end.name for end in explicit(found.nodes[0])) == ["/one", "/three", "/two"]
