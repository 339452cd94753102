# SPDX-License-Identifier: Apache-2.0
"""A run on several machines: each takes its part (``part``), one puts the parts together (``merged``); beside the pipeline."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import fields, replace

from haros_ci import __version__
from haros_ci.baselines import at_base
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.inspection import Architectures, inspected, is_inspected
from haros_ci.linters.part import Noted, answers
from haros_ci.linters.portions import portions
from haros_ci.linters.recorded import Recorded, Unanswered
from haros_ci.linters.work import Digests, Work, works
from haros_ci.model.workspace import Store, Workspace
from haros_ci.pipeline import Progress, Testimony, analyse, found, lint_options, narrowed, own_run, selection_of
from haros_ci.registry import Registry, registry
from haros_ci.results.result import Report, Run
from haros_ci.shards.costs import Costs
from haros_ci.shards.division import Job, divide, plan_digest
from haros_ci.shards.joining import ANEW, Joined, fits
from haros_ci.shards.shard import BASE, HEAD, SIDES, Failed, Had, Header, Said, Shard, ShardError, Whole
from haros_ci.shards.values import plain
from haros_ci.workspace.base import Base

#: What is done once for a whole workspace: the checks and queries.
ARCHITECTURE = "architecture"
#: CPU microseconds for a byte of what the architecture is read from, where nothing is remembered (docs/measurements.md).
ARCHITECTURE_COST = 8.0
ARCHITECTURE_LANGUAGES = frozenset({"cpp", "python", "launch"})

#: Settings that say how the run is made or reported, not what the tools are to find.
_REPORTING = frozenset(
    {
        "root",
        "project_file",
        "fail_on",
        "jobs",
        "imports",
        "baseline",
        "baseline_rev",
        "require_baseline",
        "allow_tool_failure",
        "cache_dir",
        "notes",
        "origins",
    }
)

#: Where the others are given, if not in the project file.
_OPTIONS = {
    "paths": "the paths",
    "profile": "--profile",
    "command_line": "--select or --ignore",
    "exclude": "--exclude",
    "compile_database": "--compile-database",
    "trust_config": "--trust-config",
    "plugins": "--plugin",
}


def part(
    settings: Settings, store: Store, number: int, of: int, costs: Costs, progress: Progress | None = None
) -> tuple[Shard, tuple[str, ...]]:
    """What shard *number* of *of* finds, and sentences on what failed in it. All shards must be given the same *costs*."""
    known = registry(settings)
    selection, _ = selection_of(settings, known)
    head = found(settings, selection)
    selection = selection.over(head.package_finder())
    options = lint_options(settings, known)
    with at_base(head, settings) as base:
        past = base if isinstance(base, Base) else None
        sides = [head] if past is None else [head, narrowed(past.workspace, settings, selection)]
        noted = [Noted() for _ in sides]
        digests = [Digests(side) for side in sides]
        planned = [
            works(side, known.linters, options, store, hashed, tools)
            for side, hashed, tools in zip(sides, digests, noted, strict=True)
        ]
        wholes = [ARCHITECTURE] if is_inspected(head, selection, settings, known) else []
        whole_costs = [costs.get("", {}).get(ARCHITECTURE, _guess(sides)) for _ in wholes]
        parts = portions([_works(side) for side in planned], costs, of, sum(whole_costs))
        jobs = [
            *(Job(("", name), cost) for name, cost in zip(wholes, whole_costs, strict=True)),
            *(Job((portion.tool, *portion.keys), portion.cost) for portion in parts),
        ]
        given = divide(jobs, of)
        mine = {
            (job.names[0], key) for job, who in zip(jobs, given, strict=True) if who == number for key in job.names[1:]
        }
        said: dict[tuple[str, str], Said] = {}
        failed: list[Failed] = []
        for side, plan, hashed in zip(sides, planned, digests, strict=True):
            left = mine - said.keys()
            remembered = _Remembered(costs)
            for answer in answers(plan, left, side, options, store, hashed, progress):
                cost = remembered.cost(answer.tool, answer.path, answer.seconds)
                value = json.dumps(answer.value, separators=(",", ":"), allow_nan=False)
                said[answer.tool, answer.key] = Said(answer.tool, answer.path, answer.key, cost, value)
            failed += _failures(plan)
            mine -= {(failure.tool, key) for failure in failed for key in failure.keys}
        is_mine = ("", ARCHITECTURE) in mine
        runs = (
            tuple(_inspected(sides, past, selection, Architectures(settings, store, known), progress))
            if is_mine
            else ()
        )
        header = Header(
            version=__version__,
            number=number,
            of=of,
            workspace=content_digest(head),
            base=None if past is None else past.revision,
            settings=settings_digests(settings, known),
            tools=tuple(_had(noted)),
            plan=plan_digest(jobs, given, of),
        )
    return Shard(header, tuple(said.values()), tuple(failed), runs), _trouble(planned, failed, runs)


def merged(settings: Settings, store: Store, joined: Joined) -> tuple[Report, Workspace]:
    """The report of the whole run, made of what shards have found. ShardError or OtherSettings where they do not fit."""

    known = registry(settings)

    def told(workspace: Workspace, past: Base | None) -> tuple[Testimony, Testimony | None]:
        fits(
            joined,
            version=__version__,
            settings=settings_digests(settings, known),
            workspace=content_digest(workspace),
            base=None if past is None else past.revision,
        )
        selection, _ = selection_of(settings, known)
        needed = is_inspected(workspace, selection.over(workspace.package_finder()), settings, known)
        return _testimony(joined, HEAD, needed), None if past is None else _testimony(joined, BASE, needed)

    try:
        return analyse(settings, store, told=told)
    except Unanswered as err:
        what = f"{err.path} ({err.tool})" if err.path else err.tool
        raise ShardError(f"no shard has answered for {what}", help=ANEW) from err


def _testimony(joined: Joined, side: str, needed: bool) -> Testimony:
    own = joined.wholes.get((ARCHITECTURE, side))
    if needed and own is None:
        raise ShardError(f"no shard has looked at the architecture ({side})", help=ANEW)
    recorded = Recorded(
        joined.versions(side), joined.fingerprints(side), joined.answers, joined.failures, joined.errors(side)
    )
    return Testimony(recorded, own if needed else None)


def content_digest(workspace: Workspace) -> str:
    """Of all that is analysed: files, packages, and what of it is reported on."""
    rows = [
        [[f.path, f.digest, f.language, f.package] for f in workspace.files],
        sorted([package.path, package.name] for package in workspace.packages),
        None if workspace.targets is None else sorted(workspace.targets),
    ]
    return hashlib.sha256(json.dumps(rows).encode()).hexdigest()


def settings_digests(settings: Settings, known: Registry) -> dict[str, str]:
    """A digest of the settings that change what the tools are to find, by where they are given."""
    values: dict[str, list[object]] = {}
    for field in fields(settings):
        if field.name not in _REPORTING:
            value = getattr(settings, field.name)
            if field.name == "compile_database" and value is not None:
                value = os.path.relpath(os.path.join(settings.root, value), settings.root)
            values.setdefault(_OPTIONS.get(field.name, "the project file"), []).append(plain(value))
    values["--plugin"] = [plain(known.components)]
    return {name: _digest(repr(value)) for name, value in values.items()}


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]


def _works(planned: Iterable[Work | Run]) -> list[Work]:
    return [work for work in planned if isinstance(work, Work)]


def _guess(sides: Iterable[Workspace]) -> int:
    """What the architecture of all *sides* may cost."""
    size = sum(file.size for side in sides for file in side.files if file.language in ARCHITECTURE_LANGUAGES)
    return int(size * ARCHITECTURE_COST)


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


def _inspected(
    sides: list[Workspace],
    past: Base | None,
    selection: Selection,
    architectures: Architectures,
    progress: Progress | None,
) -> Iterator[Whole]:
    """Our own runs of both sides; what they cost is told of the head's."""
    before = _cpu()
    runs = [
        inspected(
            own_run(side, architectures.registry),
            side,
            selection.over(side.package_finder()),
            architectures,
            progress,
            base,
        )
        for side, base in zip(sides, (past, None), strict=False)
    ]
    spent = int((_cpu() - before) * 1e6)
    for side, run in zip(SIDES, runs, strict=False):
        yield Whole(ARCHITECTURE, side, spent if side == HEAD else None, replace(run, analysed=frozenset()))


def _cpu() -> float:
    """CPU seconds of this process and of those that it has waited for."""
    return sum(os.times()[:4])


def _had(noted: Iterable[Noted]) -> Iterator[Had]:
    for side, tools in zip(SIDES, noted, strict=False):
        for tool, version in sorted(tools.versions.items()):
            yield Had(tool, side, version, tools.fingerprints.get(tool, ""), tools.errors.get(tool, ""))


def _trouble(
    planned: Iterable[Iterable[Work | Run]], failed: Iterable[Failed], wholes: Iterable[Whole]
) -> tuple[str, ...]:
    """Sentences on what did not succeed, each once; merge says them again and decides what follows."""
    sentences = [failure.message for failure in failed]
    runs = [run for side in planned for run in side if isinstance(run, Run)] + [whole.run for whole in wholes]
    sentences += [
        n.message for run in runs if not run.successful for n in run.notifications if n.level.value == "error"
    ]
    return tuple(dict.fromkeys(sentences))
