# SPDX-License-Identifier: Apache-2.0
"""What a change does to nodes, topics, services, parameters and QoS: what is told, and what is not."""

from __future__ import annotations

from pathlib import Path

import pytest
from revisions_of import Files, changes, launch, python_node, said

PUB = 'pub = node.create_publisher(String, "chatter", 10)'
RATE = 'node.declare_parameter("rate", 10.0)'
TALKER = 'pkg="demo" exec="talker.py" name="talker"'
YAML = "talker:\n  ros__parameters:\n    rate: 5.0\n"
WITH_YAML = (
    '<launch>\n  <node pkg="demo" exec="talker.py" name="talker">\n'
    '    <param from="$(find-pkg-share demo)/config/talker.yaml"/>\n  </node>\n</launch>\n'
)
REMAPPED = '<launch>\n  <node pkg="demo" exec="talker.py" name="talker">\n    <remap from="{}" to="{}"/>\n  </node>\n</launch>\n'


def talker(*lines: str) -> Files:
    return {"talker.py": python_node("talker", *lines)}


TOLD: dict[str, tuple[Files, Files, list[str]]] = {
    "publisher added": (talker(), talker(PUB), ["publisher added /chatter: None -> std_msgs/msg/String"]),
    "publisher removed": (talker(PUB), talker(), ["publisher removed /chatter: std_msgs/msg/String -> None"]),
    "publisher renamed": (
        talker(PUB),
        talker(PUB.replace("chatter", "chat")),
        ["publisher renamed name /chat: /chatter -> /chat"],
    ),
    "publisher retyped": (
        talker(PUB),
        talker(PUB.replace("String", "Bool")),
        ["publisher changed type /chatter: std_msgs/msg/String -> std_msgs/msg/Bool"],
    ),
    "service": (
        talker('srv = node.create_service(Empty, "reset", print)'),
        talker('srv = node.create_service(SetBool, "reset", print)'),
        ["service server changed type /reset: std_srvs/srv/Empty -> std_srvs/srv/SetBool"],
    ),
    "default": (
        talker(RATE),
        talker(RATE.replace("10.0", "20.0")),
        ["parameter changed default /talker:rate: 10.0 -> 20.0"],
    ),
    "type": (
        talker(RATE),
        talker(RATE.replace("10.0", "10")),
        ["parameter changed default /talker:rate: 10.0 -> 10", "parameter changed type /talker:rate: double -> int"],
    ),
    "parameter renamed": (
        talker(RATE),
        talker(RATE.replace("rate", "rate_hz")),
        ["parameter renamed name /talker:rate_hz: /talker:rate -> /talker:rate_hz"],
    ),
    "another parameter": (
        talker(RATE),
        talker(RATE.replace('rate", 10.0', 'frame", "map"')),
        ['parameter added /talker:frame: None -> str = "map"', "parameter removed /talker:rate: double = 10.0 -> None"],
    ),
    "depth": (
        talker(PUB),
        talker(PUB.replace("10", "1")),
        ["QoS changed publisher /chatter: depth 10 -> depth 1"],
    ),
    "reliability": (
        talker(PUB.replace("10", "5")),
        talker(PUB.replace("10", "qos_profile_sensor_data")),
        ["QoS changed publisher /chatter: reliability reliable -> reliability best_effort"],
    ),
    "node renamed by its launch file": (
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER)},
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER.replace('"talker"', '"speaker"'))},
        ["node renamed name /speaker: /talker -> /speaker"],
    ),
    "node added": (
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER)},
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER, TALKER.replace('"talker"', '"second"'))},
        ["node added /second: None -> demo/talker.py"],
    ),
    "program added": (
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER)},
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER), "listener.py": python_node("listener")
         + 'sub = node.create_subscription(String, "chatter", print, 10)\n'},
        ["node added program demo/listener.py: None -> node /listener: 1 subscriber"],
    ),
    "launch file added": (
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER)},
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER), "launch/b.launch.xml": launch(TALKER, TALKER)},
        ["launch file added demo/launch/b.launch.xml: None -> starts 2 nodes"],
    ),
    "remapped": (
        {**talker(PUB), "launch/a.launch.xml": launch(TALKER)},
        {**talker(PUB), "launch/a.launch.xml": REMAPPED.format("chatter", "chat")},
        ["remapping added chatter: None -> chat"],
    ),
    "remapped elsewhere": (
        {**talker(PUB), "launch/a.launch.xml": REMAPPED.format("chatter", "chat")},
        {**talker(PUB), "launch/a.launch.xml": REMAPPED.format("chatter", "talk")},
        ["remapping changed target chatter: chat -> talk"],
    ),
    "value in YAML": (
        {**talker(RATE), "launch/a.launch.xml": WITH_YAML, "config/talker.yaml": YAML},
        {**talker(RATE), "launch/a.launch.xml": WITH_YAML, "config/talker.yaml": YAML.replace("5.0", "6.0")},
        ["value changed given talker:rate: 5.0 -> 6.0"],
    ),
    "value in YAML that nobody reads": (
        {**talker(RATE), "config/other.yaml": YAML},
        {**talker(RATE), "config/other.yaml": YAML + "    more: [1, 2]\n"},
        ["value added talker:more: None -> [1, 2]"],
    ),
    "value in a launch file": (
        {**talker(RATE), "launch/a.launch.xml": "<launch><node pkg='demo' exec='talker.py' name='talker'>"
         "<param name='rate' value='1.0'/></node></launch>"},
        {**talker(RATE), "launch/a.launch.xml": "<launch><node pkg='demo' exec='talker.py' name='talker'>"
         "<param name='rate' value='2.0'/></node></launch>"},
        ["value changed given /talker:rate: 1.0 -> 2.0"],
    ),
    "launch argument": (
        {**talker(), "launch/a.launch.xml": "<launch><arg name='sim' default='true'/></launch>"},
        {**talker(), "launch/a.launch.xml": "<launch><arg name='sim' default='false'/></launch>"},
        ["launch argument changed default sim: true -> false"],
    ),
    "ROS 1": (
        {"a.py": "import rospy\nfrom std_msgs.msg import String\nrospy.init_node('a')\n"
         "pub = rospy.Publisher('out', String, queue_size=1)\nx = rospy.get_param('~gain', 1.0)\n"},
        {"a.py": "import rospy\nfrom std_msgs.msg import String\nrospy.init_node('a')\n"
         "pub = rospy.Publisher('out', String, queue_size=5, latch=True)\nx = rospy.get_param('~gain', 2.0)\n"},
        ["QoS changed publisher /out: queue 1, not latched -> queue 5, latched", "parameter changed default /a/gain: 1.0 -> 2.0"],
    ),
    "a message": (
        {**talker(), "msg/Pose.msg": "float64 x\n"},
        {**talker(), "msg/Pose.msg": "float64 x\nfloat64 y\n"},
        ["interface changed field y added (float64) demo/msg/Pose: None -> float64"],
    ),
    "code that no node runs": (
        {**talker(), "plugin.hpp": 'struct P { void init(N n, S s) { n->declare_parameter(s + ".gain", 1.0); } };\n'},
        {**talker(), "plugin.hpp": 'struct P { void init(N n, S s) { n->declare_parameter(s + ".gain", 2.0); } };\n'},
        ["parameter changed default ?.gain: 1.0 -> 2.0"],
    ),
}  # fmt: skip

