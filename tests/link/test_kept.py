# SPDX-License-Identifier: Apache-2.0
"""What nodes make is kept between runs: the model is the same byte for byte, and what is not touched is not followed.

A record is checked for its form, not for its truth: one that somebody has written with the right key, digests and shape
is believed. It is trusted as far as the cache directory is, which is never one of the workspace under analysis unless
the user names it (tests/hostile).
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from follow_kit import CMAKE, ROS2_CMAKE, ROS2_HEAD, ROS2_NODE, main, script, workspace

import haros_ci.systems.ros2_processes as ros2_processes
from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.follow.made import MadeEntity
from haros_ci.graph.ros2_process import RemappingRule, RosNode
from haros_ci.keeping import kept, kept_json
from haros_ci.keeping.consulted import Consulted
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.report.model_json import render
from haros_ci.systems import following
from haros_ci.values.abstract import Known

Files = dict[str, str]


@dataclass
class Cache:
    """A cache in memory; what it keeps goes through JSON. Without *keeps* it has no record of what was followed."""

    kept: dict[tuple[str, str, str], str] = field(default_factory=dict)
    keeps: bool = True

    def get(self, group: str, path: str, key: str) -> Any:
        found = self.kept.get((group, path, key))
        return None if found is None or (group == "linked" and not self.keeps) else json.loads(found)

    def put(self, group: str, path: str, key: str, value: object) -> None:
        if group != "linked" or self.keeps:
            self.kept[group, path, key] = json.dumps(value)

    def get_text(self, group: str, path: str, key: str) -> str | None:
        return self.kept.get((group, path, key))

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self.kept[group, path, key] = text

    def records(self) -> list[tuple[str, str, str]]:
        return [place for place in self.kept if place[0] == "linked" and place[1] != "last"]


@pytest.fixture
def followed(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The files in which what is followed begins."""
    calls: list[str] = []
    original = following.followed_in

    def counted(types: Any, entry: Any, *rest: Any) -> Any:
        calls.append(entry.source.path)
        return original(types, entry, *rest)

    monkeypatch.setattr(following, "followed_in", counted)
    monkeypatch.setattr(ros2_processes, "followed_in", counted)
    return calls


def digested(files: Files, ros: int | None) -> Workspace:
    made = workspace(files, ros)
    digests = {path: sha256(text.encode()).hexdigest() for path, text in files.items()}
    return replace(made, files=tuple(replace(each, digest=digests.get(each.path, "")) for each in made.files))


def model(files: Files, cache: Cache, ros: int | None, project: Mapping[str, Any] | None = None) -> str:
    settings = replace(Settings(root=Path("/nowhere")), project=project or {})
    found = architecture(digested(files, ros), settings, cache, environment={}, known_nodes=False)
    return render(found)


def again(
    before: Files,
    after: Files,
    followed: list[str],
    ros: int | None,
    *projects: Mapping[str, Any],
) -> tuple[list[str], bool]:
    """What is followed in a second run, and whether its model is another; it is the same as without a cache."""
    cache = Cache()
    first, second = projects or ({}, {})
    earlier = model(before, cache, ros, first)
    followed.clear()
    later = model(after, cache, ros, second)
    calls = sorted(followed)
    assert later == model(after, Cache(keeps=False), ros, second)
    followed.clear()
    assert model(after, cache, ros, second) == later  # and a third run takes all of it
    return calls, later != earlier


