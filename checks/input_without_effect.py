# SPDX-License-Identifier: Apache-2.0
"""Subscriptions whose callback does nothing that anybody notices."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, listed
from haros_ci.api.code import callbacks


def check(project: Project) -> Iterator[Finding]:
    from haros_ci.api.dependence import unread

    code = project.code
    for callback in callbacks(code):
        if callback.kind != "subscription" or callback.routine.is_test or callback.maker.is_test:
            continue
        names = unread(code, callback)
        if names is None:
            continue
        title = callback.routine.title
        kept = listed(names)
        yield Finding(
            at=callback.location,
            message=(
                f"{title}, the callback of this subscription, only assigns to {kept}, which no code reads: the messages have "
                "no effect; remove the subscription, or use what it keeps"
            ),
            about=(title, "without effect"),
            related=((callback.routine.location, "the callback"),),
        )


CHECK = Check(
    id="input-without-effect",
    summary="Subscription whose callback has no effect.",
    level=Level.NOTE,
    tags=("code",),
    profiles=("strict",),
    project=check,
)
