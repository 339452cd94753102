# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 Python tables: calls as programs write them, the row that each selects, and what the row takes from it."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from importlib import import_module

import pytest
from every import every

from haros_ci.extract.apis.python_threads import EXECUTORS, POOLS, PROCESSES
from haros_ci.model.api import Row, Template, load_row

MODULES = (
    "ros2_rclpy",
    "ros2_rclpy_qos",
    "ros2_rclpy_libraries",
    "ros2_rclpy_navigator",
    "ros2_rclpy_smach",
    "python_threads",
)
FORMS = [row for module in MODULES for row in import_module(f"haros_ci.extract.apis.{module}").ROWS]
ROWS = [load_row(form) for form in FORMS]
#: What variables of the calls below are.
TYPES = {
    "node": "rclpy.node.Node",
    "Parameter.Type.BOOL": "rclpy.parameter.Parameter.Type",
    "rclpy.Parameter.Type.BOOL": "rclpy.Parameter.Type",
}
KINDS = (
    "publishers subscribers servers clients action_servers action_clients getters setters parameters node timer rate"
)


class Call:
    """A call as it is written: ``create_timer(1.0, callback=f)``; texts are without their quotes."""

    def __init__(self, written: str) -> None:
        call = ast.parse(f"f({written})", mode="eval").body
        assert isinstance(call, ast.Call)
        self.given = {str(n): shown(value) for n, value in enumerate(call.args)}
        self.given |= {str(each.arg): shown(each.value) for each in call.keywords}

    def row(self, name: str) -> Row:
        """The first row that fits."""
        for row in ROWS:
            fits = row.call == name and not row.is_class and (not row.args or len(self.given) in row.args)
            if fits and all(TYPES.get(self.given.get(where, "")) == kind for where, kind in row.when):
                return row
        raise AssertionError(f"no row for {name}")

    def selected(self, alternative: str) -> str | None:
        """What an alternative of a selector takes; of the receiver, the parameter and an item their names."""
        function, bracket, inside = alternative.partition("(")
        if bracket:
            found = next((f for f in map(self.selected, inside[:-1].split("|")) if f is not None), None)
            return found if found is None or function in ("typename", "typeof") else f"{function}({found})"
        head, dot, rest = alternative.partition(".")
        if head in ("this", "item", "parameter", "node") and (dot or head not in self.given):
            return alternative
        return f"{self.given[head]}{dot}{rest}" if head in self.given else None

    def said(self, template: Template) -> str:
        parts = []
        for part in template.parts:
            if isinstance(part, str):
                parts.append(part)
                continue
            found = next((f for f in map(self.selected, part[0]) if f is not None), None)
            parts.append(found if found is not None else part[1] if part[1] is not None else "-")
        return "".join(parts)


def shown(value: ast.expr) -> str:
    is_text = isinstance(value, ast.Constant) and isinstance(value.value, str)
    return ast.unparse(value)[1:-1] if is_text else ast.unparse(value)


def told(name: str, written: str) -> str:
    """What the row for a call takes from it, entry by entry; what is not given is left out."""
    call = Call(written)
    row = call.row(name)
    lines = []
    for entry in row.makes:
        values = {key: call.said(value) for key, value in entry.values.items()}
        marks = [f"each={entry.each}"] if entry.each else []
        marks += ["implicit"] if entry.implicit else []
        marks += ["unsure"] if entry.unsure else []
        lines.append(" ".join([entry.kind, *(f"{k}={v}" for k, v in values.items() if v != "-"), *marks]))
    lines += [f"calls {call.given[where]}" for where in row.calls if where in call.given]
    lines += [f"returns {call.said(row.returns)}"] if row.returns is not None else []
    fills = {key: call.said(value) for key, value in row.fills}
    lines += [f"fills {key}={value}" for key, value in fills.items() if value != "-"]
    lines += [f"unseen {row.unseen}"] if row.unseen else []
    return "\n".join(lines)


