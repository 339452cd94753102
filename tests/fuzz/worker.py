# SPDX-License-Identifier: Apache-2.0
"""One target for some seconds: inputs that reach new blocks are kept and changed further."""

from __future__ import annotations

import gc
import hashlib
import json
import mmap
import resource
import struct
import sys
import time
from argparse import Namespace
from pathlib import Path
from random import Random

from fuzz.execute import Finding, run
from fuzz.instrument import Coverage
from fuzz.mutate import Mutator
from fuzz.shrink import shrunk

#: Of the file in which the present input stands: whoever finds this process dead reads it there.
STATE = 1 << 18
HEAD = struct.Struct("<QI")
#: Address space beside what is there at the start; what wants more gets a MemoryError, which is a finding.
ROOM = 2 << 30
_AGAIN = 10  # one input in so many is run twice


def present(state: Path) -> tuple[int, bytes]:
    """How many inputs there were, and the last of them."""
    data = state.read_bytes()
    count, length = HEAD.unpack_from(data)
    return count, data[HEAD.size : HEAD.size + length]


class Worker:
    """The loop over one target. Findings are written as they come, one of each kind and place."""

    def __init__(self, name: str, seed: int, state: Path, findings: Path, coverage: Coverage) -> None:
        from fuzz.targets import entry

        self.name = name
        self.entry = entry(name)
        self.random = Random(f"{name} {seed}")
        self.coverage = coverage
        self.findings = findings
        self.known: set[tuple[str, str]] = set()
        self.kept: list[bytes] = []
        self.weights: list[int] = []
        self.grown: list[bytes] = []
        self.count = 0
        self.slowest = (0.0, b"")
        self.mutator = Mutator(self.random, self.entry.words)
        self.is_timed = True
        with state.open("r+b") as stream:
            self.memory = mmap.mmap(stream.fileno(), STATE)

    def fuzz(self, seeds: list[bytes], seconds: float, inputs: int | None = None) -> None:
        """Run the *seeds*, then changes of them for so many *seconds*; with *inputs* so many, on every machine the same ones."""
        end = time.monotonic() + seconds
        self.is_timed = inputs is None
        for data in seeds or [b""]:
            self.one(data, is_seed=True)
        last = self.count + (inputs or 0)
        while time.monotonic() < end if inputs is None else self.count < last:
            (chosen,) = self.random.choices(self.kept, self.weights)
            others = [self.random.choice(self.kept)]
            self.one(self.mutator.mutated(chosen, others), is_seed=False)

    def merge(self, seeds: list[bytes], more: list[bytes], corpus: Path) -> None:
        """Store in *corpus* those of *more*, the small ones first, that reach what the *seeds* do not reach."""
        for data in seeds:
            self.one(data, is_seed=True)
        for data in sorted(more, key=lambda each: (len(each), each)):
            before = len(self.grown)
            self.one(data, is_seed=False)
            if len(self.grown) > before:
                corpus.mkdir(parents=True, exist_ok=True)
                (corpus / hashlib.sha256(data).hexdigest()[:12]).write_bytes(data)

    def one(self, data: bytes, *, is_seed: bool) -> None:
        """Run one input, keep it if it reaches what none before has reached."""
        self.note(data)
        self.coverage.clear()
        before = time.process_time()
        finding = run(self.entry.run, data, twice=is_seed or self.count % _AGAIN == 0)
        taken = time.process_time() - before
        if taken > self.slowest[0]:
            self.slowest = (taken, data)
        if finding is not None:
            self.tell(data, finding)
        fresh = self.coverage.new()
        if (fresh and finding is None) or is_seed:
            self.kept.append(data)
            slowness = int(taken * 20) if self.is_timed else 0
            self.weights.append(1 + min(40, len(fresh) * (1 if is_seed else 8)) // (1 + slowness))
            if not is_seed:
                self.grown.append(data)
            self.mutator.add_words([word for place in fresh for word in self.coverage.words.get(place, ())])
        if self.count % 500 == 0:
            gc.collect()

    def note(self, data: bytes) -> None:
        self.count += 1
        part = data[: STATE - HEAD.size]
        self.memory[: HEAD.size + len(part)] = HEAD.pack(self.count, len(part)) + part

    def tell(self, data: bytes, finding: Finding) -> None:
        """Write a finding that is new, made as small as it gets in a while."""
        if finding.kind == "slow":
            again = run(self.entry.run, data)  # a collection of garbage, or another process, may have had the time
            if again is None:
                return
            finding = again
        if finding.key in self.known:
            return
        self.known.add(finding.key)

        def shows(smaller: bytes) -> bool:
            self.note(smaller)
            found = run(self.entry.run, smaller, twice=finding.kind == "differs")
            return found is not None and found.key == finding.key

        small = data if finding.kind == "memory" else shrunk(data, shows)
        report(self.findings, self.name, small, finding)

    def stats(self) -> str:
        """A line of JSON."""
        data = {
            "inputs": self.count,
            "blocks": self.coverage.reached,
            "kept": len(self.kept),
            "slowest": round(self.slowest[0], 3),
            "megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024,
        }
        return json.dumps(data)


def report(findings: Path, name: str, data: bytes, finding: Finding) -> None:
    """The input that shows *finding*, and beside it what it is."""
    findings.mkdir(parents=True, exist_ok=True)
    digest = hashlib.sha256(repr(finding.key).encode()).hexdigest()[:8]
    place = findings / f"{name}-{finding.kind}-{digest}"
    place.write_bytes(data)
    place.with_name(f"{place.name}.txt").write_text(f"{finding.kind} {finding.place}\n\n{finding.detail}\n", "utf-8")


def limit_memory() -> None:
    """A process that wants far more than it has gets a MemoryError, and the machine lives on."""
    with open("/proc/self/statm", encoding="ascii") as stream:
        used = int(stream.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + ROOM, used + ROOM))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def main(
    name: str, options: Namespace, seeds: list[Path], more: list[Path], corpus: Path, coverage: Coverage | None = None
) -> None:
    """Fuzz *name* in this process, which does nothing else, or merge *more*; the statistics go to stdout.

    *coverage* is that of a process whose modules are instrumented already.
    """
    from fuzz.instrument import install

    worker = Worker(name, options.seed, options.state, options.findings, coverage or install())
    if sys.platform == "linux":
        limit_memory()
    data = [path.read_bytes() for path in seeds]
    try:
        if more:
            worker.merge(data, [path.read_bytes() for path in more], corpus)
        else:
            worker.fuzz(data, options.seconds, options.inputs)
    finally:
        if options.grow is not None:
            grown = options.grow / name
            grown.mkdir(parents=True, exist_ok=True)
            for each in worker.grown:
                (grown / hashlib.sha256(each).hexdigest()[:16]).write_bytes(each)
        print(worker.stats(), flush=True)
