# SPDX-License-Identifier: Apache-2.0
"""A proof by composition: its links, what their bounds come to, and up to which latency of the network they suffice."""

from __future__ import annotations

from haros_ci.behaviour.text import time_text
from haros_ci.behaviour.tree import PatternKind
from haros_ci.records import dataclass
from haros_ci.verification.problem import MILLISECOND, Claim, Problem


@dataclass(frozen=True, slots=True)
class Proof:
    """Its links in words, the axioms, the sum of their bounds in nanoseconds (None: one has none), and how often a message is received."""

    links: tuple[str, ...]
    axioms: tuple[int, ...]
    bound: int | None
    hops: int

    def then(self, other: Proof) -> Proof:
        total = None if self.bound is None or other.bound is None else self.bound + other.bound
        return Proof(
            tuple(dict.fromkeys((*self.links, *other.links))),
            tuple(dict.fromkeys((*self.axioms, *other.axioms))),
            total,
            self.hops + other.hops,
        )

    def beside(self, other: Proof) -> Proof:
        """Both, of which either may happen."""
        bound = None if self.bound is None or other.bound is None else max(self.bound, other.bound)
        joined = self.then(other)
        return Proof(joined.links, joined.axioms, bound, max(self.hops, other.hops))


NOTHING = Proof((), (), 0, 0)


def sentence(problem: Problem, claim: Claim, proof: Proof) -> tuple[str, ...]:
    """The links of a proof, and what their bounds come to."""
    found = list(proof.links)
    pattern = claim.stated.pattern
    if proof.bound is not None and pattern.kind is not PatternKind.NO:
        total = time_text(proof.bound / 1000 / MILLISECOND)
        network = problem.network
        if network.is_async and proof.hops and network.high is not None:
            latency = time_text(network.high / 1000 / MILLISECOND)
            found.append(f"together within {total} and {proof.hops} times a latency of at most {latency}")
        else:
            found.append(f"together within {total}")
    return tuple(found)


def suffices(problem: Problem, claim: Claim, proof: Proof) -> bool:
    """Whether the bounds of a proof keep that of the claim."""
    window = claim.window
    if window is None or claim.stated.pattern.kind is PatternKind.NO:
        return True
    if proof.bound is None:
        return False
    network = problem.network
    if not network.is_async or not proof.hops:
        return proof.bound <= window
    return network.high is not None and proof.bound + proof.hops * network.high <= window


def greatest_latency(problem: Problem, claim: Claim, proof: Proof) -> int | None:
    """The greatest latency of an asynchronous network at which a proof keeps the claim's bound, in nanoseconds; None where there is none."""
    window = claim.window
    if not problem.network.is_async or window is None or proof.bound is None or not proof.hops or proof.bound > window:
        return None
    return (window - proof.bound) // proof.hops
