# SPDX-License-Identifier: Apache-2.0
"""Draw a seeded sample of endpoints, parameters and conditions from models for a check by hand.

`python handcheck.py MODEL.json... [--seed N] [--count N]` draws so many endpoints from each model; with `--evenly ENDPOINTS PARAMETERS
CONDITIONS` so many of each kind from all models together, one model after the other in turn. Left out: implicit ones and
those of known nodes. One entry for each distinct node type, kind, name, type and place; conditions are those of such an endpoint that has any.
"""

from __future__ import annotations

import argparse
import json
import random
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

KINDS = ("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients")
PARAMETERS = ("parameters", "getters", "setters")
Key = tuple[str, str, str, str, str]
Entries = dict[Key, dict[str, Any]]


def entries(model: dict[str, Any], kinds: tuple[str, ...] = KINDS) -> Entries:
    """Return the distinct endpoints of a model, each with the first configuration and node that has it."""
    found: Entries = {}
    for configuration in model["configurations"]:
        for node in configuration["nodes"]:
            for kind in kinds:
                for endpoint in node.get(kind, ()):
                    at = endpoint["location"]
                    if endpoint["implicit"] or at is None or endpoint["source"] != "source":
                        continue
                    place = f"{at['path']}:{at['line']}:{at['column']}"
                    key = (f"{node['package']}/{node['type']}", kind, endpoint["name"], str(endpoint["type"]), place)
                    where = {"configuration": configuration["name"], "node": node["name"], "remaps": node["remaps"]}
                    found.setdefault(key, {**where, "endpoint": endpoint})
    return found


def evenly(models: Mapping[str, Entries], count: int, seed: int) -> Iterator[tuple[str, Key, dict[str, Any]]]:
    """So many of all models together: one of each in turn, in a seeded order, as long as they have any."""
    draw = random.Random(seed)
    waiting = [(name, draw.sample(sorted(found), len(found))) for name, found in sorted(models.items()) if found]
    draw.shuffle(waiting)
    while waiting and count:
        name, keys = waiting.pop(0)
        key = keys.pop()
        yield name, key, models[name][key]
        count -= 1
        if keys:
            waiting.append((name, keys))


def with_conditions(found: Entries) -> Entries:
    """Those of the entries that stand under a condition."""
    return {key: each for key, each in found.items() if each["endpoint"]["conditions"]}


def main() -> None:
    """Print the sample of each model, one JSON object a line, behind a line with the number of entries it is drawn from."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--evenly", type=int, nargs=3, metavar=("ENDPOINTS", "PARAMETERS", "CONDITIONS"))
    given = parser.parse_args()
    models = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in given.models}
    if given.evenly is None:
        for name, model in models.items():
            found = entries(model)
            print(f"# {name}: {len(found)} entries")
            for key in random.Random(given.seed).sample(sorted(found), min(given.count, len(found))):
                print(json.dumps({"type": key[0], "kind": key[1], "at": key[4], **found[key]}))
        return
    endpoints = {name: entries(model) for name, model in models.items()}
    parameters = {name: entries(model, PARAMETERS) for name, model in models.items()}
    conditions = {name: with_conditions(endpoints[name] | parameters[name]) for name in models}
    for what, of, count in zip(
        ("endpoint", "parameter", "condition"), (endpoints, parameters, conditions), given.evenly, strict=True
    ):
        print(f"# {what}s: {sum(map(len, of.values()))} entries in {sum(map(bool, of.values()))} models")
        for name, key, each in evenly(of, count, given.seed):
            print(json.dumps({"draw": what, "model": name, "type": key[0], "kind": key[1], "at": key[4], **each}))


if __name__ == "__main__":
    main()
