# SPDX-License-Identifier: Apache-2.0
"""What the ``generate_*_launch`` functions of moveit_configs_utils launch (launches.py, launch_utils.py)."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.entities import description
from haros_ci.launch.python.launch_actions import SUMMARIES as LAUNCH
from haros_ci.launch.python.moveit import CONFIGS, as_dictionary
from haros_ci.launch.python.paths import joined_path
from haros_ci.launch.python.ros_actions import SUMMARIES as ROS
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LaunchObject, Library, LibraryCall, Rest, Sub, Unknown, Value, why
from haros_ci.model.launch_actions import Substitution, Test


def library(run: ScriptEvaluation, name: str, call: LibraryCall, *args: Value, **keywords: Value) -> Value:
    """What launch's *name* makes at the place of *call*."""
    summary = LAUNCH.get(name) or ROS[name]
    return summary(run, LibraryCall(name=name, location=call.location, args=args, keywords=keywords))


def argument(run: ScriptEvaluation, call: LibraryCall, name: str, default: Value) -> Value:
    return library(run, "launch.actions.DeclareLaunchArgument", call, name, default_value=default)


def switch(run: ScriptEvaluation, call: LibraryCall, name: str, default: bool) -> Value:
    return library(run, "moveit_configs_utils.launch_utils.DeclareBooleanLaunchArg", call, name, default_value=default)


def configuration(call: LibraryCall, name: str) -> Sub:
    return Sub((Substitution("var", ((name,),), call.location),), "LaunchConfiguration")


def when(call: LibraryCall, kind: str, name: str) -> LaunchObject:
    """``condition=IfCondition(LaunchConfiguration(name))``, or unless."""
    test = Test(kind=kind, phrases=(configuration(call, name).phrase,), text=name, location=call.location)
    return LaunchObject("launch.conditions.IfCondition", call.location, {"test": test})


def debuggable(
    run: ScriptEvaluation, call: LibraryCall, extra: Value = None, commands: Value = None, **keywords: Value
) -> list[Value]:
    """A node, and the same in a debugger if ``debug`` is set."""
    debugged = dict(keywords)
    name = keywords.pop("condition_name", "debug")
    debugged.pop("condition_name", None)
    if isinstance(debugged.get("arguments"), list) and isinstance(extra, list):
        debugged["arguments"] = [*debugged["arguments"], *extra]
    debugged["prefix"] = f"gdb {f'-x {commands} ' if isinstance(commands, str) else ''}--ex run --args"
    if not isinstance(name, str):
        return [run.unknown(why(name), call.location)]
    return [
        library(run, "launch_ros.actions.Node", call, **keywords, condition=when(call, "unless", name)),
        library(run, "launch_ros.actions.Node", call, **debugged, condition=when(call, "if", name)),
    ]


