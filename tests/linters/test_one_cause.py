# SPDX-License-Identifier: Apache-2.0
"""What cppcheck derives several times from one assumption is one finding."""

from __future__ import annotations

import pytest

from haros_ci.linters.one_cause import MOST, one_cause
from haros_ci.model.location import Location
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

BODY = "  use(a);\n" * 100
TEXT = f"void first() {{\n{BODY}}}\nvoid second() {{\n{BODY}}}\n"
SECOND = 105


def found(
    line: int, name: str, *because: int, rule: str = "containerOutOfBounds", level: Level = Level.WARNING
) -> Result:
    message = f"Out of bounds access in expression '{name}[i]' because '{name}' is empty."
    related = tuple(Related(Location("a.cpp", each, 1), "assumed") for each in because)
    return Result("cppcheck", rule, level, message, Location("a.cpp", line, 1), related)


def lines(results: list[Result]) -> list[list[int | None]]:
    return [[r.location.line, *(n.location.line for n in r.related)] for r in one_cause(results, lambda path: TEXT)]


@pytest.mark.parametrize(
    ("results", "expected"),
    [
        ([found(3, "p"), found(5, "p")], [[3, 5]]),
        ([found(5, "p"), found(3, "p")], [[3, 5]]),
        ([found(3, "p", 2), found(5, "q", 2)], [[3, 2, 5]]),  # one line explains both
        ([found(line, "it", rule="eraseDereference") for line in (3, 9)], [[3, 9]]),
        ([found(line, "it", rule="eraseDereference") for line in (3, SECOND)], [[3], [SECOND]]),
        ([found(3, "p"), found(4, "q"), found(8, "p", 6), found(9, "q", 6)], [[3, 4, 8, 9]]),  # a pair
        ([found(3, "p"), found(5, "q")], [[3], [5]]),
        ([found(3, "p", 2), found(5, "q", 4)], [[3, 2], [5, 4]]),
        ([found(3, "p"), found(SECOND, "p")], [[3], [SECOND]]),  # another function's variable
        ([found(3, "p"), found(5, "p", rule="nullPointer")], [[3], [5]]),
        ([found(3, "p", rule="unusedVariable"), found(5, "p", rule="unusedVariable")], [[3], [5]]),
        ([found(500, "p"), found(501, "p")], [[500], [501]]),  # in no function
        ([], []),
    ],
)
def test_findings_of_one_cause(results: list[Result], expected: list[list[int | None]]) -> None:
    assert lines(results) == expected


def leak(line: int, name: str, rule: str = "memleak") -> Result:
    return Result("cppcheck", rule, Level.WARNING, f"Memory leak: {name}", Location("a.cpp", line, 1))


@pytest.mark.parametrize(
    ("results", "expected"),
    [
        ([leak(3, "a"), leak(3, "b"), leak(3, "c")], [[3, 3, 3]]),  # a function is left
        ([leak(3, "a"), leak(7, "a")], [[3, 7]]),  # at two places
        ([leak(3, "a"), leak(3, "b"), leak(7, "a"), leak(7, "b")], [[3, 3, 7, 7]]),
        ([leak(3, "f", "resourceLeak"), leak(9, "f", "resourceLeak")], [[3, 9]]),
        ([leak(3, "a"), leak(3, "f", "resourceLeak")], [[3], [3]]),
        ([leak(3, "a"), leak(7, "b")], [[3], [7]]),
        ([leak(3, "a"), leak(SECOND, "a")], [[3], [SECOND]]),
        ([leak(500, "a"), leak(500, "b")], [[500], [500]]),
        ([found(3, "p", rule="sprintfOverlappingData"), found(9, "p", rule="sprintfOverlappingData")], [[3, 9]]),
        ([found(3, "p"), found(3, "q")], [[3], [3]]),
    ],
)
def test_leaks_of_one_cause(results: list[Result], expected: list[list[int | None]]) -> None:
    assert lines(results) == expected


@pytest.mark.parametrize(
    ("places", "expected"),
    [
        ([(3, "check"), (5, "check"), (9, "check")], [[3, 5, 9]]),
        ([(3, "goal.x"), (5, "goal.x")], [[3, 5]]),
        ([(3, "goal->x"), (5, "goal->x")], [[3, 5]]),
        ([(3, "check"), (5, "checked")], [[3], [5]]),
        ([(3, "goal.x"), (5, "goal.y")], [[3], [5]]),
        ([(3, "goal.x"), (5, "x")], [[3], [5]]),
        ([(3, "check"), (SECOND, "check")], [[3], [SECOND]]),  # another function's variable
        ([(500, "check"), (501, "check")], [[500], [501]]),  # in no function
    ],
)
@pytest.mark.parametrize("end", ["", "."])
def test_a_variable_without_a_value(places: list[tuple[int, str]], expected: list[list[int]], end: str) -> None:
    message = "Uninitialized variable: {}" + end
    given = [
        Result("cppcheck", "uninitvar", Level.ERROR, message.format(name), Location("a.cpp", line, 1))
        for line, name in places
    ]
    assert lines(given) == expected