N = "rclpy.node.Node"
SERVICE = "qos=rclpy.qos.qos_profile_services_default"
PARAMETER = "returns rclpy.parameter.Parameter\nfills name=a"
PUBLISHER = "returns rclpy.publisher.Publisher\nfills topic=a\nfills topic_name=resolve(a)"
SUBSCRIPTION = "returns rclpy.subscription.Subscription\nfills topic=a\nfills topic_name=resolve(a)"
SERVER = "returns rclpy.service.Service\nfills srv_name=a\nfills service_name=resolve(a)"
CLIENT = "returns rclpy.client.Client\nfills srv_name=a\nfills service_name=resolve(a)"
FUTURE = "returns rclpy.task.Future"
LOGGER = "returns rclpy.impl.rcutils_logger.RcutilsLogger"
TF = "type=tf2_msgs/msg/TFMessage"
DIAGNOSTICS = (
    "publishers name=/diagnostics type=diagnostic_msgs/msg/DiagnosticArray qos=1 namespace=node\n"
    "parameters name=diagnostic_updater.period value={} namespace=node\n"
    "parameters name=diagnostic_updater.use_fqn type=bool value=false namespace=node\nfills node=node"
)
MARKERS = (
    f"servers name=m/get_interactive_markers type=visualization_msgs/srv/GetInteractiveMarkers {SERVICE} namespace=node\n"
    "publishers name=m/update type=visualization_msgs/msg/InteractiveMarkerUpdate qos={} namespace=node\n"
    "subscribers name=m/feedback type=visualization_msgs/msg/InteractiveMarkerFeedback qos={} namespace=node\n"
    "fills node=node"
)
FRAMES = f"servers name=tf2_frames type=tf2_msgs/srv/FrameGraph {SERVICE} namespace="
IMAGE = "publishers name=i type=sensor_msgs/msg/Image qos=1"
COMPRESSED = "\n".join(
    f"publishers name=i/{name} type={kind} qos=1 implicit unsure"
    for name, kind in (
        ("compressed", "sensor_msgs/msg/CompressedImage"),
        ("compressedDepth", "sensor_msgs/msg/CompressedImage"),
        ("theora", "theora_image_transport/msg/Packet"),
        ("zstd", "sensor_msgs/msg/CompressedImage"),
    )
)
STATE = f"type=lifecycle_msgs/srv/GetState {SERVICE}"
NAVIGATOR = "nav2_simple_commander.robot_navigator.BasicNavigator"

