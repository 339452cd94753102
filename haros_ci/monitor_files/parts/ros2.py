# SPDX-License-Identifier: Apache-2.0
"""The wrapper for rclpy: subscriptions that fit the publishers, the clock, the topic of verdicts, actions."""

from __future__ import annotations

import argparse
import threading
from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.monitor_files.parts.monitors import Property
from haros_ci.monitor_files.parts.program import Live, System, Trouble, printable, state
from haros_ci.monitor_files.parts.suite import Monitors, as_json

#: Messages that wait for their callback.
DEPTH = 1000


def run_rclpy(system: System, monitors: Monitors, options: argparse.Namespace, rest: list[str]) -> None:
    """Watch the running system of ROS 2 until the context is shut down, or its time is over."""
    try:
        import rclpy
        from rclpy.executors import ExternalShutdownException
        from rclpy.qos import DurabilityPolicy, QoSProfile
        from rosidl_runtime_py.utilities import get_message
        from std_msgs.msg import String
    except ImportError as err:
        raise Trouble(f"ROS 2 is not at hand: {err}") from err
    rclpy.init(args=rest)
    node = rclpy.create_node(system.node)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    verdicts = node.create_publisher(String, "~/verdicts", latched)
    logger = node.get_logger()
    log = {"info": logger.info, "warn": logger.warning, "error": logger.error, "fatal": logger.fatal}
    act = prepared_rclpy(system, node, options, log)

    def say() -> None:
        if rclpy.ok():
            verdicts.publish(String(data=as_json(state(system, monitors))))

    def violated(one: Property) -> None:
        actions = [*system.actions.get(one.title, ()), *system.actions.get("*", ())]
        for action in actions:
            if "log" not in action:
                act(action)
        say()
        level = next((action["log"] for action in actions if "log" in action), "warn")
        log[level](printable(f"violated: {one.title}: {(one.violation or {}).get('reason')}"))

    live = Live(monitors, options, lambda: int(node.get_clock().now().nanoseconds), violated, say)

    def spin() -> None:
        try:
            rclpy.spin(node)
        except (ExternalShutdownException, KeyboardInterrupt):
            pass

    for topic, name in system.topics.items():
        if not name:
            for one in monitors.ears.get(topic, ()):
                one.leave(f"the type of {topic} is not known")
            continue
        try:
            kind = get_message(name)
        except (AttributeError, ModuleNotFoundError, ValueError) as err:
            raise Trouble(f"the definition of {name}, on {topic}, is not at hand") from err
        node.create_subscription(kind, topic, receiver(live, topic), fitting(system.qos.get(topic, {})))
    thread = threading.Thread(target=spin, daemon=True)
    thread.start()
    try:
        live.loop(lambda: not rclpy.ok())
    except KeyboardInterrupt:
        live.is_over = True
    rclpy.try_shutdown()
    thread.join(timeout=1.0)


def receiver(live: Live, topic: str) -> Callable[[Any], None]:
    """The callback of the subscription to *topic*."""
    return lambda message: live.receive(topic, message)


def fitting(qos: Mapping[str, str]) -> Any:
    """A profile that publishers of the system can serve: best effort and volatile fit all, and *qos* says where more is certain."""
    from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE
        if qos.get("reliability") == "reliable"
        else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if qos.get("durability") == "transient_local"
        else DurabilityPolicy.VOLATILE,
    )


def prepared_rclpy(
    system: System, node: Any, options: argparse.Namespace, log: Mapping[str, Callable[..., Any]]
) -> Callable[[Mapping[str, Any]], None]:
    """What does an action. Without --act it is named in the log alone; publishers and clients are made now, so that they are connected when they are needed."""
    from rosidl_runtime_py.set_message import set_message_fields
    from rosidl_runtime_py.utilities import get_message, get_service

    ends: dict[str, tuple[Any, Any]] = {}
    for action in [action for entry in system.actions.values() for action in entry] if options.act else []:
        if "publish" in action:
            message = get_message(action["type"])
            ends[action["publish"]] = message, node.create_publisher(message, action["publish"], 10)
        elif "call" in action:
            service = get_service(action["type"])
            ends[action["call"]] = service.Request, node.create_client(service, action["call"])

    def act(action: Mapping[str, Any]) -> None:
        name = action.get("publish") or action["call"]
        if not options.act:
            log["warn"](printable(f"on_violation names {name}; nothing is done without --act"))
            return
        kind, end = ends[name]
        message = kind()
        set_message_fields(message, action["message"])
        if "publish" in action:
            end.publish(message)
        elif end.service_is_ready():
            end.call_async(message)
        else:
            log["error"](printable(f"{name} was not called: no node serves it"))

    return act
