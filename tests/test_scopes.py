# SPDX-License-Identifier: Apache-2.0
"""The tests of a module are one scope for processes of pytest-xdist, whatever their cases are called; slow ones come first."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
import scopes
from tiers import TESTS
from xdist.remote import Producer

SLOW, FAST, OTHER = "tests/link/test_values.py", "tests/test_tiers.py", "tests/config/test_selection.py"


@pytest.mark.parametrize(
    ("nodeid", "scope"),
    [
        ("tests/test_a.py::test_b", "tests/test_a.py"),
        ("tests/test_a.py::test_b[1-2]", "tests/test_a.py"),
        ("tests/test_a.py::test_b[tf2_ros::Buffer]", "tests/test_a.py"),
        ("tests/test_a.py::test_b[a[0]-x::y::z]", "tests/test_a.py"),
        ("tests/test_a.py::TestB::test_c", "tests/test_a.py::TestB"),
        ("tests/test_a.py::TestB::test_c[::]", "tests/test_a.py::TestB"),
    ],
)
def test_scope(nodeid: str, scope: str) -> None:
    assert scopes.scope_of(nodeid) == scope


class Worker:
    """A process that is told which tests to run."""

    shutting_down = False

    def __init__(self) -> None:
        self.gateway = SimpleNamespace(id="gw")
        self.told: list[int] = []

    def send_runtest_some(self, numbers: list[int]) -> None:
        self.told += numbers

    def shutdown(self) -> None:
        self.shutting_down = True


def given(nodeids: list[str], workers: int) -> tuple[Any, list[Worker]]:
    """The scheduler that has begun to share the tests out to as many processes."""
    option = SimpleNamespace(loadscopereorder=True, tx=["popen"] * workers, maxfail=0)
    config = SimpleNamespace(option=option, getvalue=lambda name: getattr(option, name))
    scheduler = scopes.Modules(config, Producer("tests", enabled=False))
    made = [Worker() for _ in range(workers)]
    for worker in made:
        scheduler.add_node(worker)
        scheduler.add_node_collection(worker, nodeids)
    scheduler.schedule()
    return scheduler, made


def named(module: str, count: int) -> list[str]:
    return [f"{module}::test_a[a::{number}]" for number in range(count)]


def test_slow_ones_come_first() -> None:
    assert (TESTS.parent / SLOW).is_file() and (TESTS.parent / FAST).is_file()
    nodeids = named(FAST, 9) + named(SLOW, 3)
    _, (one, two) = given(nodeids, 2)
    assert (one.told, two.told) == ([9, 10, 11], list(range(9)))


def test_all_are_run_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scopes, "is_slow", lambda path: False)
    nodeids = [nodeid for number in range(20) for nodeid in named(f"{FAST}{number}", number + 1)]
    scheduler, workers = given(nodeids, 2)
    done = [0, 0]
    while scheduler.has_pending:
        for n, worker in enumerate(workers):
            if done[n] < len(worker.told):
                scheduler.mark_test_complete(worker, worker.told[done[n]])
                done[n] += 1
    assert sorted(workers[0].told + workers[1].told) == list(range(len(nodeids)))
    modules = [{nodeids[number].partition("[")[0] for number in worker.told} for worker in workers]
    assert not modules[0] & modules[1] and abs(len(workers[0].told) - len(workers[1].told)) < 25


def test_what_a_process_has_left_is_run_by_another_one() -> None:
    nodeids = named(SLOW, 4) + named(FAST, 4) + named(OTHER, 3)
    scheduler, (one, two) = given(nodeids, 2)
    scheduler.mark_test_complete(one, 0)
    assert scheduler.remove_node(one) == nodeids[1], "the test in which it has ended"
    for number in two.told:
        scheduler.mark_test_complete(two, number)
    assert two.told == [4, 5, 6, 7, 8, 9, 10, 1, 2, 3]
