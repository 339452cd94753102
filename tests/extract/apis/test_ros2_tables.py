# SPDX-License-Identifier: Apache-2.0
"""The tables of ROS 2 C++ calls: every row loads and is of use, and what must be covered is."""

from __future__ import annotations

import re
from importlib import import_module

import pytest
from every import every

from haros_ci.extract.apis.tables import TABLES, UNSURE, rows
from haros_ci.follow.ros.qos import qos_of
from haros_ci.model.api import Row, Template, load_row
from haros_ci.values.abstract import Known

CPP = next(modules for language, ros, modules in TABLES if (language, ros) == ("cpp", 2))
FORMS = [(module, row) for module in CPP for row in import_module(f"haros_ci.extract.apis.{module}").ROWS]
TOPICS, OFFERED = ("publishers", "subscribers"), ("servers", "clients")

#: Calls, each with the numbers of arguments that it is made with.
COVERED = {
    "rclcpp::Node": (1, 2, 3),
    "rclcpp::Node::make_shared": (1, 2, 3),
    "rclcpp_lifecycle::LifecycleNode": (1, 2, 3, 4),
    "rclcpp_lifecycle::LifecycleNode::make_shared": (1, 2, 3, 4),
    "rclcpp::Node::create_sub_node": (1,),
    "rclcpp::Node::get_name": (0,),
    "rclcpp::Node::get_namespace": (0,),
    "rclcpp::Node::get_fully_qualified_name": (0,),
    "rclcpp::Node::get_effective_namespace": (0,),
    "rclcpp::Node::get_sub_namespace": (0,),
    "rclcpp::Node::shared_from_this": (0,),
    "rclcpp::Node::weak_from_this": (0,),
    "rclcpp::Node::get_node_base_interface": (0,),
    "rclcpp::Node::get_node_topics_interface": (0,),
    "rclcpp::Node::get_node_parameters_interface": (0,),
    "rclcpp::NodeOptions": (0,),
    "rclcpp::NodeOptions::arguments": (0, 1),
    "rclcpp::NodeOptions::parameter_overrides": (0, 1),
    "rclcpp::NodeOptions::append_parameter_override": (2,),
    "rclcpp::NodeOptions::allow_undeclared_parameters": (0, 1),
    "rclcpp::NodeOptions::automatically_declare_parameters_from_overrides": (0, 1),
    "rclcpp::NodeOptions::use_intra_process_comms": (0, 1),
    "rclcpp::NodeOptions::start_parameter_services": (0, 1),
    "rclcpp::NodeOptions::enable_rosout": (0, 1),
    "rclcpp::NodeOptions::use_global_arguments": (0, 1),
    "rclcpp::Node::create_publisher": (2, 3),
    "rclcpp::Node::create_subscription": (3, 4, 5),
    "rclcpp::Node::create_service": (2, 3, 4),
    "rclcpp::Node::create_client": (1, 2, 3),
    "rclcpp::Node::create_generic_publisher": (3, 4),
    "rclcpp::Node::create_generic_subscription": (4, 5),
    "rclcpp::Node::create_generic_service": (3, 4, 5),
    "rclcpp::Node::create_generic_client": (2, 3, 4),
    "rclcpp::create_publisher": (3, 4, 5),
    "rclcpp::create_subscription": (4, 5, 6, 7),
    "rclcpp::create_service": (6,),
    "rclcpp::create_client": (4, 5, 6),
    "rclcpp::create_generic_publisher": (4, 5),
    "rclcpp::create_generic_subscription": (5, 6),
    "rclcpp::create_generic_service": (6, 7),
    "rclcpp::create_generic_client": (3, 4, 5, 6, 7),
    "rclcpp::wait_for_message": (3, 4),
    "rclcpp_action::create_server": (5, 6, 7, 8, 9, 10),
    "rclcpp_action::create_client": (2, 3, 4, 5, 6, 7),
    "rclcpp::Node::create_wall_timer": (2, 3, 4),
    "rclcpp::Node::create_timer": (2, 3),
    "rclcpp::create_timer": (4, 5, 6, 7),
    "rclcpp::create_wall_timer": (5, 6),
    "rclcpp::GenericTimer": (4, 5),
    "rclcpp::Node::declare_parameter": (1, 2, 3, 4),
    "rclcpp::Node::list_parameters": (2,),
    "rviz_common::Panel::getDisplayContext": (0,),
    "rviz_common::Display": (0, 1),
    "QObject::connect": (3, 4, 5),
    "rclcpp::Node::declare_parameters": (2, 3),
    "rclcpp::Node::undeclare_parameter": (1,),
    "rclcpp::Node::has_parameter": (1,),
    "rclcpp::Node::get_parameter": (1, 2),
    "rclcpp::Node::get_parameter_or": (2, 3),
    "rclcpp::Node::set_parameter": (1,),
    "rclcpp::Node::set_parameters": (1,),
    "rclcpp::Node::set_parameters_atomically": (1,),
    "rclcpp::Node::describe_parameter": (1,),
    "rclcpp::Node::add_on_set_parameters_callback": (1,),
    "rclcpp::Node::add_pre_set_parameters_callback": (1,),
    "rclcpp::Node::add_post_set_parameters_callback": (1,),
    "rclcpp::Parameter": (1, 2),
    "rclcpp::Parameter::as_string": (0,),
    "rclcpp::Parameter::get_value": (0,),
    "rclcpp::Parameter::get_parameter_value": (0,),
    "rclcpp::ParameterValue": (1,),
    "rclcpp::ParameterValue::get": (0,),
    "rclcpp::AsyncParametersClient": (1, 2, 3, 4, 5, 6, 7),
    "rclcpp::SyncParametersClient": (1, 2, 3, 4, 5, 6, 7),
    "rclcpp::ParameterEventHandler": (1, 2),
    "rclcpp::ParameterEventHandler::add_parameter_callback": (2, 3),
    "rclcpp::QoS": (1, 2),
    "rclcpp::KeepLast": (1,),
    "rclcpp::KeepAll": (0,),
    "rclcpp::QoSInitialization": (2,),
    "rclcpp::QoSInitialization::from_rmw": (1,),
    "rclcpp::SensorDataQoS": (0, 1),
    "rclcpp::QoS::keep_last": (1,),
    "rclcpp::QoS::keep_all": (0,),
    "rclcpp::QoS::reliable": (0,),
    "rclcpp::QoS::best_effort": (0,),
    "rclcpp::QoS::transient_local": (0,),
    "rclcpp::QoS::durability_volatile": (0,),
    "rclcpp::QoS::reliability": (0, 1),
    "rclcpp::QoS::durability": (0, 1),
    "rclcpp::QoS::history": (0, 1),
    "rclcpp::QoS::deadline": (0, 1),
    "rclcpp::QoS::lifespan": (0, 1),
    "rclcpp::QoS::liveliness": (0, 1),
    "rclcpp::QoS::liveliness_lease_duration": (0, 1),
    "rclcpp::QoS::avoid_ros_namespace_conventions": (1,),
    "rclcpp::QoS::get_rmw_qos_profile": (0,),
    "rclcpp::QosOverridingOptions": (0, 1, 2, 3),
    "rclcpp::QosOverridingOptions::with_default_policies": (0, 1, 2),
    "rclcpp::Duration": (1, 2),
    "rclcpp::Duration::from_seconds": (1,),
    "std::chrono::milliseconds": (1,),
    'operator""ms': (1,),
    "message_filters::Subscriber": (2, 3, 4),
    "message_filters::Subscriber::subscribe": (0, 2, 3, 4),
    "message_filters::SimpleFilter::registerCallback": (1, 2),
    "message_filters::Synchronizer::registerCallback": (1, 2),
    "tf2_ros::TransformListener": (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11),
    "tf2_ros::StaticTransformListener": (1, 2, 3, 4, 5, 6, 7, 8),
    "tf2_ros::TransformBroadcaster": (1, 2, 3, 4),
    "tf2_ros::StaticTransformBroadcaster": (1, 2, 3, 4),
    "tf2_ros::Buffer": (1, 2, 3, 4),
    "tf2_ros::Buffer::waitForTransform": (5,),
    "tf2_ros::BufferServer": (3, 4),
    "tf2_ros::BufferClient": (2, 3, 4),
    "image_transport::create_publisher": (2, 3, 4),
    "image_transport::create_subscription": (4, 5, 6),
    "image_transport::create_camera_publisher": (2, 3, 4),
    "image_transport::create_camera_subscription": (4, 5),
    "image_transport::ImageTransport::advertise": (2, 3),
    "image_transport::ImageTransport::subscribe": (3, 4, 5, 6),
    "image_transport::ImageTransport::advertiseCamera": (2, 3),
    "image_transport::ImageTransport::subscribeCamera": (3, 4, 5),
    "image_transport::SubscriberFilter::subscribe": (3, 4, 5),
    "image_transport::TransportHints": (1, 2, 3),
    "camera_info_manager::CameraInfoManager": (1, 2, 3, 4, 5, 6, 7),
    "point_cloud_transport::create_publisher": (2, 3, 4),
    "point_cloud_transport::create_subscription": (4, 5, 6),
    "point_cloud_transport::PointCloudTransport::advertise": (2, 3),
    "point_cloud_transport::PointCloudTransport::subscribe": (3, 4, 5),
    "diagnostic_updater::Updater": (1, 2, 6, 7),
    "diagnostic_updater::DiagnosticTaskVector::add": (1, 2, 3),
    "interactive_markers::InteractiveMarkerServer": (2, 3, 4, 6, 7, 8),
    "bond::Bond": (3, 4, 5, 7, 8, 9),
    "realtime_tools::RealtimePublisher": (1,),
    "nav2::LifecycleNode": (1, 2, 3),
    "nav2::LifecycleNode::create_subscription": (2, 3, 4),
    "nav2::LifecycleNode::create_publisher": (1, 2, 3),
    "nav2::LifecycleNode::create_action_server": (2, 3, 4, 5, 6, 7),
    "nav2::LifecycleNode::declare_or_get_parameter": (1, 2, 3),
    "nav2::declare_or_get_parameter": (2, 3, 4),
    "nav2_util::declare_parameter_if_not_declared": (3, 4),
    "nav2_util::SimpleActionServer": (3, 4, 5, 6, 7, 8),
    "nav2_util::ServiceClient": (2,),
    "autoware_utils::InterProcessPollingSubscriber": (2, 3),
    "autoware_utils_rclcpp::InterProcessPollingSubscriber::create_subscription": (2, 3),
    "autoware::universe_utils::getOrDeclareParameter": (2,),
    "tier4_autoware_utils::DebugPublisher::publish": (2, 3),
    "autoware_utils_debug::PublishedTimePublisher::publish_if_subscribed": (2,),
    "autoware_utils::LoggerLevelConfigure": (1,),
    "autoware::component_interface_utils::NodeAdaptor::init_sub": (2, 3),
}

