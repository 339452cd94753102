# SPDX-License-Identifier: Apache-2.0
"""What a report says of how linters were confined."""

from itertools import pairwise

from haros_ci.linters import sandbox
from haros_ci.results.confined import SENTENCES, sentence


def test_machines_that_are_alike_are_one_sentence() -> None:
    for way, expected in SENTENCES.items():
        assert sentence([way]) == sentence([way, way]) == expected


def test_of_machines_that_differ_the_weakest_counts() -> None:
    for stronger, weaker in pairwise(SENTENCES):
        assert (
            sentence([weaker, stronger])
            == sentence({stronger, weaker})
            == f"On a part of the machines: {SENTENCES[weaker]}"
        )


def test_nothing_is_said_where_no_linter_has_run() -> None:
    assert sentence([]) == ""


def test_this_machine_has_a_sentence() -> None:
    assert sandbox.state() in SENTENCES
    assert sandbox.state(trusted=True) == "trusted"