OLDER: Files = {
    "p/CMakeLists.txt": CMAKE.format("p")
    + "include_directories(src)\nadd_executable(a src/a.cpp src/work.cpp)\nadd_executable(b src/b.cpp)\n"
    "catkin_install_python(PROGRAMS scripts/s.py)\n",
    "p/setup.py": "from distutils.core import setup\nsetup(packages=['lib'], package_dir={'': 'src'})\n",
    "p/src/lib/__init__.py": "",
    "p/src/lib/topics.py": "NAME = 'python'\ndef name():\n    return NAME\n",
    "p/scripts/s.py": script("from lib.topics import name\nPUB(name())\n"),
    "p/src/names.h": '#pragma once\n#define NAME "chatter"\n#include "more.h"\n',
    "p/src/more.h": '#pragma once\nstatic const char* more = "more";\n',
    "p/src/base.h": "#pragma once\n#include <ros/ros.h>\n#include <std_msgs/String.h>\nclass Other {};\n"
    'class Base { public: void open(ros::NodeHandle& nh) { q = nh.advertise<std_msgs::String>("base", 1); } ros::Publisher q; };\n',
    "p/src/work.h": '#pragma once\n#include "base.h"\nclass Work : public Base { public: Work(ros::NodeHandle& nh);\nros::Publisher p; };\n'
    "typedef Work Job;\n",
    "p/src/work.cpp": '#include "work.h"\n#include "names.h"\nWork::Work(ros::NodeHandle& nh) { open(nh); '
    "p = nh.advertise<std_msgs::String>(NAME, 1); }\n",
    "p/src/a.cpp": main("Job w(nh);", '#include "work.h"\n'),
    "p/src/b.cpp": main('std::string t; nh.param<std::string>("t", t, "d"); auto p = ADV(t, 1);', "struct Idle {};"),
    "p/src/unused.cpp": "int unused() { return 1; }\n",
    "p/launch/l.launch": '<launch><node pkg="p" type="a" name="x"/><node pkg="p" type="b" name="y"/>'
    '<param name="/t" value="given"/><node pkg="p" type="s.py" name="z"/></launch>\n',
}
NEWER: Files = {
    "p/CMakeLists.txt": ROS2_CMAKE.format("p")
    + "ament_auto_add_library(l SHARED src/n.cpp)\nament_auto_add_executable(m src/m.cpp)\n"
    'rclcpp_components_register_node(l PLUGIN "N" EXECUTABLE n)\nament_auto_package(INSTALL_TO_SHARE launch)\n',
    "p/src/names.hpp": 'constexpr const char * TOPIC = "t";\n',
    "p/src/n.cpp": ROS2_HEAD
    + '#include "names.hpp"\n'
    + ROS2_NODE
    % (
        'auto p = create_publisher<String>(TOPIC, 1); auto v = declare_parameter("a", "d"); '
        "auto q = create_publisher<String>(v, 1);",
        "",
    ),
    "p/src/m.cpp": "#include <rclcpp/rclcpp.hpp>\nint main(int argc, char ** argv) {\nrclcpp::init(argc, argv);\n"
    'auto m = std::make_shared<rclcpp::Node>("m"); auto p = m->create_publisher<std_msgs::msg::String>("u", 1);\n}\n',
    "p/launch/l.launch.xml": '<launch><node pkg="p" exec="n" name="x"><param from="$(find-pkg-share p)/launch/y.yaml"/>'
    '</node><node pkg="p" exec="m" name="y"/></launch>\n',
    "p/launch/y.yaml": '"/**":\n  ros__parameters:\n    a: "given"\n',
}
A, B, S, N, M = "p/src/a.cpp", "p/src/b.cpp", "p/scripts/s.py", "p/src/n.cpp", "p/src/m.cpp"


def edited(files: Files, path: str, old: str, new: str) -> Files:
    assert old in files[path]
    return {**files, path: files[path].replace(old, new)}


#: Name, file, text before and after, whether the model is another; what is followed anew. Following A goes through all
#: variables, so that it is followed anew whatever is declared elsewhere. B is not, nor is S but where it is concerned.
EDITS: list[tuple[str, str, str, str, bool, list[str]]] = [
    ("comment at the end", "p/src/work.cpp", "1); }\n", "1); }\n// words\n", False, []),
    ("comment in another", "p/src/unused.cpp", "int", "/* words */ int", False, []),
    ("comment in a Python module", "p/src/lib/topics.py", "def", "# words\ndef", False, []),
    ("literal", "p/src/b.cpp", '"d"', '"e"', True, [B]),
    ("literal in a module", "p/src/lib/topics.py", "'python'", "'other'", True, [S, A]),
    ("macro in a header", "p/src/names.h", '"chatter"', '"other"', True, [A]),
    ("constant that nobody uses", "p/src/more.h", '"more"', '"less"', False, []),
    ("function added", "p/src/unused.cpp", "int", "int more() { return 2; }\nint", False, []),
    ("function removed", "p/src/unused.cpp", "int unused() { return 1; }\n", "", False, []),
    (
        "method removed",
        "p/src/work.cpp",
        "Work::Work(ros::NodeHandle& nh) {",
        "void f(ros::NodeHandle& nh) { ros::Publisher p;",
        True,
        [A],
    ),
    ("class renamed", "p/src/base.h", "class Base", "class Bass", True, [A]),
    ("base changed", "p/src/work.h", ": public Base", ": public Other", True, [A]),
    ("typedef changed", "p/src/work.h", "typedef Work Job", "typedef Other Job", True, [A, B]),
    ("typedef removed", "p/src/work.h", "typedef Work Job;\n", "", True, [A, B]),
    ("include removed", "p/src/work.cpp", '#include "names.h"\n', "", True, [A]),
    ("include removed further off", "p/src/names.h", '#include "more.h"\n', "", False, [A]),
    ("ceases to make something", "p/src/base.h", 'q = nh.advertise<std_msgs::String>("base", 1);', "", True, [A]),
    ("executable without a file", "p/CMakeLists.txt", " src/work.cpp", "", False, [A]),
    ("executable renamed", "p/CMakeLists.txt", "add_executable(b ", "add_executable(c ", True, [B]),
    ("parameter in the launch file", "p/launch/l.launch", "given", "other", True, [B]),
    ("name in the launch file", "p/launch/l.launch", 'name="y"', 'name="w"', True, [B]),
    ("remapping", "p/launch/l.launch", 'name="x"/>', 'name="x"><remap from="chatter" to="c"/></node>', True, [A]),
    ("no parameter", "p/launch/l.launch", '<param name="/t" value="given"/>', "", True, [B]),
    ("node removed", "p/launch/l.launch", '<node pkg="p" type="s.py" name="z"/>', "", True, [S]),
]