#: Calls that make nothing, or nothing that their text tells: a row would say more than is known.
QUIET = (
    "rclcpp::Publisher::publish",
    "rclcpp::Context",
    "message_filters::Synchronizer",
    "message_filters::Cache",
    "tf2_ros::MessageFilter",
    "laser_geometry::LaserProjection",
    "autoware_utils::update_param",
    "autoware::universe_utils::updateParam",
    "ros::NodeHandle",
)

CLASSES = {
    "rclcpp_lifecycle::LifecycleNode": (
        ("rclcpp::Node", "rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface"),
        ("on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error"),
    ),
    "rclcpp::node_interfaces::NodeTypeDescriptionsInterface": (("rclcpp::Node",), ()),
    "nav2::LifecycleNode": (("rclcpp_lifecycle::LifecycleNode",), ()),
    "rclcpp::SensorDataQoS": (("rclcpp::QoS",), ()),
    "rclcpp::KeepAll": (("rclcpp::QoSInitialization",), ()),
    "message_filters::TimeSynchronizer": (("message_filters::Synchronizer",), ()),
    "rclcpp::executors::MultiThreadedExecutor": (("rclcpp::Executor",), ()),
}


def _rows(call: str) -> list[Row]:
    return [row for row in rows("cpp", 2) if row.call == call and not row.is_class]


