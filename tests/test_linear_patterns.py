# SPDX-License-Identifier: Apache-2.0
"""Regular expressions that read whole files: text made to be read again from each of its places takes no longer than other text."""

from __future__ import annotations

from importlib import import_module

import pytest

from haros_ci.coverage.blanked import blanked
from haros_ci.coverage.names import names_of
from haros_ci.coverage.pieces import around, pieces_of
from haros_ci.coverage.search import calls_in
from haros_ci.extract.apis.tables import rows
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.index.index import Source
from haros_ci.robot.places import as_xacro
from haros_ci.robot.sources import FIND

#: Characters that each is given: a quadratic one takes minutes for them.
SIZE = 300_000
CASES = (
    ("haros_ci.linters.catkin_doubts._COMMAND", "add_"),
    ("haros_ci.linters.python2._SHEBANG", "#!a"),
    ("haros_ci.linters.python2._STATEMENTS", "except" + " " * SIZE),
    ("haros_ci.linters.python2._REMARK", "<!--"),
    ("haros_ci.linters.gate._QUOTED", "‘"),
    ("haros_ci.linters.inclusions._ASKED", "defined" + " " * SIZE + "!"),
    ("haros_ci.linters.loaded_files._IN_CODE", "-"),
    ("haros_ci.linters.one_cause._CALLEE", "a" * SIZE + "!"),
    ("haros_ci.linters.pylint_doubts._CALLEE", "a"),
    ("haros_ci.linters.pylint_doubts._KEPT", "#"),
    ("haros_ci.extract.cpp.literals._FLOAT", "1" * SIZE + "z"),
    ("haros_ci.launch.ros2.parameter_yaml._FLOAT", "1" * SIZE + "z"),
    ("haros_ci.linters.cppcheck_doubts._BY_NAME", "%" + " " * SIZE),
    ("haros_ci.linters.duplicates._WILDCARD", "from a import" + " " * SIZE),
    ("haros_ci.checking.given_names._HELD", "A::"),
    ("haros_ci.checking.given_names._COMMENT", "/*a"),
    ("haros_ci.linters.cppcheck_doubts._COMMENT", "/*a"),
    ("haros_ci.linters.constant_switches._COMMENT", "/*a"),
    ("haros_ci.linters.one_cause._REMARK", "/*a"),
    ("haros_ci.linters.includes._ANY_INCLUDE", "/**/"),
    ("haros_ci.linters.catkin_doubts._SIMPLE", "\n"),
    ("haros_ci.checking.includes._GUARD", "if ! defined" + " " * SIZE + "!"),
    ("haros_ci.checking.launching._COMMENT", "<!--"),
    ("haros_ci.checking.old_python._OPEN", "import" + " " * SIZE),
    ("haros_ci.checking.republishing._AGAIN", "Timer" + " " * SIZE),
    ("haros_ci.checking.republishing._PUBLISHER", "a" + " " * SIZE),
    ("haros_ci.launch.facts.programs._MAKERS", "\n"),
    ("haros_ci.analysis.foreign_code._INCLUDE", "#" + " " * SIZE),
    ("haros_ci.analysis.foreign_code._CLASS", "struct A "),
    ("haros_ci.analysis.foreign_code._CLASS", "struct A" + " " * SIZE),
    ("haros_ci.analysis.foreign_code._ROS", "a" * SIZE),
    ("haros_ci.behaviour.scanner._METADATA", "#" + " " * SIZE),
    ("haros_ci.behaviour.scanner._OTHER_METADATA", "#a: b" + " " * SIZE),
    ("haros_ci.behaviour.scanner._TOPIC", "a/"),
    ("haros_ci.behaviour.scanner._NUMBER", "1" * SIZE + "e"),
    ("haros_ci.behaviour.sources._BEFORE", "&a "),
    ("haros_ci.workspace.environment._EM", "@["),
    ("haros_ci.workspace.environment._EM_BLOCK", "@[if "),
    ("haros_ci.workspace.shell_values._SET", "${a"),
    ("haros_ci.workspace.dotenv._COMMENT", " "),
    ("haros_ci_checks.unused_launch_argument._NEXT", "\n"),
    ("haros_ci.coverage.pieces._REGISTERING", "PLUGINLIB_A("),
)
#: C++ that makes what looks for calls and functions in text look far, again and again.
CALLS = (
    '"' + '\\"' * SIZE + "\\",
    "get_parameter(x, ",
    "a.get_parameter(1).",
    "a<" * 60 + ">" * 60 + ".get_parameter(1);",
)


@pytest.mark.parametrize(("name", "pump"), CASES)
def test_one_text_over_and_over(name: str, pump: str) -> None:
    module, _, attribute = name.rpartition(".")
    pattern = getattr(import_module(module), attribute)
    text = pump * max(SIZE // len(pump), 1)
    if attribute == "_FLOAT":  # asked at the beginning of a word alone
        assert pattern.fullmatch(text) is None
    else:
        assert sum(1 for _ in pattern.finditer(text)) <= 1


def test_directories_of_packages_over_and_over() -> None:
    count = SIZE // len("$(find a)")
    assert as_xacro("$(find a)" * count) == f"{FIND}a" * count


@pytest.mark.parametrize("pump", CALLS)
def test_calls_in_text_made_to_be_read_again(pump: str) -> None:
    text = pump * max(SIZE // len(pump), 1)
    calls = list(calls_in(blanked(text, "cpp"), names_of(rows("cpp", 2)), "cpp"))
    assert len(calls) == text.count("get_parameter(")


def test_functions_whose_brackets_are_not_closed() -> None:
    text = "void f() {\n#define B {\n}\n" * 5_000
    found = list(pieces_of(Source("a.cpp", None, read_cpp(text)), blanked(text, "cpp")))
    assert 50 <= len(found) <= 60, "the others stay outside"
    assert len(around(found, range(0, len(text), 20))) == len(range(0, len(text), 20))
