# SPDX-License-Identifier: Apache-2.0
"""The wrapper for rospy: subscribers, the clock, the topic of verdicts, actions."""

from __future__ import annotations

import argparse
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from haros_ci.monitor_files.parts.monitors import Property
from haros_ci.monitor_files.parts.program import Live, System, Trouble, printable, state
from haros_ci.monitor_files.parts.suite import Monitors, as_json

#: Seconds for which a service of an action is waited for.
SERVICE_PATIENCE = 1.0


def run_rospy(system: System, monitors: Monitors, options: argparse.Namespace, rest: list[str]) -> None:
    """Watch the running system of ROS 1 until the node is shut down, or its time is over."""
    try:
        import rosgraph
        import roslib.message
        import rospy
        from std_msgs.msg import String
    except ImportError as err:
        raise Trouble(f"ROS 1 is not at hand: {err}") from err
    if not rosgraph.is_master_online():
        raise Trouble(f"no master answers at {rosgraph.get_master_uri()}")
    rospy.init_node(system.node, argv=rest)
    verdicts = rospy.Publisher("~verdicts", String, queue_size=10, latch=True)
    log = {"info": rospy.loginfo, "warn": rospy.logwarn, "error": rospy.logerr, "fatal": rospy.logfatal}
    act = prepared_rospy(system, options, log)

    def say() -> None:
        with suppress(rospy.ROSException):  # the node is shut down
            verdicts.publish(String(data=as_json(state(system, monitors))))

    def violated(one: Property) -> None:
        actions = [*system.actions.get(one.title, ()), *system.actions.get("*", ())]
        for action in actions:
            if "log" not in action:
                act(action)
        say()
        level = next((action["log"] for action in actions if "log" in action), "warn")
        log[level]("%s", printable(f"violated: {one.title}: {(one.violation or {}).get('reason')}"))

    live = Live(monitors, options, lambda: int(rospy.get_rostime().to_nsec()), violated, say)
    while not rospy.is_shutdown() and not rospy.get_rostime().to_nsec():
        rospy.rostime.wallsleep(0.01)  # with use_sim_time there is no time before the first message on /clock
    for topic, name in system.topics.items():
        kind = roslib.message.get_message_class(name) if name else None
        subscribe_rospy(rospy, live, topic, kind)
    live.loop(rospy.is_shutdown)
    rospy.signal_shutdown("the monitor has ended")


def subscribe_rospy(rospy: Any, live: Live, topic: str, kind: Any) -> None:
    """Give *live* the messages on *topic*, of the class *kind*; None takes the class that the publisher names."""
    import genpy
    import roslib.message

    def typed(message: Any) -> None:
        live.receive(topic, message)

    def untyped(message: Any) -> None:
        name = message._connection_header.get("type", "?")
        found = roslib.message.get_message_class(name)
        if found is None:
            live.receive(topic, None, f"the definition of {name}, on {topic}, is not at hand")
            return
        try:
            live.receive(topic, found().deserialize(message._buff))
        except genpy.DeserializationError:
            live.receive(topic, None, f"a message on {topic} does not fit the definition of {name}")

    rospy.Subscriber(
        topic, rospy.AnyMsg if kind is None else kind, untyped if kind is None else typed, tcp_nodelay=True
    )


def prepared_rospy(
    system: System, options: argparse.Namespace, log: Mapping[str, Callable[..., None]]
) -> Callable[[Mapping[str, Any]], None]:
    """What does an action. Without --act it is named in the log alone; publishers are made now, so that they are connected when they are needed."""
    import genpy
    import genpy.message
    import roslib.message
    import rospy

    publishers: dict[str, Any] = {}
    for action in [action for entry in system.actions.values() for action in entry] if options.act else []:
        kind = roslib.message.get_message_class(action["type"]) if "publish" in action else True
        if kind is None or ("call" in action and roslib.message.get_service_class(action["type"]) is None):
            raise Trouble(f"the definition of {action['type']}, of an action, is not at hand")
        if "publish" in action:
            publishers[action["publish"]] = rospy.Publisher(action["publish"], kind, queue_size=10)

    def call(action: Mapping[str, Any]) -> None:
        try:
            rospy.wait_for_service(action["call"], timeout=SERVICE_PATIENCE)
            kind = roslib.message.get_service_class(action["type"])
            request = kind._request_class()
            genpy.message.fill_message_args(request, [action["message"]])
            rospy.ServiceProxy(action["call"], kind)(request)
        except (rospy.ROSException, rospy.ServiceException, genpy.MessageException) as err:
            log["error"]("%s", printable(f"{action['call']} was not called: {err}"))

    def act(action: Mapping[str, Any]) -> None:
        name = action.get("publish") or action["call"]
        if not options.act:
            log["warn"]("%s", printable(f"on_violation names {name}; nothing is done without --act"))
        elif "call" in action:
            threading.Thread(target=call, args=(action,), daemon=True).start()
        else:
            message = publishers[name].data_class()
            genpy.message.fill_message_args(message, [action["message"]])
            publishers[name].publish(message)

    return act