CALLS = (
    (N, "'n'", "node name=n"),
    (N, "node_name='n', namespace='s'", "node name=n namespace=s"),
    ("rclpy.create_node", "'n', namespace=s", "node name=n namespace=s\nreturns rclpy.node.Node"),
    ("rclpy.lifecycle.LifecycleNode", "'n'", "node name=n lifecycle=true"),
    ("rclpy.lifecycle.Node", "'n', namespace='s'", "node name=n namespace=s lifecycle=true"),
    ("rclpy.lifecycle.LifecycleNodeMixin", "", ""),
    (f"{N}.create_publisher", "T, 'a', 10", f"publishers name=a type=T qos=10\n{PUBLISHER}"),
    (f"{N}.create_publisher", "msg_type=T, topic='a', qos_profile=q", f"publishers name=a type=T qos=q\n{PUBLISHER}"),
    (
        f"{N}.create_publisher",
        "T, 'a', 10, qos_overriding_options=o",
        f"publishers name=a type=T qos=10 options=o\n{PUBLISHER}",
    ),
    (
        "rclpy.lifecycle.LifecycleNodeMixin.create_lifecycle_publisher",
        "T, 'a', 10",
        "publishers name=a type=T qos=10\nreturns rclpy.lifecycle.LifecyclePublisher\nfills topic=a\nfills topic_name=resolve(a)",
    ),
    (f"{N}.create_subscription", "T, 'a', f, 1", f"subscribers name=a type=T qos=1\ncalls f\n{SUBSCRIPTION}"),
    (
        f"{N}.create_subscription",
        "T, 'a', callback=f, qos_profile=q, callback_group=g",
        f"subscribers name=a type=T qos=q\ncalls f\n{SUBSCRIPTION}",
    ),
    (f"{N}.create_service", "T, 'a', f", f"servers name=a type=T {SERVICE}\ncalls f\n{SERVER}"),
    (
        f"{N}.create_service",
        "srv_type=T, srv_name='a', callback=f, qos_profile=q",
        f"servers name=a type=T qos=q\ncalls f\n{SERVER}",
    ),
    (f"{N}.create_client", "T, 'a'", f"clients name=a type=T {SERVICE}\n{CLIENT}"),
    (f"{N}.create_client", "T, srv_name='a', qos_profile=q", f"clients name=a type=T qos=q\n{CLIENT}"),
    (f"{N}.create_timer", "0.5, f", "timer period=0.5\ncalls f\nreturns rclpy.timer.Timer"),
    (
        f"{N}.create_timer",
        "timer_period_sec=p, callback=f",
        "timer period=p\ncalls f\nreturns rclpy.timer.Timer",
    ),
    (f"{N}.create_rate", "20", "rate frequency=20\nreturns rclpy.timer.Rate"),
    (f"{N}.create_rate", "frequency=20", "rate frequency=20\nreturns rclpy.timer.Rate"),
    (f"{N}.create_guard_condition", "f", "calls f\nreturns rclpy.guard_condition.GuardCondition"),
    (f"{N}.declare_parameter", "'a'", f"parameters name=a\n{PARAMETER}\nfills value=parameter"),
    (
        f"{N}.declare_parameter",
        "'a', 1, d",
        f"parameters name=a type=1 value=1 descriptor=d\n{PARAMETER}\nfills value=parameter",
    ),
    (
        f"{N}.declare_parameter",
        "name='a', value=v, descriptor=d, ignore_override=True",
        f"parameters name=a type=v value=v descriptor=d\n{PARAMETER}\nfills value=parameter",
    ),
    (
        f"{N}.declare_parameter",
        "'a', Parameter.Type.BOOL",
        f"parameters name=a type=Parameter.Type.BOOL\n{PARAMETER}\nfills value=parameter",
    ),
    (
        f"{N}.declare_parameter",
        "name='a', value=rclpy.Parameter.Type.BOOL, descriptor=d",
        f"parameters name=a type=rclpy.Parameter.Type.BOOL descriptor=d\n{PARAMETER}\nfills value=parameter",
    ),
    (
        f"{N}.declare_parameters",
        "namespace='s', parameters=p",
        (
            "parameters name=s.item.name type=item.type value=item.default descriptor=item.descriptor "
            "each=items(1|parameters)"
        ),
    ),
    (f"{N}.get_parameter", "'a'", f"getters name=a\n{PARAMETER}\nfills value=parameter"),
    (f"{N}.get_parameter", "name='a'", f"getters name=a\n{PARAMETER}\nfills value=parameter"),
    (f"{N}.get_parameter_or", "'a', p", f"getters name=a value=p.value\n{PARAMETER}\nfills value=parameter"),
    (
        f"{N}.get_parameter_or",
        "name='a', alternative_value=p",
        f"getters name=a value=p.value\n{PARAMETER}\nfills value=parameter",
    ),
    (f"{N}.get_parameters", "names", "getters name=item.name each=items(0|names)\nreturns parameter"),
    (f"{N}.get_parameter_types", "names=n", "getters name=item.name each=items(0|names)"),
    (f"{N}.get_parameter_type", "'a'", "getters name=a"),
    (f"{N}.get_parameters_by_prefix", "'a'", ""),
    (f"{N}.has_parameter", "'a'", "returns declared(a)"),
    (f"{N}.has_parameter", "name='a'", "returns declared(a)"),
    (
        f"{N}.set_parameters",
        "p",
        "setters name=item.name type=item.type value=item.default each=items(0|parameter_list)",
    ),
    (
        f"{N}.set_parameters_atomically",
        "parameter_list=p",
        "setters name=item.name type=item.type value=item.default each=items(0|parameter_list)",
    ),
    (f"{N}.undeclare_parameter", "'a'", "setters name=a"),
    (f"{N}.add_pre_set_parameters_callback", "f", "calls f"),
    (f"{N}.add_on_set_parameters_callback", "callback=f", "calls f"),
    (f"{N}.add_post_set_parameters_callback", "f", "calls f"),
    (f"{N}.set_parameters_callback", "f", "calls f"),
    (f"{N}.get_name", "", "returns node.base_name"),
    (f"{N}.get_namespace", "", "returns node.namespace"),
    (f"{N}.get_fully_qualified_name", "", "returns node.name"),
    (f"{N}.resolve_topic_name", "'a'", "returns resolve(a)"),
    (f"{N}.resolve_service_name", "service='a'", "returns resolve(a)"),
    (f"{N}.get_logger", "", LOGGER),
    (f"{N}.get_clock", "", "returns rclpy.clock.Clock"),
    ("rclpy.parameter.Parameter", "'a', t, 1", "fills name=a\nfills type_=t\nfills value=1"),
    ("rclpy.Parameter", "'a', value=1", "fills name=a\nfills value=1"),
    ("rclpy.node.Parameter", "name='a', type_=t, value=1", "fills name=a\nfills type_=t\nfills value=1"),
    (
        "rcl_interfaces.msg.ParameterDescriptor",
        "description='d', read_only=True, integer_range=[r]",
        "fills description=d\nfills read_only=True\nfills integer_range=[r]",
    ),
    ("rcl_interfaces.msg.IntegerRange", "from_value=1", "fills from_value=1\nfills to_value=0\nfills step=0"),
    (
        "rcl_interfaces.msg.FloatingPointRange",
        "from_value=1.0, to_value=2.0",
        "fills from_value=1.0\nfills to_value=2.0\nfills step=0.0",
    ),
    (
        "rclpy.parameter_event_handler.ParameterEventHandler",
        "node",
        (
            "subscribers name=/parameter_events type=rcl_interfaces/msg/ParameterEvent "
            "qos=rclpy.qos.qos_profile_parameter_events namespace=node"
        ),
    ),
    ("rclpy.parameter_event_handler.ParameterEventHandler.add_parameter_callback", "'p', 'n', f", "calls f"),
    (
        "rclpy.parameter_event_handler.ParameterEventHandler.add_parameter_callback",
        "parameter_name='p', node_name='n', callback=f",
        "calls f",
    ),
    ("rclpy.parameter_event_handler.ParameterEventHandler.add_parameter_event_callback", "callback=f", "calls f"),
    (
        "rclpy.wait_for_message.wait_for_message",
        "T, node, 'a', time_to_wait=1",
        "subscribers name=a type=T qos=1 namespace=node",
    ),
    (
        "rclpy.wait_for_message.wait_for_message",
        "T, node, 'a', qos_profile=q",
        "subscribers name=a type=T qos=q namespace=node",
    ),
    (
        "rclpy.action.ActionServer",
        "node, A, 'a', f, cancel_callback=c, goal_callback=g",
        "action_servers name=a type=A namespace=node\ncalls f\ncalls g\ncalls c",
    ),
    (
        "rclpy.action.server.ActionServer",
        "node=node, action_type=A, action_name='a', execute_callback=f, handle_accepted_callback=h",
        "action_servers name=a type=A namespace=node\ncalls f\ncalls h",
    ),
    ("rclpy.action.ActionServer.register_execute_callback", "f", "calls f"),
    ("rclpy.action.ActionServer.register_goal_callback", "f", "calls f"),
    ("rclpy.action.ActionServer.register_cancel_callback", "f", "calls f"),
    ("rclpy.action.ActionServer.register_handle_accepted_callback", "f", "calls f"),
    ("rclpy.action.ActionClient", "node, A, 'a'", "action_clients name=a type=A namespace=node"),
    (
        "rclpy.action.client.ActionClient",
        "node, action_type=A, action_name='a'",
        "action_clients name=a type=A namespace=node",
    ),
    ("rclpy.action.ActionClient.send_goal_async", "g, f", f"calls f\n{FUTURE}"),
    ("rclpy.action.ActionClient.send_goal_async", "g, feedback_callback=f", f"calls f\n{FUTURE}"),
    ("rclpy.action.ActionClient.send_goal", "g, feedback_callback=f", "calls f"),
    ("rclpy.client.Client.call_async", "r", FUTURE),
    ("rclpy.client.Client.configure_introspection", "c, q, s", "unseen the events of a service are published"),
    ("rclpy.task.Future.add_done_callback", "f", "calls f"),
    ("rclpy.executors.Executor.create_task", "f, 1", "calls f\nreturns rclpy.task.Task"),
    ("rclpy.context.Context.on_shutdown", "f", "calls f"),
    ("rclpy.clock.Clock.create_jump_callback", "t, post_callback=f", "calls f"),
    ("rclpy.event_handler.SubscriptionEventCallbacks", "deadline=f, message_lost=g", "calls f\ncalls g"),
    ("rclpy.event_handler.PublisherEventCallbacks", "matched=f", "calls f"),
    ("rclpy.qos_event.PublisherEventCallbacks", "liveliness=f", "calls f"),
    ("rclpy.logging.get_logger", "'n'", LOGGER),
    (
        "ament_index_python.get_package_share_directory",
        "'p'",
        "returns $(find-pkg-share p)",
    ),
    (
        "ament_index_python.packages.get_package_share_directory",
        "package_name='p'",
        "returns $(find-pkg-share p)",
    ),
    ("ament_index_python.packages.get_package_prefix", "'p'", "returns $(find-pkg-prefix p)"),
    ("threading.Thread", "target=f", "calls f"),
    ("threading.Timer", "1.0, f", "calls f"),
    # Processes, pools and executors.
    *((name, "target=f", "calls f") for name in PROCESSES),
    ("multiprocessing.context.BaseContext.Process", "None, f", "calls f"),
    *(
        (f"multiprocessing.pool.Pool.{name}", "f, a", "calls f")
        for name in ("apply", "apply_async", "map", "map_async", "imap", "imap_unordered")
    ),
    ("concurrent.futures.Executor.submit", "f, 'a'", "calls f"),
    ("concurrent.futures.Executor.map", "f, a", "calls f"),
    ("multiprocessing.get_context", "'spawn'", "returns multiprocessing.context.BaseContext"),
    *((name, "2", "returns multiprocessing.pool.Pool") for name in POOLS),
    *((name, "", "returns concurrent.futures.Executor") for name in EXECUTORS),
    # Quality of service.
    ("rclpy.qos.QoSProfile", "depth=1", "fills depth=1"),
    ("rclpy.qos.QoSProfile", "h, 5", "fills history=h\nfills depth=5"),
    (
        "rclpy.qos.QoSProfile",
        (
            "history=h, depth=1, reliability=r, durability=d, lifespan=l, deadline=e, liveliness=a, "
            "liveliness_lease_duration=s"
        ),
        (
            "fills history=h\nfills depth=1\nfills reliability=r\nfills durability=d\nfills lifespan=l\nfills deadline=e\n"
            "fills liveliness=a\nfills lease=s"
        ),
    ),
    (
        "rclpy.qos.QoSPresetProfiles.get_from_short_key",
        "'sensor_data'",
        "returns rclpy.qos.QoSPresetProfiles.sensor_data",
    ),
    ("rclpy.qos.ReliabilityPolicy.get_from_short_key", "name='best_effort'", "returns best_effort"),
    ("rclpy.qos.QoSDurabilityPolicy.get_from_short_key", "'volatile'", "returns volatile"),
    (
        "rclpy.qos_overriding_options.QoSOverridingOptions.with_default_policies",
        "entity_id='i', callback=f",
        (
            "calls f\nreturns rclpy.qos_overriding_options.QoSOverridingOptions\nfills policies=history,depth,reliability\n"
            "fills id=i"
        ),
    ),
    ("rclpy.qos_overriding_options.QoSOverridingOptions", "[p]", "fills policies=[p]\nfills id="),
    ("rclpy.duration.Duration", "", "fills seconds=0\nfills nanosec=0"),
    ("rclpy.duration.Duration", "seconds=1.5", "fills seconds=1.5\nfills nanosec=0"),
    ("rclpy.duration.Duration", "seconds=1, nanoseconds=2", "fills seconds=1\nfills nanosec=2"),
    # message_filters and tf2_ros.
    (
        "message_filters.Subscriber",
        "node, T, 'a'",
        "subscribers name=a type=T qos=10 namespace=node\nfills node=node\nfills topic=a",
    ),
    (
        "message_filters.Subscriber",
        "node, T, 'a', qos_profile=q",
        "subscribers name=a type=T qos=q namespace=node\nfills node=node\nfills topic=a",
    ),
    ("message_filters.Subscriber.getTopic", "", "returns this.topic"),
    ("message_filters.TimeSynchronizer", "[a, b], 10", ""),
    ("message_filters.ApproximateTimeSynchronizer", "[a, b], queue_size=10, slop=0.1", ""),
    ("message_filters.Cache", "s, 10", ""),
    ("message_filters.SimpleFilter.registerCallback", "f, 1", "calls f"),
    ("tf2_ros.TransformBroadcaster", "node", f"publishers name=/tf {TF} qos=100 namespace=node"),
    ("tf2_ros.TransformBroadcaster", "node=node, qos=q", f"publishers name=/tf {TF} qos=q namespace=node"),
    (
        "tf2_ros.transform_broadcaster.TransformBroadcaster",
        "node, 5",
        f"publishers name=/tf {TF} qos=5 namespace=node",
    ),
    (
        "tf2_ros.StaticTransformBroadcaster",
        "node",
        f"publishers name=/tf_static {TF} qos=tf2_ros::StaticBroadcasterQoS namespace=node",
    ),
    (
        "tf2_ros.static_transform_broadcaster.StaticTransformBroadcaster",
        "node, q",
        f"publishers name=/tf_static {TF} qos=q namespace=node",
    ),
    (
        "tf2_ros.TransformListener",
        "buffer, node, spin_thread=True",
        (
            f"subscribers name=/tf {TF} qos=100 namespace=node\n"
            f"subscribers name=/tf_static {TF} qos=tf2_ros::StaticListenerQoS namespace=node"
        ),
    ),
    (
        "tf2_ros.transform_listener.TransformListener",
        "buffer=b, node=node, qos=q, static_qos=s, tf_topic='tf', tf_static_topic='t'",
        f"subscribers name=tf {TF} qos=q namespace=node\nsubscribers name=t {TF} qos=s namespace=node",
    ),
    ("tf2_ros.Buffer", "", ""),
    ("tf2_ros.Buffer", "duration", ""),
    ("tf2_ros.buffer.Buffer", "cache_time=duration", ""),
    ("tf2_ros.Buffer", "node=node", f"{FRAMES}node"),
    ("tf2_ros.Buffer", "duration, node", f"{FRAMES}node"),
    ("tf2_ros.Buffer", "duration, x", f"{FRAMES}x unsure"),
    (
        "tf2_ros.BufferClient",
        "node, 's'",
        "action_clients name=s type=tf2_msgs/action/LookupTransform namespace=node",
    ),
    (
        "tf2_ros.buffer_client.BufferClient",
        "node, ns='s', check_frequency=1.0",
        "action_clients name=s type=tf2_msgs/action/LookupTransform namespace=node",
    ),
    # smach_ros.
    ("smach_ros.ServiceState", "node, 's', SetBool", f"clients name=s type=SetBool {SERVICE} namespace=node"),
    (
        "smach_ros.SimpleActionState",
        "node, 'a', Fibonacci, goal_cb=f",
        "action_clients name=a type=Fibonacci namespace=node\ncalls f",
    ),
    ("smach_ros.MonitorState", "node, 't', String, f", "subscribers name=t type=String qos=1 namespace=node\ncalls f"),
    ("smach_ros.ConditionState", "node, cond_cb=f", "calls f"),
    *(
        (f"smach_ros.{name}", "node, 'a', Fibonacci, sm", "action_servers name=a type=Fibonacci namespace=node")
        for name in ("ActionServerWrapper", "action_server_wrapper.ActionServerWrapper")
    ),
    *(
        (f"smach_ros.{name}", "'s', sm, '/'", "node name=s\nfills server=s")
        for name in ("IntrospectionServer", "introspection.IntrospectionServer")
    ),
    (
        "smach_ros.IntrospectionServer.start",
        "",
        (
            "publishers name=this.server/smach/container_status type=smach_msgs/msg/SmachContainerStatus qos=1\n"
            "publishers name=this.server/smach/container_structure type=smach_msgs/msg/SmachContainerStructure qos=1\n"
            "subscribers name=this.server/smach/container_init type=smach_msgs/msg/SmachContainerInitialStatusCmd qos=1"
        ),
    ),
    # image_transport_py, diagnostic_updater, interactive_markers, bondpy.
    ("moveit.planning.MoveItPy", "node_name='n'", "node name=n options=declaring"),
    ("moveit.planning.MoveItPy", "", "node name=moveit_py options=declaring"),
    ("image_transport_py.ImageTransport", "'n', image_transport='raw'", "node name=n"),
    (
        "image_transport_py.ImageTransport.advertise",
        "'i', 1",
        f"{IMAGE}\n{COMPRESSED}\nreturns image_transport_py.Publisher",
    ),
    (
        "image_transport_py.ImageTransport.advertise_camera",
        "base_topic='i', queue_size=1",
        (
            f"{IMAGE}\n{COMPRESSED}\npublishers name=parent(i)camera_info type=sensor_msgs/msg/CameraInfo qos=1\n"
            "returns image_transport_py.CameraPublisher"
        ),
    ),
    (
        "image_transport_py.ImageTransport.subscribe",
        "'i', 1, f",
        "subscribers name=i type=sensor_msgs/msg/Image qos=1 unsure\ncalls f\nreturns image_transport_py.Subscriber",
    ),
    (
        "image_transport_py.ImageTransport.subscribe_camera",
        "'i', 1, f",
        (
            "subscribers name=i type=sensor_msgs/msg/Image qos=1 unsure\n"
            "subscribers name=parent(i)camera_info type=sensor_msgs/msg/CameraInfo qos=1\n"
            "calls f\nreturns image_transport_py.CameraSubscriber"
        ),
    ),
    ("diagnostic_updater.Updater", "node", DIAGNOSTICS.format("1.0")),
    ("diagnostic_updater.Updater", "node, 0.5", DIAGNOSTICS.format("0.5")),
    ("diagnostic_updater.DiagnosticTaskVector.add", "'n', f", "calls f"),
    ("diagnostic_updater.DiagnosticTaskVector.add", "task", ""),
    ("diagnostic_updater.FunctionDiagnosticTask", "'n', fn=f", "calls f"),
    ("interactive_markers.InteractiveMarkerServer", "node, 'm'", MARKERS.format(100, 1)),
    (
        "interactive_markers.interactive_marker_server.InteractiveMarkerServer",
        "node=node, namespace='m', update_pub_qos=u, feedback_sub_qos=f",
        MARKERS.format("u", "f"),
    ),
    ("interactive_markers.InteractiveMarkerServer.insert", "m, feedback_callback=f", "calls f"),
    ("interactive_markers.InteractiveMarkerServer.setCallback", "'m', f", "calls f"),
    ("interactive_markers.MenuHandler.insert", "'t', callback=f", "calls f"),
    (
        "bondpy.bondpy.Bond",
        "node, 't', 'id', on_broken=f",
        "publishers name=t type=bond/msg/Status qos=1 namespace=node\ncalls f\nfills node=node\nfills topic=t",
    ),
    (
        "bondpy.bondpy.Bond.start",
        "",
        "subscribers name=this.topic type=bond/msg/Status qos=1 namespace=this.node",
    ),
    # nav2_simple_commander.
    (
        f"{NAVIGATOR}.waitUntilNav2Active",
        "",
        f"clients name=amcl/get_state {STATE}\nclients name=bt_navigator/get_state {STATE}",
    ),
    (
        f"{NAVIGATOR}.waitUntilNav2Active",
        "localizer='l'",
        f"clients name=l/get_state {STATE} unsure\nclients name=bt_navigator/get_state {STATE}",
    ),
    (
        f"{NAVIGATOR}.waitUntilNav2Active",
        "'n', 'l'",
        f"clients name=l/get_state {STATE} unsure\nclients name=n/get_state {STATE}",
    ),
)


