# SPDX-License-Identifier: Apache-2.0
"""``model --coverage``: which calls of ROS APIs the code has, and what the model says of each."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from commandline import write

from haros_ci.analysis.coverage import too_little
from haros_ci.analysis.coverage_nodes import Users
from haros_ci.cli import main
from haros_ci.coverage.blanked import blanked
from haros_ci.coverage.names import Names, names_of
from haros_ci.coverage.search import calls_in, shown
from haros_ci.extract.apis.tables import rows
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.index.index import Source
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node
from haros_ci.model.coverage import OPEN, Coverage, Site, counted
from haros_ci.model.location import Location
from haros_ci.report import coverage_text
from haros_ci.report.coverage_text import percent

ROS2 = names_of(rows("cpp", 2))
ROS1 = names_of(rows("cpp", 1))
RCLPY = names_of(rows("python", 2))
ROSPY = names_of(rows("python", 1))


def found(text: str, names: Names, language: str = "cpp") -> list[str]:
    """The texts of the calls that are found."""
    return [shown(text, call) for call in calls_in(blanked(text, language), names, language)]


@pytest.mark.parametrize(
    ("text", "names", "call"),
    [
        ('void f() { nh.advertise<Lamp>("lamp", 1); }', ROS1, 'nh.advertise<Lamp>("lamp", 1)'),
        ('p = nh_->subscribe("a", 1, &C::m, this);', ROS1, 'nh_->subscribe("a", 1, &C::m, this)'),
        (
            'x = get().node()\n  ->create_publisher<A::B<C>>(\n  "a", 1);',
            ROS2,
            'get().node() ->create_publisher<A::B<C>>( "a", 1)',
        ),
        ('declare_parameter("rate", 5);', ROS2, 'declare_parameter("rate", 5)'),
        ('return declare_parameter("rate", 5);', ROS2, 'declare_parameter("rate", 5)'),
        ('#endif\n  declare_parameter("rate", 5);', ROS2, 'declare_parameter("rate", 5)'),
        ('if (a && getParam("x", y)) {}', ROS1, 'getParam("x", y)'),
        ('ros::param::get("/x", y);', ROS1, 'ros::param::get("/x", y)'),
        ("#define P(n) nh.param(n, n##_, 1)", ROS1, "nh.param(n, n##_, 1)"),
        (
            'rclcpp_action::create_server<A>(this, "a", h, c, d);',
            ROS2,
            'rclcpp_action::create_server<A>(this, "a", h, c, d)',
        ),
        (
            'message_filters::Subscriber<Lamp> lamp(nh, "lamp", 1);',
            ROS1,
            'message_filters::Subscriber<Lamp> lamp(nh, "lamp", 1)',
        ),
        (
            "l = std::make_shared<tf2_ros::TransformListener>(*b);",
            ROS2,
            "std::make_shared<tf2_ros::TransformListener>(*b)",
        ),
        ('auto s = R"x(")x"; nh.setParam("a", 1);', ROS1, 'nh.setParam("a", 1)'),
    ],
)
def test_a_call_is_found(text: str, names: Names, call: str) -> None:
    assert found(text, names) == [call]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ('// nh.advertise<Lamp>("lamp", 1);', ROS1),
        ('/* nh.advertise<Lamp>(\n"lamp", 1); */', ROS1),
        ('puts("nh.advertise(1)");', ROS1),
        ('auto s = R"x(nh.setParam("a", 1);)x";', ROS1),
        ("bool getParam(const std::string & name);", ROS1),
        ("void Lamp::subscribe(int a) { }", ROS1),
        ("std::vector<int> Lamp::declare_parameter(int a) { }", ROS2),
        ("const std::string & get_parameter(int a);", ROS2),
        ("signal.subscribe();", ROS1),
        ("nh.advertise_all(1);", ROS1),
        ("map.get(1);", ROS1),
        ("publisher.publish(message);", ROS2),
        ("message_filters::Subscriber<Lamp> lamp;", ROS1),
        ("void f(tf2_ros::TransformListener & l);", ROS2),
        ("auto f = &Lamp::subscribe;", ROS1),
    ],
)
def test_what_is_no_call_is_not_found(text: str, names: Names) -> None:
    assert found(text, names) == []


def test_python_is_searched_like_it() -> None:
    text = (
        "import rospy\nrospy.Publisher('a', A)  # rospy.Publisher('b', B)\n'''rospy.Publisher('c', C)'''\n"
        "def get_param(name): pass\nx = self.node.get_param('~a', f(1))\nclass Subscriber(object): pass\n"
    )
    assert found(text, ROSPY, "python") == ["rospy.Publisher('a', A)", "self.node.get_param('~a', f(1))"]
    assert found("self.create_timer(1, f)\nself.create_publisher(A, 'a', 1)\n", RCLPY, "python") == [
        "self.create_publisher(A, 'a', 1)"
    ]


def test_blanks_stand_where_comments_and_texts_stood() -> None:
    text = "a(\"x//y\", '\"'); // b\nc(1'000); /* d\n e */ f"
    bare = blanked(text, "cpp")
    assert len(bare) == len(text)
    assert bare.split() == ['a("', '",', "'", "');", "c(1'000);", "f"]


MANIFEST = (
    "<package format='3'><name>{name}</name><version>1.0.0</version><description>x</description>"
    "<maintainer email='a@b.c'>a</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>"
    "<depend>rclcpp</depend><export><build_type>ament_cmake</build_type></export></package>"
)
CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(lamp)\nfind_package(ament_cmake REQUIRED)\nfind_package(rclcpp REQUIRED)\n"
    "add_executable(lamp src/lamp.cpp)\ninstall(TARGETS lamp DESTINATION lib/lamp)\nament_package()\n"
)
LAMP = """#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/bool.hpp"

