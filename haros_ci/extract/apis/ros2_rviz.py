# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of RViz (ROS 2, C++): base classes of which RViz makes the instances, all on its own node; their properties.

RViz names its node ``rviz`` (rviz_common/src/rviz_common/visualizer_app.cpp). A property has its default as long as no
.rviz file sets it, as a parameter has that no launch file sets.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

ABSTRACTION = "rviz_common::ros_integration::RosNodeAbstractionIface"
#: What RViz calls of a plug-in of each kind (rviz_common/panel.hpp, display.hpp, tool.hpp, view_controller.hpp).
PANEL = ("onInitialize", "load", "save")
DISPLAY = ("onInitialize", "onEnable", "onDisable", "reset", "update", "load", "save", "setTopic", "fixedFrameChanged")
TOOL = ("onInitialize", "activate", "deactivate", "update", "processMouseEvent", "processKeyEvent", "load", "save")
VIEW = ("onInitialize", "onActivate", "update", "reset", "mimic", "handleMouseEvent", "handleKeyEvent")
#: Bases of plug-ins, those of the plug-in descriptions first, with what is called of them.
BASES: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("rviz_common::Panel", PANEL),
    ("rviz_common::Display", DISPLAY),
    ("rviz_common::Tool", TOOL),
    ("rviz_common::ViewController", VIEW),
    ("rviz_common::DisplayGroup", DISPLAY),
    ("rviz_common::_RosTopicDisplay", (*DISPLAY, "subscribe", "unsubscribe")),
    ("rviz_common::RosTopicDisplay", (*DISPLAY, "subscribe", "unsubscribe", "processMessage")),
    ("rviz_common::MessageFilterDisplay", (*DISPLAY, "subscribe", "unsubscribe", "processMessage")),
    ("rviz_common::FramePositionTrackingViewController", VIEW),
    ("rviz_default_plugins::view_controllers::OrbitViewController", VIEW),
    ("rviz_default_plugins::tools::PoseTool", (*TOOL, "onPoseSet")),
    ("rviz_default_plugins::tools::MoveTool", TOOL),
    ("rviz_default_plugins::tools::InteractionTool", TOOL),
    ("rviz_default_plugins::tools::SelectionTool", TOOL),
)
#: rviz_common/properties: classes with a default value as their second argument, and what reads it.
PROPERTIES = "Property BoolProperty IntProperty FloatProperty StringProperty EditableEnumProperty EnumProperty"
TOPICS = "RosTopicProperty RosFilteredTopicProperty RosTopicMultiProperty TfFrameProperty"
READERS = "getValue getBool getInt getFloat getString getStdString getTopic getTopicStd getFrame getFrameStd"


def _base(name: str, entry: tuple[str, ...]) -> tuple[Mapping[str, Any], ...]:
    """A base class: the plug-in is on RViz's node, which it finds through its context."""
    node = {"kind": "node", "name": "rviz"}
    return (
        {"class": name, "entry": list(entry), "bases": ["QWidget", "QObject"]},
        {"call": name, "args": list(range(6)), "makes": [node], "fills": {"context_": "{this}"}},
        {"call": f"{name}::getDisplayContext", "args": [0], "transparent": "{this}"},
        {"call": f"{name}::getRosNodeAbstraction", "args": [0], "returns": ABSTRACTION, "fills": {"node": "{this}"}},
    )


def _property(kind: str) -> tuple[Mapping[str, Any], ...]:
    """A property: its value is its default until it is set."""
    return (
        {"call": kind, "args": [0], "fills": {"value": ""}},
        {"call": kind, "args": list(range(1, 10)), "fills": {"value": "{1?}"}},
        *(
            {"call": f"{kind}::{setter}", "args": [1], "fills": {"value": "{0}"}}
            for setter in ("setValue", "setString", "setStdString")
        ),
        *({"call": f"{kind}::{reader}", "args": [0], "returns": "{this.value}"} for reader in READERS.split()),
    )


# fmt: off
ROWS: tuple[Mapping[str, Any], ...] = (
    *(row for name, entry in BASES for row in _base(name, entry)),

    # rviz_common/ros_integration/ros_node_abstraction_iface.hpp
    {"call": f"{ABSTRACTION}::lock", "args": [0], "transparent": "{this}"},
    {"call": f"{ABSTRACTION}::get_raw_node", "args": [0], "returns": "rclcpp::Node", "fills": {"node": "{this}"}},

    # rviz_common/ros_integration/ros_client_abstraction.hpp: arguments, the node's name, whether a number is put behind it.
    {"call": "rviz_common::ros_integration::RosClientAbstraction::init", "args": [4],
     "makes": [{"kind": "node", "name": "{2}", "anonymous": "{3}"}], "returns": "rclcpp::Node"},
    {"call": "rclcpp::Node::get_raw_node", "args": [0], "transparent": "{this}"},

    # rviz_common/properties
    *(row for name in (PROPERTIES + " " + TOPICS).split() for row in _property(f"rviz_common::properties::{name}")),
    *({"call": f"QString::{name}", "args": [1], "transparent": "{0}"} for name in ("fromStdString", "fromUtf8")),

    # QObject: what is connected to a signal is called later.
    {"call": "QObject::connect", "args": [3], "calls": ["2"]},
    {"call": "QObject::connect", "args": [4, 5], "calls": ["3"]},
)
