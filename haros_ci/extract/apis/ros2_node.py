# SPDX-License-Identifier: Apache-2.0
"""Nodes (ROS 2, C++): rclcpp and lifecycle nodes, their options, sub-nodes and interfaces, spinning.

The interfaces of a node stand for the node itself.
"""

from __future__ import annotations

from collections.abc import Mapping

#: rclcpp/node_interfaces
INTERFACES = (
    "base",
    "clock",
    "graph",
    "logging",
    "parameters",
    "services",
    "time_source",
    "timers",
    "topics",
    "type_descriptions",
    "waitables",
)
#: rclcpp/node_options.hpp: methods that set and get what is called like them; what is not set has its default.
OPTIONS = (
    "use_global_arguments",
    "enable_rosout",
    "use_intra_process_comms",
    "enable_topic_statistics",
    "start_parameter_services",
    "start_parameter_event_publisher",
    "enable_logger_service",
    "use_clock_thread",
    "allow_undeclared_parameters",
    "automatically_declare_parameters_from_overrides",
    "arguments",
    "parameter_overrides",
    "clock_qos",
    "parameter_event_qos",
    "rosout_qos",
    "parameter_event_publisher_options",
    "clock_type",
    "context",
    "allocator",
)
#: Executors and what they are called with.
EXECUTORS = (
    "SingleThreadedExecutor",
    "MultiThreadedExecutor",
    "StaticSingleThreadedExecutor",
    "EventsExecutor",
    "EventsCBGExecutor",
)
EXECUTOR_METHODS = [
    "add_node",
    "remove_node",
    "add_callback_group",
    "remove_callback_group",
    "spin",
    "spin_some",
    "spin_once",
    "spin_all",
    "spin_node_some",
    "spin_node_once",
    "spin_until_future_complete",
    "cancel",
    "is_spinning",
    "get_number_of_threads",
]
#: rclcpp/utilities.hpp, rclcpp/executors.hpp: these make nothing.
QUIET = [
    "init",
    "shutdown",
    "uninstall_signal_handlers",
    "install_signal_handlers",
    "on_shutdown",
    "spin",
    "spin_some",
    "spin_all",
    "spin_until_future_complete",
    "sleep_for",
    "ok",
]
OPTION = "rclcpp::NodeOptions"


def _node(args: list[int], when: dict[str, str], lifecycle: bool, **entry: str) -> list[dict[str, object]]:
    """A node's constructor, also as ``make_shared``."""
    owner = "rclcpp_lifecycle::LifecycleNode" if lifecycle else "rclcpp::Node"
    makes = [{"kind": "node", "name": "{0}", **entry, **({"lifecycle": True} if lifecycle else {})}]
    row: dict[str, object] = {"args": args, "makes": makes, **({"when": when} if when else {})}
    makers = [{**row, "call": f"{owner}::{maker}", "returns": owner} for maker in ("make_shared", "make_unique")]
    return [{**row, "call": owner}, *makers]


# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # rclcpp/node.hpp: a name, perhaps a namespace, perhaps options.
    *_node([1], {}, False),
    *_node([2], {"1": OPTION}, False, options="{1}"),
    *_node([2], {}, False, namespace="{1}"),
    *_node([3], {}, False, namespace="{1}", options="{2}"),
    {"call": "rclcpp::Node::create_sub_node", "args": [1],
     "makes": [{"kind": "node", "parent": "{this}", "namespace": "{0}"}], "returns": "rclcpp::Node"},

    # rclcpp_lifecycle/lifecycle_node.hpp: as a node, with whether its services are offered; what it does on
    # transitions, a framework calls.
    {"class": "rclcpp_lifecycle::LifecycleNode",
     "bases": ["rclcpp::Node", "rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface"],
     "entry": ["on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error"]},
    *_node([1], {}, True),
    *_node([2, 3], {"1": OPTION}, True, options="{1}"),
    *_node([2], {}, True, namespace="{1}"),
    *_node([3, 4], {}, True, namespace="{1}", options="{2}"),
    *({"call": f"rclcpp_lifecycle::LifecycleNode::register_{name}", "args": [1], "calls": ["0"]}
      for name in ("on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error")),
    *({"call": f"rclcpp_lifecycle::LifecycleNode::{name}", "args": [0, 1], "returns": "rclcpp_lifecycle::State"}
      for name in ("configure", "activate", "deactivate", "cleanup", "shutdown", "get_current_state")),
    {"call": "rclcpp_lifecycle::LifecycleNode::trigger_transition", "args": [1, 2],
     "returns": "rclcpp_lifecycle::State"},
    *({"call": f"rclcpp_lifecycle::LifecycleNode::{name}", "args": [1]}
      for name in ("add_managed_entity", "add_timer_handle", "on_activate", "on_deactivate")),
    *({"call": f"rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::{name}", "args": [1]}
      for name in ("on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error")),
    {"class": "rclcpp_lifecycle::LifecyclePublisher", "bases": ["rclcpp::Publisher"]},

    # rclcpp/node.hpp: names, and what stands for the node.
    {"call": "rclcpp::Node::get_name", "args": [0], "returns": "{node.base_name}"},
    {"call": "rclcpp::Node::get_namespace", "args": [0], "returns": "{node.namespace}"},
    {"call": "rclcpp::Node::get_fully_qualified_name", "args": [0], "returns": "{node.name}"},
    {"call": "rclcpp::Node::get_sub_namespace", "args": [0], "returns": "{node.sub_namespace}"},
    {"call": "rclcpp::Node::get_effective_namespace", "args": [0], "returns": "{node.effective_namespace}"},
    {"call": "rclcpp::expand_topic_or_service_name", "args": [3, 4], "returns": "{expand(0,1,2)}"},
    {"call": "rclcpp::Node::resolve_topic_name", "args": [1, 2], "returns": "{resolve(0,1)}"},
    {"call": "rclcpp::Node::resolve_service_name", "args": [1, 2], "returns": "{resolve(0,1)}"},
    {"call": "rclcpp::Node::resolve_topic_or_service_name", "args": [2, 3], "returns": "{resolve(0,2)}"},
    *({"call": f"rclcpp::Node::{name}", "args": [0], "transparent": "{this}"}
      for name in ("shared_from_this", "weak_from_this", "lock")),
    *({"call": f"rclcpp::Node::get_node_{name}_interface", "args": [0], "transparent": "{this}"}
      for name in INTERFACES),
    *({"call": f"rclcpp::node_interfaces::get_node_{name}_interface", "args": [1], "transparent": "{0}"}
      for name in INTERFACES),
    *({"class": f"rclcpp::node_interfaces::Node{''.join(word.title() for word in name.split('_'))}Interface",
       "bases": ["rclcpp::Node"]} for name in INTERFACES),
    {"class": "rclcpp::node_interfaces::NodeInterfaces", "bases": ["rclcpp::Node"]},
    {"call": "rclcpp::node_interfaces::NodeInterfaces", "args": [1], "fills": {"node": "{0}"}},
    {"call": "rclcpp::Node::get_node_options", "args": [0], "returns": "{node.options}"},
    {"call": "rclcpp::Node::get_logger", "args": [0], "returns": "rclcpp::Logger"},
    {"call": "rclcpp::Node::get_clock", "args": [0], "returns": "rclcpp::Clock"},
    {"call": "rclcpp::Node::now", "args": [0], "returns": "rclcpp::Time"},
    {"call": "rclcpp::Node::create_callback_group", "args": [1, 2], "returns": "rclcpp::CallbackGroup"},
    {"call": "rclcpp::Node::get_graph_event", "args": [0], "returns": "rclcpp::Event"},
    *({"call": f"rclcpp::Node::{name}", "args": [1]}
      for name in ("count_publishers", "count_subscribers", "count_clients", "count_services")),

    # rclcpp/node_options.hpp
    {"call": OPTION, "args": [0, 1]},
    *({"call": f"{OPTION}::{name}", "args": [1], "fills": {name: "{0}"}, "transparent": "{this}"} for name in OPTIONS),
    *({"call": f"{OPTION}::{name}", "args": [0], "returns": f"{{this.{name}}}"} for name in OPTIONS),
    {"call": f"{OPTION}::append_parameter_override", "args": [2],
     "fills": {"appended_name": "{0}", "appended_value": "{1}"}, "transparent": "{this}"},

    # rclcpp/executors.hpp, rclcpp/utilities.hpp, rclcpp/rate.hpp, rclcpp/clock.hpp
    *({"call": f"rclcpp::{name}", "args": [0, 1, 2, 3, 4, 5]} for name in QUIET),
    *({"class": f"rclcpp::executors::{name}", "bases": ["rclcpp::Executor"]} for name in EXECUTORS),
    *({"class": f"rclcpp::experimental::executors::{name}", "bases": ["rclcpp::Executor"]} for name in EXECUTORS),
    *({"call": f"rclcpp::Executor::{name}", "args": [0, 1, 2, 3, 4]} for name in EXECUTOR_METHODS),
    # The period of a rate is the rate itself here: whoever asks for a duration finds its frequency.
    *({"call": f"rclcpp::{name}", "args": [1], "makes": [{"kind": "rate", "frequency": "{0}"}],
       "fills": {"frequency": "{0}"}} for name in ("Rate", "WallRate")),
    *({"call": f"rclcpp::{name}::sleep", "args": [0]} for name in ("Rate", "WallRate")),
    *({"call": f"rclcpp::{name}::period", "args": [0], "transparent": "{this}"} for name in ("Rate", "WallRate")),
    {"call": "rclcpp::get_logger", "args": [1], "returns": "rclcpp::Logger"},
)
