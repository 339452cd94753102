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
        "from demo.parts import arm\nfrom demo.parts.arm import A",
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
        ("from .parts.arm import A", {}),
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
