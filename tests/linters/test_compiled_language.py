# SPDX-License-Identifier: Apache-2.0
"""A file of C that CMake has compiled as C++ is analysed as C++."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from linter_samples import MemoryStore, workspace

from haros_ci.linters import cppcheck
from haros_ci.linters.compiled_language import compiled_as_cpp
from haros_ci.linters.linter import LintOptions
from haros_ci.model.package import Package

PACKAGES = (Package(name="arm", path="arm"), Package(name="other", path="other"))
FILES = {
    "arm/src/part.c": "int a;\n",
    "arm/src/more.c": "int b;\n",
    "other/part.c": "int c;\n",
    "other/d.cpp": "int d;\n",
}


def found(place: Path, text: str) -> frozenset[str]:
    return compiled_as_cpp(workspace(place, FILES | {"arm/CMakeLists.txt": text}, PACKAGES))


@pytest.mark.parametrize(
    ("text", "paths"),
    [
        ("set_source_files_properties(src/part.c PROPERTIES LANGUAGE CXX)\n", {"arm/src/part.c"}),
        ('set_source_files_properties(\n  "src/part.c" # (C)\n  PROPERTIES LANGUAGE "CXX")\n', {"arm/src/part.c"}),
        ("SET_PROPERTY(SOURCE ${HERE}/part.c PROPERTY LANGUAGE CXX)\n", {"arm/src/part.c"}),
        ("set_property(SOURCE [[src/part.c]] PROPERTY LANGUAGE [[CXX]])\n", {"arm/src/part.c"}),
        ("set_source_files_properties(${ALL} PROPERTIES LANGUAGE CXX)\n", {"arm/src/part.c", "arm/src/more.c"}),
        ("set_source_files_properties(../other/part.c src/no.c PROPERTIES LANGUAGE CXX)\n", {"arm/src/part.c"}),
        ("set_source_files_properties(src/part.c PROPERTIES LANGUAGE C)\n", set()),
        ("set_source_files_properties(src/part.c PROPERTIES COMPILE_FLAGS -Wall)\n", set()),
        ("# set_source_files_properties(src/part.c PROPERTIES LANGUAGE CXX)\n", set()),
        ("project(arm LANGUAGES CXX)\nadd_library(a src/part.c)\n", set()),
        ("set_source_files_properties(other/d.cpp src/apart.c PROPERTIES LANGUAGE CXX)\n", set()),
    ],
)
def test_compiled_as_cpp(tmp_path: Path, text: str, paths: set[str]) -> None:
    assert found(tmp_path, text) == paths


def test_cppcheck_is_told(tmp_path: Path) -> None:
    text = "set_source_files_properties(src/part.c PROPERTIES LANGUAGE CXX)\n"
    made = workspace(tmp_path, FILES | {"arm/CMakeLists.txt": text}, PACKAGES)
    units = cppcheck.plan(made, LintOptions(), MemoryStore())
    languages = {unit.file.path: json.loads(unit.group)[0] for unit in units}
    assert languages == {"arm/src/part.c": "c++", "arm/src/more.c": "c", "other/part.c": "c", "other/d.cpp": "c++"}
