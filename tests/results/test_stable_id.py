# SPDX-License-Identifier: Apache-2.0
"""Ids of findings: one each, the same after lines have moved, another for another finding."""

from __future__ import annotations

from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.results.fingerprint import fingerprint
from haros_ci.results.result import BaselineState, Result, Run, Suppression, Tool
from haros_ci.results.rule import Level
from haros_ci.results.stable_id import stable_ids

CODE = "int f()\n{\n  return p;\n  return p;\n}\n"


def finding(line: int, rule: str = "r", **more: object) -> Result:
    return replace(Result("t", rule, Level.NOTE, f"of line {line}", Location("a.cpp", line)), **more)  # type: ignore[arg-type]


def identified(text: str, *results: Result) -> list[Result]:
    [run] = fingerprint([Run(Tool("t"), results=results)], lambda path: text, lambda path: "cpp")
    return list(run.results)


def ids(results: list[Result]) -> list[str]:
    return [id for id, _ in stable_ids(results)]


def test_equal_findings_on_equal_lines_have_different_ids() -> None:
    found = ids(identified(CODE, finding(3), finding(4), finding(3), finding(4, "other")))
    assert len(set(found)) == 4 and {len(id) for id in found} == {16}


def test_ids_stay_when_lines_move_or_neighbours_change() -> None:
    moved = identified("// new\n\n" + CODE.replace("int", "long"), finding(5), finding(6))
    scopes = [r.identity.scope if r.identity else "" for r in moved]
    assert scopes == ["f", "f"]
    assert ids(moved) == ids(identified(CODE, finding(3), finding(4)))


@pytest.mark.parametrize(
    "other",
    [
        identified(CODE, finding(3, "s")),
        identified(CODE.replace("p", "q"), finding(3)),
        identified(CODE.replace("f", "g"), finding(3)),
        [replace(identified(CODE, finding(3))[0], location=Location("b.cpp", 3))],
        [replace(identified(CODE, finding(3))[0], tool="u")],
    ],
    ids=["rule", "line", "function", "file", "tool"],
)
def test_another_finding_has_another_id(other: list[Result]) -> None:
    assert ids(other) != ids(identified(CODE, finding(3)))


def test_a_finding_about_names_keeps_its_id_when_its_line_is_edited() -> None:
    names = {"subject": ("/odom", "/base")}
    assert ids(identified(CODE, finding(3, **names))) == ids(identified(CODE.replace("p;", "q;"), finding(3, **names)))
    assert ids(identified(CODE, finding(3, **names))) != ids(identified(CODE, finding(3, subject=("/scan",))))


def test_what_is_known_or_gone_does_not_change_the_ids_of_others() -> None:
    three, four = identified(CODE, finding(3), finding(4))
    plain = ids([three, four])
    gone = replace(three, state=BaselineState.ABSENT, location=Location("a.cpp", 1))
    known = replace(three, state=BaselineState.UNCHANGED, suppressions=(Suppression("inSource"),))
    assert ids([known, replace(four, state=BaselineState.NEW)]) == plain
    assert ids([gone, three, four])[1:] == plain


def test_the_order_given_does_not_matter() -> None:
    found = identified(CODE, finding(3), finding(4), finding(3, "s"))
    assert stable_ids(found) == stable_ids(found[::-1])


def test_findings_without_identity_have_ids_too() -> None:
    assert len(set(ids([finding(3), finding(3), finding(9)]))) == 3
