# SPDX-License-Identifier: Apache-2.0
"""Loops that end where reading a parameter raises, and loops of unknown length that count their names."""

from __future__ import annotations

import pytest
from follow_kit import case, cpp, names, python, table

SENSORS = (
    '<launch><node pkg="p" type="n.py" name="n"><param name="s0" value="/a"/><param name="s1" value="/b"/>'
    '<param name="s0_x" value="1"/><param name="s1_x" value="2"/></node></launch>'
)
READ = 'PUB(rospy.get_param("~s%d" % i))\n'
#: Rows of a ROS 1 script under that launch file: what it publishes.
ENDS = (
    case(
        "try around",
        f"i = 0\ntry:\n    while True:\n        {READ}        i += 1\nexcept KeyError:\n    pass",
        "/a",
        "/b",
    ),
    case(
        "try inside",
        f"i = 0\nwhile True:\n    try:\n        {READ}    except KeyError:\n        break\n    i += 1",
        "/a",
        "/b",
    ),
    case("no try", f"i = 0\nwhile 1:\n    {READ}    i += 1", "/a", "/b"),
    case(
        "bare except", f"i = 0\nwhile True:\n    try:\n        {READ}    except:\n        break\n    i += 1", "/a", "/b"
    ),
    case(
        "else of the try",
        "i = 0\nwhile True:\n    try:\n        s = rospy.get_param('~s%d' % i)\n    except KeyError:\n        break\n"
        "    else:\n        PUB(s)\n    i += 1",
        "/a",
        "/b",
    ),
    case(
        "a function that catches",
        "def read(i):\n    try:\n        return rospy.get_param('~s%d' % i)\n    except KeyError:\n        return None\n"
        "i = 0\nwhile True:\n    s = read(i)\n    if s is None:\n        break\n    PUB(s)\n    i += 1",
        "/a",
        "/b",
    ),
    case(
        "a function that raises",
        "def read(i):\n    return rospy.get_param('~s%d' % i)\n"
        "i = 0\ntry:\n    while True:\n        PUB(read(i))\n        i += 1\nexcept KeyError:\n    PUB('end')",
        "/a",
        "/b",
        "/end",
    ),
    case(
        "a loop of known length",
        f"for i in range(9):\n    try:\n        {READ}    except KeyError:\n        break",
        "/a",
        "/b",
    ),
    case(
        "the second reading of a turn",
        "i = 0\nwhile True:\n    try:\n        a = rospy.get_param('~s%d' % i)\n        b = rospy.get_param('~s%d_x' % i)\n"
        "    except KeyError:\n        break\n    PUB(a + str(b))\n    i += 1",
        "/a1",
        "/b2",
    ),
)
#: Rows where nothing raises, or it is not known what does.
GOES_ON = (
    case("a default", "for i in range(3):\n    PUB(rospy.get_param('~s%d' % i, '/d%d' % i))", "/a", "/b", "/d2"),
    case(
        "a handler that goes on",
        "for i in range(4):\n    try:\n        s = rospy.get_param('~s%d' % i)\n    except KeyError:\n        continue\n    PUB(s)",
        "/a",
        "/b",
    ),
    case(
        "another exception",
        f"for i in range(3):\n    try:\n        {READ}    except ValueError:\n        break",
        "/?",
        "/a",
        "/b",
    ),
    case("a list of names", "for s in ('~x', '~y'):\n    PUB(rospy.get_param(s) + s[1:])", "/?x", "/?y"),
    case("one name", "while True:\n    s = rospy.get_param('~none')\n    PUB('a')\n    PUB('b')", "/a", "/b"),
    case(
        "another place in a later turn",
        "k = 0\nwhile True:\n    if k == 0:\n        PUB('a' + rospy.get_param('~x'))\n        k = 1\n"
        "    elif k == 1:\n        PUB('b' + rospy.get_param('~y'))\n        break",
        "/a?",
        "/b?",
    ),
    case("has_param", "i = 0\nwhile rospy.has_param('~s%d' % i):\n    " + READ + "    i += 1", "/a", "/b"),
    case(
        "a branch that is not taken",
        "i = 0\nwhile i < 2:\n    try:\n        if False:\n            x = rospy.get_param('~t%d' % i)\n        PUB('a%d' % i)\n"
        "    except KeyError:\n        break\n    i += 1",
        "/a0",
        "/a1",
    ),
    case(
        "set by the node itself",
        "rospy.set_param('~s2', '/c')\ni = 0\nwhile True:\n    try:\n        "
        + READ
        + "    except KeyError:\n        break\n    i += 1",
        "/a",
        "/b",
        "/c",
    ),
)


