# SPDX-License-Identifier: Apache-2.0
"""Changes to a small ROS package, and which findings each leaves old, makes new, or removes: data alone.

Every case watches the rules in ``rules`` only and switches on the tools in ``tools`` only. ``before`` and ``after`` are
all files of the repository. ``log`` edits a SARIF log made of ``before``, as another version of the tool would have
written it; against a revision it changes nothing, because the base is analysed with today's tools.

Five of the numbers 1 to 40 are not here, because they are about histories and flags: 26 (a rule under its old id, which
only a log can bring), 35 (merge, rebase and squash), 36 (shuffled input and --jobs), 37 (file arguments), 38 (no base).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Files = dict[str, str]


@dataclass(frozen=True)
class Mutation:
    """``states`` are those of all watched results against a revision: each ``state`` or ``state@tool:rule``, where the
    rule is the first of ``rules`` if none is named. ``sarif`` and ``compact`` are those against a file of known
    findings where they differ, and ``why`` says why. ``lines`` are those of the new results, where one place alone is
    right.
    """

    number: int
    name: str
    before: Files
    after: Files
    states: str
    lines: tuple[int, ...] | None = None
    rules: tuple[str, ...] = ("cpplint:runtime/printf",)
    tools: tuple[str, ...] = ("cpplint",)
    sarif: str = ""
    compact: str = ""
    why: str = ""
    log: Callable[[dict[str, Any]], None] | None = None


CPP, PY, OTHER = "walker/src/walker.cpp", "walker/scripts/walk.py", "walker/src/turner.cpp"

MANIFEST = """\
<?xml version="1.0"?>
<package format="2">
  <name>walker</name>
  <version>0.1.0</version>
  <description>Walks about.</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>catkin</buildtool_depend>
  <depend>roscpp</depend>
</package>
"""

WALKER = """\
// Walks about.
#include <cstdio>

#include "walker/walker.h"

namespace walker
{

int Walker::start(int goal)
{
  char name[32];
  int first = goal + 1;
  first += 2 * goal;
  sprintf(name, "%d of %d", first, goal);
  publish(name, first);
  return first;
}

int Walker::stop(int distance)
{
  char label[16];
  int second = distance - 1;
  second -= 3 * distance;
  announce(label, second);
  return second;
}

}  // namespace walker
"""

TURNER = """\
// Turns around.
#include "walker/walker.h"

namespace walker
{

int Walker::turn(int angle)
{
  int third = angle / 2;
  rotate(third);
  return third;
}

}  // namespace walker
"""

WALK = '''\
#!/usr/bin/env python3
"""Walks about."""
import math


class Walker:
    """Walks."""

    def start(self, goal):
        """Start to walk."""
        first = goal * 2
        spare = first + 1
        return math.sqrt(first)

    def stop(self, command):
        """Stop walking."""
        second = command - 1
        return second
'''

LINE = '  sprintf(name, "%d of %d", first, goal);\n'
START = WALKER[WALKER.index("int Walker::start") : WALKER.index("\nint Walker::stop")]
STOP = WALKER[WALKER.index("int Walker::stop") : WALKER.index("\n}  // namespace")]
SPREAD = '  sprintf(name,\n    "%d of %d",\n    first, goal);\n'
TWICE = WALKER.replace(LINE, LINE + "  check(first);\n  check(goal);\n  check(name);\n" + LINE)
HEADER = "walker/include/walker/sizes.h"
SIZES = "#ifndef WALKER_SIZES_H_\n#define WALKER_SIZES_H_\n#define WALKER_STEPS 10\n#endif\n"
TABLE = """\
// Remembers steps.
#include "walker/sizes.h"

