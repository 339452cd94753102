# SPDX-License-Identifier: Apache-2.0
"""The tables of C++ calls: every row loads and is of use, and what must be covered is."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections import Counter
from importlib import import_module
from pathlib import Path

import pytest
from every import every

from haros_ci.extract.apis.tables import TABLES, rows
from haros_ci.model.api import load_row

ROOT = Path(__file__).resolve().parents[3]
CPP = next(modules for language, ros, modules in TABLES if (language, ros) == ("cpp", 1))
KINDS = ("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients", "getters", "setters")
FORMS = [(module, row) for module in CPP for row in import_module(f"haros_ci.extract.apis.{module}").ROWS]

#: Calls, each with the numbers of arguments that it is made with.
COVERED = {
    "ros::init": (2, 3, 4),
    "ros::NodeHandle": (0, 1, 2),
    "ros::NodeHandle::getNamespace": (0,),
    "ros::NodeHandle::resolveName": (1, 2),
    "ros::NodeHandle::advertise": (1, 2, 3, 4, 5, 6),
    "ros::NodeHandle::subscribe": (1, 3, 4, 5),
    "ros::NodeHandle::advertiseService": (1, 2, 3),
    "ros::NodeHandle::serviceClient": (1, 2, 3),
    "ros::NodeHandle::param": (2, 3),
    "ros::NodeHandle::getParam": (2,),
    "ros::NodeHandle::getParamCached": (2,),
    "ros::NodeHandle::hasParam": (1,),
    "ros::NodeHandle::searchParam": (2,),
    "ros::NodeHandle::setParam": (2,),
    "ros::NodeHandle::deleteParam": (1,),
    "ros::NodeHandle::createTimer": (1, 2, 3, 4, 5),
    "ros::NodeHandle::createWallTimer": (1, 2, 3, 4, 5),
    "ros::NodeHandle::createSteadyTimer": (1, 2, 3, 4, 5),
    "ros::AdvertiseOptions": (0, 5, 6, 7),
    "ros::AdvertiseOptions::init": (2, 3, 4),
    "ros::AdvertiseOptions::create": (6,),
    "ros::SubscribeOptions": (0, 4),
    "ros::SubscribeOptions::init": (3, 4),
    "ros::SubscribeOptions::initByFullCallbackType": (3, 4),
    "ros::SubscribeOptions::create": (5,),
    "ros::AdvertiseServiceOptions::init": (2,),
    "ros::AdvertiseServiceOptions::initBySpecType": (2,),
    "ros::AdvertiseServiceOptions::create": (4,),
    "ros::ServiceClientOptions": (4,),
    "ros::ServiceClientOptions::init": (3,),
    "ros::TimerOptions": (3, 4, 5),
    "ros::Rate": (1,),
    "ros::WallRate": (1,),
    "ros::Duration": (0, 1),
    "ros::WallDuration": (0, 1),
    "ros::topic::waitForMessage": (1, 2, 3),
    "ros::service::call": (2, 3),
    "ros::service::createClient": (1, 2, 3),
    "ros::service::waitForService": (1, 2),
    "ros::service::exists": (2,),
    "ros::param::param": (2, 3),
    "ros::param::get": (2,),
    "ros::param::getCached": (2,),
    "ros::param::has": (1,),
    "ros::param::search": (2, 3),
    "ros::param::set": (2,),
    "ros::param::del": (1,),
    "ros::names::resolve": (1, 2),
    "ros::this_node::getName": (0,),
    "ros::this_node::getNamespace": (0,),
    "nodelet::Nodelet::getNodeHandle": (0,),
    "nodelet::Nodelet::getPrivateNodeHandle": (0,),
    "nodelet::Nodelet::getMTNodeHandle": (0,),
    "nodelet::Nodelet::getMTPrivateNodeHandle": (0,),
    "nodelet::Nodelet::getName": (0,),
    "nodelet::Loader": (0, 1),
    "nodelet_topic_tools::NodeletLazy::advertise": (3, 4),
    "image_transport::ImageTransport": (1,),
    "image_transport::ImageTransport::advertise": (2, 3, 4, 5, 6),
    "image_transport::ImageTransport::subscribe": (3, 4, 5),
    "image_transport::ImageTransport::advertiseCamera": (2, 3, 4, 5, 6, 7, 8),
    "image_transport::ImageTransport::subscribeCamera": (3, 4, 5),
    "image_transport::TransportHints": (0, 1, 2, 3, 4),
    "image_transport::SubscriberFilter": (3, 4),
    "image_transport::SubscriberFilter::subscribe": (3, 4),
    "camera_info_manager::CameraInfoManager": (1, 2, 3),
    "point_cloud_transport::PointCloudTransport::advertise": (2, 3),
    "point_cloud_transport::PointCloudTransport::subscribe": (3, 4, 5),
    "pcl_ros::Publisher": (3,),
    "topic_tools::ShapeShifter::advertise": (3, 4, 5),
    "message_filters::Subscriber": (3, 4, 5),
    "message_filters::Subscriber::subscribe": (0, 3, 4, 5),
    "message_filters::SimpleFilter::registerCallback": (1, 2),
    "message_filters::Synchronizer::registerCallback": (1, 2),
    "filters::FilterChain::configure": (1, 2),
    "tf::TransformBroadcaster": (0,),
    "tf::TransformListener": (0, 1, 2, 3),
    "tf2_ros::TransformBroadcaster": (0,),
    "tf2_ros::StaticTransformBroadcaster": (0,),
    "tf2_ros::TransformListener": (1, 2, 3, 4),
    "tf2_ros::Buffer": (2,),
    "tf2_ros::BufferServer": (2, 3, 4),
    "tf2_ros::BufferClient": (1, 2, 3),
    "actionlib::SimpleActionServer": (1, 2, 3, 4),
    "actionlib::ActionServer": (2, 3, 4, 5),
    "actionlib::SimpleActionClient": (1, 2, 3),
    "actionlib::ActionClient": (1, 2, 3),
    "actionlib::SimpleActionClient::sendGoal": (1, 2, 3, 4),
    "dynamic_reconfigure::Server": (0, 1, 2),
    "dynamic_reconfigure::Server::setCallback": (1,),
    "dynamic_reconfigure::Client": (1, 2, 3, 4),
    "diagnostic_updater::Updater": (0, 1, 2, 3),
    "diagnostic_updater::DiagnosticTaskVector::add": (1, 2, 3),
    "self_test::TestRunner": (0, 1, 2),
    "realtime_tools::RealtimePublisher": (3, 4),
    "realtime_tools::RealtimePublisher::init": (3, 4),
    "interactive_markers::InteractiveMarkerServer": (1, 2, 3),
    "robot_state_publisher::RobotStatePublisher": (1, 2),
    "robot_state_publisher::JointStateListener": (2, 3),
    "controller_manager::ControllerManager": (1, 2),
    "costmap_2d::Costmap2DROS": (2,),
    "moveit::planning_interface::MoveGroupInterface": (1, 2, 3),
    "bond::Bond": (2, 3, 4),
    "bond::Bond::start": (0,),
    "urdf::Model::initParam": (1,),
    "urdf::Model::initParamWithNodeHandle": (1, 2),
    "pluginlib::ClassLoader::createInstance": (1,),
}

#: Calls that make nothing, or nothing that their text tells: a row would say more than is known.
QUIET = (
    "ros::NodeHandle::getParamNames",
    "ros::NodeHandle::setCallbackQueue",
    "ros::AsyncSpinner",
    "ros::spin",
    "ros::Publisher::publish",
    "ros::master::getTopics",
    "message_filters::Cache",
    "message_filters::Synchronizer",
    "realtime_tools::RealtimeBuffer",
    "dynamic_reconfigure::Server::CallbackType",
    "dynamic_reconfigure::Server::updateConfig",
    "pluginlib::ClassLoader",
)

CLASSES = {
    "nodelet::Nodelet": ((), ("onInit",)),
    "nodelet_topic_tools::NodeletLazy": (("nodelet::Nodelet",), ("onInit", "subscribe", "unsubscribe")),
    "message_filters::Subscriber": (("message_filters::SimpleFilter",), ()),
    "image_transport::SubscriberFilter": (("message_filters::SimpleFilter",), ()),
    "message_filters::TimeSynchronizer": (("message_filters::Synchronizer",), ()),
    "tf2_ros::MessageFilter": (("tf2_ros::MessageFilterBase", "message_filters::SimpleFilter"), ()),
    "diagnostic_updater::Updater": (("diagnostic_updater::DiagnosticTaskVector",), ()),
}


@pytest.mark.parametrize("module", [name for name in CPP if name != "behavior_trees"])
def test_rows_are_literals(module: str) -> None:
    path = ROOT / "haros_ci" / "extract" / "apis" / f"{module}.py"
    body = ast.parse(path.read_text(encoding="utf-8")).body
    assert [type(node).__name__ for node in body] == ["Expr", "ImportFrom", "AnnAssign"]
    assert isinstance(body[2], ast.AnnAssign) and body[2].value is not None
    assert len(ast.literal_eval(body[2].value)) > 0


@every(("module", "row"), FORMS)
def test_every_row_loads_and_says_what_its_kind_needs(module: str, row: dict[str, object]) -> None:
    loaded = load_row(row)
    assert loaded.is_class or loaded.args, "a row for a call says with how many arguments"
    for entry in loaded.makes:
        if entry.kind in KINDS:
            assert "name" in entry.values
        if entry.kind in ("publishers", "subscribers"):
            assert "queue_size" in entry.values
        assert ("latched" in entry.values) == (entry.kind == "publishers")
        if entry.kind in ("rate", "timer"):
            assert len({"period", "frequency"} & entry.values.keys()) == 1


@every(("module", "row"), FORMS)
def test_no_row_selects_an_argument_that_its_call_never_has(module: str, row: dict[str, object]) -> None:
    most = max(load_row(row).args, default=0)
    text = repr({key: value for key, value in row.items() if key != "call"})
    selected = {int(n) for n in re.findall(r"\{(\d+)[.?|}]", text)}
    selected |= {int(n) for n in re.findall(r"(?:callback|typename|parent|search)\((\d+)", text)}
    assert all(n < most for n in selected)


def test_no_row_stands_twice() -> None:
    counted = Counter((row.call, row.args, row.when, row.is_class) for row in rows("cpp", 1))
    assert [key for key, count in counted.items() if count > 1] == []


def test_no_row_is_hidden_by_one_before_it() -> None:
    seen: dict[str, set[int]] = {}
    for row in rows("cpp", 1):
        if row.is_class:
            continue
        open_to = seen.setdefault(row.call, set())
        assert set(row.args) - open_to, f"{row.call} {row.args} {row.when}"
        if not row.when:
            open_to |= set(row.args)


@every(("call", "arguments"), COVERED.items())
def test_covered(call: str, arguments: tuple[int, ...]) -> None:
    found = {number for row in rows("cpp", 1) if row.call == call and not row.is_class for number in row.args}
    assert found == set(arguments)


@pytest.mark.parametrize("call", QUIET)
def test_quiet(call: str) -> None:
    assert [row for row in rows("cpp", 1) if row.call == call and not row.is_class] == []


@pytest.mark.parametrize(("name", "expected"), CLASSES.items())
def test_classes(name: str, expected: tuple[tuple[str, ...], tuple[str, ...]]) -> None:
    assert [(row.bases, row.entry) for row in rows("cpp", 1) if row.call == name and row.is_class] == [expected]


@pytest.mark.parametrize("ros", (0, 3))
def test_no_tables(ros: int) -> None:
    assert rows("cpp", ros) == ()
    assert rows("fortran", 1) == ()


def test_tables_are_imported_when_they_are_used() -> None:
    program = (
        "import sys, haros_ci.extract.apis.tables as t;"
        "b = {m for m in sys.modules if m.startswith('haros_ci.extract.apis.')};"
        "t.rows('cpp', 1);"
        "a = {m for m in sys.modules if m.startswith('haros_ci.extract.apis.')};"
        "print(len(b), len(a), 'haros_ci.extract.apis.rospy' in a)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1", str(1 + len(CPP)), "False"]
