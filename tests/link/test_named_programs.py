# SPDX-License-Identifier: Apache-2.0
"""Programs that a package does not have, though its build has a word that reads so: the name of a source file, or of a module."""

from __future__ import annotations

import pytest
from launch_facts_kit import CMAKE, facts

from haros_ci.model.launch_facts import ProgramUse
from haros_ci.model.program_words import before_return, is_called_otherwise, is_not_made, may_make_program

SETUP = "setup(name='p', packages=['p'], entry_points={{'console_scripts': [{}]}})\n"

NOT_MADE = [
    SETUP.format("'hearer = p.listener:main'"),
    SETUP.format("'hearer = listener:main', 'other = p.more:listener'"),
    SETUP.format("'hearer = p.hear:main'  # was: listener"),
    "add_executable(hearer src/listener.cpp)\n",
    "add_executable(hearer\n  src/listener.cpp  # listener\n  ${DIR}/listener.hpp)\n",
    "# add_executable(listener src/listener.cpp)\nadd_executable(hearer src/hearer.cpp)\n",
    "catkin_install_python(PROGRAMS scripts/listener.py DESTINATION lib)\n",
    "set(SOURCES src/listener.cpp src/other.cc)\nadd_executable(hearer ${SOURCES})\n",
    "add_executable(listener_node src/a.cpp)\n",
]
MAY_BE_MADE = [
    SETUP.format("'listener = p.hear:main'"),
    SETUP.format("*[f'{n} = p.{n}:main' for n in ('listener', 'talker')]"),
    "setup(scripts=['scripts/listener'])\n",
    "add_executable(listener src/a.cpp)\n",
    "add_executable(hearer src/a.cpp)\nset_target_properties(hearer PROPERTIES OUTPUT_NAME listener)\n",
    "install(PROGRAMS a.py DESTINATION lib RENAME listener)\n",
    "set(NAMES listener talker)\n",
    "make_programs_of(src/listener.cpp)\n",
    "foreach(file src/listener.cpp src/b.cpp)\n  get_filename_component(n ${file} NAME_WE)\n  add_executable(${n} ${file})\nendforeach()\n",
    "names = [os.path.splitext(one)[0] for one in ('listener.py', 'talker.py')]\nsetup(scripts=names)\n",
    "install(DIRECTORY listener DESTINATION lib)\n",
    "install(PROGRAMS scripts/listener DESTINATION lib)\n",
]


@pytest.mark.parametrize("text", NOT_MADE)
def test_a_word_that_makes_no_program(text: str) -> None:
    assert not may_make_program(text, "listener")
    assert not may_make_program(text, "nobody")


@pytest.mark.parametrize("text", MAY_BE_MADE)
def test_a_word_that_may_make_one(text: str) -> None:
    assert may_make_program(text, "listener")


def test_a_file_is_called_by_its_whole_name() -> None:
    assert may_make_program("install(PROGRAMS scripts/listener.py DESTINATION lib)", "listener.py")
    assert may_make_program("# listener\n", "listener", is_file=False)


def test_many_places_are_not_looked_at() -> None:
    assert may_make_program("add_executable(a " + "src/listener.cpp " * 100_000 + ")", "listener")


MADE = "add_executable(listener src/a.cpp)\ninstall(TARGETS listener DESTINATION lib/p)\n"
LEFT_OUT = MADE.replace("listener src", "listener EXCLUDE_FROM_ALL src", 1)
NOT_BUILT = [
    LEFT_OUT,
    LEFT_OUT + "target_link_libraries(listener a)  # not listener\n",
    MADE + "set_target_properties(listener PROPERTIES EXCLUDE_FROM_ALL TRUE)\n",
    MADE + "set_property(TARGET listener PROPERTY EXCLUDE_FROM_ALL 1)\n",
]
BUILT = [
    MADE,
    LEFT_OUT + "add_dependencies(more listener)\n",
    LEFT_OUT + "add_custom_target(more ALL DEPENDS listener)\n",
    LEFT_OUT + "add_custom_command(OUTPUT a COMMAND $<TARGET_FILE:listener>)\n",
    MADE + "add_executable(talker EXCLUDE_FROM_ALL src/b.cpp)\n",
    MADE + "add_subdirectory(more EXCLUDE_FROM_ALL)\n",
    MADE + "set_target_properties(listener PROPERTIES EXCLUDE_FROM_ALL FALSE)\n",
]


