# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest
from in_memory import built, messages, names, only

UNDECIDED = "find_package(X)\nif(X_FOUND)\n{}\nelse()\n{}\nendif()\n"


def test_both_branches_are_taken() -> None:
    build = built(UNDECIDED.format("add_executable(a m.cpp)", "add_library(b m.cpp)") + "add_library(c m.cpp)", "m.cpp")
    assert [(t.name, t.is_conditional) for t in build.targets] == [("a", True), ("b", True), ("c", False)]
    assert messages(build) == [
        (2, "whether (X_FOUND) holds is only known in a build; taken as possible: executable a, library b")
    ]


def test_a_branch_that_makes_nothing_is_no_problem() -> None:
    build = built(UNDECIDED.format("add_definitions(-DX)", "set(FLAGS y)") + "add_library(c m.cpp)", "m.cpp")
    assert messages(build) == [] and not only(build).is_conditional


def test_sources_of_some_branches_are_conditional() -> None:
    text = "set(S m.cpp)\n" + UNDECIDED.format("list(APPEND S x.cpp)", "list(APPEND S y.cpp)")
    target = only(built(text + "add_library(c ${S})", "m.cpp", "x.cpp", "y.cpp"))
    assert target.sources == ("arm/m.cpp", "arm/x.cpp", "arm/y.cpp")
    assert target.conditional_sources == ("arm/x.cpp", "arm/y.cpp")
    assert not target.is_conditional


def test_one_target_made_in_both_branches() -> None:
    build = built(UNDECIDED.format("add_library(c x.cpp)", "add_library(c y.cpp)"), "x.cpp", "y.cpp")
    target = only(build)
    assert target.conditional_sources == target.sources == ("arm/x.cpp", "arm/y.cpp")
    assert target.is_conditional and target.location.line == 3


def test_a_name_that_depends_is_a_problem_and_never_guessed() -> None:
    build = built(
        UNDECIDED.format("set(N a)", "set(N b)") + "add_executable(${N} m.cpp)\nadd_library(l${N} m.cpp)", "m.cpp"
    )
    assert names(build) == []
    assert messages(build) == [
        (7, "the name of this executable, ${N}, is only known in a build; it is missing"),
        (8, "the name of this library, l${N}, is only known in a build; it is missing"),
    ]


def test_after_a_possible_return_all_is_conditional() -> None:
    text = "add_library(a m.cpp)\nfind_package(X)\nif(NOT X_FOUND)\n  return()\nendif()\nadd_library(b m.cpp)"
    build = built(text, "m.cpp")
    assert [(t.name, t.is_conditional) for t in build.targets] == [("a", False), ("b", True)]
    assert [line for line, _ in messages(build)] == [3]


def test_a_possible_return_in_a_subdirectory_ends_with_it() -> None:
    inner = "find_package(X)\nif(X_FOUND)\nreturn()\nendif()\nadd_library(a m.cpp)"
    build = built("add_subdirectory(s)\nadd_library(b m.cpp)", "m.cpp", "s/m.cpp", s__CMakeLists_txt=inner)
    assert [(t.name, t.is_conditional) for t in build.targets] == [("a", True), ("b", False)]


def test_a_branch_that_ends_the_build_does_not_count() -> None:
    text = UNDECIDED.format("set(S m.cpp)", 'message(FATAL_ERROR "no X")') + "add_library(a ${S})"
    build = built(text, "m.cpp")
    assert not only(build).is_conditional and only(build).conditional_sources == ()
    assert messages(build) == []


FATAL = 'message(FATAL_ERROR "no X")'


@pytest.mark.parametrize(
    "before",
    [
        UNDECIDED.format(FATAL, FATAL),
        f"set(L a)\n{UNDECIDED.format('list(APPEND L b)', '')}foreach(i ${{L}})\nset(d NO)\nif(NOT d)\n{FATAL}\nendif()\nendforeach()\n",
        f"if(A)\nif(B)\n{FATAL}\nendif()\nelse()\n{FATAL}\nendif()\n",
        f"{UNDECIDED.format('return()', '')}if(NOT d)\n{FATAL}\nendif()\n",
        "include(s/extra.cmake)\n",
    ],
)
def test_what_follows_an_error_is_read(before: str) -> None:
    inner = f"find_package(X)\nif(X_FOUND)\nreturn()\nendif()\nif(NOT d)\n{FATAL}\nendif()\n"
    build = built(before + "include_directories(inc)\nadd_library(a m.cpp)", "m.cpp", s__extra_cmake=inner)
    assert only(build).name == "a"
    assert [each.arguments for each in build.commands if each.name == "include_directories"] == [("inc",)]


def test_a_loop_over_doubtful_items_makes_conditional_targets() -> None:
    text = "set(L a)\n" + UNDECIDED.format("list(APPEND L b)", "")
    build = built(text + "foreach(i ${L})\nadd_library(${i} m.cpp)\nendforeach()\nadd_library(z m.cpp)", "m.cpp")
    assert [(t.name, t.is_conditional) for t in build.targets] == [("a", False), ("b", True), ("z", False)]


def test_doubt_about_tests_is_no_problem() -> None:
    text = "if(BUILD_TESTING)\nfind_package(X)\nif(X_FOUND)\nadd_executable(t gone.cpp)\nendif()\nendif()"
    build = built(text)
    assert (only(build).is_test, only(build).is_conditional, messages(build)) == (True, True, [])


