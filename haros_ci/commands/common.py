# SPDX-License-Identifier: Apache-2.0
"""What each command does: flags become settings, the pipeline runs, texts are written, an exit code results."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from haros_ci.baselines import COMPACT_NAME
from haros_ci.commands.output import (
    FOLDERS,
    PAGES,
    SILENT,
    Extras,
    Outputs,
    RendererError,
    Renderers,
    parse_outputs,
    rendered,
)
from haros_ci.commands.standard_input import settled, with_buffer
from haros_ci.commands.timings import with_timings
from haros_ci.config.settings import Settings
from haros_ci.errors import EXIT_TOOL_TROUBLE, RunFailure, UserError
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Report
from haros_ci.streams import write_to_stderr
from haros_ci.timing import remark, stage, timed
from haros_ci.workspace.cache import DiskCache, MemoryCache, cache_directory
from haros_ci.writing import write

if TYPE_CHECKING:
    from haros_ci.analysis.architectures import Architectures

Flags = Mapping[str, Any]
Progress = Callable[[str], None]
Made = TypeVar("Made")


def check(flags: Flags) -> int:
    """``haros-ci check``: analyse, write every output asked for, and give the exit code of design.md."""
    flags = settled(flags)
    if flags.get("watch"):
        from haros_ci.commands.watch import watch

        return watch(flags)
    if flags["shard"] is not None:
        from haros_ci.commands.shard import shard

        return shard(flags)
    return checked(flags)


@with_timings
def checked(flags: Flags) -> int:
    """One run, all at once."""
    settings = with_buffer(settings_from(flags), flags)
    renderers = renderers_of(settings)
    outputs = parse_outputs(flags["output"], renderers)
    if flags["show_settings"]:
        from haros_ci.config.describe import describe

        click.echo(describe(settings), nl=False)
        return 0
    demand_base(settings)
    settings = replace(settings, is_measured=any(format in (*PAGES, *FOLDERS) for format, _ in outputs))
    report, workspace, known = run_with_systems(settings, flags)
    demand_baseline(report, settings)
    if flags["diff"] or flags["fix"]:
        from haros_ci.commands.fixing import mend, show_patch

        if flags["diff"]:
            warn_of_missing_base(settings)
            return show_patch(report, workspace, settings)
        is_mended = mend(report, workspace, settings)
    if flags["fix"] and is_mended:
        report, workspace, known = run_with_systems(settings, flags)
    return reported(report, workspace, outputs, renderers, settings, flags, known)


def reported(
    report: Report,
    workspace: Workspace,
    outputs: Outputs,
    renderers: Renderers,
    settings: Settings,
    flags: Flags,
    known: Architectures | None = None,
) -> int:
    """Write every output, and give the exit code; *known* has the systems that the run has made."""
    warn_of_missing_base(settings, outputs)
    is_whole = written(report, workspace, outputs, renderers, settings, flags, known)
    on_stdout = [format for format, path in outputs if path is None]
    if flags["statistics"]:
        from haros_ci.report.statistics import render

        shown = view_of(workspace, flags, to_file=False).joined(report)
        click.echo(render(shown), err=any(format != "text" for format in on_stdout), nl=False)
    if not flags.get("quiet") and (not on_stdout or SILENT.intersection(on_stdout)):
        from haros_ci.report.text import summary_line

        shown = view_of(workspace, flags, to_file=False).joined(report)
        click.echo(summary_line(shown), err=True)
    return exit_code(report, settings) if is_whole else EXIT_TOOL_TROUBLE


@timed("render")
def written(
    report: Report,
    workspace: Workspace,
    outputs: Outputs,
    renderers: Renderers,
    settings: Settings,
    flags: Flags,
    known: Architectures | None = None,
) -> bool:
    """Write every output; False if one could not be made or not whole, which is said."""
    from haros_ci.report.escape import terminal

    is_whole = True
    folders = [path for format, path in outputs if format in FOLDERS and path is not None]
    if folders:
        from haros_ci.commands.folders import fill

        is_whole = fill(folders, report, workspace, settings, flags, known)
    if any(format in PAGES for format, _ in outputs):
        from haros_ci.commands.report import fill as fill_pages

        is_whole = fill_pages(outputs, report, workspace, settings, flags, known) and is_whole
    for format, path in outputs:
        if format in (*FOLDERS, *PAGES):
            continue
        view = view_of(workspace, flags, to_file=path is not None)
        try:
            text = rendered(report, format, view, renderers)
        except RendererError as err:
            click.echo(f"error: {terminal(str(err))}", err=True)
            is_whole = False
            continue
        try:
            write(text, path)
        except RunFailure as err:  # no room for this one; the others are written all the same
            write_to_stderr(f"error: {terminal(err.message)}", f"help: {terminal(err.help or '')}")
            is_whole = False
    return is_whole


def view_of(workspace: Workspace, flags: Flags, *, to_file: bool) -> Extras:
    """What a renderer may ask for of *workspace*."""
    packages = {file.path: file.package or "" for file in workspace.files}
    return Extras(workspace.text, flags, to_file, lambda path: packages.get(path, ""))


def demand_base(settings: Settings) -> None:
    """Refuse to begin where the base revision that was asked for cannot be had, unless ``--no-require-baseline`` says to go on.

    Without it every old finding would be reported as new. UserError (2), or RunFailure (3) under ``--require-baseline``.
    """
    if settings.base_missing:
        _refuse_without(settings.base_missing, settings)


def demand_baseline(report: Report, settings: Settings) -> None:
    """The same of a baseline of which only the analysis shows that it cannot be had."""
    if report.baseline is not None and not report.baseline.available:
        _refuse_without(report.baseline.message or report.baseline.source, settings)


def _refuse_without(why: str, settings: Settings) -> None:
    if settings.require_baseline is False:
        return
    message = f"no baseline, so nothing is reported: {why.rstrip('.')}"
    help = "with --no-require-baseline every finding is reported as new"
    raise (RunFailure if settings.require_baseline else UserError)(message, help=help)


def warn_of_missing_base(settings: Settings, outputs: Outputs = ()) -> None:
    """Say on stderr that the base revision cannot be had, unless one of *outputs* is text to be read there and then."""
    if settings.base_missing and ("text", None) not in outputs:
        from haros_ci.report.escape import terminal

        click.echo(f"warning: No baseline: {terminal(settings.without_base)}", err=True)


def renderers_of(settings: Settings) -> Mapping[str, Callable[[Report], str]]:
    """The formats that plug-ins bring."""
    if not settings.plugins:
        return {}
    from haros_ci.registry import registry

    return registry(settings).renderers


def exit_code(report: Report, settings: Settings) -> int:
    """3 before 1 before 0 (design.md: tool trouble is never green)."""
    if set(report.failed_tools()) - settings.allow_tool_failure:
        return EXIT_TOOL_TROUBLE
    if settings.require_baseline and (
        settings.base_missing or report.baseline is None or not report.baseline.available
    ):
        return EXIT_TOOL_TROUBLE
    return 1 if report.failing() else 0


def run(settings: Settings, flags: Flags) -> tuple[Report, Workspace]:
    """Analyse under a cache."""
    return run_with_systems(settings, flags)[:2]


def run_with_systems(settings: Settings, flags: Flags) -> tuple[Report, Workspace, Architectures]:
    """The same, with the systems that the run has made, for outputs that show them."""

    def analysed(store: DiskCache | MemoryCache, progress: Progress) -> tuple[Report, Workspace, Architectures]:
        with stage("loading"):
            from haros_ci.analysis.architectures import Architectures
            from haros_ci.pipeline import analyse

        known = Architectures(settings, store)
        return *analyse(settings, store, progress=progress, architectures=known), known

    return under_cache(analysed, settings, flags)


def under_cache(work: Callable[[DiskCache | MemoryCache, Progress], Made], settings: Settings, flags: Flags) -> Made:
    """What *work* makes with a cache, saying on stderr what is being done when a person watches."""
    from haros_ci.commands.collector import without_collector
    from haros_ci.plugins.stdout import kept_clean

    without_collector()
    store = store_for(settings)
    watched = sys.stderr.isatty() and not os.environ.get("CI") and not flags.get("quiet")

    def progress(what: str) -> None:
        if watched:
            click.echo(f"\r\x1b[K{what}", nl=False, err=True)

    try:
        with kept_clean(bool(settings.plugins)):
            made = work(store, progress)
    finally:
        if watched:
            click.echo("\r\x1b[K", nl=False, err=True)
        problem = store.flush()
        if problem:
            click.echo(f"warning: {problem}", err=True)
    remark(f"cache: {store.stats}")
    return made


def store_for(settings: Settings) -> DiskCache | MemoryCache:
    return MemoryCache() if settings.cache_dir is None else DiskCache(settings.cache_dir)


# -- settings -----------------------------------------------------------------------------------------------------


@timed("settings")
def settings_from(flags: Flags) -> Settings:
    """Flags and project file as one value; on a pull request (``--baseline-rev``) the file is the base revision's."""
    from haros_ci.config.load import load
    from haros_ci.workspace.roots import locate

    place = locate(tuple(flags["paths"]), Path.cwd(), may_be_new=flags.get("is_buffer", False))
    command_line: dict[str, Any] = {
        "paths": place.paths,
        "profile": flags.get("profile"),
        "select": flatten(flags.get("select")),
        "ignore": flatten(flags.get("ignore")),
        "exclude": tuple(flags.get("exclude") or ()),
        "fail_on": flags.get("fail_on"),
        "jobs": flags.get("jobs") or cores(),
        "compile_database": flags.get("compile_database"),
        "exact": flags.get("exact"),
        "imports": tuple(flags.get("imports") or ()),
        "plugins": plugins_of(flags),
        "plugin_whitelist": flatten(flags.get("plugin_whitelist")),
        "plugin_blacklist": flatten(flags.get("plugin_blacklist")),
        "plugin_export": flags.get("plugin_export"),
        "baseline": flags.get("baseline"),
        "baseline_rev": flags.get("baseline_rev"),
        "no_baseline": flags.get("no_baseline") or False,
        "require_baseline": flags.get("require_baseline"),
        "allow_tool_failure": frozenset(flags.get("allow_tool_failure") or ()),
        "cache_dir": cache_dir(flags, place.root),
    }
    loaded = partial(
        load,
        place.root,
        start=place.start,
        project=Path(flags["project"]) if flags.get("project") else None,
        isolated=flags.get("isolated") or False,
        trust_config=flags.get("trust_config") or False,
        command_line=command_line,
    )
    settings = settings_at(place.root, flags.get("baseline_rev"), loaded)
    unnamed = settings.baseline is None and settings.baseline_rev is None and not flags.get("no_baseline")
    if unnamed and (place.root / COMPACT_NAME).is_file():
        settings = replace(settings, baseline=COMPACT_NAME)
    return settings


