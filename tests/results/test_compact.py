# SPDX-License-Identifier: Apache-2.0
"""The compact baseline file, and keeping it up to date."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from haros_ci.model.location import Location
from haros_ci.results.compact import BaselineFormatError, read_compact, write_compact
from haros_ci.results.known import ComparedFiles, KnownFinding, known_from_results
from haros_ci.results.result import BaselineState, Identity, Result, Suppression
from haros_ci.results.rule import Level
from haros_ci.results.upkeep import prune, update

VERSION = '{"haros-ci-baseline": 1}\n'
ENTRY = '{"path": "a.cpp", "tool": "t", "rule": "r", "text": "0123456789abcdef"}\n'


def known(**changes: object) -> KnownFinding:
    base = KnownFinding(tool="t", rule="r", path="a.cpp", scope="f", text="0" * 16, template="Bad '_'")
    return replace(base, **changes)  # type: ignore[arg-type]


def test_round_trip_and_bytes() -> None:
    entries = (known(path="b.cpp", reason="vendored"), known(occurrence=2), known(), known(path="ä/\udc80.cpp"))
    text = write_compact(entries)
    assert text == write_compact(entries[::-1]) == write_compact((*entries, entries[0]))
    assert text.startswith(VERSION) and text.endswith("}\n") and text.isascii()
    assert set(read_compact(text.encode(), "b")) == set(entries)
    assert write_compact(read_compact(text.encode(), "b")) == text
    assert write_compact(()) == VERSION


def test_nothing_that_moves_is_written() -> None:
    one = known(line=12, value=31.0, level=Level.ERROR, message="Bad 'x'")
    assert write_compact([one]) == write_compact([known()])
    assert set(json.loads(write_compact([one]).split("\n")[1])) == {"path", "tool", "rule", "scope", "message", "text"}


def test_adding_one_finding_adds_one_line() -> None:
    some = [known(path=f"{n}.cpp") for n in range(9)]
    before, after = write_compact(some).split("\n"), write_compact([*some, known(path="4a.cpp")]).split("\n")
    assert len(after) == len(before) + 1
    assert [line for line in after if line in before] == before


GOOD = [
    VERSION,
    VERSION + ENTRY,
    VERSION.replace("\n", "\r\n") + ENTRY.replace("\n", "\r\n"),
    "\n" + VERSION + "\n\n" + ENTRY + "\n",
    VERSION + ENTRY.strip(),
    VERSION + ENTRY + ENTRY,
    VERSION + '{"rule": "r", "tool": "t", "path": "a", "occurrence": 3, "reason": "why"}',
]
BAD = [
    (b"", 1, "empty"),
    (b"\n\n", 1, "empty"),
    (ENTRY, 1, "first line"),
    ('{"haros-ci-baseline": 2}\n' + ENTRY, 1, "format version 2"),
    ('{"haros-ci-baseline": true}\n', 1, "format version True"),
    ('{"haros-ci-baseline": 1, "x": 1}\n', 1, "version"),
    ("[]\n", 1, "JSON object"),
    (VERSION + "{\n", 2, "JSON object"),
    (VERSION + ENTRY + "[1]\n", 3, "JSON object"),
    (VERSION + "[" * 100_000, 2, "JSON object"),
    (VERSION + '{"a": ' + "9" * 5000 + "}", 2, ""),
    (VERSION + "<<<<<<< HEAD\n" + ENTRY, 2, "merge conflict"),
    (VERSION + ENTRY + "=======\n", 3, "merge conflict"),
    (VERSION + ENTRY + ENTRY + ">>>>>>> other\n", 4, "merge conflict"),
    ("<<<<<<< HEAD\n" + VERSION, 1, "merge conflict"),
    (VERSION + '{"path": "a", "tool": "t"}', 2, "'rule' is missing"),
    (VERSION + '{"path": "", "tool": "t", "rule": "r"}', 2, "'path' is missing"),
    (VERSION + ENTRY.replace("a.cpp", "/etc/passwd"), 2, "'path'"),
    (VERSION + ENTRY.replace("a.cpp", "a/../../b"), 2, "'path'"),
    (VERSION + ENTRY.replace('"t"', "1"), 2, "'tool'"),
    (VERSION + ENTRY.replace('"t"', "null"), 2, "'tool'"),
    (VERSION + ENTRY.replace('"t"', '"' + "t" * 5000 + '"'), 2, "'tool'"),
    (VERSION + ENTRY.replace("abcdef", "ABCDEF"), 2, "'text'"),
    (VERSION + ENTRY.replace("}", ', "line": 3}'), 2, "unknown key 'line'"),
    (VERSION + ENTRY.replace("}", ', "occurrence": 0}'), 2, "'occurrence'"),
    (VERSION + ENTRY.replace("}", ', "occurrence": true}'), 2, "'occurrence'"),
    (VERSION + ENTRY.replace("}", ', "occurrence": 1.5}'), 2, "'occurrence'"),
    (VERSION.encode() + b'{"path": "\xff"}', 2, "UTF-8"),
    (b"\xff\xfe" + VERSION.encode("utf-16-le"), 1, "UTF-8"),
    (b" " * 64_000_001, 1, "larger"),
    (b"\n" * 250_001, 250_000, "more than"),
]


@pytest.mark.parametrize("text", GOOD)
def test_good_files(text: str) -> None:
    assert len(read_compact(text.encode(), "b")) == ("tool" in text)


@pytest.mark.parametrize(("data", "line", "message"), BAD, ids=range(len(BAD)))
def test_bad_files_name_the_line(data: str | bytes, line: int, message: str) -> None:
    with pytest.raises(BaselineFormatError) as caught:
        read_compact(data if isinstance(data, bytes) else data.encode(), "b")
    assert (caught.value.line, message in caught.value.message) == (line, True)
    assert str(caught.value).startswith(f"line {line}: ")


def result(path: str, text: str, **changes: object) -> Result:
    identity = Identity(scope="f", text=text * 16, template="Bad", before="b" * 16)
    base = Result("t", "r", Level.NOTE, "Bad.", Location(path, 3), identity=identity)
    return replace(base, **changes)  # type: ignore[arg-type]


SIDES = ComparedFiles(head=lambda path: "", language=lambda path: "", exists=lambda path: path != "gone.cpp")
OLD = [result("a.cpp", "1"), result("b.cpp", "2"), result("gone.cpp", "3")]


def test_update() -> None:
    old = tuple(replace(k, reason=f"because of {k.path}") for k in known_from_results(OLD))
    moved = result("a.cpp", "1", identity=replace(OLD[0].identity or Identity(), before="c" * 16))
    new = [moved, result("c.cpp", "4")]
    after = update(old, new, SIDES)
    assert [(k.path, k.before, k.reason) for k in after] == [("a.cpp", "c" * 16, "because of a.cpp")]
    after = update(old, new, SIDES, accept_new=True)
    assert [(k.path, k.reason) for k in after] == [("a.cpp", "because of a.cpp"), ("c.cpp", "")]
    silent = replace(moved, suppressions=(Suppression("inSource"),))
    assert update(old, [silent], SIDES, accept_new=True) == ()


def test_prune_changes_nothing_else() -> None:
    old = known_from_results(OLD)
    moved = result("a.cpp", "1", identity=replace(OLD[0].identity or Identity(), before="c" * 16))
    assert prune(old, [moved, result("c.cpp", "4")], SIDES) == old[:1]
    assert prune(old, OLD, SIDES) == old


def test_partial_runs_drop_nothing_they_did_not_look_at() -> None:
    old = known_from_results(OLD)
    partial = replace(SIDES, analysed=lambda tool, path: path == "b.cpp", partial=True)
    assert [k.path for k in prune(old, [], partial)] == ["a.cpp", "gone.cpp"]
    assert [k.path for k in update(old, [], partial, accept_new=True)] == ["a.cpp", "gone.cpp"]
    failed = replace(SIDES, analysed=lambda tool, path: False)
    assert [k.path for k in update(old, [], failed)] == ["a.cpp", "b.cpp"]


def test_what_is_gone_is_not_remembered() -> None:
    assert known_from_results([replace(OLD[0], state=BaselineState.ABSENT)]) == ()