@pytest.mark.parametrize("text", NOT_BUILT)
def test_a_target_that_is_never_built(text: str) -> None:
    assert is_not_made(text, "listener")


@pytest.mark.parametrize("text", BUILT)
def test_a_target_that_is_built(text: str) -> None:
    assert not is_not_made(text, "listener")


def test_a_target_by_another_name() -> None:
    text = MADE + "set_target_properties(listener PROPERTIES OUTPUT_NAME hearer)\n"
    assert is_called_otherwise(text, "listener")
    assert not is_called_otherwise(text + "install(PROGRAMS a.py DESTINATION lib/p RENAME listener)\n", "listener")
    assert not is_called_otherwise(text + "add_custom_command(OUTPUT listener)\n", "listener")
    assert not is_called_otherwise(text + "set(NAMES listener)\n", "listener")


def test_what_stands_behind_a_return_is_not_read() -> None:
    assert before_return(f"project(p)\nreturn()\n{MADE}") == "project(p)\n"
    assert before_return(f"if(A)\nendif()\n  RETURN ()\n{MADE}") == "if(A)\nendif()\n"
    text = 'message("\nreturn()\n")\nset(A "b" "c")\n'
    assert before_return(f"{text}return()\n{MADE}") == text


@pytest.mark.parametrize(
    "text",
    [
        MADE,
        f"if(A)\n  return()\nendif()\n{MADE}",
        f"function(f)\n  return()\nendfunction()\n{MADE}",
        f"# return()\n{MADE}",
        f"#[[\nreturn()\n]]\n{MADE}",
        f'message("\nreturn()\n")\n{MADE}',
    ],
)
def test_what_is_read_to_its_end(text: str) -> None:
    assert before_return(text) == text


@pytest.mark.parametrize(
    ("build", "expected"),
    [
        (MADE.replace("src/a", "src/m"), True),
        (MADE.replace("src/a", "src/m") + "set_target_properties(listener PROPERTIES OUTPUT_NAME hearer)\n", False),
        (MADE.replace("src/a", "src/m") + "set_target_properties(listener PROPERTIES SUFFIX .bin)\n", False),
        (LEFT_OUT.replace("src/a", "src/m"), False),
        ("return()\n" + MADE.replace("src/a", "src/m"), False),
        ("if(A)\n  return()\nendif()\n" + MADE.replace("src/a", "src/m"), True),
        (LEFT_OUT.replace("src/a", "src/m") + "add_dependencies(more listener)\n", True),
    ],
)
def test_a_launch_file_that_starts_what_is_not_made(build: str, expected: bool) -> None:
    files = {"p/CMakeLists.txt": CMAKE + build, "p/src/m.cpp": "int main() {}\n"}
    assert [use.is_found for use in facts(ProgramUse, '<node pkg="p" exec="listener"/>', files)] == [expected]


@pytest.mark.parametrize(
    ("build", "expected"),
    [("add_executable(hearer src/m.cpp)\n", False), ("make_my_program(hearer src/m.cpp)\n", None)],
)
def test_a_launch_file_that_starts_a_source(build: str, expected: bool | None) -> None:
    files = {"p/CMakeLists.txt": CMAKE + build, "p/src/m.cpp": "int main() {}\n"}
    assert [use.is_found for use in facts(ProgramUse, '<node pkg="p" exec="m"/>', files)] == [expected]
