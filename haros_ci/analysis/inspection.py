# SPDX-License-Identifier: Apache-2.0
"""What the checks and the project file's queries say of the architecture, added to the run of our own."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from haros_ci.config.digests import settings_digests
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.forks import shared
from haros_ci.model.access import AccessRule
from haros_ci.model.architecture import Architecture
from haros_ci.model.element import Element
from haros_ci.model.workspace import Problem, Store, Workspace
from haros_ci.registry import Registry, registry
from haros_ci.results import own
from haros_ci.results.result import Notification, Run
from haros_ci.results.rule import Level, Rule
from haros_ci.timing import stage, timed
from haros_ci.workspace.views import View, views

if TYPE_CHECKING:  # they are loaded where there is something to check
    from haros_ci.analysis.architecture import Common
    from haros_ci.behaviour.declared import Stated
    from haros_ci.checking.check import Check
    from haros_ci.checking.project import Project
    from haros_ci.checking.system import System
    from haros_ci.code.codebase import Codebase
    from haros_ci.systems.link import Linked
    from haros_ci.workspace.base import Base

Progress = Callable[[str], None]

#: Whose notes it is that something of the architecture is not known.
ARCHITECTURE = "architecture"
#: Of so few files the checks are done before another process is there.
FEW = 50
#: A workspace in a run: its root, and which packages of it are seen.
_Key = tuple[Path, tuple[str, ...]]


def _key(workspace: Workspace) -> _Key:
    return workspace.root, tuple(package.path for package in workspace.packages)


class Architectures:
    """The architecture of each workspace of a run, made once: that of the base revision is asked for by both sides."""

    def __init__(self, settings: Settings, store: Store, known: Registry | None = None) -> None:
        self.settings = settings
        self.store = store
        self.registry = known or registry(settings)
        self._made: dict[_Key, Linked] = {}
        self._projects: dict[_Key, Project] = {}
        self._common: Common | None = None

    def under(self, store: Store) -> Architectures:
        """The same, what is made from now on kept in *store*; without a cache what the run has in memory counts on."""
        if self.settings.cache_dir is not None:
            self.store = store
        return self

    def project(self, workspace: Workspace) -> Project:
        """What the checks have seen of the workspace, or see of it, for who shows more of that."""
        if _key(workspace) not in self._projects:
            from haros_ci.checking.system import systems

            made = self.of(workspace)
            found = tuple(systems(made.architecture, workspace))
            where = self.settings.project_file or ""
            access = self.settings.access
            self._projects[_key(workspace)] = project_of(made, workspace, found, project_file=where, access=access)
        return self._projects[_key(workspace)]

    def seen(self, project: Project) -> Project:
        """Keep what the checks see."""
        self._projects[_key(project.workspace)] = project
        return project

    def has_made(self, workspace: Workspace) -> bool:
        """Whether the systems of *workspace* are there already."""
        return _key(workspace) in self._made

    def of(self, workspace: Workspace) -> Linked:
        with stage("loading"):
            from haros_ci.analysis.architecture import Common, varied
            from haros_ci.analysis.views import joined

        if self._common is None:
            self._common = Common()
        key = _key(workspace)
        if key not in self._made:
            parts = views(workspace)
            if parts[0].workspace is workspace:
                self._made[key] = varied(
                    workspace,
                    self.settings,
                    self.store,
                    exact=self.settings.exact,
                    processes=self.settings.jobs,
                    common=self._common,
                )
            else:
                where = self.settings.project_file or "the project file"
                self._made[key] = joined(workspace, parts, [self.of(view.workspace) for view in parts], where)
        return self._made[key]


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
        from haros_ci.analysis.launch_faults import refused
        from haros_ci.analysis.same_model import has_same_model
        from haros_ci.analysis.unmodelled import lacking
        from haros_ci.checking.all_checks import OF_CHANGES, run_all
        from haros_ci.checking.run import Assigned
        from haros_ci.checking.system import System, systems

    if progress is not None:
        progress("architecture")
    made = architectures.of(workspace)
    found = made.architecture

    def under(system: System, arguments: Assigned) -> System | None:
        configuration = made.under(system.name, dict(arguments))
        return None if configuration is None else System(configuration, found, workspace)

    if progress is not None:
        progress(f"{len(chosen)} checks")
    all_systems = tuple(systems(found, workspace))
    past, renames = _past(base, architectures), base.renames if base else None
    is_same = (
        base is not None and not settings.plugins and has_same_model(base, workspace, made.sources, architectures.store)
    )
    where = settings.project_file or ""
    access = settings.access
    seen = project_of(made, workspace, all_systems, past, renames, project_file=where, access=access)
    project = architectures.seen(seen.without_changes() if is_same else seen)
    processes = settings.jobs if len(workspace.files) > FEW else 1
    share = partial(shared, processes=processes, here=OF_CHANGES)
    old = base.workspace if base is not None else None
    beside = partial(lacking, made, workspace, settings)
    of_systems, of_project, changes, sentences = run_all(
        chosen, all_systems, project, own.TOOL, under, share, old, beside
    )
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

    options = repr((settings.project_file, settings_digests(settings, known.components)))
    found = kept_run(ARCHITECTURE, make, workspace, base, options, architectures.store)
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
        made = architectures.of(base.workspace)
        return project_of(made, base.workspace, tuple(systems(made.architecture, base.workspace)))

    return make


def _problems_before(base: Base, architectures: Architectures) -> Callable[[], Iterable[Problem]]:
    """What could not be analysed at the base revision."""
    return lambda: architectures.of(base.workspace).architecture.problems


def project_of(
    made: Linked,
    workspace: Workspace,
    systems: tuple[System, ...],
    base: Project | Callable[[], Project | None] | None = None,
    renames: Mapping[str, str] | None = None,
    *,
    project_file: str = "",
    stated: Sequence[Stated] | None = None,
    access: Sequence[AccessRule] = (),
) -> Project:
    """What the checks of packages see, from what the architecture was *made* of; *base* is that of the base revision.

    *stated* are the properties that count in place of those of the project file.
    """
    from haros_ci.analysis.comparison import revision_of
    from haros_ci.checking.project import Project
    from haros_ci.robot.descriptions import Descriptions
    from haros_ci.workspace.xml import XmlError, parse_xml

    def element(path: str) -> Element | None:
        try:
            return parse_xml(workspace.text(path).encode())
        except (XmlError, UnicodeEncodeError):
            return None

    def code() -> Codebase:
        from haros_ci.analysis.code_of import code_of

        with stage("call graph"):
            return code_of(made, workspace)

    programs = {source.path: source.program for source in made.sources}
    return Project(
        workspace,
        made.builds,
        programs,
        systems,
        read_xml=element,
        base=base,
        renames=renames,
        revision=revision_of(workspace, made),
        robots=Descriptions(workspace, made.builds),
        code=code,
        project_file=project_file,
        stated=stated,
        access=access,
    )


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
