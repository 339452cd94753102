# SPDX-License-Identifier: Apache-2.0
"""``haros-ci baseline``: the file of known findings is created, updated, pruned and shown."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from haros_ci.baselines import COMPACT_NAME, known_findings
from haros_ci.commands.common import Flags, run, settings_from, view_of
from haros_ci.commands.timings import with_timings
from haros_ci.config.settings import Settings
from haros_ci.errors import EXIT_TOOL_TROUBLE, UserError
from haros_ci.results.result import Report
from haros_ci.results.rule import Level
from haros_ci.writing import write

if TYPE_CHECKING:
    from haros_ci.model.workspace import Workspace
    from haros_ci.results.known import ComparedFiles, KnownFinding


@with_timings
def create(flags: Flags) -> int:
    """``haros-ci baseline create``: today's findings become known; a file that holds any is written anew under ``--force`` only."""
    from haros_ci.report.summary import plural
    from haros_ci.results.compact import write_compact
    from haros_ci.results.counted import is_counted
    from haros_ci.results.known import known_from_results

    settings, report, workspace = looked_at(flags)
    sides = compared(settings, report, workspace)
    known = known_from_results(report.results)
    path = baseline_path(flags, settings)
    if not flags["force"] and not report.failed_tools() and _holds_another(path, write_compact(known)):
        help = "'haros-ci baseline update --accept-new' adds to it and keeps its reasons; '--force' writes it anew"
        raise UserError(f"{path} exists already. {_difference(path, settings, report, sides)}", help=help)
    metrics = sum(map(is_counted, report.results))
    joined = len(report.results) - len(view_of(workspace, flags, to_file=False).joined(report).results)
    parts = [f"{metrics} of them metrics beyond limits, which check only counts"] if metrics else []
    parts += [f"check shows {joined} of them together with others like them"] if joined else []
    return keep(
        flags,
        known,
        report,
        ", ".join((f"{plural(len(known), 'finding')} {'is' if len(known) == 1 else 'are'} known now", *parts)),
    )


def _holds_another(path: Path, text: str) -> bool:
    """Whether a file with other contents stands there; devices, pipes and files that mktemp has made hold nothing.

    Nor do links: whoever writes refuses them.
    """
    return not path.is_symlink() and path.is_file() and path.stat().st_size > 0 and path.read_bytes() != text.encode()


def _difference(path: Path, settings: Settings, report: Report, sides: ComparedFiles) -> str:
    """What a baseline of *report* would add to the one at *path*, what it would take away."""
    from haros_ci.report.summary import plural
    from haros_ci.report.text import one_line
    from haros_ci.results.counted import is_set_aside
    from haros_ci.results.pairing import pair

    try:
        before = known_findings(replace(settings, baseline=str(path), baseline_rev=None))
    except UserError:
        return "It holds no known findings that can be read, so it may be something else"
    open_ones = [result for result in report.results if not is_set_aside(result)]
    pairs = pair(open_ones, before, sides)
    taken = {found.new for found in pairs}
    new = [result for index, result in enumerate(open_ones) if index not in taken]
    reasons = sum(bool(known.reason) for known in before)
    parts = [
        f"To write it anew would add {plural(len(new), 'finding')}",
        f"take away {plural(len(before) - len(pairs), 'finding')}",
    ]
    if reasons:
        parts.append(f"lose the reasons of {plural(reasons, 'finding')}")
    first = f"; the first one to be added: {one_line(new[0])}" if new else ""
    return f"{', '.join(parts[:-1])} and {parts[-1]}{first}"


@with_timings
def update(flags: Flags) -> int:
    """``haros-ci baseline update``: known findings follow the code; new ones join under ``--accept-new`` only."""
    from haros_ci.results.upkeep import update as updated

    settings, report, sides = examined(flags)
    before = known_file(flags, settings)
    known = updated(before, report.results, sides, accept_new=flags["accept_new"])
    return keep(flags, known, report, f"{len(before)} findings were known, {len(known)} are now")


@with_timings
def prune(flags: Flags) -> int:
    """``haros-ci baseline prune``: what is gone is dropped."""
    from haros_ci.results.upkeep import prune as pruned

    settings, report, sides = examined(flags)
    before = known_file(flags, settings)
    known = pruned(before, report.results, sides)
    return keep(flags, known, report, f"{len(before) - len(known)} of {len(before)} known findings are gone")


def show(flags: Flags) -> int:
    """``haros-ci baseline show``: what the file holds, one finding a line."""
    from haros_ci.report.escape import log_line

    settings = settings_from({"paths": (), "isolated": True})
    for known in known_file(flags, settings):
        scope = f" in {known.scope}" if known.scope else ""
        reason = f" ({known.reason})" if known.reason else ""
        click.echo(log_line(f"{known.path}{scope}: {known.template} [{known.tool}:{known.rule}]{reason}"))
    return 0


def examined(flags: Flags) -> tuple[Settings, Report, ComparedFiles]:
    """Today's findings without any baseline, and the files as the matcher asks for them."""
    settings, report, workspace = looked_at(flags)
    return settings, report, compared(settings, report, workspace)


def looked_at(flags: Flags) -> tuple[Settings, Report, Workspace]:
    """Today's findings without any baseline, and where they are."""
    settings = replace(settings_from({**flags, "no_baseline": True}), with_copies=True)
    report, workspace = run(settings, flags)
    return settings, report, workspace


def compared(settings: Settings, report: Report, workspace: Workspace) -> ComparedFiles:
    """The files as the matcher asks for them."""
    from haros_ci.results.known import sides

    return sides(workspace, report.runs, settings.paths)


def known_file(flags: Flags, settings: Settings) -> tuple[KnownFinding, ...]:
    path = baseline_path(flags, settings)
    if not path.exists():
        raise UserError(f"{path}: no such baseline", help="haros-ci baseline create writes one")
    return known_findings(replace(settings, baseline=str(path), baseline_rev=None))


def baseline_path(flags: Flags, settings: Settings) -> Path:
    return Path(flags["file"]).absolute() if flags.get("file") else settings.root / COMPACT_NAME


def keep(flags: Flags, known: tuple[KnownFinding, ...], report: Report, message: str) -> int:
    """Write the file, unless a tool failed: its findings would be missing from it."""
    from haros_ci.results.compact import write_compact

    settings = settings_from({**flags, "no_baseline": True})
    path = baseline_path(flags, settings)
    if failed := report.failed_tools():
        click.echo(f"error: {', '.join(failed)} failed, so {path} is left as it is", err=True)
        for run in report.runs:
            for note in run.notifications:
                if note.level is Level.ERROR:
                    click.echo(f"  {run.tool.name}: {note.message}", err=True)
        return EXIT_TOOL_TROUBLE
    write(write_compact(known), path)
    click.echo(f"{path}: {message}.")
    return 0
