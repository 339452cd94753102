# SPDX-License-Identifier: Apache-2.0
"""Navigation's wrappers (ROS 2, C++): nav2_ros_common and before it nav2_util, where they are not in the workspace.

nav2's node takes the callback before the quality of service, which is by default the last ten, reliable.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

NODE = "nav2::LifecycleNode"
OPTION = "rclcpp::NodeOptions"
TOPIC = "nav2::qos::StandardTopicQoS"
SERVICES = "rmw_qos_profile_services_default"
#: What parameters may override unless ``allow_parameter_qos_overrides`` says otherwise.
OVERRIDES = "depth,durability,history,reliability"
BOND = {"kind": "parameters", "name": "bond_disable_heartbeat_timeout", "type": "bool", "value": True}
DESCRIPTOR = "rcl_interfaces::msg::ParameterDescriptor"


def _node(
    owner: str, args: list[int], when: dict[str, str], makes: list[dict[str, Any]], **entry: str
) -> dict[str, Any]:
    node = {"kind": "node", "name": "{0}", "lifecycle": True, **entry}
    row: dict[str, Any] = {"call": owner, "args": args, "makes": [node, *makes]}
    return {**row, "when": when} if when else row


def _nodes(owner: str, makes: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [
        _node(owner, [1], {}, makes),
        _node(owner, [2], {"1": OPTION}, makes, options="{1}"),
        _node(owner, [2], {}, makes, namespace="{1}"),
        _node(owner, [3], {}, makes, namespace="{1}", options="{2}"),
    ]


def _interfaces(owner: str, at: int, **node: str) -> list[dict[str, Any]]:
    """Methods of the node (*at* 0), or functions in ``nav2::interfaces`` that are given it (*at* 1)."""

    def args(least: int, most: int) -> list[int]:
        return list(range(least + at, most + at + 1))

    name, second, third = f"{{{at}}}", at + 1, at + 2
    return [
        {
            "call": f"{owner}::create_subscription",
            "args": args(2, 4),
            "makes": [
                {
                    "kind": "subscribers",
                    "name": name,
                    "type": f"{{<0>|callback({second})}}",
                    "qos": f"{{{third}?{TOPIC}}}",
                    "options": OVERRIDES,
                    **node,
                }
            ],
            "calls": [str(second)],
            "returns": "rclcpp::Subscription",
            "fills": {"topic": f"{{resolve({at})}}"},
        },
        {
            "call": f"{owner}::create_publisher",
            "args": args(1, 3),
            "makes": [
                {
                    "kind": "publishers",
                    "name": name,
                    "type": "{<0>}",
                    "qos": f"{{{second}?{TOPIC}}}",
                    "options": OVERRIDES,
                    **node,
                }
            ],
            "returns": "rclcpp_lifecycle::LifecyclePublisher",
            "fills": {"topic": f"{{resolve({at})}}"},
        },
        {
            "call": f"{owner}::create_client",
            "args": args(1, 2),
            "makes": [{"kind": "clients", "name": name, "type": "{<0>}", "qos": SERVICES, **node}],
            "returns": "nav2::ServiceClient",
        },
        {
            "call": f"{owner}::create_service",
            "args": args(2, 3),
            "makes": [
                {"kind": "servers", "name": name, "type": f"{{<0>|callback({second},1)}}", "qos": SERVICES, **node}
            ],
            "calls": [str(second)],
            "returns": "nav2::ServiceServer",
        },
        {
            "call": f"{owner}::create_action_server",
            "args": args(2, 7),
            "makes": [{"kind": "action_servers", "name": name, "type": "{<0>}", **node}],
            "calls": [str(second), str(third), str(at + 3)],
            "returns": "nav2::SimpleActionServer",
        },
        {
            "call": f"{owner}::create_action_client",
            "args": args(1, 2),
            "makes": [{"kind": "action_clients", "name": name, "type": "{<0>}", **node}],
            "returns": "nav2::ActionClient",
        },
    ]


def _actions(owner: str) -> list[dict[str, Any]]:
    """A simple action server on a node or on its interfaces: ``name, execute, …``."""
    entry = {"kind": "action_servers", "type": "{<0>}", "namespace": "{0}"}
    return [
        {
            "call": owner,
            "args": list(range(3, 9)),
            "when": {"1": "string"},
            "makes": [{**entry, "name": "{1}"}],
            "calls": ["2", "3", "4"],
        },
        {
            "call": owner,
            "args": list(range(6, 13)),
            "when": {"4": "string"},
            "makes": [{**entry, "name": "{4}"}],
            "calls": ["5", "6", "7"],
        },
        {"call": owner, "args": list(range(7, 14)), "makes": [{**entry, "name": "{5}"}], "calls": ["6", "7", "8"]},
    ]


# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # nav2_ros_common/lifecycle_node.hpp
    {"class": NODE, "bases": ["rclcpp_lifecycle::LifecycleNode"]},
    *_nodes(NODE, [BOND, {"kind": "parameters", "name": "bond_heartbeat_period", "type": "double", "value": "0.25"},
                   {"kind": "parameters", "name": "autostart_node", "type": "bool", "value": False}]),
    *_interfaces(NODE, 0),
    {"call": f"{NODE}::declare_or_get_parameter", "args": [2], "when": {"1": DESCRIPTOR},
     "makes": [{"kind": "parameters", "name": "{0}", "type": "{typeof(<0>)}", "descriptor": "{1}"}],
     "returns": "{parameter}"},
    {"call": f"{NODE}::declare_or_get_parameter", "args": [2, 3],
     "makes": [{"kind": "parameters", "name": "{0}", "type": "{typeof(<0>|1)}", "value": "{1}",
                "descriptor": "{2}"}],
     "returns": "{parameter}"},
    {"call": f"{NODE}::declare_or_get_parameter", "args": [1],
     "makes": [{"kind": "parameters", "name": "{0}", "type": "{typeof(<0>)}"}], "returns": "{parameter}"},

    # nav2_ros_common/interface_factories.hpp, service_client.hpp, service_server.hpp, simple_action_server.hpp
    *_interfaces("nav2::interfaces", 1, namespace="{0}"),
    {"call": "nav2::ServiceClient", "args": [2, 3],
     "makes": [{"kind": "clients", "name": "{0}", "type": "{<0>}", "qos": SERVICES, "namespace": "{1}"}]},
    {"call": "nav2::ServiceServer", "args": [3, 4],
     "makes": [{"kind": "servers", "name": "{0}", "type": "{<0>}", "qos": SERVICES, "namespace": "{1}"}],
     "calls": ["2"]},
    *_actions("nav2::SimpleActionServer"),

    # nav2_ros_common/node_utils.hpp, nav2_util/node_utils.hpp
    *({"call": f"{space}::declare_or_get_parameter", "args": [2, 3], "when": {"2": DESCRIPTOR},
       "makes": [{"kind": "parameters", "name": "{1}", "type": "{typeof(<0>)}", "descriptor": "{2}",
                  "namespace": "{0}"}],
       "returns": "{parameter}"} for space in ("nav2", "nav2_util")),
    *({"call": f"{space}::declare_or_get_parameter", "args": [4, 5, 6, 7], "when": {"2": "string"},
       "makes": [{"kind": "parameters", "name": "{2}", "type": "{typeof(<0>|3)}", "value": "{3}",
                  "descriptor": "{6}", "namespace": "{1}"}],
       "returns": "{parameter}"} for space in ("nav2", "nav2_util")),
    *({"call": f"{space}::declare_or_get_parameter", "args": [2, 3, 4],
       "makes": [{"kind": "parameters", "name": "{1}", "type": "{typeof(<0>|2)}", "value": "{2}",
                  "descriptor": "{3}", "namespace": "{0}"}],
       "returns": "{parameter}"} for space in ("nav2", "nav2_util")),
    *({"call": f"{space}::declare_parameter_if_not_declared", "args": [3, 4], "when": {"2": "rclcpp::ParameterValue"},
       "makes": [{"kind": "parameters", "name": "{1}", "value": "{2.value}", "descriptor": "{3}",
                  "namespace": "{0}"}]} for space in ("nav2", "nav2_util")),
    *({"call": f"{space}::declare_parameter_if_not_declared", "args": [3, 4], "when": {"2": "rclcpp::ParameterType"},
       "makes": [{"kind": "parameters", "name": "{1}", "type": "{2}", "descriptor": "{3}", "namespace": "{0}"}]}
      for space in ("nav2", "nav2_util")),
    *({"call": f"{space}::declare_parameter_if_not_declared", "args": [3, 4],
       "makes": [{"kind": "parameters", "name": "{1}", "value": "{2}", "descriptor": "{3}", "namespace": "{0}"}]}
      for space in ("nav2", "nav2_util")),
    *({"call": f"{space}::get_plugin_type_param", "args": [2],
       "makes": [{"kind": "parameters", "name": "{1}.plugin", "type": "string", "namespace": "{0}"}],
       "returns": "{parameter}"} for space in ("nav2", "nav2_util")),

    # nav2_util (Foxy to Jazzy): lifecycle_node.hpp, service_client.hpp, simple_action_server.hpp
    {"class": "nav2_util::LifecycleNode", "bases": ["rclcpp_lifecycle::LifecycleNode"]},
    *_nodes("nav2_util::LifecycleNode", [BOND]),
    {"call": "nav2_util::ServiceClient", "args": [2, 3],
     "makes": [{"kind": "clients", "name": "{0}", "type": "{<0>}", "qos": SERVICES, "namespace": "{1}"}]},
    *_actions("nav2_util::SimpleActionServer"),
)
