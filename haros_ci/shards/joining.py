# SPDX-License-Identifier: Apache-2.0
"""Whether shards belong together, and what they say together. Whatever is doubtful is refused: half a run would look clean."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from haros_ci.records import dataclass
from haros_ci.results.result import Run
from haros_ci.shards.shard import BASE, HEAD, Header, RecordedAnswer, Shard, ShardError
from haros_ci.shards.shard_file import SAME, value_of


class OtherSettings(Exception):
    """The shards were made with other options than those given now: *names* of settings."""

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__(*names)
        self.names = tuple(names)


class AnswerValues(Mapping[tuple[str, str], object]):
    """The answers by tool and key, parsed when they are asked for."""

    def __init__(self, answers: Mapping[tuple[str, str], RecordedAnswer]) -> None:
        self._said = answers

    def __getitem__(self, key: tuple[str, str]) -> object:
        value = value_of(self._said[key])
        if value is None:
            raise KeyError(key)
        return value

    def __iter__(self) -> Iterator[tuple[str, str]]:
        return iter(self._said)

    def __len__(self) -> int:
        return len(self._said)


@dataclass(frozen=True, slots=True)
class Joined:
    """All that the shards say. ``wholes`` are by name and side, ``costs`` CPU microseconds by tool and path."""

    header: Header
    answers: AnswerValues
    failures: Mapping[tuple[str, str], tuple[tuple[str, tuple[str, ...]], ...]]
    wholes: Mapping[tuple[str, str], Run]
    costs: Mapping[str, Mapping[str, int]]
    names: tuple[str, ...]
    confined: frozenset[str]

    def versions(self, side: str) -> dict[str, str | None]:
        """Of the tools, None for one that was missing."""
        return {had.tool: had.version for had in self.header.tools if had.side == side}

    def errors(self, side: str) -> dict[str, str]:
        return {had.tool: had.error for had in self.header.tools if had.side == side and had.error}

    def fingerprints(self, side: str) -> dict[str, str]:
        return {had.tool: had.fingerprint for had in self.header.tools if had.side == side}


def join(shards: Iterable[Shard]) -> Joined:
    """The shards as one. Raises ShardError if one is missing, comes twice or is of another run."""
    shards = sorted(shards, key=lambda shard: (shard.header.number, shard.name))
    if not shards:
        raise ShardError("no shards to join", help="give the files that haros-ci check --shard has written")
    first = shards[0]
    for shard in shards[1:]:
        _of_one_run(first, shard)
    have: dict[int, Shard] = {}
    for shard in shards:
        twin = have.setdefault(shard.header.number, shard)
        if twin is not shard:
            raise ShardError(
                f"{twin.name} and {shard.name} are both shard {_label(shard)}", help="give each shard's file once"
            )
    missing = [n for n in range(1, first.header.of + 1) if n not in have]
    if missing:
        shown = ", ".join(f"{n}/{first.header.of}" for n in missing[:8]) + (" …" if len(missing) > 8 else "")
        raise ShardError(f"missing: shard {shown}", help="without all of them nothing can be said of the workspace")
    answers: dict[tuple[str, str], RecordedAnswer] = {}
    owners: dict[tuple[str, str], Shard] = {}
    failures: dict[tuple[str, str], dict[tuple[str, tuple[str, ...]], None]] = {}
    wholes: dict[tuple[str, str], Run] = {}
    costs: dict[str, dict[str, int]] = {}
    for shard in shards:
        for answer in shard.answers:
            key = (answer.tool, answer.key)
            if key in answers:
                raise ShardError(
                    f"{shard.name} and {owners[key].name} both answer for {answer.path} ({answer.tool})", help=ANEW
                )
            answers[key], owners[key] = answer, shard
            if answer.cost is not None:
                costs.setdefault(answer.tool, {})[answer.path] = answer.cost
        for failed in shard.failures:
            for failed_key in failed.keys:
                failures.setdefault((failed.tool, failed_key), {})[failed.message, failed.paths] = None
        for whole in shard.wholes:
            if (whole.name, whole.side) in wholes:
                raise ShardError(f"{shard.name}: a second {whole.name} of {whole.side}", help=ANEW)
            wholes[whole.name, whole.side] = whole.run
            if whole.cost is not None:
                costs.setdefault("", {})[whole.name] = whole.cost
    return Joined(
        first.header,
        AnswerValues(answers),
        {key: tuple(found) for key, found in failures.items()},
        wholes,
        costs,
        tuple(shard.name for shard in shards),
        frozenset(shard.header.confined for shard in shards),
    )


ANEW = "make all shards anew"


def _of_one_run(one: Shard, other: Shard) -> None:
    """Raises ShardError where the two are not of one run, with the plainest difference."""
    a, b = one.header, other.header
    pair = f"{one.name} (shard {_label(one)}) and {other.name} (shard {_label(other)})"
    if a.version != b.version:
        raise ShardError(f"{pair} are of haros-ci {a.version} and {b.version}", help=SAME)
    if a.of != b.of:
        raise ShardError(f"{pair} are of divisions into {a.of} and into {b.of}", help="give the shards of one run")
    if a.workspace != b.workspace:
        raise ShardError(f"{pair} have analysed different files", help="check out the same commit in all jobs")
    if a.base != b.base:
        raise ShardError(f"{pair} have compared with {a.base or 'nothing'} and {b.base or 'nothing'}", help=BASES)
    if a.settings != b.settings:
        named = ", ".join(differing(a.settings, b.settings))
        raise ShardError(f"{pair} were made with other settings: {named}", help="give all shards the same options")
    if a.tools != b.tools:
        mine, its = ({(t.tool, t.side): (t.version, t.fingerprint) for t in header.tools} for header in (a, b))
        tool, side = min(key for key in mine.keys() | its.keys() if mine.get(key) != its.get(key))
        versions = [_version(found.get((tool, side))) for found in (mine, its)]
        raise ShardError(
            f"{pair} have had {tool} {versions[0]} and {versions[1]}", help="install the same tools in all jobs"
        )
    if a.plan != b.plan:
        raise ShardError(
            f"{pair} have divided the work differently", help="give all shards the same --shard-costs file"
        )


BASES = "fetch as much history in all jobs (actions/checkout: fetch-depth: 0)"


def fits(joined: Joined, *, version: str, settings: Mapping[str, str], workspace: str, base: str | None) -> None:
    """Raises OtherSettings or ShardError where what is merged here is not what the shards have analysed."""
    header = joined.header
    if header.version != version:
        raise ShardError(f"the shards are of haros-ci {header.version}, and this is {version}", help=SAME)
    if header.settings != settings:
        raise OtherSettings(differing(header.settings, settings))
    if header.base != base:
        had, here = (f"commit {one[:12]}" if one else "nothing" for one in (header.base, base))
        raise ShardError(f"the shards have compared with {had}, and here it would be {here}", help=BASES)
    if header.workspace != workspace:
        raise ShardError(
            "the shards have analysed other files than those that are here",
            help="run merge in a checkout of the same commit, with the same paths",
        )


def differing(one: Mapping[str, str], other: Mapping[str, str]) -> list[str]:
    """The names under which the two differ."""
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))


def _label(shard: Shard) -> str:
    return f"{shard.header.number}/{shard.header.of}"


def _version(found: tuple[str | None, str] | None) -> str:
    if found is None:
        return "(not asked)"
    return "(missing)" if found[0] is None else found[0] or "(of unknown version)"


__all__ = ["BASE", "HEAD", "Joined", "OtherSettings", "differing", "fits", "join"]