@pytest.mark.parametrize(
    ("path", "old", "new", "is_other", "expected"), [e[1:] for e in EDITS], ids=[e[0] for e in EDITS]
)
def test_edits(path: str, old: str, new: str, is_other: bool, expected: list[str], followed: list[str]) -> None:
    calls, is_changed = again(OLDER, edited(OLDER, path, old, new), followed, None)
    assert (is_changed, sorted(set(calls))) == (is_other, expected)


#: Edits of what functions do: file, text before and after, whether the model is another, what is followed anew. Of what
#: is kept the lines are as they are after the edit.
BODIES: list[tuple[str, str, str, str, bool, list[str]]] = [
    ("statement", B, "ros::spin();", 't = "x";\nros::spin();', False, [B]),
    ("unused number", B, "ros::spin();", "int i = 1;\nros::spin();", False, []),
    ("used number", B, "ros::spin();", "int i = 1;\nstd::abs(i);\nros::spin();", False, [B]),
    ("log", B, "ros::spin();", 'ROS_INFO_STREAM("at " << 1 << t);\nros::spin();', False, []),
    ("log of a call", B, "ros::spin();", 'ROS_INFO("%d", next());\nros::spin();', False, [B]),
    ("output", B, "ros::spin();", "std::cout << t.size() << std::endl;\nros::spin();", False, []),
    ("statement in a function of a class", "p/src/work.cpp", "open(nh);", "open(nh); int i = 1;", True, [A]),
    ("statement where nothing looks", "p/src/unused.cpp", "return", "int i = 1;\nreturn", False, []),
    ("call where nothing looks", "p/src/unused.cpp", "return", "other();\nreturn", False, []),
    ("comment above", B, "struct Idle {};", "// words\n// more\nstruct Idle {};", True, []),
    ("comment inside", B, "ros::spin();", "// words\nros::spin();", False, []),
    ("lines above in a header", "p/src/base.h", "class Other {};", "\n\nclass Other {};", True, []),
    ("blanks in a line", B, "std::string t;", "std::string   t;", True, [B]),
    ("line broken in two", B, "std::string t;", "std::string t;\n", True, [B]),
    ("statement in an inline method", "p/src/base.h", "{ q =", "{ int i = 1; q =", True, [A]),
]


@pytest.mark.parametrize(
    ("path", "old", "new", "is_other", "expected"), [e[1:] for e in BODIES], ids=[e[0] for e in BODIES]
)
def test_edits_of_what_functions_do(
    path: str, old: str, new: str, is_other: bool, expected: list[str], followed: list[str]
) -> None:
    calls, is_changed = again(OLDER, edited(OLDER, path, old, new), followed, None)
    assert (is_changed, sorted(set(calls))) == (is_other, expected)


LINKED = {
    "p/launch/l.launch": '<launch><node pkg="p" type="a" name="x"/><node pkg="p" type="b" name="y"/></launch>',
    "p/CMakeLists.txt": CMAKE.format("p")
    + "include_directories(src)\nadd_executable(a src/a.cpp src/work.cpp)\nadd_executable(b src/b.cpp src/work.cpp)\n",
    "p/src/work.h": "#pragma once\n#include <ros/ros.h>\n#include <std_msgs/String.h>\nint sum();\nint count();\nint total;\n"
    "void make(ros::NodeHandle& nh);\n",
    "p/src/work.cpp": '#include "work.h"\nint sum() { return 3; }\nint count() { return 4; }\n'
    'void make(ros::NodeHandle& nh) { static auto p = nh.advertise<std_msgs::String>("made", 1); }\n',
    A: main('auto p = ADV(std::string("a"), sum());', '#include "work.h"\n'),
    B: main('auto call = [&]() { return count(); };\nauto p = ADV(std::string("b"), call());', '#include "work.h"\n'),
}


