# SPDX-License-Identifier: Apache-2.0
"""Options of Python programs that argparse reads from the words of a launch file."""

from __future__ import annotations

import pytest
from follow_kit import names, python

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


@pytest.mark.parametrize(
    ("before", "words"),
    [
        ('p.add_argument("where", nargs="?")\n', ""),
        ('p.add_argument("where", nargs="*")\n', "a"),
        ('p.add_argument("--only2", nargs="*")\n', "--only2 a"),
        ('p.add_argument("needed")\n', ""),
        ("p.allow_abbrev = other()\n", "$(env HOME_OF)"),
    ],
)
def test_words_that_roslaunch_adds_may_be_an_option(before: str, words: str) -> None:
    launch = f'<launch><node pkg="p" type="n.py" name="n" args="{words}"/></launch>'
    assert names(python(PARTLY.replace("o, rest", before + "o, rest") + "PUB(o.topic)\n", launch)) == ["/?"]


def test_a_program_alone_may_be_given_words() -> None:
    assert names(python(PARTLY + "PUB(o.topic)\n")) == ["/?"]


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
