# SPDX-License-Identifier: Apache-2.0
"""Where the known findings come from: a file of ours, a SARIF log, or the analysis of a base revision.

Most runs need one of these ways or none, so each is imported where it is taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.results.result import Baseline, Notification, Result, Run
from haros_ci.results.rule import Level
from haros_ci.timing import stage, timed
from haros_ci.workspace.files import TooLarge, read_regular
from haros_ci.workspace.git import BaselineUnavailable
from haros_ci.workspace.left_out import LeftOut
from haros_ci.workspace.third_party import around

if TYPE_CHECKING:
    from haros_ci.results.known import ComparedFiles, KnownFinding
    from haros_ci.workspace.base import Base

#: The baseline file that is used without being named.
COMPACT_NAME = ".haros-ci-baseline.jsonl"

#: The largest log or baseline that is read, in bytes.
MAX_BYTES = 64_000_000

NO_SETTINGS = (
    "Settings files of linters do not count in this run: they are read from the base revision, which cannot be had. "
    "Every linter runs with its own defaults."
)

Examine = Callable[[Workspace], tuple[Run, ...]]


@dataclass(frozen=True, slots=True)
class Comparison:
    """Runs whose results carry their state, how the baseline was come by, and what went wrong on the way."""

    runs: tuple[Run, ...]
    baseline: Baseline | None = None
    notifications: tuple[Notification, ...] = ()


@contextmanager
def at_base(workspace: Workspace, settings: Settings) -> Iterator[Base | BaselineUnavailable | None]:
    """*workspace* at the base revision of *settings* for as long as it is needed; None without one, or why it cannot be had."""
    if settings.baseline_rev is None:
        yield None
        return
    if settings.base_missing:
        yield BaselineUnavailable(settings.without_base)
        return
    from haros_ci.workspace.base import base_workspace

    with ExitStack() as stack:
        found: Base | BaselineUnavailable
        try:
            with stage("baseline"):
                base = base_workspace(
                    workspace,
                    settings.baseline_rev,
                    paths=settings.paths,
                    exclude=settings.exclude,
                    max_file_size=settings.max_file_size,
                    also=settings.claims,
                    trusted=settings.trust_config,
                    known=settings.base,
                )
                found = stack.enter_context(base)
        except BaselineUnavailable as err:
            found = err
        yield found


@timed("baseline")
def settled(workspace: Workspace, settings: Settings, base: Base | BaselineUnavailable | None) -> Workspace:
    """*workspace* with the linters' settings of the base revision, so that a change cannot bring its own.

    Where the base revision cannot be had no settings file counts. A workspace that is trusted keeps its own.
    """
    if base is None or settings.trust_config:
        return workspace
    workspace = _as_known_before(workspace, base)
    if isinstance(base, BaselineUnavailable):
        from haros_ci.workspace.base_settings import no_settings

        return replace(workspace, settings=no_settings(workspace.root))
    return replace(workspace, settings=base.settings)


def _as_known_before(workspace: Workspace, base: Base | BaselineUnavailable) -> Workspace:
    """*workspace*, in which files are generated, and directories or files third-party, if they were so in *base*.

    Else a comment, a licence or a name would keep linters out of a change. So would a move: a file that was the project's own stays so where
    it comes to lie among others' code.
    """
    if isinstance(base, BaselineUnavailable):
        files = tuple(replace(file, is_generated=False, third_party="") for file in workspace.files)
        return replace(workspace, files=files)
    before = base.workspace.files
    generated = {base.renames.get(file.path, file.path) for file in before if file.is_generated}
    third_party = {file.third_party for file in before} - {""}
    single = {base.renames.get(file.path, file.path) for file in before if file.third_party == file.path}
    own = {base.renames[file.path] for file in before if not file.third_party and file.path in base.renames}

    def known(file: SourceFile) -> SourceFile:
        copy = "" if file.path in own else around(file.path, third_party)
        if not copy and file.third_party and file.path in single:
            copy = file.path
        if copy == file.third_party and not file.is_generated:
            return file
        return replace(file, is_generated=file.is_generated and file.path in generated, third_party=copy)

    return replace(workspace, files=tuple(map(known, workspace.files)))


@timed("unused code")
def left_out(workspace: Workspace, settings: Settings, base: Base | BaselineUnavailable | None) -> LeftOut:
    """What tells which files of *workspace* nothing uses, and nothing used in *base* either, and which are copies now as then.

    Else a change could keep linters out of a file by taking it from its target, or by a first comment.
    """
    if base is None or settings.trust_config:
        return LeftOut(workspace)
    if isinstance(base, BaselineUnavailable):
        return LeftOut(workspace, is_known=False)
    return LeftOut(workspace, base.workspace, base.renames)


@timed("baseline")
def compare(
    runs: tuple[Run, ...],
    workspace: Workspace,
    settings: Settings,
    base: Base | BaselineUnavailable | None,
    *,
    examine: Examine,
) -> Comparison:
    """Match *runs* against the baseline that *settings* ask for, *base* if it is a revision; without one they have no state.

    A baseline file given together with a revision is read from that revision, so that a change cannot bring its own.
    A revision that cannot be had is an unavailable baseline, never an empty one.
    """
    try:
        if settings.baseline is not None:
            return _against_file(runs, workspace, settings, base)
        if isinstance(base, BaselineUnavailable):
            raise base
        if settings.baseline_rev is not None and base is not None:
            return _against_revision(runs, workspace, settings, settings.baseline_rev, base, examine)
    except BaselineUnavailable as err:
        source = settings.baseline_rev or settings.baseline or ""
        notes = [_no_baseline(str(err))]
        if isinstance(base, BaselineUnavailable) and not settings.trust_config:
            notes.append(Notification(Level.NOTE, NO_SETTINGS, configuration=True))
        return Comparison(
            runs,
            Baseline("revision", source, available=False, message=str(err)),
            tuple(notes),
        )
    return Comparison(runs)


def _no_baseline(why: str) -> Notification:
    return Notification(Level.WARNING, f"No baseline: {why}", configuration=True)


def known_findings(settings: Settings) -> tuple[KnownFinding, ...]:
    """What the baseline file of *settings* holds, read from the base revision if one is given."""
    return _held(settings)[0]


def _held(settings: Settings) -> tuple[tuple[KnownFinding, ...], tuple[Run, ...] | None]:
    """The same, and the runs if it is a log."""
    from haros_ci.results.compact import BaselineFormatError, read_compact
    from haros_ci.results.known import known_from_sarif

    assert settings.baseline is not None
    name = settings.baseline
    data = _bytes_of(settings)
    if is_sarif(data):
        runs = sarif_runs(data, name, settings.root)
        return known_from_sarif(runs), runs
    try:
        return read_compact(data, name), None
    except BaselineFormatError as err:
        raise UserError(f"{name}:{err.line}: {err.message}", help="or write it anew: haros-ci baseline create") from err


def is_sarif(data: bytes) -> bool:
    """Whether *data* is one JSON document with runs, rather than our lines."""
    head = data[:4096].lstrip(b"\xef\xbb\xbf \t\r\n")
    return b'"haros-ci-baseline"' not in head.split(b"\n", 1)[0] and (b'"runs"' in data or b'"$schema"' in head)


def sarif_runs(data: bytes, name: str, root: Path) -> tuple[Run, ...]:
    """The runs of a SARIF log, with notifications of what was left out of them; UserError if *path* is no SARIF log."""
    from haros_ci.results.sarif_file import SarifError
    from haros_ci.results.sarif_reader import read_sarif

    try:
        return read_sarif(data, name, root=root.as_posix())
    except SarifError as err:
        raise UserError(f"{name}: {err}", help="give a SARIF 2.1.0 log, or leave the file out") from err


def _against_file(
    runs: tuple[Run, ...], workspace: Workspace, settings: Settings, base: Base | BaselineUnavailable | None
) -> Comparison:
    from haros_ci.results.known import sides

    known, past = _held(settings)
    missing = (_no_baseline(str(base)),) if isinstance(base, BaselineUnavailable) else ()
    kind = "file" if settings.baseline_rev is None else "file at revision"
    return Comparison(
        _matched(runs, known, sides(workspace, runs, settings.paths, past=past)),
        Baseline(kind, settings.baseline or ""),
        (*missing, *_difference(settings)),
    )


def _difference(settings: Settings) -> tuple[Notification, ...]:
    """What a change does to the baseline file takes effect once it is in the base revision, and is said until then."""
    name = settings.baseline or ""
    try:
        if settings.baseline_rev is None or read_regular(settings.root / name, MAX_BYTES) == _bytes_of(settings):
            return ()
    except (OSError, TooLarge):
        pass
    return (
        Notification(Level.NOTE, f"{name} differs from the base revision's, which this run uses", configuration=True),
    )


def _against_revision(
    runs: tuple[Run, ...], workspace: Workspace, settings: Settings, rev: str, base: Base, examine: Examine
) -> Comparison:
    from haros_ci.results.known import known_from_results, sides

    past = examine(base.workspace)
    known = known_from_results(result for run in past for result in run.results)
    compared = tuple(run for run in runs if not run.imported)
    found = sides(workspace, compared, settings.paths, base.workspace, base.renames, past)
    matched = _matched(compared, known, found)
    logs = tuple(run for run in runs if run.imported)
    notes = [
        Notification(
            Level.WARNING,
            f"The imported log of {run.tool.name} has no counterpart at {rev}: all of it counts.",
            configuration=True,
        )
        for run in logs
    ]
    broken = {run.tool.name for run in past if not run.successful}
    notes += [
        Notification(Level.WARNING, f"{tool} failed on the base revision: its old findings count as new.", tool=tool)
        for tool in sorted(broken)
    ]
    return Comparison((*matched, *logs), Baseline("revision", f"{rev} ({base.revision[:12]})"), tuple(notes))


def _matched(runs: tuple[Run, ...], known: tuple[KnownFinding, ...], sides: ComparedFiles) -> tuple[Run, ...]:
    """Each run with its results' states and, at the end, its absent ones."""
    from haros_ci.results.matching import match

    by_tool: dict[str, list[KnownFinding]] = {}
    for entry in known:
        by_tool.setdefault(entry.tool, []).append(entry)
    return tuple(
        replace(run, results=tuple(sorted(match(run.results, by_tool.get(run.tool.name, ()), sides), key=_order)))
        for run in runs
    )


