# SPDX-License-Identifier: Apache-2.0
"""Calls that a change adds and that lead to a finding which is known."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.called_again import MOST, notes
from haros_ci.results.result import BaselineState, Related, Result
from haros_ci.results.rule import Level

BEFORE = "int read(int * p, int n);\nint first()\n{\n  return read(nullptr, 1);\n}\n"


class Texts:
    def __init__(self, text: str) -> None:
        self.kept = text

    def text(self, path: str) -> str:
        return self.kept

    data = None


def workspace(text: str) -> Workspace:
    file = SourceFile(path="a.cpp", language="cpp", size=len(text), digest=str(hash(text)), package=None)
    return Workspace(root=Path("/nowhere"), packages=(), files=(file,), reader=Texts(text))  # type: ignore[arg-type]  # texts alone are asked for


def known(message: str, state: BaselineState = BaselineState.UNCHANGED) -> Result:
    related = (Related(Location("a.cpp", 4), message),)
    return Result("cppcheck", "nullPointer", Level.WARNING, "m", Location("b.cpp", 9), related=related, state=state)


NULL = "Calling function 'read', 1st argument 'nullptr' value is 0"
FIRES = {
    "again": "int second()\n{\n  return read(nullptr, 2);\n}\n",
    "the_same_line": "int second()\n{\n  return read(nullptr, 1);\n}\n",
    "another_null": "int second()\n{\n  return read(NULL, 2);\n}\n",
    "over_lines": "int second()\n{\n  return read\n    (\n      nullptr,\n      2);\n}\n",
    "of_an_object": "int second()\n{\n  return a.read(nullptr, f(1, 2));\n}\n",
}
QUIET = {
    "another_value": "int second(int * p)\n{\n  return read(p, 2);\n}\n",
    "another_function": "int second()\n{\n  return spread(nullptr) + read_all(nullptr);\n}\n",
    "another_argument": "int second(int * p)\n{\n  return read(p, nullptr);\n}\n",
    "no_call": "int second()\n{\n  return read;\n}\n",
    "no_argument": "int second()\n{\n  return read();\n}\n",
    "not_closed": "int second()\n{\n  return read(nullptr",
    "nothing_of_it": "int second()\n{\n  return 1;\n}\n",
}


@pytest.mark.parametrize("name", FIRES)
def test_fires(name: str) -> None:
    (note,) = notes([known(NULL)], workspace(BEFORE + FIRES[name]), workspace(BEFORE), {})
    assert (note.path, note.line) == ("a.cpp", 8)
    assert note.message.startswith("since this change read() is given nullptr here, too")


@pytest.mark.parametrize("name", QUIET)
def test_stays_quiet(name: str) -> None:
    assert notes([known(NULL)], workspace(BEFORE + QUIET[name]), workspace(BEFORE), {}) == ()


def test_calls_that_only_move_are_not_named() -> None:
    assert notes([known(NULL)], workspace("\n\n" + BEFORE), workspace(BEFORE), {}) == ()


def test_a_file_as_it_was_is_not_looked_at() -> None:
    assert notes([known(NULL)], workspace(BEFORE), workspace(BEFORE), {}) == ()


@pytest.mark.parametrize("state", [BaselineState.NEW, BaselineState.ABSENT, None])
def test_findings_that_are_not_known_speak_for_themselves(state: BaselineState | None) -> None:
    now = workspace(BEFORE + FIRES["again"])
    assert notes([known(NULL, state)], now, workspace(BEFORE), {}) == ()  # type: ignore[arg-type]  # a run without a baseline has no states


def test_another_value_than_null() -> None:
    now = workspace(BEFORE + "int second()\n{\n  return read(p, 7);\n}\n")
    assert len(notes([known("Calling function 'read', 2nd argument '7' value is 7")], now, workspace(BEFORE), {})) == 1


def test_many_calls_are_counted_and_take_no_time() -> None:
    text = BEFORE + "read(nullptr, (" * 30_000 + "\nread(nullptr, 2);\n" * (MOST + 5)
    found = notes([known(NULL)] * 500, workspace(text), workspace(BEFORE), {})
    assert len(found) <= MOST + 1
