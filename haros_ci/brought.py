# SPDX-License-Identifier: Apache-2.0
"""What a change brings that would hide its findings: what its base has is found out before, what is said of it after a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.config.settings import Settings
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results import own
from haros_ci.results.result import BaselineState, Notification, Result, Run, Silenced
from haros_ci.results.rule import Level
from haros_ci.results.silence_words import sentences
from haros_ci.workspace.base import Base
from haros_ci.workspace.git import BaselineUnavailable

if TYPE_CHECKING:
    from haros_ci.results.silenced import AddedComments
    from haros_ci.workspace.past import Past


#: Runs, and results on files that a linter cannot analyse.
Unreadable = tuple[tuple[Run, ...], tuple[Result, ...]]

#: What a linter says of a file that it cannot analyse, and the file that is the reason, if it is another one.
_SAYS = " could not analyse this file: "
_AT = regex(r" \((?P<path>[^()]+):\d+\)\Z")
#: Python of another version than the linters': honest code of which it is said.
_NEWER_PYTHON = "it is for Python 3"
_OTHER_PYTHON = ("it is Python 2", _NEWER_PYTHON)
#: What linters say of code that no interpreter takes; so it is a finding already.
_OF_SYNTAX = frozenset({"syntax-error", "invalid-syntax", "E999"})


def before(settings: Settings) -> Past | None:
    """What the base revision holds, if one is asked for: its marker files count, not those that a change brings."""
    if settings.baseline_rev is None:
        return None
    from haros_ci.workspace.past import past_of

    is_missing = bool(settings.base_missing)
    return past_of(settings.root.resolve(), settings.baseline_rev, known=settings.base, is_missing=is_missing)


def silenced(
    workspace: Workspace,
    settings: Settings,
    base: Base | BaselineUnavailable | None,
    runs: tuple[Run, ...],
    examine: Callable[[Workspace], tuple[Run, ...]],
    uncommented: Callable[[Workspace, frozenset[str]], tuple[Run, ...]] | None,
) -> Silenced:
    """What comments silence that the files have now and did not have in *base*, and what those silence that were there.

    The latter only where the findings at *base* are known anyway: *examine* gives them, and *uncommented* what comments keep tools from saying
    of files that have changed (None: no tool is run).
    """
    if not isinstance(base, Base):
        return Silenced()
    from haros_ci.results.silenced import by_place

    added = _by_comments(workspace, base)
    found = added.silenced(runs)
    if settings.baseline is not None:
        return found
    beside = frozenset((place.path, (place.line or 0) + n) for place in added.places for n in (0, 1))
    more = (
        (place, rule)
        for place, rule in _more(workspace, base, runs, examine, uncommented)
        if (place.path, place.line) not in beside
    )
    return replace(found, more=tuple(sorted({*found.more, *more}, key=by_place)))


def _more(
    workspace: Workspace,
    base: Base,
    runs: tuple[Run, ...],
    examine: Callable[[Workspace], tuple[Run, ...]],
    uncommented: Callable[[Workspace, frozenset[str]], tuple[Run, ...]] | None,
) -> Iterator[tuple[Location, str]]:
    """The findings that are left out or suppressed for comments now, and that *base* neither had nor left out."""
    from haros_ci.results.fingerprint import fingerprint
    from haros_ci.results.known import known_from, sides
    from haros_ci.results.pairing import pair

    now_changed, old_changed = _changed(workspace, base)
    quiet = uncommented(workspace, now_changed) if uncommented is not None and now_changed else ()
    before = uncommented(base.workspace, old_changed) if uncommented is not None and quiet else ()
    lost = {(base.renames.get(path, path), tool) for path, tool in _lost(before)}
    yield from ((Location(path), f"what {tool} would say") for path, tool in _lost(quiet) if (path, tool) not in lost)
    now = (*(replace(run, results=_suppressed(run)) for run in runs), *quiet)
    now = tuple(run for run in now if run.results)
    if not now:
        return
    of_tools = {run.tool.name for run in now}
    languages = {file.path: file.language for it in (base.workspace, workspace) for file in it.files}
    old = tuple(
        replace(run, results=(*run.silenced, *run.results))
        for run in (*examine(base.workspace), *before)
        if run.tool.name in of_tools
    )
    old = fingerprint(old, base.workspace.text, lambda path: languages.get(path, ""))
    now = fingerprint(now, workspace.text, lambda path: languages.get(path, ""))
    found = sides(workspace, now, (".",), base.workspace, base.renames)
    known = [known_from(result) for run in old for result in run.results]
    results = [result for run in now for result in run.results]
    paired = {one.new for one in pair(results, known, found)}
    for i, result in enumerate(results):
        if i not in paired:
            yield Location(result.location.path, result.location.line), result.rule


def _lost(runs: Iterable[Run]) -> set[tuple[str, str]]:
    """The files that tools could not analyse without comments, each with the tool's name."""
    return {(note.path, run.tool.name) for run in runs for note in run.notifications if note.path}