PLUGIN = 'struct {0} {{ void init(N n, S s) {{ n->declare_parameter(s + "{1}", 1.0); }} }};\n'
TOLD |= {
    "renamed in code that no node runs": (
        {**talker(), "p.hpp": PLUGIN.format("P", ".max_speed")},
        {**talker(), "p.hpp": PLUGIN.format("P", ".max_speed_x")},
        ["parameter renamed name ?.max_speed_x: ?.max_speed -> ?.max_speed_x"],
    ),
    "new in code that no node runs": (
        {**talker(), "p.hpp": PLUGIN.format("P", ".max_speed")},
        {**talker(), "p.hpp": PLUGIN.format("P", ".max_speed") + PLUGIN.format("Q", ".gain")},
        ["parameter added ?.gain: None -> default 1.0"],
    ),
}

QUIET: dict[str, tuple[Files, Files]] = {
    "the same": (talker(PUB, RATE), talker(PUB, RATE)),
    "lines have moved": (talker(PUB, RATE), talker("", "", PUB, "x = 1", RATE)),
    "a comment": (talker(PUB), talker("# says what it has to say", PUB)),
    "the order": (talker(PUB, RATE), talker(RATE, PUB)),
    "another way to write it": (talker(PUB), talker('name = "chatter"', PUB.replace('"chatter"', "name"))),
    "the name is not known now": (talker(PUB), talker("import sys", PUB.replace('"chatter"', "sys.argv[1]"))),
    "the name was not known": (talker("import sys", PUB.replace('"chatter"', "sys.argv[1]")), talker(PUB)),
    "the default is not known now": (talker(RATE), talker("import os", RATE.replace("10.0", "os.getpid()"))),
    "the type is not known now": (talker(PUB), talker("from x import T", PUB.replace("String", "T()"))),
    "a second publisher of the topic": (talker(PUB), talker(PUB, PUB.replace("pub", "again"))),
    "a quality of service that is not known": (talker(PUB), talker("from x import q", PUB.replace("10", "q()"))),
    "a test": (
        {**talker(), "test/test_it.hpp": "struct T {};\n"},
        {**talker(), "test/test_it.hpp": 'struct T { void run(N n) { n->declare_parameter("gain", 1.0); } };\n'},
    ),
    "YAML that is no parameter file": (
        {**talker(), "config/a.yaml": "a: 1\n"},
        {**talker(), "config/a.yaml": "a: 2\n"},
    ),
    "YAML in another order": (
        {**talker(RATE), "config/a.yaml": "t:\n  ros__parameters:\n    a: 1\n    b: 2\n"},
        {**talker(RATE), "config/a.yaml": "t:\n  ros__parameters:\n    b: 2\n    a: 1\n"},
    ),
    "an alone program is launched now": (
        talker(PUB, RATE),
        {**talker(PUB, RATE), "launch/empty.launch.xml": "<launch/>"},
    ),
    "moved to another file": (
        {**talker(), "p.hpp": PLUGIN.format("P", ".gain"), "q.hpp": "struct R {};\n"},
        {**talker(), "p.hpp": "struct R {};\n", "q.hpp": PLUGIN.format("P", ".gain")},
    ),
    "the name in code that no node runs is not known now": (
        {**talker(), "p.hpp": PLUGIN.format("P", ".gain")},
        {**talker(), "p.hpp": PLUGIN.format("P", ".gain").replace('s + ".gain"', "s")},
    ),
    "a comment of a message": (
        {**talker(), "msg/Pose.msg": "float64 x\n"},
        {**talker(), "msg/Pose.msg": "float64 x  # in metres\n"},
    ),
}


