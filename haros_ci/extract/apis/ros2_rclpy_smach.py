# SPDX-License-Identifier: Apache-2.0
"""ROS 2 Python: smach_ros, whose states call services, send goals and wait for messages on the node that they are given."""

from __future__ import annotations

from haros_ci.extract.apis.ros2_rclpy import SERVICES, renamed

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # smach_ros/service_state.py, simple_action_state.py, monitor_state.py, condition_state.py: of the callbacks those that are given by name.
    {"call": "smach_ros.ServiceState",
     "makes": [{"kind": "clients", "name": "{1|service_name}", "type": "{typename(2|service_spec)}", "qos": SERVICES,
                "namespace": "{0|node}"}],
     "calls": ["request_cb", "response_cb"]},
    {"call": "smach_ros.SimpleActionState",
     "makes": [{"kind": "action_clients", "name": "{1|action_name}", "type": "{typename(2|action_spec)}",
                "namespace": "{0|node}"}],
     "calls": ["goal_cb", "result_cb"]},
    {"call": "smach_ros.MonitorState",
     "makes": [{"kind": "subscribers", "name": "{1|topic}", "type": "{typename(2|msg_type)}", "qos": 1,
                "namespace": "{0|node}"}],
     "calls": ["3", "cond_cb"]},
    {"call": "smach_ros.ConditionState", "calls": ["1", "cond_cb"]},
    {"call": "smach_ros.ActionServerWrapper",
     "makes": [{"kind": "action_servers", "name": "{1|server_name}", "type": "{typename(2|action_spec)}",
                "namespace": "{0|node}"}]},
    {"call": "smach_ros.ActionServerWrapper.run_server"},

    # smach_ros/introspection.py: a node of its own, with the same topics for each container once it is started.
    {"class": "smach_ros.IntrospectionServer", "bases": ["rclpy.node.Node"]},
    {"call": "smach_ros.IntrospectionServer", "makes": [{"kind": "node", "name": "{0|server_name}"}],
     "fills": {"server": "{0|server_name}"}},
    {"call": "smach_ros.IntrospectionServer.start",
     "makes": [{"kind": "publishers", "name": "{this.server}/smach/container_status",
                "type": "smach_msgs/msg/SmachContainerStatus", "qos": 1},
               {"kind": "publishers", "name": "{this.server}/smach/container_structure",
                "type": "smach_msgs/msg/SmachContainerStructure", "qos": 1},
               {"kind": "subscribers", "name": "{this.server}/smach/container_init",
                "type": "smach_msgs/msg/SmachContainerInitialStatusCmd", "qos": 1}]},
    {"call": "smach_ros.IntrospectionServer.stop"},
)
# fmt: on

ROWS += renamed(
    ROWS,
    {
        "smach_ros.IntrospectionServer": ("smach_ros.introspection.IntrospectionServer",),
        "smach_ros.ActionServerWrapper": ("smach_ros.action_server_wrapper.ActionServerWrapper",),
    },
)
