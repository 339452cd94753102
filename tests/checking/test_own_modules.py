# SPDX-License-Identifier: Apache-2.0
"""Programs that import modules of their own package which Python does not find."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>{0}</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><exec_depend>rclpy</exec_depend><export><build_type>ament_python</build_type></export></package>\n"
)
SETUP = (
    "from setuptools import setup\nsetup(name='demo', version='1.0.0', packages=['demo', 'demo.parts'],{}\n"
    "      data_files=[('share/ament_index/resource_index/packages', ['resource/demo']), ('share/demo', ['package.xml'])],\n"
    "      entry_points={{'console_scripts': ['run = demo.run:main']}})\n"
)
CFG = "[install]\ninstall_scripts=$base/lib/demo\n[develop]\nscript_dir=$base/lib/demo\n"
PARTS = {
    "demo/tools.py": "WIDTH = 1\n",
    "demo/parts/__init__.py": "LENGTH = 2\n",
    "demo/parts/arm.py": "from . import LENGTH\n",
}


def messages(imports: str, folder: Path, more: dict[str, str] | None = None, setup: str = "") -> list[str]:
    files = {
        "package.xml": MANIFEST.format("demo"),
        "setup.py": SETUP.format(setup),
        "setup.cfg": CFG,
        "resource/demo": "",
        "demo/__init__.py": "VERSION = 1\n",
        "demo/run.py": f"import rclpy\n{imports}\n\ndef main():\n    rclpy.init()\n",
        **PARTS,
        **(more or {}),
    }
    check = next(check for check in checks() if check.id == "python-package-incomplete")
    return [result.message for result in said(check, Example("", True, files), folder)]


@pytest.mark.parametrize(
    ("imports", "words"),
    [
        ("import tools", "it imports tools, which is demo.tools; write that name"),
        ("from tools import WIDTH", "it imports tools, which is demo.tools; write that name"),
        ("from demo.tool import WIDTH", "it imports demo.tool, which does not exist"),
        ("import demo.parts.leg", "it imports demo.parts.leg, which does not exist"),
        ("from .tool import WIDTH", "it imports demo.tool, which does not exist"),
        ("from demo.part.arm import A", "it imports demo.part.arm, which does not exist"),
        ("from demo.nodes import A", "it imports demo.nodes, which does not exist"),
    ],
)
def test_a_module_that_python_does_not_find(imports: str, words: str, tmp_path: Path) -> None:
    (message,) = messages(imports, tmp_path)
    assert message.startswith("program run of package demo cannot start: ") and words in message


def test_a_module_that_another_one_imports(tmp_path: Path) -> None:
    (message,) = messages(
        "from demo.parts import arm\nfrom demo.parts.arm import hand",
        tmp_path,
        {"demo/parts/arm.py": "import hand\n", "demo/parts/hand.py": ""},
    )
    assert "it imports hand, which is demo.parts.hand" in message


@pytest.mark.parametrize("name", ["hand.pyi", "hand.txt", "hand.md", "hand.yaml", "hand.json"])
def test_a_file_of_the_name_that_is_no_module(name: str, tmp_path: Path) -> None:
    (message,) = messages("from demo.hand import A", tmp_path, {f"demo/{name}": "A: int\n"})
    assert "it imports demo.hand, which does not exist" in message


@pytest.mark.parametrize(
    "name",
    [
        "hand.so",
        "hand.cpython-310-x86_64-linux-gnu.so",
        "hand.pyd",
        "hand.pyx",
        "hand.pyc",
        "hand.c",
        "hand.cpp",
        "hand.py.in",
        "hand.ui",
        "hand/a.py",
    ],
)
def test_a_module_in_another_form(name: str, tmp_path: Path) -> None:
    assert (
        messages("from demo.hand import A", tmp_path, {f"demo/{name}": "A\n" if "/" not in name else "A = 1\n"}) == []
    )


@pytest.mark.parametrize(
    ("imports", "more"),
    [
        ("from demo import tools", {}),
        ("from demo.tools import WIDTH", {}),
        ("from .tools import WIDTH", {}),
        ("from . import tools", {}),
        ("from .parts.arm import LENGTH", {}),
        ("import demo.parts.arm as arm", {}),
        ("from demo.VERSION import A", {}),  # a name of the package
        ("from demo.msg import Arm", {}),
        ("try:\n    import tools\nexcept ImportError:\n    from demo import tools", {}),
        ("if True:\n    from demo.tool import A", {}),
        ("def f():\n    import tools", {}),
        ("'''\nimport tools\n'''", {}),
        ("# import tools", {}),
        ("import sys\nsys.path.append('.')\nimport tools", {}),
        ("import importlib\nimport tools", {}),
        ("import serial", {"demo/serial.py": ""}),  # a library of that name
        ("import json", {"demo/json.py": ""}),
        ("import elsewhere", {}),
        ("from demo.fast import A", {"demo/fast.cpython-310-x86_64-linux-gnu.so": ""}),
        ("from demo.fast import A", {"demo/fast.pyx": ""}),
        ("from demo.made import A", {".gitignore": "made.py\n"}),
        ("from demo.data import A", {"demo/data/a.txt": ""}),
    ],
)
def test_what_may_be_found(imports: str, more: dict[str, str], tmp_path: Path) -> None:
    assert messages(imports, tmp_path, more) == []


@pytest.mark.parametrize(
    "setup", ["py_modules=['tools'],", "package_dir={'': 'demo'}, py_modules=['tools'],", "scripts=['demo/tools.py'],"]
)
def test_a_module_that_setup_installs_by_itself(setup: str, tmp_path: Path) -> None:
    assert not any("tools" in message for message in messages("import tools", tmp_path, setup=setup))


def test_a_module_that_nothing_starts(tmp_path: Path) -> None:
    assert messages("", tmp_path, {"demo/spare.py": "import tools\nfrom demo.gone import A\n"}) == []


NAMES = [
    (
        "from demo.tools import HEIGHT",
        {},
        "it imports HEIGHT from demo.tools, which has no such name; define it there, or remove the import",
    ),
    ("from demo.tools import WIDHT", {}, "it imports WIDHT from demo.tools, which has no such name; write WIDTH"),
    ("from .tools import WIDTH, DEPTH", {}, "it imports DEPTH from demo.tools"),
    ("from demo import RELEASE", {}, "it imports RELEASE from demo, which"),
    ("from demo.parts import leg", {}, "it imports leg from demo.parts"),
    (
        "import demo.parts.arm",
        {"demo/parts/arm.py": "from ..tools import arm_width\n"},
        "it imports arm_width from demo.tools",
    ),
    (
        "from demo.tools import help",
        {"demo/tools.py": "class A:\n    def help(self):\n        pass\n"},
        "it imports help from",
    ),
    (
        "from demo.tools import x",
        {"demo/tools.py": "def f():\n    x = 1\n    return x\n"},
        "it imports x from demo.tools",
    ),
]


@pytest.mark.parametrize(("imports", "more", "words"), NAMES, ids=[imports for imports, _, _ in NAMES])
def test_a_name_that_a_module_does_not_have(imports: str, more: dict[str, str], words: str, tmp_path: Path) -> None:
    (message,) = messages(imports, tmp_path, more)
    assert message.startswith("program run of package demo cannot start: ") and words in message


BINDINGS = [
    "A = 1",
    "A: int = 1",
    "A += 1",
    "(A, B), *C = f()",
    "def A(): pass",
    "async def A(): pass",
    "class A: pass",
    "import A",
    "import A.b",
    "import b.c as A",
    "from b import A",
    "from b import c as A",
    "for A in (1, 2): pass",
    "with open('x') as A: pass",
    "if B:\n    A = 1",
    "try:\n    import A\nexcept ImportError:\n    pass",
    "try:\n    pass\nfinally:\n    A = 1",
    "while (A := f()): pass",
    "def f():\n    global A\n    A = 1",
    "class B:\n    def f(self):\n        global A\n        A = 1",
    "match f():\n    case [*A]:\n        pass",
    "match f():\n    case {'a': 1, **A}:\n        pass",
    "from b import *",
    "from b import (\n    *)",
    "def __getattr__(name): return 1",
    "globals()['A'] = 1",
    "globals().update(f())",
    "exec('A = 1')",
    "setattr(f(), 'A', 1)",
    "sys.modules[__name__] = f()",
    "def broken(:",
    "print 'Python 2'",
]


@pytest.mark.parametrize("text", BINDINGS)
def test_quiet_where_a_module_has_the_name_or_may_have_it(text: str, tmp_path: Path) -> None:
    assert messages("from demo.tools import A", tmp_path, {"demo/tools.py": f"{text}\n"}) == []


QUIET_NAMES = [
    ("from demo.parts import arm", {}),
    ("from demo.parts import arm, LENGTH", {}),
    ("from demo import parts", {}),
    ("from . import tools", {}),
    ("from demo.tools import *", {}),
    ("from demo.tools import __doc__, __name__", {}),
    ("from demo.parts import fast", {"demo/parts/fast.cpython-310-x86_64-linux-gnu.so": ""}),
    ("from demo.parts import data", {"demo/parts/data/one.py": "X = 1\n"}),
    ("from demo import msg", {}),
    ("try:\n    from demo.tools import HEIGHT\nexcept ImportError:\n    HEIGHT = 1", {}),
    ("def f():\n    from demo.tools import HEIGHT", {}),
    ("if f():\n    from demo.tools import HEIGHT", {}),
    ("import sys\nsys.path.insert(0, '/x')\nfrom demo.tools import HEIGHT", {}),
    ("from demo.kinds import HEIGHT", {"demo/kinds/one.py": "X = 1\n"}),
    ("from other.tools import HEIGHT", {}),
]


@pytest.mark.parametrize(("imports", "more"), QUIET_NAMES, ids=[imports for imports, _ in QUIET_NAMES])
def test_quiet_on_other_imports_of_names(imports: str, more: dict[str, str], tmp_path: Path) -> None:
    assert messages(imports, tmp_path, more) == []


CATKIN = {
    "package.xml": '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>BSD</license><buildtool_depend>catkin</buildtool_depend><exec_depend>rospy</exec_depend></package>\n",
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.0.2)\nproject(demo)\nfind_package(catkin REQUIRED COMPONENTS rospy)\ncatkin_python_setup()\n"
    "catkin_package()\ncatkin_install_python(PROGRAMS scripts/talk.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n",
    "setup.py": "from setuptools import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\n"
    "setup(**generate_distutils_setup(packages=['demo'], package_dir={'': 'src'}))\n",
    "src/demo/__init__.py": "",
    "src/demo/tools.py": "WIDTH = 1\n",
}
AMENT = {
    "package.xml": '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>BSD</license><buildtool_depend>ament_cmake_python</buildtool_depend><exec_depend>rclpy</exec_depend>"
    "<export><build_type>ament_cmake</build_type></export></package>\n",
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\nfind_package(ament_cmake_python REQUIRED)\n"
    "ament_python_install_package(demo)\ninstall(PROGRAMS scripts/talk.py DESTINATION lib/demo)\nament_package()\n",
    "demo/__init__.py": "",
    "demo/tools.py": "WIDTH = 1\n",
}
SCRIPT = "#!/usr/bin/env python3\n{}\n\nif __name__ == '__main__':\n    print(1)\n"


def of_script(base: dict[str, str], imports: str, folder: Path, more: dict[str, str]) -> list[str]:
    check = next(check for check in checks() if check.id == "python-package-incomplete")
    files = {**base, "scripts/talk.py": SCRIPT.format(imports), **more}
    return [result.message for result in said(check, Example("", True, files), folder)]


@pytest.mark.parametrize("base", [CATKIN, AMENT], ids=["catkin", "ament_cmake"])
@pytest.mark.parametrize(
    ("imports", "words"),
    [
        ("from demo.tools import HEIGHT", "it imports HEIGHT from demo.tools, which has no such name"),
        ("from demo.tool import WIDTH", "it imports demo.tool, which does not exist"),
        ("import demo.tool", "it imports demo.tool, which does not exist"),
        ("from demo import tool", "it imports tool from demo, which has no such name"),
    ],
)
def test_a_script_beside_its_python_package(base: dict[str, str], imports: str, words: str, tmp_path: Path) -> None:
    (message,) = of_script(base, imports, tmp_path, {})
    assert message.startswith("program talk.py of package demo cannot start: ") and words in message


@pytest.mark.parametrize("base", [CATKIN, AMENT], ids=["catkin", "ament_cmake"])
@pytest.mark.parametrize(
    ("imports", "more"),
    [
        ("from demo.tools import WIDTH", {}),
        ("from demo import tools", {}),
        ("from demo.msg import Beat", {}),
        ("from demo.srv import Beat, BeatResponse", {}),
        ("from demo.cfg import DriveConfig", {}),
        ("from tools import HEIGHT", {}),
        ("from .tools import HEIGHT", {}),
        ("from demo.tool import WIDTH", {"scripts/demo.py": "tool = 1\n"}),
        ("from demo.tool import WIDTH", {"scripts/demo/tool.py": "WIDTH = 1\n"}),
        ("import sys\nsys.path.append('x')\nfrom demo.tool import WIDTH", {}),
        ("try:\n    from demo.tool import WIDTH\nexcept ImportError:\n    pass", {}),
        ("print 'Python 2'\nfrom demo.tool import WIDTH", {}),
        ("import beside", {"scripts/beside.py": "from demo.tool import WIDTH\n"}),
        ("from demo.tool import WIDTH", {".gitignore": "tool.py\n"}),
    ],
)
def test_quiet_on_scripts_that_start(base: dict[str, str], imports: str, more: dict[str, str], tmp_path: Path) -> None:
    assert of_script(base, imports, tmp_path, more) == []


def test_quiet_on_a_script_that_nothing_installs_or_starts(tmp_path: Path) -> None:
    assert of_script(CATKIN, "", tmp_path, {"scripts/old.py": SCRIPT.format("from demo.tool import WIDTH")}) == []


COMPILED = [
    "find_package(pybind11 REQUIRED)",
    "pybind11_add_module(fast src/fast.cpp)",
    "find_package(PythonLibs 3 REQUIRED)",
    "find_package(Boost REQUIRED COMPONENTS system python3)",
    "find_package(Python3 REQUIRED COMPONENTS Interpreter Development)",
    "swig_add_library(fast LANGUAGE python SOURCES fast.i)",
    "find_package(SWIG REQUIRED)",
    "python_add_library(fast MODULE fast.cpp)",
]


@pytest.mark.parametrize("command", COMPILED)
def test_quiet_where_the_build_compiles_modules(command: str, tmp_path: Path) -> None:
    cmake = AMENT["CMakeLists.txt"].replace("ament_package()", f"{command}\nament_package()")
    assert of_script(AMENT, "from demo.tool import WIDTH", tmp_path, {"CMakeLists.txt": cmake}) == []
    assert of_script(AMENT, "from demo.tools import HEIGHT", tmp_path, {"CMakeLists.txt": cmake}) == []


def test_quiet_on_what_setup_compiles(tmp_path: Path) -> None:
    setup = CATKIN["setup.py"] + "# Extension('demo.inner', sources=['x.c'])\n"
    assert of_script(CATKIN, "from demo import inner", tmp_path, {"setup.py": setup}) == []
    assert of_script(CATKIN, "from demo import _C", tmp_path, {}) == []
