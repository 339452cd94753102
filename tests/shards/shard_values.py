# SPDX-License-Identifier: Apache-2.0
"""A shard made of literals."""

from __future__ import annotations

from haros_ci.model.location import Location
from haros_ci.results.result import Result, Run, Tool
from haros_ci.results.rule import Level
from haros_ci.shards.shard import Failed, Had, Header, RecordedAnswer, Shard, WorkspaceRun

KEYS = tuple(digit * 64 for digit in "0123456789abcdef")

HEADER = Header(
    version="0.1.0",
    number=1,
    of=2,
    workspace="w" * 64,
    base=None,
    settings={"profile": "p", "select": "s"},
    tools=(Had("cppcheck", "head", "2.17", "f"), Had("pylint", "head", None, "")),
    plan="d" * 64,
    confined="files-network",
)
RUN = Run(
    Tool("haros-ci", "0.1.0"),
    results=(Result("haros-ci", "topic-type-mismatch", Level.ERROR, "m", Location("a.launch", 1)),),
    architecture=True,
)
SHARD = Shard(
    HEADER,
    answers=(
        RecordedAnswer("cppcheck", 'odd "name", [x].cpp', KEYS[0], 1200, '{"rules":[],"gave_up":[]}'),
        RecordedAnswer("cppcheck", "src/é\udc80.cpp", KEYS[1], None, '{"rules":[],"gave_up":[["no",3]]}'),
    ),
    failures=(Failed("cppcheck", "cppcheck failed: x", ("b.cpp",), (KEYS[2],)),),
    wholes=(WorkspaceRun("architecture", "head", 5_000_000, RUN),),
)