@pytest.mark.parametrize(("name", "written", "expected"), CALLS, ids=[f"{name}({text})" for name, text, _ in CALLS])
def test_what_a_call_says(name: str, written: str, expected: str) -> None:
    assert told(name, written) == expected


@every("row", FORMS)
def test_every_row_loads(row: Mapping[str, object]) -> None:
    assert load_row(row).call


def test_no_two_rows_answer_the_same_call() -> None:
    keys = [(row.call, row.is_class, row.args, row.when) for row in ROWS]
    assert len(keys) == len(set(keys))


def test_a_row_for_any_arguments_is_the_last_of_its_call() -> None:
    calls = [row for row in ROWS if not row.is_class]
    for index, row in enumerate(calls):
        if not row.args and not row.when:
            assert row.call not in {later.call for later in calls[index + 1 :]}


def test_each_row_that_says_something_has_a_call_above() -> None:
    said = {row.call for row in ROWS if row.makes or row.calls}
    tried = {name for name, _, _ in CALLS}
    others = {
        row.call
        for row in ROWS
        if any(row.call.startswith(f"{base}.") for base in ("rclpy.lifecycle.node", "rclpy.lifecycle.publisher"))
    }
    whole = {
        NAVIGATOR,
        "rclpy.parameter_client.AsyncParameterClient",
        "interactive_markers.menu_handler.MenuHandler.insert",
        "rclpy.action.server.ServerGoalHandle.execute",
        "rclpy.qos_event.SubscriptionEventCallbacks",
        "rclpy.timer.Timer",
        "diagnostic_updater.CompositeDiagnosticTask.addTask",
        "bondpy.bondpy.Bond.set_formed_callback",
        "bondpy.bondpy.Bond.set_broken_callback",
    }
    assert said - tried - others - whole == set()


