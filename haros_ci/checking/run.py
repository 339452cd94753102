# SPDX-License-Identifier: Apache-2.0
"""From checks and systems to results: each finding under the launch arguments that show it, reported once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci.checking.check import About, Check, Finding
from haros_ci.checking.checked import Checked
from haros_ci.checking.kinds import ACTION, SERVICE, TOPIC
from haros_ci.checking.patience import Overrun, Patience
from haros_ci.checking.project import Project
from haros_ci.checking.set_aside import lowered
from haros_ci.checking.system import Channel, End, System, SystemNode
from haros_ci.checking.unrun_cmake import of_what_is_run
from haros_ci.model.location import Location
from haros_ci.model.presence import assignment, in_words, together
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.results.fix import is_counted_alike
from haros_ci.results.result import Graph, Notification, Related, Result, Vertex
from haros_ci.results.rule import Level
from haros_ci.timing import stage

#: So many other names of which the same is to be said are named.
SHOWN = 5
#: Files that keep build tools out of a directory (haros_ci/workspace/selection.py has the same), and the tags of checks of what is built.
_MARKERS = frozenset(("COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"))
_OF_BUILDS = frozenset(("packages", "build"))
#: The stage that checks are (``--timings``).
CHECKS = "checks"
#: Launch arguments that have to be set, with their values.
Assigned = tuple[tuple[str, str], ...]
#: The system of the same configuration under other launch arguments; None if it cannot be had.
Under = Callable[[System, Assigned], System | None]


@dataclass(frozen=True, slots=True)
class _ConfirmedFinding:
    check: Check
    finding: Finding
    system: System | None
    arguments: Assigned

    @property
    def key(self) -> tuple[object, ...]:
        """The same check at the same places is one finding, in however many configurations and nodes."""
        if self.finding.apart:
            return (self.check.id, self.finding.at.sort_key, self.finding.apart)
        related = {place.sort_key for place, _ in self.finding.related}
        return (self.check.id, self.finding.at.sort_key, tuple(sorted(related)))

    @property
    def rank(self) -> tuple[int, tuple[str, ...]]:
        """The less arguments have to be set, the better it shows; then by names, so that it stays the same one."""
        return (len(self.arguments), subject(self.finding.about))


def run_checks(checks: Sequence[Check], found: Iterable[System], tool: str, under: Under | None = None) -> Checked:
    """Run *checks* on every system.

    In launch files that launch refuses as a whole only the checks made for that are heard. A finding that holds only in contradictory contexts is dropped. One that needs other launch arguments than the defaults names
    them, and is confirmed by running its check *under* them, where that can be done: else it is dropped, too. A check that
    fails, or that takes too long, is a notification, and loses no other check's findings.
    """
    by_key: dict[tuple[object, ...], dict[tuple[str, ...], _ConfirmedFinding]] = {}
    failures: dict[str, Notification] = {}
    confirm = _Confirmation(under)
    budget = Patience()
    every = tuple(found)
    for check in checks:
        here: System | None = None
        try:
            with stage(CHECKS, check.id), budget.with_(check.id):
                for here in every if check.run is not None else ():
                    try:
                        for checked in _found_in(here, check, confirm):
                            alike = by_key.setdefault(checked.key, {})
                            before = alike.setdefault(subject(checked.finding.about), checked)
                            if checked.rank < before.rank:
                                alike[subject(checked.finding.about)] = checked
                    except Exception as err:  # a fault of one check must not lose the others
                        message = f"the check {check.id} failed on {here.name}: {type(err).__name__}: {err}"
                        failures.setdefault(check.id, Notification(Level.ERROR, message, tool=tool))
        except Overrun:
            failures[check.id] = _ended(check, tool, f" on {here.name}" if here is not None else "")
    chosen = [
        (best, _other_names(best, alike.values())) for alike in by_key.values() for best in [_best(alike.values())]
    ]
    used = {
        checked.system.name: checked.system
        for checked, _ in chosen
        if checked.system is not None and _edges(checked.finding.about)
    }
    results = sorted((_result(checked, more, tool) for checked, more in chosen), key=lambda result: result.sort_key)
    graphs = tuple(graph_of(system) for _, system in sorted(used.items()))
    return Checked(tuple(results), graphs, tuple(failures[id] for id in sorted(failures)))


def _found_in(system: System, check: Check, confirm: _Confirmation) -> Iterator[_ConfirmedFinding]:
    """What *check* finds in *system* that holds there, or is confirmed under other launch arguments."""
    if check.run is None or (system.is_refused and not check.of_refused):
        return
    for finding in check.run(system):
        if finding.at.path in system.refused and not check.of_refused:
            continue
        checked = _with_arguments(check, lowered(finding, system.workspace), system)
        if checked is not None and (not checked.arguments or confirm(checked)):
            yield checked


def run_on_project(
    checks: Sequence[Check],
    project: Project,
    tool: str,
    unseen: Sequence[str] | None = None,
    budget: Patience | None = None,
) -> Checked:
    """Run those of *checks* that look at the whole workspace; one that fails, or takes too long, loses no other's findings.

    *unseen* are the ``markers`` of the workspace, *budget* is the time that the checks share; both are made here where they are not given.
    """
    results: dict[tuple[object, ...], Result] = {}
    sentences: set[tuple[str, object, str]] = set()
    failures = []
    budget = budget or Patience()
    if unseen is None:
        unseen = markers(project.workspace, project.base.workspace if project.base is not None else None)
    left = of_what_is_run(project)
    for check in checks:
        if check.project is None:
            continue
        try:
            with stage(CHECKS, check.id), budget.with_(check.id):
                for finding in left(check.tags, check.project(project)):
                    if unseen and _OF_BUILDS.intersection(check.tags):
                        finding = _of_no_build(finding, unseen)
                    checked = _ConfirmedFinding(check, _mendable(finding, project.text), None, ())
                    result = _result(checked, (), tool)
                    sentence = (check.id, result.location.sort_key, result.message)
                    if sentence not in sentences:  # what is about others, too, says the same of the same place once
                        sentences.add(sentence)
                        results.setdefault((*checked.key, subject(finding.about)), result)
        except Exception as err:  # a fault of one check must not lose the others
            message = f"the check {check.id} failed: {type(err).__name__}: {err}"
            failures.append(Notification(Level.ERROR, message, tool=tool))
        except Overrun:
            failures.append(_ended(check, tool))
    return Checked(tuple(sorted(results.values(), key=lambda result: result.sort_key)), (), tuple(failures))


def _ended(check: Check, tool: str, where: str = "") -> Notification:
    return Notification(Level.ERROR, f"the check {check.id} was ended{where}: it took too long", tool=tool)


def markers(workspace: Workspace, base: Workspace | None) -> tuple[str, ...]:
    """The files that keep build tools out of directories which are analysed all the same, because they were given to the run.

    One that a change adds to *base* does not count: a change hides nothing. colcon, catkin and ament pass over such a directory even where it is
    the root of the search (colcon_core/package_discovery, catkin_pkg/packages.py).
    """
    marked = [path for path in workspace.names if path.rpartition("/")[2] in _MARKERS]
    return tuple(sorted(path for path in marked if base is None or path in base.names))


def _of_no_build(finding: Finding, unseen: Sequence[str]) -> Finding:
    """A *finding* on a manifest or build is a note where the repository's own build never sees it."""
    for marker in unseen:
        folder = marker.rpartition("/")[0]
        if not folder or finding.at.path.startswith(f"{folder}/"):
            message = f"{finding.message.rstrip('. ')} ({marker} keeps the package out of builds)"
            return replace(finding, level=Level.NOTE, message=message)
    return finding


