# SPDX-License-Identifier: Apache-2.0
"""Draw a seeded sample of endpoints from models for a check by hand: `python handcheck.py MODEL.json... [--seed N] [--count N]`.
Left out: implicit endpoints and those of known nodes. One entry for each distinct node type, kind, name, type and place."""

from __future__ import annotations

import argparse
import json
import random
from pathlib import Path
from typing import Any

KINDS = ("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients")
Key = tuple[str, str, str, str, str]


def entries(model: dict[str, Any]) -> dict[Key, dict[str, Any]]:
    """Return the distinct endpoints of a model, each with the first configuration and node that has it."""
    found: dict[Key, dict[str, Any]] = {}
    for configuration in model["configurations"]:
        for node in configuration["nodes"]:
            for kind in KINDS:
                for endpoint in node[kind]:
                    at = endpoint["location"]
                    if endpoint["implicit"] or at is None or endpoint["source"] != "source":
                        continue
                    place = f"{at['path']}:{at['line']}:{at['column']}"
                    key = (f"{node['package']}/{node['type']}", kind, endpoint["name"], str(endpoint["type"]), place)
                    where = {"configuration": configuration["name"], "node": node["name"], "remaps": node["remaps"]}
                    found.setdefault(key, {**where, "endpoint": endpoint})
    return found


def main() -> None:
    """Print the sample of each model, one JSON object a line, behind a line with the number of entries it is drawn from."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--count", type=int, default=20)
    given = parser.parse_args()
    for path in given.models:
        found = entries(json.loads(path.read_text(encoding="utf-8")))
        print(f"# {path.name}: {len(found)} entries")
        for key in random.Random(given.seed).sample(sorted(found), min(given.count, len(found))):
            print(json.dumps({"type": key[0], "kind": key[1], "at": key[4], **found[key]}))


if __name__ == "__main__":
    main()
