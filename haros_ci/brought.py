# SPDX-License-Identifier: Apache-2.0
"""What a change brings that would hide its findings: what its base has is found out before, what is said of it after a run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from haros_ci.config.settings import Settings
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Notification, Run, Silenced
from haros_ci.results.rule import Level
from haros_ci.results.silence_words import sentences
from haros_ci.workspace.base import Base

if TYPE_CHECKING:
    from haros_ci.workspace.past import Past


def before(settings: Settings) -> Past | None:
    """What the base revision holds, if one is asked for: its marker files count, not those that a change brings."""
    if settings.baseline_rev is None:
        return None
    from haros_ci.workspace.past import past_of

    return past_of(settings.root.resolve(), settings.baseline_rev, is_missing=bool(settings.base_missing))


def silenced(workspace: Workspace, base: Base, runs: Iterable[Run]) -> Silenced:
    """What comments silence that the files have now and did not have in *base*."""
    from haros_ci.results.silenced import SilencedPair
    from haros_ci.results.silenced import silenced as found

    old = {base.renames.get(file.path, file.path): file for file in base.workspace.files}
    text = base.workspace.text
    changed = [
        (file, was)
        for file in workspace.files
        if workspace.reports_on(file.path)
        and ((was := old.get(file.path)) is None or was.digest != file.digest or was.path != file.path)
    ]
    present = {file.path for file in workspace.files}
    return found(
        (
            SilencedPair(f.path, f.language, workspace.text(f.path), None if was is None else text(was.path))
            for f, was in changed
        ),
        ((was.path, was.language, text(was.path)) for path, was in old.items() if path not in present),
        runs,
    )


def notices(workspace: Workspace, silence: Silenced) -> Iterator[Notification]:
    """What is said of all this beside the findings."""
    for problem in workspace.hiding.warnings:
        yield Notification(Level.WARNING, problem.message, path=problem.path)
    for problem in workspace.hiding.notes:
        yield Notification(Level.NOTE, problem.message, path=problem.path)
    for sentence in sentences(silence):
        yield Notification(Level.NOTE, sentence)
