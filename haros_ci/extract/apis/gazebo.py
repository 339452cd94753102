# SPDX-License-Identifier: Apache-2.0
"""API rows of Gazebo Classic (C++): what a plug-in's base class says of it (gazebo/common/Plugin.hh)."""

from __future__ import annotations

from collections.abc import Mapping

CLASSES = ("ModelPlugin", "WorldPlugin", "SensorPlugin", "VisualPlugin", "SystemPlugin")
ROWS: tuple[Mapping[str, object], ...] = tuple(
    {"call": f"gazebo::{name}::GetHandle", "args": [0], "returns": "{this.handleName}"} for name in CLASSES
)
