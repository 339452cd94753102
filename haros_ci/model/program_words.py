# SPDX-License-Identifier: Apache-2.0
"""Whether what builds a package may make a program of a name, by the words in it: that of a source file, or of a module, makes none."""

from __future__ import annotations

import re
from itertools import islice

from haros_ci.regex import regex

_COMMENT = regex(r"(?:^|(?<=[ \t]))#[^\n]*", re.M)
#: The module and function of an entry point (packaging.python.org, "Entry points specification").
_ENTRY = regex(r"(?<==)[ \t]{0,20}[A-Za-z_][\w.]{0,200}:[A-Za-z_][\w.]{0,200}")
_PATH_BEFORE = regex(r"[\w./+${}-]{1,300}\Z")
_PATH_BEHIND = regex(r"[\w./+${}-]{1,300}")
_SOURCES = frozenset("c cc cpp cxx c++ cu h hh hpp hxx py".split())
#: What may take a program's name from the name of a file.
_DERIVES = regex(
    r"\b(?:get_filename_component|cmake_path|NAME_WE|STEM|REGEX|REPLACE|stem|splitext|removesuffix|basename)\b"
)
_OPENER = regex(r"\b([A-Za-z_]\w{0,100})[ \t]*\(")
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


#: Commands of CMake of which no word is the name of a program, and that make no target be built.
_NO_DEPENDENCY = frozenset(
    """
    add_executable ament_auto_add_executable ament_target_dependencies target_link_libraries target_include_directories target_compile_options target_compile_definitions
    target_compile_features target_link_options target_sources target_precompile_headers set_target_properties set_property install
    """.split()
)
_EXCLUDED = regex(r"\A\s*\S+\s+(?:WIN32\s+|MACOSX_BUNDLE\s+)*EXCLUDE_FROM_ALL\b")
_EXCLUDED_BY = regex(r"\bEXCLUDE_FROM_ALL\s+\"?(?:1|ON|TRUE|YES|Y)\b", re.I)
#: What opens a block of CMake, ends one, or ends the file; comments and texts may hold none of these at the beginning of a line.
_BLOCK = regex(
    r"^[ \t]*(if|endif|foreach|endforeach|while|endwhile|function|endfunction|macro|endmacro|block|endblock|return)[ \t]*\(",
    re.I | re.M,
)
_BEGINS = frozenset(("if", "foreach", "while", "function", "macro", "block"))
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


def is_not_made(text: str, target: str) -> bool:
    """Whether CMake *text* leaves the executable *target* out of what is built by default, and has nothing that depends on it (EXCLUDE_FROM_ALL of cmake-properties(7))."""
    if "EXCLUDE_FROM_ALL" not in text:
        return False
    commands = _commands_with(text, target)
    is_left_out = any(
        (name == "add_executable" and _EXCLUDED.search(words))
        or (name in ("set_target_properties", "set_property") and _EXCLUDED_BY.search(words))
        for name, words in commands
    )
    return is_left_out and all(name in _NO_DEPENDENCY for name, _ in commands)


def is_called_otherwise(text: str, target: str) -> bool:
    """Whether CMake *text* has *target* as the name of one alone, and of no program: not in a command that may name a file, nor behind ``OUTPUT_NAME`` or ``RENAME``."""
    if re.search(rf"\b(?:RENAME|\w*OUTPUT_NAME\w*)\s+\"?{re.escape(target)}(?!\w)", text):
        return False
    return all(name in _NO_DEPENDENCY for name, _ in _commands_with(text, target))


def _commands_with(text: str, word: str) -> list[tuple[str, str]]:
    """The commands of CMake *text* among whose arguments *word* is one, by name, with the arguments; one without a name for a word that stands elsewhere."""
    found, done = [], 0
    plain = _COMMENT.sub("", text)
    for place in islice(re.finditer(rf"(?<![\w./+-]){re.escape(word)}(?![\w./+-])", plain), _MOST_PLACES):
        if place.start() < done:
            continue
        openers = list(_OPENER.finditer(plain, max(0, place.start() - _NEAR), place.start()))
        opener = openers[-1] if openers else None
        end = plain.find(")", place.end())
        if opener is None or end < 0 or plain.find(")", opener.end(), place.start()) >= 0:
            return [("", "")]
        found.append((opener[1].lower(), plain[opener.end() : end]))
        done = end
    return found


def before_return(script: str) -> str:
    """The text of a CMake file to the command ``return()`` that stands in no block, behind which nothing is read."""
    if "#[" in script or "[[" in script:
        return script  # comments and texts over several lines
    depth = quotes = at = 0
    for match in _BLOCK.finditer(script):
        word = match[1].lower()
        quotes += script.count('"', at, match.start())
        at = match.start()
        if word == "return" and depth == 0 and quotes % 2 == 0:
            return script[:at]
        depth += word in _BEGINS
        depth -= word.startswith("end")
    return script


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
