# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import MANIFEST, built, messages, names, only, workspace_of

from haros_ci.workspace.build import build_of, builds


def test_subdirectories_have_scopes() -> None:
    build = built(
        "set(X a)\nadd_subdirectory(src)\nadd_executable(${X} main.cpp)\nadd_subdirectory(src)",
        "main.cpp",
        "src/lib.cpp",
        src__CMakeLists_txt="set(X b)\nadd_library(l lib.cpp)\nset(Y ${CMAKE_CURRENT_SOURCE_DIR})\nlist(APPEND X ${Y})",
    )
    assert [(t.name, t.sources, t.location.path, t.location.line) for t in build.targets] == [
        ("l", ("arm/src/lib.cpp",), "arm/src/CMakeLists.txt", 2),
        ("a", ("arm/main.cpp",), "arm/CMakeLists.txt", 3),
    ]
    assert messages(build) == []


def test_includes_share_the_scope() -> None:
    build = built(
        "list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_SOURCE_DIR}/cmake)\ninclude(cmake/a.cmake)\ninclude(b)\n"
        "include(CTest)\nadd_executable(${N} ${S})",
        "main.cpp",
        cmake__a_cmake="set(N x)\nreturn()\nset(N y)",
        cmake__b_cmake="set(S main.cpp)",
    )
    assert (only(build).name, only(build).sources) == ("x", ("arm/main.cpp",))
    assert messages(build) == []


def test_a_target_made_in_a_function_stands_where_it_is_called() -> None:
    build = built(
        "function(node name)\n  add_executable(${name} ${ARGN})\n  install(TARGETS ${name} DESTINATION bin)\n"
        "endfunction()\n"
        "node(a a.cpp)\nnode(b b.cpp)",
        "a.cpp",
        "b.cpp",
    )
    assert [(t.name, t.location.line, t.sources, t.is_installed) for t in build.targets] == [
        ("a", 5, ("arm/a.cpp",), True),
        ("b", 6, ("arm/b.cpp",), True),
    ]


def test_other_packages_lend_their_macros() -> None:
    workspace = workspace_of(
        {
            "tools/package.xml": MANIFEST.format("tools"),
            "tools/CMakeLists.txt": "ament_package(CONFIG_EXTRAS tools-extras.cmake)",
            "tools/tools-extras.cmake": 'include("${tools_DIR}/node.cmake")',
            "tools/cmake/node.cmake": "macro(tools_node name)\nadd_executable(${name} ${name}.cpp)\nendmacro()",
            "arm/package.xml": MANIFEST.format("arm"),
            "arm/CMakeLists.txt": "find_package(tools)\ntools_node(talker)",
            "arm/talker.cpp": "int main() {}",
        }
    )
    found = builds(workspace)
    assert [(t.name, t.sources) for t in found["arm"].targets] == [("talker", ("arm/talker.cpp",))]
    assert found["arm"].targets[0].location.path == "arm/CMakeLists.txt"
    assert found["tools"].targets == () and found["arm"].problems == ()


def test_a_package_at_the_root() -> None:
    workspace = workspace_of(
        {
            "package.xml": MANIFEST.format("arm"),
            "CMakeLists.txt": "add_executable(a ${CMAKE_SOURCE_DIR}/src/a.cpp)",
            "src/a.cpp": "int main() {}",
        }
    )
    assert only(build_of(workspace, workspace.packages[0])).sources == ("src/a.cpp",)


@pytest.mark.parametrize(
    ("depends", "targets"),
    [
        ("<buildtool_depend>catkin</buildtool_depend>", ["one"]),
        ("<buildtool_depend>ament_cmake</buildtool_depend>", ["two"]),
        ("", ["one", "two"]),
    ],
)
def test_packages_for_both_ros(depends: str, targets: list[str]) -> None:
    cmake = (
        "find_package(catkin QUIET)\nfind_package(ament_cmake QUIET)\nif(catkin_FOUND)\nadd_library(one m.cpp)\n"
        "elseif(ament_cmake_FOUND)\nadd_library(two m.cpp)\nendif()\n"
        'if("$ENV{ROS_VERSION}" STREQUAL "1")\nadd_library(one_too m.cpp)\nendif()'
    )
    text = f'<package format="2"><name>arm</name>{depends}</package>'
    workspace = workspace_of({"package.xml": text, "CMakeLists.txt": cmake, "m.cpp": "int x;"})
    build = build_of(workspace, workspace.packages[0])
    assert [name for name in names(build) if name != "one_too"] == targets
    assert ("one_too" in names(build)) == ("one" in targets)


def test_what_we_know_by_name_is_not_replaced() -> None:
    text = "macro(rosbuild_add_executable name)\nendmacro()\nrosbuild_add_executable(t m.cpp)"
    assert names(built(text, "m.cpp")) == ["t"]


def test_packages_that_find_each_other() -> None:
    files = {}
    for here, there in (("a", "b"), ("b", "a")):
        files[f"{here}/package.xml"] = MANIFEST.format(here)
        files[f"{here}/CMakeLists.txt"] = (
            f"find_package({there})\ncatkin_package(CFG_EXTRAS x.cmake)\nadd_library({here} m.cpp)"
        )
        files[f"{here}/cmake/x.cmake"] = f"find_package({there})\nset(X 1)"
        files[f"{here}/m.cpp"] = "int x;"
    found = builds(workspace_of(files))
    assert [names(found[name]) for name in "ab"] == [["a"], ["b"]]
    assert found["a"].problems == found["b"].problems == ()