def add_debuggable_node(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``add_debuggable_node(ld, package, executable, condition_name, commands_file, extra_debug_args, **kwargs)``."""
    bound = call.bind("ld package executable condition_name commands_file extra_debug_args")
    target: Any = bound.pop("ld", None)
    extra, commands = bound.pop("extra_debug_args", None), bound.pop("commands_file", None)
    found = debuggable(run, call, extra, commands, **bound)
    if isinstance(target, LaunchObject) and "entities" in target.fields:
        run.heap.touch(target.fields["entities"])
        target.fields["entities"].extend(found)
        return None
    return run.unknown("the launch description is not known", call.location)


def below(made: LaunchObject, *parts: str) -> Value:
    return joined_path([made.fields["package_path"], *parts])


def rsp(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    parameters = [made.fields["robot_description"], {"publish_frequency": configuration(call, "publish_frequency")}]
    return [
        argument(run, call, "publish_frequency", "15.0"),
        library(
            run,
            "launch_ros.actions.Node",
            call,
            package="robot_state_publisher",
            executable="robot_state_publisher",
            respawn=True,
            parameters=parameters,
        ),
    ]


def rviz(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    parameters = [made.fields[name] for name in ("planning_pipelines", "robot_description_kinematics", "joint_limits")]
    return [
        switch(run, call, "debug", False),
        argument(run, call, "rviz_config", below(made, "config/moveit.rviz")),
        *debuggable(
            run,
            call,
            package="rviz2",
            executable="rviz2",
            respawn=False,
            parameters=parameters,
            arguments=["-d", configuration(call, "rviz_config")],
        ),
    ]


def assistant(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    words = [["--config_pkg=", below(made)]]
    return [
        switch(run, call, "debug", False),
        *debuggable(run, call, package="moveit_setup_assistant", executable="moveit_setup_assistant", arguments=words),
    ]


def joints(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    return [Rest("a static transform for each virtual joint of the SRDF", call.location)]


def spawners(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    """A spawner for each controller of the trajectory execution's parameters, and for the joint states."""
    execution = made.fields["trajectory_execution"]
    manager = execution.get("moveit_simple_controller_manager") if isinstance(execution, dict) else None
    names = manager.get("controller_names") if isinstance(manager, dict) else None
    found: list[Value] = []
    if isinstance(names, list):
        found = list(names)
    elif not isinstance(execution, dict) or any(isinstance(key, Rest) for key in execution):
        found = [Unknown("which controllers there are is not known", call.location)]
    return [
        library(
            run, "launch_ros.actions.Node", call, package="controller_manager", executable="spawner", arguments=[name]
        )
        for name in [*found, "joint_state_broadcaster"]
    ]


def warehouse(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    parameters = {
        "overwrite": False,
        "database_path": configuration(call, "moveit_warehouse_database_path"),
        "warehouse_port": configuration(call, "moveit_warehouse_port"),
        "warehouse_host": configuration(call, "moveit_warehouse_host"),
        "warehouse_exec": "mongod",
        "warehouse_plugin": "warehouse_ros_mongo::MongoDatabaseConnection",
    }
    return [
        argument(run, call, "moveit_warehouse_database_path", below(made, "default_warehouse_mongo_db")),
        switch(run, call, "reset", False),
        argument(run, call, "moveit_warehouse_port", "33829"),
        argument(run, call, "moveit_warehouse_host", "localhost"),
        library(
            run,
            "launch_ros.actions.Node",
            call,
            package="warehouse_ros_mongo",
            executable="mongo_wrapper_ros.py",
            parameters=[parameters],
        ),
        library(
            run,
            "launch_ros.actions.Node",
            call,
            package="moveit_ros_warehouse",
            executable="moveit_init_demo_warehouse",
            condition=when(call, "if", "reset"),
        ),
    ]


def move_group(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    shown = configuration(call, "publish_monitored_planning_scene")
    parameters: dict[str, Value] = {
        "publish_robot_description_semantic": True,
        "allow_trajectory_execution": configuration(call, "allow_trajectory_execution"),
    }
    capabilities = made.fields["move_group_capabilities"]
    arguments: list[Value] = []
    for name in ("capabilities", "disable_capabilities"):
        default = (
            capabilities.get(name, "") if isinstance(capabilities, dict) else Unknown(why(capabilities), call.location)
        )
        arguments.append(argument(run, call, name, default))
        text = LaunchObject(
            "launch_ros.parameter_descriptions.ParameterValue",
            call.location,
            {
                "value": configuration(call, name),
                "value_type": STR,
            },
        )
        parameters[name] = text
    for name in (
        "publish_planning_scene",
        "publish_geometry_updates",
        "publish_state_updates",
        "publish_transforms_updates",
    ):
        parameters[name] = shown
    parameters["monitor_dynamics"] = False
    return [
        switch(run, call, "debug", False),
        switch(run, call, "allow_trajectory_execution", True),
        switch(run, call, "publish_monitored_planning_scene", True),
        *arguments,
        switch(run, call, "monitor_dynamics", False),
        *debuggable(
            run,
            call,
            ["--debug"],
            below(made, "launch/gdb_settings.gdb"),
            package="moveit_ros_move_group",
            executable="move_group",
            parameters=[as_dictionary(run, made), parameters],
        ),
    ]


def demo(run: ScriptEvaluation, call: LibraryCall, made: LaunchObject) -> list[Value]:
    provided = call.bind("moveit_config launch_package_path").get("launch_package_path")
    base = made.fields["package_path"] if provided is None else provided

    def included(file: str, name: str = "") -> Value:
        keywords: dict[str, Value] = {"condition": when(call, "if", name)} if name else {}
        path = joined_path([base, f"launch/{file}.launch.py"])
        return library(run, "launch.actions.IncludeLaunchDescription", call, path, **keywords)

    controllers = below(made, "config/ros2_controllers.yaml")
    return [
        switch(run, call, "db", False),
        switch(run, call, "debug", False),
        switch(run, call, "use_rviz", True),
        included("static_virtual_joint_tfs"),
        included("rsp"),
        included("move_group"),
        included("moveit_rviz", "use_rviz"),
        included("warehouse_db", "db"),
        library(
            run,
            "launch_ros.actions.Node",
            call,
            package="controller_manager",
            executable="ros2_control_node",
            parameters=[controllers],
            remappings=[("/controller_manager/robot_description", "/robot_description")],
        ),
        included("spawn_controllers"),
    ]


def generated(make: Any) -> Summary:
    """A function of a MoveItConfigs that gives a LaunchDescription."""

    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        made = call.bind("moveit_config").get("moveit_config")
        if not isinstance(made, LaunchObject) or made.name != CONFIGS:
            return run.unknown(f"the MoveIt configuration is not known: {why(made)}", call.location)
        return description(call.location, make(run, call, made))

    return summary


STR = Library("builtins.str")
G = "moveit_configs_utils.launches.generate_"
SUMMARIES: dict[str, Summary] = {
    "moveit_configs_utils.launch_utils.add_debuggable_node": add_debuggable_node,
    f"{G}rsp_launch": generated(rsp),
    f"{G}moveit_rviz_launch": generated(rviz),
    f"{G}setup_assistant_launch": generated(assistant),
    f"{G}static_virtual_joint_tfs_launch": generated(joints),
    f"{G}spawn_controllers_launch": generated(spawners),
    f"{G}warehouse_db_launch": generated(warehouse),
    f"{G}move_group_launch": generated(move_group),
    f"{G}demo_launch": generated(demo),
}
