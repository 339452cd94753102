# SPDX-License-Identifier: Apache-2.0
"""The file of what each part of a run has cost: merge writes it, the next run's shards divide the work by it."""

from __future__ import annotations

import json
from collections.abc import Mapping

from haros_ci.results.values import LARGEST

FORMAT = 1
MAX_BYTES = 200_000_000

#: CPU microseconds by tool and path; under the tool "" those of what is done once, by its name.
Costs = Mapping[str, Mapping[str, int]]


class NoCosts(ValueError):
    """Not a file of costs; the message says why."""


def written(costs: Costs) -> str:
    rows = {tool: dict(sorted(by_path.items())) for tool, by_path in sorted(costs.items())}
    return json.dumps({"haros-ci-costs": FORMAT, "costs": rows}, separators=(",", ":"), indent=0) + "\n"


def parsed(data: bytes) -> Costs:
    """Raises NoCosts. A file of another format is as good as none: it only makes the shares less even."""
    try:
        found = json.loads(data.decode("ascii"))
    except (ValueError, RecursionError):
        raise NoCosts("not JSON") from None
    if not isinstance(found, dict) or "haros-ci-costs" not in found:
        raise NoCosts("no file that haros-ci merge --write-costs has written")
    if found["haros-ci-costs"] != FORMAT:
        return {}
    costs = found.get("costs")
    if not isinstance(costs, dict) or not all(isinstance(by_path, dict) for by_path in costs.values()):
        raise NoCosts("without costs")
    if not all(type(c) is int and 0 <= c <= LARGEST for by_path in costs.values() for c in by_path.values()):
        raise NoCosts("a cost that is none")
    return costs
