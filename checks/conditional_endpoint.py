# SPDX-License-Identifier: Apache-2.0
"""Publishers and servers that others count on, but that a node makes under a condition of its code."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Channel, Check, Condition, End, Finding, Level, System

#: Conditions that make an end as soon as somebody is there to need it.
LAZY = ("getNumSubscribers", "getNumPublishers", "get_subscription_count", "get_num_connections", "current_count")
#: Statements that decide whether what is inside them happens at all.
DECIDE = ("if", "else", "switch", "catch", "#if", "case", "unless")


def check(system: System) -> Iterator[Finding]:
    for channel in (*system.topics, *system.services, *system.actions):
        if any(not giver.conditions for giver in channel.givers):
            continue
        for end in channel.givers:
            condition = _condition(end)
            if condition is None or not end.in_source or end.implicit:
                continue
            if sum(other.node is end.node for other in channel.givers) > 1:
                continue  # one in each branch
            counting = [t for t in channel.takers if not t.conditions and not t.implicit and t.node is not end.node]
            if counting:
                yield _finding(channel, end, condition, counting)


def _finding(channel: Channel, end: End, condition: Condition, counting: list[End]) -> Finding:
    effect = f"{counting[0].node} gets no {'message' if channel.kind == 'topic' else 'answer'}"
    return Finding(
        at=end.location,
        message=f"{end.node} is {_article(end.word)} of {channel} only under the condition {condition.condition or condition.statement!r}, "
        f"but {counting[0].node} is always {_article(counting[0].word)} of {channel}: if the condition is false, "
        f"{effect}; create both under the same condition",
        about=(channel, end),
        related=((condition.location, "the condition"), *((other.location, str(other)) for other in counting)),
    )


def _condition(end: End) -> Condition | None:
    deciding = [condition for condition in end.conditions if condition.statement in DECIDE]
    is_lazy = any(word in condition.condition for condition in deciding for word in LAZY)
    return None if is_lazy or not deciding else deciding[0]


def _article(word: str) -> str:
    return f"{'an' if word[0] in 'aeiou' else 'a'} {word}"


CHECK = Check(
    id="conditional-endpoint",
    summary="Publisher, subscription or service created only under a condition, while other nodes always need it.",
    level=Level.NOTE,
    catalogue="G16",
    aliases=("conditional_links",),
    tags=("topics", "services"),
    profiles=("strict",),
    run=check,
)