@pytest.mark.parametrize(
    ("path", "old", "new", "expected"),
    (
        ("p/src/work.cpp", "return 3", "return 5", [A]),
        ("p/src/work.cpp", "return 4", "return 5", [B]),
        ("p/src/work.cpp", "return 4", "total = 0; return 4", [B]),
        ("p/src/work.cpp", "return 4", "int i = 0; return 4", []),
        (B, "return count", "return 1 + count", [B]),
        (B, "return count", "total = 1; return count", [B]),
    ),
)
def test_functions_of_one_library(path: str, old: str, new: str, expected: list[str], followed: list[str]) -> None:
    """Only what has looked up the function that does something else is followed anew."""
    assert sorted(set(again(LINKED, edited(LINKED, path, old, new), followed, None)[0])) == expected


def test_a_function_that_begins_to_make_something_by_a_call(followed: list[str]) -> None:
    """Whoever has asked whether it may make something is concerned, whatever it is called by."""
    calls, is_changed = again(
        LINKED,
        edited(LINKED, "p/src/work.cpp", "int sum() {", "int sum() { ros::NodeHandle nh; make(nh);"),
        followed,
        None,
    )
    assert A in calls and is_changed


def test_functions_that_begin_or_cease_to_make_something(followed: list[str]) -> None:
    """What may make something is known by name; the names that were asked are among those that were looked up."""
    idle = edited(edited(OLDER, B, "struct Idle {};", "void help() {}"), B, "ros::spin();", "help();\nros::spin();")
    making = 'help() { ros::NodeHandle h; static auto s = h.advertise<std_msgs::String>("h", 1); }'
    busy = edited(idle, B, "help() {}", making)
    for before, after in ((idle, busy), (busy, idle)):
        calls, is_changed = again(before, after, followed, None)
        assert (sorted(set(calls)), is_changed) == ([B], True)


READS = main(
    'YAML::Node all = YAML::LoadFile(ros::package::getPath("p") + "/config/a.yaml");\n'
    'auto p = ADV(all["topic"].as<std::string>(), 1);',
    "#include <yaml-cpp/yaml.h>\n#include <ros/package.h>\n",
)
READERS: Files = {**OLDER, B: READS, "p/config/a.yaml": "topic: a\n", "p/config/b.yaml": "topic: b\n"}


@pytest.mark.parametrize(
    ("path", "text", "is_other", "expected"),
    (
        ("p/config/a.yaml", "topic: c\n", True, [B]),
        ("p/config/a.yaml", None, True, [B]),
        ("p/config/b.yaml", "topic: c\n", False, []),
        ("p/config/b.yaml", None, False, []),
        ("p/config/c.yaml", "topic: c\n", False, []),
    ),
)
def test_files_that_a_node_reads(
    path: str, text: str | None, is_other: bool, expected: list[str], followed: list[str]
) -> None:
    """A YAML file that a node reads itself concerns it, and no other one does."""
    after = {**READERS, path: text} if text is not None else {key: READERS[key] for key in READERS if key != path}
    calls, is_changed = again(READERS, after, followed, None)
    assert (is_changed, sorted(set(calls))) == (is_other, expected)


@pytest.mark.parametrize(
    ("path", "old", "new", "is_other", "expected"),
    (
        ("p/src/names.hpp", '"t"', '"x"', True, [N]),
        (M, '"u"', '"x"', True, [M]),
        (M, '"m"', '"x"', False, [M]),  # the launch file renames it
        ("p/launch/y.yaml", "given", "other", True, []),  # the node only passes it on
        ("p/launch/y.yaml", "a:", "b:", True, [N]),
        ("p/launch/y.yaml", '"given"', "1", True, [N]),
        ("p/launch/l.launch.xml", 'name="x"', 'name="w"', True, []),
        ("p/launch/l.launch.xml", 'name="y"/>', 'name="y"><remap from="u" to="w"/></node>', True, [M]),
        ("p/CMakeLists.txt", "EXECUTABLE n", "EXECUTABLE k", True, [N]),  # it is started alone
        ("p/CMakeLists.txt", "SHARED src/n.cpp", "SHARED src/n.cpp src/m.cpp", False, [N]),
    ),
)
def test_edits_of_ros2(path: str, old: str, new: str, is_other: bool, expected: list[str], followed: list[str]) -> None:
    calls, is_changed = again(NEWER, edited(NEWER, path, old, new), followed, 2)
    assert (is_changed, sorted(set(calls))) == (is_other, expected)