def _suppressed(run: Run) -> tuple[Result, ...]:
    """What comments silence of a run: what a tool says of that, and findings that comments of ours suppress. Numbers have limits of their own."""
    own_ones = (
        result
        for result in run.results
        if result.value is None
        and result.state is not BaselineState.ABSENT
        and any(s.kind == "inSource" for s in result.suppressions)
    )
    return (*run.silenced, *own_ones)


def _changed(workspace: Workspace, base: Base) -> tuple[frozenset[str], frozenset[str]]:
    """The paths that have other contents now than in *base*, or are new; and those of *base* that have, or are gone."""
    now = {file.path: file.digest for file in workspace.files}
    old = {file.path: file.digest for file in base.workspace.files}
    moved = base.renames
    gone = frozenset(path for path, digest in old.items() if now.get(moved.get(path, path)) != digest)
    same = {moved.get(path, path) for path in old.keys() - gone}
    return frozenset(now.keys() - same), gone


def _by_comments(workspace: Workspace, base: Base) -> AddedComments:
    from haros_ci.results.silenced import SilencedPair, added_comments

    old = {base.renames.get(file.path, file.path): file for file in base.workspace.files}
    text = base.workspace.text
    changed = [
        (file, was)
        for file in workspace.files
        if workspace.reports_on(file.path)
        and ((was := old.get(file.path)) is None or was.digest != file.digest or was.path != file.path)
    ]
    present = {file.path for file in workspace.files}
    return added_comments(
        (
            SilencedPair(f.path, f.language, workspace.text(f.path), None if was is None else text(was.path))
            for f, was in changed
        ),
        ((was.path, was.language, text(was.path)) for path, was in old.items() if path not in present),
    )


def unreadable(
    workspace: Workspace, base: Base | None, runs: tuple[Run, ...], past: Callable[[Base], Iterable[Run]] | None
) -> Unreadable:
    """The *runs* without what linters cannot analyse since *base*, and a result for each file of that, and for what else *base* had analysed."""
    if base is None:
        return runs, ()
    from haros_ci.workspace.build_changes import brought_steps
    from haros_ci.workspace.lost_packages import lost_packages

    left, lost = _unreadable(workspace, base, runs, past)
    brought = (*brought_steps(workspace, base.workspace)[0], *lost_packages(workspace, base.workspace, base.renames))
    return left, (*own.unread_results(_used_first(workspace, base)), *own.brought_results(brought), *lost)


def _used_first(workspace: Workspace, base: Base) -> Iterator[Problem]:
    """The files that nothing in *base* used as code, and that are what they were: whatever is wrong in them, the change brings it in."""
    if not workspace.hiding.used:
        return
    from haros_ci.workspace.used_code import UsedCode

    now = {origin: use.problem.path for use in workspace.hiding.used for origin in use.origins}
    before = UsedCode(base.workspace, lambda path: workspace.text(now.get(path, path)))
    for use in workspace.hiding.used:
        if not any(before.is_used(origin, use.directory) for origin in use.origins):
            yield use.problem


