# SPDX-License-Identifier: Apache-2.0
"""Examples against systems that are functions: what counts as a failure, what is called flaky, what is discarded, and what is stored.

The system stands in for one of ROS, behind the same interface; the monitors are generated ones.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from test_files.generated import monitor_class

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.monitoring.watch import Watch
from haros_ci.recordings.jsonl import JsonLines
from haros_ci.test_files.property_tests import trials as trials_module
from haros_ci.test_files.property_tests import verdicts as verdicts_module
from haros_ci.test_files.property_tests.examples import Claim, Example
from haros_ci.test_files.property_tests.plans import Input, between, plans, settled
from haros_ci.test_files.property_tests.trials import Driver, NotReady, Trials
from haros_ci.test_files.property_tests.verdicts import REPORT, judged

CAUSES = "globally: /in {data > 5} causes /out within 40 ms"
INPUTS = Input("/in", st.integers(0, 20).map(lambda number: {"data": number}))


class Answering(Driver):
    """A system that answers at once; *answers* says what, from the message and the state, which a fresh system has not."""

    def __init__(self, answers: Callable[[dict[str, Any], list[Any]], Any], restarts: bool = True) -> None:
        self.answers = answers
        self.restarts = restarts
        self.state: list[Any] = []
        self.starts = 0
        self.take: Any = None
        self.up = False
        self.dead: list[str] = []

    @property
    def running(self) -> bool:
        return self.up

    def start(self) -> None:
        self.starts += 1
        self.state, self.up, self.dead = [], True, []

    def send(self, topic: str, message: Any) -> None:
        answer = self.answers(message, self.state)
        if answer == "die":
            self.dead = ["/node ended with signal SIGSEGV"]
        elif answer is not None and self.take is not None:
            self.take("/out", answer)

    def listen(self, take: Any) -> None:
        self.take = take

    def ended(self) -> list[str]:
        return self.dead


@pytest.fixture(autouse=True)
def clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock that goes on only where an example waits: the system answers at once, and nothing depends on how busy this machine is."""
    now = [0]
    monkeypatch.setattr(Example, "clock", staticmethod(lambda: now[0]))
    monkeypatch.setattr(Example, "rest", lambda self, seconds: now.__setitem__(0, now[0] + round(seconds * 1e9)))


def always(message: Any, state: list[Any]) -> Any:
    return {"data": 0}


def not_seven(message: Any, state: list[Any]) -> Any:
    return None if message["data"] == 7 else {"data": 0}


def not_twice(message: Any, state: list[Any]) -> Any:
    state.append(message["data"])
    return None if len(state) > 1 and message["data"] > 5 else {"data": 0}


def only_once(message: Any, state: list[Any]) -> Any:
    """A system that is worn out after ten messages, whatever they are."""
    state.append(message["data"])
    return {"data": 0} if len(state) <= 10 else None


def dies(message: Any, state: list[Any]) -> Any:
    return "die" if message["data"] > 9 else {"data": 0}


def result_of(
    driver: Driver, folder: Path, text: str = CAUSES, assumptions: tuple[str, ...] = (), parts: Any = None
) -> tuple[str, str]:
    """The outcome of one generated test, and what it says."""
    trials = Trials(driver, str(folder / "failures"))
    claim = Claim(text, text, monitor_class(text), 0.0, "haros.yaml:1:1", "robot")
    assumed = tuple(Claim(item, item, monitor_class(item)) for item in assumptions)

    @judged(
        trials, claim, assumed, parts if parts is not None else plans(between(1, 3, INPUTS), settled(), gaps=(0.0,))
    )
    def test_it(plan: Any) -> None:
        trials.holds(claim, plan, assumed)

    try:
        test_it()
    except pytest.xfail.Exception as err:  # before failures, as it is one
        return "flaky", str(err)
    except pytest.fail.Exception as err:
        return "failed", str(err)
    except pytest.skip.Exception as err:
        return "skipped", str(err)
    return "passed", ""


def messages_of(folder: Path) -> list[Any]:
    found = [json.loads(line) for line in (folder / "failures/test_it.jsonl").read_text().splitlines()]
    return [line["msg"]["data"] for line in found if line["topic"] == "/in"]


@pytest.mark.parametrize(
    ("answers", "messages"), [(not_seven, [7]), (not_twice, [0, 6]), (dies, [10]), (lambda message, state: None, [6])]
)
def test_a_failure_is_shrunk_and_stored(answers: Any, messages: list[int], tmp_path: Path) -> None:
    result, text = result_of(Answering(answers), tmp_path)
    assert result == "failed"
    assert messages_of(tmp_path) == messages
    assert "so in 5 of 5 replays" in text and "haros-ci monitor --jsonl" in text


@pytest.mark.parametrize("answers", [not_seven, not_twice])
def test_the_stored_trace_is_violated_for_the_offline_monitor_too(answers: Any, tmp_path: Path) -> None:
    result_of(Answering(answers), tmp_path)
    recording = JsonLines(tmp_path / "failures/test_it.jsonl")
    watch = Watch([monitor_of(parse_property(CAUSES))])
    for topic, message, time, number in recording.messages(watch.topics):
        if watch.began is None and recording.first is not None:
            watch.begin(recording.first)
        watch.take(topic, message, time, number)
    (outcome,) = watch.finish(recording.last, frozenset(recording.topics))
    assert outcome.verdict.value == "violated"


