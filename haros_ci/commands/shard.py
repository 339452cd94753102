# SPDX-License-Identifier: Apache-2.0
"""What ``haros-ci check --shard I/N`` does: one part of a run, written for ``haros-ci merge``."""

from __future__ import annotations

from pathlib import Path

import click

from haros_ci.baselines import read_input
from haros_ci.commands.common import Flags, Progress, demand_base, settings_from, under_cache, warn_of_missing_base
from haros_ci.commands.timings import with_timings
from haros_ci.errors import UserError
from haros_ci.report.escape import terminal
from haros_ci.shards import costs, shard_file
from haros_ci.shards.division import MOST_SHARDS, parse_shard
from haros_ci.shards.shard import Shard
from haros_ci.workspace.cache import DiskCache, MemoryCache
from haros_ci.writing import write


@with_timings
def shard(flags: Flags) -> int:
    """Do one part and write it. 0 even where a tool failed: the file says so, and merge decides what that means."""
    path = destination(flags)
    parsed = parse_shard(flags["shard"])
    if parsed is None:
        raise UserError(
            f"--shard {flags['shard']}: not a shard", help=f"I/N with 1 <= I <= N <= {MOST_SHARDS}, as in --shard 2/4"
        )
    number, of = parsed
    settings = settings_from(flags)
    demand_base(settings)
    warn_of_missing_base(settings)
    remembered = costs_of(flags["shard_costs"])

    def work(store: DiskCache | MemoryCache, progress: Progress) -> tuple[Shard, tuple[str, ...]]:
        from haros_ci.shards.sharding import part

        return part(settings, store, number, of, remembered, progress)

    made, problems = under_cache(work, settings, flags)
    write(shard_file.written(made), path)
    for sentence in problems:
        click.echo(f"warning: {terminal(sentence)}", err=True)
    click.echo(f"shard {number}/{of}: {len(made.answers)} answers; haros-ci merge joins them", err=True)
    return 0


def destination(flags: Flags) -> Path:
    """FILE of ``--output shard=FILE``; UserError if something else is asked for, which only the whole run can give."""
    for flag in ("fix", "diff", "show_settings"):
        if flags[flag]:
            raise UserError(f"--{flag.replace('_', '-')} is not for one shard", help="leave out --shard")
    outputs = [item.partition("=") for item in flags["output"]]
    if len(outputs) != 1 or outputs[0][0] != "shard" or not outputs[0][2]:
        raise UserError(
            "--shard writes one file and no report",
            help="give --output shard=FILE here, other formats to haros-ci merge",
        )
    return Path(outputs[0][2])


def costs_of(name: str | None) -> costs.Costs:
    """The contents of the file *name*; empty if the file does not exist yet, as on the first run."""
    if name is None or not Path(name).exists():
        return {}
    try:
        return costs.parsed(read_input(Path(name), name))
    except costs.NoCosts as err:
        raise UserError(f"{name}: {err}", help="delete it; haros-ci merge --write-costs writes another") from err
