# SPDX-License-Identifier: Apache-2.0
"""Branches of #if that the build decides: by definitions of CMake, and by those of the file and its headers."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from follow_kit import cpp_files, follow, main, node, only

from haros_ci.model.architecture import Node

#: ``c`` where neither macro is defined.
BRANCHES = '\n#ifdef A\nADV("a", 1);\n#elif defined(B)\nADV("b", 1);\n#else\nADV("c", 1);\n#endif'
#: CMake after ``add_executable(n …)``, and the publishers: those that are made, those that are ruled out.
DECIDED = (
    ("of the target", "target_compile_definitions(n PRIVATE A)", "a", "bc"),
    ("public", "target_compile_definitions(n PUBLIC A B)", "a", "bc"),
    ("with -D", "target_compile_definitions(n PRIVATE -DA)", "a", "bc"),
    ("with a value", "target_compile_definitions(n PRIVATE A=0)", "a", "bc"),
    ("of the directory", "add_definitions(-DA)", "a", "bc"),
    ("of the directory, of late", "add_compile_definitions(A)", "a", "bc"),
    ("an option", "add_compile_options(-Wall -DA)", "a", "bc"),
    ("an option of the target", "target_compile_options(n PRIVATE -DA)", "a", "bc"),
    ("a property", 'set_target_properties(n PROPERTIES COMPILE_DEFINITIONS "A;B")', "a", "bc"),
    ("flags as a property", 'set_target_properties(n PROPERTIES COMPILE_FLAGS "-O2 -DA=1")', "a", "bc"),
    ("another way to a property", "set_property(TARGET n APPEND PROPERTY COMPILE_DEFINITIONS A)", "a", "bc"),
    ("flags of the compiler", 'set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -Wall -DA")', "a", "bc"),
    ("flags with others that only a build knows", 'set(CMAKE_CXX_FLAGS "${OpenMP_CXX_FLAGS} -DA")', "a", "bc"),
    ("an option that is on", "option(X x ON)\nif(X)\nadd_definitions(-DA)\nendif()", "a", "bc"),
    ("passed on", "add_library(l src/l.cpp)\ntarget_compile_definitions(l PUBLIC A)\ntarget_link_libraries(n l)", "a", "bc"),
    ("passed on by an interface", ("add_library(l INTERFACE)\ntarget_compile_definitions(l INTERFACE A)\n"
     "add_library(x::l ALIAS l)\ntarget_link_libraries(n x::l)"), "a", "bc"),
    ("the second, where the first is another target's",
     "add_executable(m src/main.cpp)\ntarget_compile_definitions(m PRIVATE A)\ntarget_compile_definitions(n PRIVATE B)", "b", "ac"),
    ("neither, where both are another target's",
     "add_executable(m src/main.cpp)\ntarget_compile_definitions(m PRIVATE A B)", "c", "ab"),
    (
        "where the target is",
        ("find_package(X)\nif(X_FOUND)\nadd_executable(m src/main.cpp)\ntarget_compile_definitions(m PRIVATE A)\nendif()\n"
        "if(NOT X_FOUND)\nset_target_properties(n PROPERTIES COMPILE_DEFINITIONS C)\nendif()\n"
        "target_compile_definitions(n PRIVATE B)"),
        "b",
        "ac",
    ),
    # what stays as it is
    ("nobody", "", "abc", ""),
    (
        "in one of two places of the target",
        ("find_package(X)\nif(X_FOUND)\nadd_executable(m src/main.cpp)\ntarget_compile_definitions(m PRIVATE A)\n"
        "else()\nadd_executable(m src/l.cpp)\nendif()\ntarget_compile_definitions(n PRIVATE B)"),
        "ab",
        "c",
    ),
    ("the second alone", "target_compile_definitions(n PRIVATE B)", "ab", "c"),
    ("under a condition", "if(X_FOUND)\nadd_definitions(-DA)\nendif()", "abc", ""),
    ("under a condition of a package", "find_package(X)\nif(X_FOUND)\nadd_definitions(-DA)\nendif()", "abc", ""),
    ("in the other branch", "find_package(X)\nif(X_FOUND)\nelse()\ntarget_compile_definitions(n PRIVATE A)\nendif()", "abc", ""),
    ("taken back", "add_definitions(-DA)\nremove_definitions(-DA)", "abc", ""),
    ("set anew", "target_compile_definitions(n PRIVATE A)\nset_target_properties(n PROPERTIES COMPILE_DEFINITIONS C)", "abc", ""),
    ("set anew, of the directory", "add_definitions(-DA)\nset_target_properties(n PROPERTIES COMPILE_DEFINITIONS C)", "abc", ""),
    ("of who links it", "target_compile_definitions(n INTERFACE A)", "abc", ""),
    ("not passed on", "add_library(l src/l.cpp)\ntarget_compile_definitions(l PRIVATE A)\ntarget_link_libraries(n l)", "bc", "a"),
    ("of one file", "set_source_files_properties(src/main.cpp PROPERTIES COMPILE_DEFINITIONS A)", "abc", ""),
    ("of one file, and of another target", ("add_library(l src/l.cpp)\ntarget_compile_definitions(l PRIVATE A)\n"
     "set_source_files_properties(src/main.cpp PROPERTIES COMPILE_DEFINITIONS A)"), "abc", ""),
    ("of one configuration", 'target_compile_definitions(n PRIVATE "$<$<CONFIG:Debug>:A>")', "abc", ""),
    ("a variable that is not known", "find_package(X)\ntarget_compile_definitions(n PRIVATE ${X_DEFINITIONS})", "abc", ""),
    ("such a variable, and another target's", ("find_package(X)\nadd_library(l src/l.cpp)\ntarget_compile_definitions(l PRIVATE A)\n"
     "target_compile_definitions(n PRIVATE ${X_DEFINITIONS})"), "abc", ""),
    ("of a test", "if(BUILD_TESTING)\nadd_definitions(-DA)\nendif()", "abc", ""),
    ("flags under a condition", 'find_package(X)\nif(X_FOUND)\nset(CMAKE_CXX_FLAGS "-DA")\nendif()', "abc", ""),
    ("flags of one configuration", 'set(CMAKE_CXX_FLAGS_DEBUG "-DA")', "abc", ""),
    ("flags of C", 'set(CMAKE_C_FLAGS "-DA")', "abc", ""),
    ("a name that begins so", "add_definitions(-DAB)", "abc", ""),
    ("no definition", "add_definitions(A)", "abc", ""),
    ("perhaps another target's", ("find_package(X)\nadd_library(l src/l.cpp)\nif(X_FOUND)\n"
     "target_compile_definitions(l PRIVATE A)\nendif()"), "abc", ""),
    ("another directory's", "add_subdirectory(sub)", "c", "ab"),
)  # fmt: skip


def named(found: Node) -> tuple[str, str]:
    """The last letters of the publishers: those that are made, those that are ruled out."""
    ends = [end for end in found.endpoints if end.kind == "publishers"]
    kinds = (sorted(end.name[1:] for end in ends if end.is_ruled_out is dead) for dead in (False, True))
    made, dead = ("".join(kind) for kind in kinds)
    return made, dead


def built(files: Mapping[str, str], cmake: str) -> Node:
    files = {"p/src/l.cpp": "", "p/sub/k.cpp": "", **files}
    files["p/sub/CMakeLists.txt"] = (
        "add_definitions(-DA)\nadd_library(k k.cpp)\ntarget_compile_definitions(k PRIVATE B)\n"
    )
    files["p/CMakeLists.txt"] += f"{cmake}\n"
    found = [n for each in follow(files).configurations for n in each.nodes if each.name == "p/n"]
    assert len(found) == 1
    return found[0]


@pytest.mark.parametrize(("cmake", "made", "dead"), [row[1:] for row in DECIDED], ids=[row[0] for row in DECIDED])
def test_definitions_of_cmake_decide(cmake: str, made: str, dead: str) -> None:
    assert named(built(cpp_files(main(BRANCHES)), cmake)) == (made, dead)


#: What is before main, the condition of the only ``#if``, and what is made: a under it, c under its ``#else``.
CONDITIONS = (
    ("defined here", "#define A", "#ifdef A", "a"),
    ("defined here, not", "#define A", "#ifndef A", "c"),
    ("a number", "#define A 2", "#if A", "a"),
    ("zero", "#define A 0", "#if A", "c"),
    ("compared", "#define A 2", "#if A >= 2 && A < 0x10", "a"),
    ("by another macro", "#define B 3\n#define A B", "#if A == 3", "a"),
    ("in parentheses", "#define A (2 + 1)", "#if (A * 2) == 6", "a"),
    ("long and unsigned", "#define A 20UL", "#if A == 20", "a"),
    ("negative", "#define A 1", "#if -A < 0", "a"),
    ("taken back", "#define A\n#undef A", "#ifdef A", "c"),
    ("taken back, as a number", "#undef A", "#if A", "c"),
    ("one side is enough", "#define A", "#if defined(A) || defined(X)", "a"),
    ("one side is not there", "#undef A", "#if defined A && X > 2", "c"),
    ("a default", "#ifndef A\n#define A 1\n#endif", "#ifdef A", "a"),
    ("continued", "#define A \\\n 2", "#if A \\\n == 2", "a"),
    ("a comment", "#define A 2 // two", "#if A == 2 /* two */", "a"),
    ("constants", "", "#if 1", "a"),
    ("defined in one that is compiled", "#define B\n#ifdef B\n#define A\n#endif", "#ifdef A", "a"),
    # what stays as it is
    ("nobody", "", "#ifdef A", "ac"),
    ("not, nobody", "", "#ifndef A", "ac"),
    ("nobody's value", "", "#if A > 2", "ac"),
    ("the value of a default", "#ifndef A\n#define A 1\n#endif", "#if A", "ac"),
    ("perhaps", "#ifdef X\n#define A\n#endif", "#ifdef A", "ac"),
    ("perhaps taken back", "#define A\n#ifdef X\n#undef A\n#endif", "#ifdef A", "ac"),
    ("one side is not enough", "#define A", "#if defined(A) && defined(X)", "ac"),
    ("a call", "#define A(x) 1", "#if A(2)", "ac"),
    ("of the compiler", "", "#if __GNUC__ > 4", "ac"),
    ("a call beside it", "#define A", "#if defined(A) && VERSION_OF(X)", "ac"),
    ("a version", "", "#if ROS_VERSION_MINIMUM(1, 14, 0)", "ac"),
    ("an operator that is not read", "#define A 1", "#if A ? 1 : 0", "ac"),
    ("divided", "#define A 1", "#if 1 / (A - 1)", "ac"),
    ("a text", '#define A "x"', "#if A", "ac"),
    ("by itself", "#define A A", "#if A", "ac"),
    ("in a circle", "#define A B\n#define B A", "#if A", "ac"),
    ("a sum that is text", "#define A 1 + 1", "#if A * 2 == 3", "ac"),
    ("no number", "#define A 1x", "#if A", "ac"),
    ("nothing", "#define A", "#if A", "ac"),
    ("in a text", 'const char* s = R"(\n#define A\n)";', "#ifdef A", "ac"),
    ("in a comment", "/*\n#define A\n*/", "#ifdef A", "ac"),
    ("too many parentheses", "#define A 1", "#if " + "(" * 300 + "A" + ")" * 300, "ac"),
    ("too many signs", "#define A 1", "#if " + "!" * 300 + "A", "ac"),
    ("too long", "#define A 1", "#if " + "A || " * 300 + "A", "ac"),
    ("too large", "#define A 0xFFFFFFFFFFFFFFFFFFFF", "#if A", "ac"),
    ("too large a product", "#define A 0x7FFFFFFFFFFFFFFF", "#if A * A", "ac"),
    ("too many lines", "\n".join(["#define A"] * 3000), "#ifdef A", "ac"),
)


@pytest.mark.parametrize(
    ("before", "condition", "made"), [row[1:] for row in CONDITIONS], ids=[row[0] for row in CONDITIONS]
)
def test_macros_of_the_file_decide(before: str, condition: str, made: str) -> None:
    found = node(follow(cpp_files(main(f'\n{condition}\nADV("a", 1);\n#else\nADV("c", 1);\n#endif', before))))
    assert named(found) == (made, "ac".replace(made, "") if len(made) == 1 else "")


#: Headers, what is included and defined before main, and what is made under ``#ifdef A`` and its ``#else``.
HEADERS = (
    ("of the workspace", {"h__h": "#pragma once\n#define A\n"}, '#include "h.h"', "a"),
    ("with a guard", {"h__h": "#ifndef H_H\n#define H_H\n#define A\n#endif\n"}, '#include "h.h"\n#include "h.h"', "a"),
    ("of a header", {"h__h": '#include "g.h"\n', "g__h": "#define A\n"}, '#include "h.h"', "a"),
    ("by what is defined before", {"h__h": "#ifdef B\n#define A\n#endif\n"}, '#define B\n#include "h.h"', "a"),
    ("taken back", {"h__h": "#undef A\n"}, '#define A\n#include "h.h"', "c"),
    ("a guard is no doubt", {"h__h": "#ifndef H_H\n#define H_H 1\n#define A\n#endif\n"}, '#include "h.h"', "a"),
    # what stays as it is
    ("after the line", {"h__h": "#define A\n"}, "", "ac"),
    ("of another file", {"h__h": "#define A\n", "o__cpp": '#include "h.h"\n'}, "", "ac"),
    ("outside", {}, '#include <config.h>', "ac"),
    ("perhaps included", {"h__h": "#define A\n"}, '#ifdef X\n#include "h.h"\n#endif', "ac"),
    ("perhaps taken back", {"h__h": "#undef A\n"}, '#define A\n#ifdef X\n#include "h.h"\n#endif', "ac"),
    ("by what is perhaps defined", {"h__h": "#ifdef B\n#define A\n#endif\n"}, '#include "h.h"', "ac"),
    ("each includes the other", {"h__h": '#include "g.h"\n', "g__h": '#include "h.h"\n'}, '#include "h.h"\n#define A', "ac"),
    ("broken", {"h__h": "#endif\n#else\n"}, '#define A\n#include "h.h"', "ac"),
)  # fmt: skip


@pytest.mark.parametrize(("files", "before", "made"), [row[1:] for row in HEADERS], ids=[row[0] for row in HEADERS])
def test_macros_of_headers_decide(files: dict[str, str], before: str, made: str) -> None:
    body = '\n#ifdef A\nADV("a", 1);\n#else\nADV("c", 1);\n#endif'
    found = node(follow(cpp_files(main(body, before), **files)))
    assert named(found) == (made, "ac".replace(made, "") if len(made) == 1 else "")


#: Definitions in branches, and the name of the publisher that uses them, where B is defined and A is another target's.
VALUES = (
    ("a constant", '#ifdef A\nconst std::string s("a");\n#elif defined(B)\nconst std::string s("b");\n#endif', "s", "/b"),
    ("one of three", '#ifdef A\nconst char* s = "a";\n#elif defined(B)\nconst char* s = "b";\n#else\nconst char* s = "c";\n#endif',
     "s", "/b"),
    ("a macro", '#ifdef A\n#define S "a"\n#elif defined(B)\n#define S "b"\n#endif', "S", "/b"),
    ("a function", '#ifndef B\nstd::string f() { return "a"; }\n#else\nstd::string f() { return "b"; }\n#endif', "f()", "/b"),
    ("in a function", 'std::string f() {\n#ifdef A\nreturn "a";\n#endif\nreturn "b";\n}', "f()", "/b"),
    ("a member", 'struct C {\n#ifdef A\nstd::string s = "a";\n#else\nstd::string s = "b";\n#endif\n};', "C().s", "/b"),
    ("in a namespace", '#ifdef B\nnamespace x { const std::string s = "b"; }\n#else\nnamespace x { const std::string s = "a"; }\n#endif',
     "x::s", "/b"),
    ("a default that the build replaces", "#ifndef B\n#define B 2\n#endif", "std::to_string(B)", "/5"),
    # what stays as it is
    ("nobody", '#ifdef X\nconst std::string s("a");\n#else\nconst std::string s("b");\n#endif', "s", "/?"),
    ("nobody's macro", '#ifdef X\n#define S "a"\n#else\n#define S "b"\n#endif', "S", "/?"),
    ("twice", '#define S "a"\n#undef S\n#define S "b"', "S", "/?"),
    ("the first is nobody's", '#ifdef X\nconst std::string s("a");\n#elif defined(B)\nconst std::string s("b");\n#endif', "s", "/?"),
)  # fmt: skip


@pytest.mark.parametrize(("before", "value", "name"), [row[1:] for row in VALUES], ids=[row[0] for row in VALUES])
def test_the_definition_that_is_compiled_counts(before: str, value: str, name: str) -> None:
    cmake = (
        "add_library(l src/l.cpp)\ntarget_compile_definitions(l PRIVATE A)\ntarget_compile_definitions(n PRIVATE B=5)"
    )
    found = built(cpp_files(main(f"ADV({value}, 1);", before)), cmake)
    assert [end.name for end in found.endpoints if end.kind == "publishers"] == [name]


def test_each_target_has_its_own() -> None:
    before = '#ifdef A\nconst std::string s("a");\n#elif defined(B)\nconst std::string s("b");\n#endif'
    files = cpp_files(main("ADV(s, 1);", before))
    files["p/CMakeLists.txt"] += (
        "add_executable(m src/main.cpp)\nset_target_properties(n PROPERTIES COMPILE_DEFINITIONS A)\n"
        "set_target_properties(m PROPERTIES COMPILE_DEFINITIONS B)\n"
    )
    found = {each.name: [e.name for n in each.nodes for e in n.endpoints] for each in follow(files).configurations}
    assert {name: [end for end in ends if len(end) == 2] for name, ends in found.items()} == {
        "p/n": ["/a"],
        "p/m": ["/b"],
    }


def test_a_header_is_compiled_as_all_that_include_it() -> None:
    """Two files of one node, of which one is compiled with the macro: nobody knows whose code of the header it is."""
    header = '#pragma once\ninline void make(ros::NodeHandle& nh) {\n#ifdef A\nADV("a", 1);\n#else\nADV("c", 1);\n#endif\n}\n'
    header = header.replace("ADV(", "nh.advertise<std_msgs::String>(")
    files = cpp_files(main("make(nh);", '#include "h.h"'), h__h=header)
    files["p/src/k.cpp"] = '#include <ros/ros.h>\n#include <std_msgs/String.h>\n#include "h.h"\n'
    one = "target_compile_definitions(n PRIVATE A)"
    assert named(built(files, one)) == ("a", "c")
    assert named(built(files, f"{one}\nadd_library(k src/k.cpp)\ntarget_link_libraries(n k)")) == ("ac", "")


def test_what_a_function_under_if_makes_is_ruled_out() -> None:
    before = '#ifndef A\nvoid f(ros::NodeHandle& nh) { ADV("c", 1); }\n#endif\n'
    files = cpp_files(main('ADV("a", 1); f(nh);', before))
    assert named(built(files, "add_definitions(-DA)")) == ("a", "c")
    assert named(built(files, "")) == ("ac", "")
    assert only(follow(files)).name == "p/n"


@pytest.mark.parametrize(
    ("case", "made"),
    [
        ("#if A || B\n%s break;\n#else\nexit(-1);\n#endif", True),
        ("#ifdef A\n%s break;\n#endif", True),
        ("#ifdef A\nexit(-1);\n#else\n%s break;\n#endif", True),
        ("#ifdef A\n#endif\n%s break;", True),
        ("#if 0\n%s break;\n#endif", False),
        ("#ifdef A\nbreak;\n#endif\nbreak;\n%s", False),
    ],
)
def test_what_a_case_has_under_an_if_alone(case: str, made: bool) -> None:
    text = "int a; switch (a) { case 1:\n" + case % 'ADV("x", 1);' + "\ndefault: break; }"
    found = node(follow(cpp_files(main(text))))
    assert [end.name for end in found.endpoints if end.kind == "publishers"] == (["/x"] if made else [])