def test_types_have_the_kind_of_their_interface() -> None:
    wanted = {"publishers": "msg", "subscribers": "msg", "servers": "srv", "clients": "srv"}
    wanted |= {"action_servers": "action", "action_clients": "action"}
    for row in ROWS:
        for entry in row.makes:
            parts = entry.values["type"].parts if "type" in entry.values else ()
            if entry.kind in wanted and parts and isinstance(parts[0], str):
                assert re.fullmatch(rf"\w+/{wanted[entry.kind]}/\w+", parts[0]), row.call


def test_topics_and_services_say_their_quality_of_service() -> None:
    ends = ("publishers", "subscribers", "servers", "clients")
    for row in ROWS:
        assert all("qos" in entry.values for entry in row.makes if entry.kind in ends), row.call


@pytest.mark.parametrize(
    ("name", "bases"),
    [
        ("rclpy.lifecycle.LifecycleNode", ("rclpy.lifecycle.LifecycleNodeMixin", N)),
        ("rclpy.lifecycle.Node", ("rclpy.lifecycle.LifecycleNode",)),
        ("rclpy.lifecycle.LifecyclePublisher", ("rclpy.publisher.Publisher",)),
        ("rclpy.executors.MultiThreadedExecutor", ("rclpy.executors.Executor",)),
        ("rclpy.Parameter", ("rclpy.parameter.Parameter",)),
        ("rclpy.action.client.ActionClient", ("rclpy.action.ActionClient",)),
        ("tf2_ros.buffer.Buffer", ("tf2_ros.Buffer",)),
        ("message_filters.ApproximateTimeSynchronizer", ("message_filters.TimeSynchronizer",)),
        ("message_filters.TimeSynchronizer", ("message_filters.SimpleFilter",)),
        ("diagnostic_updater.Updater", ("diagnostic_updater.DiagnosticTaskVector",)),
        (NAVIGATOR, (N,)),
    ],
)
def test_bases(name: str, bases: tuple[str, ...]) -> None:
    assert [row.bases for row in ROWS if row.call == name and row.is_class and row.bases] == [bases]


