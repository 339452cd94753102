# SPDX-License-Identifier: Apache-2.0
"""Programs that a package does not have, though its build has a word that reads so: the name of a source file, or of a module."""

from __future__ import annotations

import pytest
from launch_facts_kit import CMAKE, facts

from haros_ci.model.launch_facts import ProgramUse
from haros_ci.model.program_words import may_make_program

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


@pytest.mark.parametrize(
    ("build", "expected"),
    [("add_executable(hearer src/m.cpp)\n", False), ("make_my_program(hearer src/m.cpp)\n", None)],
)
def test_a_launch_file_that_starts_a_source(build: str, expected: bool | None) -> None:
    files = {"p/CMakeLists.txt": CMAKE + build, "p/src/m.cpp": "int main() {}\n"}
    assert [use.is_found for use in facts(ProgramUse, '<node pkg="p" exec="m"/>', files)] == [expected]
