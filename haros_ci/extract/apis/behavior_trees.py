# SPDX-License-Identifier: Apache-2.0
"""BehaviorTree.CPP (C++, of either ROS): the base classes of trees' nodes, and methods that ``link.behavior_trees`` models."""

from __future__ import annotations

from collections.abc import Mapping

#: behaviortree_cpp/action_node.h, condition_node.h, control_node.h, decorator_node.h and their library's own nodes that
#: others derive from (version 3 and 4).
BASES = (
    "LeafNode ActionNodeBase SyncActionNode AsyncActionNode ThreadedAction SimpleActionNode StatefulActionNode "
    "CoroActionNode ConditionNode SimpleConditionNode ControlNode DecoratorNode SimpleDecoratorNode SequenceNode "
    "FallbackNode ReactiveSequence ReactiveFallback ParallelNode InverterNode"
)
#: The methods that have a model, by class (behaviortree_cpp/bt_factory.h, blackboard.h, tree_node.h).
MODELLED = {
    "BT::BehaviorTreeFactory": "registerNodeType registerBuilder registerSimpleAction registerSimpleCondition "
    "registerSimpleDecorator registerFromPlugin registerFromROSPlugins registerBehaviorTreeFromFile "
    "registerBehaviorTreeFromText createTree createTreeFromFile createTreeFromText",
    "BT::Blackboard": "create get set rootBlackboard",
    "BT::TreeNode": "config name getInput setOutput",
    "BT::Expected": "value has_value",
}

# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    *({"class": f"BT::{name}", "bases": ["BT::TreeNode"]} for name in BASES.split()),
    *({"class": name} for name in MODELLED),
    *({"call": f"{name}::{method}", "args": list(range(9))}
      for name, methods in MODELLED.items() for method in methods.split()),

    # behaviortree_cpp/utils/shared_library.h: the name of a library's file.
    {"call": "BT::SharedLibrary::getOSName", "args": [1], "transparent": "{0}"},
)
# fmt: on