@pytest.mark.parametrize("name", TOLD)
def test_told(name: str, tmp_path: Path) -> None:
    base, head, expected = TOLD[name]
    assert said(changes(tmp_path, base, head)) == expected


@pytest.mark.parametrize("name", QUIET)
def test_quiet(name: str, tmp_path: Path) -> None:
    base, head = QUIET[name]
    found = [text for text in said(changes(tmp_path, base, head)) if not text.startswith("launch file added")]
    assert found == []


def test_a_change_in_many_configurations_is_told_once(tmp_path: Path) -> None:
    files = {f"launch/{number}.launch.xml": launch(TALKER.replace('"talker"', f'"t{number}"')) for number in range(4)}
    found = changes(tmp_path, {**talker(RATE), **files}, {**talker(RATE.replace("10.0", "20.0")), **files})
    (change,) = found.changes
    assert change.names == ("/t0:rate", "/t1:rate", "/t2:rate", "/t3:rate")
    assert len(change.configurations) == 4


def test_users_of_an_interface_are_named(tmp_path: Path) -> None:
    files = {
        "talker.py": python_node("talker", "from demo.msg import Pose", PUB.replace("String", "Pose")),
        "msg/Path.msg": "Pose[] poses\n",
    }
    found = changes(tmp_path, {**files, "msg/Pose.msg": "float64 x\n"}, {**files, "msg/Pose.msg": "float32 x\n"})
    assert [(change.aspect, change.users) for change in found.changes] == [
        ("field x: float64 → float32", ("/talker", "demo/Path (msg)"))
    ]