def test_a_managed_node_has_its_transitions_called() -> None:
    wanted = ("on_configure", "on_cleanup", "on_shutdown", "on_activate", "on_deactivate", "on_error")
    for name in ("LifecycleNodeMixin", "LifecycleNode", "Node", "node.LifecycleNode"):
        (row,) = (row for row in ROWS if row.call == f"rclpy.lifecycle.{name}" and row.is_class)
        assert row.entry == wanted


def test_a_parameter_value_has_all_its_members() -> None:
    row = Call("").row("rclpy.parameter.Parameter.get_parameter_value")
    assert {name for name, _ in row.fills} == {
        "bool_value",
        "integer_value",
        "double_value",
        "string_value",
        "byte_array_value",
        "bool_array_value",
        "integer_array_value",
        "double_array_value",
        "string_array_value",
        "of",
    }


def test_a_client_of_another_nodes_parameters() -> None:
    made = told("rclpy.parameter_client.AsyncParameterClient", "node, 'n'").splitlines()
    assert made[0] == f"clients name=n/get_parameters type=rcl_interfaces/srv/GetParameters {SERVICE} namespace=node"
    assert [line.split()[1] for line in made] == [
        f"name=n/{name}"
        for name in (
            "get_parameters",
            "list_parameters",
            "set_parameters",
            "get_parameter_types",
            "describe_parameters",
            "set_parameters_atomically",
        )
    ]


