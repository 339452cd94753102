# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model`` on hostile workspaces and caches: it ends, says what it could not read, and keeps the rest."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from commandline import haros, write

from haros_ci.syntax import Function

GOOD = {
    "good/package.xml": '<package format="2"><name>good</name><version>1.0.0</version></package>',
    "good/CMakeLists.txt": "project(good)\nadd_executable(talker src/talker.cpp)\n",
    "good/src/talker.cpp": """#include <ros/ros.h>
int main(int argc, char** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle nh;
  ros::Publisher out = nh.advertise<std_msgs::String>("chatter", 1);
}
""",
}
EVIL = "a`$(touch x)\u202e</script>\n::error::b"
PACKAGE = (
    '<package format="3"><name>bad</name><version>1.0.0</version><export><build_type>{}</build_type></export></package>'
)
SETUP = "from setuptools import setup\nsetup(name='bad', packages=['bad'], entry_points={'console_scripts': ['n = bad.n:main']})\n"


def diamonds(form: str, first: str, last: str, heads: str = "", ways: int = 8) -> str:
    """A program with forty classes, of which those that follow have the eight before as their bases: 8**39 ways lead up."""
    classes = [
        form.format(n, ", ".join(f"{heads}C{m}" for m in reversed(range(max(0, n - ways), n)))) for n in range(1, 40)
    ]
    return "\n".join((first, *classes, last))


def of_python(base: str, last: str, imports: str = "") -> dict[str, str]:
    first = f"import rclpy\nfrom rclpy.node import Node\n{imports}\nclass C0({base}):\n    a: str = 'x'\n"
    return {
        "bad/package.xml": PACKAGE.format("ament_python"),
        "bad/setup.py": SETUP,
        "bad/resource/bad": "",
        "bad/bad/__init__.py": "",
        "bad/bad/n.py": diamonds("class C{0}({1}):\n    pass", first, f"def main():\n    rclpy.init()\n{last}"),
    }


def of_cpp(first: str, last: str, heads: str = "public ") -> dict[str, str]:
    first = "#include <ros/ros.h>\n" + first
    return {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/CMakeLists.txt": "project(bad)\nadd_executable(n src/n.cpp)\n",
        "bad/src/n.cpp": diamonds("class C{0} : {1} {{ public: C{0}() {{}} }};", first, last, heads),
    }


