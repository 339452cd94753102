# SPDX-License-Identifier: Apache-2.0
"""A change that adds to a known finding which stands for several, or says the same of another name, has a new one."""

from __future__ import annotations

import re

import pytest

from haros_ci.linters.one_cause import MOST, one_cause
from haros_ci.model.location import Location
from haros_ci.results.fingerprint import fingerprint
from haros_ci.results.known import ComparedFiles, known_from_results
from haros_ci.results.matching import match
from haros_ci.results.named_defects import is_other_defect
from haros_ci.results.result import Result, Run, Tool
from haros_ci.results.rule import Level
from haros_ci.results.suppress import suppress

#: What a toy pylint says of names and calls, by what stands in the text.
SAYS = {
    "undefined-variable": (re.compile(r"\bno_\w+"), "Undefined variable '{0}'"),
    "no-value-for-parameter": (re.compile(r"\bcall\(\w*(?=\))"), "No value for argument 'b' in function call"),
    "unused-variable": (re.compile(r"\bun_\w+"), "Unused variable '{0}'"),
}


def examined(text: str) -> tuple[Result, ...]:
    found = []
    for number, line in enumerate(text.split("\n"), 1):
        for rule, (pattern, message) in SAYS.items():
            for hit in pattern.finditer(line):
                place = Location("a.py", number, hit.start() + 1, number, hit.end() + 2)
                found.append(Result("pylint", rule, Level.ERROR, message.format(hit[0]), place))
    run = Run(Tool("pylint"), results=one_cause(found, lambda path: text), analysed=frozenset(("a.py",)))
    runs, _ = suppress((run,), lambda path: text, lambda path: "python", lambda name, one: name == one.rule)
    return fingerprint(runs, lambda path: text, lambda path: "python")[0].results


def compared(before: str, after: str, *, is_revision: bool = True) -> list[tuple[str, int | None, str]]:
    sides = ComparedFiles(
        head=lambda path: after,
        base=(lambda path: before) if is_revision else None,
        language=lambda path: "python",
        exists=lambda path: True,
    )
    found = match(examined(after), known_from_results(examined(before)), sides)
    return [(r.state.value, r.location.line, r.message) for r in found if r.state and not r.suppressions]


def new(before: str, after: str) -> list[int | None]:
    return [line for state, line, _ in compared(before, after) if state == "new"]


FOUR = "def one():\n    return no_a + no_b + no_c + no_d\n"
OTHER = "\n\ndef other():\n    return {0}\n"
CALLS = "def one():\n    call(1)\n    call(2)\n"
MANY = "".join(f"def f{i}():\n    return no_{i}\n\n\n" for i in range(MOST + 5))

FIRES = {
    "a fifth name": (FOUR, FOUR + OTHER.format("no_e"), [6]),
    "a fifth name above the others": (FOUR, OTHER.format("no_e") + FOUR, [4]),
    "one of the four in another function": (FOUR, FOUR + OTHER.format("no_a"), [6]),
    "a fifth name in a line of the four": (FOUR, FOUR.replace("no_d", "no_d + no_e"), [2]),
    "two names in two functions are one": (FOUR, FOUR + OTHER.format("no_e") + OTHER.format("no_f + no_g + no_h"), [6]),
    "one name mended, one brought": (FOUR, FOUR.replace("no_d", "1") + OTHER.format("no_e"), [6]),
    "a name beside one of a large file": (MANY, MANY + OTHER.format("no_e"), [4 * (MOST + 5) + 4]),
    "one more call": (CALLS, CALLS + "    call(3)\n", [4]),
    "another name in the line": (OTHER.format("no_a"), OTHER.format("no_e"), [4]),
    "another name in an edited line": (OTHER.format("no_a + 1"), OTHER.format("2 + no_e + 1"), [4]),
    "another unused name, the old one used": (
        "def one():\n    un_a = 1\n",
        "def one():\n    un_e = 1\n    print(x.un_a)\n".replace("un_a)", "un_a)  # un_a"),
        [2],
    ),
}  # fmt: skip

