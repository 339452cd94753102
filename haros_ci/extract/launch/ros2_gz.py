# SPDX-License-Identifier: Apache-2.0
"""The tags of ros_gz in launch files in XML and YAML: each includes a launch file of its package (ros_gz_bridge/actions, ros_gz_sim/actions)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from haros_ci.extract.launch.ros2_entity import Entity
from haros_ci.model.launch_actions import Action

if TYPE_CHECKING:
    from haros_ci.extract.launch.ros2_actions import Builder

Maker = Callable[["Builder", Entity], "Action | None"]
_COMPOSED = "container_name create_own_container use_composition"
_MODEL = "world file model_string topic entity_name allow_renaming x y z R P Y"


def _including(file: str, names: str) -> Maker:
    """A tag that includes a launch *file* with its attributes as arguments."""

    def make(builder: Builder, entity: Entity) -> Action | None:
        builder.check(entity, tuple(names.split()))
        provided = builder.phrases(entity, {name: name for name in names.split()})
        return Action(
            kind="include",
            location=entity.location,
            phrases=(("file", (f"$(find-pkg-share {file}.launch.py",)),),
            arguments=tuple(((name,), phrase) for name, phrase in provided),
            tests=builder.tests(entity),
        )

    return make


MAKERS: Mapping[str, Maker] = {
    "ros_gz_bridge": _including(
        "ros_gz_bridge)/launch/ros_gz_bridge", f"bridge_name config_file namespace use_respawn log_level {_COMPOSED}"
    ),
    "gz_server": _including("ros_gz_sim)/launch/gz_server", f"world_sdf_file world_sdf_string {_COMPOSED}"),
    "gz_spawn_model": _including("ros_gz_sim)/launch/gz_spawn_model", _MODEL),
}
