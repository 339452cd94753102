# SPDX-License-Identifier: Apache-2.0
"""Which single files are copies of well-known libraries."""

from __future__ import annotations

import time

import pytest

from haros_ci.workspace.known_copies import copied_library, is_of_project

NIELS = "// SPDX-FileCopyrightText: 2013-2023 Niels Lohmann <https://example.org>\n"
REST = "int x;\n" * 200

FIRES = [
    ("a/json.hpp", NIELS, "json"),
    ("json.hpp", "#pragma once\n/*\n * JSON for Modern C++\n * |_|  version 3.1.0\n */\n", "json"),
    ("a/stb_image.h", "/* stb_image - v2.27 - public domain image loader - http://nothings.org/stb */\n", "stb"),
    ("a/httplib.h", "//\n//  httplib.h\n//\n//  Copyright (c) 2023 Yuji Hirose. All rights reserved.\n", "httplib"),
    ("a/tinyxml2.cpp", "/*\nOriginal code by Lee Thomason (www.example.org)\n*/\n", "tinyxml2"),
    ("a/catch.hpp", "/*\n *  Catch v2.13.9\n *  Copyright (c) 2022 Two Blue Cubes Ltd.\n */\n", "catch"),
    ("a/jsoncpp.cpp", "/// Json-cpp amalgamated source (http://jsoncpp.sourceforge.net/).\n", "jsoncpp"),
    ("a/matplotlibcpp.h", "// Source: https://github.com/lava/matplotlib-cpp\n", "matplotlibcpp"),
    (
        "a/matplotlibcpp.h",
        "#pragma once\n\n// Python headers must be included before any system headers, since\n// they define _POSIX_C_SOURCE\n",
        "matplotlibcpp",
    ),
    ("a/imgui_draw.cpp", "// dear imgui, v1.89\n", "imgui"),
    (
        "a/sqlite3.c",
        "/****\n** This file is an amalgamation of many separate C source files from SQLite\n*/\n",
        "sqlite3",
    ),
    ("a/unix.cc", "/* Copyright 2012 William Woodall and John Harrison\n * the Serial library\n */\n", "serial"),
]
QUIET = [
    ("a/json.hpp", "", 200),
    ("a/json.hpp", "// Reads the settings, by means of JSON for Modern C++.\n", 200),
    ("a/json.hpp", "// Copyright 2020 Somebody Else\n", 200),
    ("a/json.hpp", NIELS, 20),
    ("a/settings.hpp", NIELS, 200),
    ("a/json.hpp", "#include <x>\n" + NIELS, 200),
    ("a/json.hpp", 'const char * s = "Copyright Niels Lohmann";\n', 200),
    ("a/jsoncpp.cpp", "// Reads our settings with JsonCpp\n", 200),
    ("a/matplotlibcpp.h", "// Plots for our robot\n", 200),
    ("a/plot.h", "// Python headers must be included before any system headers\n", 200),
    ("a/plots.h", "// After https://github.com/lava/matplotlib-cpp\n", 200),
    ("a/getopt.c", "// Copyright 2020 Somebody Else\n", 200),
    ("a/serial.cc", "// Copyright 2020 Somebody Else, serial lines\n", 200),
    ("a/imgui_panel.cpp", "// Our panel, drawn by imgui.\n", 200),
    ("a/argparse.hpp", "/* Licensed under the MIT License */\n", 200),
    ("a/my_stb_image.h", "/* http://nothings.org/stb */\n", 200),
]


@pytest.mark.parametrize(("path", "head", "library"), FIRES)
def test_is_one(path: str, head: str, library: str) -> None:
    assert copied_library(path, "cpp", (head + REST).encode()) == library


@pytest.mark.parametrize(("path", "head", "lines"), QUIET)
def test_is_none(path: str, head: str, lines: int) -> None:
    assert copied_library(path, "cpp", (head + "int x;\n" * lines).encode()) == ""