struct Register { void subscribe(const char * name, int size) { (void)name; (void)size; } };

class Spare : public rclcpp::Node
{
public:
  Spare() : Node("spare") { create_publisher<std_msgs::msg::Bool>("spare", 1); }
};

class Lamp : public rclcpp::Node
{
public:
  Lamp() : Node("lamp")
  {
    light_ = create_publisher<std_msgs::msg::Bool>("light", 1);
    declare_parameter("rate", 5);
    register_.subscribe("a", 1);
  }
  void never() { declare_parameter("never", 5); }

private:
  Register register_;
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr light_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Lamp>());
}
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    write(
        tmp_path,
        {
            "src/lamp/package.xml": MANIFEST.format(name="lamp"),
            "src/lamp/CMakeLists.txt": CMAKE,
            "src/lamp/src/lamp.cpp": LAMP,
            "src/lamp/src/old.cpp": LAMP.replace("Lamp", "Old"),
            "src/lamp/test/test_lamp.cpp": 'void f(rclcpp::Node & n) { n.declare_parameter("x", 1); }',
        },
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


def sites(capsys: pytest.CaptureFixture[str]) -> list[Site]:
    assert main(["model", "--no-cache", "--coverage", "--format", "json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema_version"] == 1
    return [
        Site(
            **{
                **each,
                "reason": each["reason"] or "",
                "detail": each["detail"] or "",
                "package": each["package"] or "",
                "node_types": tuple(each["node_types"]),
            }
        )
        for each in document["sites"]
    ]


def test_each_call_is_accounted_for_with_a_reason(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    every = [
        (site.line, site.state, site.reason, site.detail) for site in sites(capsys) if site.path.endswith("/lamp.cpp")
    ]
    assert every == [
        (9, "unreached", "the class is never made", "Spare (Node)"),
        (17, "endpoint", "", ""),
        (18, "endpoint", "", ""),
        (19, "other", "a function of the workspace", "Register::subscribe at src/lamp/src/lamp.cpp:4:24"),
        (21, "unreached", "the function is never called", "Lamp::never"),
    ]


@pytest.mark.parametrize(
    "call",
    [
        'create_publisher<\nstd_msgs::msg::Bool>(\n"light", 1);',
        'message_filters::Subscriber<std_msgs::msg::Bool>\n  light(this,\n  "light");',
        'message_filters::Subscriber<\n  std_msgs::msg::Bool> light(\n  this, "light");',
    ],
)
def test_a_call_over_several_lines_is_one(workspace: Path, capsys: pytest.CaptureFixture[str], call: str) -> None:
    code = LAMP.replace('declare_parameter("rate", 5);', call)
    write(workspace, {"src/lamp/src/lamp.cpp": code})
    assert [site.state for site in sites(capsys) if site.path.endswith("/lamp.cpp")].count("endpoint") == 2


def test_files_without_a_target_and_tests_are_told_apart(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = sites(capsys)
    old = {(each.state, each.reason) for each in found if each.path.endswith("old.cpp")}
    assert ("unreached", "the file is in no target") in old and OPEN not in {state for state, _ in old}
    (test,) = [each for each in found if each.area == "test"]
    assert (test.state, test.reason) == ("unreached", "code of a test")


def test_the_table_has_a_line_for_each_package(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["model", "--no-cache", "--coverage"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["package", "sites", "endpoints", "no", "API", "unreached", "missing", "accounted"]
    assert lines[1].split() == ["lamp", "10", "2", "2", "6", "0", "100.0%"]
    assert lines[2].split() == ["lamp", "(tests)", "1", "0", "0", "1", "0", "100.0%"]


PLUGIN = """#include "acme/tool.hpp"
namespace lamp {
class Dimmer : public acme::Tool
{
  void start(rclcpp::Node & node) override { node.declare_parameter("level", 1); }
};
}
PLUGINLIB_EXPORT_CLASS(lamp::Dimmer, acme::Tool)
"""
DESCRIPTION = '<library path="dimmer"><class type="lamp::Dimmer" base_class_type="acme::Tool"/></library>'


SIMULATED = PLUGIN.replace("PLUGINLIB_EXPORT_CLASS(lamp::Dimmer, acme::Tool)", "GZ_REGISTER_MODEL_PLUGIN(lamp::Dimmer)")


@pytest.mark.parametrize(
    ("code", "named", "state", "reason", "detail"),
    [
        (PLUGIN, "tools: []", "endpoint", "", ""),
        (SIMULATED, "tools: [libdimmer.so, dimmer]", "open", "in a plug-in", "the simulator"),
        (SIMULATED, "tools: []", "unreached", "a plug-in that nothing in the workspace loads", "the simulator"),
    ],
)
def test_a_plugin_is_followed_or_missing_where_a_file_names_it(
    workspace: Path, capsys: pytest.CaptureFixture[str], code: str, named: str, state: str, reason: str, detail: str
) -> None:
    write(
        workspace / "src/lamp",
        {
            "CMakeLists.txt": CMAKE.replace("install(", "add_library(dimmer SHARED src/dimmer.cpp)\ninstall("),
            "package.xml": MANIFEST.format(name="lamp").replace(
                "<export>", '<export><acme plugin="${prefix}/plugins.xml"/>'
            ),
            "plugins.xml": DESCRIPTION if code is PLUGIN else "<library path='other'/>",
            "src/dimmer.cpp": code,
            "config/tools.yaml": f"{named}\n",
        },
    )
    (found,) = [site for site in sites(capsys) if site.path.endswith("dimmer.cpp")]
    assert (found.line, found.call) == (5, 'node.declare_parameter("level", 1)')
    assert (found.state, found.reason) == (state, reason) and detail in found.detail


@pytest.mark.parametrize(
    ("call", "before", "state", "reason"),
    [
        ('vk::getParam("rate", 5);', "", "other", "a function of a library that is not here"),
        ('getParam(config, "rate");', "bool getParam(int & a, const char * b);", "other", "called without a node"),
        ('getParam(config, "rate");', "", "other", "called without a node"),
        ('ros2::get_parameter(config, "rate");', "", "open", ""),
        ('config.getParam("rate", 5);', "", "open", ""),
    ],
)
def test_functions_that_are_no_methods_of_a_node(
    workspace: Path, capsys: pytest.CaptureFixture[str], call: str, before: str, state: str, reason: str
) -> None:
    code = f"{before}\nint main() {{ int config = 0; if (rand() > 5) {{ {call} }} return config; }}\n"
    files = {
        "src/lamp/src/lamp.cpp": code,
        "src/lamp/package.xml": MANIFEST.format(name="lamp")
        .replace("ament_cmake", "catkin")
        .replace("rclcpp", "roscpp"),
    }
    write(workspace, {name: text.replace("get_parameter(", "getParam(") for name, text in files.items()})
    (found,) = [site for site in sites(capsys) if site.path.endswith("/lamp.cpp")]
    assert found.state == state and reason in found.reason


def test_copies_of_other_projects_are_no_calls(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "inline void go(Source & source) { source.declare_parameter(1); }\n"
    write(
        workspace / "src/lamp",
        {
            "third_party/rx/rx.hpp": text,
            "src/lamp.cpp": LAMP.replace(
                "int main(", '#include "../third_party/rx/rx.hpp"\nvoid all() { go(1); }\nint main('
            ),
        },
    )
    (found,) = [site for site in sites(capsys) if site.path.endswith("rx.hpp")]
    assert found.state in ("other", "unreached")


@pytest.mark.parametrize(("package", "state"), [("image_transport", "other"), ("acme_transport", "open")])
def test_calls_of_a_library_that_the_rows_describe_are_no_calls(
    package: str, state: str, workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    header = (
        "namespace image_transport {\nclass Publisher : public Base { public:\n"
        '  void make(rclcpp::Node * node) { node->create_publisher<std_msgs::msg::Bool>("raw", 1); }\n};\n'
        'Publisher create_publisher(rclcpp::Node * node) { node->declare_parameter("plugins", 1); return Publisher(); }\n}\n'
    )
    write(
        workspace / "src" / package,
        {
            "package.xml": MANIFEST.format(name=package),
            "CMakeLists.txt": CMAKE.replace("lamp", package).replace("add_executable", "add_library"),
            f"src/{package}.cpp": header,
        },
    )
    found = [site for site in sites(capsys) if site.package == package]
    assert len(found) == 2 and {site.state for site in found} == {state}
    assert {site.reason for site in found} == {"in a library that the API rows describe"} or state != "other"


def test_the_summary_of_a_check_says_a_small_share(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = " of ROS APIs in production code"
    command = ["check", "--no-cache", "--profile", "architecture"]
    assert main(command) in (0, 1)
    assert said not in capsys.readouterr().out
    more = "\n".join(f'node.declare_parameter("level{number}", 1);' for number in range(9))
    write(
        workspace / "src/lamp",
        {
            "CMakeLists.txt": CMAKE.replace("install(", "add_library(dimmer SHARED src/dimmer.cpp)\ninstall("),
            "src/dimmer.cpp": PLUGIN.replace("node.declare_parameter", f"{more}\nnode.declare_parameter").partition(
                "PLUGINLIB"
            )[0],
            "config/tools.yaml": "tools: [lamp::Dimmer]\n",
        },
    )
    assert main(command) in (0, 1)
    assert f"10 of 20 calls{said} (50%) are understood" in capsys.readouterr().out


def test_other_formats_are_refused(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["model", "--coverage", "--format", "dot"]) == 2
    assert "--coverage is text or json" in capsys.readouterr().err


HIDDEN = """
class Dimmer : public rclcpp::Node
{
public:
  Dimmer() : Node("dimmer")
  {
    light_ = create_publisher<std_msgs::msg::Bool>("light", 1);
    table_.at(which())(this);
  }
  static void add(Dimmer * dimmer) { dimmer->create_publisher<std_msgs::msg::Bool>("more", 1); }
  int which();
  std::map<int, void (*)(Dimmer *)> table_ = make_table(&Dimmer::add);
};
"""


def test_a_missing_call_makes_the_nodes_incomplete_whose_code_it_stands_in() -> None:
    source = Source("a.cpp", "a", read_cpp(HIDDEN + "void other() {}\n"))
    end = Endpoint(
        kind="publishers", name="/light", original_name="/light", type=None, location=Location("a.cpp", 7, 5)
    )
    node = Node(name="/dimmer", kind="node", package="a", type="dimmer", endpoints=(end,))
    users = Users(Architecture(configurations=(Configuration(name="a", nodes=(node,)),)), (source,))
    assert users.of("a.cpp", 8) == users.of("a.cpp", 10) == users.of("a.cpp", 15) == ("a/dimmer",)
    assert users.of("b.cpp", 8) == ()


def test_of_two_nodes_of_a_file_the_one_whose_class_it_is_is_incomplete() -> None:
    code = "struct A { void a() {}\nvoid b() {} };\nstruct B { void a() {}\nvoid b() {} };\n"
    nodes = tuple(
        Node(name=f"/{name}", kind="node", package="p", type=name, endpoints=(end_at(line),))
        for name, line in (("a", 1), ("b", 3))
    )
    found = Architecture(configurations=(Configuration(name="p", nodes=nodes),))
    users = Users(found, (Source("a.cpp", "p", read_cpp(code)),))
    assert [users.of("a.cpp", line) for line in (1, 2, 3, 4)] == [("p/a",), ("p/a",), ("p/b",), ("p/b",)]


def end_at(line: int) -> Endpoint:
    return Endpoint(kind="publishers", name="/x", original_name="/x", type=None, location=Location("a.cpp", line, 1))


def test_incomplete_node_types_are_counted() -> None:
    sites = (
        replace(site(OPEN), node_types=("a/x", "a/y")),
        replace(site(OPEN), node_types=("a/x",)),
        replace(site(OPEN, "test"), node_types=("a/z",)),
        site("endpoint"),
    )
    assert Coverage(sites=sites).incomplete() == {"a/x": 2, "a/y": 1}
    assert coverage_text.render(Coverage(sites=sites)).splitlines()[-2:] == ["      2  a/x", "      1  a/y"]
    assert "incomplete" not in coverage_text.render(Coverage(sites=sites[-1:]))


def site(state: str, area: str = "production") -> Site:
    return Site(path="a.cpp", line=1, column=1, name="f", call="f(1)", package="a", area=area, state=state)


def test_too_little_is_said_of_production_code_alone() -> None:
    many = tuple(site("endpoint") for _ in range(9))
    assert too_little(Coverage(sites=(*many, site(OPEN)))) == ()
    assert too_little(Coverage(sites=(*many, site("endpoint"), *(site(OPEN, "test") for _ in range(9))))) == ()
    assert too_little(Coverage()) == ()
    (said,) = too_little(Coverage(sites=(*many[1:], site(OPEN))))
    assert said.startswith("8 of 9 calls of ROS APIs in production code (88%) are understood: ")
    assert "at the other 1 are not reported" in said and "manifests, builds" in said


def test_shares_are_rounded_down() -> None:
    assert percent(counted([site("other")] * 9999 + [site(OPEN)]).share) == "99.9%"
    assert (percent(1.0), percent(None), percent(0.0)) == ("100.0%", "-", "0.0%")


@pytest.mark.parametrize(
    "option", [["--configuration", "lamp/lamp"], ["--as-running"], ["--expect", "lamp.yaml"], ["--check-readme"]]
)
def test_options_that_have_no_say_in_it_are_refused(
    workspace: Path, capsys: pytest.CaptureFixture[str], option: list[str]
) -> None:
    assert main(["model", "--no-cache", "--coverage", *option]) == 2
    said = capsys.readouterr()
    assert (
        f"--coverage is about the code of the whole workspace, so {option[0]} has no say" in said.err and not said.out
    )


@pytest.mark.parametrize(
    ("imports", "states"),
    [
        ("from lamp.parts.light import Light", {"lamp/light.py": "unreached", "lamp/parts/light.py": "open"}),
        ("from .parts.light import *", {"lamp/light.py": "unreached", "lamp/parts/light.py": "open"}),
        (
            "from lamp.parts import light\nfrom lamp.light import Light",
            {"lamp/light.py": "open", "lamp/parts/light.py": "open"},
        ),
    ],
)
def test_of_modules_of_one_name_those_run_that_are_imported(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    imports: str,
    states: dict[str, str],
) -> None:
    light = "import rclpy\nclass Light:\n    def __init__(self, host):\n        host.create_publisher(1, 'a', 1)\n"
    write(
        tmp_path,
        {
            "package.xml": MANIFEST.format(name="lamp")
            .replace("ament_cmake", "ament_python")
            .replace("rclcpp", "rclpy"),
            "setup.py": "from setuptools import setup\nsetup(name='lamp', packages=['lamp', 'lamp.parts'], "
            "entry_points={'console_scripts': ['lamp = lamp.main:main']})\n",
            "lamp/__init__.py": "",
            "lamp/parts/__init__.py": "",
            "lamp/light.py": light,
            "lamp/parts/light.py": light,
            "lamp/main.py": f"{imports}\nimport other\ndef main():\n    for one in other.all({{'Light': 1}}):\n        getattr(one, 'x')(Light)\n",
        },
    )
    monkeypatch.chdir(tmp_path)
    assert {each.path: each.state for each in sites(capsys) if each.path in states} == states


TOOL = (
    "#!/usr/bin/env python3\nimport rclpy\nclass Tool:\n    def __init__(self, host):\n        host.create_publisher(1, 'a', 1)\n"
    "if __name__ == '__main__':\n    Tool(1)\n"
)


@pytest.mark.parametrize(
    ("more", "state"),
    [
        ({}, "unreached"),
        ({"lamp/tool.py": TOOL.partition("if __name__")[0]}, "unreached"),
        ({"launch/a.launch.py": "cmd = ['python3', 'lamp/tool.py']\n"}, "open"),
        ({"run.sh": "#!/bin/sh\npython3 lamp/tool.py\n"}, "open"),
        ({"lamp/main.py": "from lamp.tool import Tool\nimport other\ndef main():\n    other.go(Tool)\n"}, "open"),
    ],
)
def test_a_script_that_ros2_run_does_not_find_is_run_by_whoever_names_it(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    more: dict[str, str],
    state: str,
) -> None:
    manifest = MANIFEST.format(name="lamp").replace("ament_cmake", "ament_python").replace("rclcpp", "rclpy")
    files = {
        "package.xml": manifest,
        "setup.py": "from setuptools import setup\nsetup(name='lamp', packages=['lamp'], "
        "entry_points={'console_scripts': ['lamp = lamp.main:main']})\n",
        "lamp/__init__.py": "",
        "lamp/main.py": "def main():\n    pass\n",
        "lamp/tool.py": TOOL,
    }
    write(tmp_path, files | more)
    monkeypatch.chdir(tmp_path)
    assert [each.state for each in sites(capsys) if each.path == "lamp/tool.py"] == [state]


def test_what_cpp_mentions_runs_no_python_and_what_python_mentions_no_cpp(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A plug-in in C++ and the Python class that talks to it have names in common; a property that nothing reads is not run by that."""
    plugin = (
        "class LampPlugin : public acme::Plugin\n{\n  void go(rclcpp::Node & n) { pub_dim(); idle(); }\n"
        '  void idle() {}\n  void spare(rclcpp::Node & n) { n.declare_parameter("spare", 1); }\n};\n'
    )
    script = (
        "#!/usr/bin/env python3\nimport rclpy\nfrom functools import cached_property\nfrom std_msgs.msg import Bool\n"
        "class LampPlugin:\n    def __init__(self, node):\n        self.node = node\n"
        "    @cached_property\n    def pub_light(self):\n        return self.node.create_publisher(Bool, 'light', 1)\n"
        "    @cached_property\n    def pub_dim(self):\n        return self.node.create_publisher(Bool, 'dim', 1)\n"
        "class Client(rclpy.node.Node):\n    @cached_property\n    def lamp(self):\n        return LampPlugin(self)\n"
        "if __name__ == '__main__':\n    rclpy.init()\n    Client('c').lamp.pub_light.publish(Bool())\n    spare()\n"
    )
    write(
        workspace / "src/lamp",
        {
            "scripts/client.py": script,
            "src/plugin.cpp": plugin,
            "CMakeLists.txt": CMAKE.replace(
                "install(",
                "add_library(plugin src/plugin.cpp)\ninstall(PROGRAMS scripts/client.py DESTINATION lib/lamp)\ninstall(",
                1,
            ),
        },
    )
    found = {(site.path.rpartition("/")[2], site.call): (site.state, site.reason) for site in sites(capsys)}
    assert found["client.py", "self.node.create_publisher(Bool, 'light', 1)"] == ("endpoint", "")
    assert found["client.py", "self.node.create_publisher(Bool, 'dim', 1)"] == (
        "unreached",
        "the function is never called",
    )
    assert found["plugin.cpp", 'n.declare_parameter("spare", 1)'][0] == "unreached"


@pytest.mark.parametrize(
    ("decorator", "state"),
    [
        ("@now\n", "open"),
        ("@now()\n", "open"),
        ("@other.now\n", "open"),
        ("@cached\n", "unreached"),
        ("@functools.lru_cache(None)\n", "unreached"),
        ("", "unreached"),
    ],
)
def test_a_decorator_of_the_workspace_may_call_what_it_is_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], decorator: str, state: str
) -> None:
    script = (
        "#!/usr/bin/env python3\nimport functools\nimport rclpy\nfrom helpers import cached, other\n\n\ndef now(f):\n    f(NODE)\n    return f\n\n\n"
        f"{decorator}def spare(node):\n    node.create_publisher(1, 'a', 1)\n\n\nrclpy.init()\nNODE = rclpy.create_node('n')\n"
    )
    write(
        tmp_path,
        {
            "package.xml": MANIFEST.format(name="lamp").replace("rclcpp", "rclpy"),
            "CMakeLists.txt": "project(lamp)\ninstall(PROGRAMS a.py DESTINATION lib/lamp)\n",
            "a.py": script,
        },
    )
    monkeypatch.chdir(tmp_path)
    assert [each.state for each in sites(capsys) if each.call.startswith("node.")] == [state]


@pytest.mark.parametrize(
    ("build", "states"),
    [
        (None, {("unreached", "the file is in no target")}),
        ("CMakeLists.txt", {("endpoint", "")}),
        ("Makefile", {("open", "nothing of the function is in the model")}),
    ],
)
def test_a_package_without_a_build_file_compiles_nothing(
    workspace: Path, capsys: pytest.CaptureFixture[str], build: str | None, states: set[tuple[str, str]]
) -> None:
    main = '#include <rclcpp/rclcpp.hpp>\nint main(int argc, char** argv) {\n  rclcpp::init(argc, argv);\n  auto node = rclcpp::Node::make_shared("n");\n'
    files = {
        "src/bare/package.xml": "<package format='3'><name>bare</name><depend>rclcpp</depend><export><build_type>ament_cmake</build_type></export></package>\n",
        "src/bare/src/bare.cpp": f'{main}  auto p = node->create_publisher<std_msgs::msg::Bool>("b", 1);\n  rclcpp::spin(node);\n}}\n',
    }
    if build is not None:
        files[f"src/bare/{build}"] = "project(bare)\nadd_executable(bare src/bare.cpp)\n"
    write(workspace, files)
    found = {(site.state, site.reason) for site in sites(capsys) if site.path.endswith("bare.cpp")}
    assert found == states


def test_a_program_in_no_package_is_missing_for_that_reason(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = "import rclpy\n\n\ndef main():\n    rclpy.init()\n    n = rclpy.create_node('n')\n    n.create_publisher(Bool, 'b', 1)\n\n\nmain()\n"
    write(workspace, {"tools/t.py": program})
    (site,) = [site for site in sites(capsys) if site.path == "tools/t.py"]
    assert (site.state, site.reason, site.detail) == ("open", "the file lies in no package", "main")
