# SPDX-License-Identifier: Apache-2.0
"""Which inputs of nodes cause which outputs (docs/dependence.md)."""

from __future__ import annotations

from haros_ci.dependence.effects import unread
from haros_ci.dependence.nodes import node_dependence
from haros_ci.model.dependence import Cause, NodeDependence, Output

__all__ = ["Cause", "NodeDependence", "Output", "node_dependence", "unread"]
