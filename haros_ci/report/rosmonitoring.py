# SPDX-License-Identifier: Apache-2.0
"""A configuration of ROSMonitoring that logs topics, as its README states the format ("Configuration Reference", d03aa5b of the repository).

There is one monitor, without an oracle and without ``publishers`` or ``subscribers``: it listens only, and nothing has to be remapped. Its log is one
that ``haros-ci monitor --jsonl`` reads.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: What can stand in the file as it is.
_TOPIC = regex(r"/[A-Za-z0-9_/]{1,300}", re.ASCII)
_TYPE = regex(r"([A-Za-z]\w{0,200})/(?:msg/)?([A-Za-z]\w{0,200})", re.ASCII)
_UNFIT = regex(r"\W+", re.ASCII)
MOST_PROPERTIES = 1_000


@dataclass(frozen=True, slots=True)
class ExportedLog:
    """The *text* of the configuration, and the topics that are not in it, a sentence for each."""

    text: str
    gaps: tuple[str, ...]


def rosmonitoring(
    configuration: str, ros: int, topics: Iterable[str], types: Mapping[str, tuple[str, ...]], properties: Iterable[str]
) -> ExportedLog | None:
    """What logs *topics*, of which *types* has those that are known; None if none of them can be. *properties* are named in a comment."""
    rows: list[str] = []
    gaps: list[str] = []
    for topic in sorted(set(topics)):
        known = types.get(topic)
        type_ = _TYPE.fullmatch(known[0]) if known is not None and len(known) == 1 else None
        if type_ is None or _TOPIC.fullmatch(topic) is None:
            gaps.append(f"{topic} is left out: {_why(known)}")
            continue
        rows += [
            f"        - name: {topic}",
            f"          type: {type_[1]}.msg.{type_[2]}",
            "          action: log",
        ]
    if not rows:
        return None
    name = _UNFIT.sub("_", configuration)[:100] or "all"
    shown = [json.dumps(text) for text in properties][:MOST_PROPERTIES]
    lines = [
        "# Written by haros-ci: ROSMonitoring logs these topics, and the properties are held against its log by",
        f"#   haros-ci monitor --jsonl ./logs/haros_ci_{name}.jsonl",
        *(f"#     {text}" for text in shown),
        f"ros_version: ros{ros}",
        "monitors:",
        "  - monitor:",
        f"      id: haros_ci_{name}",
        f"      log: ./logs/haros_ci_{name}.jsonl",
        "      topics:",
        *rows,
    ]
    return ExportedLog("\n".join((*lines, "")), tuple(gaps))


def _why(types: tuple[str, ...] | None) -> str:
    if types is None:
        return "no node of the configuration has it"
    if len(types) > 1:
        return f"its ends have several types ({', '.join(types[:3])})"
    return "its type or name is not one of ROS" if types else "its type is not known"