def _unreadable(
    workspace: Workspace, base: Base, runs: tuple[Run, ...], past: Callable[[Base], Iterable[Run]] | None
) -> Unreadable:
    """The *runs* without what they say of code that linters cannot analyse since *base*, and a result for each file of that.

    Such code is C++ or Python that the change alters or adds: what is wrong in it would not be found. *past* gives the runs on *base*, where what
    could not be analysed is no news; without it that is not known. Of Python of another version than the linters' nothing is a finding, but where
    the base revision had it so that they could read it, and where a new file is for a newer one than anything in the base revision: nobody says
    that the robot has that, and its linters could have been silenced by one line.
    """
    notes = _gave_up(runs)
    if not notes:
        return runs, ()
    wrong = {result.location.path for run in runs for result in run.results if result.rule in _OF_SYNTAX}
    notes = [one for one in _of_change(notes, workspace, base, is_known=past is not None) if one.place not in wrong]
    if notes and past is not None:
        notes = _unknown(notes, _gave_up(past(base)), base)
    lost = {one.place: (one.tool, one.reason) for one in reversed(notes)}
    return _without(runs, {one.notification for one in notes}), own.unreadable_results(lost)


def _unknown(notes: list[_GaveUp], before: list[_GaveUp], base: Base) -> list[_GaveUp]:
    known = {(old.tool, base.renames.get(old.path, old.path)) for old in before}
    if any(old.is_newer_python for old in before):
        there = {base.renames.get(file.path, file.path) for file in base.workspace.files}
        notes = [one for one in notes if one.path in there or not one.is_newer_python]
    return [one for one in notes if (one.tool, one.path) not in known]


def _without(runs: tuple[Run, ...], news: set[Notification]) -> tuple[Run, ...]:
    return tuple(replace(run, notifications=tuple(n for n in run.notifications if n not in news)) for run in runs)


@dataclass(frozen=True)
class _GaveUp:
    """What a *tool* says of the file at *path*, which it cannot analyse; the *reason* is in the file at *place*, which it may include."""

    notification: Notification
    tool: str
    path: str
    place: str
    reason: str

    @property
    def is_other_python(self) -> bool:
        return self.reason.startswith(_OTHER_PYTHON)

    @property
    def is_newer_python(self) -> bool:
        return self.reason.startswith(_NEWER_PYTHON)


def _gave_up(runs: Iterable[Run]) -> list[_GaveUp]:
    found = []
    for notification in (n for run in runs for n in run.notifications):
        _, gave_up, reason = notification.message.partition(_SAYS)
        if gave_up and notification.path is not None:
            at = _AT.search(reason)
            place = notification.path if at is None else at["path"]
            found.append(_GaveUp(notification, notification.tool or "", notification.path, place, reason))
    return found


def _of_change(notes: list[_GaveUp], workspace: Workspace, base: Base, *, is_known: bool) -> list[_GaveUp]:
    """Those of *notes* that are about C++ and Python that is not as in *base*; *is_known* tells whether the notes there are known."""
    old = {base.renames.get(file.path, file.path): file for file in base.workspace.files}
    changed = {file.path: old.get(file.path) for file in workspace.files if _differs(file, old.get(file.path))}
    other = {
        one.place
        for one in notes
        if one.is_other_python and not (is_known and (one.is_newer_python or changed.get(one.place)))
    }
    return [one for one in notes if one.place in changed.keys() - other and workspace.reports_on(one.place)]


def _differs(file: SourceFile, old: SourceFile | None) -> bool:
    return file.language in ("cpp", "python") and (old is None or old.digest != file.digest)


def notices(workspace: Workspace, base: Base | None, silence: Silenced) -> Iterator[Notification]:
    """What there is to note of all this beside the findings."""
    if base is not None:
        from haros_ci.workspace.build_changes import brought_builders, brought_steps
        from haros_ci.workspace.shadowing import shadowed

        of_builds = (*brought_steps(workspace, base.workspace)[1], *brought_builders(workspace, base.workspace))
        for problem in (*of_builds, *shadowed(workspace, base.workspace)):
            yield Notification(Level.NOTE, f"since this change {problem.message}", path=problem.path, line=problem.line)
    for problem in workspace.hiding.warnings:
        yield Notification(Level.WARNING, problem.message, path=problem.path)
    for problem in workspace.hiding.notes:
        yield Notification(Level.NOTE, problem.message, path=problem.path)
    for sentence in sentences(silence):
        yield Notification(Level.NOTE, sentence)