int remember(int step)
{
  int steps[WALKER_STEPS];
  steps[7] = step;
  return steps[0];
}
"""
#: Two functions that each have the finding.
BOTH = WALKER.replace("  announce(", '  sprintf(label, "%d", second);\n  announce(')
UNINITIALISED = WALKER.replace("  first += 2 * goal;\n", "  int speed;\n  first += speed;\n").replace(LINE, "")


ROS2_MANIFEST = (
    MANIFEST.replace("catkin", "ament_cmake")
    .replace("roscpp", "rclcpp")
    .replace("</package>", "  <export><build_type>ament_cmake</build_type></export>\n</package>")
)
CMAKE = """\
project(walker)
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
find_package(std_msgs REQUIRED)
add_executable(first src/first.cpp)
add_executable(second src/second.cpp)
target_link_libraries(first rclcpp::rclcpp ${std_msgs_TARGETS})
target_link_libraries(second rclcpp::rclcpp ${std_msgs_TARGETS})
install(TARGETS first second DESTINATION lib/walker)
install(DIRECTORY launch DESTINATION share/walker)
ament_package()
"""
TALK = """\
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("first");
  auto pub = node->create_publisher<std_msgs::msg::String>("goal", 10);
  rclcpp::spin(node);
}
"""
LISTEN = """\
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("second");
  const int depth = 10;
  auto sub = node->create_subscription<std_msgs::msg::Int32>("steps", depth, &take);
  rclcpp::spin(node);
}
"""
LAUNCH = """\
<launch>
  <node pkg="walker" exec="first" name="first"/>
  <node pkg="walker" exec="second" name="second">
    <remap from="steps" to="goal"/>
  </node>
</launch>
"""
TALKER_CPP, LISTENER_CPP, LAUNCH_XML = "walker/src/first.cpp", "walker/src/second.cpp", "walker/launch/all.launch.xml"
ROS2: Files = {
    "walker/package.xml": ROS2_MANIFEST,
    "walker/CMakeLists.txt": CMAKE,
    TALKER_CPP: TALK,
    LISTENER_CPP: LISTEN,
    LAUNCH_XML: LAUNCH,
}
#: The same without a remapping, so that the finding stands at the call.
CALLED: Files = {
    **ROS2,
    LISTENER_CPP: LISTEN.replace('"steps"', '"goal"'),
    LAUNCH_XML: LAUNCH.replace('from="steps" to', 'from="a" to'),
}
SUBSCRIPTION = '  auto sub = node->create_subscription<std_msgs::msg::Int32>("goal", depth, &take);\n'


def system(*changes: tuple[str, str, str], files: Files = ROS2) -> Files:
    """The two nodes with the first occurrence of each old text in a file replaced."""
    made = dict(files)
    for path, old, new in changes:
        assert old in made[path], old
        made[path] = made[path].replace(old, new, 1)
    return made


def package(cpp: str = WALKER) -> Files:
    """The package with walker.cpp as given."""
    return {"walker/package.xml": MANIFEST, CPP: cpp, OTHER: TURNER}


def changed(*changes: tuple[str, str], text: str = WALKER) -> Files:
    """The package with the first occurrence of each old text in walker.cpp replaced."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return package(text)


def python(text: str) -> Files:
    return {"walker/package.xml": MANIFEST, PY: text}


def moved(files: Files, old: str, new: str) -> Files:
    """The same files, those below *old* standing below *new*."""
    return {path.replace(old, new, 1) if path.startswith(old) else path: text for path, text in files.items()}


def steps(count: int) -> str:
    """A function body of so many decisions."""
    return "".join(f"  if (goal > {n})\n  {{\n    first += {n};\n  }}\n" for n in range(count))


def complex_package(count: int, name: str = "start") -> Files:
    """The package with a function of cyclomatic complexity *count*."""
    text = WALKER.replace(LINE, "").replace("  first += 2 * goal;\n", steps(count - 1))
    return package(text.replace("start", name))


def reword(log: dict[str, Any]) -> None:
    for result in results_of(log):
        result["message"]["text"] = "Do not call this function, it overruns."
        result.get("properties", {}).pop("template", None)


def lower_level(log: dict[str, Any]) -> None:
    for result in results_of(log):
        result["level"] = "note"


def shift_columns(log: dict[str, Any]) -> None:
    for region in regions_of(log):
        region.update({key: region[key] + 1 for key in ("startColumn", "endColumn") if key in region})


def drop_ends(log: dict[str, Any]) -> None:
    for region in regions_of(log):
        for key in ("endColumn", "endLine"):
            region.pop(key, None)


def results_of(log: dict[str, Any]) -> list[dict[str, Any]]:
    return [result for run in log["runs"] for result in run["results"]]


def regions_of(log: dict[str, Any]) -> list[dict[str, Any]]:
    places = [result["locations"][0]["physicalLocation"] for result in results_of(log)]
    return [place["region"] for place in places if "region" in place]