def test_the_same_change_of_several_interfaces_is_told_once(tmp_path: Path) -> None:
    base = {**talker(), "msg/A.msg": "float64 x\n", "msg/B.msg": "float64 x\n", "msg/C.msg": "float64 x\n"}
    head = {
        **base,
        "msg/A.msg": "float64 x\nint8 n\n",
        "msg/B.msg": "float64 x\nint8 n\n",
        "msg/C.msg": "float64 x\nint16 n\n",
    }
    first, second = changes(tmp_path, base, head).changes
    assert (first.names, second.names) == (("demo/msg/A", "demo/msg/B"), ("demo/msg/C",))
    assert len(first.details) == 4 and first.details[0].startswith("demo/msg/A: wire hash RIHS01_")


def test_a_file_that_has_moved_is_no_change(tmp_path: Path) -> None:
    yaml = {"config/a.yaml": "talker:\n  ros__parameters:\n    rate: 1.0\n"}
    moved = {"params/a.yaml": yaml["config/a.yaml"]}
    renames = {"config/a.yaml": "params/a.yaml"}
    assert said(changes(tmp_path, {**talker(RATE), **yaml}, {**talker(RATE), **moved}, renames)) == []
    assert said(changes(tmp_path / "again", {**talker(RATE), **yaml}, {**talker(RATE), **moved}))


def test_who_listens_is_named_and_drawn(tmp_path: Path) -> None:
    listener = {"listener.py": python_node("listener", 'sub = node.create_subscription(String, "chatter", print, 10)')}
    both = {"launch/a.launch.xml": launch(TALKER, 'pkg="demo" exec="listener.py" name="listener"')}
    found = changes(
        tmp_path, {**talker(PUB), **listener, **both}, {**talker(PUB.replace("chatter", "chat")), **listener, **both}
    )
    (change,) = found.changes
    assert change.users == ("/listener",)
    assert [(edge.node, edge.channel, edge.state) for edge in found.edges] == [
        ("/listener", "/chatter", ""),
        ("/talker", "/chat", "added"),
        ("/talker", "/chatter", "removed"),
    ]


LISTENER = {"listener.py": python_node("listener", 'sub = node.create_subscription(String, "chatter", print, 10)')}
ALONE = {"launch/a.launch.xml": launch(TALKER)}
BOTH = {"launch/a.launch.xml": launch(TALKER, 'pkg="demo" exec="listener.py" name="listener"')}


@pytest.mark.parametrize(("base", "head", "state"), [(BOTH, ALONE, "removed"), (ALONE, BOTH, "added")])
def test_a_node_that_comes_or_goes_is_drawn_with_who_is_left(
    tmp_path: Path, base: Files, head: Files, state: str
) -> None:
    found = changes(tmp_path, {**talker(PUB), **LISTENER, **base}, {**talker(PUB), **LISTENER, **head})
    assert [(edge.node, edge.channel, edge.state) for edge in found.edges] == [
        ("/listener", "/chatter", state),
        ("/talker", "/chatter", ""),
    ]


def test_nothing_is_drawn_where_nothing_comes_or_goes(tmp_path: Path) -> None:
    files = {**talker(PUB, RATE), **LISTENER, **BOTH}
    other = {**talker(PUB, RATE.replace("10.0", "20.0")), **LISTENER, **BOTH}
    assert changes(tmp_path / "same", files, files).edges == ()
    assert changes(tmp_path / "parameter", files, other).edges == ()
