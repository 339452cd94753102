# SPDX-License-Identifier: Apache-2.0
"""What the checks and the project file's queries say of the architecture, added to the run of our own."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from haros_ci.analysis.architectures import Architectures, options_of, project_of
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.forks import shared
from haros_ci.model.architecture import Architecture
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.registry import Registry
from haros_ci.results import own
from haros_ci.results.result import Notification, Run
from haros_ci.results.rule import Level, Rule
from haros_ci.timing import stage, timed
from haros_ci.workspace.views import View

if TYPE_CHECKING:  # they are loaded where there is something to check
    from haros_ci.analysis.kept_findings import KeptFindings
    from haros_ci.analysis.same_model import Moved
    from haros_ci.checking.check import Check
    from haros_ci.checking.project import Project
    from haros_ci.checking.system import System
    from haros_ci.checking.unseen import Held, Part
    from haros_ci.systems.link import Linked
    from haros_ci.workspace.base import Base

Progress = Callable[[str], None]

#: Whose notes it is that something of the architecture is not known.
ARCHITECTURE = "architecture"
#: Of so few files the checks are done before another process is there.
FEW = 50


@timed("checks")
def inspected(
    run: Run,
    workspace: Workspace,
    selection: Selection,
    architectures: Architectures,
    progress: Progress | None,
    base: Base | None = None,
) -> Run:
    """*run* with what the checks and queries say of the architecture, where any of them is on; what changed since *base*."""
    settings, known = architectures.settings, architectures.registry
    if not is_inspected(workspace, selection, settings, known):
        return run
    with stage("loading"):
        from haros_ci.analysis.views import in_views, same_view

    def look(view: View) -> Run:
        past = replace(base, workspace=same_view(base.workspace, view)) if base is not None else None
        return _inspected(run, view.workspace, selection, architectures, progress, past)

    return in_views(run, workspace, settings.project_file, look)


def _held(
    findings: KeptFindings, base: Base | None, workspace: Workspace, made: Linked, moved: Moved | None
) -> Held | None:
    """What was found at the *base* and holds in *workspace*, where code has *moved* alone."""
    if base is None or moved is None:
        return None
    return findings.get(base.workspace, workspace, made.builds, moved)


def _inspected(
    run: Run,
    workspace: Workspace,
    selection: Selection,
    architectures: Architectures,
    progress: Progress | None,
    base: Base | None,
) -> Run:
    """The same of a workspace in which no two packages have the same name."""
    settings, known = architectures.settings, architectures.registry
    chosen = chosen_checks(workspace, selection, known)
    with stage("loading"):
        from haros_ci.analysis.cut_short import cut_short
        from haros_ci.analysis.kept_findings import KeptFindings, parts_of
        from haros_ci.analysis.launch_faults import refused
        from haros_ci.analysis.same_model import moved_lines
        from haros_ci.analysis.unmodelled import lacking
        from haros_ci.checking.all_checks import OF_CHANGES, run_all
        from haros_ci.checking.run import Assigned
        from haros_ci.checking.system import System, systems

    if progress is not None:
        progress("architecture")
    moved = None if base is None or settings.plugins else moved_lines(base, workspace, architectures.store)
    if base is None:
        made = architectures.kept(workspace)
    elif moved is None:
        made = architectures.of(workspace)
    else:
        made = architectures.kept(workspace, base.workspace, moved.lines)
    found = made.architecture

    def under(system: System, arguments: Assigned) -> System | None:
        configuration = made.under(system.name, dict(arguments))
        return None if configuration is None else System(configuration, found, workspace)

    if progress is not None:
        progress(f"{len(chosen)} checks")
    all_systems = tuple(systems(found, workspace))
    past, renames = _past(base, architectures), base.renames if base else None
    where = settings.project_file or ""
    access = settings.access
    seen = project_of(made, workspace, all_systems, past, renames, project_file=where, access=access)
    project = architectures.seen(seen.without_changes() if moved is not None and moved.is_all else seen)
    processes = settings.jobs if len(workspace.files) > FEW else 1
    share = partial(shared, processes=processes, here=OF_CHANGES)
    old = base.workspace if base is not None else None
    kept, of = architectures.keeping(), base.workspace if base is not None and moved is not None else workspace
    before = kept.sentences(of) if kept is not None else None
    beside = partial(lacking, made, workspace, settings) if before is None else partial(tuple[str, ...], before)
    findings = KeptFindings(options_of(settings, known), architectures.store)
    parts: tuple[Part, ...] = ()
    if kept is not None and base is None:
        parts = parts_of(made, workspace, where, tuple(access))
    held = _held(findings, base, workspace, made, moved) if kept is not None else None
    of_systems, of_project, changes, sentences = run_all(
        chosen, all_systems, project, own.TOOL, under, share, old, beside, parts, held
    )
    if parts:
        findings.put(workspace, made.builds, of_systems, of_project)
    if kept is not None and before is None:
        kept.put_sentences(of, sentences)
    failures = (*of_systems.notifications, *of_project.notifications)
    faults = tuple(refused(workspace))
    cut: tuple[Problem, ...] = ()
    if base is not None:
        cut = tuple(cut_short(found.problems, _problems_before(base, architectures), base.renames))
    as_findings = {(fault.path, fault.line) for fault in (*faults, *cut)}
    run = replace(
        run,
        results=(
            *run.results,
            *own.launch_results(faults),
            *own.cut_results(cut),
            *of_systems.results,
            *of_project.results,
        ),
        notifications=(
            *run.notifications,
            *failures,
            *(
                Notification(Level.NOTE, p.message, ARCHITECTURE, p.path, p.line)
                for p in (*found.problems, *project.problems)
                if (p.path, p.line) not in as_findings
            ),
            *(Notification(Level.NOTE, sentence, ARCHITECTURE) for sentence in sentences),
        ),
        graphs=of_systems.graphs,
        architecture=not failures,
        successful=run.successful and not failures,
        changes=changes,
    )
    return queried(run, found, workspace, settings, selection) if asks(settings) else run


def inspected_or_kept(
    run: Run,
    workspace: Workspace,
    selection: Selection,
    architectures: Architectures,
    progress: Progress | None,
    base: Base | None,
) -> Run:
    """*run* with what ``inspected`` finds, from the cache if all that this depends on is as it was."""
    settings, known = architectures.settings, architectures.registry
    if settings.plugins or settings.exact or not is_inspected(workspace, selection, settings, known):
        # nobody knows what a plug-in reads, and headers of the machine may change
        return inspected(run, workspace, selection, architectures, progress, base)
    from haros_ci.analysis.kept_runs import kept_run

    def make(workspace: Workspace, base: Base | None) -> Run:
        bare = replace(run, analysed=frozenset())
        return inspected(bare, workspace, selection, architectures, progress, base)

    found = kept_run(ARCHITECTURE, make, workspace, base, options_of(settings, known), architectures.store)
    return replace(found, tool=run.tool, analysed=run.analysed)


def is_inspected(workspace: Workspace, selection: Selection, settings: Settings, known: Registry) -> bool:
    """Whether the architecture is needed: a check is on or a query may be asked, and not only of single files."""
    return not only_files(workspace, settings) and (asks(settings) or bool(chosen_checks(workspace, selection, known)))


def chosen_checks(workspace: Workspace, selection: Selection, known: Registry) -> tuple[Check, ...]:
    """The checks that are on in any file."""
    return tuple(check for check in known.checks if is_on(known.check_rules[check.id], workspace, selection))


def _past(base: Base | None, architectures: Architectures) -> Callable[[], Project | None]:
    """How the base revision is had, where there is one."""

    def make() -> Project | None:
        from haros_ci.checking.system import systems

        if base is None:
            return None
        made = architectures.kept(base.workspace)
        return project_of(made, base.workspace, tuple(systems(made.architecture, base.workspace)))

    return make


def _problems_before(base: Base, architectures: Architectures) -> Callable[[], Iterable[Problem]]:
    """What could not be analysed at the base revision."""
    return lambda: architectures.kept(base.workspace).architecture.problems


@timed("queries")
def queried(run: Run, found: Architecture, workspace: Workspace, settings: Settings, selection: Selection) -> Run:
    """*run* with the matches of the project file's queries."""
    from haros_ci.query import queries

    where = settings.project_file or "the project file"
    requested = queries.run(
        found, settings.project, where, workspace.files, is_selected=lambda rule: is_on(rule, workspace, selection)
    )
    return replace(
        run,
        results=(*run.results, *requested.results),
        notifications=(*run.notifications, *requested.notifications),
        architecture=run.architecture and not requested.failed,
    )


def is_on(rule: Rule, workspace: Workspace, selection: Selection) -> bool:
    """Whether *rule* is on in any file."""
    return selection.wants_any(own.TOOL, (rule,), (file.path for file in workspace.files))


def only_files(workspace: Workspace, settings: Settings) -> bool:
    """Whether nothing but single files was asked for: of them alone no architecture is made, unless its profile asks."""
    paths = {file.path for file in workspace.files}
    return settings.profile != "architecture" and all(path in paths for path in settings.paths)


def asks(settings: Settings) -> bool:
    """Whether the project file may have queries."""
    return "rules" in settings.project or "configurations" in settings.project
