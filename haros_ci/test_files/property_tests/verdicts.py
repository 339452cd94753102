# SPDX-License-Identifier: Apache-2.0
"""What becomes of a failure that Hypothesis has found and shrunk: it is replayed, its trace is stored, and the test says what it has shown."""

from __future__ import annotations

import json
import os
import shlex
import time
import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, Phase, errors, given, settings

from haros_ci.test_files.property_tests.examples import DIED, Claim, Outcome, lines, shown
from haros_ci.test_files.property_tests.trials import REPLAYS, Failed, Tally, Trials, Trouble

PASSED, FAILED, FLAKY, SKIPPED, ERROR = "passed", "failed", "flaky", "skipped", "error"
#: A file that gets a line of JSON for each test.
REPORT = "PROPERTY_TESTS_REPORT"

#: How many examples a test has; more or less of them on request.
EXAMPLES = "PROPERTY_TESTS_EXAMPLES"
#: The same examples in every run. What is slow here is the system under test.
SETTINGS = settings(
    max_examples=int(os.environ.get(EXAMPLES, "100")),
    deadline=None,
    derandomize=True,
    database=None,
    print_blob=False,
    report_multiple_bugs=False,
    phases=(Phase.explicit, Phase.generate, Phase.shrink),
    suppress_health_check=list(HealthCheck),
)

if TYPE_CHECKING:  # Python 3.8 does not evaluate this
    Test = Callable[[Any], None]


def judged(
    trials: Trials, claim: Claim, assumptions: Sequence[Claim], *plans: Any
) -> Callable[[Test], Callable[[], None]]:
    """Let Hypothesis draw *plans*, one strategy after the other, each from a fresh system on, until one fails.

    The test fails if a shrunk failure comes again in every replay; it is an expected failure, called flaky, if it does not; and it is
    skipped if no example had what the property is about.
    """

    def decorated(test: Test) -> Callable[[], None]:
        def run() -> None:
            trials.tally, trials.always_fresh = Tally(), False
            result, message = _result(trials, claim, assumptions, test, plans)
            _record(trials.tally, claim, test.__name__, result)
            if result in (FAILED, ERROR):
                pytest.fail(message, pytrace=False)
            elif result == FLAKY:
                pytest.xfail(message)
            elif result == SKIPPED:
                pytest.skip(message)

        run.__name__, run.__doc__, run.__module__ = test.__name__, test.__doc__, test.__module__
        return run

    return decorated


def _result(
    trials: Trials, claim: Claim, assumptions: Sequence[Claim], test: Test, plans: Sequence[Any]
) -> tuple[str, str]:
    examples = settings(SETTINGS, max_examples=max(1, SETTINGS.max_examples // len(plans)))
    fitting = 0
    try:
        for strategy in plans:
            trials.fresh_next = True
            try:
                examples(given(plan=strategy)(test))()
                fitting += 1
            except errors.Unsatisfiable:
                pass
    except (Failed, errors.Flaky):
        try:
            return _replayed(trials, claim, assumptions, test.__name__)
        except Trouble as err:
            return ERROR, str(err)
    except Trouble as err:
        return ERROR, str(err)
    tally = trials.tally
    if not fitting:
        return SKIPPED, "no example fits the assumptions"
    if tally.carried:
        warnings.warn(
            f"{tally.carried} failures came of the state that an earlier example had left, and not on a fresh system; "
            "reset(system) in hooks.py can bring the first state back",
            stacklevel=2,
        )
    if tally.between:
        warnings.warn(
            f"between two examples {len(tally.between)} processes ended, first {tally.between[0]}", stacklevel=2
        )
    if not tally.exercised:
        return SKIPPED, f"never exercised: none of {tally.examples} examples had what the property is about"
    return PASSED, ""


def _replayed(trials: Trials, claim: Claim, assumptions: Sequence[Claim], name: str) -> tuple[str, str]:
    """Replay what was found on fresh systems and store its trace."""
    found = trials.tally.latest
    if found is None:
        return ERROR, "Hypothesis reports a failure that no example has shown"
    outcomes = trials.replayed(claim, found.plan, assumptions)
    failing = [outcome for outcome in outcomes if outcome.fails]
    outcome = min(failing or [found.outcome], key=lambda outcome: len(outcome.trace))
    path = _stored(trials.folder, name, outcome)
    fresh = ", on fresh systems" if trials.driver.restarts else ", all on the system that there is"
    flaky = len(failing) < REPLAYS
    return (FLAKY if flaky else FAILED), "\n".join(
        (
            f"{'FLAKY: ' if flaky else ''}{claim.title} ({claim.where})",
            f"{outcome.reason}" if outcome.status != DIED else f"a process of the system has ended: {outcome.reason}",
            shown(outcome),
            f"so in {len(failing)} of {REPLAYS} replays{fresh}; {trials.tally.examples} examples were carried out",
            f"the trace: {path}",
            command(path, claim),
        )
    )


def command(path: str, claim: Claim) -> str:
    """How to hold the stored trace against the property again."""
    words = ["haros-ci", "monitor", "--jsonl", path]
    if claim.configuration:
        words += ["--configuration", claim.configuration]
    return " ".join(map(shlex.quote, [*words, "--property", claim.text]))


def _stored(folder: str, name: str, outcome: Outcome) -> str:
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, f"{name}.jsonl")
    with open(path, "w", encoding="ascii") as file:
        file.write(lines(outcome))
    return os.path.relpath(path)


def _record(tally: Tally, claim: Claim, name: str, result: str) -> None:
    """A line of the report, where one is asked for."""
    path = os.environ.get(REPORT)
    if not path:
        return
    found = tally.latest
    made: dict[str, Any] = {
        "test": name,
        "property": claim.text,
        "result": result,
        "examples": tally.examples,
        "discarded": tally.discarded,
        "exercised": tally.exercised,
        "starts": tally.starts,
        "carried": tally.carried,
        "seconds": round(time.monotonic() - tally.began, 3),
        "seconds in examples": round(tally.spent, 3),
        "seconds to the first example": None if tally.first is None else round(tally.first - tally.began, 3),
        "messages": None if found is None else [step.message for step in found.plan if step.topic is not None],
    }
    with open(path, "a", encoding="ascii") as file:
        file.write(f"{json.dumps(made)}\n")
