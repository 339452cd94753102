# SPDX-License-Identifier: Apache-2.0
"""Planted answers: what is stored for a file may have any shape, and lie."""

from __future__ import annotations

import json

import pytest
from cache_kit import EVIL
from hostile_kit import CHEAP_FINDING, Outcome, Trap, assert_harmless


def row(**changes: object) -> list[object]:
    """A finding as it is stored, which no run may show unless *changes* leave it sound."""
    fields: dict[str, object] = {"level": "error", "message": "planted", "path": CHEAP_FINDING[0], "line": 1}
    fields |= {"column": 1, "end_line": None, "end_column": None, "scope": "", "value": None, "limit": None}
    fields |= {"subject": [], "related": []}
    return list({**fields, **changes}.values())


def answer(*rows: object, tool: object = "cppcheck", rule: object = "nullPointer", gave_up: object = ()) -> object:
    return {"rules": [[tool, rule, list(rows)]], "gave_up": gave_up}


def any_of(*values: object) -> tuple[object, ...]:
    """Values of several types."""
    return values


#: Any JSON but what the field asks for.
WRONG: tuple[object, ...] = (
    *any_of(0, 1e300, -1, True, "x", "", [], {}, [[]], [None]),
    *any_of({"rules": []}, {"gave_up": []}, {"rules": None, "gave_up": None}),
    *(
        {"rules": rules, "gave_up": []}
        for rules in any_of(1, "abc", {"abc": 1}, [1], [[]], [[1, 2, 3]], [["a", "b"]], [[[[[]]]]])
    ),
    *(
        {"rules": [], "gave_up": gave_up}
        for gave_up in any_of(1, "abc", [1], [[]], [["a"]], [[1, 1]], [["a", "b"]], [["a", -1]])
    ),
    *(answer(row(), tool=value) for value in any_of(None, 1, [], {}, True)),
    *(answer(row(), rule=value) for value in any_of(None, 1, [], {}, True)),
    *(answer(row(level=value)) for value in any_of(None, 1, "", "none", "fatal", [], {}, ["error"])),
    *(answer(row(message=value)) for value in any_of(None, 1, [], {}, ["planted"], {"text": "planted"})),
    *(answer(row(path=value)) for value in any_of([], {}, [CHEAP_FINDING[0]])),
    *(answer(row(line=value)) for value in any_of(0, -1, True, 1.0, 1.5, "1", [], {})),
    *(answer(row(column=value)) for value in any_of(0, -1, False, 1e300, "1", [1])),
    *(answer(row(end_line=value)) for value in any_of(0, -(2**70), "1")),
    *(answer(row(end_column=value)) for value in any_of(0, True, {})),
    *(answer(row(scope=value)) for value in any_of(None, 1, [], {"f": 1})),
    *(answer(row(value=value)) for value in any_of(True, "1", [], {})),
    *(answer(row(limit=value)) for value in any_of(False, "1", [1])),
    *(answer(row(subject=value)) for value in any_of(None, 1, [1], [[]], [None])),
    *(answer(row(related=value)) for value in any_of(None, 1, [1], [[]], [["control.cpp"]], [["control.cpp", "1"]])),
    *(answer(found) for found in any_of(None, 1, [], {}, row()[:5], [*row(), 1], [[row()]])),
    answer(row(), row(line=-1)),
    answer([*row()[:7], "", None, None, [], [["control.cpp", 1, None, None, None, 7]]]),
)


def planted(trap: Trap, answers: dict[str, object]) -> None:
    """The cache says *answers* of the files named."""
    for shard in trap.cache.glob("cppcheck-*"):
        document = json.loads(shard.read_bytes())
        for key, entry in document["entries"].items():
            entry[1] = answers.get(key.partition(" ")[2], entry[1])
        shard.write_text(json.dumps(document))


def test_answers_of_a_wrong_shape(trap: Trap) -> None:
    """Each wrong answer stands for a file of its own: none is shown, and every file is analysed again."""
    trap.use_cheap_control()
    trap.cache = trap.place / "cache"
    wrong = {f"wrong{number}.cpp": value for number, value in enumerate(WRONG)}
    for name in wrong:
        trap.write(name, "int f(int x) { int *unset = 0; return *unset + x; }\n")
    before = trap.run()
    assert {(path, 1, "nullPointer") for path in wrong} < before.findings()
    planted(trap, wrong)
    outcome = trap.run()
    assert outcome.formats == before.formats and outcome.code == 1
    assert_harmless(trap, outcome)


NEARLY = {
    "a value that is no float": answer(row(value=10**400)),
    "a limit that is no float": answer(row(limit=-(10**400))),
    "a row that is a text": answer("planted"),
    "a subject that is a text": answer(row(subject="planted")),
    "related places that are a text": answer(row(related="planted")),
}


@pytest.mark.parametrize("value", NEARLY.values(), ids=NEARLY)
def test_answers_of_nearly_the_right_shape(value: object, trap: Trap, uncached: Outcome) -> None:
    trap.use_cheap_control()
    trap.use_filled_cache()
    planted(trap, {CHEAP_FINDING[0]: value})
    outcome = trap.run()
    assert outcome.formats == uncached.formats, outcome.stderr
    assert_harmless(trap, outcome)


def test_lies(trap: Trap) -> None:
    """What has the right shape is believed of the files that it is stored for, is harmless, and speaks of no others."""
    trap.use_cheap_control()
    trap.use_filled_cache()
    outside = [
        row(path=path) for path in ("../outside/secret.py", "/etc/passwd", "gone.cpp", EVIL, "", "./control.cpp")
    ]
    rules = [
        [
            "cppcheck",
            "uninitvar",
            [*outside, row(message=EVIL), row(scope=EVIL, subject=[EVIL], value=1e308, limit=-1e308)],
        ],
        ["cppcheck", EVIL, [row()]],
        ["cppcheck", "", [row(message="")]],
        ["cppcheck", "nullPointer", [row(line=10**6), row(column=10**10), row(column=9, end_line=1, end_column=2)]],
        ["cppcheck", "zerodiv", [row(line=None), row(related=[["/etc/passwd", 1, 1, 1, 1, "x"], [*row()[2:7], EVIL]])]],
        [EVIL, "x", [row()]],
    ]
    planted(trap, {CHEAP_FINDING[0]: {"rules": rules, "gave_up": [[EVIL, 1], ["", None], ["beyond", 10**9]]}})
    outcome = trap.run("--profile=all")
    assert outcome.code == 1 and outcome.stderr == ""
    assert {path for path, _, _ in outcome.findings()} == {CHEAP_FINDING[0]}
    assert {rule for _, _, rule in outcome.findings()} >= {"uninitvar", "nullPointer", "zerodiv"}
    assert "/etc/passwd" not in "".join(outcome.formats.values())
    assert_harmless(trap, outcome)