OF_NODE = 'class C0 { public: C0() { p_ = h_.advertise<std_msgs::String>("x", 1); } virtual void f(); ros::NodeHandle h_; ros::Publisher p_; };'
RUN = 'int main(int c, char** v) { ros::init(c, v, "n"); C39 n; n.f(); n.absent(); C39::g(); f(n); n.m = C39::k; C0 o = n; ros::spin(); }'
CASES: dict[str, dict[str, str]] = {
    "diamonds of nodes": of_python("Node", "    n = C39('n')\n    n.absent()\n    n.a\n    rclpy.spin(n)\n"),
    "diamonds of a library": of_python("outside.Thing", "    C39(Node('n')).a\n    C39.b\n", "import outside"),
    "diamonds of plain classes": of_python("object", "    x = C39()\n    x.a = x.b\n    C39.b\n    Node('n')\n"),
    "diamonds of enumerations": of_python("Enum", "    C39.A.value\n    raise C39()\n", "from enum import Enum"),
    "diamonds that nobody makes": of_python("Node", "    pass\n"),
    "diamonds in a launch file": {
        **of_python("Node", "    pass\n"),
        "bad/launch/a.launch.py": diamonds(
            "class C{0}({1}):\n    pass",
            "from launch import LaunchDescription\nclass C0:\n    pass",
            "def generate_launch_description():\n    x = C39()\n    hasattr(x, 'a')\n    isinstance(x, str)\n"
            "    isinstance(x, LaunchDescription)\n    getattr(C39, 'b', 1)\n    return LaunchDescription([])\n",
        ),
    },
    "diamonds of c++": of_cpp(OF_NODE, RUN),
    "virtual diamonds of c++": of_cpp(OF_NODE, RUN, "virtual public "),
    "diamonds of c++ without a node": of_cpp("class C0 { public: static int k; int m; };", RUN),
    "diamonds of nodelets": of_cpp(
        "class C0 : public nodelet::Nodelet { public: void onInit() {} };",
        "PLUGINLIB_EXPORT_CLASS(C39, nodelet::Nodelet)",
    ),
    "include loop": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/launch/a.launch": '<launch><include file="$(find bad)/launch/b.launch"/></launch>',
        "bad/launch/b.launch": '<launch><include file="$(find bad)/launch/a.launch"/><node name="x" pkg="y" type="z"/></launch>',
    },
    "include bomb": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        **{
            f"bad/launch/l{n}.launch": "<launch>"
            + f'<include file="$(find bad)/launch/l{n + 1}.launch"/>' * 8
            + "</launch>"
            for n in range(12)
        },
        "bad/launch/l12.launch": '<launch><node name="x" pkg="y" type="z"/></launch>',
    },
    "entities": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/launch/a.launch": '<!DOCTYPE l [<!ENTITY a SYSTEM "file:///etc/passwd">]><launch>&a;</launch>',
    },
    "deep xml": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/launch/a.launch": "<launch>" + "<group>" * 5000 + "</group>" * 5000 + "</launch>",
    },
    "names": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/launch/a.launch": f'<launch><node name="{EVIL.replace("<", "&lt;")}" pkg="p" type="t" args="{EVIL.replace("<", "&lt;")}"/></launch>',
    },
    "cmake": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/CMakeLists.txt": "project(bad)\nwhile(1)\n  list(APPEND L a)\nendwhile()\nfunction(f)\n  f()\nendfunction()\nf()\n",
    },
    "c++": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/CMakeLists.txt": "project(bad)\nadd_executable(n src/n.cpp)\n",
        "bad/src/n.cpp": "int f(int x) { return f(x) + f(x + 1); }\nint main() {\n"
        + "{" * 3000
        + "f(1);"
        + "}" * 3000
        + "for (int i = 0; i < 1000000000; ++i) for (int j = 0; j < 1000000000; ++j) f(i);\n}\n",
    },
    "python": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/n.py": "#!/usr/bin/env python3\nimport os\nos.system('touch ran')\nx = " + "(" * 3000 + ")" * 3000 + "\n",
        "bad/m.py": "#!/usr/bin/env python3\nimport rospy\ndef f(n):\n    return f(n - 1) + f(n + 1)\nrospy.Publisher(f(3), None)\nopen('ran', 'w')\n",
    },
    "yaml": {
        "bad/package.xml": '<package format="2"><name>bad</name><version>1.0.0</version></package>',
        "bad/launch/a.launch": '<launch><rosparam file="$(find bad)/p.yaml"/><rosparam>!!python/object/apply:os.system ["touch ran"]</rosparam></launch>',
        "bad/p.yaml": "a: &a [x, x, x, x, x, x, x, x, x]\n"
        + "".join(f"{chr(98 + n)}: &{chr(98 + n)} [" + ", ".join([f"*{chr(97 + n)}"] * 9) + "]\n" for n in range(9)),
    },
}


#: What takes all that launch files may take reaches that sooner: each step counts for ten.
DEARER = """
import sys
from haros_ci.launch.ros1.state import RoslaunchState
spend = RoslaunchState.spend
RoslaunchState.spend = lambda self, cost: spend(self, 10 * cost)
from haros_ci.cli import main
sys.exit(main())
"""


@pytest.mark.parametrize("name", CASES)
def test_a_hostile_package(name: str, tmp_path: Path) -> None:
    root = write(tmp_path / "ws", {**GOOD, **CASES[name]})
    driver = write(tmp_path, {"dearer.py": DEARER}) / "dearer.py" if name == "include bomb" else None
    for format in ("json", "text", "dot", "mermaid"):
        done = haros("model", ".", f"--format={format}", f"--cache-dir={tmp_path / 'cache'}", cwd=root, driver=driver)
        if driver is not None:
            assert "include and set more than can be evaluated" in done.stderr
        assert done.returncode == 0, done.stderr
        assert "Traceback" not in done.stderr and "fault of haros-ci" not in done.stderr
        assert "root:x:0" not in done.stdout and "\u202e" not in done.stdout
        assert not any(line.lstrip().startswith("::") for line in (done.stdout + done.stderr).splitlines())
        if format == "json":
            assert "/chatter" in {
                end["name"]
                for configuration in json.loads(done.stdout)["configurations"]
                for node in configuration["nodes"]
                for end in node["publishers"]
            }
    assert not list(root.rglob("ran"))