UNUSED: dict[str, Any] = {"rules": ("pylint:unused-variable",), "tools": ("pylint",)}
UNINIT: dict[str, Any] = {"rules": ("cppcheck:uninitvar",), "tools": ("cppcheck",)}
BOUNDS: dict[str, Any] = {"rules": ("cppcheck:arrayIndexOutOfBounds",), "tools": ("cppcheck",)}
COMPLEXITY: dict[str, Any] = {
    "rules": ("metrics:max-cyclomatic-complexity-10", "metrics:max-cyclomatic-complexity-15"),
    "tools": ("lizard",),
}
MISMATCH: dict[str, Any] = {"rules": ("haros-ci:topic-type-mismatch",), "tools": ()}
OTHER_TOPIC = (
    '  auto more = node->create_publisher<std_msgs::msg::String>("other", 10);\n  rclcpp::spin',
    '  auto more = node->create_subscription<std_msgs::msg::Int32>("other", depth, &take);\n  rclcpp::spin',
)
TOPIC_RENAMED = ((TALKER_CPP, '"goal"', '"target"'), (LAUNCH_XML, 'to="goal"', 'to="target"'))
CALLED_RENAMED = ((TALKER_CPP, '"goal"', '"target"'), (LISTENER_CPP, '"goal"', '"target"'))
NODE_RENAMED = ((TALKER_CPP, '"first"', '"chief"'), (LAUNCH_XML, 'name="first"', 'name="chief"'))

