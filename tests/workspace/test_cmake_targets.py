# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import built, messages, only

ALL = ("a.cpp", "b.cpp", "s/c.cpp", "s/d.cc", "a.h", "k.cu")


@pytest.mark.parametrize(
    ("cmake", "kind", "sources"),
    [
        ("add_executable(t a.cpp b.cpp)", "executable", ["a.cpp", "b.cpp"]),
        ("add_executable(t WIN32 EXCLUDE_FROM_ALL a.cpp a.cpp)", "executable", ["a.cpp"]),
        ("add_executable(t ./s/../a.cpp)", "executable", ["a.cpp"]),
        ('add_executable(t "a.cpp;b.cpp")', "executable", ["a.cpp", "b.cpp"]),
        ('set(S a.cpp b.cpp)\nadd_library(t "${S}" s/c.cpp)', "library", ["a.cpp", "b.cpp", "s/c.cpp"]),
        ('file(GLOB S s/*)\nadd_library(t SHARED "${S}")', "library", ["s/c.cpp", "s/d.cc"]),
        ('set(S)\nadd_library(t a.cpp "${S}")', "library", ["a.cpp"]),
        ('add_library(t a.cpp)\ntarget_sources(t PRIVATE "b.cpp;a.h")', "library", ["a.cpp", "b.cpp", "a.h"]),
        ("add_executable(t a)", "executable", ["a.cpp"]),
        ("add_executable(t IMPORTED)", "imported", []),
        ("add_executable(x::t ALIAS u)", "alias", []),
        ("add_library(t a.cpp)", "library", ["a.cpp"]),
        ("add_library(t STATIC a.cpp)", "library", ["a.cpp"]),
        ("add_library(t SHARED EXCLUDE_FROM_ALL a.cpp a.h)", "library", ["a.cpp", "a.h"]),
        ("add_library(t MODULE a.cpp)", "library", ["a.cpp"]),
        ("add_library(t OBJECT a.cpp)", "object", ["a.cpp"]),
        ("add_library(t INTERFACE)", "interface", []),
        ("add_library(t UNKNOWN IMPORTED GLOBAL)", "imported", []),
        ("add_library(t)\ntarget_sources(t PRIVATE a.cpp PUBLIC s/c.cpp)", "library", ["a.cpp", "s/c.cpp"]),
        ("add_library(t $<$<BOOL:ON>:a.cpp> $<$<BOOL:OFF>:b.cpp>)", "library", ["a.cpp"]),
        (
            "add_library(t $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/a.cpp> $<INSTALL_INTERFACE:b.cpp>)",
            "library",
            ["a.cpp"],
        ),
        ("add_library(t $<$<NOT:$<BOOL:0>>:a.cpp>)", "library", ["a.cpp"]),
        ("add_library(t $<$<PLATFORM_ID:Linux>:a.cpp>)", "library", ["a.cpp"]),
        ("cuda_add_executable(t k.cu OPTIONS -O2)", "executable", ["k.cu"]),
        ("cuda_add_library(t SHARED k.cu)", "library", ["k.cu"]),
        ("rosbuild_add_executable(t a.cpp)", "executable", ["a.cpp"]),
        ("rosbuild_add_library(t a.cpp)", "library", ["a.cpp"]),
        ("cs_add_executable(t a.cpp)", "executable", ["a.cpp"]),
        ("cs_add_library(t a.cpp)", "library", ["a.cpp"]),
        ("qt_add_executable(t MANUAL_FINALIZATION a.cpp)", "executable", ["a.cpp"]),
        ("ament_auto_add_executable(t a.cpp)", "executable", ["a.cpp"]),
        ("ament_auto_add_library(t SHARED DIRECTORY s)", "library", ["s/d.cc", "s/c.cpp"]),
        ("pybind11_add_module(t MODULE a.cpp)", "library", ["a.cpp"]),
    ],
)
def test_kinds_and_sources(cmake: str, kind: str, sources: list[str]) -> None:
    build = built(cmake, *ALL)
    target = only(build)
    assert (target.kind, list(target.sources)) == (kind, [f"arm/{path}" for path in sources])
    assert target.name in ("t", "x::t") and not target.is_test
    assert target.location.line == (1 if cmake.startswith(("add", "cuda", "ros", "cs", "qt", "ament", "pybind")) else 2)
    assert messages(build) == []