def test_python_is_none() -> None:
    assert copied_library("a/json.hpp", "python", (NIELS + REST).encode()) == ""


LLVM = "#!/usr/bin/env python\n#\n#===- format -*- python -*--===#\n#\n#   The LLVM Compiler Infrastructure\n#\n"


@pytest.mark.parametrize(
    ("path", "head", "library"),
    [
        ("tools/git-clang-format", LLVM, "clang"),
        ("run-clang-tidy-14.py", LLVM.replace("The LLVM Compiler Infrastructure", "Part of the LLVM Project"), "clang"),
        (
            "a/cpplint.py",
            "#!/usr/bin/env python\n#\n# Copyright (c) 2009 Google Inc. All rights reserved.\n",
            "cpplint",
        ),
        ("inputs.py", '"""Inputs - user input for humans.\n\n"""\n\n# Copyright (c) 2016, Zeth\n', "inputs"),
        ("a/transforms.py", "# -*- coding: utf-8 -*-\n# Copyright (c) 2006, Christoph Gohlke\n", "transformations"),
        ("a/inputs.py", '"""Inputs of our network."""\n', ""),
        ("a/my_inputs.py", "# Copyright (c) 2016, Zeth\n", ""),
        ("a/transforms.py", "# Copyright 2020 Somebody Else\n", ""),
        ("a/geometry.py", "# Copyright (c) 2006, Christoph Gohlke\n", ""),
        ("a/git-clang-format", "#!/usr/bin/env python\n", ""),
        ("a/format.py", LLVM, ""),
        ("a/cpplint.py", "# Copyright 2020 Somebody Else\n", ""),
        ("a/stats.py", "# Copyright 2020 Somebody Else\n", ""),
        ("a/cpplint.py", "import os\n# Copyright (c) 2009 Google Inc.\n", ""),
    ],
)
def test_scripts(path: str, head: str, library: str) -> None:
    assert copied_library(path, "python", (head + "x = 1\n" * 200).encode()) == library


def test_the_project_itself() -> None:
    assert (
        is_of_project("serial", "serial")
        and is_of_project("catch", "catch2")
        and is_of_project("magicenum", "magic_enum")
    )
    assert not any(is_of_project("catch", name) for name in ("catch_ros", "catch2-vendor", "catch_ros2"))
    assert (
        not is_of_project("json", None) and not is_of_project("json", "robot") and not is_of_project("json", "my_json")
    )


@pytest.mark.parametrize("filler", ["Copyright ", "Copyright William Woodall ", "amalgamation of ", "/", "version "])
def test_long_comments_take_no_time(filler: str) -> None:
    start = time.monotonic()
    for name in ("json.hpp", "unix.cc", "sqlite3.c", "backward.hpp"):
        copied_library(name, "cpp", b"/*" + filler.encode() * 3000 + b"*/" + b"\n" * 200)
    assert time.monotonic() - start < 2


@pytest.mark.parametrize(
    ("path", "line", "lines", "library"),
    [
        ("a/easysensors.py", "see our Dexter Industries `shop`_.", 200, "gopigo3"),
        ("easygopigo3.py", "see our Dexter Industries `shop`_.", 200, "gopigo3"),
        ("a/easysensors.py", "see our Dexter Industries `shop`_.", 20, ""),
        ("a/easysensors.py", "sensors of Dexter Industries", 200, ""),
        ("a/my_easysensors.py", "see our Dexter Industries `shop`_.", 200, ""),
        ("a/sensors.py", "see our Dexter Industries `shop`_.", 200, ""),
    ],
)
def test_a_script_without_a_head(path: str, line: str, lines: int, library: str) -> None:
    text = f'import time\n"""\n{line}\n"""\n' + "x = 1\n" * lines
    assert copied_library(path, "python", text.encode()) == library
    assert copied_library(path, "cpp", text.encode()) == ""
