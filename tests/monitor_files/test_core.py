# SPDX-License-Identifier: Apache-2.0
"""The core of generated monitors says what the offline monitor says, and defects in it are seen (tests/bench/generated_monitors.py asks more)."""

from __future__ import annotations

import ast
from typing import Any

import pytest
from monitor_files.core_kit import core, disagreements, generated, offline, run

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.core import CORE, PROGRAM, core_text, definitions
from haros_ci.monitor_files.parts.suite import Clock as GeneratedClock
from haros_ci.monitoring.clock import SECOND, Clock
from haros_ci.monitoring.patterns import monitor_of


def text_of(*texts: str) -> str:
    return core_text([Described(monitor_of(parse_property(text)), text, text) for text in texts])[0]


@pytest.mark.parametrize("seed", range(4))
def test_core_and_offline_monitor_agree(seed: int) -> None:
    assert not list(disagreements(100, seed))


def test_both_clocks_take_a_step_back_of_a_second_for_one_that_was_set_back() -> None:
    for step in (1, SECOND - 1, SECOND, SECOND + 1):
        here, beside = Clock(), GeneratedClock()
        times = [5 * SECOND, 5 * SECOND - step, 5 * SECOND - step + 7, 7 * SECOND]
        assert [here.at(time, 1) for time in times] == [beside.at(time) for time in times]
        assert (here.noise, here.jumps) == (beside.noise, beside.jumps)


#: What is wrong, and the patterns of which that is asked.
DEFECTS = [
    ("time - since < self.window", "time - since <= self.window", ["some"]),
    ("        self.opened, self.known = None, {}\n", "", ["no"]),
    (
        "            if self.keeps_first:\n                return\n            self.forget(key)",
        "            return",
        ["forbids"],
    ),
    ("if BEHAVIOUR in roles and self.pool:\n            self.answer", "if 0:\n            self.answer", ["causes"]),
    ("self.done = not (self.is_reopened and self.is_closed)", "self.done = True", ["some"]),
    ("for record in reversed(list(self.pool)):", "for record in ():", ["requires"]),
    (
        "isinstance(compound, Interval) else bool(value in",
        "isinstance(compound, Interval) else bool(value not in",
        ["no"],
    ),
    ("tame(num(a) + num(b))", "num(a) - num(b)", ["no"]),
    ("self.faults += 1", "self.faults += 2", ["no"]),
    ("            found[key] = MISSING", "            found[key] = 0", ["causes"]),
]


@pytest.mark.parametrize(("right", "wrong", "patterns"), DEFECTS)
def test_a_defect_is_seen(right: str, wrong: str, patterns: list[str]) -> None:
    applied = []

    def made_of(*texts: str) -> dict[str, Any]:
        made = text_of(*texts)
        applied.append(right in made)
        return run(made.replace(right, wrong))

    assert next(disagreements(4_000, 7, made_of, patterns), None) is not None
    assert any(applied)


def test_properties_do_not_disturb_each_other() -> None:
    texts = [
        "globally: /a causes /b within 5 ms",
        "globally: no /b {data > 3}",
        "after /a until /b: some /c within 3 ms",
    ]
    messages = [("/a", {"data": 1}, 0), ("/c", {"data": 1}, 1), ("/b", {"data": 4}, 5), ("/a", {"data": 1}, 9)]
    assert generated(core(*texts), messages) == offline(texts, messages)


def test_the_same_properties_give_the_same_text() -> None:
    assert text_of("globally: no /a {x > 3}") == text_of("globally: no /a {x > 3}")


def test_a_core_has_what_it_needs_alone() -> None:
    made = run(text_of("globally: no /a"))
    assert "No" in made and not {"Causes", "Requires", "hpl_yaw", "multiply"} & made.keys()


def test_no_definition_has_the_name_of_another() -> None:
    names = [name for part in (*CORE, *PROGRAM) for name in definitions(part)]
    assert len(names) == len(set(names))


def test_python_3_8_reads_it() -> None:
    every = [
        "globally: no /a {yaw(q) > 1}",
        "globally: some /a",
        "globally: /a causes /b",
        "globally: /a forbids /b",
        "globally: /a requires /b",
    ]
    ast.parse(text_of(*every), feature_version=(3, 8))


@pytest.mark.parametrize(
    ("predicate", "written"),
    [
        ("x = 0", "get(m, 'x') == 0"),
        ("pose.position.x in [0 to 5]!", "0 <= get(m, 'pose', 'position', 'x') < 5"),
        ("x in [y to 5]", "is_in(get(m, 'x'), Interval(get(m, 'y'), 5))"),
        ("not pressed", "not get(m, 'pressed')"),
        ("x > -1.5 and not (y in {1, 2})", "(get(m, 'x') > (-1.5)) and (not is_in(get(m, 'y'), [1, 2]))"),
        ("a and b and c and d", "get(m, 'a') and get(m, 'b') and get(m, 'c') and get(m, 'd')"),
        ("a implies b", "not get(m, 'a') or get(m, 'b')"),
        ("forall i in xs: xs[@i].y < 3", "all((get(item(get(m, 'xs'), i1), 'y') < 3) for i1 in indices(get(m, 'xs')))"),
        ('name = "it\'s"', "get(m, 'name') == \"it's\""),
        ("x < INF", "get(m, 'x') < float('inf')"),
        ("x - 1 + y * 2 = 4", "add(subtract(get(m, 'x'), 1), multiply(get(m, 'y'), 2)) == 4"),
        ("yaw(q) > 0", "hpl_yaw(get(m, 'q')) > 0"),
    ],
)
def test_what_is_written(predicate: str, written: str) -> None:
    assert f"lambda m, known: {written}" in text_of(f"globally: no /a {{{predicate}}}")


def test_a_long_row_of_conditions_is_written_and_a_deep_one_is_left_out() -> None:
    row = " or ".join(f"x = {at}" for at in range(110))
    assert generated(core(f"globally: no /a {{{row}}}"), [("/a", {"x": 109}, 0)])[0][0] == "violated"
    deep = "x" + " + 1" * 60
    property = monitor_of(parse_property(f"globally: no /a {{{deep} > 0}}"))
    made, left_out = core_text(
        [Described(property, "deep", "deep"), Described(monitor_of(parse_property("globally: no /b")), "b", "b")]
    )
    assert left_out == ("deep is left out: more than 30 operators stand within each other in a predicate",)
    assert len(run(made)["PROPERTIES"]) == 1
