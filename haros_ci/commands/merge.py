# SPDX-License-Identifier: Apache-2.0
"""What ``haros-ci merge`` does: shards become the report that one run would have written."""

from __future__ import annotations

from pathlib import Path

import click

from haros_ci.commands.common import (
    Flags,
    Progress,
    demand_base,
    demand_baseline,
    renderers_of,
    reported,
    settings_from,
    under_cache,
)
from haros_ci.commands.output import parse_outputs
from haros_ci.commands.timings import with_timings
from haros_ci.errors import EXIT_TOOL_TROUBLE, UserError
from haros_ci.model.workspace import Workspace
from haros_ci.report.escape import terminal
from haros_ci.results.result import Report
from haros_ci.shards import costs, shard_file
from haros_ci.shards.division import MOST_SHARDS
from haros_ci.shards.joining import OtherSettings, join
from haros_ci.shards.shard import Shard, ShardError
from haros_ci.workspace.cache import DiskCache, MemoryCache
from haros_ci.workspace.files import TooLarge, read_regular
from haros_ci.writing import write


@with_timings
def merge(flags: Flags) -> int:
    """Join, report, and give the exit code of a check. 3, and no report, where shards do not make a whole."""
    settings = settings_from(flags)
    demand_base(settings)
    renderers = renderers_of(settings)
    outputs = parse_outputs(flags["output"], renderers)
    try:
        joined = join(shards_of(flags["files"]))

        def work(store: DiskCache | MemoryCache, progress: Progress) -> tuple[Report, Workspace]:
            from haros_ci.shards.sharding import merged

            return merged(settings, store, joined)

        report, workspace = under_cache(work, settings, flags)
    except OtherSettings as err:
        names = ", ".join(name for name in err.names)
        raise UserError(
            f"the shards were made with other settings: {names}",
            help="give merge the options that the shards were given",
        ) from err
    except ShardError as err:
        click.echo(f"error: {terminal(err.message)}", err=True)
        if err.help:
            click.echo(f"help: {terminal(err.help)}", err=True)
        return EXIT_TOOL_TROUBLE
    demand_baseline(report, settings)
    code = reported(report, workspace, outputs, renderers, settings, flags)
    if flags["write_costs"]:
        write(costs.written(joined.costs), Path(flags["write_costs"]))
    return code


def shards_of(names: tuple[str, ...]) -> list[Shard]:
    """The shards in the files *names*. Raises ShardError."""
    if len(names) > MOST_SHARDS:
        raise ShardError(f"more than {MOST_SHARDS} shard files", help="give the shards of one run")
    return [shard_file.parsed(_bytes(name), name) for name in names]


def _bytes(name: str) -> bytes:
    try:
        data = read_regular(name, shard_file.MAX_BYTES)
    except TooLarge:
        raise ShardError(f"{name}: larger than {shard_file.MAX_BYTES // 1_000_000} MB") from None
    except OSError as err:
        raise ShardError(f"{name}: cannot be read: {err.strerror}", help="check the path") from None
    if data is None:
        raise ShardError(f"{name}: not a regular file", help="check the path")
    return data
