# SPDX-License-Identifier: Apache-2.0
"""What the checks and the project file's queries say of the architecture, added to the run of our own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.model.workspace import Problem, Store, Workspace
from haros_ci.registry import check_rules, checks
from haros_ci.results import own
from haros_ci.results.result import Notification, Run
from haros_ci.results.rule import Level, Rule

Progress = Callable[[str], None]

#: Whose notes it is that something of the architecture is not known.
ARCHITECTURE = "architecture"


def inspected(
    run: Run, workspace: Workspace, settings: Settings, selection: Selection, store: Store, progress: Progress | None
) -> Run:
    """*run* with what the checks and queries say of the architecture, where any of them is on."""
    chosen = tuple(check for check in checks() if is_on(check_rules()[check.id], workspace, selection))
    if not (chosen or asks(settings)) or only_files(workspace, settings):
        return run
    from haros_ci.architecture import varied
    from haros_ci.checking.run import Assigned, run_checks
    from haros_ci.checking.system import System, systems

    if progress is not None:
        progress("architecture")
    made = varied(workspace, settings, store, processes=settings.jobs)
    found = made.architecture

    def under(system: System, arguments: Assigned) -> System | None:
        configuration = made.under(system.name, dict(arguments))
        return None if configuration is None else System(configuration, found, workspace)

    if progress is not None:
        progress(f"{len(chosen)} checks")
    said = run_checks(chosen, systems(found, workspace), own.TOOL, under)
    run = replace(
        run,
        results=(*run.results, *own.launch_results(malformed(workspace)), *said.results),
        notifications=(
            *run.notifications,
            *said.notifications,
            *(Notification(Level.NOTE, p.message, ARCHITECTURE, p.path, p.line) for p in found.problems),
        ),
        graphs=said.graphs,
        architecture=not said.notifications,
        successful=run.successful and not said.notifications,
    )
    return queried(run, found, workspace, settings, selection) if asks(settings) else run


def malformed(workspace: Workspace) -> Iterator[Problem]:
    """The launch files that begin as XML and are none; a template, by its path, is to become one."""
    from haros_ci.architecture import launch_reader

    read = launch_reader(workspace)
    for file in workspace.files:
        if file.language != "launch" or "template" in file.path.lower():
            continue
        if workspace.text(file.path).lstrip().startswith("<"):
            launch = read(file.path)
            if launch is not None and launch.root is None:
                yield from (Problem(file.path, message, line) for line, message in launch.problems[:1])


def queried(run: Run, found: Architecture, workspace: Workspace, settings: Settings, selection: Selection) -> Run:
    """*run* with the matches of the project file's queries."""
    from haros_ci.query import queries

    where = settings.project_file or "the project file"
    asked = queries.run(
        found, settings.project, where, workspace.files, wanted=lambda rule: is_on(rule, workspace, selection)
    )
    return replace(
        run,
        results=(*run.results, *asked.results),
        notifications=(*run.notifications, *asked.notifications),
        successful=run.successful and not asked.failed,
        architecture=run.architecture and not asked.failed,
    )


def is_on(rule: Rule, workspace: Workspace, selection: Selection) -> bool:
    """Whether *rule* is on in any file."""
    return any(selection.wants(own.TOOL, rule, file.path) for file in workspace.files)


def only_files(workspace: Workspace, settings: Settings) -> bool:
    """Whether nothing but single files was asked for: of them alone no architecture is made, unless its profile asks."""
    paths = {file.path for file in workspace.files}
    return settings.profile != "architecture" and all(path in paths for path in settings.paths)


def asks(settings: Settings) -> bool:
    """Whether the project file may have queries."""
    return "rules" in settings.project or "configurations" in settings.project
