# SPDX-License-Identifier: Apache-2.0
"""Other libraries (ROS 1, C++): real-time publishers, interactive markers, bonds, robot models, plugins."""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # realtime_tools/realtime_publisher.h
    {"call": "realtime_tools::RealtimePublisher", "args": [3, 4],
     "makes": [{"kind": "publishers", "name": "{1}", "type": "{<0>}", "queue_size": "{2}", "latched": "{3?false}",
                "namespace": "{0}"}]},
    {"call": "realtime_tools::RealtimePublisher::init", "args": [3, 4],
     "makes": [{"kind": "publishers", "name": "{1}", "type": "{this<0>}", "queue_size": "{2}",
                "latched": "{3?false}", "namespace": "{0}"}]},

    # interactive_markers/interactive_marker_server.h, interactive_marker_client.h, menu_handler.h
    {"call": "interactive_markers::InteractiveMarkerServer", "args": [1, 2, 3],
     "makes": [{"kind": "publishers", "name": "{0}/update", "type": "visualization_msgs/InteractiveMarkerUpdate",
                "queue_size": 100, "latched": False},
               {"kind": "publishers", "name": "{0}/update_full", "type": "visualization_msgs/InteractiveMarkerInit",
                "queue_size": 100, "latched": True},
               {"kind": "subscribers", "name": "{0}/feedback",
                "type": "visualization_msgs/InteractiveMarkerFeedback", "queue_size": 100}]},
    {"call": "interactive_markers::InteractiveMarkerServer::insert", "args": [1, 2, 3], "calls": ["1"]},
    {"call": "interactive_markers::InteractiveMarkerServer::setCallback", "args": [2, 3], "calls": ["1"]},
    {"call": "interactive_markers::InteractiveMarkerClient::subscribe", "args": [1],
     "makes": [{"kind": "subscribers", "name": "{0}/update", "type": "visualization_msgs/InteractiveMarkerUpdate",
                "queue_size": 100},
               {"kind": "subscribers", "name": "{0}/update_full", "type": "visualization_msgs/InteractiveMarkerInit",
                "queue_size": 100}]},
    {"call": "interactive_markers::MenuHandler::insert", "args": [2], "calls": ["1"]},
    {"call": "interactive_markers::MenuHandler::insert", "args": [3], "calls": ["2"]},

    # bondcpp/bond.h, bondcpp/src/bond.cpp, bond/msg/Constants.msg: the topic is used from start on.
    {"call": "bond::Bond", "args": [2, 3, 4], "fills": {"topic": "{0}"}, "calls": ["2", "3"]},
    {"call": "bond::Bond::start", "args": [0],
     "makes": [{"kind": "publishers", "name": "{this.topic}", "type": "bond/Status", "queue_size": 5,
                "latched": False, "implicit": True},
               {"kind": "subscribers", "name": "{this.topic}", "type": "bond/Status", "queue_size": 30,
                "implicit": True},
               {"kind": "getters", "name": "/bond_disable_heartbeat_timeout", "type": "bool", "value": False,
                "implicit": True}]},

    # robot_state_publisher/robot_state_publisher.h, joint_state_listener.cpp (melodic-devel, noetic-devel)
    {"call": "robot_state_publisher::RobotStatePublisher", "args": [1, 2],
     "makes": [{"kind": "publishers", "name": "/tf", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": False},
               {"kind": "publishers", "name": "/tf_static", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": True}]},
    {"call": "robot_state_publisher::JointStateListener", "args": [2, 3],
     "makes": [{"kind": "publishers", "name": "/tf", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": False},
               {"kind": "publishers", "name": "/tf_static", "type": "tf2_msgs/TFMessage", "queue_size": 100,
                "latched": True},
               {"kind": "subscribers", "name": "joint_states", "type": "sensor_msgs/JointState", "queue_size": 1},
               {"kind": "getters", "name": "publish_frequency", "type": "double", "value": "50.0", "namespace": "~"},
               {"kind": "getters", "name": "use_tf_static", "type": "bool", "value": True, "namespace": "~"},
               {"kind": "getters", "name": "ignore_timestamp", "type": "bool", "value": False, "namespace": "~"}]},

    # controller_manager/controller_manager.h, controller_manager.cpp (noetic-devel)
    {"call": "controller_manager::ControllerManager", "args": [1],
     "makes": [{"kind": "servers", "name": "controller_manager/list_controllers",
                "type": "controller_manager_msgs/ListControllers"},
               {"kind": "servers", "name": "controller_manager/list_controller_types",
                "type": "controller_manager_msgs/ListControllerTypes"},
               {"kind": "servers", "name": "controller_manager/load_controller",
                "type": "controller_manager_msgs/LoadController"},
               {"kind": "servers", "name": "controller_manager/unload_controller",
                "type": "controller_manager_msgs/UnloadController"},
               {"kind": "servers", "name": "controller_manager/switch_controller",
                "type": "controller_manager_msgs/SwitchController"},
               {"kind": "servers", "name": "controller_manager/reload_controller_libraries",
                "type": "controller_manager_msgs/ReloadControllerLibraries"}],
     "unseen": "controllers are loaded when the system runs"},
    {"call": "controller_manager::ControllerManager", "args": [2],
     "makes": [{"kind": "servers", "name": "controller_manager/list_controllers",
                "type": "controller_manager_msgs/ListControllers", "namespace": "{1}"},
               {"kind": "servers", "name": "controller_manager/list_controller_types",
                "type": "controller_manager_msgs/ListControllerTypes", "namespace": "{1}"},
               {"kind": "servers", "name": "controller_manager/load_controller",
                "type": "controller_manager_msgs/LoadController", "namespace": "{1}"},
               {"kind": "servers", "name": "controller_manager/unload_controller",
                "type": "controller_manager_msgs/UnloadController", "namespace": "{1}"},
               {"kind": "servers", "name": "controller_manager/switch_controller",
                "type": "controller_manager_msgs/SwitchController", "namespace": "{1}"},
               {"kind": "servers", "name": "controller_manager/reload_controller_libraries",
                "type": "controller_manager_msgs/ReloadControllerLibraries", "namespace": "{1}"}],
     "unseen": "controllers are loaded when the system runs"},

    # What these make depends on plug-ins, on parameters of theirs, and on their version.
    {"call": "costmap_2d::Costmap2DROS", "args": [2], "unseen": "a costmap and its layers are made"},
    {"call": "moveit::planning_interface::MoveGroupInterface", "args": [1, 2, 3],
     "unseen": "a client of move_group is made"},
    {"call": "moveit::planning_interface::MoveGroup", "args": [1, 2, 3],  # its name up to Indigo's end
     "unseen": "a client of move_group is made"},
    {"call": "moveit::planning_interface::PlanningSceneInterface", "args": [0, 1, 2],
     "unseen": "a client of move_group is made"},
    {"call": "planning_scene_monitor::PlanningSceneMonitor", "args": [1, 2, 3, 4],
     "unseen": "a planning scene is monitored"},

    # urdf/model.h, urdf/src/model.cpp: the parameter is searched for from the handle's namespace upwards; without one, that of ros::NodeHandle().
    {"call": "urdf::Model::initParam", "args": [1],
     "makes": [{"kind": "getters", "name": "{search(0)}", "type": "str", "namespace": "{handle()}"}]},
    {"call": "urdf::Model::initParamWithNodeHandle", "args": [1],
     "makes": [{"kind": "getters", "name": "{search(0)}", "type": "str", "namespace": "{handle()}"}]},
    {"call": "urdf::Model::initParamWithNodeHandle", "args": [2],
     "makes": [{"kind": "getters", "name": "{search(0)}", "type": "str", "namespace": "{1}"}]},

    # pluginlib/class_loader.hpp: which class is loaded is a value; all that is known is the base.
    {"call": "pluginlib::ClassLoader::createInstance", "args": [1], "returns": "{this<0>}"},
    {"call": "pluginlib::ClassLoader::createUniqueInstance", "args": [1], "returns": "{this<0>}"},
    {"call": "pluginlib::ClassLoader::createUnmanagedInstance", "args": [1], "returns": "{this<0>}"},
    {"call": "pluginlib::ClassLoader::createClassInstance", "args": [1, 2], "returns": "{this<0>}"},
)
