# SPDX-License-Identifier: Apache-2.0
"""Runs the real command on a trap and says what no trap may ever achieve."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from forked import server
from repositories import begin

#: Lies in every workspace; its one finding must be reported whatever lies beside it.
CONTROL = "control.py"
CONTROL_TEXT = (
    b'"""A file like any other."""\n\n\ndef control():\n    """Have one known defect."""\n    return nowhere_defined\n'
)
CONTROL_FINDING = (CONTROL, 6, "undefined-variable")
CHEAP_FINDING = ("control.cpp", 1, "nullPointer")

#: A driver: the command without the superuser's right to pass over permissions.
UNPRIVILEGED = """
import ctypes, sys
libc = ctypes.CDLL(None)
if hasattr(libc, "capset"):  # Linux; version 3 of the header, this process, every set empty
    libc.capset((ctypes.c_uint32 * 2)(0x20080522, 0), (ctypes.c_uint32 * 6)())
from haros_ci.cli import main
sys.exit(main())
"""

#: Controls other than tab and line feed, bidirectional controls, line separators, surrogates.
RAW = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
COMMAND = re.compile(r"::(error|warning|notice) [a-zA-Z]+=[^:]*::.*")
#: What a runner obeys in any other output: `::name ::` at the head of a line, `##[name]` anywhere in it.
OBEYED = re.compile(r"^\s*::|##\[", re.MULTILINE)
TRACE = re.compile(r"Traceback \(most recent|internal error|^  File \".*\", line \d+", re.MULTILINE)


@dataclass
class Outcome:
    """What one run left behind: its exit code, what it printed, and each format."""

    code: int
    stderr: str
    formats: Mapping[str, str]  # text, github, markdown, json, sarif
    harmless: bool = False  # found so before

    @cached_property
    def report(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self.formats["json"])
        return found

    @cached_property
    def sarif(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self.formats["sarif"])
        return found

    def findings(self) -> set[tuple[str, int | None, str]]:
        return {(r["path"], r["line"], r["rule"]) for r in self.report["results"]}

    def notes(self) -> list[tuple[str | None, str]]:
        """Path and message of every notification."""
        return [(note["path"], note["message"]) for note in self.report["notifications"]]

    def says(self, words: str) -> bool:
        """Whether *words* stand in a notification, or where the run ended on stderr."""
        return words in self.stderr or ("json" in self.formats and any(words in message for _, message in self.notes()))


class Trap:
    """A workspace of hostile input in *place*, and beside it what the input tries to reach.

    ``sentinels`` is where every payload would leave a file, ``outside`` holds what must be neither read nor changed.
    """

    SECRET = "the-secret-outside"

    def __init__(self, place: Path, cache: Path, *, afresh: bool = False) -> None:
        """With *afresh* each run loads Python and all modules anew, as a test of what is loaded needs it."""
        self.afresh = afresh
        self.timeout = 120.0
        self.place = place
        self.cache = cache
        self.root = place / "ws"
        self.sentinels = place / "sentinels"
        self.outside = place / "outside"
        for directory in (self.root, self.sentinels, self.outside):
            directory.mkdir(parents=True)
        self.write(CONTROL, CONTROL_TEXT)
        name = self.SECRET.replace("-", "_")
        (self.outside / "secret.py").write_text(f'"""Not yours."""\n{name} = undefined_outside\n')
        (self.outside / "secret.hpp").write_text(f"inline int {name}(int x) {{ int *unset = 0; return *unset + x; }}\n")
        (self.outside / "error.hpp").write_text(f"#error {name}\n")
        (self.outside / "victim.json").write_text(f'{{"victim": "{self.SECRET}"}}')

    def use_cheap_control(self) -> None:
        """A control of one tool's that is quick, where what is cached is spoiled: ``CHEAP_FINDING``."""
        (self.root / CONTROL).unlink()
        self.write(CHEAP_FINDING[0], "int f(int x) { int *unset = 0; return *unset + x; }\n")
        self.write("haros.yaml", "linters: {cpplint: false, pylint: false, lizard: false, radon: false, ruff: false}\n")

    def use_filled_cache(self) -> None:
        """A cache of the trap's own that knows the cheap control; it is filled once for all traps."""
        filled = self.cache.with_name(f"{self.cache.name}-filled")
        if not filled.exists():
            self.cache = filled
            self.command("check", ".")
        self.cache = self.place / "cache"
        shutil.copytree(filled, self.cache)

    def write(self, name: str | bytes, data: bytes | str) -> Path:
        """Write a file of the workspace, whatever its name."""
        path = os.path.join(os.fsencode(self.root), os.fsencode(name))
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data.encode() if isinstance(data, str) else data)
        return Path(os.fsdecode(path))

    def sparse(self, name: str, size: int) -> None:
        with self.write(name, b"").open("wb") as file:
            file.truncate(size)

    def touch(self, name: str) -> str:
        """A shell command that would betray itself."""
        return f"touch {self.sentinels / name}"

    def python(self, name: str) -> str:
        """A Python statement that would betray itself."""
        return f"open({str(self.sentinels / name)!r}, 'w').close()"

    def unprivileged(self) -> Path:
        """A driver to which permissions matter, whoever runs the tests."""
        path = self.place / "unprivileged.py"
        path.write_text(UNPRIVILEGED)
        return path

    def impatient(self, lines: str) -> Path:
        """A driver in which *lines* have lowered a bound, where what takes all of it is to be given up and said, whatever the bound is."""
        path = self.place / "impatient.py"
        path.write_text(f"import sys\n{lines}\nfrom haros_ci.cli import main\nsys.exit(main())\n")
        return path

    def git(self, *arguments: str) -> str:
        """Run git itself in the workspace, to set the trap."""
        who = {f"GIT_{role}_{key}": "ada@example.org" for role in ("AUTHOR", "COMMITTER") for key in ("NAME", "EMAIL")}
        done = subprocess.run(["git", *arguments], cwd=self.root, env=plain(who), capture_output=True, check=True)
        return done.stdout.decode().strip()

    def commit(self) -> None:
        """Everything so far as a commit; the first one makes the repository."""
        begin(self.root)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "a change")

    @property
    def executed(self) -> list[str]:
        """What the payloads left; it must be empty."""
        return sorted(os.listdir(self.sentinels))

    def run(self, *arguments: str, environment: Mapping[str, str] | None = None, driver: Path | None = None) -> Outcome:
        """``haros-ci check .`` with *arguments* and every format at once."""
        outputs = {name: self.place / f"out.{name}" for name in ("text", "json", "sarif")}
        page = self.place / "out.markdown"
        for file in (*outputs.values(), page):
            file.unlink(missing_ok=True)
        wanted = ["--output=github", *(f"--output={name}={file}" for name, file in outputs.items())]
        more = {"GITHUB_STEP_SUMMARY": str(page), **(environment or {})}
        done = self.start("check", *wanted, *arguments, environment=more, driver=driver)
        formats = {
            name: file.read_bytes().decode() for name, file in (*outputs.items(), ("markdown", page)) if file.exists()
        }
        return Outcome(done.returncode, done.stderr.decode(), {"github": done.stdout.decode(), **formats})

    def command(self, *arguments: str) -> str:
        """What ``haros-ci`` with *arguments* writes to stdout."""
        return self.start(*arguments).stdout.decode()

    def start(
        self, *arguments: str, environment: Mapping[str, str] | None = None, driver: Path | None = None
    ) -> subprocess.CompletedProcess[bytes]:
        """``haros-ci`` with *arguments* in the workspace, or a *driver* that calls it."""
        env = plain({"HAROS_CI_CACHE": str(self.cache), **(environment or {})})
        if not self.afresh:
            return server().run(list(arguments), cwd=self.root, env=env, timeout=self.timeout, driver=driver)
        command = [sys.executable, "-I", *([str(driver)] if driver else ["-m", "haros_ci"]), *arguments]
        return subprocess.run(
            command,
            cwd=self.root,
            env=env,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=self.timeout,
            check=False,
        )