def _mendable(finding: Finding, text: Callable[[str], str]) -> Finding:
    """*finding* with the fixes that are sure to be made where they are meant to."""
    if not finding.fixes:
        return finding
    fixes = tuple(
        fix
        for fix in finding.fixes
        if all(edit.is_executable or is_counted_alike(text(edit.path)) for edit in fix.edits)
    )
    return replace(finding, fixes=fixes)


def _with_arguments(check: Check, finding: Finding, system: System) -> _ConfirmedFinding | None:
    """The finding with the arguments nearest to the defaults under which it can happen; None if there are none."""
    if system.workspace is not None:
        finding = _mendable(finding, system.workspace.text)
    presence = together(
        finding.presence, *(item.presence for item in finding.about if isinstance(item, (End, SystemNode)))
    )
    if presence is None:
        return None
    arguments = assignment(presence, system.arguments)
    return None if arguments is None else _ConfirmedFinding(check, finding, system, arguments)


class _Confirmation:
    """Runs a check under other launch arguments, each assignment evaluated once."""

    def __init__(self, under: Under | None) -> None:
        self.under = under
        self.systems: dict[tuple[str, Assigned], System | None] = {}
        self.known_outcomes: dict[tuple[str, str, Assigned], frozenset[tuple[object, ...]]] = {}

    def __call__(self, outcome: _ConfirmedFinding) -> bool:
        run = outcome.check.run
        if self.under is None or outcome.system is None or run is None:
            return False
        place = (outcome.system.name, outcome.arguments)
        if place not in self.systems:
            self.systems[place] = self.under(outcome.system, outcome.arguments)
        system = self.systems[place]
        if system is None:
            return False
        key = (outcome.check.id, *place)
        if key not in self.known_outcomes:
            with stage("confirmations"):
                found = (_with_arguments(outcome.check, finding, system) for finding in run(system))
                self.known_outcomes[key] = frozenset(
                    checked.key for checked in found if checked is not None and not checked.arguments
                )
        return outcome.key in self.known_outcomes[key]


