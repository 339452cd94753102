# SPDX-License-Identifier: Apache-2.0
"""Plans: parts in order, messages that wait for each other, and the rates that assumptions allow."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import find, given, settings
from hypothesis import strategies as st

from haros_ci.test_files.property_tests.plans import (
    Input,
    Spacing,
    Step,
    as_json,
    between,
    either,
    in_order,
    one,
    pause,
    perhaps,
    plans,
    settled,
    spaced,
)

A, B = Input("/a", st.just({"data": 1})), Input("/b", st.just({"data": 2}))
FEW = settings(max_examples=200, database=None, derandomize=True)


def topics(plan: Any) -> list[Any]:
    return [step.topic for step in plan]


@FEW
@given(plans(between(1, 2, A), one(B), settled()))
def test_parts_come_in_order(plan: Any) -> None:
    assert topics(plan) in (["/a", "/b", None], ["/a", "/a", "/b", None])
    assert plan[-1].settled and not plan[0].settled


@pytest.mark.parametrize(
    ("part", "sent"),
    [
        (between(0, 2), []),
        (one(), []),
        (in_order(one(A), one(B)), ["/a", "/b"]),
        (either(one(A), one(B)), ["/a"]),
        (perhaps(one(A), one(B)), []),
        (in_order(pause(0.5), one(A)), [None, "/a"]),
    ],
)
def test_the_simplest_plan(part: Any, sent: list[Any]) -> None:
    assert topics(find(plans(part), lambda plan: True, settings=FEW)) == sent


@FEW
@given(plans(between(1, 2, A, B), silent=("/b",)))
def test_nothing_is_sent_on_silent_topics_and_more_on_the_others(plan: Any) -> None:
    assert topics(plan) in (["/a"], ["/a", "/a"])


def test_a_message_can_ask_for_an_earlier_one() -> None:
    first = Input("/a", st.integers(1, 9), "A")
    second = Input("/b", lambda seen: st.just(seen["A"] + 1))

    @FEW
    @given(plans(one(first), one(second)))
    def test(plan: Any) -> None:
        assert plan[1].message == plan[0].message + 1

    test()


@pytest.mark.parametrize(
    ("steps", "spacings", "waits"),
    [
        (["/a", "/a"], [Spacing("/a", "/a", 1.0)], [0.0, 1.001]),
        (["/a", "/b", "/a"], [Spacing("/a", "/a", 1.0)], [0.0, 0.0, 1.001]),
        (["/a", "/b"], [Spacing("/a", "/b", 1.0)], [0.0, 1.001]),
        (["/b", "/a"], [Spacing("/a", "/b", 1.0)], [0.0, 0.0]),
        (["/a", "/a"], [Spacing("/a", "/a", 1.0, lambda sent: sent > 1)], [0.0, 0.0]),
        (["/a", "/a"], [Spacing("/a", "/a", 1.0, None, lambda sent: sent > 1)], [0.0, 0.0]),
        (["/a", "/a"], [Spacing("/a", "/a", 1.0, lambda sent: sent == 1)], [0.0, 1.001]),
        (["/a", "/a"], [], [0.0, 0.0]),
    ],
)
def test_messages_keep_the_distance_that_is_assumed(
    steps: list[str], spacings: list[Spacing], waits: list[float]
) -> None:
    assert [step.after for step in spaced([Step(topic, 1) for topic in steps], spacings)] == waits


def test_a_distance_counts_what_lies_between() -> None:
    steps = [Step("/a", 1), Step(None, None, 0.4), Step("/b", 1, 0.3), Step("/a", 1)]
    assert [step.after for step in spaced(steps, [Spacing("/a", "/a", 1.0)])] == [0.0, 0.4, 0.3, 0.301]


def test_plans_that_send_the_same_are_the_same_data() -> None:
    assert as_json((Step("/a", {"x": 1}, 0.5), Step(None, None, 0.0, True))) == [
        ["/a", {"x": 1}, 0.5, False],
        [None, None, 0.0, True],
    ]
