# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.workspace.language import is_kept_copy, language_of, script_language


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
        ("run.sh", "shell"),
        ("env.bash", "shell"),
        ("Dockerfile", "dockerfile"),
        ("Dockerfile.humble", "dockerfile"),
        ("ros.Dockerfile", "dockerfile"),
        ("Containerfile", "dockerfile"),
        ("README.md", "markdown"),
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
        b'#!/usr/bin/env -S "python3" -u\n',
        b"#!/usr/bin/env -S'/usr/bin/python3'\n",
        b"#!/usr/bin/env -vSpython3\n",
        b"#!/usr/bin/env --split-string=python3\n",
        b'#!/usr/bin/env PYTHONUNBUFFERED=1 --split-string="python3 -u"\n',
        b"#!/usr/bin/env PYTHONUTF8=1 python\n",
        b"#!/opt/venv/bin/python -s",
        b"#!/usr/bin/env python",
    ],
)
def test_python_scripts(head: bytes) -> None:
    assert script_language(head) == "python"


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
    assert script_language(head) != "python"


@pytest.mark.parametrize(
    "head", [b"#!/bin/sh\n", b"#!/bin/bash -e\n", b"#!/usr/bin/env bash\n", b"#! /bin/dash", b"#!/bin/ksh\n"]
)
def test_shell_scripts(head: bytes) -> None:
    assert script_language(head) == "shell"


@pytest.mark.parametrize(
    "head",
    [b"", b"# !/bin/sh\n", b"#!/bin/zsh\n", b"#!/usr/bin/fish\n", b"#!/usr/bin/shell\n", b"#!/bin/csh\n", b"sh\n"],
)
def test_no_shell_scripts(head: bytes) -> None:
    assert script_language(head) is None


@pytest.mark.parametrize(
    "name", ["a.py.bak", "a.py.bak2", "a.BAK", "run.old", "a.py.orig", "a.py~", "a.py.swp", "talker.bak_2021"]
)
def test_a_copy_that_is_kept_beside(name: str) -> None:
    assert is_kept_copy(name)


@pytest.mark.parametrize(
    "name", ["bak.py", "old", "talker", "talker.py", "a.old.py", ".bak", "tmp", "a.bakery", "restore_bak", "rollback"]
)
def test_other_names_are_no_copies(name: str) -> None:
    assert not is_kept_copy(name)
