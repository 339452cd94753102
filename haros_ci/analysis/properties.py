# SPDX-License-Identifier: Apache-2.0
"""What the checks of properties say of files that are named on the command line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from haros_ci.analysis.architectures import Architectures, project_of
from haros_ci.behaviour.declared import WORKSPACE, Owner, Stated, in_file, in_project
from haros_ci.checking.checked import Checked
from haros_ci.checking.project import Project
from haros_ci.checking.properties import find_file
from haros_ci.checking.run import run_on_project
from haros_ci.checking.system import systems
from haros_ci.errors import UserError
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.results import own

#: How the ids of the checks of properties begin.
PREFIX = "hpl-"
YAML = (".yaml", ".yml")


@dataclass(frozen=True, slots=True)
class Read:
    """The *outcome* of the checks of properties, the *paths* of the files with them, and how many there are."""

    outcome: Checked
    paths: frozenset[str]
    count: int


def checked(
    workspace: Workspace,
    architectures: Architectures,
    files: Iterable[str],
    configurations: Sequence[str] = (),
    nodes: Sequence[str] = (),
) -> Read:
    """What is wrong with the properties in *files*.

    Those of a project file (YAML) are about what it says; those of other files about *configurations* and *nodes*
    (``package/executable``), or about all that the workspace has. UserError for names that it does not have.
    """
    made = architectures.of(workspace)
    every = tuple(systems(made.architecture, workspace))
    _demand(configurations, {system.name for system in every}, "configuration")
    _demand(nodes, {node.type for system in every for node in system.nodes}, "node")
    project = project_of(made, workspace, every)
    owners = (*(Owner("configuration", name) for name in configurations), *(Owner("node", name) for name in nodes))
    properties = [stated for path in files for stated in _stated(project, path, owners or (WORKSPACE,))]
    project = project_of(made, workspace, every, stated=properties)
    checks = [check for check in architectures.registry.checks if check.id.startswith(PREFIX)]
    outcome = run_on_project(checks, project, own.TOOL)
    count = sum(stated.parsed is not None for stated in properties)
    return Read(outcome, frozenset(stated.source.path for stated in properties), count)


def _stated(project: Project, path: str, owners: Iterable[Owner]) -> Iterator[Stated]:
    """The properties in the file *path*."""
    if path not in project.workspace.names:
        raise UserError(f"{path}: no file of the workspace", help="name .hpl files, or project files in YAML")
    text = project.text(path)
    if path.endswith(YAML):
        yield from in_project(text, path, partial(find_file, project))
        return
    for owner in owners:
        yield from in_file(text, path, owner)


def _demand(names: Iterable[str], known: set[str], what: str) -> None:
    for name in names:
        if name not in known:
            shown = ", ".join(sorted(known)[:10])
            raise UserError(
                f"no {what} {name} in the workspace", help=f"there is {shown}" if shown else "see haros-ci model"
            )
