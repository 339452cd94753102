# SPDX-License-Identifier: Apache-2.0
"""Tools (ROS 2, C++): diagnostics, interactive markers, bonds, real-time publishers, classes loaded by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

SERVICES = "rmw_qos_profile_services_default"


def _markers(args: list[int], qos: int, when: dict[str, str]) -> dict[str, object]:
    """interactive_markers/interactive_marker_server.hpp: topics below the namespace that comes first."""
    makes: list[dict[str, Any]] = [
        {
            "kind": "servers",
            "name": "{0}/get_interactive_markers",
            "qos": SERVICES,
            "type": "visualization_msgs/srv/GetInteractiveMarkers",
            "namespace": "{1}",
        },
        {
            "kind": "publishers",
            "name": "{0}/update",
            "qos": f"{{{qos}?100}}",
            "type": "visualization_msgs/msg/InteractiveMarkerUpdate",
            "namespace": "{1}",
        },
        {
            "kind": "subscribers",
            "name": "{0}/feedback",
            "qos": f"{{{qos + 1}?1}}",
            "type": "visualization_msgs/msg/InteractiveMarkerFeedback",
            "namespace": "{1}",
        },
    ]
    row: dict[str, object] = {"call": "interactive_markers::InteractiveMarkerServer", "args": args, "makes": makes}
    return {**row, "when": when} if when else row


# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # diagnostic_updater/diagnostic_updater.hpp: a node or six of its interfaces, and the period in seconds.
    {"class": "diagnostic_updater::Updater", "bases": ["diagnostic_updater::DiagnosticTaskVector"]},
    *({"call": "diagnostic_updater::Updater", "args": args,
       "makes": [{"kind": "publishers", "name": "/diagnostics", "type": "diagnostic_msgs/msg/DiagnosticArray",
                  "qos": 1, "namespace": "{0}"},
                 {"kind": "parameters", "name": "diagnostic_updater.period", "type": "double", "value": period,
                  "namespace": "{0}"},
                 {"kind": "parameters", "name": "diagnostic_updater.use_fqn", "type": "bool", "value": False,
                  "namespace": "{0}"}],
       "fills": {"node": "{0}"}}
      for args, period in (([1, 2], "{1?1.0}"), ([6, 7], "{6?1.0}"))),
    {"call": "diagnostic_updater::DiagnosticTaskVector::add", "args": [1], "calls": ["0.run"]},
    {"call": "diagnostic_updater::DiagnosticTaskVector::add", "args": [2], "calls": ["1"]},
    {"call": "diagnostic_updater::DiagnosticTaskVector::add", "args": [3], "calls": ["2"]},
    *({"call": f"diagnostic_updater::Updater::{name}", "args": [0, 1, 2, 3, 4]}
      for name in ("setHardwareID", "setHardwareIDf", "force_update", "broadcast", "setPeriod", "getPeriod")),
    {"call": "diagnostic_updater::FunctionDiagnosticTask", "args": [2], "calls": ["1"]},
    {"call": "diagnostic_updater::CompositeDiagnosticTask::addTask", "args": [1], "calls": ["0.run"]},
    # diagnostic_updater/publisher.hpp: wraps a publisher that was made before.
    {"call": "diagnostic_updater::DiagnosedPublisher", "args": [4, 5]},

    # interactive_markers/interactive_marker_server.hpp: a node or five of its interfaces.
    _markers([2, 3, 4], 2, {}),
    _markers([6, 7, 8], 6, {}),
    {"call": "interactive_markers::InteractiveMarkerServer::insert", "args": [1, 2, 3], "calls": ["1"]},
    {"call": "interactive_markers::InteractiveMarkerServer::setCallback", "args": [2, 3], "calls": ["1"]},
    {"call": "interactive_markers::MenuHandler::insert", "args": [2, 3], "calls": ["1", "2"]},

    # bondcpp/bond.hpp: a node or five of its interfaces.
    *({"call": "bond::Bond", "args": args,
       "makes": [{"kind": "publishers", "name": "{0}", "type": "bond/msg/Status", "qos": 5, "namespace": "{2}"},
                 {"kind": "subscribers", "name": "{0}", "type": "bond/msg/Status", "qos": 100, "namespace": "{2}"},
                 {"kind": "parameters", "name": "bond_disable_heartbeat_timeout", "type": "bool", "value": False,
                  "namespace": "{2}"}],
       "calls": calls}
      for args, calls in (([3, 4, 5], ["3", "4"]), ([7, 8, 9], ["7", "8"]))),
    *({"call": f"bond::Bond::{name}", "args": [0, 1]}
      for name in ("start", "breakBond", "setHeartbeatPeriod", "setHeartbeatTimeout", "setConnectTimeout",
                   "setDisconnectTimeout", "waitUntilFormed", "waitUntilBroken", "isBroken", "getTopic")),
    {"call": "bond::Bond::setFormedCallback", "args": [1], "calls": ["0"]},
    {"call": "bond::Bond::setBrokenCallback", "args": [1], "calls": ["0"]},

    # ament_index_cpp: a text that stands for the directory, wherever it is.
    {"call": "ament_index_cpp::get_package_share_directory", "args": [1], "returns": "$(find-pkg-share {0})"},
    {"call": "ament_index_cpp::get_package_share_path", "args": [1], "returns": "$(find-pkg-share {0})"},
    {"call": "ament_index_cpp::get_package_prefix", "args": [1], "returns": "$(find-pkg-prefix {0})"},

    # realtime_tools/realtime_publisher.hpp, realtime_buffer.hpp: wrap what was made before.
    {"call": "realtime_tools::RealtimePublisher", "args": [1]},
    {"call": "realtime_tools::RealtimeBuffer", "args": [0, 1]},
)
