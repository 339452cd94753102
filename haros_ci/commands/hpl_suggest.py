# SPDX-License-Identifier: Apache-2.0
"""``haros-ci hpl suggest``: properties that the code suggests, as blocks for a project file with the evidence as comments."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import click

from haros_ci.analysis.code_of import code_of
from haros_ci.analysis.suggesting import suggested
from haros_ci.commands.common import cores, settings_from, store_for
from haros_ci.commands.model import selected, tell
from haros_ci.report.escape import terminal
from haros_ci.workspace.discover import discover

#: Characters in a line of evidence.
WIDTH = 400


def suggest(flags: Mapping[str, Any]) -> int:
    """Extract, follow, print; 0, or 2 for wrong usage."""
    from haros_ci.analysis.architecture import varied

    settings = settings_from({**flags, "paths": (), "no_baseline": True})
    workspace = discover(settings.root, settings.paths, exclude=settings.exclude, max_file_size=settings.max_file_size)
    store = store_for(settings)
    made = varied(workspace, settings, store, alternatives=False, processes=cores())
    if problem := store.flush():
        click.echo(f"warning: {problem}", err=True)
    found = selected(made.architecture, flags["configuration"])
    tell(tuple(dict.fromkeys((*workspace.problems, *workspace.faults, *found.problems))))
    every = suggested(found, code_of(made, workspace))
    click.echo("\n".join(lines(every)))
    return 0


def lines(every: Mapping[str, tuple[tuple[str, tuple[str, ...]], ...]]) -> Iterator[str]:
    """A project file with the suggestions of each configuration; the evidence stands above each property."""
    yield "# Suggested by the code, and not checked by anybody: keep what is meant."
    if not any(every.values()):
        yield "# Nothing is suggested: no callback is seen to publish each time, or to be alone in that."
        return
    yield "configurations:"
    for name, found in every.items():
        if not found:
            continue
        yield f"  {_quoted(name)}:"
        yield "    hpl:"
        yield "      properties:"
        for text, evidence in found:
            for sentence in evidence:
                yield f"        # {terminal(sentence)[:WIDTH]}"
            yield f"        - {_quoted(text)}"


def _quoted(text: str) -> str:
    """*text* as YAML in single quotes."""
    return "'" + terminal(text).replace("'", "''") + "'"
