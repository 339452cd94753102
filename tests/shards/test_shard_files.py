# SPDX-License-Identifier: Apache-2.0
"""Shard files: what is written is read; what is cut short, hostile or foreign is refused with a clear message."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from shard_values import HEADER, KEYS, SHARD

from haros_ci.linters.linter import GaveUp
from haros_ci.linters.rows import Answer, decode, encode
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level
from haros_ci.shards import costs, shard_file
from haros_ci.shards.shard import RecordedAnswer, Shard, ShardError

TEXT = shard_file.written(SHARD)
LINES = TEXT.splitlines()


def lines(*changed: tuple[int, str]) -> bytes:
    """The file with some of its lines changed."""
    made = list(LINES)
    for number, line in changed:
        made[number] = line
    return ("\n".join(made) + "\n").encode()


def header(**members: Any) -> bytes:
    found = json.loads(LINES[0]) | members
    return lines((0, json.dumps({k: v for k, v in found.items() if v is not ...}, separators=(",", ":"))))


def refused(data: bytes) -> str:
    with pytest.raises(ShardError) as caught:
        shard_file.parsed(data, "one.jsonl")
    assert "one.jsonl" in caught.value.message
    return caught.value.message


def test_what_is_written_is_read() -> None:
    assert shard_file.parsed(TEXT.encode(), "one") == replace(SHARD, name="one")
    assert TEXT.isascii()


def test_a_shard_that_has_nothing_to_do_is_read() -> None:
    empty = Shard(HEADER)
    assert shard_file.parsed(shard_file.written(empty).encode(), "") == empty


def test_the_order_in_which_answers_came_does_not_count() -> None:
    assert shard_file.written(replace(SHARD, answers=SHARD.answers[::-1])) == TEXT


def test_an_answer_comes_back_as_the_cache_has_it() -> None:
    result = Result("pylint", "x", Level.NOTE, 'a "b", [c]}\n\u2028', Location("a.py", 2, 3))
    value = json.dumps(encode(Answer((result,), (GaveUp("a.py", "no", 1),))), separators=(",", ":"))
    [said] = shard_file.parsed(
        shard_file.written(Shard(HEADER, (RecordedAnswer("pylint", "a.py", KEYS[0], None, value),))).encode(), ""
    ).answers
    answer = decode(shard_file.value_of(said), "a.py", lambda *_: True, {"a.py"})
    assert answer is not None
    assert answer.results == (result,)


# -- cut short ----------------------------------------------------------------------------------------------------


def test_a_file_cut_anywhere_is_refused() -> None:
    data = TEXT.encode()
    for end in range(0, len(data), 7):
        assert refused(data[:end])
    assert "cut short" in refused(data[:-1])


def test_a_file_without_one_of_its_lines_is_refused() -> None:
    for number in range(1, len(LINES)):
        assert "cut short" in refused(("\n".join(LINES[:number] + LINES[number + 1 :]) + "\n").encode())


# -- something else -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "data",
    [b"", b"\n", b"{}", b"[]\n{}\n", b"\x00" * 100, "é".encode() * 9, b'{"version": "2.1.0", "runs": []}', b'{"haros-ci-costs":1}'],
    ids=repr,
)  # fmt: skip
def test_what_is_no_shard_file_is_said_to_be_none(data: bytes) -> None:
    assert "not a shard file" in refused(data)


def test_another_format_is_told_from_nonsense() -> None:
    assert "format 2, and this haros-ci reads format 1" in refused(
        b'{"haros-ci-shard":2,"everything":"else"}\n{"lines":2}\n'
    )
    assert "format ?" in refused(b'{"haros-ci-shard":"x"}\n{"lines":2}\n')


def test_a_line_may_be_reported_by_its_number() -> None:
    assert refused(lines((1, '["answer"]'))).startswith("one.jsonl:2:")


# -- hostile ------------------------------------------------------------------------------------------------------

ANSWER = f'["answer","cppcheck",%s,"{KEYS[0]}",1,{{}}]'


@pytest.mark.parametrize(
    "line",
    [
        "null",
        "[]",
        "{}",
        '["answer"]',
        '["else",{}]',
        '["failure",null]',
        '["failure",{"tool":"t","message":"m","paths":"abc","keys":[]}]',
        '["failure",{"tool":"t","message":"m","paths":["../x"],"keys":[]}]',
        '["failure",{"tool":"t","message":"m","paths":[],"keys":["short"]}]',
        '["whole",{"name":"architecture","side":"middle","cost":1,"run":{"tool":{"name":"haros-ci"}}}]',
        '["whole",{"name":"architecture","side":"head","cost":-1,"run":{"tool":{"name":"haros-ci"}}}]',
        '["whole",{"name":"architecture","side":"head","cost":1,"run":{"tool":{"name":"haros-ci"},"results":[{"tool":"pylint",'
        '"rule":"r","level":"note","message":"m","location":{"path":"a"}}]}}]',
        ANSWER % '"/etc/passwd"',
        ANSWER % '"a/../../b"',
        ANSWER % '"\\u0000"',
        ANSWER % "1",
        '["answer","cppcheck","a.cpp","0123",1,{}]',
        f'["answer","cppcheck","a.cpp","{KEYS[0]}",-1,{{}}]',
        f'["answer","cppcheck","a.cpp","{KEYS[0]}",1e999,{{}}]',
        "[" * 100_000,
        '["failure",' + "[" * 90_000 + "]" * 90_000 + "]",
        '["failure",' + "9" * 100_000 + "]",
        '["failure",NaN]',
        '["failure",' + "[]," * 3_000_000 + "0]",
    ],
    ids=lambda line: line[:30] + line[-20:],
)
def test_hostile_lines_are_refused(line: str) -> None:
    assert refused(lines((1, line)))


@pytest.mark.parametrize(
    "value",
    ["[" * 100_000, "9" * 100_000, "NaN", '{"rules":' * 50_000, "x", '{"rules":[]}],["answer"'],
    ids=lambda v: v[:20],
)
def test_a_hostile_answer_is_none(value: str) -> None:
    assert shard_file.value_of(RecordedAnswer("cppcheck", "a.cpp", KEYS[0], 1, value)) is None


@pytest.mark.parametrize(
    "members",
    [
        {"confined": "very well"},
        {"confined": ...},
        {"number": 0},
        {"number": 3},
        {"number": "1"},
        {"number": True},
        {"of": 10**400},
        {"of": ...},
        {"settings": []},
        {"settings": {"a": 1}},
        {"settings": ...},
        {"tools": {}},
        {"tools": [1]},
        {"tools": [{"tool": "t", "side": "middle", "version": "1", "fingerprint": ""}]},
        {"tools": [{"tool": "t", "side": "head", "version": 1, "fingerprint": ""}]},
        {"workspace": None},
        {"base": 5},
        {"more": 1},
    ],
    ids=str,
)
def test_hostile_headers_are_refused(members: dict[str, Any]) -> None:
    assert refused(header(**members)).startswith("one.jsonl:1:")


@pytest.mark.parametrize("name", [r'"\p"', r'"\u12"', r'"\uZZZZ"'])
@pytest.mark.parametrize("place", [0, 1])
def test_an_answer_with_a_name_that_is_no_json_is_refused(name: str, place: int) -> None:
    names = ['"t"', '"a.cpp"']
    names[place] = name
    said = refused(lines((1, f'["answer",{",".join(names)},"{KEYS[0]}",0,{{}}]')))
    assert said.startswith("one.jsonl:2: a name that is not JSON text")


def test_too_many_bytes_are_not_parsed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shard_file, "MAX_BYTES", len(TEXT) - 1)
    assert "larger than" in refused(TEXT.encode())


# -- costs --------------------------------------------------------------------------------------------------------


def test_costs_are_read_as_they_were_written() -> None:
    some = {"cppcheck": {"a.cpp": 5, "é.cpp": 7}, "": {"architecture": 9}}
    assert costs.parsed(costs.written(some).encode()) == some


def test_costs_of_another_format_are_as_good_as_none() -> None:
    assert costs.parsed(b'{"haros-ci-costs":2,"costs":[]}') == {}


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"[]",
        b"{}",
        b"\xff",
        b"[" * 100_000,
        b'{"haros-ci-costs":1}',
        b'{"haros-ci-costs":1,"costs":{"t":[1]}}',
        b'{"haros-ci-costs":1,"costs":{"t":{"a":-1}}}',
        b'{"haros-ci-costs":1,"costs":{"t":{"a":1.5}}}',
        b'{"haros-ci-costs":1,"costs":{"t":{"a":true}}}',
        b'{"haros-ci-costs":1,"costs":{"t":{"a":1' + b"0" * 30 + b"}}}",
    ],
    ids=lambda data: repr(data[:40]),
)
def test_what_is_no_file_of_costs_is_refused(data: bytes) -> None:
    with pytest.raises(costs.NoCosts):
        costs.parsed(data)
