# SPDX-License-Identifier: Apache-2.0
"""Options of Python programs that argparse reads from the words of a launch file."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, names, node, python

HEAD = """import argparse, sys
p = argparse.ArgumentParser(description="d")
p.add_argument("-t", "--topic", default="a", help="where")
p.add_argument("--count", type=int, default=2)
p.add_argument("--loud", action="store_true")
p.add_argument("--only", nargs="*", default=[])
p.add_argument("station", nargs="?", default="home")
o = p.parse_args(rospy.myargv()[1:])
"""
ALL = "PUB(o.topic + str(o.count) + ('/loud' if o.loud else '/quiet') + '/' + o.station)\n"

READ = (
    ("", ALL, "/a2/quiet/home"),
    ("dock", ALL, "/a2/quiet/dock"),
    ("-t b --count 3", ALL, "/b3/quiet/home"),
    ("--topic=b --loud", ALL, "/b2/loud/home"),
    ("--top b", ALL, "/b2/quiet/home"),
    ("chatter:=x", ALL, "/a2/quiet/home"),
    ("--only x y", "for s in o.only:\n    PUB(s)\n", "/x /y"),
    ("", "for s in o.only:\n    PUB(s)\nPUB('z')\n", "/z"),
)


@pytest.mark.parametrize(("words", "body", "expected"), READ)
def test_options_of_a_launch_file(words: str, body: str, expected: str) -> None:
    launch = f'<launch><node pkg="p" type="n.py" name="n" args="{words}"/></launch>'
    assert names(python(HEAD + body, launch)) == expected.split()


def test_a_group_and_words_left_over() -> None:
    body = (
        "import argparse\np = argparse.ArgumentParser()\ng = p.add_argument_group('x')\n"
        "g.add_argument('--name', default='a')\no, rest = p.parse_known_args(rospy.myargv()[1:])\nPUB(o.name)\nPUB(rest[0])\n"
    )
    launch = '<launch><node pkg="p" type="n.py" name="n" args="--name b more"/></launch>'
    assert names(python(body, launch)) == ["/b", "/more"]


#: Another beginning, and the words.
UNKNOWN = (
    (HEAD.replace("rospy.myargv()[1:]", ""), "", "with the words that roslaunch adds the program ends"),
    (HEAD, "--nothing", "no such option"),
    (HEAD, "--count many", "no number"),
    (HEAD.replace('description="d"', 'prefix_chars="+"'), "", "other rules"),
    (HEAD.replace('description="d"', 'fromfile_prefix_chars="@"'), "@file", "words of a file"),
    (HEAD.replace("type=int", "type=lambda text: 7"), "", "a type of its own"),
    (HEAD.replace("o = ", "p.set_defaults(topic=open('x').read())\no = "), "", "other defaults"),
    (HEAD.replace('default="a"', 'default=open("x").read()'), "", "a default that is not known"),
    (HEAD.replace('action="store_true"', "action=Other"), "", "an action of its own"),
)


MANY = "import argparse\np = argparse.ArgumentParser()\n"
PLUS = "".join(f'p.add_argument("x{number}", nargs="+")\n' for number in range(60))
MAYBE = "".join(f'p.add_argument("x{number}", nargs="?")\n' for number in range(60))
#: Parsers over which argparse itself would not come to an end, or out of memory.
ENDLESS = (
    ('p.add_argument("x", nargs=10**9)\n', "a b"),
    ('p.add_argument("--x", nargs=10**9)\n', "--x a b"),
    ('p.add_argument("x", nargs=-(10**9))\n', "a b"),
    (PLUS, " ".join("a" * 59)),
    (MAYBE + 'p.add_argument("y", nargs=40)\n', " ".join("a" * 39)),
    ('for i in range(500):\n    p.add_argument("--x%d" % i)\n', ""),
    ('p.add_argument("x", nargs="*")\n', " ".join("a" * 500)),
)


@pytest.mark.parametrize(("options", "words"), ENDLESS)
def test_what_argparse_cannot_bear_is_not_asked(options: str, words: str) -> None:
    launch = f'<launch><node pkg="p" type="n.py" name="n" args="{words}"/></launch>'
    body = MANY + options + 'p.add_argument("--name", default="a")\no = p.parse_args(rospy.myargv()[1:])\nPUB(o.name)\n'
    assert names(python(body, launch)) == ["/?"]


@pytest.mark.parametrize(("head", "words", "why"), UNKNOWN)
def test_options_that_are_not_known(head: str, words: str, why: str) -> None:
    launch = f'<launch><node pkg="p" type="n.py" name="n" args="{words}"/></launch>'
    assert [name for name in names(python(head + "PUB('base')\nPUB(o.topic)\n", launch)) if name != "/base"] == ["/?"]


def test_a_program_alone_is_started_without_words() -> None:
    assert names(python(HEAD + "PUB(o.topic)\n")) == ["/a"]


PARTLY = HEAD.replace("o = p.parse_args(rospy.myargv()[1:])", "o, rest = p.parse_known_args()").replace(
    'p.add_argument("station", nargs="?", default="home")\n', ""
)


@pytest.mark.parametrize(("words", "expected"), [("", ["/a"]), ("-t b", ["/b"]), ("--topic=b left", ["/b"])])
def test_words_that_roslaunch_adds_are_left_over(words: str, expected: list[str]) -> None:
    launch = f'<launch><node pkg="p" type="n.py" name="n" args="{words}"/></launch>'
    assert names(python(PARTLY + "PUB(o.topic)\n", launch)) == expected


#: Another option, the words, what is read, and the name that is published.
TAKEN = (
    ('p.add_argument("where", nargs="?")\n', "", "o.where", "/?"),
    ('p.add_argument("where", nargs="?")\n', "", "o.topic", "/a"),
    ('p.add_argument("where", nargs="*")\n', "a", "o.where[0]", "/?"),
    ('p.add_argument("where", nargs="*")\n', "a", "o.topic", "/a"),
    ('p.add_argument("--only2", nargs="*")\n', "--only2 a", "o.only2[0]", "/?"),
    ('p.add_argument("--only2", nargs="*")\n', "--only2 a", "o.topic", "/a"),
    ('p.add_argument("needed")\n', "", "o.topic", "/?"),
    ('p.add_argument("needed")\np.add_argument("more")\n', "", "o.needed", "/?"),
    ("p.allow_abbrev = other()\n", "$(env HOME_OF)", "o.topic", "/?"),
)


@pytest.mark.parametrize(("before", "words", "read", "expected"), TAKEN)
def test_words_that_roslaunch_adds_may_be_an_option(before: str, words: str, read: str, expected: str) -> None:
    launch = f'<launch><node pkg="p" type="n.py" name="n" args="{words}"/></launch>'
    text = PARTLY.replace("o, rest", before + "o, rest") + f"PUB({read})\n"
    assert names(python(text, launch)) == [expected]


@pytest.mark.parametrize(
    "words",
    ["", "None", "args=None", "argv", "args=argv", "sys.argv[1:]", "rospy.myargv()[1:]", "argv or sys.argv[1:]"],
)
def test_a_program_that_nothing_starts_has_no_words(words: str) -> None:
    body = PARTLY.replace("parse_known_args()", f"parse_known_args({words})").replace("o, rest", "argv = None\no, rest")
    assert names(python(body + "PUB(o.topic)\n")) == ["/a"]
    assert names(python(body.replace("parse_known_args", "parse_args").replace("o, rest", "o") + "PUB(o.topic)\n")) == [
        "/a"
    ]


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ('"file"', ""),
        ('"--needed", required=True', ""),
        ('"--needed", required=True', "argv"),
        ('"--only", action=Own', ""),
        ('"--more"', "other()"),
        ('"--more"', "['-t', other()]"),
        ('"--more"', "None, other()"),
        ('"--more"', "namespace=other()"),
    ],
)
def test_options_of_a_program_that_nothing_starts_and_that_are_not_known(option: str, words: str) -> None:
    body = PARTLY.replace("parse_known_args()", f"parse_known_args({words})").replace(
        "o, rest", f"p.add_argument({option})\nargv = None\no, rest"
    )
    assert set(names(python(body + "PUB(o.topic)\n"))) <= {"/?"}


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        ("o.topic = 'set'\n", ["/set"]),
        ("if mode is not None:\n    o.topic = mode\n", ["/given"]),
        ("if mode is None:\n    o.topic = mode\n", ["/?"]),
        ("o.other = 'set'\n", ["/?"]),
        ("if unknown():\n    o.topic = 'set'\n", ["/?"]),
        ("o.topic = 'set'\no.topic = other()\n", ["/?"]),
        ("", ["/?"]),
    ],
)
def test_what_the_program_sets_itself_of_options_that_are_not_known(before: str, expected: list[str]) -> None:
    launch = '<launch><node pkg="p" type="n.py" name="n" args="$(env WORDS)"/></launch>'
    found = names(python(HEAD + f"mode = 'given'\n{before}PUB(o.topic)\n", launch))
    assert sorted(found) == expected


@pytest.mark.parametrize("words", ["", "argv", "sys.argv[1:]"])
@pytest.mark.parametrize(
    "option", ['"--more", nargs="*", default=[]', '"--more", nargs=4', '"--more", action="append"']
)
def test_lists_that_nothing_fills_are_what_somebody_gives(option: str, words: str) -> None:
    body = PARTLY.replace(
        "o, rest = p.parse_known_args()", f"p.add_argument({option})\nargv = None\no = p.parse_args({words})"
    )
    assert names(python(body + "for m in o.more:\n    PUB(m)\nPUB(o.topic)\n")) == ["/?", "/a"]


def test_a_list_with_a_default_has_it() -> None:
    body = PARTLY.replace(
        "o, rest = p.parse_known_args()", "p.add_argument('--more', nargs='*', default=['b'])\no = p.parse_args()"
    )
    assert names(python(body + "for m in o.more:\n    PUB(m)\n")) == ["/b"]


@pytest.mark.parametrize(
    ("required", "expected"), [("required=True", ["/?"]), ("required=False", ["/a"]), ("", ["/a"])]
)
def test_a_group_without_which_the_program_ends(required: str, expected: list[str]) -> None:
    group = f"g = p.add_mutually_exclusive_group({required})\ng.add_argument('--left')\ng.add_argument('--right')\no = p.parse_args()"
    assert names(python(PARTLY.replace("o, rest = p.parse_known_args()", group) + "PUB(o.topic)\n")) == expected


SETUP = (
    "from setuptools import setup\nsetup(name='p', packages=['p'], data_files=[('share/p/launch', ['launch/l.launch.py'])], "
    "entry_points={'console_scripts': ['n = p.n:main']})\n"
)
MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>"
LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([Node(package='p', executable='n', arguments=ARGS)])\n"
)
PROGRAM = """import argparse, sys
import rclpy
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from std_msgs.msg import String
class Drone(Node):
    def __init__(self, o):
        super().__init__(f"drone{o.index}")
        self.pub = self.create_publisher(String, f"/{o.where}{o.index}/{'loud' if o.loud else 'quiet'}", 10)