@pytest.mark.parametrize(
    "cmake",
    [
        "catkin_add_gtest(t a.cpp TIMEOUT 60)",
        "catkin_add_gmock(t a.cpp WORKING_DIRECTORY x)",
        "add_rostest_gtest(t test/t.test a.cpp)",
        "ament_add_gtest(t a.cpp TIMEOUT 60 ENV A=b)",
        "ament_add_gtest_executable(t a.cpp)",
        "ament_add_gmock(t a.cpp SKIP_TEST)",
        "ament_auto_add_gtest(t a.cpp)",
        "rosbuild_add_gtest(t a.cpp)",
        "if(CATKIN_ENABLE_TESTING)\nadd_executable(t a.cpp)\nendif()",
        "if(BUILD_TESTING)\nfind_package(x REQUIRED)\nadd_executable(t a.cpp)\nendif()",
        "if(${CATKIN_ENABLE_TESTING})\nadd_executable(t a.cpp)\nendif()",
        'if("${BUILD_TESTING}")\nadd_executable(t a.cpp)\nendif()',
    ],
)
def test_tests(cmake: str) -> None:
    target = only(built(cmake, "a.cpp"))
    assert (target.kind, target.sources, target.is_test) == ("executable", ("arm/a.cpp",), True)


def test_what_stands_behind_testing_is_no_test() -> None:
    build = built("if(BUILD_TESTING)\nfind_package(x)\nelse()\nendif()\nadd_executable(t a.cpp)", "a.cpp")
    assert not only(build).is_test
    assert not only(built("if(NOT BUILD_TESTING)\nelse()\nadd_executable(t a.cpp)\nendif()", "a.cpp")).is_test


def test_links() -> None:
    text = (
        "find_package(catkin REQUIRED)\nadd_library(t a.cpp)\nadd_library(o OBJECT b.cpp)\n"
        "target_link_libraries(t PRIVATE debug x optimized x PUBLIC ${catkin_LIBRARIES} ${NOT_SET} rclcpp::rclcpp\n"
        " $<BUILD_INTERFACE:core> $<INSTALL_INTERFACE:gone> $<$<CONFIG:Debug>:dbg> $<TARGET_OBJECTS:o>)\n"
        "target_link_libraries(t y -lm)"
    )
    target = built(text, "a.cpp", "b.cpp").targets[0]
    assert target.links == ("x", "${catkin_LIBRARIES}", "rclcpp::rclcpp", "core", "dbg", "o", "y", "-lm")


def test_objects_as_sources_are_links() -> None:
    target = built("add_executable(t a.cpp $<TARGET_OBJECTS:o>)", "a.cpp").targets[0]
    assert (target.sources, target.links) == (("arm/a.cpp",), ("o",))


def test_an_alias_links_to_what_it_stands_for() -> None:
    assert only(built("add_library(x::t ALIAS t)")).links == ("t",)


@pytest.mark.parametrize(
    ("cmake", "file"),
    [
        ("add_library(t a.cpp)", ("lib", "t", ".so")),
        ("add_executable(t a.cpp)", ("", "t", "")),
        ("add_executable(t a.cpp)\nset_target_properties(t PROPERTIES OUTPUT_NAME u)", ("", "u", "")),
        ('add_library(t a.cpp)\nset_target_properties(t PROPERTIES X y PREFIX "" SUFFIX .x)', ("", "t", ".x")),
        ("add_library(t a.cpp)\nset_property(TARGET t PROPERTY OUTPUT_NAME u)", ("lib", "u", ".so")),
        ("add_library(t a.cpp)\nset_target_properties(t PROPERTIES RUNTIME_OUTPUT_NAME u)", ("lib", "t", ".so")),
        ("add_library(t a.cpp)\nset_target_properties(u PROPERTIES OUTPUT_NAME u)", ("lib", "t", ".so")),
        ("add_library(t a.cpp)\nset_target_properties(t PROPERTIES OUTPUT_NAME)", ("lib", "t", ".so")),
    ],
)
def test_file_names(cmake: str, file: tuple[str, str, str]) -> None:
    target = only(built(cmake, "a.cpp"))
    assert (target.prefix, target.output, target.suffix) == file


def test_a_file_name_that_depends_is_a_problem() -> None:
    text = "find_package(X)\nadd_library(t a.cpp)\nset_target_properties(t PROPERTIES OUTPUT_NAME t${X_VERSION})"
    build = built(text, "a.cpp")
    assert only(build).output == "t"
    message = "t: its OUTPUT_NAME is only known in a build; the file is taken to be named after the target"
    assert messages(build) == [(3, message)]


def test_sources_under_a_condition_of_the_configuration() -> None:
    target = only(built("add_library(t a.cpp $<$<CONFIG:Debug>:b.cpp>)", "a.cpp", "b.cpp"))
    assert (target.sources, target.conditional_sources) == (("arm/a.cpp", "arm/b.cpp"), ("arm/b.cpp",))


