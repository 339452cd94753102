# SPDX-License-Identifier: Apache-2.0
"""Every data file on known ROS 2 nodes: its shape, its types, nothing twice, and no node that cannot be started."""

from __future__ import annotations

from collections import Counter
from functools import partial

from every import every

from haros_ci.model.architecture import KINDS, Endpoint
from haros_ci.systems.known import load
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.known.load import known_packages, load_known, parse
from haros_ci.systems.known.quality import PRESETS
from haros_ci.systems.known.shape import ROS2_DISTRIBUTIONS, ROS2_PARAMETER_TYPES, SUBFOLDERS, read_package

FILES = {
    package: (load._HERE / "ros2" / f"{package}.yaml").read_text(encoding="utf-8") for package in known_packages(2)
}
NODES = [
    node for package in known_packages(2) for name, node in (load_known(package, 2) or {}).items() if name == node.type
]


@every("package", FILES)
def test_a_file_has_its_form(package: str) -> None:
    data = parse(FILES[package])
    assert isinstance(data, dict)
    nodes, problems = read_package(data, package, f"{package}.yaml", ros=2)
    assert problems == []
    assert sorted(nodes) == sorted(data)
    assert {node.ros for node in nodes.values()} == {2}
    assert FILES[package].startswith("# SPDX-License-Identifier: Apache-2.0\n")


@every("package", FILES)
def test_keys_of_a_file_stand_once(package: str) -> None:
    keys = [line for line in FILES[package].splitlines() if line[:1] not in ("", " ", "#")]
    assert keys == list(dict.fromkeys(keys))


def test_there_are_enough() -> None:
    assert len(NODES) >= 90


def test_the_versions_are_apart() -> None:
    ros1, ros2 = load_known("joy", 1), load_known("joy", 2)
    assert ros1 is not None and ros2 is not None
    assert sorted(ros1) == ["joy_node"]
    assert sorted(ros2) == ["game_controller_node", "joy::GameController", "joy::Joy", "joy_node"]
    assert ros2["joy::Joy"] is ros2["joy_node"]
    assert load_known("move_base", 2) is None and load_known("nav2_amcl") is None


@every("node", NODES, ids=lambda node: f"{node.package}:{node.type}")
def test_a_node_says_where_it_is_described(node: KnownNode) -> None:
    assert node.source.startswith("https://")
    assert not node.nodelet
    if node.plugin:
        assert node.type.partition("/")[0] == node.package


@every("node", NODES, ids=lambda node: f"{node.package}:{node.type}")
def test_a_node_starts_without_anything(node: KnownNode) -> None:
    start = partial(
        instantiate,
        node,
        name="/place/it",
        namespace="/place",
        arguments=(),
        parameter=lambda name: None,
        remap=lambda name: name,
        ros=2,
    )
    for distribution in (None, *ROS2_DISTRIBUTIONS):
        ends = start(distribution=distribution)
        sure = Counter((end.kind, end.name) for end in ends if not _told(end) & {"name", "conditions"})
        assert [key for key, count in sure.items() if count > 1] == []
        for end in ends:
            _holds_together(end)


def _holds_together(end: Endpoint) -> None:
    assert end.kind in KINDS and end.kind not in ("getters", "setters")
    assert end.source == "known-node" and end.location is None
    assert end.queue_size is None and end.latched is None
    assert end.name.startswith("/") and "{" not in end.name and "//" not in end.name
    assert ("?" in end.name) == ("name" in _told(end))
    assert (end.type is None) == ("type" in _told(end))
    if end.kind == "parameters":
        assert end.name.startswith("/place/it:")
        assert end.type is None or end.type in ROS2_PARAMETER_TYPES
        _fits(end.type, end.value)
        assert end.effective == end.value
    else:
        assert end.type is None or end.type.split("/")[1] == SUBFOLDERS[end.kind]
    if end.kind in ("publishers", "subscribers"):
        assert (end.qos is None or "?" in vars_of(end)) == ("qos" in _told(end))


def _fits(type_name: str | None, value: object) -> None:
    plain = {"bool": bool, "int": int, "double": float, "str": str}
    if value is not None and type_name in plain:
        assert type(value) is plain[type_name]
    elif value is not None and type_name is not None:
        assert isinstance(value, list)


def vars_of(end: Endpoint) -> list[object]:
    qos = end.qos or PRESETS["system_default"]
    return [qos.history, qos.depth, qos.reliability, qos.durability]


def _told(end: Endpoint) -> set[str]:
    return {why.field for why in end.unknowns}
