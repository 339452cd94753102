# SPDX-License-Identifier: Apache-2.0
"""What is made of each view of a workspace, put together: where packages of one name are of both versions of ROS there are two."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci.model.architecture import Configuration
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.results.own import TOOL
from haros_ci.results.result import Notification, Result, Run
from haros_ci.systems.link import Linked, Requested
from haros_ci.workspace.views import View, views


def started_in(view: View, requested: tuple[Requested, ...] | None) -> tuple[Requested, ...] | None:
    """Those of the configurations that are *requested* whose launch files are in the view."""
    if requested is None or view.ros is None:
        return requested
    paths = {file.path for file in view.workspace.files}
    return tuple(item for item in requested if paths.issuperset(item.launch))


def joined(workspace: Workspace, parts: Sequence[View], made: Sequence[Linked], project_file: str) -> Linked:
    """The architecture of *workspace*, of what was *made* of its views: all their configurations.

    Of what both versions of ROS have under one name, the configurations carry the version in theirs. Of packages of one name the build of the
    first view stands. What is wrong in the *project_file* for one version alone is not wrong.
    """
    if len(parts) == 1:
        return _of_all(workspace, made[0])
    ones = [_narrowed(view, linked) for view, linked in zip(parts, made, strict=True)]
    configurations = {
        configuration.name: configuration for one in reversed(ones) for configuration in one.architecture.configurations
    }
    problems = {problem for one in ones for problem in one.architecture.problems}
    for one in ones:
        problems -= {p for p in problems if p.path == project_file and p not in one.architecture.problems}

    def under(name: str, arguments: Mapping[str, str]) -> Configuration | None:
        owner = next((o for o in ones if any(name == known.name for known in o.architecture.configurations)), None)
        return owner.under(name, arguments) if owner is not None else None

    whole = replace(
        ones[0].architecture,
        configurations=tuple(configurations[name] for name in sorted(configurations)),
        packages=workspace.packages,
        problems=tuple(sorted(problems, key=_order)),
    )
    builds = {**ones[1].builds, **ones[0].builds}
    sources = {source.path: source for one in ones for source in one.sources}
    return Linked(whole, under, builds, tuple(sources[path] for path in sorted(sources)), tuple(ones))


#: Rules on what another package has, or has not.
OF_OTHERS = frozenset(
    """
    mesh-not-loaded missing-launch-file parameter-file-missing parameter-not-declared parameter-type-mismatch share-file-missing
    undefined-field undefined-interface unknown-executable unset-launch-argument wrong-field-value
    """.split()
)


def in_views(run: Run, workspace: Workspace, project_file: str | None, look: Callable[[View], Run]) -> Run:
    """What *look* adds to *run* in the views of *workspace*, each finding once and from the version of ROS that its package is of."""
    parts = views(workspace)
    runs = [_of_neighbours(view, look(view)) for view in parts]
    if len(runs) == 1:
        return runs[0]
    results = {repr(result): result for view, one in zip(parts, runs, strict=True) for result in _held(view, one)}
    notes = dict.fromkeys(note for one in runs for note in one.notifications)
    notes = {n: None for n in notes if _is_of_all(n, project_file, runs)}
    return replace(
        run,
        results=tuple(sorted(results.values(), key=lambda result: result.sort_key)),
        notifications=tuple(notes),
        graphs=tuple({graph.name: graph for one in runs for graph in one.graphs}.values()),
        architecture=all(one.architecture for one in runs),
        successful=all(one.successful for one in runs),
        changes=next((one.changes for one in runs if one.changes), runs[0].changes),
    )


def _of_neighbours(view: View, run: Run) -> Run:
    """*run* without what OF_OTHERS say of a package of which the one that lies nearer is not in the view."""
    kept = tuple(
        one
        for one in run.results
        if one.tool != TOOL or one.rule not in OF_OTHERS or not view.is_nearer_another(one.location.path, one.message)
    )
    return run if len(kept) == len(run.results) else replace(run, results=kept)


def _held(view: View, run: Run) -> Iterator[Result]:
    """The results of *run* that are the view's."""
    return (result for result in run.results if result.location is None or view.holds(result.location.path))


def _is_of_all(note: Notification, project_file: str | None, runs: Sequence[Run]) -> bool:
    """Whether a note counts: one on the project file if all *runs* have it."""
    return note.path is None or note.path != project_file or all(note in one.notifications for one in runs)


def same_view(workspace: Workspace, view: View) -> Workspace:
    """The view of *workspace*, at another revision, that shows the version of ROS of *view*."""
    found = views(workspace)
    return next((other.workspace for other in found if other.ros == view.ros), found[0].workspace)


def _of_all(workspace: Workspace, made: Linked) -> Linked:
    if made.architecture.packages == workspace.packages:
        return made
    return replace(made, architecture=replace(made.architecture, packages=workspace.packages))


def _narrowed(view: View, made: Linked) -> Linked:
    """*made* without what another view shows, and with the version in the names of what both have."""
    belongs = view.versions()
    own = {_name(view, one): one for one in made.architecture.configurations if _is_of(view, one, belongs)}
    before = {name: one.name for name, one in own.items()}

    def under(name: str, arguments: Mapping[str, str]) -> Configuration | None:
        found = made.under(before.get(name, name), arguments)
        return replace(found, name=name) if found is not None else None

    configurations = tuple(replace(one, name=name) for name, one in own.items())
    return replace(made, architecture=replace(made.architecture, configurations=configurations), under=under)


def _name(view: View, found: Configuration) -> str:
    is_shared = found.name.partition("/")[0] in view.doubled or not view.shared.isdisjoint(found.launch)
    return f"{found.name} (ROS {view.ros})" if is_shared else found.name


def _is_of(view: View, found: Configuration, belongs: Callable[[str], bool]) -> bool:
    """Whether a configuration is of the view's version of ROS."""
    if not all(belongs(path.partition("/")[0]) for path in (*found.launch, *(() if found.launch else (found.name,)))):
        return False
    versions = {node.ros for node in found.nodes}
    return not versions or view.ros in versions


def _order(problem: Problem) -> tuple[str, int, str]:
    return problem.path, problem.line or 0, problem.message
