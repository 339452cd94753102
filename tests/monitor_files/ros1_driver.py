# SPDX-License-Identifier: Apache-2.0
"""Runs under the distribution's Python: publishes numbers beside a monitor, and says in JSON what the monitor published and did.

    ros1_driver.py MONITOR_NODE acts|watches [NUMBER …]

A line is written when it is ready, one when the monitor has taken all messages or has found a violation, and one at the end of the standard input.
"""

import json
import sys
import time

import rospy
from roscpp.srv import Empty, EmptyResponse
from std_msgs.msg import Bool, Int32, String

PATIENCE = 30.0


def wait_for(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            print(json.dumps({"trouble": "waited in vain"}), flush=True)
            sys.exit(3)
        time.sleep(0.005)


def main():
    node, manner, *numbers = sys.argv[1:]
    seen = {"state": {"messages": 0, "violated": 0}, "alarms": [], "calls": 0, "log": []}

    def called(_):
        seen["calls"] += 1
        return EmptyResponse()

    rospy.init_node("driver")
    level = rospy.Publisher("/level", Int32, queue_size=100)
    other = rospy.Publisher("/other", Bool, queue_size=100)
    rospy.Service("/motors/off", Empty, called)
    alarm = rospy.Subscriber("/alarm", String, lambda message: seen["alarms"].append(message.data))
    rospy.Subscriber("/%s/verdicts" % node, String, lambda message: seen.update(state=json.loads(message.data)))
    print(json.dumps({"ready": True}), flush=True)
    wait_for(lambda: level.get_num_connections() > 0 and other.get_num_connections() > 0)
    if manner == "acts":
        wait_for(lambda: alarm.get_num_connections() > 0)
    other.publish(Bool(data=True))
    for number in numbers:
        level.publish(Int32(data=int(number)))
    wait_for(lambda: seen["state"]["messages"] > len(numbers) or seen["state"]["violated"])
    if manner == "acts":
        wait_for(lambda: seen["alarms"] and seen["calls"])
    print(json.dumps(seen), flush=True)
    sys.stdin.readline()
    print(json.dumps(seen), flush=True)


main()
