# SPDX-License-Identifier: Apache-2.0
"""Prints the README rows that a model lacks or has with another type, by package: readme_misses.py MISSES.json."""

from __future__ import annotations

import json
import sys
from itertools import groupby
from pathlib import Path
from typing import Any


def kind(row: dict[str, Any]) -> str:
    """What is wrong with *row*: it is missed, may be a name with an unknown part, or has another type."""
    if row["match"] is not None:
        return "type"
    return "unknown" if row.get("unknown") else "missed"


def place(row: dict[str, Any]) -> tuple[str, str, int, str]:
    """The order of the rows: package, file, line, name."""
    return row["package"], row["file"], row["line"], row["name"]


def lines(rows: list[dict[str, Any]]) -> list[str]:
    """One heading per package and role with its counts, then one line per row."""
    found: list[str] = []
    ordered = sorted(rows, key=lambda row: (row["package"], row["role"], place(row)))
    for (package, role), group in groupby(ordered, key=lambda row: (row["package"], row["role"])):
        members = list(group)
        counts = [f"{sum(kind(row) == name for row in members)} {name}" for name in ("missed", "unknown", "type")]
        found.append(f"{package} {role}: {', '.join(counts)}")
        for row in members:
            said = f"{row['name']} ({row['type']})"
            model = f", the model has {row['found']['type']}" if row["match"] is not None else ""
            verdict = f" [{row['verdict']}: {row['reason']}]" if row.get("verdict") else ""
            found.append(f"  {row['file']}:{row['line']}: {kind(row)}: {said}{model}{verdict}")
    return found


def main(arguments: list[str]) -> int:
    """Print the file of misses that the comparison wrote; 2 when it is not named."""
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    rows = json.loads(Path(arguments[0]).read_text(encoding="utf-8"))["misses"]
    print("\n".join(lines(rows)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
