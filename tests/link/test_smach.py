# SPDX-License-Identifier: Apache-2.0
"""smach_ros: what servers for introspection, wrappers and states of a state machine make, in ROS 1 and ROS 2."""

from __future__ import annotations

import pytest
from follow_kit import explicit, python, types
from test_ros2_python import program

from haros_ci.model.architecture import Node

KINDS = "publishers subscribers servers clients action_servers action_clients".split()
SERVED = [
    "publishers {}/smach/container_status",
    "publishers {}/smach/container_structure",
    "subscribers {}/smach/container_init",
]
IMPORTS = (
    "import smach, smach_ros\nfrom smach_ros import *\nfrom smach_ros.introspection import IntrospectionServer as I\n"
)
MACHINE = "sm = smach.StateMachine(outcomes=['a'])\n"


def made(node: Node) -> list[str]:
    return [f"{kind} {name}" for kind in KINDS for name in sorted(end.name for end in explicit(node, kind))]


def served(name: str) -> list[str]:
    return [line.format(name) for line in SERVED]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("s = smach_ros.IntrospectionServer('server', sm, '/SM_ROOT')\ns.start()", served("/server")),
        ("s = IntrospectionServer('/a/server', sm, '/SM_ROOT')\ns.start()", served("/a/server")),
        ("s = I(server_name='server', state=sm, path='/')\ns.start()\ns.stop()", served("/server")),
        ("s = IntrospectionServer(rospy.get_name(), sm, '/')\ns.start()", served("/n")),
        ("s = IntrospectionServer('s', sm, '/')", []),
        ("s = IntrospectionServer('s', sm, '/')\ns.stop()", []),
        ("w = ActionServerWrapper('do', TFAction, sm)\nw.run_server()", ["action_servers /do"]),
        ("s = other.IntrospectionServer('s', sm, '/')\ns.start()", []),
    ],
)
def test_ros1(body: str, expected: list[str]) -> None:
    assert made(python(IMPORTS + "from tf2_msgs.msg import TFAction\nimport other\n" + MACHINE + body)) == expected


def test_types_in_ros1() -> None:
    node = python(IMPORTS + MACHINE + "IntrospectionServer('s', sm, '/').start()")
    assert types(node) == [
        ("/s/smach/container_status", "smach_msgs/SmachContainerStatus"),
        ("/s/smach/container_structure", "smach_msgs/SmachContainerStructure"),
    ]
    assert types(node, "subscribers") == [("/s/smach/container_init", "smach_msgs/SmachContainerInitialStatusCmd")]


def test_a_name_that_is_not_known() -> None:
    node = python(IMPORTS + MACHINE + "IntrospectionServer(f(), sm, '/').start()")
    assert [end.name for end in explicit(node)] == ["/?/smach/container_status", "/?/smach/container_structure"]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("ServiceState(node, 'a', SetBool)", ["clients /n/a"]),
        ("SimpleActionState(node, 'a', Fibonacci)", ["action_clients /n/a"]),
        ("MonitorState(node, 'a', String, lambda u, m: True)", ["subscribers /n/a"]),
        ("ActionServerWrapper(node, 'a', Fibonacci, sm)", ["action_servers /n/a"]),
        ("ConditionState(node, lambda u: True)", []),
    ],
)
def test_states_of_ros2(body: str, expected: list[str]) -> None:
    (node,) = program(f"node = Node('me', namespace='n')\n{MACHINE}{body}", IMPORTS).nodes
    assert made(node) == expected


def test_introspection_of_ros2_is_a_node_of_its_own() -> None:
    found = program(f"{MACHINE}s = IntrospectionServer('server', sm, '/SM_ROOT')\ns.start()", IMPORTS)
    assert [(node.name, made(node)) for node in found.nodes] == [("/server", served("/server"))]