CALLS = """
role.update()
self.role.update()
team.role(1).update(
    (a, b), ')',
)
other.update_all()
Role(update=update())
super().__init__()
Base.__init__()
"""


def called(rule: str, line: int, column: int, end: tuple[int, int]) -> Result:
    place = Location("a.py", line, column, *end)
    return Result("pylint", rule, Level.ERROR, "No value for argument 'ball' in method call", place)


NO_VALUE = [("no-value-for-parameter", 2, 1, (2, 14)), ("no-value-for-parameter", 3, 1, (3, 19))]


@pytest.mark.parametrize(
    ("calls", "expected"),
    [
        (NO_VALUE, [[2, 3]]),
        ([*NO_VALUE, ("no-value-for-parameter", 4, 1, (6, 2))], [[2, 3, 4]]),
        ([*NO_VALUE, ("no-value-for-parameter", 8, 13, (8, 21))], [[2, 3, 8]]),
        ([("too-many-function-args", *NO_VALUE[0][1:]), ("too-many-function-args", *NO_VALUE[1][1:])], [[2, 3]]),
        ([("unexpected-keyword-arg", *NO_VALUE[0][1:]), ("unexpected-keyword-arg", *NO_VALUE[1][1:])], [[2, 3]]),
        ([NO_VALUE[0], ("no-value-for-parameter", 7, 1, (7, 19))], [[2], [7]]),  # another function
        ([NO_VALUE[0], ("unexpected-keyword-arg", *NO_VALUE[1][1:])], [[2], [3]]),  # another fault
        ([NO_VALUE[0], ("unexpected-keyword-arg", *NO_VALUE[0][1:])], [[2, 2]]),  # of the same call
        ([*NO_VALUE, ("missing-kwoa", *NO_VALUE[0][1:]), ("missing-kwoa", *NO_VALUE[1][1:])], [[2, 2, 3, 3]]),
        ([NO_VALUE[0], ("no-value-for-parameter", 8, 1, (8, 22))], [[2], [8]]),
        ([("no-value-for-parameter", 9, 1, (9, 19)), ("no-value-for-parameter", 10, 1, (10, 16))], [[9], [10]]),
        ([NO_VALUE[0], ("no-value-for-parameter", 30, 1, (30, 19))], [[2], [30]]),  # a line that is not there
    ],
)
def test_calls_of_one_function(calls: list[tuple[str, int, int, tuple[int, int]]], expected: list[list[int]]) -> None:
    found = one_cause([called(*each) for each in calls], lambda path: CALLS)
    assert [[r.location.line, *(n.location.line for n in r.related)] for r in found] == expected


def test_the_worst_level_is_kept_and_the_others_are_quoted() -> None:
    (only,) = one_cause([found(3, "p"), found(5, "p", level=Level.ERROR)], lambda path: TEXT)
    assert only.level is Level.ERROR and only.related[0].message.startswith("Of the same cause: Out of bounds")


def test_a_finding_names_so_many_places_at_most() -> None:
    many = [found(line, "p") for line in range(2, 2 + 2 * (MOST + 1))]
    assert [len(line) for line in lines(many)] == [MOST + 1, MOST + 1]


def test_other_tools_pass_through() -> None:
    other = Result("pylint", "nullPointer", Level.ERROR, "'p'", Location("a.cpp", 3))
    assert one_cause([other, other], lambda path: TEXT) == (other, other)


@pytest.mark.parametrize(
    ("rule", "lines", "left"),
    [
        ("pylint:no-value-for-parameter", (3, 3, 5), 2),
        ("ruff:F811", (1, 1, 1), 1),
        ("pylint:anomalous-backslash-in-string", (3, 3, 5), 2),
        ("pylint:invalid-all-object", (3, 4, 5), 1),
        ("cpplint:readability/utf8", (3, 4, 5), 1),
        ("pylint:undefined-variable", (3, 3), 2),
        ("ruff:F401", (1, 1), 2),
        ("pylint:F811", (1, 1), 2),
    ],
)
def test_what_is_said_of_each_argument_or_name(rule: str, lines: tuple[int, ...], left: int) -> None:
    tool, _, rule = rule.partition(":")
    given = [Result(tool, rule, Level.ERROR, f"of {i}", Location("a.py", line, i + 1)) for i, line in enumerate(lines)]
    found = one_cause(given, lambda path: "")
    assert len(found) == left and found[0].message == "of 0"
    assert sum(1 + len(result.related) for result in found) == len(lines)


