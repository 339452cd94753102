# SPDX-License-Identifier: Apache-2.0
"""Actions (ROS 1, C++): actionlib's servers and clients; the template argument ``pkg::NameAction`` is ``pkg/Name``."""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # actionlib/server/simple_action_server.h, wiki.ros.org/actionlib: with or without a handle, a callback, auto_start.
    {"call": "actionlib::SimpleActionServer", "args": [2, 3, 4], "when": {"0": "ros::NodeHandle"},
     "makes": [{"kind": "action_servers", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}], "calls": ["2"]},
    {"call": "actionlib::SimpleActionServer", "args": [1, 2, 3],
     "makes": [{"kind": "action_servers", "name": "{0}", "type": "{<0>}"}], "calls": ["1"]},
    {"call": "actionlib::SimpleActionServer", "args": [4],
     "makes": [{"kind": "action_servers", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}], "calls": ["2"]},
    {"call": "actionlib::SimpleActionServer::registerGoalCallback", "args": [1], "calls": ["0"]},
    {"call": "actionlib::SimpleActionServer::registerPreemptCallback", "args": [1], "calls": ["0"]},

    # actionlib/server/action_server.h, action_server_base.h: always with a handle.
    {"class": "actionlib::ActionServer", "bases": ["actionlib::ActionServerBase"]},
    {"call": "actionlib::ActionServer", "args": [2, 3, 4, 5],
     "makes": [{"kind": "action_servers", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}],
     "calls": ["2", "3"]},
    {"call": "actionlib::ActionServerBase::registerGoalCallback", "args": [1], "calls": ["0"]},
    {"call": "actionlib::ActionServerBase::registerCancelCallback", "args": [1], "calls": ["0"]},

    # actionlib/client/simple_action_client.h
    {"call": "actionlib::SimpleActionClient", "args": [2, 3], "when": {"0": "ros::NodeHandle"},
     "makes": [{"kind": "action_clients", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}]},
    {"call": "actionlib::SimpleActionClient", "args": [1, 2],
     "makes": [{"kind": "action_clients", "name": "{0}", "type": "{<0>}"}]},
    {"call": "actionlib::SimpleActionClient", "args": [3],
     "makes": [{"kind": "action_clients", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}]},
    {"call": "actionlib::SimpleActionClient::sendGoal", "args": [1, 2, 3, 4], "calls": ["1", "2", "3"]},

    # actionlib/client/action_client.h
    {"call": "actionlib::ActionClient", "args": [2, 3], "when": {"0": "ros::NodeHandle"},
     "makes": [{"kind": "action_clients", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}]},
    {"call": "actionlib::ActionClient", "args": [1, 2],
     "makes": [{"kind": "action_clients", "name": "{0}", "type": "{<0>}"}]},
    {"call": "actionlib::ActionClient", "args": [3],
     "makes": [{"kind": "action_clients", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}]},
    {"call": "actionlib::ActionClient::sendGoal", "args": [1, 2, 3], "calls": ["1", "2"]},
)
