# SPDX-License-Identifier: Apache-2.0
"""Fuzz the readers of bytes that a workspace brings: ``python tests/fuzz/run.py --seconds 60 [TARGET...]``.

Each target has a process of its own. What goes wrong is written to the directory of findings, and the exit status is 1.
docs/fuzzing.md says more.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path[:] = [str(HERE.parent)] + [place for place in sys.path if place not in ("", str(HERE))]

from fuzz import worker
from fuzz.execute import SECONDS, Finding

CORPUS = HERE / "corpus"
#: A process whose present input is the same for so many seconds on the clock is stuck where Python cannot stop it.
STUCK = 12 * SECONDS


def parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser(description="Fuzz the readers of what a workspace brings.")
    made.add_argument("targets", nargs="*", metavar="TARGET", help="or a group of them; all if none is named")
    made.add_argument("--seconds", type=float, default=60.0, help="for each target (60)")
    made.add_argument("--inputs", type=int, help="so many changed inputs for each target, the same on every machine")
    made.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="targets at a time (the processors)")
    made.add_argument("--seed", type=int, default=0, help="another seed makes other inputs (0)")
    made.add_argument("--findings", type=Path, default=Path("fuzz-findings"), help="where findings go (fuzz-findings)")
    made.add_argument("--grow", type=Path, help="a directory of inputs by target: read at the start, added to")
    made.add_argument("--merge", type=Path, help="store those inputs of DIR/TARGET that reach something new, and end")
    made.add_argument("--list", action="store_true", help="print the targets and end")
    made.add_argument("--state", type=Path, help=argparse.SUPPRESS)
    return made


def files_of(directory: Path) -> list[Path]:
    """The inputs in *directory*, in the order of their names."""
    return [path for path in sorted(directory.glob("*")) if path.is_file()]


def watched(name: str, seconds: float, options: argparse.Namespace) -> list[dict[str, Any]]:
    """Run the processes of a target until its time is over: after one that died there is another."""
    told = []
    end = time.monotonic() + seconds
    attempt = 0
    while (left := end - time.monotonic()) > 0 or not attempt:
        found, is_over = process(name, max(left, 0.5), options.seed * 1000 + attempt, options)
        told.append(found)
        attempt += 1
        if is_over or attempt > 20 or options.inputs is not None:
            break
    return told


def process(name: str, seconds: float, seed: int, options: argparse.Namespace) -> tuple[dict[str, Any], bool]:
    """One process. Its statistics, and whether it came to its end by itself."""
    with tempfile.TemporaryDirectory(prefix="haros-ci-fuzz-") as scratch:
        state = Path(scratch, "state")
        state.write_bytes(bytes(worker.STATE))
        command = [sys.executable, str(HERE / "run.py"), name, "--state", str(state), "--seconds", str(seconds)]
        command += ["--seed", str(seed), "--findings", str(options.findings)]
        for flag in ("inputs", "grow", "merge"):
            command += [f"--{flag}", str(getattr(options, flag))] if getattr(options, flag) is not None else []
        environment = {**os.environ, "PYTHONHASHSEED": str(seed % 1000), "TMPDIR": scratch}
        with open(Path(scratch, "said"), "w+b") as said, open(Path(scratch, "err"), "w+b") as err:
            child = subprocess.Popen(command, stdout=said, stderr=err, env=environment, stdin=subprocess.DEVNULL)
            status = wait(child, state)
            said.seek(0)
            err.seek(0)
            lines, trouble = said.read().decode().splitlines(), err.read().decode("utf-8", "replace")
        if status == 0 and lines:
            return json.loads(lines[-1]), True
        count, data = worker.present(state)
        if not count:  # before its first input
            raise SystemExit(f"{name}: {trouble}")
        kind = "stuck" if status is None else f"died{status}"
        worker.report(options.findings, name, data, Finding(kind, "", trouble[-4000:]))
        return {"inputs": count, "blocks": 0, "kept": 0, "slowest": 0.0, "megabytes": 0}, False


def wait(child: subprocess.Popen[bytes], state: Path) -> int | None:
    """The exit status; None, and the process is killed, if it stays with one input."""
    count, since = -1, time.monotonic()
    while child.poll() is None:
        time.sleep(0.2)
        now, _ = worker.present(state)
        if now != count:
            count, since = now, time.monotonic()
        elif time.monotonic() - since > STUCK + (60 if count <= 0 else 0):
            child.kill()
            child.wait()
            return None
    return child.returncode


def main(arguments: list[str]) -> int:
    """Fuzz; 1 if there are findings, 2 for a target that is not there."""
    options = parser().parse_args(arguments)
    if options.state is not None:  # its modules are to be instrumented before they are imported
        (name,) = options.targets
        more = files_of(options.merge / name) if options.merge is not None else []
        seeds = files_of(CORPUS / name) + (files_of(options.grow / name) if options.grow is not None else [])
        worker.main(name, options, seeds, more, CORPUS / name)
        return 0
    from fuzz.targets import GROUPS, NAMES, entry

    if options.list:
        print("\n".join(f"{name}: {entry(name).what}" for name in NAMES))
        return 0
    named = [name for word in options.targets for name in GROUPS.get(word, (word,))]
    unknown = sorted(set(named) - set(NAMES))
    if unknown:
        print(f"no such target: {', '.join(unknown)}; --list names them", file=sys.stderr)
        return 2
    before = {path: path.stat().st_mtime_ns for path in options.findings.glob("*")}
    chosen = list(dict.fromkeys(named)) or list(NAMES)
    with ThreadPoolExecutor(max(1, options.jobs)) as pool:
        for name, told in zip(
            chosen, pool.map(lambda name: watched(name, options.seconds, options), chosen), strict=True
        ):
            inputs, blocks = sum(each["inputs"] for each in told), max(each["blocks"] for each in told)
            slowest = max(each["slowest"] for each in told)
            print(f"{name:24} {inputs:8} inputs {blocks:6} blocks, slowest {slowest:.2f} s", flush=True)
    found = sorted(p for p in options.findings.glob("*.txt") if before.get(p) != p.stat().st_mtime_ns)
    for path in found:
        print(f"\n{path.with_suffix('')}: {path.read_text('utf-8')}")
    print(f"{len(found)} findings" if found else "no finding")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
