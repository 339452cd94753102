# SPDX-License-Identifier: Apache-2.0
"""The actions of webots_ros2_driver: the simulator, the drivers of its robots, its supervisor, and what waits for a driver.

What counts is webots_ros2_driver/webots_ros2_driver of cyberbotics/webots_ros2: webots_launcher.py, webots_controller.py,
wait_for_controller_connection.py.
"""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.conditions import tests_of
from haros_ci.launch.python.entities import deferred_actions
from haros_ci.launch.python.ros_actions import started
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LaunchObject, LibraryCall, PartialText, Sub, Unknown, Value, phrase
from haros_ci.model.launch_actions import Action

PACKAGE = "webots_ros2_driver"
LAUNCHER = f"{PACKAGE}.WebotsLauncher"
#: What the driver makes an underscore of in the name of its robot (Driver.cpp).
_REPLACED = str.maketrans(dict.fromkeys(" -.)(", "_"))
UNNAMED = "the driver is called as its robot in the world of Webots, which is not read"


def _node(run: ScriptEvaluation, call: LibraryCall, **keywords: Value) -> Value:
    """A node of the package, with what else *call* is given."""
    kept = {name: value for name, value in call.keywords.items() if name in ("condition", "respawn", "parameters")}
    keywords = {"package": PACKAGE, **kept, **keywords}
    as_node = LibraryCall(
        name="launch_ros.actions.Node", location=call.location, keywords=keywords, unknown=call.unknown
    )
    return started("node")(run, as_node)


def controller(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``WebotsController(robot_name=…, namespace=…, parameters=[…], remappings=[…])``."""
    bound = call.bind("output respawn remappings namespace parameters robot_name")
    robot, space = bound.get("robot_name"), bound.get("namespace")
    name = robot.translate(_REPLACED) if isinstance(robot, str) and robot else Unknown(UNNAMED, call.location)
    extra: dict[str, Value] = {"executable": "driver", "name": name}
    if isinstance(space, (PartialText, Sub, Unknown)) or space:
        extra["namespace"] = f"/{space}" if isinstance(space, str) else (PartialText(("/", *phrase(space))))
    for key in ("parameters", "remappings"):
        if bound.get(key) is not None:
            extra[key] = bound[key]
    return _node(run, call, **extra)


def supervisor(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``Ros2SupervisorLauncher()``."""
    return _node(run, call, executable="ros2_supervisor.py", name="Ros2Supervisor")


def launcher(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``WebotsLauncher(world=…, ros2_supervisor=True)``: it starts no node itself; its ``_supervisor`` is one."""
    bound = call.bind("output world gui mode stream ros2_supervisor")
    asked = bound.get("ros2_supervisor", False)
    fields: dict[str, Value] = {}
    if asked is True:
        own = LibraryCall(name=call.name, location=call.location, keywords={}, unknown="")
        fields["_supervisor"] = supervisor(run, own)
    elif asked is not False:
        fields["_supervisor"] = Unknown("whether Webots has a supervisor is not known", call.location)
    tests = tests_of(bound.get("condition"), call.location)
    return LaunchObject(LAUNCHER, call.location, fields, Action(kind="log", location=call.location, tests=tests))


def waiting(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``WaitForControllerConnection(target_driver, nodes_to_start)``."""
    nodes = call.bind("target_driver nodes_to_start").get("nodes_to_start")
    children = deferred_actions(run, nodes, call.location, 0)
    action = Action(kind="event", location=call.location, children=tuple(children), deferred="OnProcessIO")
    return LaunchObject(call.name, call.location, {}, action)


SUMMARIES: dict[str, Summary] = {
    f"{PACKAGE}.webots_controller.WebotsController": controller,
    f"{PACKAGE}.webots_launcher.WebotsLauncher": launcher,
    f"{PACKAGE}.webots_launcher.Ros2SupervisorLauncher": supervisor,
    f"{PACKAGE}.wait_for_controller_connection.WaitForControllerConnection": waiting,
}