QUIET = {
    "nothing": (FOUR, FOUR),
    "lines above": (FOUR, "import os\n\n\n" + FOUR),
    "another function's name": (FOUR, FOUR.replace("one", "first")),
    "one name mended": (FOUR, FOUR.replace(" + no_d", "")),
    "the first name mended": (FOUR, FOUR.replace("no_a + ", "")),
    "two names mended": (FOUR, FOUR.replace("no_a + no_b + ", "")),
    "the line in two": (FOUR, FOUR.replace("no_b + ", "no_b\n    return ")),
    "an edited line": (FOUR, FOUR.replace("return ", "return 1 + ")),
    "a line with one name edited": (OTHER.format("no_a"), OTHER.format("no_a + 5")),
    "a function moved": (FOUR + OTHER.format("1"), OTHER.format("1") + FOUR),
    "all of a large file moved": (MANY, "\n\n" + MANY),
    "one of a large file mended": (MANY, MANY.replace("no_3\n", "1\n")),
    "a call edited": (CALLS, CALLS.replace("call(2)", "call(5)")),
    "two arguments missing in one call": ("call()\n", "call()\n"),
    "a call twice in a line of one": ("call(1); call(2)\n", "\n\ncall(1); call(2)\n"),
    "calls in a renamed function": (CALLS, CALLS.replace("one", "first")),
    "an unused name renamed": ("def one():\n    un_a = 1\n", "def one():\n    un_e = 1\n"),
    "an unused name renamed, its line edited": ("def one():\n    un_a = 1 + 2\n", "def one():\n    un_e = 1 + 3\n"),
}


@pytest.mark.parametrize("name", FIRES)
def test_what_is_added_to_a_known_finding_is_new(name: str) -> None:
    before, after, expected = FIRES[name]
    found = compared(before, after)
    assert [line for state, line, _ in found if state == "new"][:1] == expected, found


@pytest.mark.parametrize("name", QUIET)
def test_what_was_there_is_known(name: str) -> None:
    before, after = QUIET[name]
    assert new(before, after) == [], compared(before, after)


def test_the_known_and_the_new_names_are_told_apart() -> None:
    before = FOUR + OTHER.format("no_e")
    found = compared(before, before + OTHER.format("no_f + no_g"))
    assert [(state, line) for state, line, _ in found] == [("unchanged", 2), ("new", 10)]
    assert found[1][2] == "Undefined variable 'no_f'; 1 more name is not defined in this file: 'no_g'"


def test_a_comment_silences_the_part_in_its_line_and_no_other() -> None:
    text = FOUR.replace("no_d\n", "no_d  # haros: ignore[undefined-variable] made by the generator\n")
    brought = OTHER.format("no_e")
    assert [line for state, line, _ in compared(text, text + brought) if state == "new"] == [6]
    silent = brought.replace("no_e", "no_e  # haros: ignore[undefined-variable] as above")
    assert [line for state, line, _ in compared(text, text + silent) if state == "new"] == []


def test_files_of_known_findings_hold_no_parts() -> None:
    assert [state for state, *_ in compared(FOUR, FOUR + OTHER.format("no_e"), is_revision=False)] == ["updated"]


@pytest.mark.parametrize(
    ("rule", "before", "after", "base", "head", "expected"),
    [
        ("pylint:undefined-variable", "Undefined variable 'a'", "Undefined variable 'b'", "a", "b", True),
        ("pylint:no-member", "Module 'm' has no 'a' member", "Module 'm' has no 'b' member", "a", "b", True),
        ("cppcheck:unusedVariable", "Unused variable: a", "Unused variable: b", "int a;", "int b; use(a);", True),
        ("cppcheck:unusedVariable", "Unused variable: a", "Unused variable: b", "int a; b", "int b;", True),
        ("pylint:no-member", "Module 'm' has no 'a' member", "Module 'm' has no 'a' member; maybe 'b'?", "a", "a", False),
        ("pylint:undefined-variable", "Undefined variable 'a'", "Undefined variable 'a'", "a", "a", False),
        ("pylint:undefined-variable", "no names", "no names", "a", "b", False),
        ("cppcheck:unusedVariable", "Unused variable: a", "Unused variable: b", "int a;", "int b;", False),
        ("cppcheck:unusedVariable", "Unused variable: a", "Unused variable: b", None, "int b; a", False),
        ("pylint:line-too-long", "Line 'a'", "Line 'b'", "a b", "a b", False),
    ],
)  # fmt: skip
def test_another_name_is_another_defect(
    rule: str, before: str, after: str, base: str | None, head: str, expected: bool
) -> None:
    assert is_other_defect(rule, before, after, base, lambda: head) is expected
