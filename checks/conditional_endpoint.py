# SPDX-License-Identifier: Apache-2.0
"""Ends that others count on, but that a node makes under a condition of its code."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Condition, End, Finding, Level, System

#: Conditions that make an end as soon as somebody is there to need it.
LAZY = ("getNumSubscribers", "getNumPublishers", "get_subscription_count", "get_num_connections", "current_count")
#: Statements that decide whether what is inside them happens at all.
DECIDE = ("if", "else", "switch", "catch", "#if", "case", "unless")


def check(system: System) -> Iterator[Finding]:
    for channel in (*system.topics, *system.services, *system.actions):
        for end, others in _each(channel.givers, channel.takers):
            condition = _condition(end)
            if (
                condition is None
                or any(word in condition.condition for word in LAZY)
                or not end.in_source
                or end.implicit
            ):
                continue
            counting = [
                other for other in others if not other.conditions and not other.implicit and other.node is not end.node
            ]
            same = channel.givers if end in channel.givers else channel.takers
            if counting and all(each.conditions for each in same):
                yield Finding(
                    at=end.location,
                    message=(
                        f"{end.node} is {_article(end.word)} of {channel} only if {condition.condition or condition.statement}, "
                        f"but {counting[0].node} is always {_article(counting[0].word)} of it: {_effect(end, channel)}"
                    ),
                    about=(channel, end),
                    related=((condition.location, "the condition"), *((o.location, str(o)) for o in counting)),
                )


def _each(givers: tuple[End, ...], takers: tuple[End, ...]) -> Iterator[tuple[End, tuple[End, ...]]]:
    for end in givers:
        yield end, takers
    for end in takers:
        yield end, givers


def _condition(end: End) -> Condition | None:
    return next((each for each in end.conditions if each.statement in DECIDE), None)


def _effect(end: End, channel: Channel) -> str:
    if end not in channel.givers:
        return "otherwise nobody takes what it sends"
    return "otherwise it gets no message" if channel.kind == "topic" else "otherwise it gets no answer"


def _article(word: str) -> str:
    return f"{'an' if word[0] in 'aeiou' else 'a'} {word}"


CHECK = Check(
    id="conditional-endpoint",
    summary="What other nodes need is made without a condition.",
    level=Level.NOTE,
    catalogue="G16",
    aliases=("conditional_links",),
    tags=("topics", "services"),
    profiles=("strict",),
    run=check,
)
