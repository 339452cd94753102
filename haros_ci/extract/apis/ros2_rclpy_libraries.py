# SPDX-License-Identifier: Apache-2.0
"""ROS 2 Python: message_filters, tf2_ros, image_transport_py, diagnostic_updater, interactive_markers, bondpy and moveit_py."""

from __future__ import annotations

from haros_ci.extract.apis.ros2_rclpy import SERVICES, renamed, silent

TF = "tf2_msgs/msg/TFMessage"
#: What tf2_ros gives its static ends (tf2_ros/qos.hpp; the Python classes write the same profiles out).
STATIC_LISTENER = "tf2_ros::StaticListenerQoS"
STATIC_BROADCASTER = "tf2_ros::StaticBroadcasterQoS"
#: What the plug-ins of image_transport publish below an image's topic.
TRANSPORTS = (
    ("compressed", "sensor_msgs/msg/CompressedImage"),
    ("compressedDepth", "sensor_msgs/msg/CompressedImage"),
    ("theora", "theora_image_transport/msg/Packet"),
    ("zstd", "sensor_msgs/msg/CompressedImage"),
)
MAY_BE_INSTALLED = "the plug-in of this transport may not be installed"
IMAGES: tuple[dict[str, object], ...] = (
    {"kind": "publishers", "name": "{0|base_topic}", "type": "sensor_msgs/msg/Image", "qos": "{1|queue_size}"},
    *(
        {
            "kind": "publishers",
            "name": f"{{0|base_topic}}/{name}",
            "type": kind,
            "qos": "{1|queue_size}",
            "implicit": True,
            "unsure": MAY_BE_INSTALLED,
        }
        for name, kind in TRANSPORTS
    ),
)
#: Which of the transports an image comes by is a parameter of the node.
BY_TRANSPORT = "another transport than raw has a topic below this one"

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # message_filters/__init__.py: a Subscriber takes the node, and then what create_subscription does.
    {"class": "message_filters.Subscriber", "bases": ["message_filters.SimpleFilter"]},
    {"class": "message_filters.Cache", "bases": ["message_filters.SimpleFilter"]},
    {"class": "message_filters.TimeSynchronizer", "bases": ["message_filters.SimpleFilter"]},
    {"class": "message_filters.ApproximateTimeSynchronizer", "bases": ["message_filters.TimeSynchronizer"]},
    {"call": "message_filters.SimpleFilter"},
    {"call": "message_filters.Subscriber",
     "makes": [{"kind": "subscribers", "name": "{2}", "type": "{typename(1)}", "qos": "{qos_profile?10}",
                "namespace": "{0}", "options": "{qos_overriding_options}"}],
     "fills": {"node": "{0}", "topic": "{2}"}},
    {"call": "message_filters.Subscriber.getTopic", "returns": "{this.topic}"},
    {"call": "message_filters.Cache"},
    {"call": "message_filters.TimeSynchronizer"},
    {"call": "message_filters.ApproximateTimeSynchronizer"},
    {"call": "message_filters.SimpleFilter.registerCallback", "calls": ["0", "cb"]},

    # tf2_ros/transform_broadcaster.py, static_transform_broadcaster.py, transform_listener.py
    {"call": "tf2_ros.TransformBroadcaster",
     "makes": [{"kind": "publishers", "name": "/tf", "type": TF, "qos": "{1|qos?100}", "namespace": "{0|node}"}]},
    {"call": "tf2_ros.StaticTransformBroadcaster",
     "makes": [{"kind": "publishers", "name": "/tf_static", "type": TF, "qos": f"{{1|qos?{STATIC_BROADCASTER}}}",
                "namespace": "{0|node}"}]},
    {"call": "tf2_ros.TransformListener",
     "makes": [{"kind": "subscribers", "name": "{tf_topic?/tf}", "type": TF, "qos": "{qos?100}",
                "namespace": "{1|node}"},
               {"kind": "subscribers", "name": "{tf_static_topic?/tf_static}", "type": TF,
                "qos": f"{{static_qos?{STATIC_LISTENER}}}", "namespace": "{1|node}"}]},

    # tf2_ros/buffer.py: it offers its service where it is given a node. tf2_ros has no BufferServer in Python.
    {"call": "tf2_ros.Buffer", "when": {"node": "rclpy.node.Node"},
     "makes": [{"kind": "servers", "name": "tf2_frames", "type": "tf2_msgs/srv/FrameGraph", "qos": SERVICES,
                "namespace": "{node}"}]},
    {"call": "tf2_ros.Buffer", "when": {"1": "rclpy.node.Node"},
     "makes": [{"kind": "servers", "name": "tf2_frames", "type": "tf2_msgs/srv/FrameGraph", "qos": SERVICES,
                "namespace": "{1}"}]},
    {"call": "tf2_ros.Buffer", "args": [2],
     "makes": [{"kind": "servers", "name": "tf2_frames", "type": "tf2_msgs/srv/FrameGraph", "qos": SERVICES,
                "namespace": "{1|node}",
                "unsure": "it may be given no node"}]},
    {"call": "tf2_ros.Buffer"},
    {"call": "tf2_ros.Buffer.wait_for_transform_async", "returns": "rclpy.task.Future"},

    # tf2_ros/buffer_client.py
    {"call": "tf2_ros.BufferClient",
     "makes": [{"kind": "action_clients", "name": "{1|ns}", "type": "tf2_msgs/action/LookupTransform",
                "namespace": "{0|node}"}]},

    # moveit_py/src/moveit/moveit_ros/moveit_cpp/moveit_cpp.cpp: it makes a node of its own, which declares all that the process is given.
    {"call": "moveit.planning.MoveItPy",
     "makes": [{"kind": "node", "name": "{0|node_name?moveit_py}", "options": "declaring"}]},

    # image_transport_py/pybind_image_transport.cpp: it makes a node of its own.
    {"call": "image_transport_py.ImageTransport", "makes": [{"kind": "node", "name": "{0|node_name}"}]},
    {"call": "image_transport_py.ImageTransport.advertise", "makes": [*IMAGES],
     "returns": "image_transport_py.Publisher"},
    {"call": "image_transport_py.ImageTransport.advertise_camera",
     "makes": [*IMAGES,
               {"kind": "publishers", "name": "{parent(0|base_topic)}camera_info",
                "type": "sensor_msgs/msg/CameraInfo", "qos": "{1|queue_size}"}],
     "returns": "image_transport_py.CameraPublisher"},
    {"call": "image_transport_py.ImageTransport.subscribe",
     "makes": [{"kind": "subscribers", "name": "{0|base_topic}", "type": "sensor_msgs/msg/Image",
                "qos": "{1|queue_size}", "unsure": BY_TRANSPORT}],
     "calls": ["2", "callback"], "returns": "image_transport_py.Subscriber"},
    {"call": "image_transport_py.ImageTransport.subscribe_camera",
     "makes": [{"kind": "subscribers", "name": "{0|base_topic}", "type": "sensor_msgs/msg/Image",
                "qos": "{1|queue_size}", "unsure": BY_TRANSPORT},
               {"kind": "subscribers", "name": "{parent(0|base_topic)}camera_info",
                "type": "sensor_msgs/msg/CameraInfo", "qos": "{1|queue_size}"}],
     "calls": ["2", "callback"], "returns": "image_transport_py.CameraSubscriber"},

    # diagnostic_updater/_diagnostic_updater.py: the parameter for full names is there since ROS 2 Humble.
    {"class": "diagnostic_updater.Updater", "bases": ["diagnostic_updater.DiagnosticTaskVector"]},
    {"call": "diagnostic_updater.Updater",
     "makes": [{"kind": "publishers", "name": "/diagnostics", "type": "diagnostic_msgs/msg/DiagnosticArray", "qos": 1,
                "namespace": "{0|node}"},
               {"kind": "parameters", "name": "diagnostic_updater.period", "value": "{1|period?1.0}",
                "namespace": "{0|node}"},
               {"kind": "parameters", "name": "diagnostic_updater.use_fqn", "type": "bool", "value": False,
                "namespace": "{0|node}"}],
     "fills": {"node": "{0|node}"}},
    {"call": "diagnostic_updater.DiagnosticTaskVector.add", "args": [1], "calls": ["0.run"]},
    {"call": "diagnostic_updater.DiagnosticTaskVector.add", "args": [2], "calls": ["1"]},
    {"call": "diagnostic_updater.FunctionDiagnosticTask", "args": [2], "calls": ["1", "fn"]},
    {"call": "diagnostic_updater.CompositeDiagnosticTask"},
    {"call": "diagnostic_updater.CompositeDiagnosticTask.addTask", "calls": ["0.run", "t.run"]},

    # interactive_markers/interactive_marker_server.py, menu_handler.py
    {"call": "interactive_markers.InteractiveMarkerServer",
     "makes": [{"kind": "servers", "name": "{1|namespace}/get_interactive_markers",
                "type": "visualization_msgs/srv/GetInteractiveMarkers", "qos": SERVICES, "namespace": "{0|node}"},
               {"kind": "publishers", "name": "{1|namespace}/update",
                "type": "visualization_msgs/msg/InteractiveMarkerUpdate", "qos": "{update_pub_qos?100}",
                "namespace": "{0|node}"},
               {"kind": "subscribers", "name": "{1|namespace}/feedback",
                "type": "visualization_msgs/msg/InteractiveMarkerFeedback", "qos": "{feedback_sub_qos?1}",
                "namespace": "{0|node}"}],
     "fills": {"node": "{0|node}"}},
    {"call": "interactive_markers.InteractiveMarkerServer.insert", "calls": ["feedback_callback"]},
    {"call": "interactive_markers.InteractiveMarkerServer.setCallback", "calls": ["1", "feedback_callback"]},
    {"call": "interactive_markers.MenuHandler"},
    {"call": "interactive_markers.MenuHandler.insert", "calls": ["4", "callback"]},

    # bondpy/bondpy.py: it subscribes when it is started.
    {"call": "bondpy.bondpy.Bond",
     "makes": [{"kind": "publishers", "name": "{1|topic}", "type": "bond/msg/Status", "qos": 1,
                "namespace": "{0|node}"}],
     "calls": ["3", "on_broken", "4", "on_formed"], "fills": {"node": "{0|node}", "topic": "{1|topic}"}},
    {"call": "bondpy.bondpy.Bond.start",
     "makes": [{"kind": "subscribers", "name": "{this.topic}", "type": "bond/msg/Status", "qos": 1,
                "namespace": "{this.node}"}]},
    {"call": "bondpy.bondpy.Bond.set_formed_callback", "calls": ["0", "on_formed"]},
    {"call": "bondpy.bondpy.Bond.set_broken_callback", "calls": ["0", "on_broken"]},
)
# fmt: on