def _order(result: Result) -> tuple[object, ...]:
    return (*result.sort_key, result.state.value if result.state else "")


def _bytes_of(settings: Settings) -> bytes:
    name = settings.baseline or ""
    path = settings.root / name
    if settings.baseline_rev is not None:
        data = _bytes_at_base(path, name, settings)
        if data is not None:
            return data
    return read_input(path, name)


def _bytes_at_base(path: Path, name: str, settings: Settings) -> bytes | None:
    """A baseline file as it is in the base revision; None if no change could bring it."""
    from haros_ci.workspace.base_commit import base_commit

    if settings.base_missing:
        if path.is_relative_to(settings.root):
            raise BaselineUnavailable(settings.without_base)
        return None
    base = base_commit(settings.root, settings.baseline_rev or "", settings.base)
    if not base.holds(path):
        return None
    data = base.read(path)
    if data is None:
        raise BaselineUnavailable(f"{name} is not in the base revision")
    return data


def read_input(path: Path, name: str) -> bytes:
    """A file that the command line names; UserError if it is not a readable regular file of sane size."""
    try:
        data = read_regular(path, MAX_BYTES)
    except TooLarge as err:
        raise UserError(f"{name}: larger than {MAX_BYTES // 1_000_000} MB", help="this is no log of findings") from err
    except OSError as err:
        raise UserError(f"{name}: cannot be read: {err.strerror}", help="check the path") from err
    if data is None:
        raise UserError(f"{name}: not a regular file", help="check the path")
    return data
