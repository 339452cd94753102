# SPDX-License-Identifier: Apache-2.0
"""``haros-ci check --watch``: a run whenever a file has changed, and what that made new or mended."""

from __future__ import annotations

import gc
from collections.abc import Callable
from pathlib import Path
from signal import SIGINT
from time import monotonic, sleep

import click

from haros_ci.commands.common import Flags, demand_base, renderers_of, run, settings_from, written
from haros_ci.commands.output import Outputs, Renderers, parse_outputs, text_style
from haros_ci.commands.timings import timings
from haros_ci.config.settings import Settings
from haros_ci.errors import EXIT_INTERRUPTED, UserError
from haros_ci.interruption import Interrupted
from haros_ci.records import dataclass, field
from haros_ci.report.escape import terminal
from haros_ci.report.summary import notifications, plural
from haros_ci.results.result import Notification, Report, Result
from haros_ci.results.stable_id import stable_ids
from haros_ci.workspace.signature import Signature, changes, signature

INTERVAL = 1.0  # seconds between looks
QUIET = 0.3  # seconds without a change before a run begins: an editor or git writes several files
MOST_LOOKS = 20  # for quiet; then the run begins all the same
SHARE = 10  # a look that takes long is made less often: at most every tenth second is spent on looking
MAX_NAMED = 5
Changed = tuple[tuple[str, str], ...]


def watch(flags: Flags) -> int:
    """Run, wait for a change, run again, until Ctrl-C."""
    refuse(flags)
    settings = settings_from(flags)
    demand_base(settings)
    renderers = renderers_of(settings)
    watched = Watch(flags, settings, renderers, on_files(parse_outputs(flags["output"], renderers)))
    try:
        follow(watched.look, watched.check, sleep, monotonic)
    except (KeyboardInterrupt, Interrupted) as err:
        if isinstance(err, Interrupted) and err.number != SIGINT:
            raise
        click.echo("\nstopped", err=True)
    return EXIT_INTERRUPTED


def refuse(flags: Flags) -> None:
    """UserError for flags that make no sense while a person edits."""
    for name in ("fix", "diff", "show_settings", "shard", "statistics"):
        if flags.get(name):
            option = name.replace("_", "-")
            raise UserError(
                f"--watch and --{option} do not go together", help=f"run haros-ci check --{option} by itself"
            )


def on_files(outputs: Outputs) -> Outputs:
    """The *outputs* into files, written anew by each run; UserError if anything but text is to go to stdout."""
    for format, path in outputs:
        if path is None and format != "text":
            raise UserError(f"--watch shows text, not {format}", help=f"give the format a file: --output {format}=FILE")
    return tuple((format, path) for format, path in outputs if path is not None)


def follow(
    look: Callable[[], Signature],
    check: Callable[[Changed], None],
    sleep: Callable[[float], None],
    now: Callable[[], float],
) -> None:
    """Call *check* at first, and then with what has changed once that is at rest; ends only by an exception.

    What changes while *check* works is seen afterwards, as the state before it counts.
    """
    seen = look()
    check(())
    while True:
        started = now()
        current = look()
        if current == seen:
            sleep(max(INTERVAL, SHARE * (now() - started)))
            continue
        for _ in range(MOST_LOOKS):
            sleep(QUIET)
            before, current = current, look()
            if current == before:
                break
        if changed := changes(seen, current):
            seen = current
            check(changed)


@dataclass(slots=True)
class Watch:
    """One watching: the settings as they are now, and the findings of the last run by their ids."""

    flags: Flags
    settings: Settings
    renderers: Renderers
    outputs: Outputs
    known: dict[str, Result] = field(default_factory=dict)
    reported: frozenset[Notification] = frozenset()
    last: Signature = field(default_factory=dict)
    has_run: bool = False

    def look(self) -> Signature:
        """The state of what a run would read; the last one while the directory is away (a checkout, a mount)."""
        settings = self.settings
        database = settings.compile_database
        named = (self.flags.get("project"), settings.baseline, *settings.imports, database)
        more = [Path(name).absolute() for name in named if name]
        more += [Path(database, "compile_commands.json").absolute()] if database else []
        own = [path for _, path in self.outputs if path] + ([settings.cache_dir] if settings.cache_dir else [])
        try:
            self.last = signature(settings.root, settings.paths, exclude=settings.exclude, more=more, but=own)
        except UserError:
            if not self.has_run:
                raise
        return self.last

    def check(self, changed: Changed) -> None:
        """Run and say what is new and what is gone; a mistake in the project file is said, and waited on."""
        if changed:
            click.echo(headline(changed))
        try:
            if changed:
                self.settings = settings_from(self.flags)
            with timings(self.flags):
                self._checked(first=not self.has_run)
        except UserError as err:
            if not self.has_run:
                raise
            click.echo(f"error: {terminal(err.message)}", err=True)
            if err.help:
                click.echo(f"help: {terminal(err.help)}", err=True)
        gc.collect()  # a run is made without the collector
        click.echo(
            f"watching {plural(sum(state is not None for state in self.last.values()), 'file')}; Ctrl-C ends", err=True
        )

    def _checked(self, *, first: bool) -> None:
        from haros_ci.report import text

        report, workspace = run(self.settings, self.flags)
        self.has_run = True
        written(report, workspace, self.outputs, self.renderers, self.settings, self.flags)
        color, width = text_style(to_file=False)
        style = {"color": color, "width": width, "why": self.flags["why"], "source": workspace.text}
        new, removed = self._compared(report)
        known, self.reported = self.reported, frozenset(notifications(report))
        if first:
            click.echo(text.render(report, **style), nl=False)
            return
        click.echo(text.findings(new, **style), nl=False)
        for result in removed:
            click.echo(f"gone: {text.one_line(result)}")
        click.echo(text.closing(report, known=known, color=color), nl=False)
        click.echo(f"since the last run: {len(new):,} new, {len(removed):,} gone")

    def _compared(self, report: Report) -> tuple[tuple[Result, ...], tuple[Result, ...]]:
        """The open findings that the last run did not have, and those that this one has not.

        What a tool that failed now had found before is not gone: it is kept until the tool works again.
        """
        open_ones = set(map(id, report.shown()))
        now = {id_: result for id_, result in stable_ids(report.results) if id(result) in open_ones}
        failed = set(report.failed_tools())
        new = tuple(result for id_, result in now.items() if id_ not in self.known)
        missing = {id_: result for id_, result in self.known.items() if id_ not in now}
        removed = tuple(result for result in missing.values() if result.tool not in failed)
        self.known = now | {id_: result for id_, result in missing.items() if result.tool in failed}
        return new, removed


def headline(changed: Changed) -> str:
    """``--- 2 files changed: a.py, b.py (new)``."""
    named = [terminal(path) + (f" ({how})" if how != "changed" else "") for path, how in changed[:MAX_NAMED]]
    more = [f"and {len(changed) - MAX_NAMED:,} more"] if len(changed) > MAX_NAMED else []
    return f"\n--- {plural(len(changed), 'file')} changed: {', '.join([*named, *more])}"
