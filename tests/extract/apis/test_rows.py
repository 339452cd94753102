# SPDX-License-Identifier: Apache-2.0
"""Some rows of the C++ tables to the letter, the selectors they use, and the examples of docs/adding-an-api.md."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml

from haros_ci.extract.apis.tables import rows
from haros_ci.model.api import Entry, Row, RowError, Template, load_row

ROOT = Path(__file__).resolve().parents[3]


def said(template: Template | None) -> str | None:
    """A template as it is written."""
    if template is None:
        return None
    parts = (
        p if isinstance(p, str) else "{" + "|".join(p[0]) + ("" if p[1] is None else f"?{p[1]}") + "}"
        for p in template.parts
    )
    return "".join(parts)


def made(entry: Entry) -> dict[str, str]:
    each = {"each": entry.each} if entry.each else {}
    return {"kind": entry.kind, **{key: said(value) or "" for key, value in entry.values.items()}, **each}


def of(call: str, arguments: int, **when: str) -> Row:
    """The first row for *call* with so many arguments and exactly these conditions, ``_0`` for argument 0."""
    conditions = tuple((key.removeprefix("_"), value) for key, value in when.items())
    return next(
        row
        for row in rows("cpp", 1)
        if row.call == call and not row.is_class and arguments in row.args and row.when == conditions
    )


def test_advertise() -> None:
    plain = {"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}"}
    assert [made(e) for e in of("ros::NodeHandle::advertise", 2).makes] == [{**plain, "latched": "false"}]
    assert [made(e) for e in of("ros::NodeHandle::advertise", 3).makes] == [{**plain, "latched": "{2}"}]
    called = of("ros::NodeHandle::advertise", 3, _2="function")
    assert ([made(e) for e in called.makes], called.calls) == ([{**plain, "latched": "false"}], ("2",))
    assert [made(e) for e in of("ros::NodeHandle::advertise", 6).makes] == [{**plain, "latched": "{5}"}]
    assert [made(e) for e in of("ros::NodeHandle::advertise", 1).makes] == [
        {
            "kind": "publishers",
            "name": "{0.topic}",
            "type": "{0.datatype}",
            "queue_size": "{0.queue_size}",
            "latched": "{0.latch}",
        }
    ]
    create = of("ros::AdvertiseOptions::create", 6)
    assert {key: said(value) for key, value in create.fills} == {
        "topic": "{0}",
        "queue_size": "{1}",
        "datatype": "{<0>}",
        "latch": "false",
    }
    assert said(create.returns) == "ros::AdvertiseOptions"


def test_service_types() -> None:
    assert said(of("ros::NodeHandle::advertiseService", 2).makes[0].values["type"]) == "{<0>|callback(1)}"
    assert said(of("ros::NodeHandle::advertiseService", 3).makes[0].values["type"]) == "{callback(1)}"
    assert "type" not in dict(of("ros::ServiceClientOptions", 4).fills)
    assert of("ros::service::waitForService", 2).makes == ()


def test_parameters() -> None:
    stored = of("ros::NodeHandle::param", 3)
    assert [made(e) for e in stored.makes] == [
        {"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1|2)}", "value": "{2}"}
    ]
    assert [(key, said(value)) for key, value in stored.sets] == [("1", "{parameter}")]
    assert said(of("ros::param::param", 2).returns) == "{parameter}"
    assert "value" not in of("ros::NodeHandle::getParam", 2).makes[0].values
    assert [made(e) for e in of("ros::param::search", 2).makes] == [
        {"kind": "getters", "name": "{search(0)}", "namespace": "~"}
    ]


def test_handles() -> None:
    assert [made(e) for e in of("ros::NodeHandle", 0).makes] == [{"kind": "handle"}]
    assert [made(e) for e in of("ros::NodeHandle", 1).makes] == [{"kind": "handle", "namespace": "{0}"}]
    assert [made(e) for e in of("ros::NodeHandle", 2, _0="ros::NodeHandle").makes] == [
        {"kind": "handle", "parent": "{0}", "namespace": "{1}"}
    ]
    assert all(row.when for row in rows("cpp", 1) if row.call == "ros::NodeHandle" and 2 in row.args)
    assert [made(e) for e in of("nodelet::Nodelet::getMTPrivateNodeHandle", 0).makes] == [
        {"kind": "handle", "namespace": "~"}
    ]


def test_dynamic_reconfigure() -> None:
    for arguments, when, namespace in (
        (0, {}, "~"),
        (1, {}, "{0}"),
        (1, {"_0": "boost::recursive_mutex"}, "~"),
        (2, {}, "{1}"),
    ):
        assert [made(e) for e in of("dynamic_reconfigure::Server", arguments, **when).makes] == [
            {
                "kind": "servers",
                "name": "set_parameters",
                "type": "dynamic_reconfigure/Reconfigure",
                "namespace": namespace,
            },
            {
                "kind": "publishers",
                "name": "parameter_descriptions",
                "type": "dynamic_reconfigure/ConfigDescription",
                "queue_size": "1",
                "latched": "true",
                "namespace": namespace,
            },
            {
                "kind": "publishers",
                "name": "parameter_updates",
                "type": "dynamic_reconfigure/Config",
                "queue_size": "1",
                "latched": "true",
                "namespace": namespace,
            },
            {
                "kind": "getters",
                "each": "config(<0>)",
                "name": "{item.name}",
                "type": "{item.type}",
                "value": "{item.default}",
                "namespace": namespace,
            },
            {
                "kind": "setters",
                "each": "config(<0>)",
                "name": "{item.name}",
                "type": "{item.type}",
                "namespace": namespace,
            },
        ]


def test_transforms_and_diagnostics() -> None:
    broadcast = {"kind": "publishers", "type": "tf2_msgs/TFMessage", "queue_size": "100"}
    assert [made(e) for e in of("tf::TransformBroadcaster", 0).makes] == [
        {**broadcast, "name": "/tf", "latched": "false"}
    ]
    assert [made(e) for e in of("tf2_ros::StaticTransformBroadcaster", 0).makes] == [
        {**broadcast, "name": "/tf_static", "latched": "true"}
    ]
    assert [made(e) for e in of("diagnostic_updater::Updater", 0).makes] == [
        {
            "kind": "publishers",
            "name": "/diagnostics",
            "type": "diagnostic_msgs/DiagnosticArray",
            "queue_size": "1",
            "latched": "false",
        },
        {"kind": "getters", "name": "diagnostic_period", "type": "double", "namespace": "{1?~}"},
    ]


def test_camera_info_stands_beside_the_image() -> None:
    image, info = of("image_transport::ImageTransport::subscribeCamera", 4).makes
    assert made(image) == {
        "kind": "subscribers",
        "name": "{0}",
        "type": "sensor_msgs/Image",
        "queue_size": "{1}",
    }
    assert made(info) == {
        "kind": "subscribers",
        "name": "{parent(0)}camera_info",
        "type": "sensor_msgs/CameraInfo",
        "queue_size": "{1}",
    }


def test_the_transport_is_read_where_no_hints_are_given() -> None:
    parameter = {"kind": "getters", "name": "image_transport", "type": "str", "value": "raw", "namespace": "~"}
    for call in ("ImageTransport::subscribe", "ImageTransport::subscribeCamera", "SubscriberFilter::subscribe"):
        *_, read = of(f"image_transport::{call}", 3).makes
        assert (made(read), read.implicit) == (parameter, True)
        assert all(entry.kind == "subscribers" for entry in of(f"image_transport::{call}", 4).makes)


def test_a_shape_shifters_type_is_unknown() -> None:
    assert "type" not in of("topic_tools::ShapeShifter::advertise", 4).makes[0].values


@pytest.mark.parametrize(
    "selector",
    (
        "0",
        "<0>",
        "this<0>",
        "0.topic",
        "parent(0)",
        "search(0)",
        "handle()",
        "handle(~)",
        "typeof(<0>|1|2)",
        "node.name",
        "1?~",
    ),
)
def test_selectors(selector: str) -> None:
    row = load_row({"call": "f", "fills": {"member": f"{{{selector}}}"}})
    assert said(row.fills[0][1]) == f"{{{selector}}}"


@pytest.mark.parametrize("selector", ("", "0.", "<x>", "handle(0)", "handle(", "search()", "callback()", "0 1", "a-b"))
def test_what_selects_nothing(selector: str) -> None:
    with pytest.raises(RowError, match="selects nothing"):
        load_row({"call": "f", "returns": f"{{{selector}}}"})


def test_conditions_are_on_selectors() -> None:
    with pytest.raises(RowError, match="'no such thing' selects nothing"):
        load_row({"call": "f", "when": {"no such thing": "bool"}})


def test_the_pages_examples_load() -> None:
    page = (ROOT / "docs" / "adding-an-api.md").read_text(encoding="utf-8")
    blocks = [yaml.safe_load(block) for block in re.findall(r"```yaml\n(.*?)```", page, re.S)]
    loaded = [load_row(row) for block in blocks for row in block["apis"]]
    assert [row.call for row in loaded] == [
        "my_robot::advertiseStatus",
        "my_robot::Gripper",
        "my_robot::Gripper::onMove",
        "my_robot.tools.load",
        "my_robot::Reporter",
        "my_robot::Driver",
        "my_robot::Driver",
    ]
    assert made(loaded[0].makes[0]) == {
        "kind": "publishers",
        "name": "status/{1}",
        "type": "{<0>}",
        "queue_size": "1",
        "latched": "true",
        "namespace": "{0}",
    }