@every(("module", "row"), FORMS)
def test_every_row_loads_and_is_of_one_form(module: str, row: dict[str, object]) -> None:
    loaded = load_row(row)
    assert module.startswith(("ros2_", "threads", "shared_pointers", "gazebo", "behavior_trees"))
    assert loaded.is_class or loaded.args, "every call says for how many arguments it holds"
    for entry in loaded.makes:
        if entry.kind in TOPICS + OFFERED:
            assert "qos" in entry.values, "the quality of service of a topic or service is told"
            assert "queue_size" not in entry.values and "latched" not in entry.values, "those are of ROS 1"


@every(("module", "row"), FORMS)
def test_selected_arguments_are_there(module: str, row: dict[str, object]) -> None:
    loaded = load_row(row)
    told = [*(template for _, template in (*loaded.fills, *loaded.sets)), loaded.returns, loaded.transparent]
    for entry in loaded.makes:
        told += [template for key, template in entry.values.items() if key not in ("options", "descriptor")]
    for template in told:
        for part in template.parts if template is not None else ():
            for alternative in () if isinstance(part, str) or part[1] is not None else part[0]:
                found = re.match(r"(\d+)|\w+\((\d+)", alternative)
                if found is not None:
                    assert int(found[1] or found[2]) < max(loaded.args), alternative


