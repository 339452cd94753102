# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.workspace.language import is_python_script, language_of


@pytest.mark.parametrize(
    ("name", "language"),
    [
        ("a.cpp", "cpp"),
        ("a.h", "cpp"),
        ("a.C", "cpp"),
        ("a.tpp", "cpp"),
        ("a.cu", "cpp"),
        ("a.py", "python"),
        ("a.pyw", "python"),
        ("setup.py", "python"),
        ("bringup.launch.py", "python"),
        ("bringup.launch", "launch"),
        ("bringup.launch.xml", "launch"),
        ("bringup_launch.xml", "launch"),
        ("bringup.launch.yaml", "launch"),
        ("bringup_launch.yml", "launch"),
        ("package.xml", "package"),
        ("plugins.xml", "xml"),
        ("arm.urdf.xacro", "xml"),
        ("CMakeLists.txt", "cmake"),
        ("extras.cmake", "cmake"),
        ("params.yaml", "yaml"),
        ("Pose.msg", "interface"),
        ("Move.srv", "interface"),
        ("Dock.action", "interface"),
        ("setup.cfg", "setup"),
    ],
)
def test_known(name: str, language: str) -> None:
    assert language_of(name) == language


@pytest.mark.parametrize(
    "name",
    [
        "config.h.in",
        "a.pyi",
        "a.pyc",
        "LICENSE",
        "notes.txt",
        "cpp",
        ".py",
        "x.cmake.in",
        "package.xml.in",
        "a.",
        "tox.ini",
    ],
)
def test_unknown(name: str) -> None:
    assert language_of(name) is None


@pytest.mark.parametrize(
    "head",
    [
        b"#!/usr/bin/python\n",
        b"#!/usr/bin/env python3\nimport rospy",
        b"#! /usr/bin/env python3.11\r\n",
        b"#!/usr/bin/env -S python3 -u\n",
        b"#!/usr/bin/env PYTHONUTF8=1 python\n",
        b"#!/opt/venv/bin/python -s",
        b"#!/usr/bin/env python",
    ],
)
def test_python_scripts(head: bytes) -> None:
    assert is_python_script(head)


@pytest.mark.parametrize(
    "head",
    [
        b"",
        b"#!",
        b"import rospy\n",
        b"# !/usr/bin/python\n",
        b" #!/usr/bin/python\n",
        b"#!/bin/sh\n# python\n",
        b"#!/bin/bash python\n",
        b"#!/usr/bin/env ipython\n",
        b"#!/usr/bin/env bash\n",
        b"#!/usr/bin/pythonista\n",
        b"#!\n/usr/bin/python\n",
        b"\x7fELF python",
    ],
)
def test_other_scripts(head: bytes) -> None:
    assert not is_python_script(head)
