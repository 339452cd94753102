# SPDX-License-Identifier: Apache-2.0
"""Sources that CMake chooses: of a function that several of them define, of which a build has one, all are told, none for certain."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, PUBLISH, cpp_files, follow, main, node

ONE_OF = "it is in one of several files of which a build has one"
EITHER = "set(S src/main.cpp)\nif({})\nlist(APPEND S src/b.cpp)\nelse()\nlist(APPEND S src/d.cpp)\nendif()\nadd_executable(n ${{S}})\n"
#: CMake, the publishers, and whether those of the files that it chooses are uncertain.
CHOSEN = (
    ("a condition of a package", "find_package(X)\n" + EITHER.format("X_FOUND"), "abd", True),
    ("the environment", EITHER.format('"$ENV{MODE}" STREQUAL "x"'), "abd", True),
    (
        "sources of a target",
        ("find_package(X)\nadd_executable(n src/main.cpp)\nif(X_FOUND)\ntarget_sources(n PRIVATE src/b.cpp)\n"
        "else()\ntarget_sources(n PRIVATE src/d.cpp)\nendif()\n"),
        "abd",
        True,
    ),
    (
        "a library of two kinds",
        ("find_package(X)\nif(X_FOUND)\nadd_library(l src/b.cpp)\nelse()\nadd_library(l src/d.cpp)\nendif()\n"
        "add_executable(n src/main.cpp)\ntarget_link_libraries(n l)\n"),
        "abd",
        True,
    ),
    # what is decided, or has one definition
    ("an option that is on", "option(X x ON)\n" + EITHER.format("X"), "ab", False),
    ("an option that is off", "option(X x)\n" + EITHER.format("X"), "ad", False),
    ("an option that is set", "set(X ON)\noption(X x)\n" + EITHER.format("X"), "ab", False),
    ("a value", "set(M d)\nadd_executable(n src/main.cpp src/${M}.cpp)\n", "ad", False),
    ("a value of the cache", 'set(M d CACHE STRING "m")\nadd_executable(n src/main.cpp src/${M}.cpp)\n', "ad", False),
    ("a value of a default", "if(NOT DEFINED M)\nset(M b)\nendif()\nadd_executable(n src/main.cpp src/${M}.cpp)\n", "ab", False),
    ("a loop", "foreach(x n)\nadd_executable(${x} src/main.cpp src/b.cpp)\nendforeach()\n", "ab", False),
    ("a loop over a list", "set(L b)\nforeach(x IN LISTS L)\nadd_executable(n src/main.cpp src/${x}.cpp)\nendforeach()\n", "ab", False),
    ("all files but one", "file(GLOB S src/*.cpp)\nlist(FILTER S EXCLUDE REGEX b.cpp)\nadd_executable(n ${S})\n", "ad", False),
    ("one more in some builds", ("find_package(X)\nset(S src/main.cpp)\nif(X_FOUND)\nlist(APPEND S src/b.cpp)\nendif()\n"
     "add_executable(n ${S})\n"), "ab", False),
    ("both in the same builds' lists", ("find_package(X)\nadd_executable(n src/main.cpp src/b.cpp)\nif(X_FOUND)\n"
     "add_executable(m src/d.cpp)\nendif()\n"), "ab", False),
    ("an expression", "option(X x ON)\nadd_executable(n src/main.cpp $<$<BOOL:${X}>:src/b.cpp> $<$<NOT:$<BOOL:${X}>>:src/d.cpp>)\n",
     "ab", False),
)  # fmt: skip
#: What the files b and d define, with their letter for X, and what is called; declared in a header.
FORMS = {
    "function": ("void f(ros::NodeHandle& nh);", 'void f(ros::NodeHandle& nh) { PUB("X", 1); }', "f(nh);"),
    "method": (
        "struct C { void f(ros::NodeHandle& nh); };",
        'void C::f(ros::NodeHandle& nh) { PUB("X", 1); }',
        "C c; c.f(nh);",
    ),
    "in a function": (
        "void f(ros::NodeHandle& nh);",
        'static void g(ros::NodeHandle& nh) { PUB("X", 1); }\nvoid f(ros::NodeHandle& nh) { g(nh); }',
        "f(nh);",
    ),
}


def files_of(form: str, cmake: str) -> dict[str, str]:
    declared, defined, called = FORMS[form]
    files = cpp_files(main(f'ADV("a", 1); {called}', '#include "f.h"\n'))
    files["p/src/f.h"] = f"#pragma once\n#include <ros/ros.h>\n{declared}\n"
    for letter in "bd":
        text = defined.replace("PUB(", f"nh.{PUBLISH.removeprefix('nh.')}").replace("X", letter)
        files[f"p/src/{letter}.cpp"] = f'{CPP_HEAD}#include "f.h"\n{text}\n'
    files["p/CMakeLists.txt"] = CMAKE.format("p") + cmake
    return files


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("cmake", "names", "is_open"), [row[1:] for row in CHOSEN], ids=[row[0] for row in CHOSEN])
def test_of_several_files_none_is_certain(cmake: str, names: str, is_open: bool, form: str) -> None:
    found = follow(files_of(form, cmake)).configurations
    ends = [
        e for each in found for n in each.nodes if each.name == "p/n" for e in n.endpoints if e.kind == "publishers"
    ]
    assert sorted(end.name for end in ends if len(end.name) == 2) == [f"/{name}" for name in names]
    told = {end.name[1:] for end in ends if ONE_OF in {u.reason for u in end.unknowns if u.field == "conditions"}}
    assert told == (set("bd") if is_open else set())


def test_what_it_returns_is_either() -> None:
    files = cpp_files(main("ADV(f(), 1);", "std::string f();\n"))
    for letter in "bd":
        files[f"p/src/{letter}.cpp"] = f'#include <string>\nstd::string f() {{ return "{letter}"; }}\n'
    files["p/CMakeLists.txt"] = CMAKE.format("p") + "find_package(X)\n" + EITHER.format("X_FOUND")
    assert [end.name for end in node(follow(files)).endpoints if end.kind == "publishers"] == ["/?"]