def test_the_navigator() -> None:
    made = told(NAVIGATOR, "").splitlines()
    assert made[0] == "node name=basic_navigator"
    assert told(NAVIGATOR, "'n', namespace='s'").splitlines()[0] == "node name=n namespace=s"
    assert "action_clients name=navigate_to_pose type=nav2_msgs/action/NavigateToPose namespace=this" in made
    assert "action_clients name=backup type=nav2_msgs/action/BackUp namespace=this" in made
    assert (
        "action_clients name=follow_gps_waypoints type=nav2_msgs/action/FollowGPSWaypoints namespace=this unsure"
        in made
    )
    assert f"clients name=map_server/load_map type=nav2_msgs/srv/LoadMap namespace=this {SERVICE}" in made
    assert f"clients name=collision_monitor/toggle type=nav2_msgs/srv/Toggle namespace=this {SERVICE} unsure" in made
    assert made[-1] == (
        "subscribers name=amcl_pose type=geometry_msgs/msg/PoseWithCovarianceStamped qos=nav2::qos::LatchedPublisherQoS "
        "namespace=this"
    )
    kinds = [line.split()[0] for line in made]
    assert {kind: kinds.count(kind) for kind in sorted(set(kinds))} == {
        "action_clients": 17,
        "clients": 10,
        "node": 1,
        "publishers": 1,
        "subscribers": 1,
    }


@pytest.mark.parametrize(
    "call",
    [
        "rclpy.init",
        "rclpy.spin",
        f"{N}.destroy_node",
        "rclpy.publisher.Publisher.publish",
        "tf2_ros.Buffer.lookup_transform",
    ],
)
def test_calls_that_say_nothing(call: str) -> None:
    assert told(call, "x") == ""


@pytest.mark.parametrize(
    "call",
    [
        "rclpy.Node",
        "rclpy.node.Node.get_node_names_and_namespaces_with_enclaves",
        "rospy.Publisher",
        "launch_testing.actions.ReadyToTest",
        "sensor_msgs_py.point_cloud2.read_points",
        "tf2_ros.BufferServer",
    ],
)
def test_calls_without_a_row(call: str) -> None:
    assert [row for row in ROWS if row.call == call] == []


def test_kinds() -> None:
    assert {entry.kind for row in ROWS for entry in row.makes} == set(KINDS.split())