@every(("module", "row"), FORMS)
def test_literal_types_are_of_ros_2(module: str, row: dict[str, object]) -> None:
    for entry in load_row(row).makes:
        kind = entry.values.get("type")
        if kind is None or not all(isinstance(part, str) for part in kind.parts):
            continue
        word = {"publishers": "msg", "subscribers": "msg", "servers": "srv", "clients": "srv"}.get(entry.kind, "action")
        if entry.kind in (*TOPICS, *OFFERED, "action_servers", "action_clients"):
            assert re.fullmatch(rf"[a-z][a-z0-9_]*/{word}/[A-Z]\w*", str(kind.parts[0])), kind


@every(("module", "row"), FORMS)
def test_literal_qualities_of_service_are_known(module: str, row: dict[str, object]) -> None:
    for entry in load_row(row).makes:
        given = entry.values.get("qos", Template(("10",)))
        texts = [part if isinstance(part, str) else part[1] for part in given.parts]
        if len(texts) == 1 and texts[0] not in (None, "?"):
            profile = str(texts[0])
            found, why = qos_of(Known(int(profile) if profile.isdigit() else profile))
            assert why is None and found.history is not None, profile


@every(("call", "numbers"), COVERED.items())
def test_covered(call: str, numbers: tuple[int, ...]) -> None:
    covered = {number for row in _rows(call) for number in row.args}
    assert set(numbers) <= covered


@pytest.mark.parametrize("call", QUIET)
def test_quiet(call: str) -> None:
    assert _rows(call) == []


@pytest.mark.parametrize(("name", "expected"), CLASSES.items(), ids=CLASSES)
def test_classes(name: str, expected: tuple[tuple[str, ...], tuple[str, ...]]) -> None:
    assert [(row.bases, row.entry) for row in rows("cpp", 2) if row.call == name and row.is_class] == [expected]


@pytest.mark.parametrize(
    ("call", "topic", "expected"),
    (
        ("image_transport::create_publisher", 1, ("compressed", "compressedDepth", "theora", "zstd")),
        ("image_transport::create_camera_publisher", 1, ("compressed", "compressedDepth", "theora", "zstd")),
        ("image_transport::ImageTransport::advertise", 0, ("compressed", "compressedDepth", "theora", "zstd")),
        ("point_cloud_transport::create_publisher", 1, ("draco", "zlib", "zstd")),
    ),
)
def test_transports_are_beside_what_is_advertised(call: str, topic: int, expected: tuple[str, ...]) -> None:
    for row in _rows(call):
        below = [entry for entry in row.makes if entry.implicit]
        assert [entry.values["name"].parts for entry in below] == [
            (((f"resolve({topic})",), None), f"/{name}") for name in expected
        ]
        assert {entry.unsure for entry in below} == {UNSURE}


@pytest.mark.parametrize("call", ("image_transport::create_subscription", "tf2_ros::TransformBroadcaster"))
def test_what_the_source_makes_is_not_implicit(call: str) -> None:
    assert not any(entry.implicit for row in _rows(call) for entry in row.makes)


def test_ros_1_has_none_of_them() -> None:
    ours = {row.call for row in rows("cpp", 2)}
    shared = {row.call for row in rows("cpp", 1)} & ours
    assert not any(call.startswith(("ros::", "rclcpp")) for call in shared)