@table((*ENDS, *GOES_ON))
def test_a_parameter_that_nothing_sets_ends_a_loop(before: str, code: str, expected: list[str]) -> None:
    assert names(python(f"{code}\n", SENSORS)) == expected


def test_what_is_read_last_is_read() -> None:
    found = python(
        "i = 0\nwhile True:\n    try:\n        x = rospy.get_param('~s%d' % i)\n    except KeyError:\n        break\n    i += 1\n",
        SENSORS,
    )
    assert names(found, "getters") == ["/n/s0", "/n/s1", "/n/s2"]


def test_where_nothing_is_set_the_first_one_raises() -> None:
    found = python(
        "i = 0\nwhile True:\n    try:\n        x = rospy.get_param('~s%d' % i)\n    except KeyError:\n        break\n    PUB(x)\n    i += 1\n"
    )
    assert names(found, "getters") == ["/n/s0"]
    assert names(found) == ["/?"]


def test_what_is_called_back_after_an_exception() -> None:
    loop = "    i = 0\n    while True:\n        s = rospy.get_param('~s%d' % i)\n        i += 1\n"
    found = python(
        f"def one(m):\n{loop}def two(m):\n    PUB('b')\n{loop}    PUB('c')\n"
        "rospy.Subscriber('x', String, one)\nrospy.Subscriber('y', String, two)\n",
        SENSORS,
    )
    assert names(found) == ["/b"]


def test_an_exception_of_what_is_started() -> None:
    loop = "i = 0\nwhile True:\n    s = rospy.get_param('~s%d' % i)\n    i += 1\n"
    assert names(python(f"def cb(m):\n    PUB('b')\nrospy.Subscriber('x', String, cb)\n{loop}", SENSORS)) == ["/b"]
    started = "def cb(m):\n    PUB('b')\ndef main():\n    rospy.Subscriber('x', String, cb)\n"
    code = started + "".join(f"    {line}\n" for line in loop.splitlines()) + "main()\nPUB('c')\n"
    assert names(python(code, SENSORS)) == ["/b"]


COUNTED = (
    'i = 0\nwhile True:\n    PUB("s%d" % i)\n    i += 1\n    if cond():\n        break',
    'i = 0\nwhile True:\n    if cond():\n        break\n    PUB("s%d" % i)\n    i += 1',
    'i = 0\ntry:\n    while True:\n        PUB("s%d" % i)\n        i += 1\n        check()\nexcept ValueError:\n    pass',
)


@pytest.mark.parametrize("code", COUNTED)
def test_names_that_a_loop_without_a_known_end_counts_are_not_known(code: str) -> None:
    assert names(python(f"{code}\n")) == ["/s?"]


def test_in_cpp_too() -> None:
    assert names(
        cpp('for (int i = 0; ; ++i) { ADV("s" + std::to_string(i), 1); if (cond()) break; }', "bool cond();")
    ) == ["/s?"]


KNOWN = (
    ('i = 0\nwhile True:\n    PUB("s%d" % i)\n    i += 1\n    if i == 3:\n        break', ["/s0", "/s1", "/s2"]),
    ('i = 0\nwhile i < 70:\n    PUB("s%d" % i)\n    i += 1', 65),
    ('i = 0\nok = True\nwhile ok:\n    PUB("s%d" % i)\n    i += 1\n    ok = rospy.get_time() > 9', ["/s0", "/s?"]),
    ('k = 0\nwhile True:\n    if k == 0:\n        PUB("a")\n        k = 1\n    else:\n        PUB("b")', ["/a", "/b"]),
)


@pytest.mark.parametrize(("code", "expected"), KNOWN)
def test_turns_that_are_known_are_told_apart(code: str, expected: list[str] | int) -> None:
    found = names(python(f"{code}\n"))
    assert (found if isinstance(expected, list) else len(found)) == expected
