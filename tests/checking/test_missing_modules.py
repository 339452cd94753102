# SPDX-License-Identifier: Apache-2.0
"""What python-package-incomplete advises for a module that does not exist."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from commandline import haros, write

MANIFEST = """<package format="3">
  <name>demo</name><version>1.0.0</version><description>demo</description>
  <maintainer email="a@example.org">a</maintainer><license>BSD</license>
  <exec_depend>rclpy</exec_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
SETUP = """from setuptools import setup

setup(
    name='demo',
    version='1.0.0',
    packages=['demo'],
    data_files=[('share/ament_index/resource_index/packages', ['resource/demo']), ('share/demo', ['package.xml'])],
    entry_points={{'console_scripts': ['tool = {module}:main']}},
)
"""
CFG = "[install]\ninstall_scripts=$base/lib/demo\n[develop]\nscript_dir=$base/lib/demo\n"


@pytest.mark.parametrize(
    ("module", "file", "advice"),
    [
        (
            "demo.scripts.tool",
            "scripts/tool.py",
            "does not exist: scripts/tool.py is not in the Python package; move it to demo/scripts/tool.py",
        ),
        (
            "demo.tool",
            "demo/trials/tool.py",
            "does not exist; demo/trials/tool.py has its name: correct the entry point, or move it back",
        ),
        ("demo.talkers", "demo/talker.py", "does not exist; write demo.talker"),
        ("demo.tool", "scripts/other.py", "does not exist; add it, or remove the entry point"),
        ("demo.scripts.tool", "scripts/other.py", "does not exist; add it, or remove the entry point"),
    ],
)
def test_advice(tmp_path: Path, module: str, file: str, advice: str) -> None:
    files = {"package.xml": MANIFEST, "setup.py": SETUP.format(module=module), "setup.cfg": CFG, "resource/demo": ""}
    write(tmp_path, {**files, "demo/__init__.py": "", file: "def main():\n    pass\n"})
    run = haros("check", ".", "--output=json", "--profile=architecture", cwd=tmp_path)
    found = [r["message"] for r in json.loads(run.stdout)["results"] if r["rule"] == "python-package-incomplete"]
    assert len(found) == 1 and found[0].endswith(advice + "."), found


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        (
            {},
            ["programs tool and other of package demo cannot start: the modules demo.tool and demo.other do not exist"],
        ),
        (
            {"demo/trials/tool.py": "", "demo/trials/other.py": ""},
            ["(demo/trials/tool.py and demo/trials/other.py have the names); add them, or correct or remove the"],
        ),
        ({"demo/tool.py": "def main():\n    pass\n"}, ["the module demo.other does not exist; add it, or remove"]),
    ],
)
def test_several_are_one_finding(tmp_path: Path, more: dict[str, str], expected: list[str]) -> None:
    setup = SETUP.format(module="demo.tool").replace(":main'", ":main', 'other = demo.other:main'")
    files = {"package.xml": MANIFEST, "setup.py": setup, "setup.cfg": CFG, "resource/demo": "", "demo/__init__.py": ""}
    write(tmp_path, {**files, **more})
    run = haros("check", ".", "--output=json", "--profile=architecture", cwd=tmp_path)
    found = [r["message"] for r in json.loads(run.stdout)["results"] if r["rule"] == "python-package-incomplete"]
    assert len(found) == len(expected)
    assert all(any(words in message for message in found) for words in expected), found
