# SPDX-License-Identifier: Apache-2.0
"""Modules of Python itself as dependencies: nobody has a package of that name, and nothing comes with it."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.result import Result

MANIFEST = (
    '<package format="3">\n  <name>{0}</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license>\n{1}  <export><build_type>ament_python</build_type></export>\n</package>\n"
)
SETUP = "from setuptools import setup\nsetup(name='demo', version='1.0.0', packages=['demo'], entry_points={'console_scripts': ['run = demo.run:main']})\n"
RUN = "import math\nimport os, sys\nfrom random import choice\nimport cv2\n\n\ndef main():\n    choice([1])\n"


def results(
    check_id: str, needs: str, folder: Path, more: dict[str, str] | None = None, run: str = RUN
) -> list[Result]:
    check = next(check for check in checks() if check.id == check_id)
    declared = "".join(f"  <exec_depend>{name}</exec_depend>\n" for name in ("rclpy", *needs.split()))
    files = {
        "demo/package.xml": MANIFEST.format("demo", declared),
        "demo/setup.py": SETUP,
        "demo/demo/__init__.py": "",
        "demo/demo/run.py": run,
    }
    return list(said(check, Example("", True, {**files, **(more or {})}), folder))


@pytest.mark.parametrize(
    ("needs", "words"),
    [
        ("math", "demo depends on math, which is a module of Python itself and neither a ROS package nor a rosdep key"),
        ("sys math", "demo depends on sys and math, which are modules of Python itself"),
        ("random", "demo depends on random,"),
        ("os json", "demo depends on os and json,"),
    ],
)
def test_a_module_of_python_is_no_dependency(needs: str, words: str, tmp_path: Path) -> None:
    (result,) = results("misspelt-dependency", needs, tmp_path)
    assert result.message.startswith(words) and result.level.value == "error"
    assert len(result.fixes[0].edits) == len(needs.split())


@pytest.mark.parametrize(
    "needs",
    [
        "",
        "sensor_msgs",
        "python3-numpy",
        "json",
        "platform",
        "house_of_math",
        "maths",
        "statistics queue",
        "tkinter",
        "turtlesim",
    ],
)
def test_what_may_be_a_package(needs: str, tmp_path: Path) -> None:
    assert results("misspelt-dependency", needs, tmp_path) == []


def test_a_package_of_the_workspace_that_is_called_so(tmp_path: Path) -> None:
    more = {"math/package.xml": MANIFEST.format("math", "")}
    assert results("misspelt-dependency", "math", tmp_path, more) == []


def test_a_comment_imports_nothing(tmp_path: Path) -> None:
    assert results("misspelt-dependency", "math", tmp_path, run="# import math\n\n\ndef main():\n    pass\n") == []


@pytest.mark.parametrize(("needs", "count"), [("math", 1), ("sys math", 1), ("house_of_math", 0), ("", 1)])
def test_nothing_comes_with_it(needs: str, count: int, tmp_path: Path) -> None:
    assert len(results("undeclared-import", needs, tmp_path)) == count


@pytest.mark.parametrize(
    ("line", "key"),
    [
        ("from google.protobuf import text_format", "python3-protobuf"),
        ("import google.protobuf.text_format as text", "python3-protobuf"),
        ("from google import protobuf", "python3-protobuf"),
        ("from ruamel.yaml import YAML", "python3-ruamel.yaml"),
        ("from mpl_toolkits.mplot3d import Axes3D", "python3-matplotlib"),
        ("from google import genai\nimport google.protobuf", "python3-protobuf"),
        ("import cv2, google.genai", "python3-opencv"),
        # of another distribution, or not known of which
        ("from google import genai", ""),
        ("from google.genai import types", ""),
        ("import google.generativeai as genai", ""),
        ("from google.cloud import speech", ""),
        ("import google.auth", ""),
        ("import google", ""),
        ("from google import (genai)", ""),
        ("from ruamel.std import zipfile", ""),
        ("from mpl_toolkits.basemap import Basemap", ""),
        ("from backports import csv", ""),
    ],
)
def test_of_a_namespace_package_the_portion_counts(line: str, key: str, tmp_path: Path) -> None:
    run = f"import math\n{line}\n\n\ndef main():\n    math.sin(1)\n"
    found = results("undeclared-import", "", tmp_path, run=run)

    assert [key in one.message for one in found] == ([True] if key else [])
