# SPDX-License-Identifier: Apache-2.0
"""What the model starts for a launch file, against lists made by hand from the text of the launch files.

    haros-ci model --isolated --launch pkg/launch/x.launch.py --format json --output MODEL.json   (in the checkout)
    python tests/bench/launch_lists.py MODEL.json tests/bench/launch_lists/x.json...
    python tests/bench/launch_lists.py CHECKOUTS tests/bench/launch_lists/*.json

CHECKOUTS is a directory with a checkout of each list's ``repository``; the command is then run for each list, with its
``arguments``. A row without a name is of a program that names itself: package, type and namespace must fit. A row that
is not ``certain`` is open: the defaults do not decide it, and it may be there or not. Nodes that a listed program makes
beside its own are no extras.
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


@dataclass(frozen=True)
class Comparison:
    """Rows *found* with their nodes, *missing* rows, *open* rows that are absent, and *extra* nodes."""

    found: tuple[tuple[Row, Row], ...]
    missing: tuple[Row, ...]
    open: tuple[Row, ...]
    extra: tuple[Row, ...]

    @property
    def different(self) -> tuple[tuple[Row, Row, tuple[str, ...]], ...]:
        """The found ones that are not as listed: row, node and what differs."""
        pairs = ((row, node, differences(row, node)) for row, node in self.found)
        return tuple(pair for pair in pairs if pair[2])


def compare(rows: Sequence[Row], nodes: Sequence[Row]) -> Comparison:
    """Rows are paired with nodes by name, then by what they start, then by the line that starts them.

    Nodes whose provenance is ``source`` are left out: a program that was started makes them.
    """
    left = [node for node in nodes if node.get("source") != "source"]
    found: list[tuple[Row, Row]] = []
    waiting = list(rows)
    for fits in (same_name, same_program, same_place):
        for row in tuple(waiting):
            candidates = [node for node in left if fits(row, node)]
            if candidates:
                best = min(candidates, key=lambda node, row=row: (len(differences(row, node)), nodes.index(node)))
                left.remove(best)
                waiting.remove(row)
                found.append((row, best))
    return Comparison(
        tuple(found),
        tuple(row for row in waiting if row["certain"]),
        tuple(row for row in waiting if not row["certain"]),
        tuple(left),
    )


def same_name(row: Row, node: Row) -> bool:
    return bool(row["name"] == node["name"])


def same_program(row: Row, node: Row) -> bool:
    """Whether *node* is that of a row without a name."""
    started = node["package"] == row["package"] and node["type"] == row["type"]
    space = row.get("namespace", "/").rstrip("/") + "/"
    return row["name"] is None and started and node["name"].rpartition("/")[0] + "/" in (space, "/?/")


def same_place(row: Row, node: Row) -> bool:
    place = node.get("location") or {}
    return (place.get("path"), place.get("line")) == (row["file"], row["line"])


def differences(row: Row, node: Row) -> tuple[str, ...]:
    """What of *node* is not as *row* says, each as ``field: listed, in the model``; the line counts last."""
    pairs = [(field, row[field], node[field]) for field in ("package", "type")]
    if row["name"] is not None:
        pairs.append(("name", row["name"], node["name"]))
    elif not same_program(row, node):
        pairs.append(("namespace", row.get("namespace", "/"), node["name"]))
    pairs.append(("container", row["container"], node.get("container")))
    place = node.get("location") or {}
    pairs.append(("place", f"{row['file']}:{row['line']}", f"{place.get('path')}:{place.get('line')}"))
    pairs.append(("certain", row["certain"], not node["conditions"]))
    return tuple(
        f"{field}: {listed}, {seen}" for field, listed, seen in pairs if listed != seen and not (listed == "?" == seen)
    )


def nodes_of(model: Mapping[str, Any], launch: str) -> Sequence[Row] | None:
    """The nodes of the configuration that is *launch*; None if there is none."""
    for configuration in model["configurations"]:
        if launch == configuration["name"] or list(configuration["launch"]) == [launch]:
            return list(configuration["nodes"])
    return None


def run(root: Path, listed: Mapping[str, Any]) -> Mapping[str, Any]:
    """The model of *listed*'s launch file alone, in the checkout below *root*; without configurations if it fails."""
    with tempfile.TemporaryDirectory() as scratch:
        output = Path(scratch, "model.json")
        command = [sys.executable, "-I", "-m", "haros_ci", "model", ".", "--isolated", "--format=json"]
        command += [f"--output={output}", f"--cache-dir={scratch}/cache", f"--launch={listed['launch']}"]
        command += [f"--arg={name}:={value}" for name, value in listed["arguments"].items()]
        done = subprocess.run(command, cwd=root / listed["repository"], capture_output=True, text=True, check=False)
        if not output.exists():
            print(done.stderr, file=sys.stderr)
            return {"configurations": []}
        return dict(json.loads(output.read_text()))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path, help="a model, or a directory of checkouts")
    parser.add_argument("list", nargs="+", type=Path)
    options = parser.parse_args()
    print("| launch file | rows | found | missing | open | extra | different |")
    print("|---|---|---|---|---|---|---|")
    details: list[str] = []
    for path in options.list:
        listed = json.loads(path.read_text())
        alone = options.model.is_dir()
        model = run(options.model, listed) if alone else json.loads(options.model.read_text())
        nodes = nodes_of(model, listed["launch"])
        title = f"{listed['repository']}: {listed['launch']}"
        if nodes is None:
            print(f"| {title} | {len(listed['nodes'])} | not in the model | | | | |")
            continue
        result = compare(listed["nodes"], nodes)
        numbers = (result.found, result.missing, result.open, result.extra, result.different)
        print(f"| {title} | {len(listed['nodes'])} | " + " | ".join(str(len(number)) for number in numbers) + " |")
        details += [f"{title}: missing: {shown(row)} {row['file']}:{row['line']}" for row in result.missing]
        details += [f"{title}: extra: {shown(node)}" for node in result.extra]
        details += [f"{title}: different: {shown(row)}: {'; '.join(what)}" for row, _, what in result.different]
    print("\n".join(("", *details)))


def shown(row: Row) -> str:
    return f"{row['name'] or row.get('namespace', '/') + ' …'} ({row['package']}/{row['type']})"


if __name__ == "__main__":
    main()
