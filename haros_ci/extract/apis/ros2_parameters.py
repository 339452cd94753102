# SPDX-License-Identifier: Apache-2.0
"""Parameters (ROS 2, C++): declaring, reading and setting them, their objects, and clients of other nodes' parameters.

``get_parameters`` with a prefix has no row: its arguments alone do not tell which parameters it reads.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

DESCRIPTOR = "rcl_interfaces::msg::ParameterDescriptor"
VALUE, PARAMETER = "rclcpp::ParameterValue", "rclcpp::Parameter"
#: rclcpp/parameter.hpp: what reads the value of a parameter.
READERS = [
    "as_bool",
    "as_int",
    "as_double",
    "as_string",
    "as_byte_array",
    "as_bool_array",
    "as_integer_array",
    "as_double_array",
    "as_string_array",
    "get_value",
    "get",
]
#: The services of a node's parameters (rclcpp/parameter_service.hpp).
SERVICES = (
    ("get_parameters", "GetParameters"),
    ("get_parameter_types", "GetParameterTypes"),
    ("set_parameters", "SetParameters"),
    ("set_parameters_atomically", "SetParametersAtomically"),
    ("list_parameters", "ListParameters"),
    ("describe_parameters", "DescribeParameters"),
)
#: Methods of a client that are called back.
ASKING = ["get_parameters", "describe_parameters", "get_parameter_types", "set_parameters", "set_parameters_atomically"]
NODE = "rclcpp::Node"


def _declared(args: list[int], when: dict[str, str], is_strict: bool = False, **entry: str) -> dict[str, object]:
    return {
        "call": f"{NODE}::declare_parameter",
        "args": args,
        **({"when": when} if when else {}),
        "makes": [{"kind": "parameters", "name": "{0}", **entry, **({"strict": True} if is_strict else {})}],
    }


def _clients(owner: str, args: list[int], node: int, remote: int, when: dict[str, str]) -> dict[str, object]:
    """A client of the parameters of the node that argument *remote* names, by default of its own."""
    qos = f"{{{remote + 1}?rmw_qos_profile_parameters}}"
    makes: list[dict[str, Any]] = [
        {
            "kind": "clients",
            "name": f"{{{remote}?~}}/{name}",
            "type": f"rcl_interfaces/srv/{kind}",
            "qos": qos,
            "namespace": f"{{{node}}}",
        }
        for name, kind in SERVICES
    ]
    row: dict[str, object] = {"call": owner, "args": args, "makes": makes, "fills": {"node": f"{{{node}}}"}}
    return {**row, "when": when} if when else row


# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # rclcpp/node.hpp: a name with a default, a type or a template argument, a descriptor, and whether overrides count.
    # A default ParameterValue, and a type, give a ParameterValue.
    {**_declared([2, 3, 4], {"1": VALUE}, type="{typeof(<0>)}", value="{1.value}", descriptor="{2}"),
     "returns": VALUE, "fills": {"value": "{parameter}"}},
    {**_declared([2, 3, 4], {"1": "rclcpp::ParameterType"}, type="{1}", descriptor="{2}"),
     "returns": VALUE, "fills": {"value": "{parameter}"}},
    {**_declared([2, 3], {"1": DESCRIPTOR}, True, type="{typeof(<0>)}", descriptor="{1}"), "returns": "{parameter}"},
    {**_declared([2, 3, 4], {}, type="{typeof(<0>|1)}", value="{1}", descriptor="{2}"), "returns": "{parameter}"},
    {**_declared([1], {}, True, type="{typeof(<0>)}"), "returns": "{parameter}"},
    {"call": f"{NODE}::list_parameters", "args": [2], "returns": "rcl_interfaces::msg::ListParametersResult",
     "fills": {"names": "{parameters(0,1)}", "prefixes": "{prefixes(0,1)}"}},
    {"call": f"{NODE}::declare_parameters", "args": [2, 3],
     "makes": [{"kind": "parameters", "name": "{0}.{item.name}", "type": "{typeof(<0>)}", "value": "{item.default}",
                "descriptor": "{item.descriptor}", "each": "keys(1)"}]},
    {"call": f"{NODE}::undeclare_parameter", "args": [1], "makes": [{"kind": "setters", "name": "{0}"}]},
    {"call": f"{NODE}::has_parameter", "args": [1], "returns": "{declared(0)}"},
    {"call": f"{NODE}::get_parameter", "args": [1], "makes": [{"kind": "getters", "name": "{0}", "strict": True}],
     "returns": PARAMETER, "fills": {"name": "{0}", "value": "{parameter}"}},
    {"call": f"{NODE}::get_parameter", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1)}"}], "sets": {"1": "{parameter}"},
     "returns": "{declared(0)}"},
    {"call": f"{NODE}::get_parameters", "args": [1],
     "makes": [{"kind": "getters", "each": "items(0)", "name": "{item.name}", "strict": True}],
     "returns": "{parameter}"},
    {"call": f"{NODE}::get_parameter_or", "args": [3],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1|2)}", "value": "{2}"}],
     "sets": {"1": "{parameter}"}, "returns": "{declared(0)}"},
    {"call": f"{NODE}::get_parameter_or", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1)}", "value": "{1}"}],
     "returns": "{parameter}"},
    {"call": f"{NODE}::set_parameter", "args": [1],
     "makes": [{"kind": "setters", "name": "{0.name}", "type": "{typeof(0.value)}", "value": "{0.value}"}],
     "returns": "rcl_interfaces::msg::SetParametersResult"},
    *({"call": f"{NODE}::{name}", "args": [1],
       "makes": [{"kind": "setters", "name": "{item.name}", "value": "{item.default}", "each": "items(0)"}]}
      for name in ("set_parameters", "set_parameters_atomically")),
    {"call": f"{NODE}::describe_parameter", "args": [1], "returns": DESCRIPTOR},
    *({"call": f"{NODE}::{name}", "args": [1], "calls": ["0"], "returns": "rclcpp::CallbackHandle"}
      for name in ("add_on_set_parameters_callback", "add_pre_set_parameters_callback",
                   "add_post_set_parameters_callback", "set_on_parameters_set_callback")),

    # rclcpp/parameter.hpp, rclcpp/parameter_value.hpp
    {"call": PARAMETER, "args": [2], "fills": {"name": "{0}", "value": "{1}"}},
    {"call": PARAMETER, "args": [1], "fills": {"name": "{0}"}},
    {"call": VALUE, "args": [1], "when": {"0": VALUE}, "fills": {"value": "{0.value}"}},
    {"call": VALUE, "args": [1], "fills": {"value": "{0}"}},
    {"call": f"{PARAMETER}::get_name", "args": [0], "returns": "{this.name}"},
    {"call": f"{PARAMETER}::get_parameter_value", "args": [0], "transparent": "{this}"},
    *({"call": f"{owner}::{name}", "args": [0], "returns": "{this.value}"}
      for owner in (PARAMETER, VALUE) for name in READERS),

    # rclcpp/parameter_client.hpp: a node or its interfaces, for the synchronous one perhaps after an executor.
    _clients("rclcpp::AsyncParametersClient", [2, 3, 4], 0, 1, {"1": "string"}),
    _clients("rclcpp::AsyncParametersClient", [1], 0, 1, {}),
    _clients("rclcpp::AsyncParametersClient", [4, 5, 6, 7], 0, 4, {}),
    _clients("rclcpp::SyncParametersClient", [2, 3], 0, 1, {"1": "string"}),
    _clients("rclcpp::SyncParametersClient", [1], 0, 1, {}),
    _clients("rclcpp::SyncParametersClient", [3, 4], 1, 2, {"2": "string"}),
    _clients("rclcpp::SyncParametersClient", [2], 1, 2, {}),
    _clients("rclcpp::SyncParametersClient", [5, 6, 7], 1, 5, {}),
    *({"call": f"rclcpp::AsyncParametersClient::{name}", "args": [1, 2], "calls": ["1"]} for name in ASKING),
    *({"call": f"{owner}::on_parameter_event", "args": [1, 2, 3],
       "makes": [{"kind": "subscribers", "name": "/parameter_events", "type": "rcl_interfaces/msg/ParameterEvent",
                  "qos": "{1?rmw_qos_profile_parameter_events}"}],
       "calls": ["0"], "returns": "rclcpp::Subscription"}
      for owner in ("rclcpp::AsyncParametersClient", "rclcpp::SyncParametersClient")),

    # rosidl_generator_cpp: setters of a message's members that return the message.
    *({"call": f"{DESCRIPTOR}::set__{member}", "args": [1], "fills": {member: "{0}"}, "transparent": "{this}"}
      for member in ("read_only", "dynamic_typing", "floating_point_range", "integer_range", "name", "description")),
    *({"call": f"{DESCRIPTOR}::set__{member}", "args": [1], "transparent": "{this}"}
      for member in ("type", "additional_constraints")),
    *({"call": f"rcl_interfaces::msg::{kind}::set__{member}", "args": [1], "fills": {member: "{0}"},
       "transparent": "{this}"}
      for kind in ("FloatingPointRange", "IntegerRange") for member in ("from_value", "to_value", "step")),

    # rclcpp/parameter_event_handler.hpp
    {"call": "rclcpp::ParameterEventHandler", "args": [1, 2],
     "makes": [{"kind": "subscribers", "name": "/parameter_events", "type": "rcl_interfaces/msg/ParameterEvent",
                "qos": "{1?rmw_qos_profile_parameter_events}", "namespace": "{0}"}],
     "fills": {"node": "{0}"}},
    {"call": "rclcpp::ParameterEventHandler::add_parameter_callback", "args": [2, 3], "calls": ["1"],
     "returns": "rclcpp::ParameterCallbackHandle"},
    {"call": "rclcpp::ParameterEventHandler::add_parameter_event_callback", "args": [1], "calls": ["0"],
     "returns": "rclcpp::ParameterEventCallbackHandle"},
)