def main(args=None):
    p = argparse.ArgumentParser()
    p.add_argument("-i", "--index", default="1", type=int, help="which")
    p.add_argument("--near", default=[], nargs="+", type=int)
    p.add_argument("--loud", default=False, action="store_true")
    p.add_argument("--where", default="air")
    DECLARED
    o = READ
    rclpy.init(args=args)
    rclpy.spin(Drone(o))
"""
#: What launch adds is an option of the program.
ROS_ARGS = 'p.add_argument("--ros-args", default=False, action="store_true")'


def _ros2(declared: str, read: str, words: str) -> tuple[str, list[str]]:
    files = {
        "p/setup.py": SETUP,
        "p/package.xml": MANIFEST,
        "p/p/__init__.py": "",
        "p/p/n.py": PROGRAM.replace("DECLARED", declared or "pass").replace("READ", read),
        "p/launch/l.launch.py": LAUNCH.replace("ARGS", words),
    }
    found = node(follow(files, 2))
    return found.name, [end.name for end in explicit(found)]


KNOWN_BY_LAUNCH = (
    (ROS_ARGS, "p.parse_args()", "['-i', '3']", "/drone3", "/air3/quiet"),
    (ROS_ARGS, "p.parse_args()", "['-i', '3', '--near', '1', '2', '--loud']", "/drone3", "/air3/loud"),
    (ROS_ARGS, "p.parse_args()", "[]", "/drone1", "/air1/quiet"),
    (ROS_ARGS, "p.parse_args(args)", "['-i', str(4)]", "/drone4", "/air4/quiet"),
    (ROS_ARGS, "p.parse_args(args=None)", "['-i3', '--where=sea']", "/drone3", "/sea3/quiet"),
    (ROS_ARGS, "p.parse_args(sys.argv[1:])", "['-i', '3']", "/drone3", "/air3/quiet"),
    ('p.add_argument("--ros-args", nargs=argparse.REMAINDER)', "p.parse_args()", "[]", "/drone1", "/air1/quiet"),
    ("", "p.parse_known_args()[0]", "['-i', '3']", "/drone3", "/air3/quiet"),
    ("", "p.parse_known_args(args)[0]", "['-i', '3']", "/drone3", "/air3/quiet"),
    ("", "p.parse_known_args(sys.argv[1:])[0]", "['-i', '3']", "/drone3", "/air3/quiet"),
    ("", "p.parse_args(remove_ros_args()[1:])", "['-i', '3']", "/drone3", "/air3/quiet"),
    ("", "p.parse_args(remove_ros_args(args=args)[1:])", "['-i', '3']", "/drone3", "/air3/quiet"),
    ("", "p.parse_args(remove_ros_args(sys.argv)[1:])", "['-i', '3', '--loud']", "/drone3", "/air3/loud"),
)


@pytest.mark.parametrize(("declared", "read", "words", "name", "topic"), KNOWN_BY_LAUNCH)
def test_options_of_a_launch_file_of_ros2(declared: str, read: str, words: str, name: str, topic: str) -> None:
    assert _ros2(declared, read, words) == (name, [topic])


NOT_KNOWN_BY_LAUNCH = (
    ("", "p.parse_args()", "['-i', '3']", "--ros-args ends the program"),
    ("", "p.parse_args(sys.argv[1:])", "['-i', '3']", "so it does"),
    ("", "p.parse_args(args)", "['-i', '3']", "so it does"),
    (ROS_ARGS, "p.parse_args()", "['-i', 'three']", "no number"),
    (ROS_ARGS, "p.parse_args()", "['--nothing']", "no such option"),
    (ROS_ARGS, "p.parse_args()", "['-i', open('x').read()]", "not a known word"),
    (ROS_ARGS, "p.parse_args(sys.argv[2:])", "['-i', '3']", "other words"),
    (ROS_ARGS, "p.parse_args(sys.argv)", "['-i', '3']", "the name of the program is no option"),
    (ROS_ARGS, "p.parse_args(other())", "['-i', '3']", "other words"),
    (
        ROS_ARGS + '\n    p.add_argument("-r", dest="index")',
        "p.parse_args()",
        "[]",
        "what launch adds may be the index",
    ),
    (ROS_ARGS + '\n    p.add_argument("need")', "p.parse_args()", "[]", "it is ended"),
    ('p.add_argument("--ros-args", action=Other)', "p.parse_args()", "[]", "an action of its own"),
    ('p.add_argument("--ros-args", dest="index", nargs="*")', "p.parse_args()", "[]", "the index is another"),
)


@pytest.mark.parametrize(("declared", "read", "words", "why"), NOT_KNOWN_BY_LAUNCH)
def test_options_of_ros2_that_are_not_known(declared: str, read: str, words: str, why: str) -> None:
    assert _ros2(declared, read, words)[0] == "/drone?"
