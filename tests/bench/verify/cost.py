# SPDX-License-Identifier: Apache-2.0
"""What the search costs: chains of nodes, each with ``causes`` and ``requires`` of equal data, in seconds of the processor.

    python tests/bench/verify/cost.py [--limit 30] [--nodes 2,4,6] [--depths 6,10,14]

Of each chain one question with no counterexample at that depth, as plain search without proofs sees it (``no``: the source never sends more than 5,
so nor does the last node; ``within``: the last node answers in time), and one with a counterexample (``no`` of 5). Runs of exactly one length are
asked for, not the shorter ones before it; -- stands for more than the limit. At last, how 60 properties that share one cone are asked for together and one by one.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[3])]

import z3

from haros_ci.behaviour.parser import parse_property
from haros_ci.verification.bounded import bounded
from haros_ci.verification.cones import cone
from haros_ci.verification.fields import Fields
from haros_ci.verification.patterns import Formula
from haros_ci.verification.problem import Claim, Member, Network, Problem

MS = 1_000_000


def chain(nodes: int, network: Network, claims: list[str]) -> Problem:
    """Nodes n1 … that make /t1 of /t0, /t2 of /t1, and so on."""
    members = [Member("/n0", frozenset(("/t0",)), {})]
    members += [Member(f"/n{n}", frozenset((f"/t{n}",)), {f"/t{n - 1}": 10}) for n in range(1, nodes + 1)]
    axioms = [("/n0", "globally: no /t0 {x > 5}")]
    for n in range(1, nodes + 1):
        axioms.append((f"/n{n}", f"globally: /t{n - 1} as A causes /t{n} {{x = @A.x}} within 10 ms"))
        axioms.append((f"/n{n}", f"globally: /t{n} as B requires /t{n - 1} {{x = @B.x}} within 10 ms"))
    stated = [Claim(k, text, parse_property(text), node=node) for k, (node, text) in enumerate(axioms)]
    asked = [Claim(1000 + k, text, parse_property(text)) for k, text in enumerate(claims)]
    return Problem(tuple(members), tuple(stated), tuple(asked), network)


def spent() -> float:
    return sum(os.times()[:2])


def ask(problem: Problem, claims: tuple[Claim, ...], depth: int, limit: float) -> tuple[str, float]:
    """The answers for *claims* together, and the seconds."""
    begun = spent()
    fields = Fields()
    fields.add((*problem.axioms, *claims))
    runs = bounded(problem, cone(problem, claims[0]), fields, depth)
    answers = set()
    for claim in claims:
        runs.solver.push()
        formula = Formula(claim, runs.run)
        runs.solver.add(*formula.constraints)
        answers.add(str(runs.check(formula.violated, seconds=limit)))
        runs.solver.pop()
    return ", ".join(sorted(answers)), spent() - begun


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--limit", type=float, default=30)
    parser.add_argument("--nodes", default="2,4,6")
    parser.add_argument("--depths", default="6,10,14")
    flags = parser.parse_args()
    depths = [int(depth) for depth in flags.depths.split(",")]
    print(f"z3 {z3.get_version_string()}")
    print("| network, nodes | question |" + "".join(f" {depth} events |" for depth in depths))
    print("|---|---|" + "---|" * len(depths))
    for name, network in (("instant", Network()), ("async", Network(True, 0, 5 * MS))):
        for nodes in map(int, flags.nodes.split(",")):
            late = 10 * nodes + (5 * nodes if network.is_async else 0)
            questions = {
                "no, holds": f"globally: no /t{nodes} {{x > 5}}",
                "within, holds": f"globally: /t0 as A causes /t{nodes} {{x = @A.x}} within {late} ms",
                "no, violated": f"globally: no /t{nodes} {{x > 4}}",
            }
            for question, text in questions.items():
                cells = []
                for depth in depths:
                    problem = chain(nodes, network, [text])
                    answer, seconds = ask(problem, problem.claims, depth, flags.limit)
                    cells.append(f" {'--' if answer == 'unknown' else f'{seconds:.1f} {answer}'} |")
                print(f"| {name}, {nodes} | {question} |{''.join(cells)}", flush=True)
    texts = [f"globally: no /t2 {{x > 5 and x < {n + 6}}}" for n in range(60)]
    for name, network in (("instant", Network()), ("async", Network(True, 0, 5 * MS))):
        problem = chain(2, network, texts)
        _, together = ask(problem, problem.claims, 8, flags.limit)
        alone = sum(ask(problem, (claim,), 8, flags.limit)[1] for claim in problem.claims)
        print(f"60 properties, {name}, 8 events: together {together:.1f} s, one by one {alone:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
