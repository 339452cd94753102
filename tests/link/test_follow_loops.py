# SPDX-License-Identifier: Apache-2.0
"""Loops that are worth their turns and loops without end; callbacks that register callbacks without end."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names, python

#: Code of ``main``, and the parameters that it reads.
CPP = (
    ('while (!nh.hasParam("a")) {}', ["/a"]),
    ('while (!nh.hasParam("a")) { ros::Duration(1).sleep(); }', ["/a"]),
    ('do { ros::Duration(1).sleep(); } while (!nh.hasParam("a"));', ["/a"]),
    ('int i = 0; while (nh.hasParam("a" + std::to_string(i))) { i++; }', ["/a0"]),
    ('int i = 0; while (cond()) { nh.hasParam("a" + std::to_string(i++)); }', ["/a?"]),
    ('int i = 0; while (cond() && !nh.hasParam("a" + std::to_string(i))) { i++; }', ["/a0", "/a?"]),
    ('while (true) { while (true) { while (true) { nh.hasParam("a"); nh.hasParam("b"); } } }', ["/a", "/b"]),
    ('for (;;) { for (int i = 0; i < 3; ++i) nh.hasParam("a" + std::to_string(i)); }', ["/a0", "/a1", "/a2"]),
    ('int i = 0; while (true) { if (i > 1) break; nh.hasParam("a" + std::to_string(i++)); }', ["/a0", "/a1"]),
    ('while (false) { nh.hasParam("a"); }', []),
    ('bool on = false; while (on) { nh.hasParam("a"); on = false; }', []),
    ('for (int i = 3; i < 3; ++i) { nh.hasParam("a"); }', []),
    ('do { nh.hasParam("a"); } while (false);', ["/a"]),
)


@pytest.mark.parametrize(("code", "expected"), CPP)
def test_parameters_read_in_loops(code: str, expected: list[str]) -> None:
    found = cpp('ADV("base", 1); ' + code, "#include <string>\nbool cond();\n")
    assert names(found, "getters") == expected


#: Of a branch that some turns take, only these count; one that none takes is kept with its condition.
TURNS = (
    ('for (int i = 0; i < 3; ++i) { if (i == 0) ADV("x", 1); else ADV("y" + std::to_string(i), 1); }', "/x /y1 /y2"),
    ('for (int i : {0, 1}) { if (i) ADV("x", 1); else ADV("y" + std::to_string(i), 1); }', "/x /y0"),
    ('for (int i = 0; i < 3; ++i) { if (i == 1) continue; ADV("y" + std::to_string(i), 1); }', "/y0 /y2"),
    ('for (int i = 0; i < 3; ++i) { if (i == 1) break; ADV("y" + std::to_string(i), 1); }', "/y0"),
    ('for (int i = 0; i < 3; ++i) { if (i == 0) continue; ADV("y" + std::to_string(i), 1); }', "/y1 /y2"),
    ('for (int i = 0; i < 3; ++i) { if (i != 1) continue; ADV("y" + std::to_string(i), 1); }', "/y1"),
    ('for (int i = 0; i < 2; ++i) { if (i == 0) continue; else {} ADV("y" + std::to_string(i), 1); }', "/y1"),
    ('for (int i = 0; i < 2; ++i) { if (cond() && i == 0) continue; ADV("y" + std::to_string(i), 1); }', "/y0 /y1"),
    ('for (int i = 0; i < 2; ++i) { unless("y" + std::to_string(i), i == 0); }', "/y1"),
    ('for (int i = 0; i < 3; ++i) { make("y" + std::to_string(i), i == 1); }', "/y1"),
    ('bool on = false; for (int i = 0; i < 2; ++i) { if (on) ADV("y" + std::to_string(i), 1); }', "/y0 /y1"),
    ('make("a", true); make("b", false);', "/a /b"),
)
MAKE = "void make(std::string s, bool on) { ros::NodeHandle nh; if (on) nh.advertise<std_msgs::String>(s, 1); }\n"
MAKE += "void unless(std::string s, bool off) { ros::NodeHandle nh; if (off) return; nh.advertise<std_msgs::String>(s, 1); }\n"
MAKE += "bool cond();\n"


@pytest.mark.parametrize(
    ("loop", "expected"),
    (
        ('for x in ("a", "b"):\n    if x == "a": continue\n    PUB(x)\n', "/b"),
        ('for x in ("a", "b"):\n    if x == "b": break\n    PUB(x)\n', "/a"),
        ('for x in ("a", "b"):\n    if x == outside(): continue\n    PUB(x)\n', "/a /b"),
        ('for x in ("a", "b"):\n    if x == "c": continue\n    PUB(x)\n', "/a /b"),
        ('def f(x):\n    if x == "a": return\n    PUB(x)\nfor x in ("a", "b"):\n    f(x)\n', "/b"),
    ),
)
def test_what_stands_behind_the_end_of_a_turn(loop: str, expected: str) -> None:
    assert names(python(loop)) == expected.split()


@pytest.mark.parametrize(("code", "expected"), TURNS)
def test_branches_that_some_turns_take(code: str, expected: str) -> None:
    assert names(cpp(code, "#include <string>\n" + MAKE)) == expected.split()


AGAIN = """
import threading
class Worker(object):
    def __init__(self, name):
        self.name = name
        threading.Thread(target=self.run).start()
    def run(self):
        PUB(self.name)
        Worker("again")
