# SPDX-License-Identifier: Apache-2.0
"""The actions of ros_gz, each of which includes a launch file of its package (ros_gz_bridge/actions, ros_gz_sim/actions)."""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.conditions import tests_of
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LaunchObject, LibraryCall, Value, phrase
from haros_ci.launch.ros2.outside_gz import BRIDGE, SERVER, SPAWN
from haros_ci.model.launch_actions import Action

#: What the launch file calls an argument that the action calls otherwise.
_OTHER = {"roll": "R", "pitch": "P", "yaw": "Y"}
_COMPOSED = "container_name create_own_container use_composition"
_MODEL = "world file model_string topic entity_name allow_renaming x y z roll pitch yaw"


def including(file: str, names: str) -> Summary:
    """An action that includes the launch *file* with its arguments of these *names*."""

    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        bound = call.bind(f"* {names}")
        provided = ((name, bound[name]) for name in names.split() if bound.get(name) is not None)
        action = Action(
            kind="include",
            location=call.location,
            phrases=(("file", (f"{file}.py",)),),
            arguments=tuple(((_OTHER.get(name, name),), phrase(value)) for name, value in provided),
            tests=tests_of(bound.get("condition"), call.location),
        )
        return LaunchObject(call.name, call.location, {}, action)

    return summary


SUMMARIES: dict[str, Summary] = {
    "ros_gz_bridge.actions.RosGzBridge": including(BRIDGE, f"bridge_name config_file namespace {_COMPOSED}"),
    "ros_gz_sim.actions.GzServer": including(SERVER, f"world_sdf_file world_sdf_string {_COMPOSED}"),
    "ros_gz_sim.actions.GzSpawnModel": including(SPAWN, _MODEL),
}