@pytest.mark.parametrize("ros", (None, 2))
def test_without_an_edit_nothing_is_followed(ros: int | None, followed: list[str]) -> None:
    files = NEWER if ros == 2 else OLDER
    assert again(files, files, followed, ros) == ([], False)


SCRIPT_2, LAUNCHED = "p/scripts/n.py", "p/launch/m.launch.py"
IMPORTS: Files = {
    "p/CMakeLists.txt": ROS2_CMAKE.format("p")
    + "install(PROGRAMS scripts/n.py DESTINATION lib/${PROJECT_NAME})\nament_auto_package(INSTALL_TO_SHARE launch)\n",
    SCRIPT_2: "#!/usr/bin/env python3\nimport rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
    "class N(Node):\n    def __init__(self):\n        super().__init__('n')\n        self.create_publisher(String, 't', 1)\n"
    "def main():\n    rclpy.init()\n    rclpy.spin(N())\nmain()\n",
    LAUNCHED: "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n"
    "def generate_launch_description():\n    return LaunchDescription([Node(package='p', executable='n.py', name='a')])\n",
}


@pytest.mark.parametrize(
    ("old", "new", "is_other", "expected"),
    (
        ("name='a'", "name='b'", True, []),
        ("import LaunchDescription", "import LaunchDescription  # and more", False, []),
        ("'a')])", "'a')])\n\ndef other():\n    return 1", False, []),
        ("import Node\n", "import Node\n\n\n", True, []),  # what stands below has other lines
        ("import Node\n", "import Node, PushRosNamespace\n", False, []),
        ("from launch_ros.actions", "from launch_ros", True, [SCRIPT_2]),  # another thing of that name
        ("import Node\n", "import Node\n\nclass N: pass\n", True, [SCRIPT_2]),
    ),
)
def test_imports_in_other_files(old: str, new: str, is_other: bool, expected: list[str], followed: list[str]) -> None:
    """Who imports the same name elsewhere is not concerned by what else is there."""
    calls, is_changed = again(IMPORTS, edited(IMPORTS, LAUNCHED, old, new), followed, 2)
    assert (is_changed, sorted(set(calls))) == (is_other, expected)


def test_classes_of_libraries(followed: list[str]) -> None:
    header, user = "p/include/p/tool.hpp", "p/src/u.cpp"
    files = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p")
        + "ament_auto_add_library(l SHARED src/tool.cpp)\nament_auto_add_executable(u src/u.cpp)\nament_auto_package()\n",
        header: "#include <rclcpp/rclcpp.hpp>\nclass Tool { public: Tool(rclcpp::Node & node, int count = 1);\n};\n",
        "p/src/tool.cpp": f"#include <p/tool.hpp>\n{ROS2_HEAD}Tool::Tool(rclcpp::Node & node, int count) {{"
        ' node.create_publisher<String>("t" + std::to_string(count), 1); }\n',
        user: "#include <p/tool.hpp>\nint main(int argc, char ** argv) { rclcpp::init(argc, argv);\n"
        'rclcpp::Node node("u");\n}\n',
    }
    assert "p/Tool (library)" in model(files, Cache(), 2)
    assert again(files, files, followed, 2) == ([], False)
    calls, is_changed = again(files, edited(files, "p/src/tool.cpp", '"t"', '"s"'), followed, 2)
    assert header in calls and is_changed
    assert again(files, edited(files, header, "= 1", "= 2"), followed, 2)[1]
    used = edited(files, user, 'node("u");', 'node("u"); Tool tool(node);')
    for before, after, is_told in ((files, used, False), (used, files, True)):
        assert again(before, after, followed, 2)[1]
        assert ("(library)" in model(after, Cache(), 2)) is is_told