def undefined(names: str, level: Level = Level.ERROR, path: str = "a.py") -> list[Result]:
    """A finding for each of *names*, on a line of its own."""
    return [
        Result("pylint", "undefined-variable", level, f"Undefined variable '{name}'.", Location(path, line, 1))
        for line, name in enumerate(names.split(), 1)
    ]


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (undefined("a b c d"), ["Undefined variable 'a'; 3 more names are not defined in this file: 'b', 'c', 'd'"]),
        (
            undefined("a b a c d e"),
            ["Undefined variable 'a'; 4 more names are not defined in this file: 'b', 'c', 'd', …"],
        ),
        (undefined("a b c"), ["Undefined variable 'a'.", "Undefined variable 'b'.", "Undefined variable 'c'."]),
        (undefined("a a a a"), ["Undefined variable 'a'."]),
        (undefined("a b") + undefined("c d", path="b.py"), [f"Undefined variable '{name}'." for name in "abcd"]),
        (undefined("a b") + undefined("c d", Level.WARNING), [f"Undefined variable '{name}'." for name in "abcd"]),
    ],
)
def test_many_names_of_one_file_that_are_not_there(given: list[Result], expected: list[str]) -> None:
    found = one_cause(given, lambda path: "")
    assert [result.message for result in found] == expected
    assert sum(1 + len(result.related) for result in found) == len(given)


def test_very_many_names_are_several_findings() -> None:
    found = one_cause(undefined(" ".join(f"n{i}" for i in range(MOST + 3))), lambda path: "")
    assert [len(result.related) for result in found] == [MOST, 1]


@pytest.mark.parametrize(("line", "left"), [(3, 1), (4, 2)])
def test_iterators_of_two_containers(line: int, left: int) -> None:
    first = Result(
        "cppcheck", "mismatchingContainerIterator", Level.ERROR, "Iterator 'a.begin()'", Location("a.cpp", 3, 9)
    )
    second = Result(
        "cppcheck", "mismatchingContainers", Level.ERROR, "Iterators of 'a' and 'b'", Location("a.cpp", line, 9)
    )
    assert len(one_cause([first, second], lambda path: "")) == left


@pytest.mark.parametrize("rule", ["pylint:undefined-variable", "ruff:F821"])
def test_one_name_that_is_not_there(rule: str) -> None:
    tool, _, rule = rule.partition(":")
    places = [("a.py", 3, "x"), ("a.py", 9, "x"), ("a.py", 9, "y"), ("b.py", 3, "x")]
    given = [Result(tool, rule, Level.ERROR, f"Undefined name `{n}`", Location(p, line, 1)) for p, line, n in places]
    found = one_cause(given, lambda path: "")
    assert [(r.location.path, r.location.line, len(r.related)) for r in found] == [
        ("a.py", 3, 1),
        ("a.py", 9, 0),
        ("b.py", 3, 0),
    ]


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        (("stlcstr", 3), ("returnDanglingLifetime", 3), 1),
        (("returnDanglingLifetime", 3), ("stlcstr", 3), 1),
        (("stlcstr", 3), ("returnDanglingLifetime", 4), 2),
        (("stlcstr", 3), ("nullPointer", 3), 2),
        (("returnReference", 3), ("returnDanglingLifetime", 3), 2),
    ],
)
def test_a_pointer_into_a_text_that_ends(first: tuple[str, int], second: tuple[str, int], expected: int) -> None:
    given = [found(line, name, rule=name) for name, line in (first, second)]
    assert len(one_cause(given, lambda path: TEXT)) == expected


