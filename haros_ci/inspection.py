# SPDX-License-Identifier: Apache-2.0
"""What the checks and the project file's queries say of the architecture, added to the run of our own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.model.element import Element
from haros_ci.model.workspace import Problem, Store, Workspace
from haros_ci.registry import check_rules, checks
from haros_ci.results import own
from haros_ci.results.result import Notification, Run
from haros_ci.results.rule import Level, Rule

if TYPE_CHECKING:  # they are loaded where there is something to check
    from haros_ci.checking.project import Project
    from haros_ci.checking.system import System
    from haros_ci.code.codebase import Codebase
    from haros_ci.link.link import Linked

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
    from haros_ci.checking.run import Assigned, run_checks, run_on_project
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
    all_systems = tuple(systems(found, workspace))
    said = run_checks(chosen, all_systems, own.TOOL, under)
    said_once = run_on_project(chosen, project_of(made, workspace, all_systems), own.TOOL)
    failures = (*said.notifications, *said_once.notifications)
    run = replace(
        run,
        results=(*run.results, *own.launch_results(malformed(workspace)), *said.results, *said_once.results),
        notifications=(
            *run.notifications,
            *failures,
            *(Notification(Level.NOTE, p.message, ARCHITECTURE, p.path, p.line) for p in found.problems),
        ),
        graphs=said.graphs,
        architecture=not failures,
        successful=run.successful and not failures,
    )
    return queried(run, found, workspace, settings, selection) if asks(settings) else run


def project_of(made: Linked, workspace: Workspace, systems: tuple[System, ...], base: Project | None = None) -> Project:
    """What the checks of packages see, from what the architecture was *made* of; *base* is that of the base revision."""
    from haros_ci.checking.project import Project
    from haros_ci.robot.descriptions import Descriptions
    from haros_ci.workspace.xml import XmlError, parse_xml

    def element(path: str) -> Element | None:
        try:
            return parse_xml(workspace.text(path).encode())
        except (XmlError, UnicodeEncodeError):
            return None

    def code() -> Codebase:
        from haros_ci.code.codebase import codebase

        ros = {package.name: package.ros for package in workspace.packages if package.ros is not None}
        return codebase(made.sources, workspace.text, ros)

    programs = {source.path: source.program for source in made.sources}
    robots = Descriptions(workspace, made.builds)
    return Project(workspace, made.builds, programs, systems, element, base, robots, code)


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
