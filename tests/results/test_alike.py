# SPDX-License-Identifier: Apache-2.0
"""Findings of one rule that say the same of one place or file are one for who reads, and every one of them is named."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.results.alike import NAMED, joined
from haros_ci.results.result import BaselineState, Related, Result, Suppression
from haros_ci.results.rule import Level


def unused(name: str, line: int, path: str = "a.launch") -> Result:
    message = f"launch argument {name!r} is declared, but never read: setting it has no effect."
    return Result("haros-ci", "unused-launch-argument", Level.WARNING, message, Location(path, line))


def lacking(name: str, line: int = 46) -> Result:
    message = f"demo needs {name} to build, but package.xml does not declare it."
    related = (Related(Location("CMakeLists.txt", 10), f"needs {name}: find_package({name})"),)
    return Result("haros-ci", "undeclared-dependency", Level.ERROR, message, Location("package.xml", line), related)


def test_arguments_of_one_file() -> None:
    one, other = joined([unused("debug", 3), unused("mode", 4), unused("gps", 7), unused("debug", 2, "b.launch")])
    assert one.message.endswith("setting it has no effect; and the same of mode and gps (lines 4 and 7)")
    assert [(place.location.line, place.message) for place in one.related] == [
        (4, "The same of mode."),
        (7, "The same of gps."),
    ]
    assert [copy.location.line for copy in one.copies] == [4, 7]
    assert other == unused("debug", 2, "b.launch")


def test_errors_at_one_place_keep_what_shows_them() -> None:
    (one,) = joined([lacking("roscpp"), lacking("rospy"), lacking("std_msgs")])
    assert one.message.endswith("; and the same of rospy and std_msgs")
    assert [place.message for place in one.related] == [
        f"needs {name}: find_package({name})" for name in ("roscpp", "rospy", "std_msgs")
    ]


def test_at_one_place_different_sentences_are_notes() -> None:
    other = replace(lacking("rospy"), message="demo needs rospy; nothing else here uses it: remove it.")
    (one,) = joined([lacking("roscpp"), other])
    assert one.message.endswith("; and 1 more like it")
    assert one.related[-1] == Related(Location("package.xml", 46), other.message)


def test_at_one_place_what_stands_in_brackets_is_shown_by_the_places() -> None:
    message = "demo needs Qt5 to build (find_package(Qt5)), but package.xml does not declare it; add Qt5 (or qt5)."
    qt = replace(lacking("Qt5"), message=message, subject=("Qt5", "demo"))
    first = replace(lacking("roscpp"), message=f"{lacking('roscpp').message.rstrip('.')}; add roscpp.")
    (one,) = joined([replace(first, subject=("demo", "roscpp")), qt])
    assert one.message.endswith("; and the same of Qt5")
    assert [place.message for place in one.related] == [
        "needs roscpp: find_package(roscpp)",
        "needs Qt5: find_package(Qt5)",
    ]


def test_what_they_are_about_is_named_where_sentences_differ() -> None:
    one = replace(lacking("roscpp"), subject=("demo", "roscpp"))
    others = [replace(lacking(name), message=f"{name} is idle", subject=("demo", name)) for name in ("rospy", "tf")]
    (whole,) = joined([one, *others])
    assert whole.message.endswith("; and the same of rospy and tf")
    assert [place.message for place in whole.related[1:]] == ["rospy is idle", "tf is idle"]


@pytest.mark.parametrize(
    ("first", "others", "named"),
    [
        (("demo", "librealsense"), [("demo", "tf")], "tf"),
        (
            ("aa", "demo"),
            [("demo", "tf"), ("bb", "demo")],
            "tf and bb",
        ),  # sorted, so the package changes its place
        (("demo", "tf"), [("aa", "demo")], "aa"),
        (("demo", "tf"), [("aa", "other")], ""),
        (("demo", "tf"), [("demo", "tf")], ""),
        (("demo",), [("demo", "tf")], ""),
    ],
)
def test_what_another_is_about_whatever_its_place(
    first: tuple[str, ...], others: list[tuple[str, ...]], named: str
) -> None:
    rest = [replace(lacking("x"), message=f"{subject} is idle", subject=subject) for subject in others]
    (one,) = joined([replace(lacking("y"), subject=first), *rest])
    assert one.message.endswith(f"; and the same of {named}" if named else f"; and {len(others)} more like it")


def test_many_are_counted() -> None:
    (one,) = joined([unused(f"n{number}", number) for number in range(1, NAMED + 5)])
    assert f"n{NAMED + 1} and 3 more (lines 2, 3, 4, 5, 6 and {NAMED - 2} more)" in one.message
    assert len(one.copies) == NAMED + 3


def test_at_one_place_what_shows_them_says_more_than_their_sentences() -> None:
    """Each of them stands at the same line, and a note has room for the half of its sentence."""
    first, second = (
        replace(
            lacking(name),
            message=f"demo needs {name} to build (find_package({name})), but package.xml does not declare it.",
            subject=("demo", name),
        )
        for name in ("roscpp", "rospy")
    )
    key = lacking("yaml-cpp")
    keyed = replace(
        key,
        message="demo needs yaml-cpp to build (find_package(YAML)), but package.xml does not declare it.",
        subject=("demo", "yaml-cpp"),
    )
    (one,) = joined([first, second, keyed])
    assert one.message.endswith("; and the same of rospy and yaml-cpp")
    assert [place.message for place in one.related] == [
        f"needs {name}: find_package({name})" for name in ("roscpp", "rospy", "yaml-cpp")
    ]


def test_parameters_that_are_read_one_after_another() -> None:
    names = {10: "robot.wheel_radius", 11: "robot.Kp", 12: "robot_id", 30: "rate"}
    found = [
        Result("haros-ci", "parameter-read-undeclared", Level.ERROR, f"cart/cart reads the parameter {name}, but does not declare it: the call throws; declare it first.", Location("a.cpp", line), subject=("cart/cart", name))
        for line, name in names.items()
    ]  # fmt: skip
    one, far = joined(found)
    assert one.message.endswith("declare it first; and the same of robot.Kp and robot_id (lines 11 and 12)")
    assert far == found[-1]


def unprefixed(name: str, line: int, *copies: str) -> Result:
    message = f"<{name}> has the name of a macro, but xacro expands <xacro:{name}> only: the element has no effect; write <xacro:{name}>"
    one = Result("haros-ci", "undefined-in-xacro", Level.ERROR, message, Location("a.xacro", line), subject=("a", name))
    return replace(one, copies=tuple(replace(one, location=Location(path, line)) for path in copies))


def test_elements_without_the_prefix_of_xacro() -> None:
    (one,) = joined([unprefixed("wheel", 3), unprefixed("arm", 9), unprefixed("wheel", 40)])
    assert one.message.endswith("; and 2 more like it (lines 9 and 40)") and len(one.copies) == 2
    (one,) = joined([unprefixed("wheel", 3, "b.xacro"), unprefixed("arm", 9, "b.xacro")])
    assert len(one.copies) == 3
    apart = [unprefixed("wheel", 3, "b.xacro"), unprefixed("arm", 9)]
    assert joined(apart) == tuple(apart)
    other = replace(unprefixed("arm", 9), message="calls the macro 'arm', which is not defined here")
    assert joined([unprefixed("wheel", 3), other]) == (unprefixed("wheel", 3), other)


@pytest.mark.parametrize(
    ("rule", "messages", "count"),
    [
        ("broken-robot-model", ["the <limit> of joint {} has no effort and no velocity: urdfdom rejects the whole robot; add the attribute."] * 3, 1),
        ("broken-robot-model", ["the revolute joint {} has no <limit>: urdfdom rejects the whole robot; add <limit>."] * 2, 1),
        (
            "broken-robot-model",
            ["the <limit> of joint {} has no effort: urdfdom rejects the whole robot.", "the <limit> of joint {} has no effort and no velocity: urdfdom rejects the whole robot."],
            2,
        ),
        ("broken-robot-model", ["duplicate link '{}' in one robot: urdfdom rejects the robot; rename one of the two."] * 2, 2),
        ("broken-robot-model", ["joint {} names the child link 'a', which the robot does not have: urdfdom rejects the robot."] * 2, 2),
        ("generation-not-awaited", ["target {} includes arm/Pose.h, which is generated in arm, but does not depend on the generation: a clean build fails."] * 2, 1),
        ("undeclared-dependency", ["target {} includes arm/Pose.h, but does not depend on the generation: it fails."] * 2, 2),
    ],
)  # fmt: skip
def test_errors_of_one_cause_in_one_file(rule: str, messages: list[str], count: int) -> None:
    found = [
        Result(
            "haros-ci", rule, Level.ERROR, message.format(f"j{i}"), Location("a.urdf", 10 * i), subject=("arm", f"j{i}")
        )
        for i, message in enumerate(messages, 1)
    ]
    assert len(joined(found)) == count


def test_the_same_of_the_same_place_is_not_counted() -> None:
    """Two branches start a node that is given one file: what differs is where."""
    one, other = (replace(missing(3), related=(Related(Location("a.launch", line), "starts it"),)) for line in (26, 42))
    (whole,) = joined([one, other])
    assert whole.message == one.message and len(whole.copies) == 1
    assert [place.location.line for place in whole.related] == [26, 42]


def test_at_another_place_the_sentence_is_the_note() -> None:
    far = [replace(missing(line), related=(Related(Location("b.launch", 1), "included here"),)) for line in (3, 9)]
    (one,) = joined(far)
    assert Related(Location("a.launch", 9), far[1].message) in one.related


def in_copies(name: str, line: int, *paths: str) -> Result:
    one = lacking(name, line)
    copies = tuple(replace(one, location=Location(path, line)) for path in paths)
    return replace(
        one,
        message=f"{one.message.rstrip('.')}; and the same in {len(paths)} copies ({', '.join(paths)})",
        copies=copies,
    )


def test_those_that_stand_for_copies_at_one_line() -> None:
    (one,) = joined(
        [
            in_copies("roscpp", 46, "b.xml", "c.xml"),
            in_copies("rospy", 46, "b.xml", "c.xml"),
            in_copies("tf", 46, "b.xml"),
        ]
    )
    assert one.message.endswith("; and 2 more like it")
    assert [str(copy.location.path) for copy in one.copies] == [
        "b.xml",
        "c.xml",
        "package.xml",
        "b.xml",
        "c.xml",
        "package.xml",
        "b.xml",
    ]
    (one,) = joined([in_copies("roscpp", 46, "b.xml"), in_copies("rospy", 46, "b.xml")])
    assert one.message.endswith("(b.xml); and the same of rospy")


def test_those_that_stand_for_copies_at_several_lines() -> None:
    results = [in_copies("roscpp", 46, "b.xml"), in_copies("roscpp", 47, "b.xml"), lacking("tf", 46)]
    assert joined(results) == tuple(results)


def missing(line: int, rest: str = "", subject: tuple[str, ...] = ("demo/talker",)) -> Result:
    message = f"package demo builds or installs no program 'talker': this node cannot start{rest}."
    return Result("haros-ci", "unknown-executable", Level.ERROR, message, Location("a.launch", line), subject=subject)


@pytest.mark.parametrize("rest", ["", "; seen with roslaunch demo a.launch sim:=1", "; did you mean 'talk'?"])
def test_one_cause_at_several_places(rest: str) -> None:
    (one,) = joined([missing(3), missing(9, rest), missing(12)])
    assert one.message.endswith("; and 2 more like it (lines 9 and 12)")
    assert [copy.location.line for copy in one.copies] == [9, 12]


QUIET = [
    pytest.param([missing(3), missing(9, subject=("demo/listener",))], id="two subjects"),
    pytest.param([missing(3, subject=()), missing(9, subject=())], id="no subject"),
    pytest.param(
        [missing(3), replace(missing(9), message="demo/talker is a library.")], id="the subject in other words"
    ),
    pytest.param([lacking("rospy", 3), lacking("roscpp", 4)], id="errors at two lines: each is mended by itself"),
    pytest.param([unused("a", 1), unused("b", 1, "b.launch")], id="two files"),
    pytest.param([unused("a", 1), replace(unused("b", 2), message="another sentence of it")], id="other words"),
    pytest.param([unused("a", 1), replace(unused("b", 2), rule="other")], id="two rules"),
    pytest.param([unused("a", 1), replace(unused("b", 2), tool="pylint")], id="two tools"),
    pytest.param([unused("a", 1), replace(unused("b", 2), level=Level.NOTE)], id="two levels"),
    pytest.param(
        [replace(unused("a", 1), state=BaselineState.UNCHANGED), replace(unused("b", 2), state=BaselineState.NEW)],
        id="a known one and a new one",
    ),
    pytest.param([replace(unused(name, 1), state=BaselineState.ABSENT) for name in "ab"], id="what is gone"),
    pytest.param([unused("a", 1), replace(unused("b", 2), suppressions=(Suppression("inSource"),))], id="suppressed"),
    pytest.param([unused("a", 1), replace(unused("b", 2), copies=(unused("c", 3),))], id="stands for others already"),
    pytest.param([replace(unused(name, 1), value=1.0) for name in "ab"], id="numbers"),
    pytest.param([replace(unused(name, 1), location=Location("a")) for name in "ab"], id="no line"),
]


@pytest.mark.parametrize("results", QUIET)
def test_others_stay(results: list[Result]) -> None:
    assert list(joined(results)) == results


def unknown(name: str, line: int, rule: str = "undefined-variable", more: str = "") -> Result:
    return Result("pylint", rule, Level.ERROR, f"Undefined variable {name!r}{more}.", Location("a.py", line))


def test_names_that_are_not_there_on_neighbouring_lines() -> None:
    one, other = joined([unknown("rospy", 13), unknown("Pose", 14), unknown("tf", 17), unknown("mock", 48)])
    assert one.message == "Undefined variable 'rospy'; and the same of Pose and tf (lines 14 and 17)"
    assert other == unknown("mock", 48)
    (two,) = joined([unknown("speed", 3, more="; did you mean 'velocity'?"), unknown("mode", 4)])
    assert [copy.location.line for copy in two.copies] == [4]


def test_two_names_that_are_not_there_on_one_line_and_more_below() -> None:
    results = [unknown("b0", 171), unknown("model", 171, more="; did you mean 'mode'?"), unknown("b1", 174)]
    (one,) = joined([*results, unknown("b2", 177)])
    assert [copy.location.line for copy in one.copies] == [171, 174, 177]
    assert one.message.startswith("Undefined variable 'b0'; and ")


def test_arguments_that_the_same_copies_have() -> None:
    copies = [(unused(name, 1, "b.launch"),) for name in "ab"]
    first, other = (replace(unused(name, n), copies=same) for n, (name, same) in enumerate(zip("ab", copies), 1))
    (one,) = joined([first, other])
    assert one.copies == (*copies[0], other, *copies[1])


def empty(folder: str, line: int, hint: str = "or add a file to {}: git stores no directory that is empty") -> Result:
    message = f"demo installs {folder}, which is not there: colcon build stops with an error; remove it, {hint.format(folder)}."
    subject = (folder, "demo")
    return Result(
        "haros-ci", "missing-install-source", Level.ERROR, message, Location("CMakeLists.txt", line), subject=subject
    )


def unawaited(target: str, line: int, includes: str, package: str = "demo") -> Result:
    message = f"target {target} includes {includes} generated in {package}, but does not depend on the generation: a clean build may fail; add add_dependencies({target} x)."
    subject = (target, package)
    return Result(
        "haros-ci", "generation-not-awaited", Level.ERROR, message, Location("CMakeLists.txt", line), subject=subject
    )


def test_directories_that_git_has_not_kept() -> None:
    (one,) = joined([empty("include", 60), empty("meshes", 88), empty("maps", 96)])
    assert one.message.endswith("; and the same of meshes and maps (lines 88 and 96)")
    assert len(joined([empty("maps", 60), empty("mesh", 88, "did you mean meshes?")])) == 2
    assert len(joined([empty("maps", 60), replace(empty("m", 88), location=Location("b/CMakeLists.txt", 88))])) == 2


def test_targets_that_include_one_or_several_generated_headers() -> None:
    several = unawaited("control", 73, "a.h and 2 more, which are")
    (one,) = joined([several, unawaited("vision", 88, "b.h, which is"), unawaited("arm", 92, "c.h, which is")])
    assert one.message.endswith("; and the same of vision and arm (lines 88 and 92)")
    assert len(joined([several, replace(unawaited("vision", 88, "b.h, which is"), level=Level.NOTE)])) == 2


@pytest.mark.parametrize(
    "results",
    [
        [unknown("rospy", 13), unknown("Pose", 17)],
        [unknown("a", 13), unknown("b", 17), unknown("c", 21)],
        [unknown("rospy", 13), unknown("Pose", 14, more=" in the class")],
        [unknown("rospy", 13, "not-callable"), unknown("Pose", 14, "not-callable")],
        [unknown("rospy", 13), replace(unknown("Pose", 14), location=Location("b.py", 14))],
        [unknown("rospy", 13), replace(unknown("Pose", 14), state=BaselineState.UNCHANGED)],
        [unknown("rospy", 13), replace(unknown("Pose", 14), suppressions=(Suppression("inSource", "meant"),))],
    ],
)
def test_names_that_have_causes_of_their_own(results: list[Result]) -> None:
    assert joined(results) == tuple(results)


def absent(node: str, line: int, path: str = "config/a.yaml", rule: str = "parameter-file-missing") -> Result:
    message = (
        f"the parameter file {path} does not exist: launch prints a warning and starts {node} without these parameters."
    )
    return Result("haros-ci", rule, Level.ERROR, message, Location("a.launch.py", line), subject=(path, node))


def test_a_file_that_several_nodes_lack_is_one_cause() -> None:
    (one,) = joined([absent("/planner", 3), absent("/controller", 9), absent("/behaviors", 12)])
    assert one.message.endswith("without these parameters; and the same of /controller and /behaviors (lines 9 and 12)")
    assert [copy.location.line for copy in one.copies] == [9, 12]


def test_a_mistake_at_each_node_of_a_launch_file_is_one_cause() -> None:
    wrong = Result(
        "haros-ci",
        "malformed-launch-file",
        Level.ERROR,
        "<node> has no attribute 'executable'; write exec.",
        Location("a.xml", 3),
    )
    (one,) = joined([wrong, replace(wrong, location=Location("a.xml", 7))])
    assert one.message == "<node> has no attribute 'executable'; write exec; and 1 more like it (line 7)"


@pytest.mark.parametrize(
    "results",
    [
        [absent("/planner", 3), absent("/planner", 9, "config/b.yaml")],
        [absent("/planner", 3), replace(absent("/controller", 9), location=Location("b.launch.py", 9))],
        [absent("/planner", 3), absent("/controller", 9, rule="missing-launch-file")],
        [absent("/planner", 3), replace(absent("/controller", 9), level=Level.NOTE)],
        [absent("/planner", 3, rule="malformed-launch-file"), absent("/controller", 9, rule="malformed-launch-file")],
    ],
)
def test_other_errors_stay_apart(results: list[Result]) -> None:
    assert joined(results) == tuple(results)
