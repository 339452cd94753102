# SPDX-License-Identifier: Apache-2.0
"""Diagnostics (ROS 1, C++): the updater, its tasks, and self tests."""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # diagnostic_updater/diagnostic_updater.h, wiki.ros.org/diagnostic_updater. The period is read with getParamCached,
    # which has no default.
    {"class": "diagnostic_updater::Updater", "bases": ["diagnostic_updater::DiagnosticTaskVector"]},
    {"call": "diagnostic_updater::Updater", "args": [0, 1, 2, 3],
     "makes": [{"kind": "publishers", "name": "/diagnostics", "type": "diagnostic_msgs/DiagnosticArray",
                "queue_size": 1, "latched": False},
               {"kind": "getters", "name": "diagnostic_period", "type": "double", "namespace": "{1?~}"}]},
    {"call": "diagnostic_updater::DiagnosticTaskVector::add", "args": [1], "calls": ["0.run"]},
    {"call": "diagnostic_updater::DiagnosticTaskVector::add", "args": [2], "calls": ["1"]},
    {"call": "diagnostic_updater::DiagnosticTaskVector::add", "args": [3], "calls": ["2"]},
    {"call": "diagnostic_updater::FunctionDiagnosticTask", "args": [2], "calls": ["1"]},
    {"call": "diagnostic_updater::CompositeDiagnosticTask::addTask", "args": [1], "calls": ["0.run"]},

    # diagnostic_updater/publisher.h: wraps a publisher that was made before.
    {"call": "diagnostic_updater::DiagnosedPublisher", "args": [4]},

    # self_test/self_test.h
    {"class": "self_test::TestRunner", "bases": ["diagnostic_updater::DiagnosticTaskVector"]},
    {"call": "self_test::TestRunner", "args": [0, 1, 2],
     "makes": [{"kind": "servers", "name": "self_test", "type": "diagnostic_msgs/SelfTest",
                "namespace": "{1?~}"}]},
)
