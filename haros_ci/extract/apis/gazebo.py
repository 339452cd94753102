# SPDX-License-Identifier: Apache-2.0
"""API rows of Gazebo Classic (C++): what a plug-in's base class says of it (gazebo/common/Plugin.hh)."""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # The name that the description gives to the plug-in.
    {"call": "gazebo::ModelPlugin::GetHandle", "args": [0], "returns": "{this.handleName}"},
    {"call": "gazebo::WorldPlugin::GetHandle", "args": [0], "returns": "{this.handleName}"},
    {"call": "gazebo::SensorPlugin::GetHandle", "args": [0], "returns": "{this.handleName}"},
    {"call": "gazebo::VisualPlugin::GetHandle", "args": [0], "returns": "{this.handleName}"},
    {"call": "gazebo::SystemPlugin::GetHandle", "args": [0], "returns": "{this.handleName}"},
)
# fmt: on
