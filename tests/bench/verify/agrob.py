# SPDX-License-Identifier: Apache-2.0
"""AgRobV16, as published for the model checker of HAROS: what haros-ci verify says of its properties, and in how many seconds of the processor.

    python tests/bench/verify/agrob.py [--network async] [--depth 12] [--budget 120]

The workspace is made of agrob.yaml and of launch files that name its nodes; no code of the system is public.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCAN, JOY, TWIST, STATE = "sensor_msgs.LaserScan", "sensor_msgs.Joy", "geometry_msgs.Twist", "std_msgs.Int16MultiArray"
SCAN_TOPIC, JOY_TOPIC, STATE_TOPIC = ("/scan", SCAN), ("/joy_teleop/joy", JOY), ("/agrobv16/current_state", STATE)
TELEOP, SUPERVISOR, LIMIT = (
    (name, TWIST) for name in ("/joy_teleop/cmd_vel", "/supervisor/cmd_vel", "/agrobv16/max_velocity")
)
BASE, PATH = ("/husky_velocity_controller/cmd_vel", TWIST), ("/path/cmd_vel", TWIST)
#: What each node publishes, and what it receives.
NODES = {
    "lms1xx": ((SCAN_TOPIC,), ()),
    "joy_node": ((JOY_TOPIC,), ()),
    "teleop_twist_joy": ((TELEOP,), (JOY_TOPIC,)),
    "supervisor": ((STATE_TOPIC, SUPERVISOR, LIMIT), (SCAN_TOPIC, JOY_TOPIC)),
    "twist_mux": ((BASE,), (LIMIT, SUPERVISOR, TELEOP)),
    "planner_supervisor": ((STATE_TOPIC, SUPERVISOR, LIMIT), (SCAN_TOPIC, JOY_TOPIC, PATH)),
    "safety_mux": ((BASE,), (LIMIT, SUPERVISOR, TELEOP)),
    "path_planner": ((PATH,), ()),
}
BASIC = ("lms1xx", "joy_node", "teleop_twist_joy", "supervisor", "twist_mux")
PLANNING = ("lms1xx", "joy_node", "teleop_twist_joy", "planner_supervisor", "safety_mux", "path_planner")
MANIFEST = """<package format="2"><name>agrob</name><version>0.0.0</version><description>-</description>
<maintainer email="a@example.org">a</maintainer><license>-</license></package>
"""


def workspace(root: Path) -> None:
    """Write it below *root*."""
    package = root / "agrob"
    for folder in ("launch", "nodes"):
        (package / folder).mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    (package / "CMakeLists.txt").write_text("project(agrob)\nfind_package(catkin REQUIRED)\ncatkin_package()\n")
    for name, (published, received) in NODES.items():
        lines = ["#!/usr/bin/env python3", "import rospy"]
        lines += [f"import {kind.split('.')[0]}.msg" for _, kind in (*published, *received)]
        lines.append(f"rospy.init_node('{name}')")
        lines += [f"rospy.Publisher('{topic}', {_type(kind)}, queue_size=10)" for topic, kind in published]
        lines += [f"rospy.Subscriber('{topic}', {_type(kind)}, print)" for topic, kind in received]
        script = package / "nodes" / f"{name}.py"
        script.write_text("\n".join([*lines, "rospy.spin()", ""]))
        script.chmod(0o755)
    for name, nodes in (("basic", BASIC), ("path_planning", PLANNING)):
        rows = "".join(f'  <node pkg="agrob" type="{node}.py" name="{node}"/>\n' for node in nodes)
        (package / "launch" / f"{name}.launch").write_text(f"<launch>\n{rows}</launch>\n")
    (root / ".haros-ci.yaml").write_text((HERE / "agrob.yaml").read_text())


def _type(kind: str) -> str:
    package, _, name = kind.partition(".")
    return f"{package}.msg.{name}"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--network", default="instant")
    parser.add_argument("--latency", default="50")
    parser.add_argument("--depth", default="12")
    parser.add_argument("--budget", default="120")
    parser.add_argument("--text", action="store_true", help="print what the command prints")
    flags = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        workspace(Path(directory))
        for name in ("basic", "path_planning"):
            command = [sys.executable, "-m", "haros_ci", "verify", ".", "--configuration", name, "--no-cache"]
            command += ["--depth", flags.depth, "--budget", flags.budget, "--network", flags.network]
            command += ["--latency", flags.latency] if flags.network == "async" else []
            before = os.times()
            done = subprocess.run(
                [*command, "--output", "text" if flags.text else "json"], cwd=directory, capture_output=True, text=True
            )
            after = os.times()
            spent = after.children_user + after.children_system - before.children_user - before.children_system
            print(f"{name}, {flags.network}: {spent:.1f} s of the processor, exit code {done.returncode}")
            if flags.text or done.returncode > 1:
                print(done.stdout, done.stderr)
                continue
            for one in json.loads(done.stdout)["properties"]:
                steps = "" if one["run"] is None else f", {len(one['run']['steps'])} events"
                print(f"  {one['verdict']} (events: {one['events']}{steps}): {one['id'][:110]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