def test_code_that_is_made_of_descriptions_of_parameters(followed: list[str]) -> None:
    description = "p/src/parameters.yaml"
    files = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p")
        + "generate_parameter_library(parameters src/parameters.yaml)\nament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n",
        description: "p:\n  rate: {type: double, default_value: 5.0}\n",
        "p/src/n.cpp": "#include <p/parameters.hpp>\n"
        + ROS2_HEAD
        + "struct Tuned { p::ParamListener listener; int count;\n"
        "void again() { count = 1; listener.refresh_dynamic_parameters(); } };\n"
        'class N : public rclcpp::Node { public: N() : Node("n") { timer_ = create_wall_timer(1s, [this] { tuned_.again(); });'
        ' create_publisher<String>("t", 1); }\nrclcpp::TimerBase::SharedPtr timer_; Tuned tuned_; };\n'
        "int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<N>()); }\n",
    }
    assert again(files, files, followed, 2) == ([], False)
    assert again(files, edited(files, description, "5.0", "6.0"), followed, 2)[0]


@pytest.mark.parametrize("path", ("p/src/new.cpp", "p/src/new.h", "p/src/lib/new.py"))
def test_files_that_come_and_go(path: str, followed: list[str]) -> None:
    """A name may mean something else from then on: all is followed anew."""
    more = {**OLDER, path: "" if path.endswith("py") else "class Other { public: int there; };\n"}
    for before, after in ((OLDER, more), (more, OLDER)):
        calls, _ = again(before, after, followed, None)
        assert sorted(set(calls)) == sorted((A, B, S))


def test_a_file_that_no_program_is_made_of_comes(followed: list[str]) -> None:
    assert again(OLDER, {**OLDER, "p/notes.md": "words"}, followed, None) == ([], False)


ROW = {"call": "help", "args": [0], "makes": [{"kind": "publishers", "name": "row", "type": "std_msgs/String"}]}


@pytest.mark.parametrize(
    ("before", "after"),
    (
        ({}, {"apis": [ROW]}),
        ({"apis": [ROW]}, {}),
        ({"apis": [ROW]}, {"apis": [{**ROW, "makes": [{**ROW["makes"][0], "name": "other"}]}]}),  # type: ignore[index]
    ),
)
def test_rows_of_the_project_file_are_for_all(before: Any, after: Any, followed: list[str]) -> None:
    calls, _ = again(OLDER, OLDER, followed, None, before, after)
    assert sorted(set(calls)) == sorted((A, B, S))


@pytest.mark.parametrize(
    "after", ({"nodes": {"p/a": {"publishers": []}}}, {"configurations": {"c": {"launch": ["p/launch/l.launch"]}}})
)
def test_other_settings_follow_nothing_anew(after: Any, followed: list[str]) -> None:
    calls, _ = again(OLDER, OLDER, followed, None, {}, after)
    assert calls == []


def test_a_branch_and_its_base_have_a_record_each(followed: list[str]) -> None:
    """As a run with ``--baseline-rev`` looks at both, one must not drive out the other."""
    cache, after = Cache(), edited(OLDER, B, '"d"', '"e"')
    base, branch = model(OLDER, cache, None), model(after, cache, None)
    followed.clear()
    assert [model(OLDER, cache, None), model(after, cache, None), model(OLDER, cache, None)] == [base, branch, base]
    assert followed == []


def test_a_new_state_begins_with_the_nearest_record(followed: list[str]) -> None:
    """A branch after another commit is like the branch before, whatever was looked at in between."""
    cache, branch = Cache(), edited(OLDER, B, '"d"', '"e"')
    model(OLDER, cache, None)
    model(branch, cache, None)
    model(edited(OLDER, "p/src/names.h", '"chatter"', '"base"'), cache, None)
    after = edited(branch, "p/src/unused.cpp", "return 1", "return 2")
    followed.clear()
    later = model(after, cache, None)
    assert followed == []
    assert later == model(after, Cache(keeps=False), None)


def test_facts_that_are_gone_void_the_record(followed: list[str]) -> None:
    cache = Cache()
    model(OLDER, cache, None)
    for place in [place for place in cache.kept if place[0] == "facts-cpp"]:
        del cache.kept[place]
    followed.clear()
    after = edited(OLDER, B, '"d"', '"e"')
    assert model(after, cache, None) == model(after, Cache(keeps=False), None)
    assert {A, B, S} <= set(followed)


