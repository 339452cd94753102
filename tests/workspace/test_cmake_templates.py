# SPDX-License-Identifier: Apache-2.0
"""Files that become CMake files are judged as such where a change brings or edits them."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.workspace.build_changes import brought_steps
from haros_ci.workspace.build_steps import steps_not_followed
from haros_ci.workspace.cmake_templates import as_cmake
from haros_ci.workspace.discover import discover

FLAGS = "project(a)\nadd_compile_options(-include ${PROJECT_SOURCE_DIR}/cfg/part.glsl)\n"
MADE = "configure_file({} ${{CMAKE_BINARY_DIR}}/{})\n"


def brought(place: Path, old: dict[str, str], new: dict[str, str]) -> list[tuple[str, int | None]]:
    for side, texts in (("old", old), ("new", new)):
        for path, text in texts.items():
            (place / side / path).parent.mkdir(parents=True, exist_ok=True)
            (place / side / path).write_text(text)
    found, _ = brought_steps(discover(place / "new", ["."]), discover(place / "old", ["."]))
    return [(problem.path, problem.line) for problem in found]


@pytest.mark.parametrize(
    ("path", "command"),
    [
        ("cfg/flags.cmake.in", ""),
        ("cfg/flags.cmake.em", ""),
        ("cfg/flags.cmake.develspace.in", ""),
        ("cfg/flags.txt", MADE.format("cfg/flags.txt", "flags.cmake COPYONLY")),
        ("cfg/vars.in", MADE.format('"cfg/vars.in"', "vars.cmake @ONLY")),
        ("cfg/lists", MADE.format("\n  cfg/lists", "more/CMakeLists.txt")),
        ("cfg/flags.txt", "configure_package_config_file(cfg/flags.txt part.cmake INSTALL_DESTINATION x)\n"),
    ],
)
def test_reported(tmp_path: Path, path: str, command: str) -> None:
    base = {"CMakeLists.txt": f"project(a)\n{command}"}
    assert brought(tmp_path, base, base | {path: FLAGS}) == [(path, 2)]


@pytest.mark.parametrize(
    ("path", "old", "new", "command"),
    [
        ("cfg/flags.cmake.in", FLAGS, FLAGS, ""),
        ("cfg/flags.cmake.in", FLAGS, f"# more\n{FLAGS}", ""),
        ("cfg/flags.txt", "", FLAGS, ""),
        ("cfg/flags.txt", "", FLAGS, MADE.format("cfg/flags.txt", "flags.txt")),
        ("cfg/flags.txt", "", FLAGS, MADE.format("cfg/other.txt", "flags.cmake")),
        ("cfg/flags.cmake.txt", "", FLAGS, ""),
        ("cfg/flags.cmake.in", "", "add_compile_options(-Wall)\n", ""),
    ],
)
def test_quiet(tmp_path: Path, path: str, old: str, new: str, command: str) -> None:
    base = {"CMakeLists.txt": f"project(a)\n{command}"}
    assert brought(tmp_path, base | ({path: old} if old else {}), base | {path: new}) == []


def test_usual_templates_are_read_whole() -> None:
    text = """@PACKAGE_INIT@
@[if DEVELSPACE]@
set(PART_DIR "@(CMAKE_CURRENT_SOURCE_DIR)/cmake")
@[else]@
set(PART_DIR "${@PROJECT_NAME@_DIR}")
@[end if]@
include("${CMAKE_CURRENT_LIST_DIR}/@PROJECT_NAME@Targets.cmake")
set_and_check(PART_INCLUDES "@PACKAGE_INCLUDES@")
check_required_components(@PROJECT_NAME@)
"""
    assert steps_not_followed(as_cmake(text)) == ()
    assert as_cmake(text).count("\n") == text.count("\n")


def test_what_nobody_finds_by_its_name_is_noted() -> None:
    for text in ("configure_file(${A} ${B})", "configure_file(cfg/${A} flags.cmake)", "configure_file(${A}.in a.hpp)"):
        assert [step.is_usual for step in steps_not_followed(text)] == [True]
    for text in (
        "configure_file(${HERE}/a.in ${B})",
        "configure_file(${A} a.txt)",
        "configure_file(cfg/${A}.in a.yaml)",
    ):
        assert steps_not_followed(text) == ()


def test_hostile_text_takes_linear_time() -> None:
    for text in ("@(", "@[", "@{", "@a", "configure_file(a ", "@((("):
        as_cmake(text * 50_000)
