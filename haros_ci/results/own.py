# SPDX-License-Identifier: Apache-2.0
"""The rules that haros-ci reports under its own name, outside any check."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.results.result import Result
from haros_ci.results.rule import Level, Rule

TOOL = "haros-ci"

MALFORMED_MANIFEST = Rule(
    id="malformed-manifest",
    summary="package.xml that cannot be parsed.",
    level=Level.ERROR,
    help=(
        "catkin, colcon and this tool read a package's name and dependencies from package.xml (REP 127, 140, 149). "
        "A manifest that is not well-formed XML or lacks its name stops the build of the whole workspace. "
        "Correct the line that the message names."
    ),
    precision="very-high",
    profiles=("ros", "strict", "google", "bugs-only"),
    tags=("ros", "correctness"),
)

MALFORMED_LAUNCH = Rule(
    id="malformed-launch-file",
    summary="Launch file that launch rejects.",
    level=Level.ERROR,
    help=(
        "roslaunch and ros2 launch stop at a launch file that is not well-formed XML, and at every file that includes it. "
        "They also stop at an unknown tag or attribute, a missing attribute, an unclosed substitution, a "
        "node name with a namespace (roslaunch), and a Python syntax error. "
        "An unknown tag of ROS 2 is a warning: an installed package may register it (launch.frontend.launch_extension). "
        "Correct the line that the message names; typical are an unclosed tag, a missing quote, and a bare & or <."
    ),
    precision="very-high",
    profiles=("ros", "strict", "google", "bugs-only", "architecture"),
    tags=("ros", "correctness"),
)

UNUSED_SUPPRESSION = Rule(
    id="unused-suppression",
    summary="Suppression comment without effect.",
    level=Level.NOTE,
    help=(
        "The rule named in the comment no longer reports a finding there. A comment left behind would "
        "hide the next, unrelated finding. Remove it. A name that is not the name of a rule has no effect: that is an error, "
        "with the name that was probably meant."
    ),
    precision="high",
    profiles=("ros", "strict", "google"),
    tags=("maintainability",),
)

FILE_NOT_ANALYSED = Rule(
    id="file-not-analysed",
    summary="Added or changed file that cannot be analysed.",
    level=Level.WARNING,
    help=(
        "Reported where a base revision is asked for. A file is not analysed if a line is too long, if it holds NUL bytes or is encoded as "
        "UTF-16, if it is larger than max-file-size, if its name is not one line of UTF-8, or if it is a symbolic link that leads out of "
        "the workspace, nowhere, or to a file of another kind. A change could hide any code in such a file. What the base revision has with "
        "the same contents, here or elsewhere, is a message and no finding; a file that was not analysed before and has changed is "
        "reported, as what is in it now is new. So is a file that is too large or too deeply nested to be analysed whole, such as a "
        "program of many thousand calls, and was not in the base revision; and C++ or Python that a linter cannot analyse, if it could analyse the file "
        "in the base revision or the file is new. So is code under a name that is not analysed as code, where analysed files use it: C++ includes it "
        '(`#include "table.inc"`), CMake makes code of it (property LANGUAGE, a template such as `part.hpp.in`), Python runs it '
        "(`exec(open(...))`), or it lies in a hidden or otherwise left out directory that they name; Cython (`.pyx`) always. So is a submodule that "
        "is new and not checked out. So is a package that the change takes out of the model while its code stays: its manifest is gone, lies in "
        "another package now, or has the name of another one. So is a command of CMake, at its line, by which other files may be compiled or installed as code: a flag, a property, a variable or a "
        "form of an argument that haros-ci does not know to be harmless. Give it the name of its language, make the file readable, split it, or leave it out by 'exclude' in "
        "the project file of the base revision. A comment in the file does not silence this."
    ),
    precision="very-high",
    profiles=("ros", "strict", "google", "bugs-only", "architecture"),
    tags=("ros", "correctness"),
)

FAILED_QUERY = Rule(
    id="failed-query",
    summary="Query of the project file that cannot be evaluated.",
    level=Level.ERROR,
    help=(
        "The message names the query by its key in the project file, the line and column in its text, and what is wrong: a name that "
        "entities do not have, a bracket that is not closed, an evaluation that does not end. The other queries and checks are not "
        "affected. Correct the query; docs/queries.md has the language, and 'haros-ci query' tries one out."
    ),
    precision="very-high",
    profiles=("ros", "strict", "google", "bugs-only", "architecture"),
    tags=("query", "correctness"),
)

VIOLATED = Rule(
    id="hpl-violated",
    summary="Property that a recording violates, or a run that its axioms allow.",
    level=Level.ERROR,
    help=(
        "Reported by 'haros-ci monitor' and 'haros-ci verify' at the line of the property; an assumption that does not hold is a warning. The messages of the code "
        "flow, in this order, are what the property forbids, or lack what it demands; each step is a place in the source that publishes the "
        "message. Correct what these nodes do, or the property if it asks for too much: a window ends before its bound, so that an answer at "
        "exactly 100 ms is not within 100 ms (docs/hpl.md). The run of 'haros-ci verify' is what the properties of the nodes allow: it may be these that say too "
        "little. docs/monitor.md and docs/verify.md have the verdicts."
    ),
    precision="very-high",
    tags=("ros", "properties", "correctness"),
)

NEVER_EXERCISED = Rule(
    id="hpl-never-exercised",
    summary="Property that nothing puts to the test.",
    level=Level.NOTE,
    help=(
        "Reported by 'haros-ci monitor' at the line of the property. Its scope never opened, its trigger never came, or the recording does not "
        "have the topics of its behaviour, so that nothing was put to the test. Record a run in which it happens, or look at the names in the "
        "property: they are those of the running system, those of a node's property the ones in its code (docs/monitor.md). 'haros-ci verify' "
        "reports it where no run that keeps the axioms puts the property to the test, and as a warning where none keeps them; it names them (docs/verify.md)."
    ),
    precision="very-high",
    tags=("ros", "properties"),
)

UNDECIDED = Rule(
    id="hpl-undecided",
    summary="Property of which it is not known whether it holds.",
    level=Level.NOTE,
    help=(
        "Reported by 'haros-ci monitor' at the line of the property. The recording ended before what the property demands was due, a message "
        "that it depends on could not be read, or more messages would have to be kept than the limit allows; the message says which. Record "
        "for longer, or with the definitions of the types (docs/monitor.md). 'haros-ci verify' reports it where the time for a property was spent "
        "before an answer, or where the property has a construct that cannot be searched for; the message names it (docs/verify.md)."
    ),
    precision="very-high",
    tags=("ros", "properties"),
)

#: What is said of recordings, and of runs that are searched for: no run of ``check`` reports it.
OF_RECORDINGS = {rule.id: rule for rule in (VIOLATED, NEVER_EXERCISED, UNDECIDED)}
RULES = {
    rule.id: rule
    for rule in (MALFORMED_MANIFEST, MALFORMED_LAUNCH, UNUSED_SUPPRESSION, FILE_NOT_ANALYSED, FAILED_QUERY)
} | OF_RECORDINGS


def launch_results(faults: Iterable[Problem]) -> tuple[Result, ...]:
    """One result for each place of a launch file that launch refuses, at its line; a warning where an extension of launch may take it."""
    rule = MALFORMED_LAUNCH
    return tuple(
        Result(
            TOOL,
            rule.id,
            rule.level if fault.is_certain else Level.WARNING,
            fault.message,
            Location(fault.path, fault.line or 1),
        )
        for fault in faults
    )


def manifest_results(faults: Iterable[Problem]) -> tuple[Result, ...]:
    """One result for each malformed manifest, at the line that the parser names."""
    return tuple(
        Result(
            TOOL, MALFORMED_MANIFEST.id, MALFORMED_MANIFEST.level, fault.message, Location(fault.path, fault.line or 1)
        )
        for fault in faults
    )


def unread_results(problems: Iterable[Problem]) -> tuple[Result, ...]:
    """One result for each file that a change has made what it is and that is not analysed, on the file as a whole."""
    return tuple(
        _unanalysed(problem.path, f"this {_kind(problem)} cannot be analysed since this change: {_why(problem)}")
        for problem in problems
    )


def brought_results(problems: Iterable[Problem]) -> tuple[Result, ...]:
    """One result for each thing that a change brings and that keeps code from being analysed, such as a command of a build file, at its line."""
    return tuple(
        _unanalysed(problem.path, f"since this change {problem.message}", problem.line) for problem in problems
    )


def cut_results(problems: Iterable[Problem]) -> tuple[Result, ...]:
    """One result for each file that a change has made too large, or too deeply nested, to be analysed whole."""
    sentence = "since this change the checks of the architecture may miss what is wrong in this file"
    return tuple(_unanalysed(problem.path, f"{sentence}: {problem.message}") for problem in problems)


def unreadable_results(reasons: Mapping[str, tuple[str, str]]) -> tuple[Result, ...]:
    """One result for each file of which a linter, by its name, says since a change why it cannot analyse it."""
    sentence = "cannot analyse this file since this change, so that what is wrong in it is not found"
    return tuple(_unanalysed(path, f"{tool} {sentence}: {reason}") for path, (tool, reason) in reasons.items())


def _unanalysed(path: str, message: str, line: int | None = None) -> Result:
    """A result on a file as a whole that a change keeps from being analysed, or on the *line* that may do so to others."""
    return Result(TOOL, FILE_NOT_ANALYSED.id, FILE_NOT_ANALYSED.level, message, Location(path, line))


def _kind(problem: Problem) -> str:
    return "directory" if "a submodule" in problem.message else "file"


def _why(problem: Problem) -> str:
    line = f"line {problem.line}: " if problem.line else ""
    return f"{line}{problem.message.removeprefix('skipped: ').removeprefix('skipped ')}"
