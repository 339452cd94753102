# SPDX-License-Identifier: Apache-2.0
"""A run on several machines: each takes its part (``part``), one puts the parts together (``merged``); beside the pipeline."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import replace

from haros_ci import __version__
from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.inspection import inspected, is_inspected
from haros_ci.baselines import at_base, settled
from haros_ci.config.digests import settings_digests
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.linters import sandbox
from haros_ci.linters.part import Noted, answers
from haros_ci.linters.portions import portions
from haros_ci.linters.recorded import Recorded, Testimony, Unanswered
from haros_ci.linters.work import Digests, Work, works
from haros_ci.linting import has_structure, lint_options
from haros_ci.model.workspace import Store, Workspace
from haros_ci.pipeline import (
    ARCHITECTURE,
    STRUCTURE,
    Progress,
    analyse,
    found,
    narrowed,
    own_run,
    selection_of,
    structured,
)
from haros_ci.registry import registry
from haros_ci.results.result import Report, Run
from haros_ci.shards.costs import Costs
from haros_ci.shards.division import ShardJob, divide, plan_digest
from haros_ci.shards.joining import ANEW, Joined, fits
from haros_ci.shards.shard import (
    BASE,
    HEAD,
    SIDES,
    Failed,
    Had,
    Header,
    RecordedAnswer,
    Shard,
    ShardError,
    WorkspaceRun,
)
from haros_ci.workspace.base import Base

#: CPU microseconds for a byte of code, where nothing is remembered: 3 to 10 were measured for the first (docs/scale.md).
WHOLE_COSTS = {ARCHITECTURE: 6.0, STRUCTURE: 2.0}


def part(
    settings: Settings, store: Store, number: int, of: int, costs: Costs, progress: Progress | None = None
) -> tuple[Shard, tuple[str, ...]]:
    """What shard *number* of *of* finds, and sentences on what failed in it. All shards must be given the same *costs*."""
    known = registry(settings)
    selection, _ = selection_of(settings, known)
    head = found(settings, selection)
    options = lint_options(settings, known)
    with at_base(head, settings) as base:
        past = base if isinstance(base, Base) else None
        head = settled(head, settings, base)
        sides = [head] if past is None else [head, narrowed(past.workspace, settings, selection)]
        noted = [Noted() for _ in sides]
        digests = [Digests(side) for side in sides]
        planned = [
            works(side, known.linters, options, store, hashed, tools)
            for side, hashed, tools in zip(sides, digests, noted, strict=True)
        ]
        makers = _Makers(sides, past, selection, Architectures(settings, store, known), progress)
        wholes = {name: costs.get("", {}).get(name, makers.guess(name)) for name in makers.needed}
        parts = portions([_works(side) for side in planned], costs, of, sum(wholes.values()))
        jobs = [
            *(ShardJob(("", name), cost) for name, cost in wholes.items()),
            *(ShardJob((portion.tool, *portion.keys), portion.cost) for portion in parts),
        ]
        shard_of = divide(jobs, of)
        mine = {
            (job.names[0], key)
            for job, who in zip(jobs, shard_of, strict=True)
            if who == number
            for key in job.names[1:]
        }
        reported: dict[tuple[str, str], RecordedAnswer] = {}
        failed: list[Failed] = []
        for side, plan, hashed in zip(sides, planned, digests, strict=True):
            left = mine - reported.keys()
            remembered = _Remembered(costs)
            for answer in answers(plan, left, side, options, store, hashed, progress):
                cost = remembered.cost(answer.tool, answer.path, answer.seconds)
                value = json.dumps(answer.value, separators=(",", ":"), allow_nan=False)
                reported[answer.tool, answer.key] = RecordedAnswer(answer.tool, answer.path, answer.key, cost, value)
            failed += _failures(plan)
            mine -= {(failure.tool, key) for failure in failed for key in failure.keys}
        runs = tuple(run for name in wholes if ("", name) in mine for run in makers.runs(name))
        header = Header(
            version=__version__,
            number=number,
            of=of,
            workspace=content_digest(head),
            base=None if past is None else past.revision,
            settings=settings_digests(settings, known.components),
            tools=tuple(_had(noted)),
            plan=plan_digest(jobs, shard_of, of),
            confined=sandbox.state(settings.trust_config),
        )
    return Shard(header, tuple(reported.values()), tuple(failed), runs), _trouble(planned, failed, runs)


def merged(settings: Settings, store: Store, joined: Joined) -> tuple[Report, Workspace]:
    """The report of the whole run, made of what shards have found. ShardError or OtherSettings where they do not fit."""

    known = registry(settings)

    def recorded(workspace: Workspace, past: Base | None) -> tuple[Testimony, Testimony | None]:
        fits(
            joined,
            version=__version__,
            settings=settings_digests(settings, known.components),
            workspace=content_digest(workspace),
            base=None if past is None else past.revision,
        )
        return _testimony(joined, HEAD), None if past is None else _testimony(joined, BASE)

    try:
        return analyse(settings, store, recorded=recorded)
    except Unanswered as err:
        what = f"{err.path} ({err.tool})" if err.path else err.tool
        raise ShardError(f"no shard has answered for {what}", help=ANEW) from err


def _testimony(joined: Joined, side: str) -> Testimony:
    recorded = Recorded(
        joined.versions(side), joined.fingerprints(side), joined.answers, joined.failures, joined.errors(side)
    )
    wholes = {name: run for (name, where), run in joined.wholes.items() if where == side}
    return Testimony(recorded, wholes, joined.confined)


def content_digest(workspace: Workspace) -> str:
    """Of all that is analysed: files, packages, and what of it is reported on."""
    rows = [
        [[f.path, f.digest, f.language, f.package] for f in workspace.files],
        sorted([package.path, package.name] for package in workspace.packages),
        None if workspace.targets is None else sorted(workspace.targets),
    ]
    return hashlib.sha256(json.dumps(rows).encode()).hexdigest()


def _works(planned: Iterable[Work | Run]) -> list[Work]:
    return [work for work in planned if isinstance(work, Work)]


class _Remembered:
    """What a unit costs: as measured now, else as it was before."""

    def __init__(self, costs: Costs) -> None:
        self._costs = costs

    def cost(self, tool: str, path: str, seconds: float | None) -> int | None:
        return self._costs.get(tool, {}).get(path) if seconds is None else int(seconds * 1e6)


def _failures(planned: Iterable[Work | Run]) -> Iterator[Failed]:
    for work in _works(planned):
        for message, paths in work.failures:
            keys = tuple(work.keys[path] for path in paths if path in work.keys)
            yield Failed(work.linter.NAME, message, paths, keys)


class _Makers:
    """What is found out of all *sides* as wholes, one after the other."""

    def __init__(
        self,
        sides: list[Workspace],
        past: Base | None,
        selection: Selection,
        architectures: Architectures,
        progress: Progress | None,
    ) -> None:
        self._sides = [(side, selection.over(side.package_finder())) for side in sides]
        self._past = past
        self._architectures = architectures
        self._progress = progress
        self.needed = [name for name in WHOLE_COSTS if any(self._needs(name, *side) for side in self._sides)]

    def guess(self, name: str) -> int:
        """What it may cost, in CPU microseconds."""
        code = sum(file.size for side, _ in self._sides for file in side.files if file.language in ("cpp", "python"))
        return int(code * WHOLE_COSTS[name])

    def runs(self, name: str) -> Iterator[WorkspaceRun]:
        """The runs of the sides that need one; the cost of all of them is recorded for the first."""
        before = _cpu()
        made = [
            (word, self._run(name, *side))
            for word, side in zip(SIDES, self._sides, strict=False)
            if self._needs(name, *side)
        ]
        spent: int | None = int((_cpu() - before) * 1e6)
        for word, run in made:
            yield WorkspaceRun(name, word, spent, replace(run, analysed=frozenset()) if name == ARCHITECTURE else run)
            spent = None

    def _needs(self, name: str, side: Workspace, selection: Selection) -> bool:
        if name == STRUCTURE:
            return has_structure(side, selection)
        return is_inspected(side, selection, self._architectures.settings, self._architectures.registry)

    def _run(self, name: str, side: Workspace, selection: Selection) -> Run:
        if name == STRUCTURE:
            return structured(side, self._architectures, self._progress)
        base = self._past if side is self._sides[0][0] else None
        run = own_run(side, self._architectures.registry)
        return inspected(run, side, selection, self._architectures, self._progress, base)


def _cpu() -> float:
    """CPU seconds of this process and of those that it has waited for."""
    return sum(os.times()[:4])


def _had(noted: Iterable[Noted]) -> Iterator[Had]:
    for side, tools in zip(SIDES, noted, strict=False):
        for tool, version in sorted(tools.versions.items()):
            yield Had(tool, side, version, tools.fingerprints.get(tool, ""), tools.errors.get(tool, ""))


def _trouble(
    planned: Iterable[Iterable[Work | Run]], failed: Iterable[Failed], wholes: Iterable[WorkspaceRun]
) -> tuple[str, ...]:
    """Sentences on what did not succeed, each once; merge says them again and decides what follows."""
    sentences = [failure.message for failure in failed]
    runs = [run for side in planned for run in side if isinstance(run, Run)] + [whole.run for whole in wholes]
    sentences += [
        n.message for run in runs if not run.successful for n in run.notifications if n.level.value == "error"
    ]
    return tuple(dict.fromkeys(sentences))
