# SPDX-License-Identifier: Apache-2.0
"""Transforms at a message's time, asked for without waiting for them."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Project, syntax
from haros_ci.api.code import ASKED, call_place, in_callbacks, is_lookup, nodes, type_name

LOOKUPS = frozenset(("lookupTransform", "lookup_transform"))
FILTERS = ("tf2_ros::MessageFilter", "tf::MessageFilter", "tf2_ros/message_filter")
OLD = frozenset(("tf::TransformListener", "tf::Transformer", "tf.TransformListener"))


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    seen: set[int] = set()
    paths = code.mentioning("lookupTransform", "lookup_transform")
    filtered = code.mentioning(*FILTERS)
    for reached in in_callbacks(code):
        made = reached.callback
        if (
            reached.routine.path not in paths
            or made.maker.is_test
            or made.kind != "subscription"
            or made.maker.path in filtered
        ):
            continue
        calls = code.body(reached.routine).calls
        if ASKED.intersection(call.name for call in calls):
            continue
        for call in calls:
            if id(call) in seen or call.name not in LOOKUPS or len(call.args) not in (3, 4) or call.receiver is None:
                continue
            if not is_lookup(code, reached.routine, call):
                continue
            is_old = type_name(code, reached.routine, call.receiver) in OLD
            at_stamp = any(isinstance(node, syntax.Member) and node.name == "stamp" for node in nodes(call.args[2]))
            if not at_stamp or (len(call.args) == 4 and not is_old):
                continue
            seen.add(id(call))
            yield Finding(
                at=call_place(reached.routine, call),
                message=f"the look-up at the time stamp of a message in {made.routine.title} has no timeout: the transform "
                "usually arrives later than the message, so the look-up fails and the message is lost; pass a timeout, "
                "or use a tf2_ros::MessageFilter",
                about=(made.routine.title, reached.routine.title, call.name),
                flow=reached.flow(call, "looks up a transform here"),
            )


CHECK = Check(
    id="transform-without-timeout",
    summary="Transform look-up at a message's time without a timeout.",
    level=Level.NOTE,
    decidability=Decidability.HEURISTIC,
    profiles=("strict",),
    tags=("code", "tf"),
    project=check,
)
