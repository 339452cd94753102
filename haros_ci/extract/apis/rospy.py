# SPDX-License-Identifier: Apache-2.0
"""ROS 1 Python: rospy, and the Python sides of actionlib, message_filters, tf, dynamic_reconfigure and diagnostics.

A queue size that is not written has no default: rospy then publishes synchronously and receives without a bound.
"""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # Threads of Python 2 (docs.python.org/3/library/_thread.html).
    {"call": "thread.start_new_thread", "calls": ["0"]},
    {"call": "_thread.start_new_thread", "calls": ["0"]},

    # rospy/client.py, wiki.ros.org/rospy/Overview/Initialization and Shutdown
    {"call": "rospy.init_node",
     "makes": [{"kind": "node", "name": "{0|name}", "anonymous": "{2|anonymous?false}"}]},
    {"call": "rospy.on_shutdown", "calls": ["0", "h"]},

    # rospy/topics.py, wiki.ros.org/rospy/Overview/Publishers and Subscribers: name is the resolved one, too.
    {"call": "rospy.Publisher",
     "makes": [{"kind": "publishers", "name": "{0|name}", "type": "{typename(1|data_class)}",
                "queue_size": "{6|queue_size}", "latched": "{4|latch?false}"}],
     "fills": {"name": "{resolve(0|name)}", "resolved_name": "{resolve(0|name)}"}},
    {"call": "rospy.Subscriber",
     "makes": [{"kind": "subscribers", "name": "{0|name}", "type": "{typename(1|data_class)}",
                "queue_size": "{4|queue_size}"}],
     "calls": ["2", "callback"],
     "fills": {"name": "{resolve(0|name)}", "resolved_name": "{resolve(0|name)}"}},
    # rospy/client.py: wait_for_message subscribes while it waits.
    {"call": "rospy.wait_for_message",
     "makes": [{"kind": "subscribers", "name": "{0|topic}", "type": "{typename(1|topic_type)}"}],
     "returns": "{typename(1|topic_type)}"},
    # rospy/numpy_msg.py, wiki.ros.org/rospy_tutorials/Tutorials/numpy: the same message with arrays of numpy.
    {"call": "rospy.numpy_msg.numpy_msg", "transparent": "{0|msg_type}"},

    # rospy/impl/tcpros_service.py, wiki.ros.org/rospy/Overview/Services
    {"call": "rospy.Service",
     "makes": [{"kind": "servers", "name": "{0|name}", "type": "{typename(1|service_class)}"}],
     "calls": ["2", "handler", "4", "error_handler"], "fills": {"resolved_name": "{resolve(0|name)}"}},
    {"call": "rospy.ServiceProxy",
     "makes": [{"kind": "clients", "name": "{0|name}", "type": "{typename(1|service_class)}"}],
     "fills": {"resolved_name": "{resolve(0|name)}"}},
    # rospy/impl/tcpros_service.py: a probe that only asks whether the service is there calls nothing.
    {"call": "rospy.wait_for_service"},

    # rospy/client.py, wiki.ros.org/rospy/Overview/Parameter Server. search_param starts at the node's own name.
    # Without a default they raise KeyError where the parameter is not set.
    {"call": "rospy.get_param", "args": [1],
     "makes": [{"kind": "getters", "name": "{0|param_name}", "type": "{typeof(1|default)}", "value": "{1|default}",
                "strict": True}],
     "returns": "{parameter}"},
    {"call": "rospy.get_param",
     "makes": [{"kind": "getters", "name": "{0|param_name}", "type": "{typeof(1|default)}", "value": "{1|default}"}],
     "returns": "{parameter}"},
    {"call": "rospy.get_param_cached",
     "makes": [{"kind": "getters", "name": "{0|param_name}", "type": "{typeof(1|default)}", "value": "{1|default}"}],
     "returns": "{parameter}"},
    {"call": "rospy.set_param",
     "makes": [{"kind": "setters", "name": "{0|param_name}", "type": "{typeof(1|param_value)}",
                "value": "{1|param_value}"}]},
    {"call": "rospy.has_param", "makes": [{"kind": "getters", "name": "{0|param_name}"}]},
    {"call": "rospy.delete_param", "makes": [{"kind": "setters", "name": "{0|param_name}"}]},
    {"call": "rospy.search_param",
     "makes": [{"kind": "getters", "name": "{search(0|param_name)}", "namespace": "~"}],
     "returns": "{searched(0|param_name)}"},

    # rospy/timer.py, rospy/rostime.py, wiki.ros.org/rospy/Overview/Time. A Duration with nanoseconds has no row.
    {"call": "rospy.Timer", "makes": [{"kind": "timer", "period": "{0.seconds|period.seconds}"}],
     "calls": ["1", "callback"]},
    {"call": "rospy.Rate", "makes": [{"kind": "rate", "frequency": "{0|hz}"}]},
    {"call": "rospy.Duration", "args": [0], "fills": {"seconds": "0"}},
    {"call": "rospy.Duration", "args": [1], "fills": {"seconds": "{0|secs}"}},
    {"call": "rospy.Duration.from_sec", "args": [1], "fills": {"seconds": "{0|float_secs}"},
     "returns": "rospy.Duration"},
    {"call": "rospy.Duration.to_sec", "args": [0], "returns": "{this.seconds}"},

    # rospy/names.py, rosgraph/names.py, wiki.ros.org/rospy/Overview/Names and Node Information. A namespace ends in a
    # slash. ns_join and scoped_name have no row: what they give depends on how the names begin.
    {"call": "rospy.resolve_name", "args": [1], "returns": "{resolve(0|name)}"},
    {"call": "rospy.remap_name", "args": [1], "returns": "{remap(0|name)}"},
    {"call": "rospy.names.resolve_name", "args": [1], "returns": "{resolve(0|name)}"},
    {"call": "rospy.names.remap_name", "args": [1], "returns": "{remap(0|name)}"},
    {"call": "rospy.names.canonicalize_name", "args": [1], "returns": "{canonical(0|name)}"},
    {"call": "rosgraph.names.canonicalize_name", "args": [1], "returns": "{canonical(0|name)}"},
    {"call": "rospy.get_name", "args": [0], "returns": "{node.name}"},
    {"call": "rospy.names.get_name", "args": [0], "returns": "{node.name}"},
    {"call": "rospy.get_caller_id", "args": [0], "returns": "{node.name}"},
    {"call": "rospy.get_namespace", "args": [0], "returns": "{parent(node.name)}"},
    {"call": "rospy.names.get_namespace", "args": [0], "returns": "{parent(node.name)}"},

    # message_filters/__init__.py, wiki.ros.org/message_filters: a Subscriber's arguments go to rospy.Subscriber.
    {"class": "message_filters.Subscriber", "bases": ["message_filters.SimpleFilter"]},
    {"class": "message_filters.Cache", "bases": ["message_filters.SimpleFilter"]},
    {"class": "message_filters.TimeSynchronizer", "bases": ["message_filters.SimpleFilter"]},
    {"class": "message_filters.ApproximateTimeSynchronizer", "bases": ["message_filters.TimeSynchronizer"]},
    {"call": "message_filters.Subscriber",
     "makes": [{"kind": "subscribers", "name": "{0}", "type": "{typename(1|data_class)}",
                "queue_size": "{queue_size}"}]},
    {"call": "message_filters.SimpleFilter.registerCallback", "calls": ["0", "cb"]},

    # actionlib/simple_action_server.py, action_server.py, simple_action_client.py, action_client.py,
    # wiki.ros.org/actionlib
    {"class": "actionlib.simple_action_server.SimpleActionServer", "bases": ["actionlib.SimpleActionServer"]},
    {"class": "actionlib.action_server.ActionServer", "bases": ["actionlib.ActionServer"]},
    {"class": "actionlib.simple_action_client.SimpleActionClient", "bases": ["actionlib.SimpleActionClient"]},
    {"class": "actionlib.action_client.ActionClient", "bases": ["actionlib.ActionClient"]},
    {"call": "actionlib.SimpleActionServer",
     "makes": [{"kind": "action_servers", "name": "{0|name}", "type": "{typename(1|ActionSpec)}"}],
     "calls": ["2", "execute_cb"]},
    {"call": "actionlib.simple_action_server.SimpleActionServer",
     "makes": [{"kind": "action_servers", "name": "{0|name}", "type": "{typename(1|ActionSpec)}"}],
     "calls": ["2", "execute_cb"]},
    {"call": "actionlib.ActionServer",
     "makes": [{"kind": "action_servers", "name": "{0|ns}", "type": "{typename(1|ActionSpec)}"}],
     "calls": ["2", "goal_cb", "3", "cancel_cb"]},
    {"call": "actionlib.action_server.ActionServer",
     "makes": [{"kind": "action_servers", "name": "{0|ns}", "type": "{typename(1|ActionSpec)}"}],
     "calls": ["2", "goal_cb", "3", "cancel_cb"]},
    {"call": "actionlib.SimpleActionClient",
     "makes": [{"kind": "action_clients", "name": "{0|ns}", "type": "{typename(1|ActionSpec)}"}]},
    {"call": "actionlib.simple_action_client.SimpleActionClient",
     "makes": [{"kind": "action_clients", "name": "{0|ns}", "type": "{typename(1|ActionSpec)}"}]},
    {"call": "actionlib.ActionClient",
     "makes": [{"kind": "action_clients", "name": "{0|ns}", "type": "{typename(1|ActionSpec)}"}]},
    {"call": "actionlib.action_client.ActionClient",
     "makes": [{"kind": "action_clients", "name": "{0|ns}", "type": "{typename(1|ActionSpec)}"}]},
    {"call": "actionlib.SimpleActionServer.register_goal_callback", "calls": ["0", "cb"]},
    {"call": "actionlib.SimpleActionServer.register_preempt_callback", "calls": ["0", "cb"]},
    {"call": "actionlib.ActionServer.register_goal_callback", "calls": ["0", "cb"]},
    {"call": "actionlib.ActionServer.register_cancel_callback", "calls": ["0", "cancel_cb"]},
    {"call": "actionlib.SimpleActionClient.send_goal",
     "calls": ["1", "done_cb", "2", "active_cb", "3", "feedback_cb"]},
    {"call": "actionlib.ActionClient.send_goal", "calls": ["1", "transition_cb", "2", "feedback_cb"]},

    # moveit_commander/planning_scene_interface.py, move_group.py, robot.py: /collision_object, /attached_collision_object and what
    # the interfaces of C++ inside of them make, by their version.
    {"call": "moveit_commander.PlanningSceneInterface", "unseen": "a client of move_group is made"},
    {"call": "moveit_commander.MoveGroupCommander", "unseen": "a client of move_group is made"},
    {"call": "moveit_commander.RobotCommander", "unseen": "a client of move_group is made"},

    # tf/broadcaster.py, tf/listener.py, docs.ros.org/api/tf/html/python: the listener keeps a Buffer without a service.
    {"call": "tf.TransformBroadcaster",
     "makes": [{"kind": "publishers", "name": "/tf", "type": "tf2_msgs/TFMessage",
                "queue_size": "{0|queue_size?100}", "latched": False}]},
    {"call": "tf.broadcaster.TransformBroadcaster",
     "makes": [{"kind": "publishers", "name": "/tf", "type": "tf2_msgs/TFMessage",
                "queue_size": "{0|queue_size?100}", "latched": False}]},
    {"call": "tf.TransformListener",
     "makes": [{"kind": "subscribers", "name": "/tf", "type": "tf2_msgs/TFMessage"},
               {"kind": "subscribers", "name": "/tf_static", "type": "tf2_msgs/TFMessage"}]},
    {"call": "tf.listener.TransformListener",
     "makes": [{"kind": "subscribers", "name": "/tf", "type": "tf2_msgs/TFMessage"},
               {"kind": "subscribers", "name": "/tf_static", "type": "tf2_msgs/TFMessage"}]},

    # tf2_ros/transform_broadcaster.py, static_transform_broadcaster.py, transform_listener.py, buffer.py,
    # buffer_client.py, wiki.ros.org/tf2_ros. The second argument of a Buffer says whether it offers its service: a
    # row knows that only where it is not written. tf2_ros has no BufferServer in Python.
    {"call": "tf2_ros.TransformBroadcaster",
     "makes": [{"kind": "publishers", "name": "/tf", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": False}]},
    {"call": "tf2_ros.StaticTransformBroadcaster",
     "makes": [{"kind": "publishers", "name": "/tf_static", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": True}]},
    {"call": "tf2_ros.TransformListener",
     "makes": [{"kind": "subscribers", "name": "/tf", "type": "tf2_msgs/TFMessage",
                "queue_size": "{1|queue_size}"},
               {"kind": "subscribers", "name": "/tf_static", "type": "tf2_msgs/TFMessage",
                "queue_size": "{1|queue_size}"}]},
    {"call": "tf2_ros.Buffer", "args": [0],
     "makes": [{"kind": "servers", "name": "~tf2_frames", "type": "tf2_msgs/FrameGraph"}]},
    {"call": "tf2_ros.Buffer", "args": [1], "when": {"0": "rospy.Duration"},
     "makes": [{"kind": "servers", "name": "~tf2_frames", "type": "tf2_msgs/FrameGraph"}]},
    {"call": "tf2_ros.Buffer", "args": [1], "when": {"cache_time": "rospy.Duration"},
     "makes": [{"kind": "servers", "name": "~tf2_frames", "type": "tf2_msgs/FrameGraph"}]},
    {"call": "tf2_ros.Buffer"},
    {"call": "tf2_ros.BufferClient",
     "makes": [{"kind": "action_clients", "name": "{0|ns}", "type": "tf2_msgs/LookupTransform"}]},

    # dynamic_reconfigure/server.py, wiki.ros.org/dynamic_reconfigure: names are private unless the namespace is global.
    {"call": "dynamic_reconfigure.server.Server", "args": [2],
     "makes": [{"kind": "servers", "name": "set_parameters", "type": "dynamic_reconfigure/Reconfigure",
                "namespace": "~"},
               {"kind": "publishers", "name": "parameter_descriptions",
                "type": "dynamic_reconfigure/ConfigDescription", "queue_size": 10, "latched": True, "namespace": "~"},
               {"kind": "publishers", "name": "parameter_updates", "type": "dynamic_reconfigure/Config",
                "queue_size": 10, "latched": True, "namespace": "~"},
               {"kind": "getters", "each": "config(0)", "name": "{item.name}", "type": "{item.type}",
                "value": "{item.default}", "namespace": "~"},
               {"kind": "setters", "each": "config(0)", "name": "{item.name}", "type": "{item.type}",
                "namespace": "~"}],
     "calls": ["1", "callback"]},
    {"call": "dynamic_reconfigure.server.Server", "args": [3],
     "makes": [{"kind": "servers", "name": "{2|namespace}/set_parameters", "type": "dynamic_reconfigure/Reconfigure",
                "namespace": "~"},
               {"kind": "publishers", "name": "{2|namespace}/parameter_descriptions",
                "type": "dynamic_reconfigure/ConfigDescription", "queue_size": 10, "latched": True, "namespace": "~"},
               {"kind": "publishers", "name": "{2|namespace}/parameter_updates",
                "type": "dynamic_reconfigure/Config", "queue_size": 10, "latched": True, "namespace": "~"},
               {"kind": "getters", "each": "config(0)", "name": "{2|namespace}/{item.name}", "type": "{item.type}",
                "value": "{item.default}", "namespace": "~"},
               {"kind": "setters", "each": "config(0)", "name": "{2|namespace}/{item.name}", "type": "{item.type}",
                "namespace": "~"}],
     "calls": ["1", "callback"]},

    # dynamic_reconfigure/client.py: the name is the server's namespace.
    {"call": "dynamic_reconfigure.client.Client",
     "makes": [{"kind": "clients", "name": "{0|name}/set_parameters", "type": "dynamic_reconfigure/Reconfigure"},
               {"kind": "subscribers", "name": "{0|name}/parameter_descriptions",
                "type": "dynamic_reconfigure/ConfigDescription"},
               {"kind": "subscribers", "name": "{0|name}/parameter_updates", "type": "dynamic_reconfigure/Config"}],
     "calls": ["2", "config_callback", "3", "description_callback"]},

    # diagnostic_updater/_diagnostic_updater.py, wiki.ros.org/diagnostic_updater
    {"class": "diagnostic_updater.Updater", "bases": ["diagnostic_updater.DiagnosticTaskVector"]},
    {"call": "diagnostic_updater.Updater",
     "makes": [{"kind": "publishers", "name": "/diagnostics", "type": "diagnostic_msgs/DiagnosticArray",
                "queue_size": 1, "latched": False},
               {"kind": "getters", "name": "~diagnostic_period", "value": 1}]},
    {"call": "diagnostic_updater.DiagnosticTaskVector.add", "args": [1], "calls": ["0.run"]},
    {"call": "diagnostic_updater.DiagnosticTaskVector.add", "args": [2], "calls": ["1"]},
    {"call": "diagnostic_updater.FunctionDiagnosticTask", "args": [2], "calls": ["1", "fn"]},

    # interactive_markers/interactive_marker_server.py, wiki.ros.org/interactive_markers
    {"call": "interactive_markers.interactive_marker_server.InteractiveMarkerServer",
     "makes": [{"kind": "publishers", "name": "{0|topic_ns}/update",
                "type": "visualization_msgs/InteractiveMarkerUpdate", "queue_size": 100, "latched": False},
               {"kind": "publishers", "name": "{0|topic_ns}/update_full",
                "type": "visualization_msgs/InteractiveMarkerInit", "queue_size": 100, "latched": True},
               {"kind": "subscribers", "name": "{0|topic_ns}/feedback",
                "type": "visualization_msgs/InteractiveMarkerFeedback", "queue_size": "{2|q_size?100}"}]},
    {"call": "interactive_markers.interactive_marker_server.InteractiveMarkerServer.insert",
     "calls": ["1", "feedback_cb"]},
    {"call": "interactive_markers.interactive_marker_server.InteractiveMarkerServer.setCallback",
     "calls": ["1", "feedback_cb"]},
    {"call": "interactive_markers.menu_handler.MenuHandler.insert", "calls": ["2", "callback"]},

    # smach_ros/service_state.py, simple_action_state.py, monitor_state.py, condition_state.py, wiki.ros.org/smach: states that
    # call a service, send a goal, or wait for a message; of the
    # callbacks those that are given by name.
    {"call": "smach_ros.ServiceState",
     "makes": [{"kind": "clients", "name": "{0|service_name}", "type": "{typename(1|service_spec)}"}],
     "calls": ["request_cb", "response_cb"]},
    {"call": "smach_ros.SimpleActionState",
     "makes": [{"kind": "action_clients", "name": "{0|action_name}", "type": "{typename(1|action_spec)}"}],
     "calls": ["goal_cb", "result_cb"]},
    {"call": "smach_ros.MonitorState",
     "makes": [{"kind": "subscribers", "name": "{0|topic}", "type": "{typename(1|msg_type)}"}],
     "calls": ["2", "cond_cb"]},
    {"call": "smach_ros.ConditionState", "calls": ["0", "cond_cb"]},
    # smach_ros/introspection.py: once it is started it has the same topics for each container. action_server_wrapper.py
    {"call": "smach_ros.IntrospectionServer", "fills": {"server": "{0|server_name}"}},
    {"call": "smach_ros.IntrospectionServer.start",
     "makes": [{"kind": "publishers", "name": "{this.server}/smach/container_status",
                "type": "smach_msgs/SmachContainerStatus", "queue_size": 1, "latched": False},
               {"kind": "publishers", "name": "{this.server}/smach/container_structure",
                "type": "smach_msgs/SmachContainerStructure", "queue_size": 1, "latched": False},
               {"kind": "subscribers", "name": "{this.server}/smach/container_init",
                "type": "smach_msgs/SmachContainerInitialStatusCmd"}]},
    {"call": "smach_ros.IntrospectionServer.stop"},
    {"call": "smach_ros.ActionServerWrapper",
     "makes": [{"kind": "action_servers", "name": "{0|server_name}", "type": "{typename(1|action_spec)}"}]},
    {"call": "smach_ros.ActionServerWrapper.run_server"},
)
# fmt: on

#: Modules of rospy and smach_ros in which the classes and functions above are defined, and may be named.
MODULES = {
    "rospy.client": "init_node wait_for_message get_param set_param has_param delete_param search_param",
    "rospy.core": "on_shutdown",
    "rospy.topics": "Publisher Subscriber",
    "rospy.impl.tcpros": "Service ServiceProxy wait_for_service",
    "rospy.impl.tcpros_service": "Service ServiceProxy wait_for_service",
    "rospy.timer": "Timer Rate",
    "rospy.rostime": "Duration",
    "smach_ros.introspection": "IntrospectionServer IntrospectionServer.start IntrospectionServer.stop",
    "smach_ros.action_server_wrapper": "ActionServerWrapper ActionServerWrapper.run_server",
}
ROWS += tuple(
    row | {"call": f"{module}.{name}"}
    for module, names in MODULES.items()
    for name in names.split()
    for row in ROWS
    if row.get("call") == f"{module.partition('.')[0]}.{name}"
)
