# SPDX-License-Identifier: Apache-2.0
"""Python modules that launch files bring in, beside them and in packages: followed as data, never imported."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.launch.python.heap import STEPS, Budget
from haros_ci.launch.python.interpret import interpret
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

MANIFEST = '<package format="3"><name>arm</name><export><build_type>ament_cmake</build_type></export></package>'
CMAKE = """
project(arm)
find_package(ament_cmake REQUIRED)
find_package(ament_cmake_python REQUIRED)
ament_python_install_package(arm)
install(DIRECTORY launch tools DESTINATION share/${PROJECT_NAME})
ament_package()
"""
HELPERS = """
from launch_ros.actions import Node
NAME = 'left'
def joy(name=NAME):
    return Node(package='joy', executable='joy_node', name=name)
open('ran.txt', 'w').write('x')
"""
HEAD = """
import importlib, importlib.util, os, pathlib, sys
from launch import LaunchDescription
from launch.actions import OpaqueFunction
from ament_index_python.packages import get_package_share_directory
HERE = os.path.dirname(os.path.realpath(__file__))
"""
TAIL = """
def generate_launch_description():
    return LaunchDescription([{}])
"""


def names(root: Path, body: str, made: str, files: Mapping[str, str] | None = None) -> list[str]:
    """The names of the nodes of a launch file."""
    everything = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": CMAKE,
        "launch/a.launch.py": HEAD + body + TAIL.format(made),
        "launch/arm_parts.py": HELPERS,
        "tools/arm_tools.py": HELPERS.replace("left", "tool"),
        "tools/parts/__init__.py": "from .inner import joy\n",
        "tools/parts/inner.py": HELPERS.replace("left", "inner"),
        "arm/__init__.py": "",
        "arm/launch_helpers.py": "from .deeper import joy\nfrom . import deeper\n",
        "arm/deeper.py": HELPERS.replace("left", "package"),
        **(files or {}),
    }
    for path, text in everything.items():
        (root / "arm" / path).parent.mkdir(parents=True, exist_ok=True)
        (root / "arm" / path).write_text(text, encoding="utf-8")
    found = architecture(discover(root, ()), Settings(root=root), MemoryCache())
    assert not list(root.rglob("ran.txt"))
    return [
        node.name or ""
        for each in found.configurations
        if each.launch == ("arm/launch/a.launch.py",)
        for node in each.nodes
    ]


@pytest.mark.parametrize(
    ("body", "made", "expected"),
    [
        ("sys.path.append(HERE)\nimport arm_parts", "arm_parts.joy()", "/left"),
        ("sys.path.append(str(pathlib.Path(__file__).parent.absolute()))\nimport arm_parts as p", "p.joy()", "/left"),
        ("sys.path.insert(0, HERE)\nfrom arm_parts import joy, NAME", "joy(NAME + '_two')", "/left_two"),
        ("sys.path.insert(0, HERE)\nfrom arm_parts import *", "joy()", "/left"),
        ("sys.path += [HERE]\nimport arm_parts", "arm_parts.joy()", "/left"),
        ("sys.path.extend(['/opt', HERE])\nimport arm_parts", "arm_parts.joy()", "/left"),
        ("if HERE not in sys.path:\n    sys.path.append(HERE)\nimport arm_parts", "arm_parts.joy()", "/left"),
        (
            "sys.path.append(os.path.join(get_package_share_directory('arm'), 'tools'))\nimport arm_tools",
            "arm_tools.joy()",
            "/tool",
        ),
        ("sys.path.append(get_package_share_directory('arm') + '/tools')\nfrom parts import joy", "joy()", "/inner"),
        ("sys.path.append(HERE + '/../tools')\nimport parts.inner", "parts.inner.joy()", "/inner"),
        ("from arm.launch_helpers import joy", "joy()", "/package"),
        ("from arm import launch_helpers", "launch_helpers.deeper.joy()", "/package"),
        ("import arm.deeper as d", "d.joy()", "/package"),
        ("m = importlib.import_module('arm.deeper')", "m.joy()", "/package"),
        ("m = importlib.import_module('.deeper', package='arm')", "m.joy()", "/package"),
        ("m = importlib.import_module('.deeper', 'arm')\nf = getattr(m, 'joy')", "f()", "/package"),
        (
            "s = importlib.util.spec_from_file_location('parts', os.path.join(HERE, 'arm_parts.py'))\n"
            "m = importlib.util.module_from_spec(s)\ns.loader.exec_module(m)",
            "m.joy()",
            "/left",
        ),
        (
            "from importlib.machinery import SourceFileLoader\nm = SourceFileLoader('p', HERE + '/arm_parts.py').load_module()",
            "m.joy()",
            "/left",
        ),
        ("import imp\nm = imp.load_source('p', HERE + '/arm_parts.py')", "m.joy()", "/left"),
        ("import runpy\nm = runpy.run_path(HERE + '/arm_parts.py')", "m['joy']()", "/left"),
        ("sys.path.append(HERE)\nm = __import__('arm_parts')", "m.joy()", "/left"),
        ("sys.path.append(HERE)\nimport arm_parts", "OpaqueFunction(function=lambda c: [arm_parts.joy()])", "/left"),
    ],
)
def test_modules_are_followed(tmp_path: Path, body: str, made: str, expected: str) -> None:
    assert names(tmp_path, body, made) == [expected]


@pytest.mark.parametrize(
    ("body", "made"),
    [
        ("import arm_parts", "arm_parts.joy()"),  # nothing says where it is: Python does not look beside launch files
        ("sys.path.append('/opt/elsewhere')\nimport arm_parts", "arm_parts.joy()"),
        ("sys.path.append(os.environ['WHERE'])\nimport arm_parts", "arm_parts.joy()"),
        ("sys.path.append(HERE + '/../../..')\nimport arm_parts", "arm_parts.joy()"),
        ("sys.path.append(get_package_share_directory('other') + '/launch')\nimport arm_parts", "arm_parts.joy()"),
        ("sys.path.append(HERE)\nimport absent", "absent.joy()"),
        ("m = importlib.import_module('arm.absent')", "m.joy()"),
        ("m = importlib.import_module(os.environ['WHICH'])", "m.joy()"),
        ("m = importlib.import_module('.deeper')", "m.joy()"),
        (
            "s = importlib.util.spec_from_file_location('p', '/opt/p.py')\nm = importlib.util.module_from_spec(s)",
            "m.joy()",
        ),
        ("import runpy\nm = runpy.run_path(HERE + '/../CMakeLists.txt')", "m['joy']()"),
        ("m = __import__(os.environ['WHICH'])", "m.joy()"),
    ],
)
def test_what_cannot_be_found_gives_nothing(tmp_path: Path, body: str, made: str) -> None:
    assert names(tmp_path, body, made) == []


def test_a_summarised_library_stays_one(tmp_path: Path) -> None:
    files = {"launch/launch_ros/actions.py": "raise ValueError", "launch/yaml.py": "NAME = 'x'"}
    body = "sys.path.insert(0, HERE)\nfrom launch_ros.actions import Node\nimport yaml"
    assert names(tmp_path, body, "Node(package='joy', executable='joy_node', name='n')", files) == ["/n"]


def test_modules_that_import_one_another_end(tmp_path: Path) -> None:
    files = {"launch/one.py": "import two\n" + HELPERS, "launch/two.py": "import one\n"}
    assert names(tmp_path, "sys.path.append(HERE)\nimport one, two", "two.one.joy()", files) == ["/left"]


def test_a_file_is_one_module_by_whatever_name(tmp_path: Path) -> None:
    body = (
        "sys.path.append(HERE)\nimport arm_parts\narm_parts.NAME = 'changed'\n"
        "m = importlib.util.module_from_spec(importlib.util.spec_from_file_location('q', HERE + '/arm_parts.py'))"
    )
    assert names(tmp_path, body, "arm_parts.joy(arm_parts.NAME)") in (["/changed"], ["/?"])


def test_a_directory_put_first_comes_before_packages(tmp_path: Path) -> None:
    files = {"tools/arm/__init__.py": "", "tools/arm/deeper.py": HELPERS.replace("left", "first")}
    first = "sys.path.insert(0, HERE + '/../tools')\nimport arm.deeper as d"
    assert names(tmp_path, first, "d.joy()", files) == ["/first"]
    last = "sys.path.append(HERE + '/../tools')\nimport arm.deeper as d"
    assert names(tmp_path, last, "d.joy()", files) == ["/package"]


def test_a_module_that_a_function_imports_is_there_each_time(tmp_path: Path) -> None:
    files = {
        "launch/other.launch.xml": '<launch><include file="$(find-pkg-share arm)/launch/a.launch.py"/></launch>',
        "launch/more.launch.xml": '<launch><include file="$(find-pkg-share arm)/launch/a.launch.py"/></launch>',
    }
    body = "def start(context):\n    import arm.deeper as d\n    return [d.joy()]"
    names(tmp_path, body, "OpaqueFunction(function=start)", files)
    found = architecture(discover(tmp_path, ()), Settings(root=tmp_path), MemoryCache())
    assert [[node.name for node in each.nodes] for each in found.configurations] == [["/package"], ["/package"]]


def test_a_module_that_is_no_python_is_parsed_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = "sys.path.append(HERE)\n" + "import broken\n" * 60
    text, real, parsed = "x = [1, 2, 3]\n" * 300 + "(\n", ast.parse, list[str]()

    def noted(source: Any, *arguments: Any, **named: Any) -> Any:
        parsed.append(source if isinstance(source, str) else source.decode())
        return real(source, *arguments, **named)

    monkeypatch.setattr(ast, "parse", noted)
    assert names(tmp_path, body, "broken.joy()", {"launch/broken.py": text}) == []
    assert 0 < parsed.count(text) < 5


def test_looking_for_modules_uses_the_budget() -> None:
    head = "import importlib, os, sys\nHERE = os.path.dirname(__file__)\n"
    paths = "".join(f"sys.path.append(HERE + '/d{number}')\n" for number in range(40))
    calls = "for number in range(4_000):\n    importlib.import_module('m' + str(number))\n"
    budget = Budget()
    interpret("a.launch.py", head + paths + calls, lambda _: None, {}, budget=budget)
    assert budget.steps == STEPS
