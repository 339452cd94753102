# SPDX-License-Identifier: Apache-2.0
"""The work of following all nodes of a workspace: done in several processes, within a limit for all of them.

Which nodes are left out depends on their order alone: not on how many processes work, nor on what earlier runs have kept.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from haros_ci.keeping.kept import Followed
from haros_ci.model.architecture import Node, Unknown
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.systems.following import Types
from haros_ci.systems.system import Job

#: Steps that all programs of a workspace may take together; moveit2 takes 1.4 million.
OF_ALL = 10_000_000
TOO_MUCH = (
    f"the programs before this one took {OF_ALL:,} steps, the limit for a workspace: what this one makes is not known; "
    "analyse fewer packages at once"
)
#: A node with its endpoints, and what went wrong.
Result = tuple[tuple[Node, ...], tuple[Problem, ...]]
#: Does jobs, each of a group that has work in common, and gives their results in order.
Share = Callable[[Sequence[Callable[[], Any]], Sequence[Hashable]], Sequence[Any]]


@dataclass(frozen=True, slots=True)
class Done:
    """What a job gives, all that was followed for it, the steps that count for each program so far, and those of each result that it uses."""

    result: Result
    fresh: Sequence[tuple[Any, Followed]]
    counted: Mapping[Any, Mapping[str, int]]
    used: Mapping[str, int]


@dataclass(slots=True)
class Work:
    """Jobs of one workspace, done in batches by *share*."""

    types: Types
    share: Share
    #: The results that jobs of earlier batches have used, and those of the present batch by the place of the job.
    seen: dict[str, int] = field(default_factory=dict)
    here: dict[str, tuple[int, int]] = field(default_factory=dict)
    #: The steps of those of earlier batches together; the last place of the present one, and its steps together.
    earlier: int = 0
    so_far: tuple[int, int] = -1, 0

    @property
    def is_over(self) -> bool:
        """Whether all steps of the workspace are used up."""
        return self.earlier > OF_ALL

    def do(self, jobs: Sequence[Job], order: Sequence[int]) -> dict[int, Done]:
        """What each of *jobs* with a number in *order* gives, by this number, begun in that order.

        Those of which the turn comes when the steps are used up make nothing that is known.
        """
        self.here, self.so_far = {}, (-1, 0)
        tasks = [partial(self._done, place, jobs[number]) for place, number in enumerate(order)]
        done = dict(zip(order, self.share(tasks, [jobs[number].group for number in order]), strict=True))
        for counted in {id(one.counted): one.counted for one in done.values()}.values():  # one of each process
            for entry, steps in counted.items() if counted is not self.types.counted else ():
                self.types.counted.setdefault(entry, {}).update(steps)
        for number in order:
            if self.is_over and jobs[number].group is not None:
                done[number] = replace(done[number], result=_left_out(jobs[number]))
            else:
                self.earlier += sum(steps for digest, steps in done[number].used.items() if digest not in self.seen)
                self.seen.update(done[number].used)
        return done

    def _done(self, place: int, job: Job) -> Done:
        """Do a job, in whichever process; not where what this process has done for earlier places is too much already."""
        last, steps_here = self.so_far
        if last >= place:
            steps_here = sum(steps for before, steps in self.here.values() if before < place)
        if job.group is not None and self.earlier + steps_here > OF_ALL:
            return Done(_left_out(job), (), {}, {})
        before = len(self.types.fresh)
        self.types.used.clear()
        made = job.follow()
        used = dict(self.types.used)
        for digest, steps in used.items():
            if digest not in self.seen and digest not in self.here:
                self.here[digest] = (place, steps)
                self.so_far = max(self.so_far[0], place), self.so_far[1] + steps
        return Done(made, self.types.fresh[before:], self.types.counted, used)


def in_turn(jobs: Sequence[Callable[[], Any]], groups: Sequence[Hashable]) -> Sequence[Any]:
    """Do the jobs here, one after the other."""
    return [job() for job in jobs]


def _left_out(job: Job) -> Result:
    node, place = job.node, job.node.location
    unknowns = (*node.unknowns, Unknown("endpoints", TOO_MUCH, place))
    problems = (Problem(place.path, TOO_MUCH, place.line),) if place is not None else ()
    return (replace(node, unknowns=unknowns),), problems
