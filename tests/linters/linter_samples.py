# SPDX-License-Identifier: Apache-2.0
"""Small workspaces, a store in memory, and a made-up tool for the tests of the runner and its adapters."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, When
from haros_ci.model.location import Location
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

LANGUAGES = {
    **{"py": "python", "cpp": "cpp", "hpp": "cpp", "h": "cpp", "c": "cpp", "xml": "package", "txt": "cmake"},
    **{"cmake": "cmake", "launch": "launch", "sh": "shell", "urdf": "xml", "yaml": "yaml", "Dockerfile": "dockerfile"},
    **{"md": "markdown", "cfg": "setup", "srv": "interface", "action": "interface"},
}


@dataclass
class DiskReader:
    root: Path

    def text(self, path: str) -> str:
        try:
            return (self.root / path).read_bytes().decode(errors="replace")
        except (OSError, ValueError):
            return ""

    def data(self, path: str) -> bytes | None:
        try:
            return (self.root / path).read_bytes()
        except (OSError, ValueError):
            return None


@dataclass
class MemoryStore:
    """Keeps values as JSON text, as a cache on disk does, and counts."""

    values: dict[tuple[str, str, str], str] = field(default_factory=dict)
    hits: int = 0

    def get(self, group: str, path: str, key: str) -> object | None:
        text = self.values.get((group, path, key))
        self.hits += text is not None
        return None if text is None else json.loads(text)

    def put(self, group: str, path: str, key: str, value: object) -> None:
        self.values[group, path, key] = json.dumps(value)

    def get_text(self, group: str, path: str, key: str) -> str | None:
        text = self.values.get((group, path, key))
        self.hits += text is not None
        return text

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self.values[group, path, key] = text


def workspace(
    root: Path, files: Mapping[str, str | bytes], packages: Iterable[Package] = (), targets: Iterable[str] | None = None
) -> Workspace:
    """*files* written below *root*; those with a known suffix are source files of the innermost of *packages*."""
    root.mkdir(parents=True, exist_ok=True)
    sources = []
    packages = tuple(packages)
    for path, content in files.items():
        data = content.encode() if isinstance(content, str) else content
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(data)
        language = LANGUAGES.get(path.rpartition(".")[2])
        if language is not None:
            owners = [p for p in packages if p.path == "." or path.startswith(p.path + "/")]
            owner = max(owners, key=lambda p: len(p.path)).name if owners else None
            sources.append(SourceFile(path, language, len(data), hashlib.sha256(data).hexdigest(), owner))
    ordered = tuple(sorted(sources, key=lambda f: f.path))
    return Workspace(root, packages, ordered, DiskReader(root), None if targets is None else frozenset(targets))


#: Reads ``path`` lines from its arguments; each line ``# say RULE`` of a file is a finding, other orders are obeyed.
TOOL = """
import os, signal, sys, time
for path in sys.argv[1:]:
    for number, line in enumerate(open(path, errors="replace"), 1):
        order, _, rest = line.strip().removeprefix("# ").partition(" ")
        if order == "say": print(path, number, rest, sep="|")
        if order == "refuse": print(path, number, "!", sep="|")
        if order == "crash": os.kill(os.getpid(), signal.SIGSEGV)
        if order == "raise": raise RuntimeError("out of ideas")
        if order == "babble": print("no such thing")
        if order == "flood": sys.stdout.write("x" * 100_000_000)
        if order == "hang": time.sleep(600)
        if order == "environment": print(path, number, " ".join(sorted(os.environ)), sep="|")
print("done")
"""


@dataclass
class FakeLinter:
    """An adapter for TOOL, counting its processes."""

    NAME: str = "fake"
    LANGUAGES: frozenset[str] = frozenset({"python"})
    WHEN: When = When.ALWAYS
    COST: float = 1.0
    BATCH_SECONDS: float = 1e9
    installed: bool = True
    version: str = "1.0"
    settings: str = ""
    needs: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    asked: list[tuple[str, ...]] = field(default_factory=list)

    def locate(self, options: LintOptions) -> Program | None:
        return Program((sys.executable, "-I", "-c", TOOL), self.version) if self.installed else None

    def fingerprint(self, workspace: Workspace, options: LintOptions) -> str:
        return self.settings

    def dependencies(self, workspace: Workspace, file: SourceFile) -> Iterable[str]:
        return self.needs.get(file.path, ())

    def command(self, program: Program, batch: Batch) -> Command:
        paths = tuple(file.path for file in batch.files)
        self.asked.append(paths)
        return Command((*program.argv, *("./" + path for path in paths)))

    def parse(self, output: Output, batch: Batch) -> Iterable[Finding | GaveUp]:
        *lines, last = output.stdout.decode().splitlines() or [""]
        if last != "done":
            raise ValueError("it did not finish")
        for line in lines:
            path, number, rule = line.split("|")
            path = path.removeprefix("./")
            if rule == "!":
                yield GaveUp(path, "refused", int(number))
            else:
                yield Finding(
                    path, Result(self.NAME, rule, Level.WARNING, f"{rule} found", Location(path, int(number)))
                )


def everything(tool: str, rule: str, path: str) -> bool:
    return True
