# SPDX-License-Identifier: Apache-2.0
"""Recordings in lines of JSON."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from haros_ci.errors import UserError
from haros_ci.recordings import jsonl
from haros_ci.recordings.jsonl import MOST_FAULTS, JsonLines, NoMessage, OfService, message_of

SECOND = 1_000_000_000


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ('{"topic": "/a", "time": 1.5, "msg": {"data": 1}}', ("/a", 1_500_000_000, {"data": 1})),
        ('{"topic": "a", "time": 0, "msg": {}}', ("/a", 0, {})),
        (
            '{"topic": "/a", "time": 1764000000, "msg": {"x": [1, {"y": null}]}}',
            ("/a", 1764000000 * SECOND, {"x": [1, {"y": None}]}),
        ),
        ('{"topic": "/a", "time": 2, "data": 7, "order": 3}', ("/a", 2 * SECOND, {"data": 7, "order": 3})),
        ('{"data": 5, "topic": "chatter", "time": 1694.25}', ("/chatter", 1694_250_000_000, {"data": 5})),
        ('{"topic": "/a", "time": 1, "msg": {"data": NaN}}', None),
    ],
)
def test_messages(line: str, expected: Any) -> None:
    found = message_of(line.encode())
    assert found == expected if expected is not None else found[2]["data"] != found[2]["data"]


@pytest.mark.parametrize(
    "line",
    [
        "", "no", "[]", "3", "{}", '{"topic": "/a"}', '{"time": 1}', '{"topic": 3, "time": 1}', '{"topic": "/a", "time": "1"}', '{"topic": "/a", "time": true}',
        '{"topic": "/a", "time": -1}', '{"topic": "/a", "time": NaN}', '{"topic": "/a", "time": 1e300}', '{"topic": "", "time": 1}',
        '{"topic": "/a", "time": Infinity}', "[" * 100_000, '{"topic": "/a", "time": 1' + "0" * 5_000 + "}", "\udcff",
    ],
)  # fmt: skip
def test_lines_that_are_no_messages(line: str) -> None:
    with pytest.raises(NoMessage):
        message_of(line.encode("utf-8", "surrogateescape"))


def write(path: Path, *lines: str) -> Path:
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_the_rest_of_a_file_is_read(tmp_path: Path) -> None:
    rows = [
        json.dumps({"topic": topic, "time": time, "msg": {"data": time}})
        for topic, time in (("/a", 1), ("/b", 2), ("/a", 3))
    ]
    recording = JsonLines(write(tmp_path / "run.jsonl", rows[0], "none", "", rows[1], "{}", rows[2]))
    found = [
        (topic, message["data"], time, number)
        for topic, message, time, number in recording.messages(frozenset(("/a",)))
    ]
    assert found == [("/a", 1, SECOND, 1), ("/a", 3, 3 * SECOND, 3)]
    assert (recording.count, recording.first, recording.last, set(recording.topics)) == (
        3,
        SECOND,
        3 * SECOND,
        {"/a", "/b"},
    )
    assert recording.notes == [
        "line 2 is not a message: it is not JSON, or too long",
        "1 further lines are no messages",
    ]


def test_a_line_that_is_too_long(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jsonl, "LONGEST_LINE", 100)
    row = '{"topic": "/a", "time": 1}'
    recording = JsonLines(write(tmp_path / "run.jsonl", row, "[" + "1," * 500 + "1]", row))
    assert len(list(recording.messages(frozenset(("/a",))))) == 2 and len(recording.notes) == 1


@pytest.mark.parametrize("rest", ['"request": {"a": 2}', '"response": {"sum": 5}, "stamp": 3'])
def test_requests_and_responses_of_rosmonitoring(tmp_path: Path, rest: str) -> None:
    row = f'{{"service": "add", "time": 1, {rest}}}'
    with pytest.raises(OfService):
        message_of(row.encode())
    message = '{"topic": "orders", "time": 1, "service": "a", "request": 3, "order": 4}'
    recording = JsonLines(write(tmp_path / "run.jsonl", *[row] * (MOST_FAULTS + 2), message))
    (found,) = recording.messages(frozenset(("/orders",)))
    assert found == ("/orders", {"service": "a", "request": 3, "order": 4}, SECOND, 1)
    assert recording.notes == [
        f"{MOST_FAULTS + 2} lines are requests and responses of services, which are not looked at"
    ]


def test_another_kind_of_file(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="lines are no messages"):
        list(JsonLines(write(tmp_path / "x", *("no" for _ in range(1_100)))).messages(frozenset()))


@pytest.mark.parametrize("name", ["none", ".", "fifo"])
def test_what_is_no_file(tmp_path: Path, name: str) -> None:
    if name == "fifo":
        os.mkfifo(tmp_path / "fifo")
    with pytest.raises(UserError):
        list(JsonLines(tmp_path / name).messages(frozenset()))


def test_topics_have_a_bound(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jsonl, "MOST_CHANNELS", 2)
    path = tmp_path / "run.jsonl"
    topics = ["/a", "/b", "/c", "/" + "d" * 1_000, "/a"]
    path.write_text("".join(json.dumps({"topic": topic, "time": 1, "msg": {}}) + "\n" for topic in topics))
    recording = JsonLines(path)
    assert [number for *_, number in recording.messages(frozenset(topics))] == [1, 2, 3]
    assert set(recording.topics) == {"/a", "/b"}
    assert recording.notes == [
        "line 3 is not a message: it is on one more topic than 2",
        "1 further lines are no messages",
    ]
