# SPDX-License-Identifier: Apache-2.0
"""Programs that are generated, and run beside their model (``tests/bench/run_oracle.py``): a few of them, for each client library of Python."""

from __future__ import annotations

import pytest

from tests.bench.run_judge import Run
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


RULED_OUT = """#!/usr/bin/env python3
import random
import rospy
from std_msgs.msg import String
LIMIT = 1
def nested(name, depth):
    if depth > 0:
        rospy.Publisher(name, String, queue_size=1)
        nested(name + "/d", depth - 1)
if __name__ == "__main__":
    rospy.init_node("n")
    if LIMIT > 3:
        rospy.Publisher({}, String, queue_size=1)
    {}
    rospy.spin()
"""
KNOWN, DRAWN = 'nested("a", 1)', 'nested("a", random.randint(1, 4))'


@pytest.mark.parametrize(
    ("name", "call", "made", "problem"),
    [
        (
            "input()",
            DRAWN,
            "a/d/d/d",
            "missing, said",
        ),  # the end that is ruled out may have that name; so may what the gap stands for
        ("input()", KNOWN, "b", "ruled out"),
        ('"b"', DRAWN, "b", "ruled out"),
        ('"b"', KNOWN, "b", "ruled out"),
    ],
)
def test_what_is_ruled_out_and_made_is_seen(name: str, call: str, made: str, problem: str) -> None:
    problems, _ = judge(RULED_OUT.format(name, call), [Run([("publishers", made, "String", 1)], "")])
    assert [found for found in problems if found.startswith(("missing", "ruled out"))] == [
        f"{problem}: publishers /{made} String"
    ]
