# SPDX-License-Identifier: Apache-2.0
"""What an adapter is: a module with these names. The runner in run.py does everything else."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import Protocol

from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

#: What pylint says of each finding that a comment silences (I0020). It is no finding, but kept whatever is selected, so that more of them are noticed.
SILENCED = "suppressed-message"
#: Stands before the rule of a finding that the code around it speaks against: it is not reported, and named where a change brings it.
REFUTED = "refuted:"


@dataclass(frozen=True, slots=True)
class Program:
    """How to start a tool (*argv* prefix) and its version, "" if it does not tell."""

    argv: tuple[str, ...]
    version: str


@dataclass(frozen=True, slots=True)
class LintOptions:
    """The part of the settings that adapters see.

    ``enabled`` are the tools asked for by name, ``disabled`` those switched off; of any other its ``WHEN`` tells
    whether it runs. ``root`` is the user's checkout, from which no program is ever taken (the workspace under
    analysis may be a copy of a base revision). ``timeout`` is in seconds for one process. ``beside`` are, by the name of an adapter, further ones
    that read something else out of what its process writes: their answers are kept, so that no second process asks for them.
    """

    enabled: frozenset[str] = frozenset()
    disabled: frozenset[str] = frozenset()
    timeouts: dict[str, float] = field(default_factory=dict)
    timeout: float = 600.0
    jobs: int = 1
    trust_config: bool = False
    arguments: dict[str, tuple[str, ...]] = field(default_factory=dict)
    compile_database: str | None = None
    root: Path | None = None
    beside: dict[str, Linter] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Unit:
    """What a tool analyses at a time: one file, and everything that its results depend on.

    Only units of one *group* share a process. *dependencies* are paths of other workspace files whose contents can
    change the results, *salt* is anything else that can. *settings* are the tool's settings files that hold for the file, as
    ``Workspace.setting`` reads them. *covers* are further files (headers) whose findings come from this unit's analysis.
    """

    file: SourceFile
    group: str = ""
    dependencies: tuple[str, ...] = ()
    covers: tuple[str, ...] = ()
    salt: str = ""
    settings: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Batch:
    """Files for one process. *scratch* is an empty directory outside the workspace for the adapter's own files."""

    workspace: Workspace
    files: tuple[SourceFile, ...]
    options: LintOptions
    scratch: Path
    group: str = ""


@dataclass(frozen=True, slots=True)
class Command:
    """One process: it runs in *cwd* (default: the workspace root), without a shell, in its own process group.

    *reads* are absolute places that it has to open besides the analysed files and what lies beside its program. With *talks*
    its processes talk to each other by local sockets. *progress* matches what the tool writes to stdout when it begins a file, whose
    name is group 1: if nothing more is written for a while, the process is stopped, and that file is left out.
    """

    argv: tuple[str, ...]
    stdin: bytes = b""
    environment: dict[str, str] = field(default_factory=dict)
    cwd: Path | None = None
    reads: tuple[str, ...] = ()
    talks: bool = False
    progress: re.Pattern[bytes] | None = None


@dataclass(frozen=True, slots=True)
class Output:
    """What a finished process left: *truncated* when the byte cap cut it. *code* is negative for a signal.

    *seconds* is the CPU time of it and of what it waited for.
    """

    stdout: bytes
    stderr: bytes
    code: int
    truncated: bool = False
    seconds: float = 0.0


@dataclass(frozen=True, slots=True)
class Finding:
    """A result together with the analysed file (*unit*) whose analysis produced it; it may stand in another file."""

    unit: str
    result: Result


def refuted(result: Result) -> Result:
    """*result* as one that the code around it speaks against."""
    return replace(result, rule=f"{REFUTED}{result.rule}")


@dataclass(frozen=True, slots=True)
class GaveUp:
    """A file that the tool could not analyse: a notification, never a finding."""

    unit: str
    message: str
    line: int | None = None


class When(Enum):
    """When a tool runs, unless it is switched off: ALWAYS (missing is trouble), where it is INSTALLED, or if ASKED for.

    A tool is asked for by the settings' ``linters`` or by a selector that names it; missing is then trouble, too.
    """

    ALWAYS = "always"
    INSTALLED = "where it is installed"
    ASKED = "if asked for"


class Unread(ValueError):
    """Raised by ``parse`` where the output cannot be used as it is: the message says why, and what to change."""


class Linter(Protocol):
    """An adapter module. ``COST`` is seconds per megabyte of source on one core, for scheduling only.

    An adapter may also have ``BATCH_SECONDS``, the estimated length of one process or the least and the most (schedule.seconds_of),
    ``plan(workspace, options, store) -> Iterable[Unit]``, which then takes the place of LANGUAGES and dependencies(),
    ``declined(workspace, units) -> dict[str, str]``, the files that the tool is not asked about with the reason, and
    ``remarks(workspace, groups) -> Iterable[Problem]``, which tells what of the settings files that units have as their group
    does not count, and why.

    A tool sees copies of the files of its LANGUAGES and of its units' dependencies, and nothing else (view.py). ``SEES``, languages, says that
    it reads other files than it analyses; ``SEES_NAMES`` that it asks which further files there are, which are then empty;
    ``FOLLOWS_INCLUDES`` that it opens what C++ includes. An adapter that is ``TRUSTED`` gets the workspace itself, without a sandbox.
    """

    NAME: str
    LANGUAGES: frozenset[str]
    WHEN: When
    COST: float

    def locate(self, options: LintOptions) -> Program | None:
        """The installed tool, or None."""
        ...

    def fingerprint(self, workspace: Workspace, options: LintOptions) -> str:
        """Everything besides tool version and file contents that the results depend on: arguments, configuration."""
        ...

    def dependencies(self, workspace: Workspace, file: SourceFile) -> Iterable[str]:
        """Paths of other workspace files whose contents can change the results for *file*."""
        ...

    def command(self, program: Program, batch: Batch) -> Command: ...

    def parse(self, output: Output, batch: Batch) -> Iterable[Finding | GaveUp]:
        """Pure: from captured output to findings. Raises ValueError when the output is not what the tool writes."""
        ...


__all__ = [
    "Batch",
    "Command",
    "Finding",
    "GaveUp",
    "Level",
    "LintOptions",
    "Linter",
    "Output",
    "Program",
    "Related",
    "Result",
    "Unit",
    "Unread",
    "When",
]
