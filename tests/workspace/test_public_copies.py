# SPDX-License-Identifier: Apache-2.0
"""Which directories of a workspace hold copies of public packages."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.public_copies import copies
from haros_ci.workspace.discover import discover

ADA, GRETE = ("Ada Lovage", "ada@robots.org"), ("Grete Stromberg", "grete@lasers.org")
TODO = ("todo", "user@todo.todo")


def manifest(name: str, people: tuple[tuple[str, str], ...], version: str = "1.2.0") -> str:
    who = "".join(f'<maintainer email="{mail}">{person}</maintainer>' for person, mail in people)
    return f'<package format="3"><name>{name}</name><version>{version}</version><description>d</description>{who}<license>BSD</license></package>\n'


def found(root: Path, packages: dict[str, tuple[str, tuple[tuple[str, str], ...], str]]) -> set[str]:
    for path, (name, people, version) in packages.items():
        directory = root / path
        directory.mkdir(parents=True, exist_ok=True)
        (directory / "package.xml").write_text(manifest(name, people, version))
    return set(copies(discover(root, (".",))))


OWN = {"src/arm_of_ours": ("arm_of_ours", (ADA,), "0.0.0")}
LASER = ("urg_node", (GRETE,), "1.2.0")

FIRES = [
    ({**OWN, "src/urg_node": LASER}, {"src/urg_node"}),
    ({**OWN, "src/urg/urg_node": LASER, "src/urg/msgs": ("urg_c", (GRETE,), "1.0.0")}, {"src/urg"}),
    ({**OWN, "src/urg/urg_node": LASER, "src/urg/more": ("urg_more", (GRETE,), "1.2.0")}, {"src/urg"}),
    ({**OWN, "src/urg-humble/urg_of_ours": ("urg_of_ours", (GRETE,), "1.0.0")}, {"src/urg-humble"}),
    ({**OWN, "src/link-melodic-devel/link_more": ("link_more", (GRETE,), "0.0.0")}, {"src/link-melodic-devel"}),
    ({**OWN, "src/labs-arm-70c2caecb930/arm_more": ("arm_more", (GRETE,), "1.0.0")}, {"src/labs-arm-70c2caecb930"}),
    ({**OWN, "src/arm-master/arm_more": ("arm_more", (GRETE,), "1.0.0")}, {"src/arm-master"}),
    ({"src/mine": ("mine_of_ours", (TODO,), "0.0.0"), "src/urg_node": LASER}, {"src/urg_node"}),
    ({**OWN, "src/a": LASER, "src/b": ("amcl", (GRETE, TODO), "1.0.0")}, {"src/a", "src/b"}),
]
SLAMTEC = ("Slamtec ROS Maintainer", "ros@slamtec.com")
FIRES += [
    ({**OWN, "src/sllidar_ros2": ("sllidar_ros2", (SLAMTEC,), "1.0.1")}, {"src/sllidar_ros2"}),
    ({**OWN, "src/yolo": ("darknet_ros", (("Marko", "marko.bjelonic@mavt.ethz.ch"),), "1.1.5")}, {"src/yolo"}),
    ({**OWN, "src/imu": ("wit_ros_imu", (("kevin", "kevin@wit-motion.com"),), "0.1.0")}, {"src/imu"}),
    ({**OWN, "src/scan": ("ydlidar", (("shao", "shao@eaibot.com"),), "1.3.1")}, {"src/scan"}),
    ({**OWN, "src/lidar": ("livox_ros2_driver", (("feng", "dev@livoxtech.com"),), "0.0.0")}, {"src/lidar"}),
]
FIRES += [
    (
        {**OWN, "src/ldlidar": ("ldlidar_stl_ros2", (("LDROBOT", "support@ldrobot.com"),), "3.0.2")},
        {"src/ldlidar"},
    ),
    (
        {**OWN, "src/gripper": ("robotiq_3f_gripper_control", (("JP", "ros@robotiq.com"),), "1.0.0")},
        {"src/gripper"},
    ),
    (
        {**OWN, "src/zed/zed_nodelets": ("zed_nodelets", (("STEREOLABS", "support@stereolabs.com"),), "3.5.0")},
        {"src/zed"},
    ),
    (
        {**OWN, "src/ublox/filters": ("ublox_msg_filters", (("Kevin", "kevin@dataspeedinc.com"),), "0.0.0")},
        {"src/ublox"},
    ),
    ({**OWN, "src/ndt": ("ndt_omp", (("k", "koide@aisl.cs.tut.ac.jp"),), "0.0.0")}, {"src/ndt"}),
    ({**OWN, "src/ur": ("ur_dashboard_msgs", (("F", "exner@fzi.de"),), "0.0.0")}, {"src/ur"}),
    (
        {**OWN, "src/example_2": ("ros2_control_demo_example_2", (("D", "d.s@stoglrobotics.de"),), "0.0.0")},
        {"src/example_2"},
    ),
    ({**OWN, "src/kindr": ("kindr_ros", (("R", "r.d@anybotics.com"),), "0.3.0")}, {"src/kindr"}),
    ({**OWN, "src/airsim": ("airsim_ros_pkgs", (("R", "ratneshmadaan@gmail.com"),), "0.0.1")}, {"src/airsim"}),
    ({**OWN, "src/omni": ("phantom_omni", (("Dane", "git@danepowell.com"),), "1.0.0")}, {"src/omni"}),
]
EVA = ("Eva Kant", "eva@lasers.org")
ASSISTANT = ("MoveIt Setup Assistant", "assistant@moveit.ros.org")
QUIET = [
    {**OWN, "src/gripper": ("robotiq_of_ours", (GRETE,), "1.0.0")},  # the name alone
    {**OWN, "src/ur": ("ur_of_ours", (GRETE,), "1.0.0")},
    {**OWN, "src/fast_lio": ("fast_lio", (GRETE,), "0.0.0")},
    {**OWN, "src/any": ("arm_of_any", (("R", "r.d@anybotics.com"),), "0.3.0")},
    {**OWN, "src/example": ("ros2_control_demo_of_ours", (GRETE,), "0.0.0")},
    {**OWN, "src/lidar": ("lidar_of_ours", (("LDROBOT", "support@ldrobot.com"),), "3.0.2")},  # the maker alone
    # one of the people of a released package has a part in one that is no copy, as its name says
    {**OWN, "arm_more": ("arm_planning", (ADA, EVA), "1.2.0"), "urg_node": ("urg_node", (EVA,), "1.2.0")},
    {
        "urg_of_ours": ("urg_of_ours", (ADA,), "1.2.0"),
        "urg_node": ("urg_node", (EVA, GRETE), "1.2.0"),
        "amcl": ("amcl", (GRETE,), "1.2.0"),
    },
    {**OWN, "src/config-master/moveit": ("arm_moveit", (ASSISTANT,), "0.3.0")},  # written by a template
    {**OWN, "src/sllidar_ros2": ("sllidar_ros2", (GRETE,), "1.0.1")},  # the name alone
    {**OWN, "src/sllidar_more": ("sllidar_more", (SLAMTEC,), "1.0.1")},  # the maker alone
    {"src/sllidar_ros2": ("sllidar_ros2", (SLAMTEC,), "1.0.1")},  # the maker's own repository
    {"src/sllidar_ros2": ("sllidar_ros2", (SLAMTEC,), "1.0.1"), "src/sdk": ("slam_sdk", (SLAMTEC,), "1.0.0")},
    {"src/sllidar_ros2": ("sllidar_ros2", (SLAMTEC,), "1.0.1"), "src/sdk": ("sllidar_sdk", (ADA,), "1.0.0")},
    {"src/urg_node": LASER, "src/amcl": ("amcl", (ADA,), "1.0.0")},  # nothing of its own: the original
    {**OWN, "src/urg_node": ("urg_node", (ADA,), "1.2.0")},  # by the same people
    {**OWN, "src/urg_node": ("urg_node", (GRETE, ADA), "1.2.0")},
    {**OWN, "src/urg_node": ("urg_node", (TODO,), "1.2.0")},  # by nobody
    {**OWN, "src/urg_node": ("urg_node", (), "1.2.0")},
    {**OWN, "src/urg_node": ("urg_node", (GRETE,), "0.0.0")},  # never released
    {**OWN, "src/urg_of_ours": ("urg_of_ours", (GRETE,), "1.0.0")},  # not public
    {"src/urg_more": ("urg_more_of_ours", (ADA,), "1.0.0"), "src/urg_node": LASER},  # a family of names
    {**OWN, "src/link-melodic-devel/link_more": ("link_more", (ADA,), "0.0.0")},
    {**OWN, "src/link-melodic-devel/link_more": ("link_more", (TODO,), "0.0.0")},
    {**OWN, "src/urg_node": LASER, "src/more": ("urg_more", (GRETE,), "1.2.0")},  # no stack: anything lies in src
    {
        **OWN,
        "urg/urg_node": ("urg_node", (GRETE,), "0.1.0"),
        "urg/more": ("urg_more", (GRETE,), "0.1.0"),
    },  # a template's version
    {**OWN, "urg/urg_node": LASER, "urg/more": ("urg_more", (GRETE,), "1.3.0")},
    {"urg/urg_node": LASER, "urg/more": ("urg_more", (GRETE,), "1.2.0")},  # nothing of its own: the original
    {".": LASER},
    {"src-master/arm_of_ours": ("arm_of_ours", (ADA,), "1.0.0")},  # all of it is an archive
    {"src-master/arm_of_ours": ("arm_of_ours", (ADA,), "1.0.0"), "src-master/leg": ("leg_of_ours", (ADA,), "1.0.0")},
    {},
]


EVA_OF_LASERS, MAX = ("Eva Kant", "eva@lasers.org"), ("Max Moritz", "max.moritz@gmail.com")
URG = {"src/urg/urg_node": LASER, "src/urg/bridge": ("urg_bridge", (EVA_OF_LASERS,), "0.0.0")}
#: Packages of one repository: what lies beside a public one, the files of the repository, and what is a copy.
REPOSITORIES = [
    ({**OWN, **URG}, "src/urg/LICENSE", {"src/urg"}),
    ({**OWN, **URG}, "src/urg/license.md", {"src/urg"}),
    ({**OWN, **URG}, "src/urg/README.md", set()),
    ({**OWN, **URG}, "src/LICENSE", set()),
    ({**OWN, **URG}, "src/urg/bridge/LICENSE", set()),
    ({**OWN, **URG, "src/urg/bridge": ("urg_bridge", (ADA,), "0.0.0")}, "src/urg/LICENSE", set()),
    ({**OWN, **URG, "src/urg/bridge": ("bridge_of_ours", (MAX,), "0.0.0")}, "src/urg/LICENSE", {"src/urg/urg_node"}),
    ({**OWN, **URG, "src/urg/bridge": ("bridge_of_ours", (TODO,), "0.0.0")}, "src/urg/LICENSE", {"src/urg/urg_node"}),
    ({**OWN, **URG, "src/more": ("arm_more", (EVA_OF_LASERS,), "0.0.0")}, "src/urg/LICENSE", set()),
    ({**OWN, "src/urg_node": LASER, "src/bridge": ("urg_bridge", (EVA_OF_LASERS,), "0.0.0")}, "src/LICENSE", set()),
    (URG, "src/urg/LICENSE", set()),
]


@pytest.mark.parametrize(("packages", "file", "expected"), REPOSITORIES)
def test_packages_of_one_repository(
    packages: dict[str, tuple[str, tuple[tuple[str, str], ...], str]], file: str, expected: set[str], tmp_path: Path
) -> None:
    (tmp_path / file).parent.mkdir(parents=True)
    (tmp_path / file).write_text("BSD\n")
    assert found(tmp_path, packages) == expected


def test_the_people_of_a_template_are_nobody(tmp_path: Path) -> None:
    """catkin_create_pkg leaves an author in a comment, in the manifest of a copy and in that of one's own package."""
    jane = '<!-- <author email="jane.doe@example.com">Jane Doe</author> --><license>'
    for path, (name, people, version) in {**OWN, "src/urg_node": LASER}.items():
        (tmp_path / path).mkdir(parents=True)
        (tmp_path / path / "package.xml").write_text(manifest(name, people, version).replace("<license>", jane))
    assert set(copies(discover(tmp_path, (".",)))) == {"src/urg_node"}


