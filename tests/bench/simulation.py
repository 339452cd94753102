# SPDX-License-Identifier: Apache-2.0
"""What the model says of simulators, against lists made by hand from descriptions, plug-ins and bridges.

    python tests/bench/simulation.py CHECKOUTS tests/bench/simulation_lists/*.json

CHECKOUTS has, for each list, a directory of its ``directory``'s name with checkouts of its ``workspace``; ``haros-ci model`` runs
there on its ``launch`` file, with its ``environment``. A row is one endpoint of the simulator, of what runs in its process or of a bridge, with
its kind, resolved name and type, and the place in one of the ``sources`` that makes it. It is found where any node of the model has it. What every
node has of the client library (``implicit``) is not listed; what else the nodes called ``processes`` have beyond the rows is too much.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

Row = Mapping[str, Any]
KINDS = ("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients")


@dataclass(frozen=True)
class Comparison:
    """Rows *found* with the endpoint of the model, *missing*, those *different* in type with that of the model, and *extra* endpoints with their node."""

    found: tuple[tuple[Row, Row], ...]
    missing: tuple[Row, ...]
    different: tuple[tuple[Row, str], ...]
    extra: tuple[tuple[str, Row], ...]


def compare(rows: Sequence[Row], processes: Sequence[str], nodes: Sequence[Row]) -> Comparison:
    """Each row with the endpoints of *nodes*."""
    there: dict[tuple[str, str], list[Row]] = {}
    for node in nodes:
        for kind in KINDS:
            for end in node[kind]:
                there.setdefault((kind, end["name"]), []).append(end)
    listed = {(row["kind"], row["name"]) for row in rows}
    found, missing, different = [], [], []
    for row in rows:
        ends = there.get((row["kind"], row["name"]), [])
        fitting = [end for end in ends if end["type"] == row["type"]]
        if fitting:
            found.append((row, min(fitting, key=is_undecided)))
        elif ends:
            different.append((row, ", ".join(sorted({end["type"] or "?" for end in ends}))))
        else:
            missing.append(row)
    extra = [
        (node["name"], {**end, "kind": kind})
        for node in nodes
        if node["name"] in processes
        for kind in KINDS
        for end in node[kind]
        if not end["implicit"] and (kind, end["name"]) not in listed
    ]
    return Comparison(tuple(found), tuple(missing), tuple(different), tuple(extra))


def is_undecided(end: Row) -> bool:
    """Whether the model leaves open if an endpoint is there, such as one that only some releases have."""
    return any(unknown["field"] == "conditions" for unknown in end["unknowns"])


def nodes_of(root: Path, listed: Mapping[str, Any]) -> list[Row]:
    """The nodes of *listed*'s launch file alone, in its checkouts below *root*; none if the command fails."""
    with tempfile.TemporaryDirectory() as scratch:
        output = Path(scratch, "model.json")
        command = [sys.executable, "-m", "haros_ci", "model", ".", "--isolated", "--format=json"]
        command += [f"--output={output}", f"--cache-dir={scratch}/cache", f"--launch={listed['launch']}"]
        command += [f"--env={name}={value}" for name, value in listed["environment"].items()]
        done = subprocess.run(command, cwd=root / listed["directory"], capture_output=True, text=True, check=False)
        if not output.exists():
            print(done.stderr, file=sys.stderr)
            return []
        model = json.loads(output.read_text())
        return [node for configuration in model["configurations"] for node in configuration["nodes"]]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("checkouts", type=Path, help="a directory of checkouts")
    parser.add_argument("list", nargs="+", type=Path)
    options = parser.parse_args()
    print("| list | rows | found (undecided) | missing | of another type | too many: known | undecided | `?` |")
    print("|---|---|---|---|---|---|---|---|")
    details: list[str] = []
    for path in options.list:
        listed = json.loads(path.read_text())
        result = compare(listed["rows"], listed["processes"], nodes_of(options.checkouts, listed))
        unknown = sum("?" in end["name"] for _, end in result.extra)
        open_ = sum("?" not in end["name"] and is_undecided(end) for _, end in result.extra)
        found = f"{len(result.found)} ({sum(is_undecided(end) for _, end in result.found)})"
        counts = (len(listed["rows"]), found, len(result.missing), len(result.different))
        counts = (*counts, len(result.extra) - open_ - unknown, open_, unknown)
        print(f"| {path.stem} | {' | '.join(map(str, counts))} |")
        details += [f"{path.stem}: missing: {row['kind']} {row['name']} {row['type']}" for row in result.missing]
        details += [f"{path.stem}: type: {row['name']} {row['type']}, {seen}" for row, seen in result.different]
        details += [f"{path.stem}: too many: {node}: {end['kind']} {end['name']}" for node, end in result.extra]
    print("\n".join(("", *details)))


if __name__ == "__main__":
    main()
