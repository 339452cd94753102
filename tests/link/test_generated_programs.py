# SPDX-License-Identifier: Apache-2.0
"""Programs that are generated, and run beside their model (``tests/bench/run_oracle.py``): a few of them, for each client library of Python."""

from __future__ import annotations

import pytest

from tests.bench.run_oracle import RUNS, Program, judge, run

#: Disagreements; what no run makes under its conditions is none.
KINDS = ("missing", "ruled out", "phantom")


@pytest.mark.parametrize("ros", [1, 2])
def test_the_model_of_a_program_is_what_it_does(ros: int) -> None:
    found: list[str] = []
    names = 0
    for seed in range(100, 130):
        text = Program(seed, ros).text
        problems, counts = judge(text, [run(text, chance) for chance in range(RUNS)], ros)
        found += [f"{seed}: {problem}" for problem in problems if problem.startswith(KINDS)]
        names += counts["made, name known"]
    assert not found
    assert names > 100


def test_a_wrong_model_is_seen() -> None:
    text = Program(100).text.replace(
        "def main():", 'def main():\n    rospy.Publisher("only_in_the_run", String, queue_size=1)'
    )
    problems, _ = judge(Program(100).text, [run(text, 0)])
    assert any(problem.startswith("missing") and "only_in_the_run" in problem for problem in problems)
