# SPDX-License-Identifier: Apache-2.0
"""The table of contents: from settings to a report, each stage a function from values to values."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from haros_ci import PROJECT_URL, __version__
from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.inspection import inspected_or_kept, is_inspected
from haros_ci.analysis.public_copies import quiet
from haros_ci.baselines import at_base, compare, left_out, read_input, sarif_runs, settled
from haros_ci.brought import Unreadable, before, notices, silenced, unreadable
from haros_ci.commented import uncommented
from haros_ci.config.selection import Selection
from haros_ci.config.selector import check_selectors, slip_finder
from haros_ci.config.settings import PROFILES, Settings
from haros_ci.hosting import hosted
from haros_ci.linters import catalogue
from haros_ci.linters.brought_otherwise import notifications as brought_otherwise
from haros_ci.linters.duplicates import drop_unfounded, merge_same_defects
from haros_ci.linters.metrics import keep_worst_band
from haros_ci.linters.one_cause import one_cause
from haros_ci.linters.one_file import one_file
from haros_ci.linters.recorded import Testimony
from haros_ci.linters.run import lint
from haros_ci.linters.said_by_ours import said_once
from haros_ci.linters.settings_changes import notifications as changed_settings
from haros_ci.linting import (
    confinement,
    contradictions,
    has_structure,
    lint_options,
    reported_rules,
    split_refuted,
    weighed,
    with_metrics,
    with_names,
    with_queries,
    with_refuted,
    with_silenced,
    without_hints,
    worth_reporting,
)
from haros_ci.measuring.ahead import measured_meanwhile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.refuted import missing, refuted_since
from haros_ci.registry import Registry
from haros_ci.results import own
from haros_ci.results.called_again import notes as calls_again
from haros_ci.results.coverage import coverage
from haros_ci.results.fingerprint import fingerprint
from haros_ci.results.result import Artifact, Notification, Report, Result, Run, Tool, distribute, results_of
from haros_ci.results.rule import Level, Rule
from haros_ci.results.suppress import suppress
from haros_ci.timing import timed
from haros_ci.workspace.base import Base
from haros_ci.workspace.discover import discover
from haros_ci.workspace.left_out import LeftOut
from haros_ci.workspace.provenance import provenance

Progress = Callable[[str], None]
#: What is found out of a whole revision at once: what the checks say of its architecture, and what only all its code tells.
ARCHITECTURE, STRUCTURE = "architecture", "structure"

#: That of the head and of the base revision, once it is clear what they are.
Recorded = Callable[[Workspace, Base | None], tuple[Testimony, Testimony | None]]


def analyse(
    settings: Settings,
    store: Store,
    *,
    progress: Progress | None = None,
    recorded: Recorded | None = None,
    architectures: Architectures | None = None,
) -> tuple[Report, Workspace]:
    """The whole run: what *settings* ask for, with what is known already taken from *store*; and what was analysed.

    With *recorded*, the results of the tools come from other machines, and no tool is run here. *architectures* keep the systems.
    """
    architectures = architectures or Architectures(settings, store)
    selection, misfits = selection_of(settings, architectures.registry)
    workspace = found(settings, selection)
    selection = selection.over(workspace.package_finder())
    with at_base(workspace, settings) as base:
        past = base if isinstance(base, Base) else None
        changed = changed_settings(workspace, past.workspace if past and past.settings else None)
        then = past.workspace if past else None
        changed += brought_otherwise(workspace, then)
        workspace = settled(workspace, settings, base)
        head, old = (None, None) if recorded is None else recorded(workspace, past)
        left = left_out(workspace, settings, base)

        @cache
        def before_it(it: Workspace) -> tuple[Run, ...]:
            narrow = narrowed(it, settings, selection)
            return examine(narrow, selection.over(it.package_finder()), architectures, progress, testimony=old)

        def since(raw: tuple[Run, ...]) -> Unreadable:
            is_revision = settings.baseline is None
            return unreadable(workspace, past, raw, (lambda base: before_it(base.workspace)) if is_revision else None)

        runs = examine(workspace, selection, architectures, progress, past, head, left, since)
        runs = tuple(described(run, selection) for run in (*runs, *imported(settings, workspace, selection)))
        compared = compare(runs, workspace, settings, base, examine=before_it)
        bare = None if recorded else uncommented(architectures, selection, narrowed, selected)
        silence = silenced(workspace, settings, base, compared.runs, before_it, bare)
        noticed = (
            *notices(workspace, past, silence),
            *refuted_since(workspace, settings, past, compared.runs, before_it),
        )
        if past is not None and settings.baseline is None:
            noticed += calls_again(results_of(compared.runs), workspace, past.workspace, past.renames)
    notes = (*settings.notes, *misfits, *idle_entries(runs, workspace, settings))
    report = Report(
        # absent results bring rules of their own
        runs=tuple(described(run, selection) for run in weighed(compared.runs, compared.baseline, selection)),
        notifications=(
            *(Notification(Level.NOTE, note, configuration=True) for note in notes),
            *changed,
            *compared.notifications,
            *(Notification(Level.WARNING, p.message, path=p.path, line=p.line) for p in workspace.problems),
            *noticed,
        ),
        baseline=compared.baseline,
        coverage=coverage(workspace, confinement(runs, settings, head), left.unused.found, left.copies.found),
        artifacts=tuple(Artifact(f.path, f.digest, f.size, f.language) for f in workspace.files),
        provenance=provenance(workspace.root),
        fail_on=settings.fail_on,
        silenced=silence,
    )
    return report, workspace


def selection_of(settings: Settings, known: Registry) -> tuple[Selection, tuple[str, ...]]:
    """Which rules are on, and sentences on selectors that name none; UserError for those that cannot be meant."""
    rules = with_queries(settings, known)
    names: dict[str, Any] = {"unserved": catalogue.UNSERVED, "open_tools": known.open_ended}
    names |= {"doubt": known.doubt, "identifiers": known.identifiers}
    misfits = check_selectors(settings, rules, known.tools, linters=known.adapters, **names)
    slip = slip_finder(settings, rules, known.tools, **names)
    return Selection(settings, rules, unlisted=known.unlisted, slip=slip), (*misfits, *contradictions(settings, known))


def found(settings: Settings, selection: Selection) -> Workspace:
    """The workspace as it is now."""
    workspace = discover(
        settings.root,
        settings.paths,
        exclude=settings.exclude,
        max_file_size=settings.max_file_size,
        also=settings.claims,
        past=before(settings),
        buffer=settings.buffer,
    )
    return quiet(narrowed(workspace, settings, selection), settings)


def narrowed(workspace: Workspace, settings: Settings, selection: Selection) -> Workspace:
    """The workspace with HAROS's ``packages`` and ``analysis.ignore.files`` as targets; unchanged without them.

    The project file is of no package, and what is wrong in it is always reported.
    """
    if not settings.packages and not settings.ignore_files:
        return workspace
    place = {package.name: package.path for package in workspace.packages}
    targets = []
    for file in workspace.files:
        home = place.get(file.package or "", ".")
        inside = file.path if home == "." else file.path.removeprefix(f"{home}/")
        is_selected = not settings.packages or file.package in settings.packages or file.path == settings.project_file
        if is_selected and workspace.reports_on(file.path) and not selection.ignores_file(file.package, inside):
            targets.append(file.path)
    package_of = workspace.package_finder()
    for problem in workspace.hiding.unread:
        if not settings.packages or package_of(problem.path) in settings.packages:
            targets.append(problem.path)
    return replace(workspace, targets=frozenset(targets))


@timed("findings")
def examine(
    workspace: Workspace,
    selection: Selection,
    architectures: Architectures,
    progress: Progress | None,
    base: Base | None = None,
    testimony: Testimony | None = None,
    left: LeftOut | None = None,
    since: Callable[[tuple[Run, ...]], Unreadable] | None = None,
) -> tuple[Run, ...]:
    """What the tools say of one revision: selected, suppressed and fingerprinted; not yet compared with a baseline.

    With *base*, the revision before, they also report what has changed. Answers in *testimony* are used instead of running tools; *left* are the
    files that linters do not report on; *since* tells what the linters cannot analyse since then.
    """
    left = left or LeftOut(workspace)
    known, store = architectures.registry, architectures.store
    options = lint_options(architectures.settings, known)
    raw = lint(
        workspace, known.linters, options, store, selection.wants, progress, testimony.lint if testimony else None
    )
    raw, lost = (raw, ()) if since is None else since(raw)
    raw = split_refuted(with_silenced(raw, workspace, selection))
    own_one = own_run(workspace, known)
    if testimony is None:
        with measured_meanwhile(workspace, architectures, is_head=since is not None):
            own_one = inspected_or_kept(own_one, workspace, selection, architectures, progress, base)
    elif is_inspected(workspace, selection, architectures.settings, known):
        own_one = replace(testimony.whole(ARCHITECTURE), tool=own_one.tool, analysed=own_one.analysed)
    own_one = replace(own_one, results=(*own_one.results, *lost))
    if has_structure(workspace, selection):
        raw = (
            *raw,
            structured(workspace, architectures, progress) if testimony is None else testimony.whole(STRUCTURE),
        )
    runs = (own_one, *with_metrics(raw))
    aside, again = list[Result](), list[Result]()
    every = drop_unfounded(results_of(runs), workspace.text, workspace)
    results = without_hints(selected(every, selection, workspace, left, aside), every, workspace, selection)
    named = with_names(results, workspace, selection)
    refuted = (result for run in runs for result in run.refuted)
    dropped = (*missing(results_of(runs), every), *aside, *missing(results, named), *refuted)
    runs = with_refuted(runs, (*selected(dropped, selection, workspace, left, again), *again))
    results = named
    of_plugins = hosted(workspace, selection, architectures, results, progress)
    runs, results = (*runs, *of_plugins), (*results, *selected(results_of(of_plugins), selection, workspace, left))
    merged = merge_same_defects(keep_worst_band(one_file(one_cause(results, workspace.text), workspace.text)))
    merged_runs = distribute(runs, said_once(merged, workspace.package_finder()))
    return finished(merged_runs, workspace, selection, architectures.settings, frozenset(left.found))


def structured(workspace: Workspace, architectures: Architectures, progress: Progress | None) -> Run:
    """What syntax trees and the index of the workspace tell of functions and classes."""
    from haros_ci.measuring.exceeded import exceeded_limits

    return exceeded_limits(workspace, architectures.store, architectures.settings.jobs, progress)


def imported(settings: Settings, workspace: Workspace, selection: Selection) -> tuple[Run, ...]:
    """The logs of other tools that ``--import`` names; all their rules are on unless the settings say otherwise."""
    runs = []
    for name in settings.imports:
        for run in sarif_runs(read_input(Path(name), name), name, workspace.root):
            rules = {rule.id: replace(rule, profiles=PROFILES) for rule in run.rules}
            results = []
            for result in run.results:
                rule = rules.get(result.rule) or Rule(result.rule, "", profiles=PROFILES)
                level = selection.decide(run.tool.name, rule, result.location.path, default=result.level)
                if level is not None and workspace.reports_on(result.location.path):
                    results.append(replace(result, level=level))
            runs.append(replace(run, results=tuple(results)))
    return finished(tuple(runs), workspace, selection, settings)


def finished(
    runs: tuple[Run, ...],
    workspace: Workspace,
    selection: Selection,
    settings: Settings,
    left_out: frozenset[str] = frozenset(),
) -> tuple[Run, ...]:
    """The last steps before comparison: suppressions, and an identity for each result; a comment in a file that is *left_out* is no idle one."""
    files = {file.path: file for file in workspace.files}

    def language(path: str) -> str:
        return files[path].language if path in files else ""

    runs, unused = suppress(
        runs,
        workspace.text,
        language,
        selection.matches,
        enabled=lambda tool, path: reported_rules(tool, path, selection) if path not in left_out else (),
        mentions=lambda path: path in files and files[path].has_directive,
        slip=selection.slip,
    )
    runs = distribute(runs, (*results_of(runs), *selected(unused, selection, workspace)))
    if settings.exemptions:
        from haros_ci.config.exemptions import exempt

        runs = exempt(runs, settings, selection.matches, workspace.package_finder())
    return fingerprint(runs, workspace.text, language)


def idle_entries(runs: tuple[Run, ...], workspace: Workspace, settings: Settings) -> tuple[str, ...]:
    """Notes on entries of the project file that are for nothing."""
    notes: tuple[str, ...] = ()
    if settings.exemptions:
        from haros_ci.config.exemptions import idle_entries

        notes = idle_entries(runs, workspace, settings)
    if settings.local or settings.exclude or settings.packages or settings.ignore_files:
        from haros_ci.config.unmatched import unmatched
        from haros_ci.workspace.excludes import idle

        notes = (*notes, *unmatched(settings, workspace, idle))
    return notes


def selected(
    results: Iterable[Result],
    selection: Selection,
    workspace: Workspace,
    left: LeftOut | None = None,
    aside: list[Result] | None = None,
) -> tuple[Result, ...]:
    """Those results whose rule is on for their file, at the level that the settings give them.

    Where they give none, a check's finding keeps its own level, as does what a tool says that weighs each finding, and a declared one, whose
    rules nobody has weighed. Copies of other projects have none; nor does what linters say of code that is *left* out count.
    """
    third_party = {file.path for file in workspace.files if file.third_party}
    kept = []
    for result in results:
        if not workspace.reports_on(result.location.path) or result.location.path in third_party:
            continue
        default = None if result.tool in catalogue.TOOLS and result.tool not in catalogue.WEIGHING else result.level
        level = selection.decide(result.tool, result.rule, result.location.path, default=default)
        if level is not None:
            kept.append(result if level is result.level else replace(result, level=level))
    out = left or LeftOut(workspace, is_known=False)
    return worth_reporting(kept, workspace, selection, out.among, aside, out.products.has)


def own_run(workspace: Workspace, known: Registry) -> Run:
    """What haros-ci itself says: manifests that cannot be read, and changed files that are not analysed."""
    tool = Tool(own.TOOL, __version__, PROJECT_URL, f"haros-ci {__version__}", known.components)
    seen = frozenset(f.path for f in workspace.files if workspace.reports_on(f.path))
    results = (*own.manifest_results(workspace.faults), *own.unread_results(workspace.hiding.unread))
    return Run(tool, results=results, analysed=seen)


def described(run: Run, selection: Selection) -> Run:
    """The run with the rules that its results refer to, those that are absent included."""
    if run.imported:
        return run
    ids = sorted({result.rule for result in run.results})
    return replace(run, rules=tuple(selection.rule(run.tool.name, id) for id in ids))
