# SPDX-License-Identifier: Apache-2.0
"""Formulas and monitor say the same of random properties and runs, and a defect in either is seen (tests/bench/verify/agreement.py compares more)."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

import pytest
from verification.agreement import Case, Solved, disagreements, endless

from haros_ci.monitoring.monitor import Monitor

pytestmark = pytest.mark.skipif(find_spec("z3") is None, reason="needs the extra: pip install 'haros-ci[verify]'")


def test_formulas_say_what_the_monitor_says() -> None:
    found, seen = disagreements("pytest", 40, each=4, longest=6)
    assert found == []
    assert {"silence, True", "silence, False", "loop, True", "loop, False", "no loop"} <= seen.keys()


def _closed(self: Any, since: Any, time: Any) -> Any:
    return True if self.window is None else time - since <= self.window


def _anywhere(self: Any, first: int, last: int) -> Any:
    return self.run.time[0] >= 0


def _first_turn_alone(formula: Any, j: int, known: Any) -> Any:
    return iter([formula.run.time[0] >= 0])


@pytest.mark.parametrize(
    ("module", "owner", "name", "defect"),
    [
        ("patterns", "Formula", "near", _closed),
        ("scopes", "View", "between", _anywhere),
        ("patterns", "", "_in_later_turns", _first_turn_alone),
    ],
)
def test_a_defect_of_the_formulas_is_seen(
    monkeypatch: pytest.MonkeyPatch, module: str, owner: str, name: str, defect: Any
) -> None:
    found = import_module(f"haros_ci.verification.{module}")
    monkeypatch.setattr(getattr(found, owner) if owner else found, name, defect)
    around = Case("globally: /b requires /a within 5 ms", (("/a", 0, 0), ("/b", 0, 1)), 1, 10)
    is_seen = Solved(around.text, 2, is_looped=True).violates(around) is not endless(around)
    assert is_seen or disagreements("defects", 100, first=True)[0]


def test_a_defect_of_the_monitor_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        Monitor, "in_window", lambda self, since, time: self.window is None or time - since <= self.window
    )
    assert disagreements("defects", 100, first=True)[0]


@pytest.mark.parametrize(
    ("text", "trace", "loop", "expected"),
    [
        ("globally: /a causes /b within 5 ms", (("/a", 0, 0), ("/b", 0, 5)), None, True),
        ("globally: /a causes /b within 5 ms", (("/a", 0, 0), ("/b", 0, 4)), None, False),
        ("globally: /a causes /b", (("/a", 0, 0),), None, True),
        ("globally: some /b", (), None, True),
        ("globally: /a causes /b", (("/b", 0, 0), ("/a", 0, 1)), (0, 10), False),
        ("globally: /a causes /b within 5 ms", (("/b", 0, 0), ("/a", 0, 1)), (0, 10), True),
        ("globally: /b requires /a within 5 ms", (("/a", 0, 0), ("/b", 0, 1)), (1, 10), True),
        ("globally: /b requires /a", (("/a", 0, 0), ("/b", 0, 1)), (1, 10), False),
        ("globally: some /b", (("/a", 0, 0), ("/c", 0, 1)), (1, 10), True),
        ("after /a until /b: some /c", (("/a", 0, 0), ("/c", 0, 1), ("/b", 0, 2)), (0, 10), False),
        ("after /a as A: no /b {data = @A.data}", (("/a", 2, 0), ("/b", 1, 1), ("/b", 2, 2)), None, True),
        ("after /a: no /b", (("/a", 2, 0), ("/c", 1, 1)), (0, 10), None),
    ],
)  # fmt: skip
def test_runs_with_known_answers(text: str, trace: Any, loop: tuple[int, int] | None, expected: bool | None) -> None:
    begins, period = loop if loop is not None else (None, 0)
    case = Case(text, trace, begins, period)
    assert endless(case) is expected
    assert Solved(text, max(1, len(trace)), is_looped=loop is not None).violates(case) is expected
