# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: message filters, transforms, transports, tools, wrappers of Autoware and navigation."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import ends, ros2_cpp, ros2_main
from ros2_cpp_kit import BEST, KEPT, PUB, SUB, by_name, component, explicit, last, only, policies

from haros_ci.extract.apis.tables import UNSURE

FILTERS = (
    'message_filters::Subscriber<String> one_, two_{this, "two", rmw_qos_profile_sensor_data};'
    "using Policy = message_filters::sync_policies::ApproximateTime<String, String>;"
    "using Sync = message_filters::Synchronizer<Policy>; std::shared_ptr<Sync> sync_;"
    f'void both(String::ConstSharedPtr a, String::ConstSharedPtr b) {{ {PUB}("both", 1); }}'
)


def test_message_filters() -> None:
    body = (
        'one_.subscribe(this, "one", rclcpp::QoS(3).best_effort().get_rmw_qos_profile());'
        "sync_ = std::make_shared<Sync>(Policy(10), one_, two_);"
        "sync_->registerCallback(std::bind(&N::both, this, std::placeholders::_1, std::placeholders::_2));"
    )
    found = component(body, FILTERS)
    assert [(end.name, end.type, policies(end)) for end in explicit(found, "subscribers")] == [
        ("/one", "std_msgs/msg/String", last(3, BEST)),
        ("/two", "std_msgs/msg/String", last(5, BEST)),
    ]
    assert [end.name for end in explicit(found)] == ["/both"]


def test_a_filter_that_is_not_subscribed_has_no_topic() -> None:
    assert (
        explicit(
            component("one_.subscribe();", FILTERS.replace('{this, "two", rmw_qos_profile_sensor_data}', "")),
            "subscribers",
        )
        == []
    )


def test_transforms() -> None:
    body = (
        "broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>(*this);"
        "still_ = std::make_shared<tf2_ros::StaticTransformBroadcaster>(this);"
        "buffer_ = std::make_unique<tf2_ros::Buffer>(get_clock());"
        "listener_ = std::make_shared<tf2_ros::TransformListener>(*buffer_, this, false);"
    )
    members = "std::unique_ptr<tf2_ros::Buffer> buffer_;"
    found = component(body, members)
    assert [(end.name, policies(end)) for end in explicit(found)] == [
        ("/tf", last(100)),
        ("/tf_static", last(1, "reliable", KEPT)),
    ]
    assert [(end.name, policies(end)) for end in explicit(found, "subscribers")] == [
        ("/tf", last(100)),
        ("/tf_static", last(100, "reliable", KEPT)),
    ]


@pytest.mark.parametrize("more", ("", ", true", ", false"))
def test_a_listener_without_a_node_has_its_own(more: str) -> None:
    found = by_name(
        ros2_cpp("", f"tf2_ros::Buffer buffer_{{get_clock()}}; tf2_ros::TransformListener l_{{buffer_{more}}};")
    )
    assert explicit(found["/n"], "subscribers") == []
    (hidden,) = (node for name, node in found.items() if name != "/n")
    assert hidden.name == "/transform_listener_impl_?"
    assert [end.name for end in explicit(hidden, "subscribers")] == ["/tf", "/tf_static"]


TRANSPORT = "std::shared_ptr<image_transport::ImageTransport> it_;"
MAKE_IT = "it_ = std::make_shared<image_transport::ImageTransport>(this);"


@pytest.mark.parametrize(
    ("call", "qos"),
    (
        ('image_transport::create_publisher(this, "camera/image")', last(10)),
        ('image_transport::create_publisher(this, "camera/image", rmw_qos_profile_sensor_data)', last(5, BEST)),
        ('it_->advertise("camera/image", 2)', last(2)),
        ('it_->advertise("camera/image", rmw_qos_profile_sensor_data, true)', last(5, BEST)),
    ),
)
def test_images_that_are_published(call: str, qos: tuple[Any, ...]) -> None:
    found = component(f"{MAKE_IT} p_ = {call};", TRANSPORT)
    assert [(end.name, end.type, policies(end)) for end in explicit(found)] == [
        ("/camera/image", "sensor_msgs/msg/Image", qos)
    ]
    below = [end for end in ends(found) if end.name.startswith("/camera/image/")]
    assert [end.name.rpartition("/")[2] for end in below] == ["compressed", "compressedDepth", "theora", "zstd"]
    assert all(end.implicit and [each.reason for each in end.unknowns] == [UNSURE] for end in below)