@pytest.mark.parametrize(
    ("url", "person", "expected"),
    [
        ("http://wiki.ros.org/map_server", GRETE, {"src/map_more"}),
        ("https://github.com/ros-planning/amcl.git", GRETE, {"src/map_more"}),
        ("http://www.ros.org/wiki/amcl", GRETE, {"src/map_more"}),
        ("https://github.com/ros-perception/slam_gmapping/issues", GRETE, {"src/map_more"}),
        ("http://wiki.ros.org/map_server", ADA, set()),  # by the same people
        ("http://wiki.ros.org/map_more_of_ours", GRETE, set()),  # not public
        ("http://wiki.ros.org/map_server/Tutorials", GRETE, set()),  # another page
        ("https://example.org/map_server", GRETE, set()),
        (
            "https://github.com/ros-planning/moveit",
            GRETE,
            set(),
        ),  # the MoveIt Setup Assistant puts it into what it makes
        ("https://github.com/ros-planning/moveit_setup_assistant/issues", GRETE, set()),
        ("http://wiki.ros.org/", GRETE, set()),
    ],
)
def test_copies_under_another_name(tmp_path: Path, url: str, person: tuple[str, str], expected: set[str]) -> None:
    packages = {**OWN, "src/map_more": ("map_more_of_ours", (person,), "1.2.0")}
    for path, (name, people, version) in packages.items():
        (tmp_path / path).mkdir(parents=True)
        text = manifest(name, people, version)
        is_copy = path == "src/map_more"
        text = text.replace("<license>", f'<url type="website">{url}</url><license>') if is_copy else text
        (tmp_path / path / "package.xml").write_text(text)
    assert set(copies(discover(tmp_path, (".",)))) == expected


@pytest.mark.parametrize(("packages", "expected"), FIRES)
def test_copies(
    tmp_path: Path, packages: dict[str, tuple[str, tuple[tuple[str, str], ...], str]], expected: set[str]
) -> None:
    assert found(tmp_path, packages) == expected


@pytest.mark.parametrize("packages", QUIET)
def test_no_copies(tmp_path: Path, packages: dict[str, tuple[str, tuple[tuple[str, str], ...], str]]) -> None:
    assert found(tmp_path, packages) == set()


def test_a_long_chain_of_people_ends(tmp_path: Path) -> None:
    """Each package has one of the people of the one before it: beyond some rounds nothing is taken for a copy."""
    people = [(f"Person {number}", f"p{number}@robots.org") for number in range(1_100)]
    chain = {
        f"src/p{number}-main/p": (f"x{number}_y", (one, other), "1.0.0")
        for number, (one, other) in enumerate(zip(people, people[1:], strict=False))
    }
    assert found(tmp_path, {"src/own": ("own_of_ours", people[:1], "0.0.0"), **chain}) == set()
