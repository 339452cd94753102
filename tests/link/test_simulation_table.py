# SPDX-License-Identifier: Apache-2.0
"""The table of plug-ins: every row has its source and a form that is read, and what has none is said."""

from __future__ import annotations

from typing import Any

import pytest

from haros_ci.systems.simulation.table import PLACES, library_of, plugins, problems, read_rows, silent

#: What is asked for at least, of both versions.
WANTED = {
    1: "diff_drive laser gpu_laser camera depth_camera openni_kinect imu imu_sensor p3d planar_move skid_steer_drive joint_state_publisher joint_pose_trajectory force"
    " ft_sensor bumper range tricycle_drive vacuum_gripper elevator hand_of_god projector template wheel_slip control",
    2: "diff_drive ray_sensor camera imu_sensor p3d planar_move joint_state_publisher joint_pose_trajectory force ft_sensor bumper gps_sensor ackermann_drive"
    " tricycle_drive vacuum_gripper elevator hand_of_god projector template wheel_slip state init factory force_system",
}


@pytest.mark.parametrize("ros", [1, 2])
def test_the_data_files(ros: int) -> None:
    assert problems(ros) == ()
    assert {f"gazebo_ros_{name}" for name in WANTED[ros].split()} <= set(plugins(ros))
    assert all(row.source and row.at in PLACES for row in plugins(ros).values())
    assert not silent() & set(plugins(ros))


def test_there_are_enough() -> None:
    assert len(plugins(1)) + len(plugins(2)) >= 60


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ({"at": "model"}, "x: source must name the file that it was read from"),
        ({"source": "x.cpp", "at": "car"}, "x: at must be one of: world, model, sensor, visual, system"),
        ({"source": "x.cpp", "at": "model", "colour": 1}, "x: nothing is called 'colour' here"),
        ({"source": "x.cpp", "at": "model", "elements": {"a b": 1}}, "x: elements must be a map of names and plain defaults"),
        ({"source": "x.cpp", "at": "model", "requires": ["a"]}, "x: requires must be a list of some of its elements"),
        ({"source": "x.cpp", "at": "model", "beside": "a"}, "x: beside must be package/type of a known node"),
        ({"source": "x.cpp", "at": "model", "namespace": {"near": ""}}, "x: namespace can have, in ROS 1: missing, empty, slash, above, below, ignored"),
        ({"source": "x.cpp", "at": "model", "publishers": [{"name": "a", "type": "b"}]}, "x.publishers[0].type: 'b' is no type; write package/Name, or {unknown:the reason}"),
        ([], "x: it must be a map"),
    ],
)  # fmt: skip
def test_what_has_no_form_is_said(row: Any, said: str) -> None:
    found, wrong = read_rows({"x": row}, "t.yaml", 1)
    assert found == {}
    assert [each.message for each in wrong] == [said]


@pytest.mark.parametrize("name", ["libgazebo_ros_imu.so", "gazebo_ros_imu", " /opt/ros/lib/libgazebo_ros_imu.so "])
def test_names_of_libraries(name: str) -> None:
    assert library_of(name) == "gazebo_ros_imu"
