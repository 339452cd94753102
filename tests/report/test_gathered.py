# SPDX-License-Identifier: Apache-2.0
"""A file that tools cannot analyse is named once, and so is a reason of several files."""

from __future__ import annotations

import pytest

from haros_ci.model.location import Location
from haros_ci.model.workspace import LATIN_1
from haros_ci.report.gathered import NAMED, gathered
from haros_ci.results.result import Notification, Result
from haros_ci.results.rule import Level


def note(tool: str, path: str, why: str, line: int | None = None) -> Notification:
    return Notification(Level.WARNING, f"{tool} could not analyse this file: {why}", tool, path, line)


def test_one_file_of_two_tools() -> None:
    (one,) = gathered([note("pylint", "a.py", "it is Python 2", 3), note("radon", "a.py", "Missing parentheses", 3)])
    assert one == Notification(
        Level.WARNING, "pylint and radon could not analyse this file: it is Python 2", None, "a.py", 3
    )


def test_one_header_of_several_files() -> None:
    why = "#endif without #if (timer.h:33)"
    (one,) = gathered([note("cppcheck", f"{name}.cpp", why) for name in "abcdefg"])
    assert one.message == (
        f"cppcheck could not analyse 7 files: {why}: a.cpp, b.cpp, c.cpp, d.cpp, e.cpp and {7 - NAMED} more"
    )
    assert (one.tool, one.path) == ("cppcheck", None)


def test_files_of_python_2_of_two_tools() -> None:
    notes = [note("pylint", path, "it is Python 2", 4) for path in ("a.py", "b.py")]
    notes += [note("radon", path, f"Missing parentheses in {path}", 4) for path in ("a.py", "b.py")]
    (one,) = gathered(notes)
    assert one.message == "pylint and radon could not analyse 2 files: they are Python 2: a.py:4, b.py:4"


def latin(path: str, line: int) -> Notification:
    return Notification(Level.WARNING, LATIN_1, path=path, line=line)


def test_files_in_latin_1() -> None:
    (one,) = gathered([latin("a.h", 38), latin("b.h", 3)])
    assert one.message == "2 files are not UTF-8, and are read as Latin-1; save them as UTF-8: a.h:38, b.h:3"
    assert (one.path, one.line) == (None, None)
    assert gathered([latin("a.h", 38)]) == (latin("a.h", 38),)


def test_files_that_are_skipped_for_one_reason() -> None:
    why = "skipped: a symbolic link that leads nowhere"
    (one,) = gathered([Notification(Level.WARNING, why, path=f"{name}.h") for name in "abcdefg"])
    assert one.message == "7 files are skipped (a symbolic link that leads nowhere): a.h, b.h, c.h, d.h, e.h and 2 more"


@pytest.mark.parametrize(
    ("rule", "path", "line", "count"),
    [
        ("syntax-error", "a.py", 3, 0),
        ("syntax-error", "a.py", 4, 1),
        ("syntax-error", "b.py", 3, 1),
        ("undefined-variable", "a.py", 3, 1),
    ],
)
def test_what_a_finding_says_already(rule: str, path: str, line: int, count: int) -> None:
    result = Result("pylint", rule, Level.ERROR, "Parsing failed", Location(path, line))
    assert len(gathered([note("radon", "a.py", "invalid syntax", 3)], [result])) == count


QUIET = [
    [
        Notification(Level.WARNING, "skipped: 3 bytes", path="a.h"),
        Notification(Level.WARNING, "skipped: 4 bytes", path="b.h"),
    ],
    [Notification(Level.WARNING, "skipped: x", path="a.h"), Notification(Level.ERROR, "skipped: x", path="b.h")],
    [
        Notification(Level.WARNING, "skipped: x", "cppcheck", "a.h"),
        Notification(Level.WARNING, "skipped: x", "cppcheck", "b.h"),
    ],
    [note("pylint", "a.py", "it is Python 2")],
    [note("pylint", "a.py", "it is Python 2"), note("pylint", "b.py", "a null byte")],
    [note("pylint", "a.py", "it is Python 2"), note("cppcheck", "b.cpp", "it is Python 2")],
    [Notification(Level.WARNING, "two packages of one name", path="a/package.xml")] * 1,
    [Notification(Level.ERROR, "pylint crashed", "pylint"), Notification(Level.ERROR, "pylint crashed", "ruff")],
    [Notification(Level.WARNING, "what it includes is unknown", "architecture", "a.launch", n) for n in (1, 2)],
    [],
]


@pytest.mark.parametrize("notes", QUIET)
def test_others_stay(notes: list[Notification]) -> None:
    assert list(gathered(notes)) == notes