def settings_at(root: Path, rev: str | None, loaded: Callable[..., Settings]) -> Settings:
    """What *loaded* makes of the project file: of that on disk, or, with *rev*, of the base revision's and no other.

    If that cannot be had, no file that a change could have brought counts.
    """
    if rev is None:
        return loaded()
    from haros_ci.workspace.base_commit import base_commit
    from haros_ci.workspace.git import BaselineUnavailable

    try:
        base = base_commit(root, rev)
        return replace(loaded(base=base), base=(base.top, base.commit))
    except BaselineUnavailable as err:
        return loaded(base_missing=str(err))


def plugins_of(flags: Flags) -> tuple[str, ...]:
    """The plug-ins that the command line names, and then those of the environment."""
    return (*flatten(flags.get("plugin")), *os.environ.get("HAROS_CI_PLUGINS", "").replace(",", " ").split())


def flatten(groups: tuple[tuple[str, ...], ...] | None) -> tuple[str, ...]:
    return tuple(word for group in groups or () for word in group)


def cores() -> int:
    """The processors that this process may use, not those that the machine has."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def cache_dir(flags: Flags, root: Path) -> Path | None:
    if flags.get("no_cache"):
        return None
    named = Path(flags["cache_dir"]).absolute() if flags.get("cache_dir") else None
    return cache_directory(named, os.environ, root, explicit=named is not None)
