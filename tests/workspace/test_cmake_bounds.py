# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import built, messages, names


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        ("add_subdirectory(gone)", "add_subdirectory(gone): no CMakeLists.txt there; what it would add is missing"),
        (
            "include(cmake/gone.cmake)",
            "include(cmake/gone.cmake): no such file in the workspace; what it defines is missing",
        ),
        ("robot_add_library(x y)", "robot_add_library() is not known; what it builds is missing from the analysis"),
        ("add_library(l gone.cpp)", "l: gone.cpp is not in the workspace (generated?); its code is not seen"),
        (
            "find_package(X)\nadd_library(l ${X_SOURCES})",
            "l: ${X_SOURCES} is only known in a build; it is not among the sources",
        ),
        (
            "while(TRUE)\nendwhile()",
            "its CMake takes too long to follow (a loop that does not end?); targets after this point are missing",
        ),
        ("add_message_files(FILES Gone.msg)", "the interface msg/Gone.msg is not among the files"),
        ("set(x", "set(...) is not closed; what follows is not read"),
    ],
)
def test_problems(cmake: str, expected: str) -> None:
    assert [message for _, message in messages(built(cmake))] == [expected]


@pytest.mark.parametrize(
    "cmake",
    [
        "robot_add_flags(x)",
        "add_custom_target(x)",
        "add_dependencies(x y)",
        "catkin_package()",
        "include(GNUInstallDirs)",
        "include(gone.cmake OPTIONAL)",
        "include(${catkin_DIR}/x.cmake)",
        "find_package(X)\nif(X_FOUND)\nadd_subdirectory(gone)\nendif()",
        "add_library(l ${CMAKE_CURRENT_BINARY_DIR}/gen.h)",
        "message(FATAL_ERROR no)",
        "target_link_libraries(unknown x)",
        "install(TARGETS unknown)",
        "set()\nlist()\nstring()\nforeach()\nendforeach()\nadd_executable()\ninstall()\nmath()\nfile()\nproject()",
        "function()\nendfunction()\nmacro()\nendmacro()\nif()\nendif()\nwhile()\nendwhile()",
        "list(GET)\nlist(GET L)\nlist(INSERT L)\nlist(TRANSFORM L)\nlist(FILTER L)\nstring(REGEX)\nstring(REGEX MATCH)",
    ],
)
def test_what_stays_quiet(cmake: str) -> None:
    assert messages(built(cmake)) == []


BOMBS = [
    "set(A " + "a" * 165 + ")\nforeach(i RANGE 4000)\nif(A MATCHES a*a*b)\nendif()\nendforeach()",
    "find_package(X)\nforeach(i RANGE 4000)\nif(X_FOUND)\nadd_library(${i} m.cpp)\nbreak()\nendif()\nendforeach()",
    "foreach(i RANGE 4000)\nadd_library(a ${i}.cpp)\nendforeach()",
    "set(A aaaaaaaaaa)\n" + 'set(A "${A}${A}${A}${A}${A}${A}${A}${A}")\n' * 30,
    "foreach(i RANGE 4000)\nforeach(j RANGE 4000)\nset(x y)\nendforeach()\nendforeach()",
    "function(f)\nf()\nendfunction()\nf()",
    "macro(m)\nm()\nm()\nendmacro()\nm()",
    "include(CMakeLists.txt)",
    "set(L a)\nwhile(TRUE)\nlist(APPEND L ${L})\nendwhile()",
    "find_package(X)\n" + "if(X_FOUND)\n" * 55 + "endif()\n" * 55,
    "find_package(X)\n" + "foreach(i RANGE 900)\nif(X_FOUND)\nset(a${i} ${i})\nendif()\nendforeach()\n" * 20,
    "set(A ${" * 3000 + "}" * 3000 + ")",
    "add_library(a " + "$<" * 3000 + ")",
    "math(EXPR x " + "(" * 3000 + ")",
    "math(EXPR x " + '"' + "-" * 3000 + '1")',
    "if(" + "NOT " * 3000 + "A)\nendif()",
    "foreach(i RANGE -999999999 999999999)\nendforeach()",
    "string(REPEAT a 100000 A)\nforeach(i RANGE 3000)\nstring(REPLACE a b B ${A})\nendforeach()",
]


@pytest.mark.parametrize("cmake", BOMBS, ids=range(len(BOMBS)))
def test_bombs_end(cmake: str) -> None:
    build = built(cmake + "\nadd_library(after m.cpp)", "m.cpp")
    assert len(build.problems) <= 101 and "b" not in names(build)


def test_any_commands() -> None:
    hypothesis = pytest.importorskip("hypothesis")
    st = hypothesis.strategies
    word = st.sampled_from(
        [
            "a",
            "${A}",
            "${X_FOUND}",
            '"a;b"',
            "NOT",
            "A",
            "(",
            ")",
            "MATCHES",
            "(a*)*",
            "PARENT_SCOPE",
            "LISTS",
            "IN",
            "-1",
            "$<BOOL:${A}>",
            "$<",
            ">",
            "ALIAS",
            "FILES",
            "DESTINATION",
            "PROPERTIES",
            "\\;",
            "RANGE",
            "9",
            "[",
            "\ue001{a}",
        ]
    )
    command = st.sampled_from(
        [
            "set",
            "list",
            "list(APPEND A ",
            "list(INSERT A ",
            "string(REGEX REPLACE ",
            "string",
            "if",
            "else",
            "elseif",
            "endif()",
            "foreach",
            "endforeach()",
            "while",
            "endwhile()",
            "function(f ",
            "endfunction()",
            "f",
            "macro(f ",
            "endmacro()",
            "add_library",
            "add_executable",
            "install(FILES ",
            "install",
            "target_sources",
            "return()",
            "break()",
            "find_package(X ",
            "math(EXPR A ",
            "file(GLOB A ",
            "get_filename_component(A ",
            "include",
            "set_target_properties",
            "cmake_parse_arguments",
            "rclcpp_components_register_node",
            "add_message_files",
        ]
    )
    line = st.tuples(command, st.lists(word, max_size=5)).map(
        lambda pair: (
            pair[0] if pair[0][-1] == ")" else pair[0] + ("" if "(" in pair[0] else "(") + " ".join(pair[1]) + ")"
        )
    )

    @hypothesis.settings(max_examples=60, deadline=None, database=None, derandomize=True)
    @hypothesis.given(st.lists(line, max_size=15).map("\n".join))
    def check(text: str) -> None:
        first = built(text, "a")
        assert first == built(text, "a")

    check()


def test_targets_are_bounded() -> None:
    """Behind a hundred other problems, too."""
    missing = "".join(f"add_library(m{number} gone{number}.cpp)\n" for number in range(100))
    build = built(missing + "".join(f"add_executable(t{number} m.cpp)\n" for number in range(1_200)))
    assert len(build.targets) == 1_000
    [message] = [message for _, message in messages(build) if "more than 1000 targets" in message]
    assert message.endswith("the rest is ignored")