@pytest.mark.parametrize(
    ("answers", "text", "assumptions"),
    [
        (always, CAUSES, ()),
        (only_once, CAUSES, ()),
        (not_seven, CAUSES, ("globally: no /in {data = 7}",)),
        (not_seven, "globally: /in {data > 7} causes /out within 40 ms", ()),
        (not_twice, CAUSES, ("globally: /in forbids /in within 60 ms",)),
        (dies, CAUSES, ("globally: no /in {data > 9}",)),
        (always, "globally: no /out {data != 0}", ()),
        (always, "globally: /out requires /in", ()),
    ],
)
def test_what_holds_is_quiet(
    answers: Any, text: str, assumptions: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(verdicts_module, "SETTINGS", settings(verdicts_module.SETTINGS, max_examples=25))
    assert result_of(Answering(answers), tmp_path, text, assumptions) == ("passed", "")
    assert not (tmp_path / "failures").exists()


def test_a_system_that_is_worn_out_is_started_anew_for_every_example(tmp_path: Path) -> None:
    driver = Answering(only_once)
    assert result_of(driver, tmp_path)[0] == "passed"
    assert driver.starts > 30


def test_a_system_is_kept_where_that_does_not_matter(tmp_path: Path) -> None:
    driver = Answering(always)
    assert result_of(driver, tmp_path)[0] == "passed"
    assert 4 <= driver.starts <= 6  # a fresh one after ten examples, and after twenty more


def test_what_does_not_come_again_in_every_replay_is_flaky(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    driver = Answering(not_seven)
    replayed = Trials.replayed

    def with_luck(self: Trials, *arguments: Any) -> Any:
        """From the replays on the system answers now and then."""
        driver.answers = lambda message, state: {"data": 0} if driver.starts % 2 else None
        return replayed(self, *arguments)

    monkeypatch.setattr(Trials, "replayed", with_luck)
    result, text = result_of(driver, tmp_path)
    assert result == "flaky" and text.startswith("FLAKY: ")
    assert "so in 2 of 5 replays" in text or "so in 3 of 5 replays" in text
    assert messages_of(tmp_path) == [7]


def test_one_failure_that_a_fresh_system_does_not_show_is_none(tmp_path: Path) -> None:
    calls: list[int] = []

    def once(message: Any, state: list[Any]) -> Any:
        calls.append(message["data"])
        return None if message["data"] > 5 and len([n for n in calls if n > 5]) == 1 else {"data": 0}

    assert result_of(Answering(once), tmp_path)[0] == "passed"


def test_what_is_never_exercised_is_not_passed(tmp_path: Path) -> None:
    result, text = result_of(Answering(always), tmp_path, "globally: /other causes /out within 40 ms")
    assert result == "skipped" and "never exercised" in text


def test_assumptions_that_leave_nothing_are_named(tmp_path: Path) -> None:
    result, text = result_of(Answering(always), tmp_path, CAUSES, ("globally: no /in",))
    assert result == "skipped" and "assumptions" in text


def test_a_system_that_does_not_start_is_no_counterexample(tmp_path: Path) -> None:
    class Broken(Answering):
        def start(self) -> None:
            self.starts += 1
            raise NotReady("no master")

    driver = Broken(always)
    result, text = result_of(driver, tmp_path)
    assert result == "failed" and "the system could not be started: NotReady: no master" in text
    assert driver.starts == 1


def test_without_restarts_a_failure_is_replayed_on_the_system_that_there_is(tmp_path: Path) -> None:
    driver = Answering(not_seven, restarts=False)
    result, text = result_of(driver, tmp_path)
    assert result == "failed" and driver.starts == 1 and "on the system that there is" in text


def test_the_report_has_a_line_for_each_test(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(REPORT, str(tmp_path / "report.jsonl"))
    result_of(Answering(not_seven), tmp_path)
    (line,) = [json.loads(line) for line in (tmp_path / "report.jsonl").read_text().splitlines()]
    assert line["result"] == "failed" and line["messages"] == [{"data": 7}] and line["starts"] > 5


def test_what_ends_between_two_examples_is_named(tmp_path: Path) -> None:
    driver = Answering(always)
    started = driver.start

    def start() -> None:
        started()
        driver.reset = lambda: bool(driver.dead.append("/node ended with exit code 3"))  # type: ignore[method-assign,func-returns-value]

    driver.start = start  # type: ignore[method-assign]
    text = "globally: no /out {data != 0}"
    with pytest.warns(UserWarning, match="first /node ended with exit code 3"):
        result = result_of(driver, tmp_path, text)[0]
    assert result in ("passed", "failed")


def test_shrinking_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trials_module, "SHRINKING", 0.0)
    result, _ = result_of(Answering(not_twice), tmp_path)
    assert result == "failed" and len(messages_of(tmp_path)) >= 2