@pytest.mark.parametrize(
    ("call", "kind"),
    (
        ('image_transport::create_camera_publisher(this, "camera/image")', "publishers"),
        ('it_->advertiseCamera("camera/image", 10)', "publishers"),
        (
            'image_transport::create_camera_subscription(this, "camera/image", [](auto i, auto c) {}, "raw")',
            "subscribers",
        ),
        ('it_->subscribeCamera("camera/image", 10, [](auto i, auto c) {})', "subscribers"),
    ),
)
def test_cameras(call: str, kind: str) -> None:
    found = component(f"{MAKE_IT} p_ = {call};", TRANSPORT)
    assert [(end.name, end.type, policies(end)) for end in explicit(found, kind)] == [
        ("/camera/camera_info", "sensor_msgs/msg/CameraInfo", last(10)),
        ("/camera/image", "sensor_msgs/msg/Image", last(10)),
    ]


def test_clouds() -> None:
    members = "std::shared_ptr<point_cloud_transport::PointCloudTransport> pct_;"
    body = "pct_ = std::make_shared<point_cloud_transport::PointCloudTransport>(this);"
    end = only(component(f'{body} p_ = pct_->advertise("points", 7);', members))
    assert (end.name, end.type, policies(end)) == ("/points", "sensor_msgs/msg/PointCloud2", last(7, BEST))


def test_tools() -> None:
    body = (
        "updater_ = std::make_unique<diagnostic_updater::Updater>(this, 0.5);"
        f'updater_->add("check", [this](diagnostic_updater::DiagnosticStatusWrapper & s) {{ {PUB}("checked", 1); }});'
        'bond_ = std::make_unique<bond::Bond>("bond", "id", shared_from_this());'
        'markers_ = std::make_unique<interactive_markers::InteractiveMarkerServer>("m", this);'
        'manager_ = std::make_unique<camera_info_manager::CameraInfoManager>(this, "camera");'
    )
    found = component(body, "std::unique_ptr<diagnostic_updater::Updater> updater_;")
    assert [(end.name, policies(end)[1]) for end in explicit(found)] == [
        ("/bond", 5),
        ("/checked", 1),
        ("/diagnostics", 1),
        ("/m/update", 100),
    ]
    assert [end.name for end in explicit(found, "subscribers")] == ["/bond", "/m/feedback"]
    assert [end.name for end in explicit(found, "servers")] == ["/m/get_interactive_markers", "/n/set_camera_info"]
    assert [(end.name, end.value) for end in explicit(found, "parameters")] == [
        ("/n:bond_disable_heartbeat_timeout", False),
        ("/n:diagnostic_updater.period", 0.5),
        ("/n:diagnostic_updater.use_fqn", False),
    ]


def test_wrappers_of_autoware() -> None:
    members = (
        'autoware_utils::InterProcessPollingSubscriber<String> one_{this, "~/input/one"};'
        "autoware_utils::InterProcessPollingSubscriber<String>::SharedPtr two_, three_;"
        "std::unique_ptr<autoware_utils::DebugPublisher> debug_;"
        "std::unique_ptr<autoware_utils::PublishedTimePublisher> time_; rclcpp::Publisher<String>::SharedPtr p_;"
    )
    body = (
        'three_ = decltype(three_)::element_type::create_subscription(this, "~/input/three", 3);'
        'two_ = autoware_utils::InterProcessPollingSubscriber<String>::create_subscription(this, "~/input/two",'
        " rclcpp::QoS{1}.transient_local());"
        'debug_ = std::make_unique<autoware_utils::DebugPublisher>(this, "~/debug"); debug_->publish<String>("d", 1);'
        f'p_ = {PUB}("~/output", 1); time_ = std::make_unique<autoware_utils::PublishedTimePublisher>(this);'
        "time_->publish_if_subscribed(p_, now());"
        "logger_ = std::make_unique<autoware_utils::LoggerLevelConfigure>(this);"
    )
    found = component(body, members)
    assert [(end.name, end.type, policies(end)) for end in explicit(found, "subscribers")] == [
        ("/n/input/one", "std_msgs/msg/String", last(1)),
        ("/n/input/three", "std_msgs/msg/String", last(3)),
        ("/n/input/two", "std_msgs/msg/String", last(1, "reliable", KEPT)),
    ]
    assert [(end.name, end.type) for end in explicit(found)] == [
        ("/n/debug/d", "std_msgs/msg/String"),
        ("/n/output", "std_msgs/msg/String"),
        ("/n/output/debug/published_time", "autoware_internal_msgs/msg/PublishedTime"),
    ]
    assert [(end.name, end.type) for end in explicit(found, "servers")] == [
        ("/n/config_logger", "logging_demo/srv/ConfigLogger")
    ]


