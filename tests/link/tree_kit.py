# SPDX-License-Identifier: Apache-2.0
"""A program that creates behaviour trees, and the texts of trees."""

from __future__ import annotations

from follow_kit import ROS2_HEAD

HEAD = '#include "behaviortree_cpp/bt_factory.h"\n' + ROS2_HEAD
NODE = 'config().blackboard->get<rclcpp::Node::SharedPtr>("node")'
#: Publishes in its constructor what its port says, on the blackboard's node.
SAY = """
class Say : public BT::SyncActionNode {
public:
  Say(const std::string & name, const BT::NodeConfig & conf) : BT::SyncActionNode(name, conf) {
    std::string topic("unset");
    getInput("topic", topic);
    pub_ = NODE->create_publisher<std_msgs::msg::String>(topic, 1);
  }
  static BT::PortsList providedPorts() { return {%s}; }
  BT::NodeStatus tick() override { return BT::NodeStatus::SUCCESS; }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
""".replace("NODE", NODE)
PORT = 'BT::InputPort<std::string>("topic", "which topic")'
MAIN = """
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("host");
  BT::BehaviorTreeFactory factory;
  auto blackboard = BT::Blackboard::create();
  blackboard->set<rclcpp::Node::SharedPtr>("node", node);
  %s
}
"""
REGISTER = 'factory.registerNodeType<Say>("Say");\n'
FROM_TEXT = 'auto tree = factory.createTreeFromText(R"(%s)", blackboard);'
UNKNOWN = 'auto tree = factory.createTreeFromFile(node->declare_parameter<std::string>("tree"), blackboard);'


def tree(inside: str, name: str = "Main") -> str:
    return f'<root BTCPP_format="4"><BehaviorTree ID="{name}">{inside}</BehaviorTree></root>'
