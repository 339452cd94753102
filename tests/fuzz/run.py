# SPDX-License-Identifier: Apache-2.0
"""Fuzz the readers of bytes that a workspace brings: ``python tests/fuzz/run.py --seconds 60 [TARGET...]``.

Each target has a process of its own; with ``--inputs`` it is forked from one that has imported the modules of all. What goes wrong is written to the directory of findings, and the exit status is 1.
docs/fuzzing.md says more.
"""

from __future__ import annotations

import argparse
import gc
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import IO, Any

HERE = Path(__file__).resolve().parent
sys.path[:] = [str(HERE.parent)] + [place for place in sys.path if place not in ("", str(HERE))]

from fuzz import worker
from fuzz.execute import SECONDS, Finding
from fuzz.instrument import Coverage, install

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


def watched(name: str, options: argparse.Namespace) -> list[dict[str, Any]]:
    """Run the processes of a target until its time is over: after one that died there is another."""
    told = []
    end = time.monotonic() + options.seconds
    attempt = 0
    while (left := end - time.monotonic()) > 0 or not attempt:
        found, is_over = process(name, max(left, 0.5), options.seed * 1000 + attempt, options)
        told.append(found)
        attempt += 1
        if is_over or attempt > 20:
            break
    return told


def process(name: str, seconds: float, seed: int, options: argparse.Namespace) -> tuple[dict[str, Any], bool]:
    """One process. Its statistics, and whether it came to its end by itself."""

    def start(state: Path, said: IO[bytes], err: IO[bytes]) -> subprocess.Popen[bytes]:
        command = [sys.executable, str(HERE / "run.py"), name, "--state", str(state), "--seconds", str(seconds)]
        command += ["--seed", str(seed), "--findings", str(options.findings)]
        for flag in ("inputs", "grow", "merge"):
            command += [f"--{flag}", str(getattr(options, flag))] if getattr(options, flag) is not None else []
        environment = {**os.environ, "PYTHONHASHSEED": str(seed % 1000), "TMPDIR": str(state.parent)}
        return subprocess.Popen(command, stdout=said, stderr=err, env=environment, stdin=subprocess.DEVNULL)

    return watched_process(name, options.findings, start)


def watched_process(
    name: str, findings: Path, start: Callable[[Path, IO[bytes], IO[bytes]], subprocess.Popen[bytes] | Forked]
) -> tuple[dict[str, Any], bool]:
    """Wait for the process that *start* makes with a file of its state and those of its output; what ends it is a finding."""
    with tempfile.TemporaryDirectory(prefix="haros-ci-fuzz-") as scratch:
        state = Path(scratch, "state")
        state.write_bytes(bytes(worker.STATE))
        with open(Path(scratch, "said"), "w+b") as said, open(Path(scratch, "err"), "w+b") as err:
            status = wait(start(state, said, err), state)
            said.seek(0)
            err.seek(0)
            lines, trouble = said.read().decode().splitlines(), err.read().decode("utf-8", "replace")
        if status == 0 and lines:
            return json.loads(lines[-1]), True
        count, data = worker.present(state)
        if not count:  # before its first input
            raise SystemExit(f"{name}: {trouble}")
        kind = "stuck" if status is None else f"died{status}"
        worker.report(findings, name, data, Finding(kind, "", trouble[-4000:]))
        return {"inputs": count, "blocks": 0, "kept": 0, "slowest": 0.0, "megabytes": 0}, False


class Forked:
    """A copy of this process that runs one target, with what `wait` asks of a process."""

    def __init__(self, run: Callable[[], None], state: Path, said: IO[bytes], err: IO[bytes]) -> None:
        self.returncode: int | None = None
        sys.stdout.flush()
        self.pid = os.fork()
        if self.pid:
            return
        status = 1
        try:
            os.environ["TMPDIR"] = tempfile.tempdir = str(state.parent)
            for number, stream in enumerate((said, err), start=1):
                os.dup2(stream.fileno(), number)
            run()
            sys.stdout.flush()
            status = 0
        except BaseException:
            traceback.print_exc()
            sys.stderr.flush()
        finally:
            os._exit(status)

    def poll(self) -> int | None:
        if self.returncode is None:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            self.returncode = os.waitstatus_to_exitcode(status) if pid else None
        return self.returncode

    def kill(self) -> None:
        os.kill(self.pid, signal.SIGKILL)

    def wait(self) -> None:
        _, status = os.waitpid(self.pid, 0)
        self.returncode = os.waitstatus_to_exitcode(status)


def wait(child: subprocess.Popen[bytes] | Forked, state: Path) -> int | None:
    """The exit status; None, and the process is killed, if it stays with one input."""
    count, since = -1, time.monotonic()
    while child.poll() is None:
        time.sleep(0.05)
        now, _ = worker.present(state)
        if now != count:
            count, since = now, time.monotonic()
        elif time.monotonic() - since > STUCK + (60 if count <= 0 else 0):
            child.kill()
            child.wait()
            return None
    return child.returncode


class Shared:
    """What the processes of `for_inputs` have from the one that they are forked from."""

    options: argparse.Namespace
    coverage: Coverage


def forked(name: str) -> list[dict[str, Any]]:
    """Run a target for so many inputs in a copy of this process, whose modules are instrumented."""
    options, coverage = Shared.options, Shared.coverage

    def start(state: Path, said: IO[bytes], err: IO[bytes]) -> Forked:
        its = argparse.Namespace(**{**vars(options), "state": state, "seed": options.seed * 1000})
        return Forked(lambda: target(name, its, coverage), state, said, err)

    return [watched_process(name, options.findings, start)[0]]


def for_inputs(names: list[str]) -> Iterator[list[dict[str, Any]]]:
    """Statistics of *names*, in their order. To import and instrument the modules takes longer than three inputs: it is done once for all."""
    from fuzz.targets import entry

    for name in names:
        entry(name)
    gc.freeze()
    with multiprocessing.get_context("fork").Pool(max(1, Shared.options.jobs)) as pool:
        yield from pool.imap(forked, names)


def target(name: str, options: argparse.Namespace, coverage: Coverage | None = None) -> None:
    """Fuzz one target in this process."""
    more = files_of(options.merge / name) if options.merge is not None else []
    seeds = files_of(CORPUS / name) + (files_of(options.grow / name) if options.grow is not None else [])
    worker.main(name, options, seeds, more, CORPUS / name, coverage)


def main(arguments: list[str]) -> int:
    """Fuzz; 1 if there are findings, 2 for a target that is not there."""
    options = parser().parse_args(arguments)
    if options.state is not None:  # its modules are to be instrumented before they are imported
        target(options.targets[0], options)
        return 0
    if options.inputs is not None and os.environ.get("PYTHONHASHSEED") != "0":  # sets have one order on every machine
        command = [sys.executable, str(HERE / "run.py"), *arguments]
        os.execve(sys.executable, command, {**os.environ, "PYTHONHASHSEED": "0"})
    if options.inputs is not None:
        Shared.options, Shared.coverage = options, install()
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
    if options.inputs is not None:
        results = for_inputs(chosen)
    else:
        results = ThreadPoolExecutor(max(1, options.jobs)).map(lambda name: watched(name, options), chosen)
    for name, told in zip(chosen, results, strict=True):
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
