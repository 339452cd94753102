# SPDX-License-Identifier: Apache-2.0
"""Fictibot with seeded violations: which of them haros-ci verify finds.

    git clone https://github.com/git-afsantos/haros_tutorials
    python tests/bench/verify/fictibot.py haros_tutorials/src

The sources are copied, and fictibot.yaml is the project file. Each seed changes what the safety controller or the multiplexer promises, as a defect of
its code would; the launch file multiplexer.launch has one of its own as it is shipped (both outputs of the safety controller have one name).
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = (HERE / "fictibot.yaml").read_text()
LASER = '        - "globally: /laser {data <= 32} causes /cmd_stop within 200 ms"\n'
RANGE = '        - "globally: no /cmd_vel {not linear in [MIN_LINEAR to MAX_LINEAR]}"\n'
#: What is changed, to what, and which properties that breaks.
SEEDS = {
    "as it is": ("", "", ()),
    "safety controller: no branch for near obstacles": (LASER, "", ("laser_stops",)),
    "safety controller: stops at 20, not at 32": (LASER, LASER.replace("32", "20"), ("laser_stops",)),
    "safety controller: left and right bumper alone": ("/bumper {left or center or right} causes /cmd_stop within 200", "/bumper {left or right} causes /cmd_stop within 200", ("bumper_stops",)),
    "safety controller: any speed": (RANGE, "", ("speed",)),
    "safety controller: stops at 60": ("/laser {data <= 32}) within 200 ms", "/laser {data <= 60}) within 200 ms", ("reason",)),
    "multiplexer: 50 ms slower": ("/high_cmd_stop causes /cmd_stop within 150 ms", "/high_cmd_stop causes /cmd_stop within 200 ms", ("bumper_stops", "laser_stops")),
    "multiplexer: stops by itself": ('        - "globally: /cmd_stop requires (/high_cmd_stop or /normal_cmd_stop or /low_cmd_stop) within 150 ms"\n', "", ("reason",)),
    "multiplexer: sends what nobody asked for": ("requires (/high_cmd_vel {linear = @CMD.linear} or", "requires (/high_cmd_vel {linear != @CMD.linear} or", ("speed",)),
    "multiplexer: stop becomes a speed": ("/high_cmd_stop causes /cmd_stop within 150 ms", "/high_cmd_stop causes /cmd_vel within 150 ms", ("bumper_stops", "laser_stops")),
}  # fmt: skip


def verdicts(root: Path, configuration: str, network: tuple[str, ...] = ()) -> tuple[dict[str, str], float]:
    """What is found out about each property of a configuration, and the seconds of the processor."""
    command = [sys.executable, "-m", "haros_ci", "verify", ".", "--configuration", configuration, *network]
    before = os.times()
    done = subprocess.run([*command, "--output", "json"], cwd=root, capture_output=True, text=True)
    after = os.times()
    if done.returncode > 1:
        sys.exit(done.stderr)
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    return {one["id"]: one["verdict"] for one in json.loads(done.stdout)["properties"]}, spent


def main() -> int:
    missed = 0
    with tempfile.TemporaryDirectory() as directory:
        root = Path(directory) / "fictibot"
        shutil.copytree(sys.argv[1], root)
        for name, (old, new, expected) in SEEDS.items():
            assert old in PROJECT, name
            (root / ".haros-ci.yaml").write_text(PROJECT.replace(old, new, 1) if old else PROJECT)
            found, spent = verdicts(root, "walker")
            broken = tuple(key for key, verdict in found.items() if verdict == "violated")
            missed += broken != expected
            rest = sorted(set(found.values()) - {"violated"})
            print(
                f"{name}: violated {', '.join(broken) or 'nothing'}; else {', '.join(rest)}; {spent:.1f} s"
                + ("" if broken == expected else f"; EXPECTED {expected}"),
                flush=True,
            )
        found, spent = verdicts(root, "shipped")
        missed += found != {"shipped_bumper_stops": "violated"}
        print(f"multiplexer.launch as it is shipped: {found}; {spent:.1f} s")
    print(f"{missed} not as expected")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