class Part:
    """A directory of a trap in which a case stands beside others, so that one run looks at all of them."""

    def __init__(self, trap: Trap, name: str) -> None:
        self.trap = trap
        self.name = name
        self.root = trap.root / name
        self.outside = trap.outside

    def write(self, name: str | bytes, data: bytes | str) -> Path:
        return self.trap.write(os.path.join(os.fsencode(self.name), os.fsencode(name)), data)


def plain(more: Mapping[str, str]) -> dict[str, str]:
    """The environment without settings of git, GitHub or haros-ci, and *more*."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("GIT_", "GITHUB_", "HAROS_CI_", "PYTHON"))}
    return {**kept, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_SYSTEM": "/dev/null", **more}


def assert_harmless(trap: Trap, outcome: Outcome) -> None:
    """What holds after every run: nothing ran, nothing leaked, no trace of a crash, nothing printed that is obeyed."""
    assert trap.executed == []
    if outcome.harmless:
        return
    for name, text in {**outcome.formats, "stderr": outcome.stderr}.items():
        assert not RAW.search(text), f"{name}: {RAW.search(text)}"
        assert not TRACE.search(text), f"{name}: {text}"
        assert Trap.SECRET not in text.replace("_", "-") and "undefined_outside" not in text, name
        assert "root:x:0" not in text, name
        assert not any(str(place) in text for place in (trap.root, trap.outside)), f"{name} names this machine's paths"
        if name == "github":
            assert all(COMMAND.fullmatch(line) for line in text.splitlines()), text
        elif name in ("text", "stderr"):  # the others are files that no runner reads
            assert not OBEYED.search(text), f"{name}: {OBEYED.search(text)}"
    if outcome.code != 2:
        for name in ("json", "sarif"):
            assert outcome.formats[name].isascii(), name
            assert not [text for text in _messages(json.loads(outcome.formats[name])) if RAW.search(text)], name
        markdown = outcome.formats["markdown"]
        assert not re.search(r"<(?!/?(?:br|code|details|summary)>)|(?<!&#64;)@\w|!\[|\]\(", markdown), markdown
    outcome.harmless = True


def assert_the_rest_is_analysed(outcome: Outcome, finding: tuple[str, int, str] = CONTROL_FINDING) -> None:
    """The control's finding is there, and shown in every format unless it is known."""
    path, line, rule = finding
    assert finding in outcome.findings(), outcome.stderr + outcome.formats.get("text", "")
    results = [result for run in outcome.sarif["runs"] for result in run.get("results", ())]
    assert any(result["ruleId"] == rule and _uri(result) == path for result in results)
    if outcome.code != 0:
        assert f"{path}:{line}:" in outcome.formats["text"]
        capped = outcome.formats["github"].count("::error ") >= 10
        assert f"file={path},line={line}," in outcome.formats["github"] or capped


def _uri(result: dict[str, Any]) -> str:
    uri: str = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    return uri


def _messages(value: object, key: str = "") -> list[str]:
    """Every text of a document that a person may come to read."""
    if isinstance(value, dict):
        return [text for name, item in value.items() for text in _messages(item, name)]
    if isinstance(value, list):
        return [text for item in value for text in _messages(item, key)]
    return [value] if isinstance(value, str) and key in ("text", "message", "markdown", "name", "unseen") else []
