# SPDX-License-Identifier: Apache-2.0
"""Results, runs and the report: what every stage after the tools passes on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from enum import Enum

from haros_ci.model.changes import Changes
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.results.fix import Fix
from haros_ci.results.rule import Level, Rule


class BaselineState(Enum):
    """SARIF §3.27.24."""

    NEW = "new"
    UNCHANGED = "unchanged"
    UPDATED = "updated"
    ABSENT = "absent"


@dataclass(frozen=True, slots=True)
class Related:
    """A further place that explains a result; its id in messages (``[text](1)``) is its 1-based position."""

    location: Location
    message: str


@dataclass(frozen=True, slots=True)
class Suppression:
    """SARIF §3.35: *kind* is ``inSource`` or ``external``; *location* is the comment's, *source* ``FILE:LINE`` of an exception."""

    kind: str
    justification: str = ""
    location: Location | None = None
    source: str = ""


@dataclass(frozen=True, slots=True)
class Identity:
    """What a result is about, without line numbers; hashes are the first 16 hex digits of a SHA-256.

    ``text`` is of the normalised line, ``shape`` of that line with names and numbers replaced, ``before`` and
    ``after`` of the three nearest non-blank lines on each side; ``template`` is the message with numbers and quoted
    names replaced; ``occurrence`` counts equal (tool, rule, path, scope, text) from 1, top to bottom; ``line_hash`` is
    GitHub's primaryLocationLineHash, "" if the file has no such line. ``names`` is of the ROS names and ``roles`` of
    their roles, "" for a result that is about none.
    """

    scope: str = ""
    text: str = ""
    before: str = ""
    after: str = ""
    template: str = ""
    occurrence: int = 1
    line_hash: str = ""
    snippet: str = ""
    shape: str = ""
    names: str = ""
    roles: str = ""


@dataclass(frozen=True, slots=True)
class Result:
    """One finding of one tool.

    ``tool`` and ``rule`` name the rule (``tool:rule`` in settings). ``value`` is a metric's number and ``limit`` the
    threshold that it crosses. ``subject`` are the ROS names that an architecture finding is about, ``roles`` what they are
    (node types, kinds of endpoints), which a renaming leaves as it is; ``flow`` are the places that lead to it, in order, and
    ``edges`` what it traverses of the run's ``Graph`` called ``graph``: pairs of ids. ``also`` are
    ``tool:rule`` of other tools that found the same defect. ``state`` is None where no baseline was given, and
    ``reason`` says why it is new or how it was matched (``--why``). ``fixes`` are ways to mend it, the best first.
    ``copies`` are the same finding in copies of the text, which this one also stands for; ``parts`` the findings of one cause that it was
    put together of, itself as it was first among them.
    """

    tool: str
    rule: str
    level: Level
    message: str
    location: Location
    related: tuple[Related, ...] = ()
    scope: str = ""
    value: float | None = None
    limit: float | None = None
    subject: tuple[str, ...] = ()
    roles: tuple[str, ...] = ()
    flow: tuple[Related, ...] = ()
    graph: str = ""
    edges: tuple[tuple[str, str], ...] = ()
    also: tuple[str, ...] = ()
    identity: Identity | None = None
    state: BaselineState | None = None
    reason: str = ""
    suppressions: tuple[Suppression, ...] = ()
    fixes: tuple[Fix, ...] = ()
    copies: tuple[Result, ...] = ()
    parts: tuple[Result, ...] = ()

    @property
    def sort_key(self) -> tuple[object, ...]:
        """Place, then rule, then message: the order of every output."""
        return (self.location.sort_key, self.tool, self.rule, self.message)

    @property
    def full_id(self) -> str:
        """``tool:rule``, as settings and baselines write it."""
        return f"{self.tool}:{self.rule}"


@dataclass(frozen=True, slots=True)
class Notification:
    """Trouble with a tool, the configuration or an input; never a finding (SARIF §3.58)."""

    level: Level
    message: str
    tool: str | None = None
    path: str | None = None
    line: int | None = None
    configuration: bool = False


@dataclass(frozen=True, slots=True)
class Tool:
    """The program that produced a run; *version* is "" when unknown. *extensions* are the plug-ins that took part."""

    name: str
    version: str = ""
    information_uri: str = ""
    full_name: str = ""
    extensions: tuple[Tool, ...] = ()


@dataclass(frozen=True, slots=True)
class Vertex:
    """A node, topic, service or action of a ``Graph``: *id* is ``node:/talker``, *label* its name, *kind* what it is."""

    id: str
    label: str
    kind: str
    location: Location | None = None


