# SPDX-License-Identifier: Apache-2.0
"""Random systems, looked at in three networks: the monitor must confirm each counterexample, and nothing that is proved may have one."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from monitoring.traces import PATTERNS, SCOPES, drawn

from haros_ci.behaviour.parser import parse_property
from haros_ci.verification.outcomes import Result
from haros_ci.verification.problem import Claim, Limits, Member, Network, Problem

MS = 1_000_000
MEMBERS = (
    Member("/n1", frozenset(("/a", "/b")), {"/d": 2}),
    Member("/n2", frozenset(("/c",)), {"/a": 1, "/b": 10}),
    Member("/n3", frozenset(("/b",)), {"/c": 0, "/a": 2}),
)
NETWORKS = {
    "instant": Network(),
    "async": Network(True, 0, 3 * MS),
    "async with loss": Network(True, 1 * MS, 4 * MS, True),
}


def system(draw: random.Random, depth: int) -> Problem:
    """Axioms of the whole, which chains are made of, are more frequent than others; in every third system all is of one scope."""
    shared = parse_property(str(drawn(draw, "no", draw.choice(SCOPES)))).scope if draw.random() < 1 / 3 else None

    def claim(number: int, node: str) -> Claim:
        scope = draw.choice(SCOPES) if draw.random() < 0.4 and shared is None else "globally"
        made = parse_property(str(drawn(draw, draw.choice(PATTERNS), scope)))
        return Claim(number, "", made if shared is None else replace(made, scope=shared), node=node)

    axioms = tuple(claim(n, draw.choice(("/n1", "/n2", "/n3", ""))) for n in range(draw.randrange(2, 6)))
    return Problem(MEMBERS, axioms, tuple(claim(100 + n, "") for n in range(3)), limits=Limits(depth, 20))


#: What opens and closes scopes of chains; nodes receive both topics.
OPENINGS = ("globally", "after /go", "after /go {x = 1}", "until /stop", "until (/stop or /go {x = 2})", "after /go until /stop", "after /go as G until /stop {x = @G.x}")  # fmt: skip
LINKS = (
    ("/src", "no /a {x > 2}"), ("/first", "/a as A causes /b {x = @A.x} within 2 ms"), ("/first", "/b as B requires /a {x = @B.x} within 2 ms"),
    ("/second", "/b as B causes /c {x = @B.x} within 2 ms"), ("/second", "/c as C requires /b {x = @C.x} within 2 ms"), ("/first", "no /b {x = 1}"),
    ("/second", "/b {x = 0} causes /c within 1 ms"), ("/first", "/b requires (/a or /go) within 2 ms"),
)  # fmt: skip
ASKED = ("/a as A causes /c {x = @A.x} within 4 ms", "/c as C requires /a {x = @C.x} within 4 ms", "no /c {x > 2}", "no /b {x = 1}", "no /c {x = 1}",
         "/a causes /c within 4 ms", "/b {x = 0} causes /c within 2 ms", "/c requires (/a or /go) within 4 ms", "no /a {x = 3}")  # fmt: skip
CHAIN = (
    Member("/src", frozenset(("/a", "/go", "/stop")), {}),
    Member("/first", frozenset(("/b",)), {"/a": 1, "/go": 1, "/stop": 1}),
    Member("/second", frozenset(("/c",)), {"/b": 10, "/go": 1, "/stop": 1}),
)


def chained(draw: random.Random, depth: int) -> Problem:
    """Systems of which much is proved: links of a chain, and questions about it, of one scope for the most part."""
    scope = draw.choice(OPENINGS)

    def claim(number: int, node: str, pattern: str) -> Claim:
        mine = draw.choice(OPENINGS) if draw.random() < 0.3 else scope
        return Claim(number, "", parse_property(f"{mine}: {pattern}"), node=node)

    links = [link for link in LINKS if draw.random() < 0.75]
    axioms = tuple(claim(n, node, pattern) for n, (node, pattern) in enumerate(links))
    claims = tuple(claim(100 + n, "", pattern) for n, pattern in enumerate(draw.sample(ASKED, 4)))
    return Problem(CHAIN, axioms, claims, limits=Limits(depth, 20))


def wrong(made: Problem, seen: Counter[str]) -> Iterator[str]:
    """What must not be, in sentences; *seen* counts the answers."""
    from haros_ci.verification import groups
    from haros_ci.verification.search import findings

    for name, network in NETWORKS.items():
        problem = replace(made, network=network)
        found = {finding.number: finding for finding in findings(problem)}
        for finding in found.values():
            seen[f"{name}: {finding.result.value}"] += 1
            if "disagrees" in finding.reason:
                yield f"{name}, {finding.number}: {finding.reason}"
        proved = tuple(claim for claim in problem.claims if found[claim.number].result is Result.PROVED)
        usual, groups.suffices = groups.suffices, lambda *_: False
        try:
            answers = list(findings(replace(problem, claims=proved)))
        finally:
            groups.suffices = usual
        for finding in answers:
            if finding.result is Result.VIOLATED:
                yield f"{name}, {finding.number}: proved and violated"
