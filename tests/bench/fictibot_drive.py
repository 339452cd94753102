# SPDX-License-Identifier: Apache-2.0
"""A minute of Fictibot's safe_random_walker as lines of JSON, as the code of its nodes (haros_tutorials, 6576ae6) behaves: drawn, not recorded.

    python tests/bench/fictibot_drive.py > drive.jsonl
    haros-ci monitor TUTORIALS --jsonl drive.jsonl --configuration safe_random_walker --output json=drive.json
    haros-ci report TUTORIALS --verdicts drive.json

Ten turns a second, milliseconds between nodes; the laser, bumps and dropped wheels are drawn with seed 7. ``projects/hpl.yaml`` is the project file, as ``haros.yaml``.
"""

from __future__ import annotations

import json
import math
import random
from collections.abc import Iterator
from typing import Any

Line = tuple[float, str, dict[str, Any]]
STOPPED = {"linear": 0.0, "angular": 0.0}
BUMPS, DROPS, TURNS = (90, 305, 460), (200, 512), 600


def lines() -> Iterator[Line]:
    drawn, laser = random.Random(7), 110
    safety, inactivity, change = (
        0.0,
        0,
        0.0,
    )  # the timers of the safety controller, the multiplexer and the random controller
    for turn in range(TURNS):
        time = turn * 0.1
        laser = max(5, min(127, laser + drawn.choice((-9, -6, -4, 3, 5, 8)))) if turn % 150 < 100 else 120
        yield time, "laser", {"data": laser}
        if turn in BUMPS or turn - 1 in BUMPS:
            yield time + 0.001, "bumper", {"left": turn in BUMPS, "center": False, "right": False}
        if turn in DROPS or turn - 1 in DROPS:
            yield time + 0.001, "wheel", {"left": False, "right": turn in DROPS}
        kind = "cmd_vel" if laser <= 64 else "cmd_stop" if turn in BUMPS or turn in DROPS else ""
        if kind and safety <= 1e-9:
            safety = 1.0
            message = STOPPED if kind == "cmd_vel" else {}
            yield time + 0.010, f"high_{kind}", message
            yield time + 0.015, kind, message
            yield time + 0.016, "state", {"data": 1}
            inactivity = 10
        safety -= 0.1
        inactivity -= 1
        if inactivity < 0:
            inactivity = 10
            yield time + 0.018, "state", {"data": -1}
        change -= 0.1
        if laser <= 50 or change <= 0:  # it publishes on /cmd_vel: the remapping of cmd_vel does not reach that
            change = 5.0
            angle = (drawn.randrange(360) - 180) * math.pi / 180
            yield time + 0.020, "/cmd_vel", {"linear": drawn.randrange(2000) / 1000 - 1, "angular": angle}


def main() -> None:
    for time, topic, message in sorted(lines(), key=lambda line: line[0]):
        name = topic if topic.startswith("/") else f"/fictibot/{topic}"
        print(json.dumps({"topic": name, "time": round(time, 3), "msg": message}))


if __name__ == "__main__":
    main()