def values(data: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The ways to all values in *data*."""
    found = [path]
    if isinstance(data, list):
        for number, item in enumerate(data):
            found += values(item, (*path, number))
    return found


def put(data: Any, path: tuple[Any, ...], value: Any) -> Any:
    if not path:
        return value
    made = list(data)
    made[path[0]] = put(data[path[0]], path[1:], value)
    return made


HOSTILE: tuple[Any, ...] = (
    None,
    True,
    -1,
    1 << 70,
    1e308,
    "",
    "\ud800\x1b[31m",
    [],
    {},
    [[]],
    ["t"],
    ["Made"],
    [["t"], 1],
)


@pytest.mark.parametrize("ros", (None, 2))
def test_a_record_with_another_value_anywhere(ros: int | None) -> None:
    """It may be believed where it has the right form, and it never raises; the files' own digests are never another's.

    A run learns of a record its files, what was consulted, and what is read of it: what is equal in these is run once.
    """
    files = NEWER if ros == 2 else OLDER
    cache = Cache()
    model(files, cache, ros)
    ((place, text),) = ((place, cache.kept[place]) for place in cache.records())
    data = json.loads(text)
    ways = values(data)
    seen: set[str] = set()
    for number, value in enumerate(HOSTILE):
        for way in ways[number :: max(1, len(ways) // 60)]:
            planted = put(data, way, value)
            found = kept.begun(planted)
            if found is None:
                continue
            asked: list[Consulted] = []
            taken = kept.read(found, lambda consulted, asked=asked: not asked.append(consulted), {})  # type: ignore[misc]
            assert isinstance(taken, list)
            assert isinstance(kept.read(found, lambda consulted: True, {A: {1: 2}}), list)
            learned = repr((found.files, asked, taken))
            if learned not in seen:
                seen.add(learned)
                model(files, Cache({**cache.kept, place: json.dumps(planted)}), ros)
    assert 100 < len(seen) < 300


#: What a trace and a result look like where they are empty.
PLAIN: list[Any] = ["", "", False, "", "", ["", 0, ""], None, None]
ITEM: list[Any] = [["t"], 0, [], [], [], ["t"], [], []]


@pytest.mark.parametrize(
    "data",
    (
        *(None, 0, True, "", "abc", [], {}, [1, 2, 3, 4], [[], [], [], []][:3], [{}, {}, {}, {}], [[], [], [], [], []]),
        *([[["p", 1]], [], [], []], [[[1, "d"]], [], [], []], [[["p"]], [], [], []], [[], [1], [], []]),
        *([[], [], [trace], []] for trace in ([["", "", True]], [PLAIN[:3]], [[0, *PLAIN[1:]]], [["AAA", *PLAIN[1:]]])),
        *([[], [], [[*PLAIN[:5], view, None, None]], []] for view in (None, [], ["", -1, ""], ["", 0, "AAAAAA=="])),
        *([[], [], [[*PLAIN[:6], some, None]], []] for some in (1, [], ["", "", ""], ["AAAAAA==", "", "", ""])),
        *([[], [], [[*PLAIN[:7], some]], []] for some in (1, "AAAA", "AAAAAA==", "AAAAAAAAAAAAAAAAAAAAAA==")),
        *(
            [[], [], [PLAIN], [item]]
            for item in ([0], [0, "k", ["t"], 0, [], [], [], ["t"]], [1, "k", *ITEM], [0, [], *ITEM])
        ),
        json.loads("[" * 500 + "]" * 500),
    ),
)
def test_planted_records_change_nothing(data: Any) -> None:
    cache = Cache()
    expected = model(OLDER, cache, None)
    (place,) = cache.records()
    cache.kept[place] = json.dumps(data)
    assert model(OLDER, cache, None) == expected


HERE = Location("p/a.cpp", 1)
NODE = RosNode("/n", "/", "/", "node", "N", HERE, rules=(RemappingRule("", "a", "b"),))
MADE = MadeEntity("publishers", "/t", "std_msgs/String", HERE, (), value=[1, {"a": (1.5, None)}])


@pytest.mark.parametrize("value", (NODE, MADE, Known([True, 1, 1.0, "x"]), (1, [2, {"a": HERE}]), None))
def test_what_is_kept_comes_back(value: Any) -> None:
    found = kept_json.from_json(json.loads(json.dumps(kept_json.to_json(value))))
    assert repr(found) == repr(value)


@pytest.mark.parametrize("value", (object(), {1: 2}, {"a": {3}}, Known(b"x"), Known(object()), [lambda: 1]))
def test_what_cannot_be_kept(value: Any) -> None:
    with pytest.raises(kept_json.Unfit):
        kept_json.to_json(value)


def deep(make: Callable[[Any], Any]) -> Any:
    found: Any = []
    for _ in range(200):
        found = make(found)
    return found


def test_what_is_too_deep_is_not_kept() -> None:
    with pytest.raises(kept_json.Unfit):
        kept_json.to_json(deep(lambda inner: [inner]))
    with pytest.raises(kept_json.Unfit):
        kept_json.from_json(deep(lambda inner: ["l", inner]))


def test_includes_of_files_that_a_node_can_reach(followed: list[str]) -> None:
    """Which functions are within reach decides what may make something, even where no name of the file is looked up."""
    files = {
        **edited(NEWER, N, '#include "names.hpp"', '#include "names.hpp"\n#include "q/q.hpp"'),
        "q/CMakeLists.txt": ROS2_CMAKE.format("q") + "ament_auto_add_library(q src/q.cpp)\nament_auto_package()\n",
        "q/include/q/q.hpp": "#pragma once\nint q();\n",
        "q/src/q.cpp": '#include "q/q.hpp"\nint q() { return 1; }\n',
        "r/CMakeLists.txt": ROS2_CMAKE.format("r") + "ament_auto_add_library(r src/r.cpp)\nament_auto_package()\n",
        "r/include/r/r.hpp": "#pragma once\nint r();\n",
        "r/src/r.cpp": '#include "r/r.hpp"\nint r() { return 1; }\n',
    }
    more = edited(files, "q/src/q.cpp", "int q", '#include "r/r.hpp"\nint q')
    for before, after in ((files, more), (more, files)):
        calls, is_changed = again(before, after, followed, 2)
        assert N in calls and not is_changed


TREE = '<root BTCPP_format="4"><BehaviorTree ID="Main"><Say topic="a"/></BehaviorTree></root>'
SAID = """#include "behaviortree_cpp/bt_factory.h"
class Say : public BT::SyncActionNode {
public:
  Say(const std::string & name, const BT::NodeConfig & conf, rclcpp::Node::SharedPtr node)
  : BT::SyncActionNode(name, conf) {
    std::string topic; getInput("topic", topic);
    node->create_publisher<std_msgs::msg::String>(topic, 1);
  }
};
"""


def test_files_of_behaviour_trees(followed: list[str]) -> None:
    """What makes trees is followed anew where one of them has changed, come or gone; all else is not."""
    body = (
        'BT::BehaviorTreeFactory factory; factory.registerNodeType<Say>("Say", m);\nfactory.createTreeFromFile(%s);\n}'
    )
    for file, paths, times in (
        ('ament_index_cpp::get_package_share_directory("p") + "/tree.xml"', ("p/tree.xml",), 2),
        ("argv[1]", ("p/tree.xml", "p/other.xml"), 3),
    ):
        text = "#include <rclcpp/rclcpp.hpp>\n" + SAID + NEWER[M].partition("\n")[2].replace("}", body % file)
        files = {**NEWER, M: text, "p/tree.xml": TREE}
        for path in paths:
            after = {**files, path: TREE.replace('"a"', '"b"')}
            assert again(files, after, followed, 2) == (
                [M] * times,
                True,
            )  # as it is started, alone, and with all trees where it needs them
        assert again(files, edited(files, "p/src/names.hpp", '"t"', '"x"'), followed, 2) == ([N], True)


#: A header's macro that makes something, which a file sees over another header.
OF_MACRO: Files = {
    "p/CMakeLists.txt": CMAKE.format("p") + "include_directories(src)\nadd_executable(a src/a.cpp)\n",
    "p/src/a.cpp": main('auto p = MADE("a");', '#include "all.h"\n'),
    "p/src/all.h": '#include "made.h"\n',
    "p/src/made.h": "#define MADE(n) nh.advertise<std_msgs::String>(n, 1)\n",
}


@pytest.mark.parametrize(
    ("path", "text", "is_other"),
    [
        ("p/src/made.h", "#define MADE(n) nh.advertise<std_msgs::String>(n, 2)\n", True),
        ("p/src/all.h", "\n", True),
        ("p/src/made.h", OF_MACRO["p/src/made.h"] + "#define MADE(n) nh.advertise<std_msgs::String>(n, 2)\n", True),
        ("p/src/made.h", "// as it was\n" + OF_MACRO["p/src/made.h"], False),
        ("p/src/all.h", OF_MACRO["p/src/all.h"] + '#include "other.h"\n', False),
    ],
)
def test_a_macro_of_a_header_is_another(path: str, text: str, is_other: bool, followed: list[str]) -> None:
    """The file that uses it is the same, and its program is not."""
    _, changed = again(OF_MACRO, {**OF_MACRO, path: text}, followed, None)
    assert changed is is_other
