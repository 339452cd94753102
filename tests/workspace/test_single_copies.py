# SPDX-License-Identifier: Apache-2.0
"""Which files are copies of another project's library by their owner and licence, and which are the project's own."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from haros_ci.workspace.discover import discover
from haros_ci.workspace.single_copies import SingleCopies

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><maintainer email="a@example.org">Ada Lovage</maintainer>'
    "<license>Apache-2.0</license></package>"
)
MIT = "#\n# Permission is hereby granted, free of charge, to any person obtaining a copy\n"
HEAD = "# Copyright (c) 1999-2007 Grete Stromberg; All Rights Reserved.\n" + MIT
BODY = "import math\n" + "a = math.pi\n" * 120
OWN = {f"demo/node{number}.py": "# Copyright 2020 Ada Lovage\nimport rospy\n" for number in range(5)}
PLACE = "demo/sums.py"


def is_copy(root: Path, files: dict[str, str], path: str = PLACE) -> bool:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return path in SingleCopies(discover(root, (".",))).among([path])


def made(head: str = HEAD, body: str = BODY, **more: str) -> dict[str, str]:
    """*more* are files by name, with two low lines for a slash."""
    named = {name.replace("__", "/").replace("_dot_", "."): text for name, text in more.items()}
    return {"demo/package.xml": MANIFEST, **OWN, PLACE: head + body, **named}


FIRES = [
    made(),
    made("#!/usr/bin/env python\n# sums.py copyright (C) 2008 Grete Stromberg <g@example.net>\n" + MIT),
    made(
        "# (c) Copyright 2009, Stromberg Works, all rights reserved.\n# Redistribution and use in source and binary forms\n"
    ),
    made("# SPDX-FileCopyrightText: 2020 Stromberg\n# SPDX-License-Identifier: MIT\n"),
    made('"""Sums.\n\nCopyright © 2001, 2003 by Grete Stromberg\nGNU General Public License\n"""\n'),
    made(demo__more_dot_py=HEAD + BODY),
    {
        **made(HEAD + "# The first version was under the GPL.\n"),
        "demo/package.xml": MANIFEST.replace("Apache-2.0", "GPL"),
    },
    made(body="import more\n" + BODY, demo__more_dot_py=HEAD + BODY),
    made(body="import os, numpy as np\n" + BODY),
    {**made(), "demo/node0.py": "# Copyright 2020 Somebody\n# Redistribution and use in source and binary forms\n"},
    made(demo__lib__sums_dot_py=HEAD + BODY),
    made(
        demo__more_dot_py=HEAD + "a = 1\n", demo__lib__more_dot_py=HEAD + "a = 1\n", demo__lib__sums_dot_py=HEAD + BODY
    ),
]
CHIPS = "# (C) Copyright 2019 Texas Instruments, Inc.\n# Redistribution and use in source and binary forms\n"
MANY = {f"demo/chip{number}.py": CHIPS + BODY for number in range(9)}
FIRES += [
    {**made(CHIPS), **MANY},
    {**made(CHIPS + "# Redistributions of source code must retain the above copyright\n# notice.\n"), **MANY},
    {**made(CHIPS, "from . import chip0\n" + BODY), **MANY},
    {**made(CHIPS), **MANY, "demo/package.xml": MANIFEST.replace("Apache-2.0", "BSD")},
    {**made(CHIPS.replace("Texas Instruments, Inc.", "NVIDIA CORPORATION")), **MANY},
    {**made(CHIPS.replace("Texas Instruments, Inc.", "VectorNav Technologies, LLC")), **MANY},
]
CONTRACT = "# Copyright © 2024 NaturalPoint, Inc. All Rights Reserved.\n# THIS SOFTWARE IS GOVERNED BY ITS EULA.\n"
BESIDE = {f"demo/part{number}.py": CONTRACT + BODY for number in range(9)}
FIRES += [
    {**made(CONTRACT, "import part0\n" + BODY), **BESIDE},
    {**made(CONTRACT.replace("ITS EULA", "A SOFTWARE LICENSE AGREEMENT")), **BESIDE},
    {**made(CHIPS.replace("Texas Instruments, Inc.", "Intel Corporation")), **MANY},
]
QUIET = [
    {**made(CONTRACT.replace("NaturalPoint, Inc.", "Some Points, Inc.")), "demo/more.py": HEAD},
    {**made(CONTRACT.replace("EULA", "AUTHORS")), **BESIDE},
    {**made(CONTRACT), **BESIDE, "demo/setup.py": "setup(author='NaturalPoint')\n"},
    {**made(CONTRACT, "import rclpy\n" + BODY), **BESIDE},
    {**made(CONTRACT, "from launch_ros.actions import Node\n" + BODY), **BESIDE},
    {**made(CONTRACT, "from launch import LaunchDescription\n" + BODY), **BESIDE},
    {**made(CONTRACT, "from arm.msg import Pose\n" + BODY), **BESIDE},
    {**made(CONTRACT + "# Adapted for the arm.\n"), **BESIDE},
    {**made(CONTRACT + "# Copyright 2020 Ada Lovage\n"), **BESIDE},
    {**made(CHIPS), **MANY, "chips/package.xml": MANIFEST.replace("a@example.org", "a@ti.com")},
    {**made(CHIPS), **MANY, "demo/setup.py": "setup(author='Texas Instruments')\n"},
    {**made(CHIPS + "# Copyright 2020 Ada Lovage\n"), **MANY},
    {**made(CHIPS + "# Copyright 2020 Somebody\n"), **MANY},
    {**made(CHIPS + "# Modified by Somebody\n"), **MANY},
    {**made(CHIPS, "import rospy\n" + BODY), **MANY},
    {**made(CHIPS.replace("Redistribution and use in source and binary forms", "All rights reserved")), **MANY},
    {
        **made(CHIPS.replace("Texas Instruments, Inc.", "Some Instruments, Inc.")),
        **{name: text.replace("Texas", "Some") for name, text in MANY.items()},
    },
    {
        **made("# For chips of Texas Instruments.\n" + HEAD),
        **MANY,
        "demo/more.py": HEAD,
        "demo/again.py": HEAD,
        "demo/other.py": HEAD,
    },
    made(""),
    made("# Sums.\n"),
    made("# Copyright (c) 1999 Grete Stromberg\n"),
    made(MIT),
    made(HEAD.replace("Grete Stromberg", "Ada Lovage")),
    made(HEAD.replace("Grete Stromberg", "Lovage Labs")),
    made(HEAD.replace("Grete Stromberg", "Robotics Research Group")),
    made(HEAD.replace("Grete Stromberg", "the authors")),
    made(HEAD + "# Copyright 2020 Ada Lovage\n"),
    made(HEAD + "# Copyright 2020 the authors\n"),
    made(HEAD + "# Modified by somebody in 2015.\n"),
    made(HEAD + "# Adapted to Python 3.\n"),
    made("# Copyright 2020 Grete Stromberg\n# Licensed under the Apache License, Version 2.0\n"),
    made(body="a = 1\n" * 20),
    made(body="import rospy\n" + BODY),
    made(body="from std_msgs.msg import String\n" + BODY),
    made(body="from . import node1\n" + BODY),
    made(body="from demo.node1 import go\n" + BODY),
    made(body="import os, node2\n" + BODY),
    made(demo__setup_dot_py="setup(author='Grete Stromberg')\n"),
    made(other__package_dot_xml=MANIFEST.replace("demo", "other").replace("Ada Lovage", "Grete S.")),
    made(demo__lib__more_dot_py=HEAD + BODY),
    made(demo__lib__sums_dot_py=HEAD + BODY + "b = 1\n"),
    made(demo__lib__sums_dot_py=HEAD + BODY, demo__lib__more_dot_py=HEAD + BODY),
    made(demo__more_dot_py="# Written with Grete.\n" + BODY),
    made(**{f"demo__more{number}_dot_py": HEAD + BODY for number in range(3)}),
    {**made(), "demo/node0.py": "# Copyright 2020 Somebody\n" + MIT},
    {**made(), "demo/package.xml": MANIFEST.replace("Apache-2.0", "MIT License")},
    {path: text for path, text in made().items() if path != "demo/node0.py"},
    {path: text for path, text in made().items() if path != "demo/package.xml"},
    made("import os\n" + HEAD),
    made('a = """\nCopyright (c) 1999 Grete Stromberg\n' + MIT + '"""\n'),
]


@pytest.mark.parametrize("files", FIRES)
def test_a_copy(tmp_path: Path, files: dict[str, str]) -> None:
    assert is_copy(tmp_path, files)


@pytest.mark.parametrize("files", QUIET)
def test_the_projects_own(tmp_path: Path, files: dict[str, str]) -> None:
    assert not is_copy(tmp_path, files)


HEADER = "/*\n * Copyright (c) 2013 Grete Stromberg\n * Permission is hereby granted, free of charge, to any\n */\n#pragma once\n"
NODES = {f"demo/src/node{number}.cpp": "// Copyright 2020 Ada Lovage\n#include <ros/ros.h>\n" for number in range(5)}


@pytest.mark.parametrize(
    ("include", "expected"),
    [
        ("#include <vector>\n", True),
        ("#include <ros/ros.h>\n", False),
        ('#include "std_msgs/String.h"\n', False),
        ("#include <demo/other.hpp>\n", False),
        ('#include "own.hpp"\n', False),
    ],
)
def test_a_header(tmp_path: Path, include: str, expected: bool) -> None:
    files = {"demo/package.xml": MANIFEST, "demo/src/own.hpp": "int a;\n", **NODES}
    files["demo/include/plot.h"] = HEADER + include + "int b;\n" * 120
    assert is_copy(tmp_path, files, "demo/include/plot.h") is expected


def test_a_script_outside_of_packages(tmp_path: Path) -> None:
    loose = {path.replace("demo/", "try/"): text for path, text in OWN.items()}
    files = {"demo/package.xml": MANIFEST, **loose, "try/sums.py": HEAD + BODY}
    assert is_copy(tmp_path, files, "try/sums.py")
    assert not is_copy(tmp_path, {"demo/package.xml": MANIFEST.replace("Apache-2.0", "MIT License")}, "try/sums.py")


def test_only_what_was_a_copy_before(tmp_path: Path) -> None:
    before, now = tmp_path / "before", tmp_path / "now"
    assert is_copy(now, made()) and not is_copy(before, made(""))
    here, old = discover(now, (".",)), discover(before, (".",))
    assert not SingleCopies(here, SingleCopies(old)).among([PLACE])
    assert not SingleCopies(here, is_known=False).among([PLACE])
    assert SingleCopies(here, SingleCopies(here)).found == () and SingleCopies(here, SingleCopies(here)).among([PLACE])
    assert not SingleCopies(here).among(["gone.py"])


@pytest.mark.parametrize("filler", ["copyright ", "copyright (c) ", "copyright 2020, ", "(c)", "1", "apache ", "mit "])
def test_long_heads_take_no_time(tmp_path: Path, filler: str) -> None:
    start = time.monotonic()
    is_copy(tmp_path, made("# " + filler * 4000 + "\n"))
    is_copy(tmp_path, made("# Copyright 2020 Stromberg\n" + MIT, "import " + filler * 4000 + "\n" * 200))
    assert time.monotonic() - start < 5
