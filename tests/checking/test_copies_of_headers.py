# SPDX-License-Identifier: Apache-2.0
"""A header of a well-known library of which a package of the workspace keeps a copy: others need the library, not that package."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

PACKAGE = (
    '<package format="3">\n<name>{0}</name><version>1.0.0</version><description>d</description>\n'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license>\n'
    "<buildtool_depend>ament_cmake</buildtool_depend>{1}<export><build_type>ament_cmake</build_type></export>\n</package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject({0})\nfind_package(ament_cmake REQUIRED)\n{1}\nament_package()\n"
COPY = "//  JSON for Modern C++\n//  version 3.11.2\n// Copyright (c) 2013-2022 Niels Lohmann\n" + "int a;\n" * 200


def messages(declared: str, header: str, tmp_path: Path, cmake: str = "", modules: str = "") -> list[str]:
    files = {
        "demo/package.xml": PACKAGE.format("demo", declared),
        "demo/CMakeLists.txt": CMAKE.format("demo", f"{cmake}\nadd_executable(demo a.cpp)"),
        ".gitmodules": modules,
        "demo/a.cpp": "#include <nlohmann/json.hpp>\nint main() {}\n",
        "other/package.xml": PACKAGE.format("other", ""),
        "other/CMakeLists.txt": CMAKE.format("other", "install(DIRECTORY include/ DESTINATION include)"),
        "other/include/nlohmann/json.hpp": header,
    }
    check = next(check for check in checks() if check.id == "undeclared-dependency")
    return [result.message for result in said(check, Example("", True, files), tmp_path)]


def test_the_library_is_named(tmp_path: Path) -> None:
    (message,) = messages("", COPY, tmp_path)
    assert "<depend>nlohmann-json-dev</depend>" in message and "other" not in message


def test_a_header_of_its_own_is_of_the_package(tmp_path: Path) -> None:
    (message,) = messages("", "int a;\n", tmp_path)
    assert "<depend>other</depend>" in message


@pytest.mark.parametrize("declared", ["other", "nlohmann-json-dev"])
def test_either_is_enough(declared: str, tmp_path: Path) -> None:
    assert messages(f"<depend>{declared}</depend>", COPY, tmp_path) == []


MODULES = '[submodule "demo/external/json"]\n\tpath = demo/external/json\n\turl = https://example.org/json\n'


def test_a_submodule_that_is_not_checked_out_may_bring_it(tmp_path: Path) -> None:
    assert messages("", COPY, tmp_path, "add_subdirectory(external/json)", MODULES) == []


@pytest.mark.parametrize(("cmake", "modules"), [("", MODULES), ("add_subdirectory(external/json)", "")])
def test_a_submodule_of_no_use(cmake: str, modules: str, tmp_path: Path) -> None:
    assert len(messages("", COPY, tmp_path, cmake, modules)) == 1
