# SPDX-License-Identifier: Apache-2.0
"""Publishers of a recording: nodes and latching of ROS 1, quality of service of ROS 2."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from recordings.bags import BEGIN, LEVEL, demanded

from haros_ci.model.architecture import Qos
from haros_ci.recordings.bag import MOST_PROFILES, Bag
from haros_ci.recordings.offered import Offer, offers

NUMBERS = """\
- history: 3
  depth: 0
  reliability: 1
  durability: 2
  deadline:
    sec: 9223372036
    nsec: 854775807
  lifespan:
    sec: 2
    nsec: 500000000
  liveliness: 1
  liveliness_lease_duration:
    sec: 2147483647
    nsec: 4294967295
  avoid_ros_namespace_conventions: false
"""
WORDS = NUMBERS.replace("history: 3", "history: unknown").replace("reliability: 1", "reliability: best_effort")
WORDS = WORDS.replace("durability: 2", "durability: transient_local").replace("liveliness: 1", "liveliness: automatic")


def test_profiles_of_numbers_and_of_words() -> None:
    assert offers(NUMBERS) == (
        Offer(qos=Qos(reliability="reliable", durability="volatile", lifespan=2.5, liveliness="automatic")),
    )
    assert offers(WORDS) == (
        Offer(qos=Qos(reliability="best_effort", durability="transient_local", lifespan=2.5, liveliness="automatic")),
    )
    assert len(offers(NUMBERS + WORDS)) == 2


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "1",
        "{a: b}",
        "- 1",
        "- [",
        "\0",
        "x" * 200_000,
        "- &a [*a]",
    ],
)
def test_texts_without_a_profile(text: str) -> None:
    assert offers(text) == ()


@pytest.mark.parametrize(
    "item",
    [
        "reliability: 0",
        "reliability: 3",
        "reliability: 99",
        "reliability: unknown",
        "reliability: true_",
        "reliability: [1]",
        "durability: system_default",
        "deadline: 1",
        "deadline: {sec: -1, nsec: 0}",
        "deadline: {sec: 0, nsec: 0}",
        "deadline: {sec: a, nsec: 0}",
        "lifespan: {sec: 1}",
        "liveliness: 4",
    ],
)
def test_policies_that_say_nothing(item: str) -> None:
    assert offers(f"- {item}") == (Offer(qos=Qos()),)


def publishers(bag: Bag) -> dict[str, set[Offer]]:
    assert list(bag.times())
    return bag.offers


def written(path: Path, storage: str, version: int, profiles: list[tuple[str, str]]) -> Path:
    """A bag of ROS 2 with a message on /level, whose publishers have these reliabilities and durabilities."""
    demanded()
    from rosbags.interfaces import Qos as Profile
    from rosbags.interfaces import QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    endless = QosTime(9223372036, 854775807)
    store: Any = get_typestore(Stores.LATEST)
    store.register(get_types_from_msg(LEVEL, "demo/msg/Level"))
    import numpy

    raw = store.serialize_cdr(
        store.types["demo/msg/Level"](data=1, values=numpy.array([1.0], dtype=numpy.float32)), "demo/msg/Level"
    )
    made = [
        Profile(QosHistory.UNKNOWN, 0, QosReliability[one.upper()], QosDurability[other.upper()], endless, endless,
                QosLiveliness.AUTOMATIC, endless, False)
        for one, other in profiles
    ]  # fmt: skip
    with Writer(path, version=version, storage_plugin=StoragePlugin[storage]) as writer:  # type: ignore[arg-type]
        channel = writer.add_connection("/level", "demo/msg/Level", typestore=store, offered_qos_profiles=made)
        writer.write(channel, BEGIN, raw)
    return path


@pytest.mark.parametrize("version", [8, 9])
@pytest.mark.parametrize("storage", ["SQLITE3", "MCAP"])
def test_bags_of_ros2(tmp_path: Path, storage: str, version: int) -> None:
    pairs = [("reliable", "transient_local"), ("best_effort", "volatile")]
    bag = Bag(written(tmp_path / "bag", storage, version, pairs))
    expected = {Offer(qos=Qos(reliability=a, durability=b, liveliness="automatic")) for a, b in pairs}
    assert publishers(bag) == {"/level": expected}
    bag = Bag(written(tmp_path / "none", storage, version, []))
    assert publishers(bag) == {"/level": set()}


def test_bags_of_ros1(tmp_path: Path) -> None:
    demanded()
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store: Any = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg("uint8 data\n", "demo/msg/Small"))
    raw = store.serialize_ros1(store.types["demo/msg/Small"](data=1), "demo/msg/Small")
    with Writer(tmp_path / "a.bag") as writer:
        for node, latching in (("/talker", 1), ("other", 0), (None, None)):
            channel = writer.add_connection(
                "/level", "demo/msg/Small", typestore=store, callerid=node, latching=latching
            )
            writer.write(channel, BEGIN, raw)
    bag = Bag(tmp_path / "a.bag")
    assert publishers(bag) == {"/level": {Offer("/talker", True), Offer("/other", False)}}


def test_very_many_profiles_are_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert MOST_PROFILES > 10_000
    monkeypatch.setattr("haros_ci.recordings.bag.MOST_PROFILES", 10)
    bag = Bag(written(tmp_path / "bag", "MCAP", 9, [("reliable", "volatile")]))
    assert publishers(bag) == {"/level": set()}
    assert bag.notes == ["the quality of service of /level is not read: there is too much of it"]
