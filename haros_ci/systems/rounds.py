# SPDX-License-Identifier: Apache-2.0
"""Jobs done in two rounds: who reads a ROS 1 parameter that another node is seen to set is followed once more."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from haros_ci.graph.parameters import Setting
from haros_ci.keeping.kept import Followed
from haros_ci.model.architecture import Endpoint, Node
from haros_ci.systems.system import Job
from haros_ci.systems.work import Result, Work
from haros_ci.values.abstract import Known, Opaque

#: Settings of one server that are looked at; more of them are of a workspace that sets names by the thousand.
MOST = 1_000


def work(shared: Work, jobs: Sequence[Job]) -> tuple[list[Result], list[tuple[Any, Followed]]]:
    """What each of the *jobs* gives, in order, and all that was followed for them."""
    order = sorted(range(len(jobs)), key=lambda number: -jobs[number].size)  # nobody waits for a large one at the end
    done = shared.do(jobs, order)
    fresh = [item for one in done.values() for item in one.fresh]
    again = in_second_round(jobs, {number: one.result for number, one in done.items()})
    if again:
        later = shared.do(jobs, again)
        fresh += [item for one in later.values() for item in one.fresh]
        done.update(later)
    return [done[number].result for number in range(len(jobs))], fresh


def work_here(jobs: Sequence[Job]) -> list[Result]:
    """The same in this process, one after the other."""
    done = [job.follow() for job in jobs]
    for number in in_second_round(jobs, dict(enumerate(done))):
        done[number] = jobs[number].follow()
    return done


def in_second_round(jobs: Sequence[Job], done: Mapping[int, Result]) -> list[int]:
    """The numbers of those jobs whose node reads what another node of the same server sets, now that the servers know of it."""
    by_server: dict[int, list[int]] = {}
    for number, job in enumerate(jobs):
        if job.server is not None:
            by_server.setdefault(id(job.server), []).append(number)
    found: list[int] = []
    for numbers in by_server.values():
        server = jobs[numbers[0]].server
        settings = tuple(
            dict.fromkeys(setting for n in numbers for setting in _settings(jobs[n].node.name, done[n][0]))
        )
        if settings and server is not None:
            server.settings = settings[:MOST]
            found += [n for n in numbers if _is_concerned(settings, jobs[n].node.name, done[n][0])]
    return found


def _settings(name: str, nodes: Iterable[Node]) -> Iterable[Setting]:
    """What a node sets and deletes."""
    for end in _of_kind(nodes, "setters"):
        why = next((unknown.reason for unknown in end.unknowns if unknown.field == "value"), None)
        if why is not None or isinstance(end.value, (list, dict)):
            yield Setting(name, end.name, Opaque(f"{name} may set it"))
        elif end.value is not None or end.type is None:
            yield Setting(name, end.name, Known(end.value))


def _is_concerned(settings: Sequence[Setting], name: str, nodes: Iterable[Node]) -> bool:
    """Whether what the node *name* reads is another value, or may be there, because of what others set."""
    others = [setting for setting in settings if setting.node != name]
    ends = _of_kind(nodes, "getters") if others else ()
    return any(setting.concerns(end.name) for end in ends if "?" not in end.name for setting in others)


def _of_kind(nodes: Iterable[Node], kind: str) -> Iterable[Endpoint]:
    return (end for node in nodes for end in node.endpoints if end.kind == kind and not end.is_ruled_out)