def test_an_undecided_loop_may_not_run() -> None:
    text = (
        "find_package(X)\nset(S m.cpp)\nwhile(X_MORE)\nlist(APPEND S x.cpp)\nbreak()\nendwhile()\nadd_library(a ${S})"
    )
    target = only(built(text, "m.cpp", "x.cpp"))
    assert target.conditional_sources == ("arm/x.cpp",) and not target.is_conditional


def test_branches_in_a_function_start_from_what_the_caller_has() -> None:
    text = (
        "find_package(X)\nset(S m.cpp)\nfunction(f)\nif(X_FOUND)\nlist(APPEND S x.cpp)\nendif()\n"
        "add_library(a ${S})\nendfunction()\nf()"
    )
    target = only(built(text, "m.cpp", "x.cpp"))
    assert (target.sources, target.conditional_sources) == (("arm/m.cpp", "arm/x.cpp"), ("arm/x.cpp",))


def test_a_possible_continue_counts_for_its_turn_and_a_break_for_all() -> None:
    text = "find_package(X)\nforeach(i a b)\nadd_library(${{i}} m.cpp)\nif(X_FOUND)\n{}()\nendif()\n"
    text += "add_library(${{i}}2 m.cpp)\nendforeach()\nadd_library(z m.cpp)"
    for word, expected in (("continue", ["a2", "b2"]), ("break", ["a2", "b", "b2"])):
        build = built(text.format(word), "m.cpp")
        assert names(build) == ["a", "a2", "b", "b2", "z"]
        assert [target.name for target in build.targets if target.is_conditional] == expected


def test_values_of_nested_branches() -> None:
    text = "find_package(X)\nset(S m.cpp)\nif(X_FOUND)\nif(X_GUI)\nlist(APPEND S x.cpp)\nelse()\nunset(S)\nendif()\n"
    text += "endif()\n"
    target = only(built(text + "add_library(a ${S})", "m.cpp", "x.cpp"))
    assert target.conditional_sources == target.sources == ("arm/m.cpp", "arm/x.cpp")
    again = only(built(text + "set(S m.cpp)\nadd_library(a ${S})", "m.cpp", "x.cpp"))
    assert again.conditional_sources == () and again.sources == ("arm/m.cpp",)


CHOICE = "{}\nif({})\nfind_package(A REQUIRED)\nelse()\nfind_package(B REQUIRED)\nendif()"


def doubts(text: str) -> dict[str, bool]:
    """The packages that find_package() looks for, and whether that is in doubt."""
    return {each.arguments[0]: each.is_conditional for each in built(text).commands if each.name == "find_package"}


@pytest.mark.parametrize(
    ("before", "condition"),
    [
        ("", "USE_A"),
        ("", "NOT USE_A"),
        ("", "${USE_A}"),
        ("", '"${WHICH}" STREQUAL "a"'),
        ("", "DEFINED WHICH"),
        ("find_package(tools REQUIRED)", "base_tools_USE_A"),
        ("find_package(tools REQUIRED)", "base_tools_MAJOR EQUAL 5"),
        (
            'find_package(tools REQUIRED)\nif("${base_tools_MAJOR} " STREQUAL "5 ")\nset(USE_A true)\nelse()\nset(USE_A false)\nendif()',
            "USE_A",
        ),
    ],
)
def test_a_choice_between_packages_by_what_nothing_here_sets(before: str, condition: str) -> None:
    found = doubts(CHOICE.format(before, condition))
    assert found["A"] and found["B"]


@pytest.mark.parametrize(
    ("before", "condition", "taken"),
    [
        ("option(USE_A help OFF)", "USE_A", "B"),
        ("option(USE_A help ON)", "USE_A", "A"),
        ("set(USE_A TRUE)", "USE_A", "A"),
        ("set(USE_A FALSE)", "USE_A", "B"),
        ("set(USE_A 1)\nunset(USE_A)", "USE_A", "B"),
        ("", "WIN32", "B"),
        ("", "MSVC OR APPLE", "B"),
        ("", "UNIX", "A"),
        ("", "CMAKE_SYSTEM_NAME STREQUAL Linux", "A"),
        ("", "${CMAKE_SYSTEM_NAME} STREQUAL Linux", "A"),
        ("", "CMAKE_VERSION VERSION_LESS 3.1", "B"),
        ("", "extras_FOUND", "B"),
        ("", "CATKIN_ENABLE_TESTING", "A"),
    ],
)
def test_a_choice_that_is_told_here(before: str, condition: str, taken: str) -> None:
    assert doubts(CHOICE.format(before, condition)) == {taken: False}


@pytest.mark.parametrize(
    "text",
    [
        "if(USE_A)\nfind_package(A REQUIRED)\nendif()\nfind_package(B REQUIRED)",
        "if(USE_A)\nfind_package(B REQUIRED)\nset(X 1)\nelse()\nfind_package(B REQUIRED)\nendif()",
        "if(arm_USE_A)\nset(X 1)\nelse()\nfind_package(B REQUIRED)\nendif()",
        "project(legs)\nif(legs_USE_A)\nset(X 1)\nelse()\nfind_package(B REQUIRED)\nendif()",
        "if(USE_OLD)\nfind_package(catkin REQUIRED)\nelse()\nfind_package(B REQUIRED)\nendif()",
    ],
)
def test_no_choice_between_packages(text: str) -> None:
    assert doubts(text) == {"B": False}
