# SPDX-License-Identifier: Apache-2.0
"""Many examples against one system: it is kept from one example to the next where that does not matter, and started anew where it does.

A failure on the kept system is repeated on a fresh one, and counts if it comes again. What Hypothesis has shrunk is replayed five times on
fresh systems: it fails the test if the property is violated each time, else it is called flaky.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from hypothesis import reject

from haros_ci.test_files.property_tests.examples import DISCARDED, Claim, Example, Outcome, quiet
from haros_ci.test_files.property_tests.plans import Step, as_json

#: How often a shrunk failure is replayed.
REPLAYS = 5
#: After so many failures that a fresh system does not show, every example gets a fresh system.
CARRIED = 3
#: So many examples the first system of a test is kept for, and each later one: what one leaves behind may hide what others would show.
KEPT, KEPT_LATER = 10, 20
#: Seconds that are spent on shrinking a failure.
SHRINKING = 60.0


class Failed(AssertionError):
    """The property is violated, on a fresh system, too."""


class NotReady(RuntimeError):
    """The system did not come up as the tests need it."""


class Trouble(BaseException):
    """The same, past Hypothesis: it is no failure of an example, and nothing is shrunk."""


class Driver:
    """What starts the system and talks to it."""

    #: Whether ``start`` can be called again for a fresh system.
    restarts = True

    @property
    def running(self) -> bool:
        """Whether the system is up, and is the one of this driver."""
        raise NotImplementedError

    def start(self) -> None:
        """Start the system, or a fresh one in its place, and wait until every edge is there."""
        raise NotImplementedError

    def reset(self) -> bool:
        """Bring the running system back to its first state; False if there is no hook for that."""
        return False

    def send(self, topic: str, message: Any) -> None:
        """Publish *message*."""
        raise NotImplementedError

    def listen(self, take: Callable[[str, Any], None] | None) -> None:
        """Give what the system publishes to *take*."""
        raise NotImplementedError

    def ended(self) -> list[str]:
        """The processes of the system that have ended by themselves."""
        return []

    def last(self) -> float:
        """When the last message came, on the monotonic clock."""
        return 0.0

    def stop(self) -> None:
        """End the system."""


class Found(NamedTuple):
    """A plan that has failed on a fresh system."""

    plan: Sequence[Step]
    outcome: Outcome


class Tally:
    """What the examples of one test have been so far."""

    def __init__(self) -> None:
        self.examples = self.discarded = self.exercised = self.starts = self.carried = 0
        self.began = time.monotonic()
        self.first: float | None = None
        self.spent = 0.0
        #: What ended by itself after one example and before the next.
        self.between: list[str] = []
        self.failing: dict[str, Found] = {}
        self.passing: set[str] = set()
        self.latest: Found | None = None
        self.shrinking_until: float | None = None


class Trials:
    """The tests of one system. Failing traces are written below *folder*."""

    def __init__(self, driver: Driver, folder: str) -> None:
        self.driver = driver
        self.folder = folder
        self.always_fresh = False
        #: The next example gets a fresh system; and how many the present one has had.
        self.fresh_next = False
        self.had = 0
        #: Why the system cannot be started, "" if it can, or was not yet.
        self.trouble = ""
        self.tally = Tally()

    def holds(self, claim: Claim, plan: Sequence[Step], assumptions: Sequence[Claim] = ()) -> None:
        """Carry out *plan*; Failed if *claim* is violated by it. The example is discarded where an assumption does not hold."""
        outcome = self._outcome(claim, plan, assumptions)
        if outcome is not None and outcome.status == DISCARDED:
            self.tally.discarded += 1
            reject()
        if outcome is not None and outcome.fails:
            raise Failed(outcome.reason)  # here alone: Hypothesis takes failures of two lines for two different ones

    def _outcome(self, claim: Claim, plan: Sequence[Step], assumptions: Sequence[Claim]) -> Outcome | None:
        """What *plan* shows, on a fresh system, too, if it fails; None where that is known to be nothing, or is not looked at any more."""
        tally = self.tally
        key = json.dumps(as_json(plan), sort_keys=True)
        if key in tally.failing:
            tally.latest = tally.failing[key]
            return tally.latest.outcome
        until = tally.shrinking_until
        if key in tally.passing or (until is not None and time.monotonic() > until):
            return None
        outcome = self._example(claim, plan, assumptions, fresh=self.always_fresh)
        if outcome.fails and not self.always_fresh and self.driver.restarts:
            outcome = self._example(claim, plan, assumptions, fresh=True)
            tally.carried += not outcome.fails
            self.always_fresh = tally.carried >= CARRIED
        if outcome.fails:
            tally.latest = tally.failing[key] = Found(plan, outcome)
            tally.shrinking_until = until if until is not None else time.monotonic() + SHRINKING
        elif outcome.status != DISCARDED:
            tally.passing.add(key)
        return outcome

    def _example(self, claim: Claim, plan: Sequence[Step], assumptions: Sequence[Claim], fresh: bool) -> Outcome:
        """One run of *plan*, on a *fresh* system or on the one that there is."""
        driver, tally = self.driver, self.tally
        dead = driver.ended() if driver.running else []
        tally.between.extend(dead)
        kept = KEPT if tally.starts < 2 else KEPT_LATER
        fresh = fresh or self.fresh_next or self.had >= kept or bool(dead)
        if not driver.running or (driver.restarts and fresh):
            self._start()
        elif driver.reset():
            self.had = 0
        else:
            quiet(driver.last)
        if tally.first is None:
            tally.first = time.monotonic()
        example = Example(claim, assumptions, driver.ended)
        driver.listen(example.take)
        begin = time.monotonic()
        try:
            outcome = example.run(plan, driver.send)
        finally:
            driver.listen(None)
        self.had += 1
        tally.examples += 1
        tally.exercised += outcome.exercised
        tally.spent += time.monotonic() - begin
        return outcome

    def _start(self) -> None:
        self.tally.starts += 1
        if not self.trouble:
            try:
                self.fresh_next, self.had = False, 0
                self.driver.start()
                return
            except Exception as err:  # whatever it is, it is not what the test is about
                self.trouble = f"the system could not be started: {type(err).__name__}: {err}"
        raise Trouble(self.trouble)

    def replayed(self, claim: Claim, plan: Sequence[Step], assumptions: Sequence[Claim]) -> list[Outcome]:
        """What *plan* shows on fresh systems, one after the other."""
        return [self._example(claim, plan, assumptions, fresh=True) for _ in range(REPLAYS)]
