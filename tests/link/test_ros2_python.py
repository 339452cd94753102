# SPDX-License-Identifier: Apache-2.0
"""rclpy programs: nodes, endpoints, quality of service, parameters, libraries; what is not known stays so."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import pytest
from follow_kit import explicit, follow, only

from haros_ci.model.architecture import Configuration, Node, Qos

SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"
HEAD = (
    "import rclpy\nfrom rclpy.node import Node\nfrom rclpy.parameter import Parameter\nfrom rclpy.duration import Duration\n"
    "from rclpy.qos import *\nfrom rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSPresetProfiles, QoSProfile\n"
    "from rclpy.qos import LivelinessPolicy, QoSReliabilityPolicy, ReliabilityPolicy, qos_profile_sensor_data\n"
    "from std_msgs.msg import String\nfrom std_srvs.srv import SetBool\nfrom example_interfaces.action import Fibonacci\n"
)
CLASS = "class N(Node):\n    def __init__(self):\n        super().__init__('n', namespace='s')\n"
MAIN = "def main(args=None):\n    rclpy.init(args=args)\n"
KINDS = "publishers subscribers servers clients action_servers action_clients"


def files(text: str, **modules: str) -> dict[str, str]:
    """The Python package ``p`` whose console script ``n`` is ``main`` of *text*; *modules* are others of the package."""
    more = {f"p/p/{name}.py": content for name, content in modules.items()}
    return {"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text, **more}


def program(body: str, before: str = "", **modules: str) -> Configuration:
    """What a program with this in ``main``, after ``rclpy.init``, comes to."""
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    return only(follow(files(HEAD + before + MAIN + lines, **modules), 2))


def node(body: str, methods: str = "", head: str = "") -> Node:
    """The node ``/s/n`` of a class with this in its constructor, and with these methods."""
    inside = "".join(f"        {line}\n" for line in body.splitlines())
    inside += "".join(f"    {line}\n" for line in methods.splitlines())
    found = program("rclpy.spin(N())", f"{head}\n{CLASS}{inside}")
    (made,) = found.nodes
    assert (made.name, made.kind, made.ros) == ("/s/n", "node", 2)
    return made


def made(found: Node, kinds: str = KINDS) -> list[str]:
    """``kind name`` of what the code makes, sorted within a kind."""
    return [f"{kind} {name}" for kind in kinds.split() for name in sorted(end.name for end in explicit(found, kind))]


def profiles(found: Node) -> list[Qos | None]:
    return [end.qos for kind in ("publishers", "subscribers") for end in explicit(found, kind)]


def declared(found: Node) -> dict[str, tuple[str | None, Any, Any]]:
    """Type, default and effective value of what is declared, by name."""
    return {end.name.partition(":")[2]: (end.type, end.value, end.effective) for end in explicit(found, "parameters")}


def unknown(found: Node) -> list[tuple[str, str, str]]:
    """Name, field and reason of what is not known of the endpoints."""
    return [(end.name, each.field, each.reason) for end in found.endpoints if not end.implicit for each in end.unknowns]


def rows(cases: Iterable[Any], defects: Mapping[str, str] | None = None) -> Any:
    """Parametrise by (name, head, body, methods, expected); *defects* are why one does not hold yet, by its name."""
    marked = []
    for name, *values in cases:
        marks = (pytest.mark.xfail(strict=True, reason=defects[name]),) if defects and name in defects else ()
        marked.append(pytest.param(*values, id=name, marks=marks))
    return pytest.mark.parametrize(("head", "body", "methods", "expected"), marked)


def case(name: str, body: str, *expected: str, methods: str = "", head: str = "") -> Any:
    return name, head, body, methods, list(expected)


CALLED = "def cb(self, *args):\n    self.create_publisher(String, 'called', 1)"
FIRES = (
    case("publisher", "self.create_publisher(String, 'a', 10)", "publishers /s/a"),
    case("keywords", "self.create_publisher(msg_type=String, qos_profile=1, topic='a')", "publishers /s/a"),
    case("absolute", "self.create_publisher(String, '/a', 10)", "publishers /a"),
    case("private", "self.create_publisher(String, '~/a', 10)", "publishers /s/n/a"),
    case(
        "subscription",
        "self.create_subscription(String, 'a', self.cb, 10)",
        "publishers /s/called",
        "subscribers /s/a",
        methods=CALLED,
    ),
    case(
        "lambda",
        "self.create_subscription(String, 'a', lambda m: self.create_publisher(String, m.x and 'b', 1), 10)",
        "publishers /?",
        "subscribers /s/a",
    ),
    case(
        "service", "self.create_service(SetBool, 'a', self.cb)", "publishers /s/called", "servers /s/a", methods=CALLED
    ),
    case("client", "self.create_client(SetBool, srv_name='a')", "clients /s/a"),
    case("timer", "self.create_timer(0.5, self.cb)", "publishers /s/called", methods=CALLED),
    case(
        "timer by keyword",
        "self.create_timer(callback=self.cb, timer_period_sec=1)",
        "publishers /s/called",
        methods=CALLED,
    ),
    case("guard condition", "self.create_guard_condition(self.cb)", "publishers /s/called", methods=CALLED),
    case(
        "parameter callback",
        "self.add_on_set_parameters_callback(self.cb)",
        "publishers /s/called",
        methods=CALLED,
    ),
    case(
        "action server",
        "ActionServer(self, Fibonacci, 'a', self.x, goal_callback=self.cb)",
        "publishers /s/called",
        "action_servers /s/a",
        head="from rclpy.action import ActionServer",
        methods=f"{CALLED}\ndef x(self, goal):\n    pass",
    ),
    case(
        "action client and its futures",
        "c = ActionClient(self, Fibonacci, 'a')\nc.send_goal_async(Fibonacci.Goal(), self.cb)",
        "publishers /s/called",
        "action_clients /s/a",
        head="from rclpy.action.client import ActionClient",
        methods=CALLED,
    ),
    case(
        "future",
        "self.create_client(SetBool, 'a').call_async(SetBool.Request()).add_done_callback(self.cb)",
        "publishers /s/called",
        "clients /s/a",
        methods=CALLED,
    ),
    case(
        "loop",
        "for n in ('a', 'b'):\n    self.create_publisher(String, f'{n}/x', 1)",
        "publishers /s/a/x",
        "publishers /s/b/x",
    ),
    case(
        "name in a parameter",
        "self.declare_parameter('topic', 'a')\nself.create_publisher(String, self.get_parameter('topic').value, 1)",
        "publishers /s/a",
    ),
    case(
        "name in a parameter's message",
        "self.declare_parameter('topic', 'a')\n"
        "self.create_publisher(String, self.get_parameter('topic').get_parameter_value().string_value, 1)",
        "publishers /s/a",
    ),
    case(
        "what declaring gives",
        "self.create_publisher(String, self.declare_parameter('t', 'a').value, 1)",
        "publishers /s/a",
    ),
    case(
        "message filters",
        "a = message_filters.Subscriber(self, String, 'a')\nb = message_filters.Subscriber(self, String, 'b', qos_profile=1)\n"
        "s = message_filters.TimeSynchronizer([a, b], 10)\ns.registerCallback(self.cb)",
        "publishers /s/called",
        "subscribers /s/a",
        "subscribers /s/b",
        head="import message_filters",
        methods=CALLED,
    ),
    case(
        "transforms",
        "self.b = Buffer()\nself.l = TransformListener(self.b, self)\nself.t = TransformBroadcaster(self)\n"
        "self.s = StaticTransformBroadcaster(self)",
        "publishers /tf",
        "publishers /tf_static",
        "subscribers /tf",
        "subscribers /tf_static",
        head="from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener",
    ),
    case(
        "transforms by their modules",
        "self.b = Buffer(node=self)\nself.l = TransformListener(self.b, node=self)",
        "subscribers /tf",
        "subscribers /tf_static",
        "servers /s/tf2_frames",
        head="from tf2_ros.buffer import Buffer\nfrom tf2_ros.transform_listener import TransformListener",
    ),
    case(
        "diagnostics",
        "u = diagnostic_updater.Updater(self)\nu.add('x', self.cb)",
        "publishers /diagnostics",
        "publishers /s/called",
        head="import diagnostic_updater",
        methods=CALLED,
    ),
    case(
        "interactive markers",
        "InteractiveMarkerServer(self, 'm')",
        "publishers /s/m/update",
        "subscribers /s/m/feedback",
        "servers /s/m/get_interactive_markers",
        head="from interactive_markers import InteractiveMarkerServer",
    ),
    case(
        "parameters of another node",
        "AsyncParameterClient(self, 'other').get_parameters(['a'])",
        *(
            f"clients /s/other/{name}"
            for name in (
                "describe_parameters",
                "get_parameter_types",
                "get_parameters",
                "list_parameters",
                "set_parameters",
                "set_parameters_atomically",
            )
        ),
        head="from rclpy.parameter_client import AsyncParameterClient",
    ),
    case(
        "waiting for a message",
        "wait_for_message(String, self, 'a', time_to_wait=1)",
        "subscribers /s/a",
        head="from rclpy.wait_for_message import wait_for_message",
    ),
    case("own name", "self.create_publisher(String, self.get_name() + '_a', 1)", "publishers /s/n_a"),
    case("own namespace", "self.create_publisher(String, self.get_namespace() + '/x/a', 1)", "publishers /s/x/a"),
    case(
        "own full name", "self.create_publisher(String, self.get_fully_qualified_name() + '/a', 1)", "publishers /s/n/a"
    ),
    case("resolved name", "self.create_publisher(String, '/x' + self.resolve_topic_name('a'), 1)", "publishers /x/s/a"),
    case(
        "names of a publisher",
        "p = self.create_publisher(String, 'a', 1)\nself.create_publisher(String, '/x' + p.topic_name, 1)\n"
        "self.create_publisher(String, p.topic + '_b', 1)",
        "publishers /s/a",
        "publishers /s/a_b",
        "publishers /x/s/a",
    ),
)
QUIET = (
    case("no call", "pass"),
    case("only named", "self.f = self.create_publisher"),
    case("another object's method", "x.create_node(String, 'a', 1)"),
    case("a callback that is only named", "self.f = self.cb", methods=CALLED),
    case("a callback that is taken away", "self.remove_on_set_parameters_callback(self.cb)", methods=CALLED),
    case("logging", "self.get_logger().info('a')\nself.get_logger().warning(f'{self}')"),
    case("clock", "self.get_clock().now().to_msg()"),
    case("publish", "self.p = None\nself.p.publish(String())"),
    case("counting", "self.count_publishers('/a')\nself.get_topic_names_and_types()"),
    case("a timer without a callback", "self.create_rate(10)"),
    case(
        "a filter without a callback",
        "message_filters.Cache(message_filters.SimpleFilter(), 1)",
        head="import message_filters",
    ),
    case("a buffer without a node", "Buffer()\nBuffer(Duration(seconds=1))", head="from tf2_ros import Buffer"),
    case("executors and groups", "MutuallyExclusiveCallbackGroup()", head="from rclpy.callback_groups import *"),
    case("a bond that is not started", "bondpy.Bond", head="from bondpy import bondpy"),
    case("rospy", "rospy.Publisher('a', String)", head="import rospy"),
    case("a method of the same name", "self.make('a')", methods="def make(self, name):\n    return name"),
    case("not reached", "return\nself.create_publisher(String, 'a', 1)"),
    case("a goal that is sent by another object", "x.send_goal_async(Fibonacci.Goal())"),
    case("futures", "f = Future()\nf.set_result(1)\nf.done()", head="from rclpy.task import Future"),
    case("a profile alone", "self.q = QoSProfile(depth=1)\nself.d = Duration(seconds=1)"),
    case("a parameter alone", "self.p = Parameter('a', value=1)"),
    case("a list of topics", "for name, kinds in self.get_topic_names_and_types():\n    self.last = name"),
    case("destroyed", "self.destroy_node()\nself.destroy_timer(None)"),
    case("names that are only texts", "self.t = 'create_publisher(String, \\'a\\', 1)'"),
    case(
        "a class that is not constructed",
        "pass",
        head="class Other(Node):\n    def go(self):\n        self.create_client(SetBool, 'a')",
    ),
    case("a function that is not called", "pass", head="def help(node):\n    node.create_publisher(String, 'a', 1)"),
    case("a test of launch files", "launch_testing.actions.ReadyToTest()", head="import launch_testing.actions"),
    case(
        "point clouds",
        "point_cloud2.read_points(x())",
        head="from sensor_msgs_py import point_cloud2",
    ),
    case(
        "a transform that is asked for",
        "self.b = Buffer()\nself.b.lookup_transform('a', 'b', Time(), Duration(seconds=1))",
        head="from rclpy.time import Time\nfrom tf2_ros import Buffer",
    ),
    case("diagnostics that are not added", "FunctionDiagnosticTask('x', 1)", head="from diagnostic_updater import *"),
    case("an unknown name", "self.create_publisher(String, x(), 1)", "publishers /?"),
    case("an unknown part", "self.create_publisher(String, 'a/' + x(), 1)", "publishers /s/a/?"),
    case(
        "a parameter without a value",
        "self.create_publisher(String, self.get_parameter('t').value, 1)",
        "publishers /?",
    ),
    case(
        "a parameter of an unknown name",
        "self.create_publisher(String, self.declare_parameter(x(), 'a').value, 1)",
        "publishers /?",
    ),
    case(
        "a default that is not known",
        "self.create_publisher(String, self.declare_parameter('t', x()).value, 1)",
        "publishers /?",
    ),
    case("unpacked arguments", "self.create_publisher(*x())", "publishers /?"),
    case("unpacked keywords", "self.create_publisher(**x())", "publishers /?"),
)

NAMES = "the selectors of names stand for the process, not for the receiver's node"
TYPES = "a member of Parameter.Type is not taken for a type"
TUPLES = "the items of a list are no entries"
#: Why a program below is not read as it should be yet.
DEFECTS: dict[str, str] = {}


@rows(FIRES, DEFECTS)
def test_endpoints(head: str, body: str, methods: str, expected: list[str]) -> None:
    assert made(node(body, methods, head)) == expected


@rows(QUIET, DEFECTS)
def test_quiet(head: str, body: str, methods: str, expected: list[str]) -> None:
    found = node(body, methods, head)
    assert made(found) == expected
    assert all(("?" in end.name) == any(each.field == "name" for each in end.unknowns) for end in found.endpoints)


def test_types() -> None:
    found = node(
        "self.create_publisher(String, 'a', 1)\nself.create_client(SetBool, 'b')\nActionClient(self, Fibonacci, 'c')\n"
        "self.create_subscription(sensor_msgs.msg.Image, 'd', None, 1)",
        head="from rclpy.action import ActionClient\nimport sensor_msgs.msg",
    )
    assert {end.name: end.type for kind in KINDS.split() for end in explicit(found, kind)} == {
        "/s/a": "std_msgs/msg/String",
        "/s/b": "std_srvs/srv/SetBool",
        "/s/c": "example_interfaces/action/Fibonacci",
        "/s/d": "sensor_msgs/msg/Image",
    }


def test_a_type_that_is_not_known() -> None:
    (end,) = explicit(node("self.create_publisher(x(), 'a', 1)"))
    assert (end.type, [each.field for each in end.unknowns]) == (None, ["type"])


DEFAULT = {"history": "keep_last", "depth": 10, "reliability": "reliable", "durability": "volatile"}
ALL = dict.fromkeys(DEFAULT, "?")
PROFILES = (
    ("number", "3", {"depth": 3}),
    ("depth", "QoSProfile(depth=3)", {"depth": 3}),
    ("positions", "QoSProfile(HistoryPolicy.KEEP_LAST, 3)", {"depth": 3}),
    ("reliability", "QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)", {"reliability": "best_effort"}),
    (
        "older names",
        "QoSProfile(depth=10, reliability=QoSReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT)",
        {"reliability": "best_effort"},
    ),
    (
        "durability",
        "QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
        {"durability": "transient_local"},
    ),
    ("all", "QoSProfile(history=HistoryPolicy.KEEP_ALL)", {"history": "keep_all", "depth": None}),
    ("deadline", "QoSProfile(depth=10, deadline=Duration(seconds=1, nanoseconds=500000000))", {"deadline": 1.5}),
    ("lifespan", "QoSProfile(depth=10, lifespan=Duration(nanoseconds=2000000000))", {"lifespan": 2.0}),
    (
        "liveliness",
        "QoSProfile(depth=10, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC, liveliness_lease_duration=Duration(seconds=3))",
        {"liveliness": "manual_by_topic", "lease": 3.0},
    ),
    ("sensor data", "qos_profile_sensor_data", {"depth": 5, "reliability": "best_effort"}),
    ("preset", "QoSPresetProfiles.SENSOR_DATA.value", {"depth": 5, "reliability": "best_effort"}),
    (
        "preset by its key",
        "QoSPresetProfiles.get_from_short_key('sensor_data')",
        {"depth": 5, "reliability": "best_effort"},
    ),
    (
        "policy by its key",
        "QoSProfile(depth=10, reliability=ReliabilityPolicy.get_from_short_key('best_effort'))",
        {"reliability": "best_effort"},
    ),
    ("a parameter", "self.declare_parameter('d', 7).value", {"depth": 7}),
    ("unknown depth", "QoSProfile(depth=x())", {"depth": "?"}),
    ("unknown policy", "QoSProfile(depth=10, durability=x())", {"durability": "?"}),
    ("unknown profile", "x()", ALL),
    ("unknown number", "int(x())", ALL),
    ("unpacked", "QoSProfile(**x())", ALL),
    ("unknown key", "QoSPresetProfiles.get_from_short_key(x())", ALL),
)


@pytest.mark.parametrize(("profile", "expected"), [each[1:] for each in PROFILES], ids=[each[0] for each in PROFILES])
def test_quality_of_service(profile: str, expected: dict[str, Any]) -> None:
    found = node(f"self.create_publisher(String, 'a', {profile})")
    (qos,) = profiles(found)
    assert qos is not None
    wanted = {**DEFAULT, **expected}
    assert {policy: getattr(qos, policy) for policy in wanted} == wanted
    assert bool(unknown(found)) == ("?" in wanted.values())


def test_a_profile_that_is_changed() -> None:
    found = node(
        "q = QoSProfile(depth=1)\nq.durability = DurabilityPolicy.TRANSIENT_LOCAL\n"
        "q.liveliness_lease_duration = Duration(seconds=2)\nself.create_publisher(String, 'a', q)"
    )
    assert profiles(found) == [
        Qos(history="keep_last", depth=1, reliability="reliable", durability="transient_local", lease=2.0)
    ]


def test_profiles_of_libraries() -> None:
    found = node(
        "TransformListener(Buffer(), self)\nStaticTransformBroadcaster(self)\nmessage_filters.Subscriber(self, String, 'a')",
        head="import message_filters\nfrom tf2_ros import Buffer, StaticTransformBroadcaster, TransformListener",
    )
    ends = [*explicit(found), *explicit(found, "subscribers")]
    assert {(end.kind, end.name): (end.qos.depth, end.qos.durability) for end in ends if end.qos} == {
        ("publishers", "/tf_static"): (1, "transient_local"),
        ("subscribers", "/tf"): (100, "volatile"),
        ("subscribers", "/tf_static"): (100, "transient_local"),
        ("subscribers", "/s/a"): (10, "volatile"),
    }


PARAMETERS = (
    ("bool", "self.declare_parameter('a', True)", {"a": ("bool", True, True)}),
    ("int", "self.declare_parameter('a', 1)", {"a": ("int", 1, 1)}),
    ("double", "self.declare_parameter('a', value=1.0)", {"a": ("double", 1.0, 1.0)}),
    ("text", "self.declare_parameter(name='a', value='x')", {"a": ("str", "x", "x")}),
    ("list", "self.declare_parameter('a.b', [1, 2])", {"a.b": ("int[]", [1, 2], [1, 2])}),
    ("texts", "self.declare_parameter('a', ['x'])", {"a": ("str[]", ["x"], ["x"])}),
    ("type", "self.declare_parameter('a', Parameter.Type.STRING)", {"a": ("str", None, None)}),
    ("type of rclpy", "self.declare_parameter('a', rclpy.Parameter.Type.INTEGER_ARRAY)", {"a": ("int[]", None, None)}),
    (
        "set later",
        "self.declare_parameter('a', 1)\nself.set_parameters([Parameter('a', value=2)])",
        {"a": ("int", 1, 1)},
    ),
    (
        "tuples",
        "self.declare_parameters('', [('a', 1), ('b', Parameter.Type.DOUBLE), ('c', 'x', ParameterDescriptor())])",
        {"a": ("int", 1, 1), "b": ("double", None, None), "c": ("str", "x", "x")},
    ),
    (
        "tuples below a name",
        "self.declare_parameters(namespace='x', parameters=[('a', 1), ('b.c', 2.0)])",
        {"x.a": ("int", 1, 1), "x.b.c": ("double", 2.0, 2.0)},
    ),
    ("what is not known", "self.declare_parameter('a', x())", {"a": (None, None, None)}),
    ("the type is known", "self.declare_parameter('a', float(x()))", {"a": ("double", None, None)}),
    ("none", "self.get_parameter_or('a', Parameter('a', value=1))", {}),
    ("a getter alone", "self.get_parameter('a')", {}),
)
PARAMETER_DEFECTS: dict[str, str] = {}


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        pytest.param(
            *each[1:],
            id=each[0],
            marks=(pytest.mark.xfail(strict=True, reason=PARAMETER_DEFECTS[each[0]]),)
            if each[0] in PARAMETER_DEFECTS
            else (),
        )
        for each in PARAMETERS
    ],
)
def test_parameters(body: str, expected: dict[str, Any]) -> None:
    found = node(body, head="from rcl_interfaces.msg import ParameterDescriptor")
    assert declared(found) == expected
    is_known = all(kind is not None for kind, _, _ in expected.values())
    assert is_known == ("type" not in {field for _, field, _ in unknown(found)})


def test_descriptors() -> None:
    found = node(
        "d = ParameterDescriptor(read_only=True, floating_point_range=[FloatingPointRange(from_value=0.0, to_value=2.0)])\n"
        "self.declare_parameter('a', 0.5, d)\nself.declare_parameter('b', 1, ParameterDescriptor(description='x'))",
        head="from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor",
    )
    assert {end.name: (end.read_only, end.range) for end in explicit(found, "parameters")} == {
        "/s/n:a": (True, (0.0, 2.0, 0.0)),
        "/s/n:b": (False, None),
    }


def nodes(found: Configuration) -> list[tuple[str, str, list[str]]]:
    return [(each.name, each.kind, made(each)) for each in found.nodes]


def test_nodes_of_one_process() -> None:
    found = program(
        "a = rclpy.create_node('a')\nb = rclpy.create_node(namespace='/s', node_name='b')\n"
        "a.create_publisher(String, 'x', 1)\nhelp(b)",
        "def help(node: Node):\n    node.create_subscription(String, '~/y', lambda m: None, 1)\n",
    )
    assert nodes(found) == [("/a", "node", ["publishers /x"]), ("/s/b", "node", ["subscribers /s/b/y"])]


def test_a_managed_node() -> None:
    found = program(
        "rclpy.spin(M('m'))",
        "import rclpy.lifecycle\nclass M(rclpy.lifecycle.Node):\n"
        "    def on_configure(self, state):\n"
        "        self.p = self.create_lifecycle_publisher(String, 'a', 1)\n"
        "        return super().on_configure(state)\n"
        "    def on_other(self, state):\n"
        "        self.create_publisher(String, 'b', 1)\n",
    )
    assert nodes(found) == [("/m", "lifecycle", ["publishers /a"])]


def test_a_module_of_the_package() -> None:
    found = program(
        "rclpy.spin(Base('x'))",
        "from p.base import Base\n",
        base="import rclpy.node\nfrom std_msgs.msg import String\n"
        "class Base(rclpy.node.Node):\n"
        "    def __init__(self, name, **more):\n"
        "        rclpy.node.Node.__init__(self, name, **more)\n"
        "        self.create_publisher(String, 'a', 1)\n",
    )
    assert nodes(found) == [("/x", "node", ["publishers /a"])]


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("super().create_publisher(String, 'a', 1)", ["publishers /s/a"]),
        ("super(N, self).create_subscription(String, 'a', print, 1)", ["subscribers /s/a"]),
        ("Node.create_publisher(self, String, 'a', 1)", ["publishers /s/a"]),
        ("rclpy.node.Node.create_publisher(self, msg_type=String, topic='a', qos_profile=1)", ["publishers /s/a"]),
        ("super().create_timer(1.0, lambda: self.create_publisher(String, 'a', 1))", ["publishers /s/a"]),
        ("super().get_logger()", []),
        ("Node.get_name(self)", []),
        ("Other.create_publisher(self, String, 'a', 1)", []),
        ("create_publisher(self, String, 'a', 1)", []),
    ],
)
def test_methods_of_the_class_above(call: str, expected: list[str]) -> None:
    assert made(node(call, head="import rclpy.node\nfrom other import Other\n")) == expected


def test_methods_of_the_class_above_in_one_that_has_its_own() -> None:
    methods = "def create_publisher(self, kind, name, depth):\n    return super().create_publisher(kind, name + '_own', depth)\n"
    assert made(node("self.create_publisher(String, 'a', 1)", methods)) == ["publishers /s/a_own"]
    assert made(node("Node.create_publisher(self, String, 'a', 1)", methods)) == ["publishers /s/a"]


def test_a_node_whose_name_is_not_known() -> None:
    (found,) = program("n = rclpy.create_node(x())\nn.create_publisher(String, '~/a', 1)").nodes
    assert (found.name, [each.field for each in found.unknowns]) == ("/?", ["name"])
    assert made(found) == ["publishers /?/a"]


NAVIGATOR = "from nav2_simple_commander.robot_navigator import BasicNavigator\n"


CONSTRUCTED = "what a constructor makes does not belong to the node that it constructs, unless that is a subclass's"


def test_the_navigator_of_nav2() -> None:
    found = program("n = BasicNavigator(namespace='r')\nn.waitUntilNav2Active()", NAVIGATOR)
    (one,) = found.nodes
    assert one.name == "/r/basic_navigator"
    assert made(one, "publishers subscribers") == ["publishers /r/initialpose", "subscribers /r/amcl_pose"]
    certain = [end.name for end in explicit(one, "clients") if not end.unknowns]
    assert sorted(certain) == [
        "/r/amcl/get_state",
        "/r/bt_navigator/get_state",
        "/r/global_costmap/clear_entirely_global_costmap",
        "/r/global_costmap/get_costmap",
        "/r/local_costmap/clear_entirely_local_costmap",
        "/r/local_costmap/get_costmap",
        "/r/map_server/load_map",
    ]


def test_two_navigators() -> None:
    found = program("a = BasicNavigator('a')\nb = BasicNavigator('b', 'r')", NAVIGATOR)
    assert {each.name: made(each, "publishers") for each in found.nodes} == {
        "/a": ["publishers /initialpose"],
        "/r/b": ["publishers /r/initialpose"],
    }


def test_overrides_in_the_code() -> None:
    (found,) = program(
        "rclpy.spin(M())",
        "class M(Node):\n    def __init__(self):\n"
        "        super().__init__('m', parameter_overrides=[Parameter('a', value=2)])\n"
        "        self.declare_parameter('a', 1)\n",
    ).nodes
    assert declared(found) == {"a": ("int", 1, 2)}


def test_a_node_that_makes_nothing() -> None:
    found = program("rclpy.spin(M())", "class M(Node):\n    def __init__(self):\n        super().__init__('m')\n")
    assert nodes(found) == [("/m", "node", [])]


def test_nodes_that_make_nothing() -> None:
    assert nodes(program("a = rclpy.create_node('a')\nrclpy.spin(a)")) == [("/a", "node", [])]


def test_events_of_a_service_are_a_gap() -> None:
    found = node("self.create_service(SetBool, 'a', None).configure_introspection(self.get_clock(), 1, 2)")
    assert made(found) == ["servers /s/a"]
    assert [each.reason for each in found.unknowns] == ["the events of a service are published"]


def test_two_ways_to_one_endpoint() -> None:
    found = node(
        "if x():\n    q = QoSProfile(depth=1)\nelse:\n    q = qos_profile_sensor_data\nself.create_publisher(String, 'a', q)"
    )
    (qos,) = profiles(found)
    assert qos == Qos(history="keep_last", depth="?", reliability="?", durability="volatile")
    assert [field for _, field, _ in unknown(found)] == ["qos"]


def test_an_unknown_object_in_a_process_of_two_nodes() -> None:
    found = program("a = rclpy.create_node('a')\nb = rclpy.create_node('b')\nx().create_publisher(String, 'y', 1)")
    ends = [(end.name, [each.field for each in end.unknowns]) for each in found.nodes for end in explicit(each)]
    assert ends == [("/?/y", ["name"])]


def test_a_node_that_is_handed_on() -> None:
    found = program(
        "a = rclpy.create_node('a', namespace='s')\nHelper(a)\nb = rclpy.create_node('b')",
        "class Helper:\n    def __init__(self, owner):\n        self.owner = owner\n"
        "        self.p = owner.create_publisher(String, 'y', 1)\n        self.owner.create_timer(1.0, self.tick)\n"
        "    def tick(self):\n        self.owner.create_client(SetBool, '~/z')\n",
    )
    assert nodes(found) == [("/s/a", "node", ["publishers /s/y", "clients /s/a/z"]), ("/b", "node", [])]


@pytest.mark.parametrize(
    ("setup", "shebang", "programs"),
    (
        (SETUP, "", ["p/n"]),
        (SETUP, "#!/usr/bin/env python3\n", ["p/n"]),
        (SETUP.replace("entry", "scripts=['p/n.py'], entry"), "#!/usr/bin/env python3\n", ["p/n", "p/n.py"]),
        (SETUP.replace("n = p.n", "n.py = p.n"), "#!/usr/bin/env python3\n", ["p/n.py"]),
        (SETUP.replace("n = p.n", "n = p.other"), "#!/usr/bin/env python3\n", ["p/n.py"]),
    ),
)
def test_module_of_a_console_script_is_no_program(setup: str, shebang: str, programs: list[str]) -> None:
    text = f"{shebang}{HEAD}{CLASS}{MAIN}    rclpy.spin(N())\n\nif __name__ == '__main__':\n    main()\n"
    found = follow(files(text) | {"p/setup.py": setup}, 2)
    assert [configuration.name for configuration in found.configurations] == programs


@pytest.mark.parametrize(
    ("head", "kind", "expected"),
    (
        ("from tf2_geometry_msgs import PointStamped", "PointStamped", "geometry_msgs/msg/PointStamped"),
        ("from tf2_sensor_msgs import PointCloud2", "PointCloud2", "sensor_msgs/msg/PointCloud2"),
        ("from tf2_geometry_msgs import Other", "Other", None),
        ("from some_msgs import PointStamped", "PointStamped", None),
    ),
)
def test_messages_that_a_library_passes_on(head: str, kind: str, expected: str | None) -> None:
    (end,) = explicit(node(f'self.create_subscription({kind}, "a", print, 1)', head=head), "subscribers")
    assert end.type == expected


COUNTED = "i = 0\nwhile True:\n    try:\n        s = self.get_parameter('s%d' % i).value\n    except Exception:\n        break\n    i += 1\n"


def test_a_loop_ends_where_a_parameter_is_not_declared() -> None:
    found = node(f"self.declare_parameter('s0', 'a')\n{COUNTED}    self.create_publisher(String, s, 1)")
    assert [end.name for end in explicit(found, "getters")] == ["/s/n:s0", "/s/n:s1"]
    assert made(found, "publishers") == ["publishers /s/a"]


def test_a_node_that_may_read_what_it_does_not_declare() -> None:
    body = f"super().__init__('n', namespace='s', allow_undeclared_parameters=True)\n{COUNTED}"
    found = program(
        "rclpy.spin(N())",
        "class N(Node):\n    def __init__(self):\n" + "".join(f"        {line}\n" for line in body.splitlines()),
    )
    assert [end.name for end in explicit(found.nodes[0], "getters")] == ["/s/n:s?"]


@pytest.mark.parametrize(
    ("head", "body", "expected"),
    [
        ("from a_msgs.action import *\nfrom a_msgs.msg import *\n", "ActionClient(self, Move, 'a')", "a_msgs/action/Move"),
        ("from a_msgs.srv import *\nfrom std_msgs.msg import *\n", "self.create_client(Switch, 'a')", "a_msgs/srv/Switch"),
        ("from a_msgs.srv import *\nfrom b_msgs.msg import *\n", "self.create_publisher(Thing, 'a', 1)", "b_msgs/msg/Thing"),
        ("from gazebo_msgs.srv import *\n", "self.create_client(SpawnEntity, 'a')", "gazebo_msgs/srv/SpawnEntity"),
        # Of two, or of none.
        ("from a_msgs.action import *\nfrom b_msgs.action import *\n", "ActionClient(self, Move, 'a')", None),
        ("from a_msgs.srv import *\nfrom b_msgs.srv import *\n", "self.create_client(Switch, 'a')", None),
        ("from a_msgs.msg import *\nfrom b_msgs.msg import *\n", "self.create_publisher(Thing, 'a', 1)", None),
        ("from elsewhere import *\n", "self.create_publisher(Thing, 'a', 1)", None),
    ],
)  # fmt: skip
def test_types_of_modules_with_all_their_names(head: str, body: str, expected: str | None) -> None:
    made = node(body, head=f"from rclpy.action import ActionClient\n{head}")
    assert [end.type for end in made.endpoints if end.name == "/s/a"] == [expected]