def test_aliases_of_messages_and_qualities_of_service_in_libraries() -> None:
    members = (
        "rclcpp::Publisher<autoware_utils::ProcessingTimeDetail>::SharedPtr detail_;"
        'autoware_utils::InterProcessPollingSubscriber<String> s_{this, "s", autoware_utils::single_depth_sensor_qos()};'
    )
    body = (
        'detail_ = create_publisher<autoware_utils::ProcessingTimeDetail>("detail", 1);'
        'create_publisher<autoware_utils::ProcessingTime>("other", 1);'
    )
    found = component(body, members)
    assert [(end.name, end.type) for end in explicit(found)] == [
        ("/detail", "autoware_internal_debug_msgs/msg/ProcessingTimeTree"),
        ("/other", None),
    ]
    assert policies(only(found, "subscribers")) == last(1, BEST)


def test_wrappers_of_navigation() -> None:
    before = f"""
class L : public nav2::LifecycleNode {{
public:
  L() : nav2::LifecycleNode("l", "", rclcpp::NodeOptions()) {{
    speed_ = declare_or_get_parameter("speed", 0.5);
  }}
  nav2::CallbackReturn on_configure(const rclcpp_lifecycle::State &) {{
    p_ = {PUB}("a");
    s_ = {SUB}("b", [this](String::ConstSharedPtr m) {{}}, nav2::qos::LatchedSubscriptionQoS());
    c_ = create_client<std_srvs::srv::Empty>("c", true);
    x_ = create_action_server<p::action::Do>("x", std::bind(&L::execute, this));
    return nav2::CallbackReturn::SUCCESS;
  }}
  void execute() {{ {PUB}("executed"); }}
  double speed_;
}};
"""
    (found,) = ros2_main("auto l = std::make_shared<L>(); rclcpp::spin(l->get_node_base_interface());", before).nodes
    assert (found.name, found.kind) == ("/l", "lifecycle")
    assert [(end.name, policies(end)) for end in explicit(found)] == [("/a", last(10)), ("/executed", last(10))]
    assert [(end.name, policies(end)) for end in explicit(found, "subscribers")] == [("/b", last(10, "reliable", KEPT))]
    assert [end.name for end in explicit(found, "clients")] == ["/c"]
    assert [(end.name, end.type) for end in explicit(found, "action_servers")] == [("/x", "p/action/Do")]
    assert ("/l:speed", 0.5) in [(end.name, end.value) for end in explicit(found, "parameters")]


@pytest.mark.parametrize(
    "started",
    (
        "t_ = std::thread(&N::run, this);",
        "t_ = std::thread([this]() { run(); });",
        "t_ = std::make_unique<std::thread>(std::bind(&N::run, this));",
        "f_ = std::async(std::launch::async, [this]() { run(); });",
        "f_ = std::async(&N::run, this);",
    ),
)
def test_what_threads_run_is_followed(started: str) -> None:
    found = component(started, f'void run() {{ p_ = {PUB}("out", 1); }}\nstd::thread t_;\nstd::future<void> f_;')
    assert [end.name for end in explicit(found)] == ["/out"]


def test_a_function_that_is_run_once_more_keeps_what_parameters_are_known() -> None:
    body = """
        declare_parameter("topic", "out");
        f_ = std::async(std::launch::async, [this]() { declare_parameter("other", 1); });
        p_ = create_publisher<String>(get_parameter("topic").as_string(), 1);
    """
    assert [end.name for end in explicit(component(body, "std::future<void> f_;"))] == ["/out"]