def test_sources_added_under_a_condition() -> None:
    text = "find_package(X)\nadd_library(t a.cpp)\nif(X_FOUND)\ntarget_sources(t PRIVATE b.cpp)\nendif()"
    build = built(text, "a.cpp", "b.cpp")
    assert only(build).conditional_sources == ("arm/b.cpp",)
    assert messages(build) == [(3, "whether (X_FOUND) holds is only known in a build; taken as possible: sources of t")]


def test_components() -> None:
    text = (
        "add_library(c SHARED a.cpp)\nrclcpp_components_register_node(c PLUGIN arm::Talker EXECUTABLE talker)\n"
        "rclcpp_components_register_nodes(c arm::A arm::B)"
    )
    build = built(text, "a.cpp")
    executable = build.targets[1]
    assert (executable.name, executable.kind, executable.links) == ("talker", "executable", ("c",))
    assert (executable.component, executable.is_installed, executable.sources) == ("arm::Talker", True, ())
    assert [(p.name, p.type, p.base, p.library, p.location.line) for p in build.plugins] == [
        ("arm::Talker", "arm::Talker", "rclcpp_components::NodeFactory", "c", 2),
        ("arm::A", "arm::A", "rclcpp_components::NodeFactory", "c", 3),
        ("arm::B", "arm::B", "rclcpp_components::NodeFactory", "c", 3),
    ]


@pytest.mark.parametrize(
    ("cmake", "defined"),
    [
        ("add_definitions(-DA -DB=1 /DC)", ("A", "B", "C")),
        ('add_definitions("-DA=\\"x\\"" -O2 -Wall)', ("A",)),
        ("add_compile_definitions(A B=2 -DC)", ("A", "B", "C")),
        ("add_library(t a.cpp)\ntarget_compile_definitions(t PRIVATE A PUBLIC B=1)", ("A", "B")),
        ("add_library(t a.cpp)\ntarget_compile_options(t PRIVATE -DA -Wno-DB)", ("A",)),
        ("set(X A)\nadd_definitions(-D${X})", ("A",)),
        ('set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -O3 -DA=1 -std=c++14")', ("A",)),
        ("find_package(y)\nif(y_FOUND)\nadd_definitions(-DA)\nendif()", ("A",)),
        ("if(OFF)\nadd_definitions(-DA)\nendif()", ()),
        ("add_library(t a.cpp)\ntarget_link_libraries(t -DA)", ()),
        ("add_compile_options(-O2 -Werror)", ()),
        ("add_definitions()", ()),
        ("", ()),
    ],
)
def test_macros_that_the_build_defines(cmake: str, defined: tuple[str, ...]) -> None:
    assert built(cmake, "a.cpp").defined == defined


@pytest.mark.parametrize(
    ("cmake", "kind", "sources", "known"),
    [
        ("rtmbuild_add_executable(t a.cpp s/c.cpp)", "executable", ["a.cpp", "s/c.cpp"], "add_executable"),
        ("robot_add_executable(t SOMEHOW a.cpp LIBS x)", "executable", ["a.cpp"], "add_executable"),
        ("set(S a.cpp)\nrobot_add_executable(t ${S})", "executable", ["a.cpp"], "add_executable"),
        ("robot_add_library(t SHARED a.cpp)", "library", ["a.cpp"], "add_library"),
        ("Robot_Add_Library(t a.cpp)", "library", ["a.cpp"], "add_library"),
    ],
)
def test_a_command_that_is_not_known_is_taken_for_the_one_that_it_ends_in(
    cmake: str, kind: str, sources: list[str], known: str
) -> None:
    found = built(cmake, *ALL)
    target = only(found)
    assert (target.name, target.kind, [path.removeprefix("arm/") for path in target.sources]) == ("t", kind, sources)
    assert target.is_installed
    ((_, message),) = messages(found)
    assert message.endswith(f"_{known}() is not known; it is taken for {known}()")


@pytest.mark.parametrize(
    "cmake",
    [
        "robot_add_executable(t)",
        "robot_add_executable(t x y)",
        "robot_add_executable(t gone.cpp)",
        "robot_add_executable(t a.h)",
        "robot_add_executable(${N} a.cpp)",
        "robot_add_executable(NAME t/u SOURCES b)",
        "robot_add_executable_of(t a.cpp)",
        "robot_add_node(t a.cpp)",
    ],
)
def test_other_commands_that_are_not_known_make_nothing(cmake: str) -> None:
    found = built(cmake, *ALL)
    assert found.targets == ()
    assert [message for _, message in messages(found)][-1].endswith("what it builds is missing from the analysis")


def test_a_command_of_the_workspace_does_what_it_says() -> None:
    cmake = "function(robot_add_executable name)\nadd_library(${name}_l b.cpp)\nendfunction()\nrobot_add_executable(t a.cpp)"
    found = built(cmake, *ALL)
    assert (only(found).name, messages(found)) == ("t_l", [])
