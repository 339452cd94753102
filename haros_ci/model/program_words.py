# SPDX-License-Identifier: Apache-2.0
"""Whether what builds a package may make a program of a name, by the words in it: that of a source file, or of a module, makes none."""

from __future__ import annotations

import re
from itertools import islice

_COMMENT = re.compile(r"(?:^|(?<=[ \t]))#[^\n]*", re.M)
#: The module and function of an entry point (packaging.python.org, "Entry points specification").
_ENTRY = re.compile(r"(?<==)[ \t]{0,20}[A-Za-z_][\w.]{0,200}:[A-Za-z_][\w.]{0,200}")
_PATH_BEFORE = re.compile(r"[\w./+${}-]{1,300}\Z")
_PATH_BEHIND = re.compile(r"[\w./+${}-]{1,300}")
_SOURCES = frozenset("c cc cpp cxx c++ cu h hh hpp hxx py".split())
#: What may take a program's name from the name of a file.
_DERIVES = re.compile(
    r"\b(?:get_filename_component|cmake_path|NAME_WE|STEM|REGEX|REPLACE|stem|splitext|removesuffix|basename)\b"
)
_OPENER = re.compile(r"\b([A-Za-z_]\w{0,100})[ \t]*\(")
#: Commands of CMake, and calls of a setup.py, that take files and name no program after them.
_TAKING = frozenset(
    """
    add_executable add_library target_sources install set list file set_source_files_properties catkin_install_python ament_python_install_module
    ament_auto_add_executable ament_auto_add_library cuda_add_executable cuda_add_library pybind11_add_module qt5_wrap_cpp qt_wrap_cpp
    qt6_wrap_cpp add_rostest_gtest catkin_add_gtest catkin_add_gmock ament_add_gtest ament_add_gmock ament_add_pytest_test
    catkin_add_nosetests add_custom_command roslint_cpp roslint_python
    setup generate_distutils_setup join glob append extend dict path
    """.split()
)


#: Places of a name that are looked at, characters of a path, and how far before it the command that takes it begins.
_MOST_PLACES = 200
_LONGEST_PATH = 300
_NEAR = 4_000


def may_make_program(text: str, name: str, *, is_file: bool = True) -> bool:
    """Whether *text*, of CMake files and a setup.py, names *name* in another way than as the stem of a source file, the module or function of an entry point, or in a comment.

    Names of files count where something may take the names of programs from them. What is no file (*is_file*), as a class, is named by any word.
    """
    word = re.compile(rf"(?<!\w){re.escape(name)}(?!\w)")
    if word.search(text) is None or not is_file:
        return word.search(text) is not None
    plain = _ENTRY.sub("", _COMMENT.sub("", text))
    places = list(islice(word.finditer(plain), _MOST_PLACES))
    if len(places) == _MOST_PLACES or (places and _DERIVES.search(plain) is not None):
        return True
    return any(not _is_of_a_source(plain, place, name) for place in places)


def _is_of_a_source(text: str, place: re.Match[str], name: str) -> bool:
    """Whether the word stands in the path of a source file that a command takes which names no program after it."""
    start, end = place.span()
    before = _PATH_BEFORE.search(text, max(0, start - _LONGEST_PATH), start)
    after = _PATH_BEHIND.match(text, end, end + _LONGEST_PATH)
    path = (before[0] if before else "") + place[0] + (after[0] if after else "")
    base = path.rpartition("/")[2]
    if base == name or "." not in base or base.rpartition(".")[2].lower() not in _SOURCES:
        return False
    openers = _OPENER.findall(text, max(0, start - _NEAR), start)
    return not openers or openers[-1].lower() in _TAKING