def subject(about: Iterable[About]) -> tuple[str, ...]:
    """The ROS names that a finding is about, sorted, once each."""
    names = set()
    for end in about:
        if isinstance(end, End):
            names |= {end.name, end.node.name}
        else:
            names.add(str(end))
    return tuple(sorted(names))


def roles(about: Iterable[About]) -> tuple[str, ...]:
    """What the finding is about, apart from names that a user gives."""
    found = set()
    for channel in about:
        if isinstance(channel, (End, SystemNode)):
            found.add(channel.role)
        elif isinstance(channel, Channel):
            found.add(channel.kind)
            found.update(end.role for end in channel.ends)
    return tuple(sorted(found))


def command(system: System, arguments: Assigned) -> str:
    """The command line that starts *system* with *arguments*; "" for a node type alone."""
    if not system.launch:
        return ""
    package, _, path = system.launch[0].partition("/")
    start = "ros2 launch" if system.ros == 2 else "roslaunch"
    return " ".join(part for part in (start, package, path.rpartition("/")[2], in_words(arguments)) if part)


def _best(alike: Iterable[_ConfirmedFinding]) -> _ConfirmedFinding:
    return min(alike, key=lambda checked: checked.rank)


def _other_names(best: _ConfirmedFinding, alike: Iterable[_ConfirmedFinding]) -> tuple[str, ...]:
    """The names of which the same is to be said at the same places as of those that *best* is about: of channels, else of nodes."""
    others = [checked.finding.about for checked in alike if checked is not best]
    channels = {name for about in others for name in _channels(about)} - _channels(best.finding.about)
    groups = [subject(about) for about in others]
    names = channels or {name for group in groups for name in group} - {*subject(best.finding.about)}
    return tuple(sorted(names)) or tuple(sorted(map(", ".join, groups)))


def _channels(about: Iterable[About]) -> set[str]:
    """The names that the ends among *about* have."""
    return {end.name for end in about if isinstance(end, End)}


def _result(checked: _ConfirmedFinding, others: tuple[str, ...], tool: str) -> Result:
    """*others* are the names of which the same is to be said at the same places."""
    check, finding, system = checked.check, checked.finding, checked.system
    message = finding.message.rstrip(". ")
    about_system = any(isinstance(item, (End, SystemNode, Channel)) for item in finding.about)
    if system is None:
        pass
    elif checked.arguments:
        message += f"; seen with {command(system, checked.arguments)}"
    elif about_system and system.is_launched:
        message += f"; in {system.name}"
    if others:
        more = f" and {len(others) - SHOWN} more" if len(others) > SHOWN else ""
        message += f"; likewise for {', '.join(others[:SHOWN])}{more}"
    edges = _edges(finding.about)
    return Result(
        tool=tool,
        rule=check.id,
        level=finding.level or check.level,
        message=message,
        location=finding.at,
        related=_places(finding.related, finding.at),
        subject=subject(finding.about),
        roles=roles(finding.about),
        flow=tuple(Related(place, text) for place, text in finding.flow),
        graph=system.name if edges and system is not None else "",
        edges=edges,
        fixes=finding.fixes,
    )


def _places(places: Iterable[tuple[Location, str]], at: Location) -> tuple[Related, ...]:
    return tuple(dict.fromkeys(Related(place, text) for place, text in places if place != at))


def _edges(about: Iterable[About]) -> tuple[tuple[str, str], ...]:
    return tuple(dict.fromkeys(edge for end in about if isinstance(end, End) for edge in _edge(end)))


def _edge(end: End) -> Iterator[tuple[str, str]]:
    """From who gives to who takes, through the topic, service or action."""
    for kind, (gives, takes) in _KINDS.items():
        if end.kind == gives:
            yield f"node:{end.node.name}", f"{kind}:{end.name}"
        elif end.kind == takes:
            yield f"{kind}:{end.name}", f"node:{end.node.name}"


_KINDS: Mapping[str, tuple[str, str]] = {"topic": TOPIC, "service": SERVICE, "action": ACTION}


def graph_of(system: System) -> Graph:
    """The node-topic graph of *system*: nodes, and what they are connected by; what is implicit is left out."""
    vertices = {
        f"node:{node.name}": Vertex(f"node:{node.name}", node.name, "node", _place(node.location))
        for node in system.nodes
    }
    edges: dict[tuple[str, str], None] = {}
    for end in system.ends:
        for source, target in _edge(end) if not end.implicit else ():
            edges[source, target] = None
            for id in (source, target):
                kind, _, name = id.partition(":")
                vertices.setdefault(id, Vertex(id, name, kind))
    return Graph(system.name, tuple(vertices[id] for id in sorted(vertices)), tuple(sorted(edges)))


def _place(location: Location) -> Location | None:
    return location if location.path != "." else None
