# SPDX-License-Identifier: Apache-2.0
"""Work shared out to forked processes: the same results as without them, whatever becomes of a process."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from haros_ci import forks
from haros_ci.forks import shared
from haros_ci.interruption import listening
from haros_ci.scratch import scratch_directory

HERE = os.getpid()
#: Long enough that one process does not do all of it before the next one begins.
MANY = 40


def square(number: int) -> int:
    return sum(range(20_000)) * 0 + number * number


def where(number: int) -> tuple[int, int]:
    square(number)
    return number, os.getpid()


def test_results_come_in_the_order_of_the_jobs() -> None:
    jobs = [partial(square, number) for number in range(MANY)]
    assert shared(jobs, range(MANY), 4) == [number * number for number in range(MANY)]


def test_jobs_of_a_group_are_done_by_one_process_in_their_order() -> None:
    done: list[int] = []

    def job(number: int) -> tuple[int, list[int], int]:
        done.append(number)
        return number, list(done), os.getpid()

    groups = [number % 5 for number in range(MANY)]
    results = shared([partial(job, number) for number in range(MANY)], groups, 3)
    assert [number for number, _, _ in results] == list(range(MANY))
    for group in range(5):
        mine = [result for result in results if result[0] % 5 == group]
        assert len({pid for _, _, pid in mine}) == 1
        assert all(number in before for number, before, _ in mine)


@pytest.mark.parametrize("own", ["second", "none of them"])
def test_jobs_of_one_group_are_done_here_and_first(own: str) -> None:
    done: list[int] = []

    def job(number: int) -> tuple[int, int]:
        done.append(number)
        return where(number)

    groups = ["second" if number % 4 == 1 else f"group {number}" for number in range(MANY)]
    results = shared([partial(job, number) for number in range(MANY)], groups, 3, here=own)
    assert [number for number, _ in results] == list(range(MANY))
    if own == "second":
        assert done[: MANY // 4] == [number for number in range(MANY) if number % 4 == 1]
        assert {process for number, process in results if number % 4 == 1} == {HERE}


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux only")
def test_more_than_one_process_works(monkeypatch: pytest.MonkeyPatch) -> None:
    """The parent leaves everything to the others: it reads nothing from the queue."""
    parents = forks._done

    def done(jobs: Any, batches: Any, queue: int) -> Any:
        return iter(()) if os.getpid() == HERE else parents(jobs, batches, queue)

    monkeypatch.setattr(forks, "_done", done)
    pids = {pid for _, pid in shared([partial(where, number) for number in range(MANY)], range(MANY), 3)}
    assert HERE not in pids
    assert 1 <= len(pids) <= 2


def in_a_child(what: Callable[[], Any], number: int) -> int:
    if os.getpid() != HERE:
        what()
    return square(number)


def fail() -> None:
    raise ValueError("in a child")


@pytest.mark.parametrize(
    "what",
    [
        fail,
        lambda: os._exit(3),
        lambda: os.kill(os.getpid(), signal.SIGKILL),
        lambda: sys.exit("in a child"),
        lambda: sys.setrecursionlimit(60),
    ],
    ids=["raises", "exits", "is killed", "leaves", "cannot pickle"],
)
def test_what_a_process_does_not_bring_back_is_done_here(
    what: Callable[[], Any], capfd: pytest.CaptureFixture[str]
) -> None:
    jobs = [partial(in_a_child, what, number) for number in range(MANY)]
    assert shared(jobs, range(MANY), 4) == [number * number for number in range(MANY)]
    assert capfd.readouterr() == ("", "")


def test_a_job_that_fails_here_fails() -> None:
    with pytest.raises(ValueError, match="in a child"):
        shared([fail, fail], [0, 1], 2)


@pytest.mark.parametrize("processes", [0, 1, 2, 99])
@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_jobs_and_any_number_of_processes(count: int, processes: int) -> None:
    jobs = [partial(square, number) for number in range(count)]
    assert shared(jobs, range(count), processes) == [number * number for number in range(count)]


def test_nothing_is_forked_where_there_are_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(forks.threading, "active_count", lambda: 2)
    monkeypatch.setattr(forks, "_forked", fail)
    assert shared([partial(square, 3), partial(square, 4)], [0, 1], 2) == [9, 16]


def refuse() -> int:
    raise BlockingIOError


@pytest.mark.skipif(sys.platform != "linux", reason="/proc")
@pytest.mark.parametrize("fork", [os.fork, refuse])
def test_no_descriptor_is_left_open(monkeypatch: pytest.MonkeyPatch, fork: Callable[[], int]) -> None:
    monkeypatch.setattr(forks.os, "fork", fork)
    before = os.listdir("/proc/self/fd")
    jobs = [partial(square, number) for number in range(MANY)]
    assert shared(jobs, range(MANY), 4) == [number * number for number in range(MANY)]
    assert len(os.listdir("/proc/self/fd")) == len(before)


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux only")
def test_meanwhile_another_process_works() -> None:
    before = os.listdir("/proc/self/fd")
    with forks.meanwhile(partial(where, 3)) as found:
        number, process = found() or (0, HERE)
        assert number == 3 and process != HERE
        assert found() is None, "it is taken once"
    assert len(os.listdir("/proc/self/fd")) == len(before)


@pytest.mark.parametrize("what", [fail, lambda: os._exit(3)], ids=["raises", "exits"])
def test_what_is_not_brought_back_meanwhile_is_nothing(
    what: Callable[[], Any], capfd: pytest.CaptureFixture[str]
) -> None:
    with forks.meanwhile(partial(in_a_child, what, 3)) as found:
        assert found() is None
    assert capfd.readouterr() == ("", "")


def test_nothing_is_done_meanwhile_where_there_are_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(forks.threading, "active_count", lambda: 2)
    with forks.meanwhile(fail) as found:
        assert found() is None


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux only")
@pytest.mark.parametrize("is_torn", [False, True])
def test_what_is_left_ends_with_the_block(is_torn: bool) -> None:
    (reading, writing), (told, telling) = os.pipe(), os.pipe()

    def wait() -> bytes:
        os.write(telling, str(os.getpid()).encode())
        return os.read(reading, 1)

    with suppress(KeyboardInterrupt), forks.meanwhile(wait):
        child = int(os.read(told, 20))
        if is_torn:
            raise KeyboardInterrupt
    with pytest.raises(ChildProcessError):
        os.waitpid(child, os.WNOHANG)
    for end in (reading, writing, told, telling):
        os.close(end)


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux only")
def test_what_is_left_puts_in_order_what_it_has_begun(tmp_path: Path) -> None:
    def work() -> None:
        with scratch_directory(place=str(tmp_path)):
            signal.pause()

    with listening(), forks.meanwhile(work):
        while not os.listdir(tmp_path):
            os.sched_yield()
    assert os.listdir(tmp_path) == []


class Torn:
    """Cannot be read from what is written of it."""

    def __reduce__(self) -> tuple[Callable[..., int], tuple[str]]:
        return int, ("no number",)


def torn_or_where(number: int) -> tuple[Torn | None, int]:
    square(number)
    return (Torn() if os.getpid() != HERE else None), os.getpid()


def test_what_cannot_be_carried_over_is_done_here() -> None:
    jobs = [partial(torn_or_where, number) for number in range(MANY)]
    assert {process for _, process in shared(jobs, range(MANY), 2)} == {HERE}
