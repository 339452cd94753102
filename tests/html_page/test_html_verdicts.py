# SPDX-License-Identifier: Apache-2.0
"""Verdicts of ``haros-ci monitor`` in the page: what is taken of a file, and what is refused."""

from __future__ import annotations

import json
from typing import Any

import pytest
from page_kit import checked, given, verdicts

from haros_ci.errors import UserError
from haros_ci.html_page.pool import Pool
from haros_ci.html_page.verdicts import MOST, MOST_MESSAGES, recorded
from haros_ci.html_page.verdicts import verdicts as rows
from haros_ci.report.monitor_text import Held, Judged, Moment, as_json


def held(*moments: Moment, verdict: str = "violated") -> Held:
    one = Judged("id", "globally: no /a", "workspace", "", False, None, verdict, "why", 2.0, moments, (1, 2, 3))
    return Held("run.mcap", "", "log", 7, 1.0, 3.0, {"/a": 7}, (one,), ())


def test_what_monitor_writes_is_read() -> None:
    moment = Moment("behaviour", "/a", 5, 2.0, {"data": 1, "far": float("inf")})
    (found,) = rows(Pool(), (recorded(as_json(held(moment)), "x"),))
    assert (found["messages"], found["begin"], found["end"], found["more"]) == (7, 1.0, 3.0, 0)
    (one,) = found["properties"]
    assert (one[0], one[7], one[8]) == (0, 2.0, (1, 2, 3))
    assert len(one[9]) == 1 and one[9][0][2:4] == (5, 2.0) and len(one[9][0][4]) == 2


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "{}",
        '{"recording": {}, "properties": {}}',
        '{"recording": [], "properties": []}',
        '{"recording": {}, "properties": [1]}',
        '{"recording": {}, "properties": [{"verdict": "fine", "text": "", "witnesses": []}]}',
        '{"recording": {}, "properties": [{"verdict": ["held"], "text": "", "witnesses": []}]}',
        '{"recording": {}, "properties": [{"verdict": "held", "text": 1, "witnesses": []}]}',
        '{"recording": {"begin": NaN}, "properties": []}',
        "[" * 100_000,
        "1" * 10_000,
    ],
)
def test_what_is_none_is_refused(text: str) -> None:
    with pytest.raises(UserError, match="has no verdicts"):
        recorded(text, "x.json")


@pytest.mark.parametrize(
    "change",
    [
        {"time": "later"},
        {"time": True},
        {"time": 1e300},
        {"node": 3},
        {"path": {}},
        {"scopes": -1},
        {"scopes": 1 << 60},
        {"witnesses": [1, {"role": "spy", "topic": "/a"}, {"role": "trigger"}]},
        {"witnesses": [{"role": "trigger", "topic": "/a", "values": [], "publishers": [1, {"node": 2}]}]},
        {"witnesses": [{"role": "trigger", "topic": "/a", "values": {"x": [[[]]]}, "time": None}]},
    ],
)
def test_what_is_odd_in_it_is_left_out(change: dict[str, Any]) -> None:
    document = {"recording": {"name": 1, "messages": -1}, "properties": [{"verdict": "held", "text": "t", "witnesses": [], **change}]}  # fmt: skip
    (found,) = rows(Pool(), (recorded(json.dumps(document), "x"),))
    assert found["messages"] == 0 and found["name"] == -1 and len(found["properties"]) == 1


def test_what_is_much_is_cut() -> None:
    witness = {"role": "trigger", "topic": "/a"}
    one = {"verdict": "held", "text": "t", "witnesses": [witness] * (MOST_MESSAGES + 5)}
    text = json.dumps({"recording": {}, "properties": [one] * (MOST + 3)})
    (found,) = rows(Pool(), (recorded(text, "x"),))
    assert (len(found["properties"]), found["more"], len(found["properties"][0][9])) == (MOST, 3, MOST_MESSAGES)


@pytest.mark.parametrize("word", ["", "</script><script>", "\x00\u202e", "x" * 5000])
def test_the_document_has_the_form_of_the_schema(word: str) -> None:
    data = checked(given(word))
    assert [len(one["properties"]) for one in data["verdicts"]] == [2]
    assert verdicts(word) == verdicts(word)
