# SPDX-License-Identifier: Apache-2.0
"""Python classes of interfaces: their fields, and what else can be asked of them."""

from __future__ import annotations

import pytest

from haros_ci.interfaces.definitions import Definitions
from haros_ci.interfaces.structs import Structs
from haros_ci.workspace.interfaces import read_interface

OWN = {
    "msg/Battery.msg": "uint8 FULL=1\nCell cell\nCell[] cells\nother_msgs/Thing thing\nfloat32 voltage",
    "msg/Cell.msg": "float32 voltage",
    "srv/Move.srv": "float64 distance\n---\nbool done",
    "action/Drive.action": "float64 goal\n---\nbool result\n---\nfloat64 left",
    "msg/Odd.msg": "int8 x\n<?>",
    "msg/Headed.msg": "Header header",
}


def structs(ros: int, hidden: frozenset[str] = frozenset()) -> Structs:
    return Structs(Definitions((read_interface(path, text, "demo")[0] for path, text in OWN.items()), ros), hidden)


@pytest.mark.parametrize(
    ("ros", "name", "fields"),
    [
        (1, "demo.msg.Battery", "cell cells thing voltage"),
        (2, "demo.msg.Battery", "cell cells thing voltage"),
        (2, "demo.srv.Move.Request", "distance"),
        (2, "demo.srv.Move.Response", "done"),
        (2, "demo.action.Drive.Goal", "goal"),
        (2, "demo.action.Drive.Feedback", "left"),
        (1, "demo.srv.MoveRequest", "distance"),
        (1, "demo.srv.MoveResponse", "done"),
        (1, "demo.msg.DriveGoal", "goal"),
        (1, "demo.msg.DriveResult", "result"),
        (1, "std_msgs.msg.Header", "seq stamp frame_id"),
        (2, "std_msgs.msg.Header", "stamp frame_id"),
    ],
)
def test_fields(ros: int, name: str, fields: str) -> None:
    found = structs(ros).named(name)
    assert found is not None and " ".join(found.fields) == fields


@pytest.mark.parametrize(
    ("ros", "name"),
    [
        (2, "demo.msg.Odd"),
        (2, "demo.msg.None_"),
        (2, "demo.srv.Move"),
        (2, "demo.srv.MoveRequest"),
        (2, "demo.srv.Move.Goal"),
        (2, "demo.action.Drive"),
        (2, "demo.action.Drive.Request"),
        (2, "demo.msg.DriveGoal"),
        (1, "demo.srv.Move"),
        (1, "demo.msg.DriveActionGoal"),
        (1, "demo.srv.Move.Request"),
        (2, "other_msgs.msg.Thing"),
        (2, "sensor_msgs.msg.Range"),  # not the same in all distributions
        (2, "demo.Battery"),
        (2, ""),
    ],
)
def test_what_is_not_known(ros: int, name: str) -> None:
    assert structs(ros).named(name) is None


def test_inner_fields() -> None:
    made = structs(2)
    battery = made.named("demo.msg.Battery")
    assert battery is not None
    cell = made.of_field(battery, "cell")
    assert cell is not None and cell.name == "demo.msg.Cell"
    assert [made.of_field(battery, name) for name in ("cells", "thing", "voltage", "none")] == [None] * 4


def test_a_header_alone_is_the_packages_own_in_ros_2() -> None:
    for ros, expected in ((1, "std_msgs.msg.Header"), (2, None)):
        made = structs(ros)
        headed = made.named("demo.msg.Headed")
        assert headed is not None
        inner = made.of_field(headed, "header")
        assert (inner.name if inner is not None else None) == expected


def test_what_else_there_is() -> None:
    battery = structs(2).named("demo.msg.Battery")
    assert battery is not None
    there = ("voltage", "FULL", "VOLTAGE__DEFAULT", "get_fields_and_field_types", "serialize", "_type", "__slots__")
    assert all(battery.has(name) for name in there)
    assert not any(battery.has(name) for name in ("Voltage", "full", "volt", "EMPTY"))


def test_modules_that_people_wrote_hide_the_generated_ones() -> None:
    assert structs(2, frozenset(("demo",))).named("demo.msg.Battery") is None