#: Where a function's body stands among its values in the cache.
BODY = Function.__struct_fields__.index("body")


def spoil(value: object, turn: int) -> object:
    """*value* with every third leaf replaced by something of another shape."""
    if isinstance(value, list):
        return [spoil(item, turn + number) for number, item in enumerate(value)]
    return ({"a": 1}, [], None, "call", -1, 1e300)[turn % 6] if turn % 3 == 0 else value


def test_a_planted_cache(tmp_path: Path) -> None:
    root = write(tmp_path / "ws", GOOD)
    cache = tmp_path / "cache"
    haros("model", ".", f"--cache-dir={cache}", cwd=root)
    shards = [path for path in cache.iterdir() if path.name.startswith("facts-")]
    assert shards
    spoilt = 0
    for turn in range(12):
        for path in shards:
            document = json.loads(path.read_text())
            for entry in document["entries"].values():
                for function in entry[1][1]:  # the program's functions
                    function[BODY] = spoil(function[BODY], turn)
                    spoilt += 1
            (tmp_path / "spoilt").mkdir(exist_ok=True)
            (tmp_path / "spoilt" / path.name).write_text(json.dumps(document))
        done = haros("model", ".", "--format=json", f"--cache-dir={tmp_path / 'spoilt'}", cwd=root)
        assert done.returncode == 0, done.stderr
        assert "Traceback" not in done.stderr
    assert spoilt


@pytest.mark.parametrize("lines", [True, False])
@pytest.mark.parametrize("depth", [90, 400, 5_000, 200_000])
def test_planted_facts_of_any_depth(tmp_path: Path, depth: int, lines: bool) -> None:
    """Expressions nested deeper than any front end writes them: taken or not, the run ends well."""
    root = write(tmp_path / "ws", GOOD)
    cache = tmp_path / "cache"
    haros("model", ".", f"--cache-dir={cache}", cwd=root)
    (shard,) = (path for path in cache.iterdir() if path.name.startswith("facts-"))
    text = shard.read_text()
    deep = '["do",' + '["star",' * depth + '["none"]' + "]" * depth + "],"
    planted = text.replace('["do",', deep + '["do",', 1)
    assert planted != text
    shard.write_text(planted if lines else planted.replace(",\n", ", "))
    done = haros("model", ".", "--format=json", f"--cache-dir={cache}", cwd=root)
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert "/chatter" in done.stdout or depth < 1_000


def test_a_planted_record_of_what_was_followed(tmp_path: Path) -> None:
    """Records of any shape: the run ends well, and one that is not understood leaves the model as it is."""
    root = write(tmp_path / "ws", GOOD)
    cache = tmp_path / "cache"
    expected = haros("model", ".", "--format=json", f"--cache-dir={cache}", cwd=root).stdout
    shards = [path for path in cache.iterdir() if path.name.startswith("linked-")]
    assert shards
    spoilt = tmp_path / "spoilt"
    wholes: tuple[object, ...] = (None, 1, "planted", [], {}, [[], [], []], [1, 2, 3], [[["planted"]], [], []])
    for turn, whole in enumerate((*wholes, *("spoil" for _ in range(8)))):
        shutil.copytree(cache, spoilt, dirs_exist_ok=True)
        for path in shards:
            document = json.loads(path.read_text())
            for entry in document["entries"].values():
                entry[1] = spoil(entry[1], turn) if whole == "spoil" else whole
            (spoilt / path.name).write_text(json.dumps(document))
        done = haros("model", ".", "--format=json", f"--cache-dir={spoilt}", cwd=root)
        assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr
        assert done.stdout == expected
