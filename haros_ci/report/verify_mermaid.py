# SPDX-License-Identifier: Apache-2.0
"""Counterexamples as Mermaid sequence diagrams, for job summaries and other Markdown that GitHub shows.

A message that is received at once is an arrow to each receiver; one that is received later is a note where it is published, and an arrow where it
arrives.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.report.escape import markdown
from haros_ci.report.model_mermaid import MAX_TEXT, label
from haros_ci.report.verify_text import ShownFinding, ShownRun, ShownStep, Verification, values_text

#: Diagrams of one summary.
MOST_DIAGRAMS = 10


def render(found: Verification) -> str:
    """Markdown: a heading, the reason and a diagram for each property that is violated."""
    broken = [one for one in found.properties if one.run is not None]
    if not broken:
        return f"No counterexample in {markdown(found.configuration)}.\n"
    parts = [f"### Counterexamples in {markdown(found.configuration)}\n"]
    parts += [_block(one) for one in broken[:MOST_DIAGRAMS]]
    if len(broken) > MOST_DIAGRAMS:
        parts.append(f"{len(broken) - MOST_DIAGRAMS} more are not drawn.\n")
    return "\n".join(parts)


def _block(one: ShownFinding) -> str:
    assert one.run is not None
    head = f"**{markdown(one.title)}**: {markdown(one.sentence)}\n"
    drawn = diagram(one.run)
    if len(drawn) > MAX_TEXT:
        return f"{head}\nToo large for a diagram here: `--output text` has the run.\n"
    return f"{head}\n```mermaid\n{drawn}```\n"


def diagram(run: ShownRun) -> str:
    """The sequence diagram of a run, without a fence."""
    names = list(dict.fromkeys(name for step in run.steps for name in _participants(step, run)))
    ids = {name: f"n{number}" for number, name in enumerate(names)}
    lines = [f"participant {ids[name]} as {plain(name)}" for name in names] or ["participant n0 as nobody"]
    for number, step in enumerate(run.steps):
        if run.loop == number:
            lines.append(f"loop every {run.period:g} s, for ever")
        lines += _event(step, run, ids)
    if run.loop is not None:
        lines.append("end")
    last = f",n{len(names) - 1}" if len(names) > 1 else ""
    ends = "violated" if run.violated is None else f"violated at {run.violated:g} s"
    silent = "nothing more comes: " if run.loop is None else ""
    lines.append(f"Note over n0{last}: {silent}{ends}")
    return "\n".join(["sequenceDiagram", *(f"  {line}" for line in lines)]) + "\n"


def plain(text: str) -> str:
    """*text* without quotes; every character that Mermaid or Markdown could act on is an entity."""
    return label(text)[1:-1]


def _participants(step: ShownStep, run: ShownRun) -> Iterator[str]:
    yield step.node
    if step.receives and step.of is not None:
        yield run.steps[step.of].node
    yield from (node for node, _ in step.receivers)


def _event(step: ShownStep, run: ShownRun, ids: dict[str, str]) -> Iterator[str]:
    what = plain(f"{step.time:g} s {step.topic}{values_text(step.values)}{f' - {step.role}' if step.role else ''}")
    own = ids[step.node]
    if step.receives and step.of is not None:
        yield f"{ids[run.steps[step.of].node]}-){own}: {what}"
    elif step.receivers:
        yield from (f"{own}->>{ids[node]}: {what}" for node, _ in step.receivers)
    else:
        yield f"Note over {own}: {what}"
