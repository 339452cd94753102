# SPDX-License-Identifier: Apache-2.0
"""``try``: what its block has done where it may be left, and what Python raises for certain."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names, python, ros2_cpp

from haros_ci.model.architecture import Node

OUTSIDE = (
    "#include <string>\n#include <stdexcept>\nbool cond();\nvoid check();\nint number();\n"
    "void fails() { throw 1; }\nvoid may_fail() { if (cond()) throw 1; }\nvoid calls() { check(); }\n"
    'int plain() { return 1; }\nvoid logs() { ROS_INFO("x"); }\n'
)
#: The block may be left before all is done: what holds afterwards is one or the other.
OPEN = (
    'try { check(); s = "b"; } catch (...) {}',
    'try { s = "b"; check(); s = "c"; } catch (...) {}',
    'try { if (number() > 1) check(); s = "b"; } catch (const std::exception& e) { ROS_ERROR("%s", e.what()); }',
    'try { may_fail(); s = "b"; } catch (...) {}',
    'try { calls(); s = "b"; } catch (...) {}',
    'try { if (cond()) throw 1; s = "b"; } catch (...) {}',
    'for (int i = 0; i < 2; ++i) { try { check(); s = "b"; } catch (...) {} }',
    'try { try { check(); s = "b"; } catch (const std::bad_alloc&) {} } catch (...) {}',
)


@pytest.mark.parametrize("code", OPEN)
def test_a_block_may_be_left_on_the_way(code: str) -> None:
    assert names(cpp(f'std::string s = "a"; {code} ADV(s, 1);', OUTSIDE)) == ["/?"]


#: What the block does before anything can throw is done, and so is all of it where nothing can, or where the handler leaves.
CLOSED = (
    ('try { s = "b"; check(); } catch (...) {}', "/b"),
    ('try { s = "b"; } catch (...) {}', "/b"),
    ('try { s = "b"; ROS_INFO("x"); s = "c"; } catch (...) {}', "/c"),
    ('try { int i = plain(); s = i == 1 ? "b" : "c"; } catch (...) {}', "/b"),
    ('try { check(); s = "b"; } catch (...) { return 1; }', "/b"),
    ('try { check(); s = "b"; } catch (...) { throw; }', "/b"),
    ('try { check(); s = "b"; } catch (...) { exit(1); }', "/b"),
    ('try { check(); s = "b"; } catch (...) { s = "b"; }', "/b"),
    ('try { throw 1; s = "b"; } catch (...) {}', "/a"),
    ('try { s = "b"; throw 1; } catch (...) {}', "/b"),
    ('try { fails(); s = "b"; } catch (...) {}', "/?"),
    ('try { if (false) check(); s = "b"; } catch (...) {}', "/b"),
)


@pytest.mark.parametrize(("code", "expected"), CLOSED)
def test_what_is_done_before_is_done(code: str, expected: str) -> None:
    assert names(cpp(f'std::string s = "a"; {code} ADV(s, 1);', OUTSIDE)) == [expected]


#: Python raises for certain, and a handler catches it: what stands behind is not done.
RAISED = (
    "import sys\ntry:\n    s = sys.argv[4]\nexcept IndexError:\n    s = 'b'",
    "import sys\ntry:\n    s = sys.argv[9]\nexcept:\n    s = 'b'",
    "import sys\ntry:\n    s = 'c'\n    t = sys.argv[9]\n    s = 'd'\nexcept (IndexError, KeyError):\n    s = 'b'",
    "l = ['x']\ntry:\n    s = l[3]\nexcept LookupError:\n    s = 'b'",
    "s = 'b'\nl = ['x']\ntry:\n    s = l[3]\nexcept Exception as e:\n    print(e)",
    "try:\n    s = str(int('zz'))\nexcept ValueError:\n    s = 'b'",
    "try:\n    s = rospy.get_param('~x')\nexcept KeyError:\n    s = 'b'",
    "s = 'a'\ntry:\n    s = 'b'\n    t = rospy.get_param('~x')\n    s = 'c'\nexcept KeyError:\n    pass",
    "def f():\n    try:\n        return rospy.get_param('~x')\n    except KeyError:\n        return 'b'\ns = f()",
    "def g(n):\n    return rospy.get_param(n)\ntry:\n    s = g('~x')\nexcept KeyError:\n    s = 'b'",
    "try:\n    try:\n        s = rospy.get_param('~x')\n    except ValueError:\n        s = 'c'\nexcept KeyError:\n    s = 'b'",
    "import contextlib\ns = 'b'\nwith contextlib.suppress(KeyError):\n    s = rospy.get_param('~x')",
)


@pytest.mark.parametrize("code", RAISED)
def test_what_is_raised_for_certain_is_caught(code: str) -> None:
    assert names(python(f"{code}\nPUB(s)\n")) == ["/b"]


def test_what_stands_behind_is_ruled_out() -> None:
    found = python("try:\n    rospy.get_param('~x')\n    PUB('a')\nexcept KeyError:\n    PUB('b')\n")
    assert [(end.name, end.is_ruled_out) for end in found.endpoints if end.kind == "publishers"] == [
        ("/a", True),
        ("/b", False),
    ]


#: Not certain, not caught, or not raised.
NOT_RAISED = (
    ("try:\n    s = rospy.get_param('~x', 'b')\nexcept KeyError:\n    s = 'b'", "/b"),
    ("s = 'c'\nl = ['b']\ntry:\n    s = l[0]\nexcept IndexError:\n    pass", "/b"),
    ("s = 'c'\ntry:\n    s = 'b' + str(int('4'))\nexcept ValueError:\n    pass", "/b4"),
    ("s = 'b'\ntry:\n    rospy.loginfo('x')\n    s = 'b'\nexcept Exception:\n    pass", "/b"),
    ("from o import check\ns = 'b'\ntry:\n    check()\n    s = 'c'\nexcept Exception:\n    pass", "/?"),
    (
        "from o import check\ntry:\n    s = rospy.get_param('~x') if check() else 'c'\nexcept KeyError:\n    s = 'b'",
        "/?",
    ),
    ("try:\n    s = rospy.get_param('~x')\nexcept ValueError:\n    s = 'b'", "/?"),
    (
        "import contextlib\nfrom o import check\ns = 'b'\nwith contextlib.suppress(OSError):\n    check()\n    s = 'c'",
        "/?",
    ),
    ("s = 'b'\nwith open('f') as f:\n    s = 'c'", "/c"),
    ("try:\n    from o import T\n    s = 'b'\nexcept ImportError:\n    s = 'b'", "/b"),
)


@pytest.mark.parametrize(("code", "expected"), NOT_RAISED)
def test_what_is_not_certain(code: str, expected: str) -> None:
    assert names(python(f"{code}\nPUB(s)\n")) == [expected]


def _ros2(code: str) -> Node:
    (found,) = ros2_cpp(code).nodes
    return found


def test_a_parameter_that_is_not_declared_is_caught_in_ros_2() -> None:
    found = _ros2(
        'std::string s = "a"; try { s = get_parameter("x").as_string(); } '
        'catch (const rclcpp::exceptions::ParameterNotDeclaredException& e) { s = "b"; } create_publisher<String>(s, 1);'
    )
    assert "/b" in names(found)


def test_a_parameter_that_is_declared_is_read() -> None:
    found = _ros2(
        'declare_parameter("x", "b"); std::string s = "a"; try { s = get_parameter("x").as_string(); } '
        'catch (const rclcpp::exceptions::ParameterNotDeclaredException& e) { s = "c"; } create_publisher<String>(s, 1);'
    )
    assert "/b" in names(found)


def test_an_exception_of_a_callback_is_its_own() -> None:
    code = (
        "def cb(m):\n    raise ValueError()\nrospy.Subscriber('t', String, cb)\ns = 'a'\n"
        "try:\n    s = 'b'\nexcept ValueError:\n    pass\nPUB(s)\n"
    )
    assert names(python(code)) == ["/b"]
