# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import value


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        ("set(OUT a b)", ["a", "b"]),
        ('set(OUT "a;b" c)', ["a", "b", "c"]),
        ("set(A b)\nset(OUT x${A}y)", ["xby"]),
        ("set(A b)\nset(b c)\nset(OUT ${${A}})", ["c"]),
        ("set(P_SRC x)\nset(N P)\nset(OUT ${${N}_SRC})", ["x"]),
        ("project(foo)\nset(OUT ${PROJECT_NAME}_x)", ["foo_x"]),
        ('set(OUT "a\\;b")', ["a;b"]),
        ("set(OUT [[${A}]])", ["${A}"]),
        ("set(ENV{X} y)\nset(OUT $ENV{X})", ["y"]),
        ("set(C v CACHE STRING doc)\nset(OUT $CACHE{C} x${C})", ["v", "xv"]),
        ("set(C v)\nset(C w CACHE STRING doc)\nset(OUT ${C})", ["w"]),
        ("set(C v CACHE STRING doc)\nset(C w CACHE STRING doc)\nset(OUT ${C})", ["v"]),
        ("set(C v CACHE STRING doc)\nset(C w CACHE STRING doc FORCE)\nset(OUT ${C})", ["w"]),
        ("set(C v)\noption(C doc ON)\nset(OUT ${C})", ["v"]),
        ("set(A a)\nunset(A)\nset(OUT x${A})", ["x"]),
        ("set(OUT a)\nlist(APPEND OUT b c)", ["a", "b", "c"]),
        ("set(OUT a)\nlist(PREPEND OUT b)", ["b", "a"]),
        ("set(OUT a b)\nlist(INSERT OUT 1 x)", ["a", "x", "b"]),
        ("set(OUT a b a)\nlist(REMOVE_DUPLICATES OUT)\nlist(REMOVE_ITEM OUT b)", ["a"]),
        ("set(OUT a b c)\nlist(REMOVE_AT OUT 0 -1)", ["b"]),
        ("set(OUT b a c)\nlist(SORT OUT)\nlist(REVERSE OUT)", ["c", "b", "a"]),
        ("set(L a b c)\nlist(GET L 0 -1 OUT)", ["a", "c"]),
        ("set(L a b c)\nlist(LENGTH L OUT)", ["3"]),
        ("set(L a b c)\nlist(FIND L b OUT)", ["1"]),
        ("set(L a b c)\nlist(FIND L x OUT)", ["-1"]),
        ("set(L a b c)\nlist(SUBLIST L 1 -1 OUT)", ["b", "c"]),
        ("set(L a b)\nlist(JOIN L + OUT)", ["a+b"]),
        ("set(OUT a.cpp b.h)\nlist(FILTER OUT EXCLUDE REGEX \\\\.h$)", ["a.cpp"]),
        ("set(OUT a b)\nlist(TRANSFORM OUT PREPEND src/)", ["src/a", "src/b"]),
        ("set(L a b)\nlist(TRANSFORM L REPLACE a x OUTPUT_VARIABLE OUT)", ["x", "b"]),
        ("set(L a b)\nlist(POP_BACK L OUT)", ["b"]),
        ("set(OUT a b)\nlist(POP_FRONT OUT)", ["b"]),
        ("string(TOUPPER ab OUT)", ["AB"]),
        ("string(REPLACE . _ OUT a.b)", ["a_b"]),
        ('string(REGEX REPLACE "(.*)\\\\.cpp" "\\\\1_node" OUT talker.cpp)', ["talker_node"]),
        ("string(REGEX MATCH [0-9]+ OUT a12b)", ["12"]),
        ("string(REGEX MATCHALL [0-9] OUT a1b2)", ["1", "2"]),
        ('string(REGEX MATCH "(a)(b)" _ ab)\nset(OUT ${CMAKE_MATCH_2})', ["b"]),
        ("string(CONCAT OUT a b c)", ["abc"]),
        ("string(JOIN - OUT a b)", ["a-b"]),
        ("set(OUT a)\nstring(APPEND OUT b c)", ["abc"]),
        ("string(SUBSTRING hello 1 3 OUT)", ["ell"]),
        ("string(LENGTH hello OUT)", ["5"]),
        ("string(FIND hello l OUT)", ["2"]),
        ('string(STRIP "  a " OUT)', ["a"]),
        ("string(REPEAT ab 3 OUT)", ["ababab"]),
        ("string(MAKE_C_IDENTIFIER 1a-b OUT)", ["_1a_b"]),
        ("string(COMPARE EQUAL a a OUT)", ["1"]),
        ('math(EXPR OUT "2 + 3 * (4 - 1)")', ["11"]),
        ('math(EXPR OUT "-7 / 2")', ["-3"]),
        ('math(EXPR OUT "0x10 | 1")', ["17"]),
        ("foreach(i a b)\nlist(APPEND OUT ${i})\nendforeach()", ["a", "b"]),
        ("foreach(i RANGE 2)\nlist(APPEND OUT ${i})\nendforeach()", ["0", "1", "2"]),
        ("foreach(i RANGE 1 5 2)\nlist(APPEND OUT ${i})\nendforeach()", ["1", "3", "5"]),
        ("set(L a b)\nforeach(i IN LISTS L ITEMS c)\nlist(APPEND OUT ${i})\nendforeach()", ["a", "b", "c"]),
        ("set(A 1 2)\nset(B x)\nforeach(a b IN ZIP_LISTS A B)\nlist(APPEND OUT ${a}${b})\nendforeach()", ["1x", "2"]),
        ("foreach(i a b c)\nif(i STREQUAL b)\ncontinue()\nendif()\nlist(APPEND OUT ${i})\nendforeach()", ["a", "c"]),
        ("foreach(i a b c)\nif(i STREQUAL b)\nbreak()\nendif()\nlist(APPEND OUT ${i})\nendforeach()", ["a"]),
        ('set(n 0)\nwhile(n LESS 3)\nlist(APPEND OUT n${n})\nmath(EXPR n "${n}+1")\nendwhile()', ["n0", "n1", "n2"]),
        ("function(f a)\nset(OUT ${a} ${ARGN} ${ARGC} PARENT_SCOPE)\nendfunction()\nf(x y z)", ["x", "y", "z", "3"]),
        ("function(f)\nset(OUT x)\nendfunction()\nf()", []),
        (
            "function(f)\nset(OUT ${ARGV1} PARENT_SCOPE)\nreturn()\nset(OUT n PARENT_SCOPE)\nendfunction()\nF(x y)",
            ["y"],
        ),
        ("macro(m a)\nset(OUT ${a} ${ARGN})\nendmacro()\nm(x y)", ["x", "y"]),
        ("macro(m v)\nset(${v} 1)\nendmacro()\nm(OUT)", ["1"]),
        (
            'function(f)\ncmake_parse_arguments(A "FLAG" "ONE" "MANY" ${ARGN})\n'
            "set(OUT ${A_FLAG} ${A_ONE} ${A_MANY} ${A_UNPARSED_ARGUMENTS} PARENT_SCOPE)\nendfunction()\n"
            "f(u MANY a b ONE c FLAG)",
            ["TRUE", "c", "a", "b", "u"],
        ),
        (
            'cmake_parse_arguments(A "" "ONE" "" ONE "x;y")\nset(OUT ${A_ONE} ${A_UNPARSED_ARGUMENTS})',
            ["x", "y"],
        ),
        ("set(L a b)\nstring(REPLACE a x OUT ${L} c)", ["xbc"]),
        (
            'function(f)\ncmake_parse_arguments(PARSE_ARGV 1 A "" "ONE" "")\n'
            "set(OUT ${A_ONE} PARENT_SCOPE)\nendfunction()\nf(x ONE y)",
            ["y"],
        ),
        ("block(PROPAGATE OUT)\nset(OUT a)\nset(X b)\nendblock()\nlist(APPEND OUT ${X})", ["a"]),
        ("get_filename_component(OUT src/a.tar.gz NAME_WE)", ["a"]),
        ("get_filename_component(OUT src/a.tar.gz EXT)", [".tar.gz"]),
        ("get_filename_component(OUT src/a.cpp DIRECTORY)", ["src"]),
        ("get_filename_component(OUT src/../b.cpp ABSOLUTE)", ["arm/b.cpp"]),
        ("file(RELATIVE_PATH OUT ${CMAKE_SOURCE_DIR}/x ${CMAKE_SOURCE_DIR}/y/z)", ["../y/z"]),
        ("set(OUT ${CMAKE_CURRENT_LIST_DIR})", ["arm"]),
        ("set(OUT ${CATKIN_PACKAGE_BIN_DESTINATION})", ["lib/arm"]),
        ('set(L "a b")\nseparate_arguments(L)\nset(OUT ${L})', ["a", "b"]),
        ("if(FALSE)\nset(OUT a)\nelseif(TRUE)\nset(OUT b)\nelse()\nset(OUT c)\nendif()", ["b"]),
        ("if(TRUE)\nset(OUT a)\nelse()\nset(OUT b)\nendif()", ["a"]),
        ("option(X doc ON)\nif(X)\nset(OUT on)\nendif()", ["on"]),
        ("set(OUT ${NOT_SET} x)", ["x"]),
        ("set(OUT a#b\n)", ["a"]),
    ],
)
def test_values(cmake: str, expected: list[str]) -> None:
    assert value(cmake) == expected


