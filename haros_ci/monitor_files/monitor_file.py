# SPDX-License-Identifier: Apache-2.0
"""The whole file for one configuration: the core, the program, the wrapper for its version of ROS, and what is known of the system."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.core import CORE, PROGRAM, module_text, properties_text
from haros_ci.monitor_files.literals import literal
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

HEAD = '''\
#!/usr/bin/env python3
"""A monitor of properties in HPL: holds them against the messages of a running system, or of a recording.

    python3 FILE                                       beside the system, until it is shut down
    python3 FILE --duration 60 --report verdicts.json  for a minute
    python3 FILE --jsonl run.jsonl                     a recording, without ROS

The exit code is 1 if a property is violated. Written by haros-ci monitor --generate, docs/generated-monitor.md: what is changed here is lost
when it is written again. The properties are the classes at the end of the file.
"""

'''
_UNFIT = regex(r"[^A-Za-z0-9_]+", re.ASCII)
_TYPE = regex(r"([A-Za-z]\w{0,200})/(?:(?:msg|srv)/)?([A-Za-z]\w{0,200})", re.ASCII)


@dataclass(frozen=True, slots=True)
class Watched:
    """The *configuration* ("" for none) of ROS 1 or 2, of its *topics* the types ("" where that is not known), the *publishers* in the source (node, path, line), the
    *actions* of properties by their titles, and the *qos* of subscriptions."""

    configuration: str
    ros: int
    topics: Mapping[str, str]
    publishers: Mapping[str, Sequence[tuple[str, str, int]]] = field(default_factory=dict)
    actions: Mapping[str, Sequence[Mapping[str, Any]]] = field(default_factory=dict)
    qos: Mapping[str, Mapping[str, str]] = field(default_factory=dict)


def plain_name(configuration: str) -> str:
    """What a configuration is called in the names of its file and its node."""
    return _UNFIT.sub("_", configuration)[:100].strip("_") or "all"


def type_name(types: Sequence[str] | None, ros: int, kind: str = "msg") -> str:
    """The one type of a topic or service as the client library looks it up, "" if it is not known."""
    found = _TYPE.fullmatch(types[0]) if types is not None and len(types) == 1 else None
    if found is None:
        return ""
    return f"{found[1]}/{kind}/{found[2]}" if ros == 2 else f"{found[1]}/{found[2]}"


def monitor_file(watched: Watched, described: Iterable[Described]) -> tuple[str, tuple[str, ...]]:
    """The text of the file, and a sentence for each property that is left out; the text is "" if none is left."""
    one_by_one = tuple(described)
    own, left_out = properties_text(one_by_one)
    if len(left_out) == len(one_by_one):
        return "", left_out
    run = "run_rclpy" if watched.ros == 2 else "run_rospy"
    tail = "\n".join(
        (*_system(watched), "", 'if __name__ == "__main__":', f"    sys.exit(main(SYSTEM, PROPERTIES, {run}))", "")
    )
    return HEAD + module_text((*CORE, *PROGRAM), (), f"{own}\n{tail}"), left_out


def _system(watched: Watched) -> Iterable[str]:
    yield "SYSTEM = System("
    yield f"    configuration={literal(watched.configuration)},"
    yield f"    node={literal(f'haros_ci_monitor_{plain_name(watched.configuration)}')},"
    for name in ("topics", "publishers", "actions", "qos"):
        entries = getattr(watched, name)
        if entries:
            yield f"    {name}={{"
            for key in sorted(entries):
                yield f"        {literal(key)}: {literal(entries[key])},"
            yield "    },"
    yield ")"