@dataclass(frozen=True, slots=True)
class Graph:
    """The node-topic graph of a configuration (SARIF §3.39): *edges* are pairs of ids, from who writes to who reads."""

    name: str
    vertices: tuple[Vertex, ...] = ()
    edges: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Run:
    """All results of one tool, sorted. ``successful`` is False when the tool was missing, crashed or timed out.

    ``analysed`` are the paths the tool was asked about and answered for: only their old findings can be absent.
    ``architecture`` says that all checks of the architecture could be made: else no old finding of theirs is absent.
    ``imported`` marks a log of another tool taken in with ``--import``. ``changes`` is what has changed since the base revision, None
    where there is none. ``silenced`` are findings that the tool itself left out for a comment, as far as it tells; ``refuted`` those that the code around
    them speaks against, which are not reported.
    """

    tool: Tool
    rules: tuple[Rule, ...] = ()
    results: tuple[Result, ...] = ()
    notifications: tuple[Notification, ...] = ()
    analysed: frozenset[str] = frozenset()
    successful: bool = True
    imported: bool = False
    graphs: tuple[Graph, ...] = ()
    architecture: bool = False
    changes: Changes | None = None
    silenced: tuple[Result, ...] = ()
    refuted: tuple[Result, ...] = ()


@dataclass(frozen=True, slots=True)
class Artifact:
    """An analysed file for SARIF ``artifacts``: *digest* is SHA-256 in hex, *size* in bytes."""

    path: str
    digest: str
    size: int
    language: str


@dataclass(frozen=True, slots=True)
class Provenance:
    """The revision under analysis (SARIF §3.14.9), credentials removed from the URI."""

    repository_uri: str = ""
    revision: str = ""
    branch: str = ""


@dataclass(frozen=True, slots=True)
class Baseline:
    """How the baseline was come by. ``available`` is False when one was asked for and could not be had."""

    kind: str  # "file", "sarif", "revision"
    source: str  # path or revision, as the user gave it
    available: bool = True
    message: str = ""


@dataclass(frozen=True, slots=True)
class Coverage:
    """What was looked at and what was not, for the summary, all without copies of other projects; *lines* are of C++ and Python."""

    packages: int = 0
    files: int = 0
    lines: int = 0
    targets: int | None = None
    unseen: tuple[str, ...] = ()  # sentences: what this run could not see, and why
    sandbox: str = ""  # a sentence: how linters are confined on this machine; "" where none may run


@dataclass(frozen=True, slots=True)
class Silenced:
    """What a change silences by comments that it adds.

    *findings* are suppressed by its ``haros:`` comments; *comments* are those of other tools, whose findings nobody sees: where each stands
    and what it is called (``noqa``). *more* are findings, and lines under comments that hold for many, which comments that were there before have come to
    silence: where each stands, and its rule or what the comment is called.
    """

    findings: int = 0
    comments: tuple[tuple[Location, str], ...] = ()
    more: tuple[tuple[Location, str], ...] = ()

    def __bool__(self) -> bool:
        return bool(self.findings or self.comments or self.more)


@dataclass(frozen=True, slots=True)
class Report:
    """The whole outcome. Renderers read it; none decides what counts."""

    runs: tuple[Run, ...]
    notifications: tuple[Notification, ...] = ()
    baseline: Baseline | None = None
    coverage: Coverage = field(default_factory=Coverage)
    artifacts: tuple[Artifact, ...] = ()
    provenance: Provenance | None = None
    fail_on: Level | None = Level.WARNING
    silenced: Silenced = Silenced()

    @property
    def results(self) -> tuple[Result, ...]:
        """Every result of every run, in output order."""
        return tuple(sorted((result for run in self.runs for result in run.results), key=lambda r: r.sort_key))

    def shown(self) -> tuple[Result, ...]:
        """What a person is to see: not suppressed, not absent, and new (or updated for the worse is not) if a baseline was matched."""
        return tuple(r for r in self.results if is_open(r))

    def failing(self) -> tuple[Result, ...]:
        """New, unsuppressed results at or above ``fail_on``: the reason for exit code 1."""
        if self.fail_on is None:
            return ()
        return tuple(r for r in self.results if is_open(r) and r.level.reaches(self.fail_on))

    @property
    def changes(self) -> Changes | None:
        """What has changed since the base revision, None without one."""
        return next((run.changes for run in self.runs if run.changes is not None), None)

    def failed_tools(self) -> tuple[str, ...]:
        """Names of the tools whose run did not succeed."""
        return tuple(run.tool.name for run in self.runs if not run.successful)


def is_open(result: Result) -> bool:
    """Whether a result counts as new: unsuppressed, and without a baseline or new against it."""
    return not result.suppressions and result.state in (None, BaselineState.NEW)


def results_of(runs: Iterable[Run]) -> tuple[Result, ...]:
    return tuple(result for run in runs for result in run.results)


def distribute(runs: Iterable[Run], results: Iterable[Result]) -> tuple[Run, ...]:
    """The same runs with *results* in place of their own, each under its tool, in output order."""
    by_tool: dict[str, list[Result]] = {}
    for result in results:
        by_tool.setdefault(result.tool, []).append(result)
    return tuple(
        replace(run, results=tuple(sorted(by_tool.get(run.tool.name, ()), key=lambda r: r.sort_key))) for run in runs
    )
