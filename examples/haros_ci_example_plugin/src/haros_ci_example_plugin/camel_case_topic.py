# SPDX-License-Identifier: Apache-2.0
"""Topics whose names have capitals, against the rule of the house."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System

#: A name of which nothing is unknown, with a capital after a small letter.
_CAMEL = re.compile(r"[^?]*[a-z][A-Z][^?]*")


def check(system: System) -> Iterator[Finding]:
    for topic in system.topics:
        if not _CAMEL.fullmatch(topic.name):
            continue
        for publisher in topic.publishers:
            if publisher.location is None:
                continue
            better = re.sub(r"(?<=[a-z])([A-Z])", r"_\1", topic.name).lower()
            yield Finding(
                at=publisher.location,
                message=f"{publisher.node} publishes {topic}: the house writes {better}",
                about=(topic, publisher),
            )


CHECK = Check(
    id="camel-case-topic",
    summary="Names of topics are lower-case words joined by underscores.",
    level=Level.NOTE,
    run=check,
)
