# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import verdict


@pytest.mark.parametrize(
    ("condition", "before"),
    [
        ("TRUE", ""),
        ("ON", ""),
        ("1", ""),
        ("2.5", ""),
        ("A", "set(A x)"),
        ("${A}", "set(A yes)"),
        ("NOT A", ""),
        ("A AND NOT B", "set(A 1)"),
        ("FALSE AND FALSE OR TRUE", ""),
        ("TRUE OR FALSE OR TRUE AND FALSE OR TRUE", ""),
        ("NOT FALSE AND TRUE", ""),
        ("(FALSE OR TRUE) AND TRUE", ""),
        ("NOT (FALSE OR FALSE)", ""),
        ("A STREQUAL b", "set(A b)"),
        ('"${A}" STREQUAL "b"', "set(A b)"),
        ("A STREQUAL B", "set(A x)\nset(B x)"),
        ("a STRLESS b", ""),
        ("b STRGREATER_EQUAL b", ""),
        ("10 GREATER 9", ""),
        ("1.0 EQUAL 1", ""),
        ("A LESS_EQUAL 3", "set(A 3)"),
        ("3.10 VERSION_GREATER 3.9", ""),
        ("1.2 VERSION_EQUAL 1.2.0", ""),
        ("CMAKE_VERSION VERSION_GREATER_EQUAL 3.5", ""),
        ('"abc.cpp" MATCHES "\\\\.cpp$"', ""),
        ("A MATCHES ^x", "set(A xyz)"),
        ("b IN_LIST A", "set(A a b c)"),
        ("DEFINED A", 'set(A "")'),
        ("DEFINED CACHE{A}", 'set(A x CACHE STRING "")'),
        ("TARGET t", "add_library(t INTERFACE)"),
        ("EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/a.cpp", ""),
        ("IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}", ""),
        ("IS_ABSOLUTE /x", ""),
        ("POLICY CMP0054", ""),
        ("COMMAND f", "function(f)\nendfunction()"),
        ("UNIX", ""),
        ("CATKIN_ENABLE_TESTING", ""),
        ("BUILD_TESTING", ""),
        ("CMAKE_SYSTEM_NAME STREQUAL Linux", ""),
        ("catkin_FOUND", "find_package(catkin REQUIRED COMPONENTS roscpp)"),
        ("Eigen3_FOUND", "find_package(Eigen3 REQUIRED)"),
        ("A", "option(A help ON)"),
        ("Y OR Eigen3_FOUND", "find_package(Eigen3)\nset(Y 1)"),
        ("L", "find_package(X)\nset(L a)\nif(X_FOUND)\nlist(APPEND L b)\nendif()"),
    ],
)
def test_holds(condition: str, before: str) -> None:
    assert verdict(condition, before) is True


@pytest.mark.parametrize(
    ("condition", "before"),
    [
        ("FALSE", ""),
        ("0", ""),
        ("0.0", ""),
        ("A", ""),
        ("A", "set(A OFF)"),
        ("A", 'set(A "")'),
        ("A", "set(A x-NOTFOUND)"),
        ('"A"', "set(A 1)"),
        ("${A}", ""),
        ("TRUE AND FALSE OR FALSE", ""),
        ("TRUE OR TRUE AND FALSE", ""),
        ("NOT TRUE OR FALSE", ""),
        ("a STREQUAL A", ""),
        ('"A" STREQUAL x', "set(A x)"),
        ("x EQUAL y", ""),
        ("3.9 VERSION_GREATER 3.10", ""),
        ("abc MATCHES ^b", ""),
        ("d IN_LIST A", "set(A a b c)"),
        ("d IN_LIST NONE", ""),
        ("DEFINED A", ""),
        ("DEFINED A", "set(A x)\nunset(A)"),
        ("TARGET t", ""),
        ("EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/b.cpp", ""),
        ("WIN32 OR APPLE OR MSVC", ""),
        ("A", "option(A help)"),
        ("WIN32 AND Eigen3_FOUND", "find_package(Eigen3)"),
    ],
)
def test_does_not_hold(condition: str, before: str) -> None:
    assert verdict(condition, before) is False


@pytest.mark.parametrize(
    ("condition", "before"),
    [
        ("Eigen3_FOUND", "find_package(Eigen3)"),
        ("EIGEN3_FOUND", "find_package(Eigen3)"),
        ("NOT Eigen3_FOUND", "find_package(Eigen3)"),
        ("${Eigen3_FOUND}", "find_package(Eigen3)"),
        ("Eigen3_VERSION VERSION_LESS 3", "find_package(Eigen3 REQUIRED)"),
        ("yaml-cpp_FOUND", "pkg_check_modules(yaml-cpp yaml-cpp)"),
        ("HAVE_X", "check_include_file(x.h HAVE_X)"),
        ("LIB", "find_library(LIB foo)"),
        ("OUT MATCHES a", "execute_process(COMMAND ls OUTPUT_VARIABLE OUT)"),
        ("$ENV{HOME} STREQUAL x", ""),
        ("DEFINED ENV{ROS_DISTRO}", ""),
        ("CMAKE_BUILD_TYPE STREQUAL Release", ""),
        ("CMAKE_SYSTEM_PROCESSOR MATCHES arm", ""),
        ("EXISTS /usr/include/x.h", ""),
        ("EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/model.stl", ""),
        ("TARGET Eigen3::Eigen", "find_package(Eigen3)"),
        ("COMMAND not_ours", ""),
        ("a IS_NEWER_THAN b", ""),
        ("A STREQUAL x", "find_package(X)\nif(X_FOUND)\nset(A x)\nendif()"),
        ("b IN_LIST L", "find_package(X)\nset(L a)\nif(X_FOUND)\nlist(APPEND L b)\nendif()"),
        ("Eigen3_FOUND AND TRUE", "find_package(Eigen3)"),
        ("TRUE FALSE", ""),
        ("NOT", ""),
        ("A STREQUAL", ""),
        ("( ) TRUE", ""),
        ('"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa" MATCHES "(a+)+$"', ""),
        ("( " * 40 + "TRUE" + " )" * 40, ""),
    ],
)
def test_only_a_build_knows(condition: str, before: str) -> None:
    assert verdict(condition, before) is None
