# SPDX-License-Identifier: Apache-2.0
"""Values as JSON and back; what is not of its type is refused."""

from __future__ import annotations

import json
from typing import Any

import pytest

from haros_ci.model.changes import Change, Changes, Edge
from haros_ci.model.location import Location
from haros_ci.results.fix import Edit, Fix
from haros_ci.results.result import (
    BaselineState,
    Graph,
    Identity,
    Notification,
    Related,
    Result,
    Run,
    Suppression,
    Tool,
    Vertex,
)
from haros_ci.results.rule import Level
from haros_ci.results.values import NotThat, plain, read

PLACE = Location("src/a.cpp", 3, 5, 3, 9)
FULL = Run(
    Tool("haros-ci", "1", "https://example.org", "haros-ci 1"),
    results=(
        Result(
            "haros-ci",
            "topic-type-mismatch",
            Level.ERROR,
            "say «x» \u2028 \udc80",
            PLACE,
            related=(Related(Location("launch/x.launch"), "here"),),
            scope="A::b",
            value=1.5,
            limit=1,
            subject=("/a", "/b"),
            roles=("talker",),
            flow=(Related(PLACE, "first"),),
            graph="main",
            edges=(("node:/a", "topic:/b"),),
            also=("pylint:x",),
            identity=Identity(text="0123", occurrence=2),
            state=BaselineState.NEW,
            reason="why",
            suppressions=(Suppression("inSource", "because", PLACE),),
            fixes=(Fix("do it", (Edit("src/a.cpp", (1, 1), (2, 3), "x"), Edit.executable("b.py"))),),
        ),
        Result("haros-ci", "x", Level.NOTE, "least", Location("package.xml")),
    ),
    notifications=(Notification(Level.WARNING, "hm", "architecture", None, 3, True),),
    successful=False,
    graphs=(Graph("main", (Vertex("node:/a", "/a", "node", PLACE),), (("node:/a", "topic:/b"),)),),
    architecture=True,
    changes=Changes(
        changes=(Change(what="node", action="added", names=("/a",), head=PLACE),),
        edges=(Edge(node="/a", channel="/b", kind="topic", is_giver=True),),
        not_known=2,
    ),
)  # fmt: skip


@pytest.mark.parametrize("run", [FULL, Run(Tool("t")), Run(Tool("t"), analysed=frozenset({"b", "a"}))])
def test_what_is_written_is_read(run: Run) -> None:
    text = json.dumps(plain(run))
    assert read(Run, json.loads(text)) == run


def test_what_is_as_by_default_is_not_written() -> None:
    assert plain(Location("a", 1)) == {"path": "a", "line": 1}


LOCATION = {"path": "a.cpp"}
RESULT = {"tool": "t", "rule": "r", "level": "note", "message": "m", "location": LOCATION}


@pytest.mark.parametrize(
    "value",
    [
        None,
        [],
        "x",
        {},
        {**RESULT, "other": 1},
        {**RESULT, "tool": None},
        {**RESULT, "tool": 1},
        {**RESULT, "level": "worst"},
        {**RESULT, "level": ["note"]},
        {**RESULT, "location": "a.cpp"},
        {**RESULT, "location": {"path": None}},
        {**RESULT, "location": {"path": "/etc/passwd"}},
        {**RESULT, "location": {"path": "../a.cpp"}},
        {**RESULT, "location": {"path": "a/../../b"}},
        {**RESULT, "location": {"path": "\\\\host\\x"}},
        {**RESULT, "location": {"path": "a\0b"}},
        {**RESULT, "location": {**LOCATION, "line": "1"}},
        {**RESULT, "location": {**LOCATION, "line": 1.0}},
        {**RESULT, "location": {**LOCATION, "line": True}},
        {**RESULT, "location": {**LOCATION, "line": 10**300}},
        {**RESULT, "value": float("inf")},
        {**RESULT, "value": float("nan")},
        {**RESULT, "value": 10**400},
        {**RESULT, "value": True},
        {**RESULT, "subject": "abc"},
        {**RESULT, "subject": [1]},
        {**RESULT, "edges": [["a"]]},
        {**RESULT, "edges": [["a", "b", "c"]]},
        {**RESULT, "fixes": [{"description": "d", "edits": [{"path": "../x"}]}]},
        {**RESULT, "related": [{"location": LOCATION}]},
    ],
    ids=lambda value: str(value)[-40:],
)
def test_what_is_not_of_its_type_is_refused(value: Any) -> None:
    with pytest.raises(NotThat):
        read(Result, value)