SILENT = {
    "tf2_ros.TransformBroadcaster": "sendTransform",
    "tf2_ros.StaticTransformBroadcaster": "sendTransform",
    "tf2_ros.TransformListener": "unregister",
    "tf2_ros.Buffer": "lookup_transform lookup_transform_full lookup_transform_async can_transform can_transform_full "
    "can_transform_async transform transform_full set_transform set_transform_static registration",
    "diagnostic_updater.Updater": "update force_update broadcast setHardwareID",
    "interactive_markers.InteractiveMarkerServer": "applyChanges clear erase get setPose shutdown",
    "interactive_markers.MenuHandler": "apply reApply setVisible setCheckState getCheckState getTitle",
    "bondpy.bondpy.Bond": "wait_until_formed wait_until_broken break_bond is_broken shutdown",
}
NAMES = {
    "tf2_ros.TransformBroadcaster": ("tf2_ros.transform_broadcaster.TransformBroadcaster",),
    "tf2_ros.StaticTransformBroadcaster": ("tf2_ros.static_transform_broadcaster.StaticTransformBroadcaster",),
    "tf2_ros.TransformListener": ("tf2_ros.transform_listener.TransformListener",),
    "tf2_ros.Buffer": ("tf2_ros.buffer.Buffer",),
    "tf2_ros.BufferClient": ("tf2_ros.buffer_client.BufferClient",),
    "interactive_markers.InteractiveMarkerServer": (
        "interactive_markers.interactive_marker_server.InteractiveMarkerServer",
    ),
    "interactive_markers.MenuHandler": ("interactive_markers.menu_handler.MenuHandler",),
}
ROWS += silent(SILENT)
ROWS += renamed(ROWS, NAMES)
