# SPDX-License-Identifier: Apache-2.0
"""``haros-ci monitor --export``: what other tools need to record what the properties are about."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.monitored import Chosen
from haros_ci.errors import UserError
from haros_ci.report.escape import terminal
from haros_ci.report.rosmonitoring import rosmonitoring
from haros_ci.writing import write

TARGETS = ("rosmonitoring",)


def target_of(flags: Mapping[str, Any]) -> Path | None:
    """The file that ``--export`` names, None for standard output; UserError for wrong usage."""
    name, _, path = flags["export"].partition("=")
    if name not in TARGETS:
        raise UserError(f"--export {name}: no such format", help=f"one of: {', '.join(TARGETS)}")
    if flags["bag"] is not None or flags["jsonl"] is not None or flags["output"]:
        raise UserError(
            "--export reads no recording and has no other output", help="leave --bag, --jsonl and --output out"
        )
    return Path(path) if path else None


def export(picked: Chosen, target: Path | None) -> int:
    """Write the configuration of ROSMonitoring for the topics of the properties, or for all where none is stated; exit code 0."""
    topics = {topic for item in picked.properties for topic in item.monitor.topics} or set(picked.types)
    texts = list(dict.fromkeys(item.text for item in picked.properties))
    written = rosmonitoring(picked.configuration, picked.ros, topics, picked.types, texts)
    for note in picked.notes:
        click.echo(f"note: {terminal(note)}", err=True)
    if written is None:
        raise UserError("there is no topic to record whose type is known", help="name the system: --configuration NAME")
    for gap in written.gaps:
        click.echo(f"warning: {terminal(gap)}", err=True)
    write(written.text, target)
    return 0