@pytest.mark.parametrize(
    ("cmake", "expected"),
    [
        ("find_package(Eigen3)\nset(OUT ${Eigen3_LIBRARIES})", ["${Eigen3_LIBRARIES}"]),
        ("find_package(catkin REQUIRED)\nset(OUT ${catkin_LIBRARIES} m)", ["${catkin_LIBRARIES}", "m"]),
        ("find_package(Eigen3)\nset(OUT lib${Eigen3_VERSION}x)", ["lib${Eigen3_VERSION}x"]),
        ("find_library(OUT foo)", ["${OUT}"]),
        ("file(READ x.txt OUT)", ["${OUT}"]),
        ("string(TIMESTAMP OUT)", ["${OUT}"]),
        ("string(SHA256 OUT abc)", ["${OUT}"]),
        ("find_package(E)\nstring(TOUPPER ${E_V} OUT)", ["${OUT}"]),
        ("find_package(E)\nmath(EXPR OUT ${E_V}+1)", ["${OUT}"]),
        ("math(EXPR OUT 1/0)", ["${OUT}"]),
        ("math(EXPR OUT 9223372036854775807)", ["9223372036854775807"]),
        ("math(EXPR OUT 9223372036854775808)", ["${OUT}"]),
        ("math(EXPR OUT 0x8000000000000000)", ["${OUT}"]),
        ("math(EXPR OUT ~9223372036854775807)", ["-9223372036854775808"]),
        ("math(EXPR OUT -~9223372036854775807)", ["-9223372036854775808"]),
        ("math(EXPR OUT ~9223372036854775807/-1)", ["${OUT}"]),
        ("math(EXPR OUT \u0661)", ["${OUT}"]),
        ("math(EXPR OUT x)", ["${OUT}"]),
        ('string(REGEX MATCH "(a+)+b" OUT aaaa)', ["${OUT}"]),
        ("string(REPEAT abcdefghij 99999999 OUT)", ["${OUT}"]),
        ("find_package(E)\nset(L a)\nif(E_FOUND)\nlist(APPEND L b)\nendif()\nlist(LENGTH L OUT)", ["${OUT}"]),
        ("find_package(E)\nset(L a)\nif(E_FOUND)\nlist(APPEND L b)\nendif()\nlist(GET L 0 OUT)", ["${OUT}"]),
    ],
)
def test_what_only_a_build_knows_stays_a_reference(cmake: str, expected: list[str]) -> None:
    assert value(cmake) == expected


def test_glob() -> None:
    paths = ("src/b.cpp", "src/a.cpp", "src/deep/c.cpp", "src/a.h")
    assert value("file(GLOB OUT src/*.cpp)", *paths) == ["arm/src/a.cpp", "arm/src/b.cpp"]
    assert value("file(GLOB OUT RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} src/*.h)", *paths) == ["src/a.h"]
    assert value("file(GLOB_RECURSE OUT CONFIGURE_DEPENDS src/*.cpp)", *paths) == [
        "arm/src/a.cpp",
        "arm/src/b.cpp",
        "arm/src/deep/c.cpp",
    ]
    assert value("file(GLOB OUT RELATIVE ${CMAKE_SOURCE_DIR}/src src/*)", *paths) == ["a.cpp", "a.h", "b.cpp", "deep"]
    assert value("file(GLOB OUT src/[!a].cpp src/?.h)", *paths) == ["arm/src/a.h", "arm/src/b.cpp"]
    assert value("file(GLOB OUT ../*/src/a.h /etc/*)", *paths) == ["arm/src/a.h"]
    assert value("aux_source_directory(src OUT)", *paths) == ["src/a.cpp", "src/b.cpp"]
