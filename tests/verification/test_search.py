# SPDX-License-Identifier: Apache-2.0
"""What is found out about properties of small systems: every answer, in both networks, each counterexample replayed."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec

import pytest

from haros_ci.behaviour.parser import parse_property
from haros_ci.verification.outcomes import Finding, Result
from haros_ci.verification.problem import Claim, Limits, Member, Network, Problem
from haros_ci.verification.replay import confirmed

pytestmark = pytest.mark.skipif(find_spec("z3") is None, reason="needs the extra: pip install 'haros-ci[verify]'")

MS = 1_000_000
#: A chain: /src publishes /a, /first makes /b of it, /second makes /c of that.
CHAIN = (
    Member("/src", frozenset(("/a",)), {}),
    Member("/first", frozenset(("/b",)), {"/a": 1}),
    Member("/second", frozenset(("/c",)), {"/b": 10}),
)
AXIOMS = (
    ("/src", "globally: no /a {x > 5}"),
    ("/first", "globally: /a as A causes /b {x = @A.x} within 10 ms"),
    ("/first", "globally: /b as B requires /a {x = @B.x} within 10 ms"),
    ("/second", "globally: /b as B causes /c {x = @B.x} within 10 ms"),
    ("/second", "globally: /c as C requires /b {x = @C.x} within 10 ms"),
)
AT_ONCE, SHORT = Network(), Limits(6, 20)
LATER = Network(True, 0, 2 * MS)


def problem(
    claims: Sequence[str],
    axioms: Sequence[tuple[str, str]] = AXIOMS,
    members: tuple[Member, ...] = CHAIN,
    network: Network = AT_ONCE,
    limits: Limits = SHORT,
) -> Problem:
    stated = [Claim(n, text, parse_property(text), node=node) for n, (node, text) in enumerate(axioms)]
    asked = [Claim(100 + n, text, parse_property(text)) for n, text in enumerate(claims)]
    return Problem(members, tuple(stated), tuple(asked), network, limits)


def answer(claim: str, **given: object) -> Finding:
    from haros_ci.verification.search import findings

    made = problem([claim], **given)  # type: ignore[arg-type]  # as of problem
    (finding,) = findings(made)
    if finding.run is not None:
        axioms = tuple(axiom for axiom in made.axioms if axiom.number in finding.axioms)
        assert not isinstance(confirmed(made, made.claims[0], axioms, finding.run), str)
    return finding


PROVED, NONE, VIOLATED, VACUOUS = Result.PROVED, Result.NONE, Result.VIOLATED, Result.VACUOUS


@pytest.mark.parametrize(
    ("claim", "expected", "events"),
    [
        ("globally: /a as A causes /c {x = @A.x} within 20 ms", PROVED, 0),
        ("globally: /a as A causes /c {x = @A.x} within 19 ms", VIOLATED, 3),
        ("globally: /a causes /c", PROVED, 0),
        ("after /a: /a causes /c within 1 s", PROVED, 0),
        ("after /a until /c: /a causes /c within 1 s", VIOLATED, 4),
        ("globally: /c as C requires /a {x = @C.x} within 20 ms", PROVED, 0),
        ("globally: /c as C requires /a {x = @C.x} within 15 ms", VIOLATED, 3),
        ("globally: /c as C requires /a {x > @C.x}", VIOLATED, 3),
        ("until /a {x = 1}: /c requires /a", PROVED, 0),
        ("after /b: /c requires /b", VIOLATED, 3),
        ("globally: no /c {x > 5}", PROVED, 0),
        ("globally: no /c {x > 4}", VIOLATED, 3),
        ("after /a {x = 2}: no /c {x > 5} within 1 s", PROVED, 0),
        ("globally: /a forbids /c within 5 ms", VIOLATED, 3),
        ("globally: /c {x = 1} forbids /a {x = 1}", VIOLATED, 6),
        ("globally: some /c", VIOLATED, 0),
        ("globally: some /c within 1 s", VIOLATED, 0),
        ("globally: /c causes /a", VIOLATED, 3),
        ("globally: /a {x > 6} causes /c", VACUOUS, 0),
        ("after /c {x > 5}: no /a", VACUOUS, 0),
        ("globally: /b {x > 5} requires /c", VACUOUS, 0),
        ("globally: /c requires (/a or /b)", PROVED, 0),
        ("after /a {x = 1} until /a {x = 2}: /c requires /b", VIOLATED, 6),
        ("after /a until /a {x = 2}: /a {x = 1} causes /b within 20 ms", VIOLATED, 7),
        ("until /c: /b requires /a within 10 ms", PROVED, 0),
        ("after /a: no /b within 0 ms", NONE, 0),
        ("globally: no /a {x > 3 and x < 3}", PROVED, 0),
        ("globally: no /c {sin(x) > 0}", Result.NOT_MODELLED, 0),
    ],
)  # fmt: skip
def test_answers_where_messages_arrive_at_once(claim: str, expected: Result, events: int) -> None:
    found = answer(claim)
    assert found.result is expected, found
    assert len(found.run.steps if found.run is not None else ()) == events


@pytest.mark.parametrize(
    ("claim", "network", "expected", "latency"),
    [
        ("globally: /a as A causes /c {x = @A.x} within 24 ms", LATER, PROVED, 2.0),
        ("globally: /a as A causes /c {x = @A.x} within 24 ms", replace(LATER, high=3 * MS), VIOLATED, 2.0),
        ("globally: /a as A causes /c {x = @A.x} within 30 ms", replace(LATER, high=3 * MS), PROVED, 5.0),
        ("globally: /c as C requires /a {x = @C.x} within 24 ms", LATER, PROVED, 2.0),
        ("globally: /a causes /c within 1 s", Network(True, 0, None), VIOLATED, 490.0),
        ("globally: /a causes /c", Network(True, 0, None), PROVED, None),
        ("globally: /a as A causes /c {x = @A.x} within 1 s", replace(LATER, loses=True), VIOLATED, None),
        ("globally: /a causes /c within 1 s", replace(LATER, loses=True), NONE, None),
        ("globally: no /c {x > 5}", LATER, PROVED, None),
        ("globally: /a forbids /c within 6 ms", replace(LATER, low=2 * MS), VIOLATED, 2.0),
        ("globally: /a forbids /c within 3 ms", replace(LATER, low=2 * MS), NONE, None),
    ],
)  # fmt: skip
def test_answers_where_messages_arrive_later(
    claim: str, network: Network, expected: Result, latency: float | None
) -> None:
    found = answer(claim, network=network, limits=Limits(8, 20))
    assert found.result is expected, found
    if expected is not VIOLATED or latency is None or "forbids" not in claim:
        assert found.latency == (None if latency is None else latency * MS) or network.loses


def test_a_message_is_lost_only_where_a_queue_can_overflow() -> None:
    claim, lossy = "globally: /a causes /b within 1 s", replace(LATER, loses=True)
    axioms = (("/first", "globally: /a causes /b within 10 ms"), ("/first", "globally: /b requires /a"))
    assert answer(claim, axioms=axioms, network=lossy, limits=Limits(3, 20)).result is NONE
    roomy = (CHAIN[0], replace(CHAIN[1], subscribes={"/a": 10}))
    assert answer(claim, axioms=axioms, members=roomy, network=lossy, limits=Limits(5, 20)).result is NONE
    strict = (("/first", "after /a {x = 1}: /a {x = 2} causes /b {x = 2} within 10 ms"), *axioms)
    found = answer("globally: /a {x = 2} causes /b {x = 2} within 1 s", axioms=strict, network=lossy)
    assert found.result is VIOLATED


@pytest.mark.parametrize("network", [AT_ONCE, LATER])
def test_a_topic_that_a_node_has_by_its_promise_alone_is_published_by_it(network: Network) -> None:
    axioms = (("/first", "globally: /z {x > 1} forbids /z"), ("/second", "globally: no /z {x = 7}"))
    found = answer("globally: /z causes /z {x = 7} within 1 ms", axioms=axioms, network=network)
    assert found.result is VIOLATED and found.run is not None
    assert {step.node for step in found.run.steps if not step.received} <= {"/first", "/second"}


def test_a_message_without_the_item_that_an_axiom_asks_for_keeps_it() -> None:
    """The monitor cannot decide such an axiom; it is not violated."""
    axioms = (("/src", "globally: no /a {not items[5] in {0, 1}}"), ("/src", "globally: no /a {len(items) > 3}"))
    assert answer("globally: no /a", axioms=axioms).result is VIOLATED


def test_axioms_that_exclude_each_other_are_named() -> None:
    axioms = (("/src", "globally: some /a"), ("/src", "globally: no /b"), ("/src", "globally: no /a"))
    found = answer("globally: no /a {x = 1}", axioms=axioms)
    assert (found.result, found.axioms) == (Result.CONTRADICTORY, (0, 2))
    chain = (("/src", "globally: some /a"), ("/first", "globally: /a causes /b"), ("/first", "globally: no /b"))
    found = answer("globally: no /b {x = 1}", axioms=chain)
    assert (found.result, found.axioms) == (Result.CONTRADICTORY, (0, 1, 2))


def test_a_run_that_is_too_short_is_no_contradiction() -> None:
    axioms = (("/src", "globally: some /a"), *AXIOMS)
    few = "no run of so few events (1) {}; longer ones may"
    found = answer("globally: no /b {x > 4}", axioms=axioms, limits=Limits(1, 20))
    assert (found.result, found.reason) == (Result.UNDETERMINED, few.format("keeps all axioms"))
    found = answer("after /a {x = 1}: no /b {x = 2}", limits=Limits(1, 20))
    assert (found.result, found.reason) == (Result.UNDETERMINED, few.format("puts it to the test"))
    assert answer("after /a {x = 1}: no /b {x = 6}", limits=Limits(1, 20)).result is PROVED


def test_axioms_that_go_on_for_ever_have_runs_with_a_loop() -> None:
    axioms = (
        ("/src", "globally: /a causes /b within 10 ms"),
        ("/src", "globally: /b causes /a within 10 ms"),
        ("/src", "globally: some /a"),
    )
    members = (Member("/src", frozenset(("/a", "/b")), {"/a": 1, "/b": 1}),)
    found = answer("globally: no /b {x > 5}", axioms=axioms, members=members)
    assert found.result is VIOLATED and found.run is not None and found.run.loop is not None
    assert answer("globally: /a causes /b", axioms=axioms, members=members).result is PROVED
    assert answer("globally: some /b within 5 ms", axioms=axioms, members=members).result is VIOLATED
    assert answer("globally: some /b", axioms=axioms, members=members).result is NONE


def test_what_follows_of_a_counterexample_must_be_possible_too() -> None:
    axioms = (("/first", "globally: /a {x = 1} causes /b within 10 ms"), ("/first", "globally: no /b"))
    found = answer("globally: no /a {x = 1}", axioms=axioms)
    assert found.result is Result.UNDETERMINED
    assert "none was found that keeps those on what follows of it" in found.reason
    possible = answer("globally: no /a {x = 1}", axioms=axioms[:1])
    assert possible.run is not None and [step.topic for step in possible.run.steps] == ["/a", "/b"]


def test_an_axiom_that_is_not_modelled_is_left_out_and_still_replayed() -> None:
    axioms = (("/src", "globally: no /a {sqrt(x) > 1}"),)
    found = answer("globally: no /a {x = 3}", axioms=axioms)
    assert found.left == ((0, "the function sqrt in sqrt(x)"),)
    assert found.result is Result.UNDETERMINED and "does not keep the axiom" in found.reason
    assert answer("globally: no /a {x = 0}", axioms=axioms).result is VIOLATED


def test_a_disagreement_of_the_replay_is_never_reported_as_a_violation(monkeypatch: pytest.MonkeyPatch) -> None:
    from haros_ci.monitoring.patterns import Absence

    monkeypatch.setattr(Absence, "in_window", lambda self, since, time: False)
    found = answer("globally: no /c {x > 4}")
    assert found.result is Result.UNDETERMINED and found.reason.startswith("the replay disagrees")


def test_without_time_nothing_is_claimed() -> None:
    found = answer("after /a: /c requires (/a or /b) within 40 ms", limits=Limits(40, 0.05))
    assert found.result in (Result.UNDETERMINED, NONE) and not found.is_whole


@pytest.mark.parametrize("network", [AT_ONCE, LATER])
def test_what_is_proved_has_no_counterexample(monkeypatch: pytest.MonkeyPatch, network: Network) -> None:
    from haros_ci.verification import groups, search

    claims = [
        "globally: /a as A causes /c {x = @A.x} within 24 ms", "globally: /c as C requires /a {x = @C.x} within 24 ms",
        "globally: no /c {x > 5}", "until /a {x = 1}: /c requires /a", "after /a: /b causes /c within 12 ms",
    ]  # fmt: skip
    made = problem(claims, network=network, limits=Limits(6, 60))
    assert {finding.result for finding in search.findings(made)} == {PROVED}
    monkeypatch.setattr(groups, "suffices", lambda *_: False)
    assert {finding.result for finding in search.findings(made)} == {NONE}


def test_the_same_counterexample_is_shown_each_time() -> None:
    first, second = (answer("globally: /c as C requires /a {x = @C.x} within 15 ms") for _ in range(2))
    assert first.run is not None and first == second


def test_random_systems_have_no_wrong_answer() -> None:
    from verification.systems import chained, system, wrong

    seen: Counter[str] = Counter()
    made = [system(random.Random(f"pytest {number}"), 3) for number in range(2)]
    made += [chained(random.Random(f"chain {number}"), 3) for number in range(2)]
    assert [text for one in made for text in wrong(one, seen)] == []
    assert seen["async: violated"] and seen["instant: violated"] and seen["instant: proved"]


#: The chain with what opens and closes scopes, which all of its nodes receive.
SCOPED = (
    Member("/src", frozenset(("/a", "/go", "/stop")), {}),
    Member("/first", frozenset(("/b",)), {"/a": 1, "/go": 1, "/stop": 1}),
    Member("/second", frozenset(("/c",)), {"/b": 10, "/go": 1, "/stop": 1}),
)
SAME = ("after /go", "until /stop", "after /go until /stop", "after /go as G {x = 1} until /stop {x = @G.x}")


def within(scope: str) -> tuple[tuple[str, str], ...]:
    return tuple((node, text.replace("globally", scope)) for node, text in AXIOMS)


@pytest.mark.parametrize("scope", SAME)
@pytest.mark.parametrize(
    "pattern",
    ["/a as A causes /c {x = @A.x} within 20 ms", "/c as C requires /a {x = @C.x} within 20 ms", "no /c {x > 5}"],
)
def test_axioms_of_the_same_scope_compose(pattern: str, scope: str) -> None:
    assert answer(f"{scope}: {pattern}", axioms=within(scope), members=SCOPED).result is PROVED


@pytest.mark.parametrize(
    ("claim", "scope"),
    [
        ("globally: no /c {x > 5}", "after /go"),
        ("globally: /a as A causes /c {x = @A.x} within 20 ms", "until /stop"),
        ("after /go: /a as A causes /c {x = @A.x} within 20 ms", "after /go until /stop"),
        ("after /go {x = 1}: no /c {x > 5}", "after /go {x = 2}"),
        ("after /go until /stop: /a causes /c within 20 ms", "globally"),
        ("after /go: /c requires /a within 20 ms", "globally"),
        ("after /go: /c requires /a within 20 ms", "after /go {x = 1}"),
        ("until /stop: /a causes /c within 20 ms", "globally"),
        ("after /go until /stop: /a causes /c within 19 ms", "after /go until /stop"),
    ],
)
def test_axioms_of_other_scopes_do_not(claim: str, scope: str) -> None:
    assert answer(claim, axioms=within(scope), members=SCOPED).result is VIOLATED


def test_where_messages_arrive_later_scopes_open_later_and_nothing_is_composed() -> None:
    found = answer(
        "after /go: no /c {x > 5}", axioms=within("after /go"), members=SCOPED, network=LATER, limits=Limits(3, 20)
    )
    assert found.result is not PROVED


def test_what_is_not_composed_for_its_scope_is_named() -> None:
    axioms = (("/first", "after /go: no /b {x > 5}"), ("/first", "until /go: no /b"))
    found = answer("globally: no /b {x > 5}", axioms=axioms, members=SCOPED, limits=Limits(3, 20))
    assert found.result is NONE
    assert found.reason == "not composed: the scope of /first: after /go: no /b {x > 5} and 1 more"


@pytest.mark.parametrize(
    ("claim", "expected"),
    [
        ("after /b as B: no /a {x = @B.x}", VIOLATED),
        ("after /b as B: no /a {x = @B.x and x > 5}", PROVED),
        ("after /b as B {x = 7}: no /a {x = @B.x}", VACUOUS),
        ("after /b as B: /a {x = @B.x} causes /c {x = @B.x} within 20 ms", PROVED),
    ],
)
def test_values_that_opened_the_scope_are_any(claim: str, expected: Result) -> None:
    assert answer(claim).result is expected