"""


def test_objects_whose_threads_make_more_of_them() -> None:
    found = python(AGAIN + 'Worker("first")\n')
    assert names(found) == ["/again", "/first"]
    assert [unknown.reason for unknown in found.unknowns if unknown.field == "endpoints"] == [
        "Worker.run is called back for more objects than are followed"
    ]


def test_many_objects_of_one_class() -> None:
    found = python(AGAIN.replace('Worker("again")', "pass") + 'for i in range(12):\n    Worker("w%d" % i)\n')
    assert names(found) == sorted(f"/w{number}" for number in range(12))
    assert not [unknown for unknown in found.unknowns if unknown.field == "endpoints"]


#: What the test of a loop reads is read in any case; what stands in its body, in its step or behind ``&&`` is not.
READ_IN_TESTS = (
    ("while (!nh.hasParam(text())) { x(); }", True),
    ("for (x(); nh.hasParam(text()); x()) { x(); }", True),
    ("do { x(); } while (!nh.hasParam(text()));", True),
    ("do { nh.hasParam(text()); } while (cond());", True),
    ("do { if (cond()) nh.hasParam(text()); } while (cond());", False),
    ("do { while (cond()) nh.hasParam(text()); } while (cond());", False),
    ("int i = 0; do { if (i > 0) nh.hasParam(text()); i++; } while (cond());", False),
    ("while (cond()) { nh.hasParam(text()); }", False),
    ("for (x(); cond(); nh.hasParam(text())) { x(); }", False),
    ("while (cond() && nh.hasParam(text())) { x(); }", False),
    ("while (cond()) { while (nh.hasParam(text())) { x(); } }", False),
)


@pytest.mark.parametrize(("code", "is_certain"), READ_IN_TESTS)
def test_conditions_of_what_a_test_reads(code: str, is_certain: bool) -> None:
    found = cpp('ADV("base", 1); ' + code, "#include <string>\nbool cond(); std::string text(); void x();\n")
    (end,) = [end for end in found.endpoints if end.kind == "getters" and not end.implicit]
    doubts = [item.reason for item in end.unknowns if item.field == "conditions"]
    assert (not end.conditions and not doubts) is is_certain


def test_a_test_of_python_is_no_condition_of_what_it_reads() -> None:
    found = python("while rospy.get_param('a') is False:\n    rospy.get_param('b')\n    rospy.sleep(1)\n")
    conditions = {
        end.name: [item.statement for item in end.conditions] for end in found.endpoints if end.kind == "getters"
    }
    assert conditions == {"/a": [], "/b": ["while"]}
