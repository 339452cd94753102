# SPDX-License-Identifier: Apache-2.0
"""Changes that make a file larger, or deeper, than is analysed, so that nothing wrong is found in it: a finding, never green."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from hostile_kit import CHEAP_FINDING, CONTROL, Outcome, Trap, assert_harmless

RULE = "file-not-analysed"
ONLY = ("--profile=architecture", "--baseline-rev=main")
MANIFEST = """<package format="2"><name>robot</name><version>1.0.0</version><description>x</description>
<maintainer email="a@b.cd">a</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>
<depend>roscpp</depend><depend>rospy</depend><depend>std_msgs</depend></package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project(robot)
find_package(catkin REQUIRED COMPONENTS roscpp rospy std_msgs)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
add_executable(talker src/talker.cpp)
target_link_libraries(talker ${catkin_LIBRARIES})
add_dependencies(talker ${catkin_EXPORTED_TARGETS})
install(TARGETS talker RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
catkin_install_python(PROGRAMS scripts/node.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
"""
CPP = "robot/src/talker.cpp"
SCRIPT = "robot/scripts/node.py"
LAUNCH = "robot/launch/all.launch"
TALKER = """#include <ros/ros.h>
#include <std_msgs/String.h>
int main(int argc, char** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle n;
%s  ros::Publisher p = n.advertise<std_msgs::String>("chat", 1);
%s  ros::spin();
}
"""
HEAD = "#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import String\n\nrospy.init_node('node')\n"
NODE = f"{HEAD}rospy.Publisher('news', String, queue_size=1)\n"


#: A part of the steps that a node has.
FEWER = "from haros_ci.follow import walk\nwalk.STEPS = 5_000"


def many_calls() -> str:
    """A script of some thousand calls."""
    made = ["def f0(x):\n    rospy.Publisher('n%d' % x, String, queue_size=1)\n"]
    for level in range(1, 5):
        calls = "".join(f"    f{level - 1}(x * 8 + {number})\n" for number in range(8))
        made.append(f"def f{level}(x):\n{calls}")
    return f"{HEAD}{''.join(made)}f4(0)\n"


def nested_python(depth: int) -> str:
    return f"{NODE}x = {'[' * depth}{']' * depth}\n"


@dataclass(frozen=True)
class Case:
    """What the head writes to *path*, and words of the message there; *base* is what the base revision has there."""

    name: str
    path: str
    head: str
    says: str = ""
    base: str = ""


CASES = [
    Case("a program of many calls", SCRIPT, many_calls(), "the node is too large to be followed to its end"),
    Case("blocks in blocks in C++", CPP, TALKER % ("{" * 300, "}" * 300), "nested too deeply"),
    Case("brackets in brackets in C++", CPP, TALKER % (f"int i = {'(' * 300}1{')' * 300};\n", ""), "nested too deeply"),
    Case("brackets in brackets in Python", SCRIPT, nested_python(190), "nested deeper than 100 levels"),
    Case(
        "a loop in CMake that does not end",
        "robot/CMakeLists.txt",
        CMAKE.replace("include_dir", "while(TRUE)\n  set(A 1)\nendwhile()\ninclude_dir"),
        "its CMake takes too long to follow",
    ),
]
QUIET = [
    Case("some calls", SCRIPT, NODE + "rospy.Publisher('more', String, queue_size=1)\n" * 300),
    Case("some blocks", CPP, TALKER % ("{" * 30, "}" * 30)),
    Case("some brackets", SCRIPT, nested_python(30)),
    Case("a loop in CMake that ends", "robot/CMakeLists.txt", f"{CMAKE}foreach(i RANGE 20)\nendforeach()\n"),
    Case("code behind a macro", CPP, TALKER % ("BEGIN_SOMETHING x y z\n", "")),
    Case("it was so", CPP, f"{TALKER % ('{' * 300, '}' * 300)}// changed\n", base=TALKER % ("{" * 300, "}" * 300)),
    Case("it is mended", SCRIPT, NODE, base=nested_python(190)),
    Case("an unknown name", SCRIPT, f"{HEAD}rospy.Publisher(input(), String, queue_size=1)\n"),
]


def change(trap: Trap, case: Case) -> None:
    """The package in the base revision, and what the head makes of it."""
    (trap.root / CONTROL).unlink()
    trap.write(CHEAP_FINDING[0], "int f(int x) { return x; }\n")
    files = {
        "robot/package.xml": MANIFEST,
        "robot/CMakeLists.txt": CMAKE,
        CPP: TALKER % ("", ""),
        SCRIPT: NODE,
        LAUNCH: '<launch><node pkg="robot" type="talker" name="talker"/></launch>\n',
    }
    for path, text in files.items():
        trap.write(path, case.base or text if path == case.path else text)
    (trap.root / SCRIPT).chmod(0o755)
    trap.commit()
    trap.git("checkout", "-q", "-b", "head")
    trap.write(case.path, case.head)
    trap.commit()


def found(outcome: Outcome) -> list[tuple[str, str, str, str]]:
    """Path, level, state and message of each finding of the rule."""
    results = [result for result in outcome.report["results"] if result["rule"] == RULE]
    return [(result["path"], result["level"], result["state"], result["message"]) for result in results]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_it_is_a_finding_at_the_file(case: Case, trap: Trap) -> None:
    change(trap, case)
    outcome = trap.run(*ONLY, driver=trap.impatient(FEWER))
    assert outcome.code == 1, (outcome.stderr, outcome.notes())
    [(path, level, state, message)] = found(outcome)
    assert (path, level, state) == (case.path, "warning", "new")
    assert message.startswith("since this change the checks of the architecture may miss what is wrong in this file: ")
    assert case.says in message
    assert_harmless(trap, outcome)


@pytest.mark.parametrize("case", QUIET, ids=lambda case: case.name)
def test_it_is_no_finding(case: Case, trap: Trap) -> None:
    change(trap, case)
    outcome = trap.run(*ONLY)
    assert found(outcome) == [], outcome.formats["text"]
    assert outcome.code == 0, outcome.formats["text"]
