# SPDX-License-Identifier: Apache-2.0
"""Names, globs and patterns of the project file and the command line that fit nothing in the workspace."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from haros_ci.config.selector import MAX_NOTES, unknown_packages
from haros_ci.config.settings import Settings
from haros_ci.config.suggestion import did_you_mean, quoted
from haros_ci.model import globs
from haros_ci.model.workspace import Workspace

#: Directories that a workspace has only after a build, or on some machines: that they are not there now says nothing.
OUTPUTS = frozenset(
    ("build", "install", "devel", "log", "logs", "build_isolated", "install_isolated", "devel_isolated", "dist", "venv")
)

Idle = Callable[[tuple[str, ...], Iterable[str]], tuple[str, ...]]


def unmatched(settings: Settings, workspace: Workspace, idle: Idle) -> tuple[str, ...]:
    """Notes on what fits nothing, where the whole workspace was looked at; *idle* tells which patterns of .gitignore's form fit no name."""
    if settings.paths != (".",):
        return ()
    known = tuple(package.name for package in workspace.packages)
    notes = (
        *_packages(settings, known),
        *unknown_packages(settings, known),
        *_per_path(settings, workspace),
        *_excludes(settings, workspace, idle),
        *_ignored_files(settings, workspace),
    )
    left = len(notes) - MAX_NOTES
    return notes if left <= 0 else (*notes[:MAX_NOTES], f"and {left} more names and globs that fit nothing here")


def _packages(settings: Settings, known: tuple[str, ...]) -> Iterable[str]:
    where = dict(settings.origins).get("packages", "packages")
    for name in settings.packages:
        if name not in known:
            near = did_you_mean(name, known)
            yield f"{where}: no package {quoted(name)} here" + (f"; {near}" if near else "")


def _per_path(settings: Settings, workspace: Workspace) -> Iterable[str]:
    where = dict(settings.origins).get("per-path", "per-path")
    for entry in settings.per_path:
        for glob in entry.globs:
            if not any(globs.matches(glob, file.path) for file in workspace.files):
                yield f"{where}: no analysed file matches {quoted(glob)}, so what is said for it has no effect"


def _excludes(settings: Settings, workspace: Workspace, idle: Idle) -> Iterable[str]:
    where = dict(settings.origins).get("exclude", "exclude")
    written = tuple(pattern for pattern in settings.exclude if not _is_output(pattern))
    if not written or not workspace.names:
        return
    for pattern in idle(written, workspace.names):
        yield f"{where}: no file here matches {quoted(pattern)} of 'exclude'; what git ignores is left out without it"


def _is_output(pattern: str) -> bool:
    names = pattern.strip().removeprefix("!").split("/")
    return any(name in OUTPUTS or name.startswith(".") or name in ("node_modules", "__pycache__") for name in names)


def _ignored_files(settings: Settings, workspace: Workspace) -> Iterable[str]:
    if not settings.ignore_files:
        return
    place = {package.name: package.path for package in workspace.packages}
    names = []
    for file in workspace.files:
        home = place.get(file.package or "", ".")
        names.append(f"{file.package}/{file.path if home == '.' else file.path.removeprefix(f'{home}/')}")
    for pattern in settings.ignore_files:
        match = globs.compiled(pattern)
        if not any(match(name) for name in names):
            yield f"analysis.ignore.files: no file matches {quoted(pattern)}; write it as package/path/in/the/package"