@pytest.mark.parametrize(
    ("text", "places", "left"),
    [
        ("{\n  int a, b, c;\n}\n", [(2, 7), (2, 10), (2, 13)], 1),
        ("{\n  int a,\n      b;\n}\n", [(2, 7), (3, 7)], 1),
        ("{\n  int a, // the first; of two\n      b;\n}\n", [(2, 7), (3, 7)], 1),
        ("{\n  int a; int b;\n}\n", [(2, 7), (2, 14)], 2),
        ("{\n  int a;\n  int b;\n}\n", [(2, 7), (3, 7)], 2),
        ("{ int a; } { int a; }\n", [(1, 7), (1, 18)], 2),
        ("", [(2, 7), (2, 10)], 2),
        ("{\n  int a, b;\n}\n", [(2, 0), (2, 0)], 1),
    ],
)
def test_the_variables_of_one_declaration(text: str, places: list[tuple[int, int]], left: int) -> None:
    given = [
        Result(
            "cppcheck", "unusedVariable", Level.NOTE, f"Unused variable: {i}", Location("a.cpp", line, column or None)
        )
        for i, (line, column) in enumerate(places)
    ]
    assert len(one_cause(given, lambda path: text)) == left
    others = [Result("cppcheck", "unreadVariable", r.level, r.message, r.location) for r in given]
    assert len(one_cause(others, lambda path: text)) == len(places)


@pytest.mark.parametrize(
    ("text", "places", "left"),
    [
        ('{\n  if (a == "b" || "c" ||\n    "d")\n    go();\n}\n', [(2, 19), (3, 5)], 1),
        ('{\n  if (a == "b" || "c" || // or; so\n    "d" || "e")\n    go();\n}\n', [(2, 19), (3, 5), (3, 12)], 1),
        ('{\n  if (a || "c") go();\n  if (b || "c") go();\n}\n', [(2, 12), (3, 12)], 2),
        ('{\n  if (a || "c") { if (b || "d") go(); }\n}\n', [(2, 12), (2, 28)], 2),
    ],
)
@pytest.mark.parametrize("rule", ["incorrectStringBooleanError", "incorrectCharBooleanError"])
def test_the_texts_of_one_condition(text: str, places: list[tuple[int, int]], left: int, rule: str) -> None:
    given = [
        Result("cppcheck", rule, Level.WARNING, f'Conversion of string literal "{i}"', Location("a.cpp", line, column))
        for i, (line, column) in enumerate(places)
    ]
    joined = one_cause(given, lambda path: text)
    assert len(joined) == left and sum(1 + len(each.related) for each in joined) == len(places)


def thrown(line: int, name: str, rule: str = "exceptThrowInDestructor") -> Result:
    message = f"Class {name} is not safe, destructor throws exception"
    if rule == "throwInNoexceptFunction":
        message = "Unhandled exception thrown in function declared not to throw exceptions."
    return Result("cppcheck", rule, Level.WARNING, message, Location("a.cpp", line, 5))


@pytest.mark.parametrize(
    ("results", "expected"),
    [
        ([thrown(3, "Box"), thrown(3, "Box < int >")], [[3, 3]]),
        ([thrown(3, "Box"), thrown(3, "", "throwInNoexceptFunction")], [[3, 3]]),
        (
            [thrown(3, "Box < int >"), thrown(3, "Box<std::map<int,int>>"), thrown(3, "", "throwInNoexceptFunction")],
            [[3, 3, 3]],
        ),
        ([thrown(3, "Box"), thrown(5, "Box < int >")], [[3], [5]]),
        ([thrown(3, "", "throwInNoexceptFunction"), thrown(5, "Box")], [[3], [5]]),
    ],
)
def test_exceptions_that_leave_a_function(results: list[Result], expected: list[list[int | None]]) -> None:
    assert lines(results) == expected


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (["Box", "Box < int >"], [[3, 3]]),
        (["Box < int >", "Box", "Box < std :: vector < int > >"], [[3, 3, 3]]),
        (["Box < int >", "Bag < int >"], [[3], [3]]),
        (["Box", "Bag < int >"], [[3], [3]]),
        (["Box", "Box"], [[3], [3]]),  # two variables, say
    ],
)
def test_instances_of_a_template(names: list[str], expected: list[list[int | None]]) -> None:
    assert lines([thrown(3, name, "noCopyConstructor") for name in names]) == expected


def raising(line: int, rule: str = "raising-bad-type", tool: str = "pylint") -> Result:
    return Result(tool, rule, Level.ERROR, "Raising NotImplementedType.", Location("a.py", line, 5))


@pytest.mark.parametrize(
    ("results", "expected"),
    [
        ([raising(3, "notimplemented-raised"), raising(3)], [[3, 3]]),
        ([raising(3, "notimplemented-raised"), raising(5)], [[3], [5]]),
        ([raising(3), raising(5)], [[3], [5]]),
        ([raising(3, "notimplemented-raised"), raising(3, tool="other")], [[3], [3]]),
        ([raising(3, "notimplemented-raised"), raising(3, "not-callable")], [[3], [3]]),
    ],
)
def test_what_is_no_exception(results: list[Result], expected: list[list[int | None]]) -> None:
    assert lines(results) == expected