MUTATIONS: tuple[Mutation, ...] = (
    Mutation(1, "one line above", package(), changed(("#include", "// more\n#include")), "unchanged"),
    Mutation(1, "a hundred lines above", package(), changed(("#include", "// more\n" * 100 + "#include")), "unchanged"),
    Mutation(2, "lines deleted above", package(), changed(("#include <cstdio>\n\n", "")), "unchanged"),
    Mutation(3, "block indented", package(), changed((START, START.replace("\n  ", "\n      "))), "unchanged"),
    Mutation(4, "LF to CRLF", package(), package(WALKER.replace("\n", "\r\n")), "unchanged"),
    Mutation(4, "CRLF to LF", package(WALKER.replace("\n", "\r\n")), package(), "unchanged"),
    Mutation(4, "spaces to tabs", package(), package(WALKER.replace("  ", "\t")), "unchanged"),
    Mutation(4, "byte-order mark", package(), package("\ufeff" + WALKER), "unchanged"),
    Mutation(5, "trailing comment", package(), changed((LINE, LINE.replace(";", ";  // for people"))), "unchanged"),
    Mutation(6, "line above edited", package(), changed(("first += 2 * goal", "first -= goal / 7")), "unchanged"),
    Mutation(6, "line below edited", package(), changed(("publish(name, first)", "tell(first)")), "unchanged"),
    Mutation(7, "expression spread over three lines", package(), changed((LINE, SPREAD)), "updated"),
    Mutation(7, "spread so that the call starts on the second", changed((LINE, "  count = sprintf(name, first);\n")),
             changed((LINE, "  count =\n    sprintf(\n    name, first);\n")),
             "updated", sarif="new absent", compact="new absent",
             why="only the base's text tells that the line that began the statement became the one that calls"),
    Mutation(8, "local renamed", package(), package(WALKER.replace("first", "initial")), "updated"),
    Mutation(8, "local renamed that the message names", package(UNINITIALISED),
             package(UNINITIALISED.replace("speed", "velocity")), "updated", **UNINIT),
    Mutation(8, "unused local renamed", python(WALK), python(WALK.replace("spare", "extra")), "updated", **UNUSED),
    Mutation(9, "function renamed", package(), package(WALKER.replace("::start", "::begin")), "unchanged"),
    Mutation(9, "class renamed", package(), package(WALKER.replace("Walker", "Runner")), "unchanged"),
    Mutation(9, "namespace renamed", package(), package(WALKER.replace("namespace walker", "namespace runner")),
             "unchanged"),
    Mutation(9, "Python method renamed", python(WALK), python(WALK.replace("start", "begin")), "unchanged", **UNUSED),
    Mutation(9, "complex function renamed", complex_package(12), complex_package(12, "begin"), "updated", **COMPLEXITY),
    Mutation(10, "file renamed", package(), moved(package(), CPP, "walker/src/runner.cpp"), "updated"),
    Mutation(11, "directory renamed", package(), moved(package(), "walker/src", "walker/lib"), "updated"),
    Mutation(11, "package renamed", package(), moved(package(), "walker/", "runner/"), "updated"),
    Mutation(12, "renamed and a third edited", package(),
             moved(changed((STOP, "int Walker::halt()\n{\n  brake();\n  return 0;\n}\n"), ("2 * goal", "goal")), CPP,
                   "walker/src/runner.cpp"), "updated"),
    Mutation(13, "function moved down the file", package(),
             package(WALKER.replace(START + "\n", "").replace(STOP, STOP + "\n" + START)), "unchanged"),
    Mutation(14, "function moved to another file", package(),
             {**package(WALKER.replace(START + "\n", "")),
              OTHER: TURNER.replace("int Walker::turn", START + "\nint Walker::turn")}, "updated"),
    Mutation(15, "file copied", package(), {**package(), "walker/src/walker2.cpp": WALKER}, "unchanged new"),
    Mutation(15, "file copied before the first by name", package(),
             {**package(), "walker/src/a.cpp": WALKER}, "unchanged new"),
    Mutation(16, "function copied below", package(),
             changed((STOP, START.replace("start", "again") + "\n" + STOP)), "unchanged new", lines=(24,)),
    Mutation(16, "function copied above", package(),
             changed((START, START.replace("start", "again") + "\n" + START)), "unchanged new", lines=(14,)),
    Mutation(17, "functions swapped", package(BOTH),
             package(BOTH.replace(START + "\n", "").replace("\n}  // n", "\n" + START + "\n}  // n")),
             "unchanged unchanged"),
    Mutation(18, "line duplicated below", package(), changed((LINE, LINE * 2)), "unchanged new", lines=(15,)),
    Mutation(18, "line duplicated further below", package(),
             changed(("  return first;\n", LINE + "  return first;\n")), "unchanged new", lines=(16,)),
    Mutation(19, "line duplicated above", package(), changed(("  first += 2", LINE + "  first += 2")), "unchanged new"),
    Mutation(20, "first of two mended", package(TWICE), package(TWICE.replace(LINE, "", 1)), "unchanged absent"),
    Mutation(20, "second of two mended", package(TWICE),
             package("".join(TWICE.rpartition(LINE)[::2])), "unchanged absent"),
    Mutation(21, "one mended, one added elsewhere", package(),
             changed((LINE, '  snprintf(name, sizeof(name), "%d", first);\n'),
                     ("  announce(", '  sprintf(label, "%d", second);\n  announce(')), "new absent"),
    Mutation(21, "one mended, one added elsewhere in the function", package(),
             changed((LINE, ""), ("  return first;\n", '  int length = strcpy(other, "walker");\n  return length;\n')),
             "new absent"),
    Mutation(22, "mended in one function, the same text added in another", package(),
             changed((LINE, ""), ("  announce(label", LINE + "  announce(label")), "new absent"),
    Mutation(23, "another rule fires on the line", package(),
             changed((LINE, LINE.replace("first, goal", "first, (int)goal"))),
             "updated new@cpplint:readability/casting",
             rules=("cpplint:runtime/printf", "cpplint:readability/casting")),
    Mutation(24, "two rules on a line, one mended", changed((LINE, LINE.replace("first, goal", "first, (int)goal"))),
             package(),
             "updated absent@cpplint:readability/casting",
             rules=("cpplint:runtime/printf", "cpplint:readability/casting")),
    Mutation(25, "message worded otherwise by the older tool", package(), package(), "unchanged", sarif="updated",
             why="the log has the old wording, today's tool words both sides of a revision alike", log=reword),
    Mutation(27, "level changed", package(), package(), "unchanged", sarif="updated",
             why="the log has the old level; both sides of a revision have the base's settings", log=lower_level),
    Mutation(28, "columns counted otherwise", package(), package(), "unchanged", log=shift_columns),
    Mutation(29, "tool starts to report ends", package(), package(), "unchanged", log=drop_ends),
    Mutation(30, "metric a little worse in its band", complex_package(12), complex_package(13), "updated",
             compact="unchanged", why="the compact file holds no metric's value", **COMPLEXITY),
    Mutation(30, "metric worse by a band", complex_package(12), complex_package(30),
             "new@metrics:max-cyclomatic-complexity-15 absent", **COMPLEXITY),
    Mutation(31, "header edit makes a finding in an untouched file",
             {**package(TABLE), HEADER: SIZES}, {**package(TABLE), HEADER: SIZES.replace("10", "4")}, "new", **BOUNDS),
    Mutation(32, "last use deleted", python(WALK.replace("math.sqrt(first)", "math.sqrt(spare)")), python(WALK),
             "new", **UNUSED),
    Mutation(33, "finding on a whole file, unrelated edit",
             {**python(WALK), "broken/package.xml": "<package><name>broken</name>\n"},
             {**python(WALK + "\n"), "broken/package.xml": "<package><name>broken</name>\n"}, "unchanged",
             rules=("haros-ci:malformed-manifest",), tools=()),
    Mutation(34, "generated path changes", {**package(TURNER), "walker/gen-1f3a/walker.cpp": WALKER},
             {**package(TURNER), "walker/gen-99c0/walker.cpp": WALKER}, "updated"),
    Mutation(39, "suppression comment added", package(),
             changed((LINE, LINE.replace(";", ";  // haros: ignore[runtime/printf] measured"))), "suppressed"),
    Mutation(39, "suppression comment removed",
             changed((LINE, LINE.replace(";", ";  // haros: ignore[runtime/printf] measured"))), package(), "new"),
    Mutation(1, "lines above a call in a system", CALLED,
             system((LISTENER_CPP, "int main", "// more\nint main"), files=CALLED), "unchanged", **MISMATCH),
    Mutation(1, "lines above a remapping", ROS2, system((LAUNCH_XML, "<launch>", "<launch>\n  <!-- more -->")),
             "unchanged", **MISMATCH),
    Mutation(7, "call in a system spread over three lines", CALLED,
             system((LISTENER_CPP, SUBSCRIPTION, SUBSCRIPTION.replace('("', '(\n    "').replace("depth,", "depth,\n   ")),
                    files=CALLED), "updated", **MISMATCH),
    Mutation(10, "source of a node renamed", CALLED,
             moved(system(("walker/CMakeLists.txt", "src/second", "src/other"), files=CALLED), LISTENER_CPP,
                   "walker/src/other.cpp"), "updated", **MISMATCH),
    Mutation(10, "launch file renamed", ROS2, moved(ROS2, LAUNCH_XML, "walker/launch/both.launch.xml"), "updated",
             **MISMATCH),
    Mutation(14, "call in a system moved to another file", CALLED,
             {**system((LISTENER_CPP, SUBSCRIPTION, "  take_all(node);\n"),
                       (LISTENER_CPP, "int main", '#include "taking.hpp"\n\nint main'), files=CALLED),
              "walker/src/taking.hpp": "inline void take_all(rclcpp::Node::SharedPtr node)\n{\n  int depth = 5;\n"
              + SUBSCRIPTION.replace("auto sub", "static auto sub") + "}\n"}, "updated", **MISMATCH),
    Mutation(21, "one wrong remapping mended, another made", ROS2,
             system((TALKER_CPP, '"goal", 10', '"other", 10'), (LAUNCH_XML, "</launch>",
                     '  <node pkg="walker" exec="second" name="third">\n    <remap from="steps" to="other"/>\n'
                     "  </node>\n</launch>")), "new absent", **MISMATCH),
    Mutation(40, "topic renamed in code and launch", ROS2, system(*TOPIC_RENAMED), "updated", **MISMATCH),
    Mutation(40, "topic renamed in the call that is found", CALLED, system(*CALLED_RENAMED, files=CALLED), "updated",
             **MISMATCH),
    Mutation(40, "node renamed in code and launch", ROS2, system(*NODE_RENAMED), "updated", **MISMATCH),
    Mutation(40, "node of the call that is found renamed", CALLED,
             system((LISTENER_CPP, '"second"', '"chief"'), (LAUNCH_XML, 'name="second"', 'name="chief"'), files=CALLED),
             "updated", **MISMATCH),
    Mutation(40, "node and topic renamed at once", ROS2, system(*NODE_RENAMED, *TOPIC_RENAMED), "updated",
             sarif="new absent", compact="new absent",
             why="without the old text one name may differ: more could be another defect", **MISMATCH),
    Mutation(40, "topic renamed, and another one made with the same defect", CALLED,
             system(*CALLED_RENAMED, (TALKER_CPP, "  rclcpp::spin", OTHER_TOPIC[0]),
                    (LISTENER_CPP, "  rclcpp::spin", OTHER_TOPIC[1]), files=CALLED),
             "updated new", sarif="new new absent", compact="new new absent",
             why="without the old text it is not known which of the two is the one that was", **MISMATCH),
)  # fmt: skip
