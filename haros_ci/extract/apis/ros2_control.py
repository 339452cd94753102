# SPDX-License-Identifier: Apache-2.0
"""Controllers and hardware components of ros2_control (ROS 2, C++): base classes of plug-ins that a controller manager loads.

A controller has a node of its own, which the manager makes before it calls ``on_init``; so has, from Kilted on, a hardware component
(controller_interface/src/controller_interface_base.cpp, hardware_interface/src/hardware_component_interface.cpp).
"""

from __future__ import annotations

from collections.abc import Mapping

#: The field of a controller or hardware component that holds its node.
NODE = "ros2_control_node"
CONTROLLER = "controller_interface::ControllerInterfaceBase"
HARDWARE = "hardware_interface::HardwareComponentInterface"
CONTROLLERS = ("controller_interface::ControllerInterface", "controller_interface::ChainableControllerInterface")
COMPONENTS = (
    "hardware_interface::SystemInterface",
    "hardware_interface::ActuatorInterface",
    "hardware_interface::SensorInterface",
)
#: Stands for what is declared for every controller before its own ``on_init``.
DECLARED = f"{CONTROLLER}::declared_before_on_init"

# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    *({"class": name, "bases": [CONTROLLER]} for name in CONTROLLERS),
    {"class": CONTROLLER, "bases": ["rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface"]},
    *({"class": name, "bases": [HARDWARE]} for name in COMPONENTS),
    {"class": HARDWARE, "bases": ["rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface"]},

    # controller_interface/controller_interface_base.hpp
    {"call": DECLARED, "args": [1],
     "makes": [{"kind": "parameters", "name": "update_rate", "type": "int", "value": "{0}", "namespace": f"{{this.{NODE}}}",
                "unsure": "only from Humble on"},
               {"kind": "parameters", "name": "is_async", "type": "bool", "value": False, "namespace": f"{{this.{NODE}}}",
                "unsure": "only from Iron on"}]},
    {"call": f"{CONTROLLER}::get_node", "args": [0], "returns": f"{{this.{NODE}}}"},
    {"call": f"{CONTROLLER}::get_lifecycle_node", "args": [0], "returns": f"{{this.{NODE}}}"},
    {"call": f"{CONTROLLER}::auto_declare", "args": [2],
     "makes": [{"kind": "parameters", "name": "{0}", "type": "{typeof(<0>|1)}", "value": "{1}", "namespace": f"{{this.{NODE}}}"}],
     "returns": "{parameter}"},
    *({"call": f"{CONTROLLER}::{name}", "args": [0], "returns": "rclcpp_lifecycle::State"}
      for name in ("get_lifecycle_state", "get_state", "get_current_state", "configure")),

    # hardware_interface/hardware_component_interface.hpp
    {"call": f"{HARDWARE}::get_node", "args": [0], "returns": f"{{this.{NODE}}}"},
)
