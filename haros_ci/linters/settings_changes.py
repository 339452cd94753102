# SPDX-License-Identifier: Apache-2.0
"""What a change does to the settings files of linters: notes, for the run takes these from the base revision."""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import dirname, join

from haros_ci.linters import settings_files
from haros_ci.linters.silencing import SETTINGS, SilencingRow
from haros_ci.linters.switches import Keys, Switches, turned_off
from haros_ci.linters.tool_switches import KEYS
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass, field
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level

#: Files that are named, and what of each.
MOST_FILES = 20
MOST_RULES = 20
_NAMES = frozenset(name for row in SETTINGS for name in row.files)


@dataclass(slots=True)
class _Change:
    """What the difference of one file switches off, and for which tools nobody can tell."""

    off: set[str] = field(default_factory=set)
    unread: set[str] = field(default_factory=set)
    tools: set[str] = field(default_factory=set)


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """The notes on the settings files that *head* and *base* have differently; none without a base whose settings count."""
    if base is None:
        return ()
    return tuple(
        Notification(Level.NOTE, note.message, path=note.path or None, configuration=True) for note in notes(head, base)
    )


def notes(head: Workspace, base: Workspace) -> Iterator[Problem]:
    """A sentence for each settings file that *head* and *base* have differently, with what *head*'s would switch off.

    Both read their own settings. A file of several tools (pyproject.toml) counts where the part of one of the tools differs.
    Of more than ``MOST_FILES`` the last note is a count, of no file; those that switch something off come first.
    """
    found = _changes(head, base)
    paths = sorted(found, key=lambda path: (not (found[path].off or found[path].unread), path))
    for path in sorted(paths[:MOST_FILES]):
        yield Problem(path, f"{_how(path, head, base)} {_what(found[path], bool(head.setting(path)))}")
    if (more := len(paths) - MOST_FILES) > 0:
        yield Problem("", f"{more} more settings files of linters differ from the base revision's, which this run uses")


def _changes(head: Workspace, base: Workspace) -> dict[str, _Change]:
    found: dict[str, _Change] = {}
    for directory in sorted(_directories(head) | _directories(base)):
        for row in SETTINGS:
            for name in row.files:
                path = join(directory, name)
                for changed in _changed(row, path, head, base):
                    _compare(row, path, head, base, found.setdefault(changed, _Change()))
    return found


def _changed(row: SilencingRow, path: str, head: Workspace, base: Workspace) -> Iterator[str]:
    """*path* and the files that it refers to on either side, as far as they differ for the tool."""
    if head.setting(path) == base.setting(path) == "":
        return
    if head.setting(path) != base.setting(path) and _part(row, head, path) != _part(row, base, path):
        yield path
    for side in (head, base):
        if _counts(row, path, side):
            for other in row.refers(side, path):
                if other != path and head.setting(other) != base.setting(other):
                    yield other


def _compare(row: SilencingRow, path: str, head: Workspace, base: Workspace, change: _Change) -> None:
    change.tools.add(row.tool)
    keys = KEYS.get(row.tool, Keys())
    try:
        after = _switches(row, path, head)
    except (ValueError, RecursionError):
        change.unread.add(row.tool)
        return
    try:
        before = _switches(row, path, base)
    except (ValueError, RecursionError):
        before = Switches()
    change.off.update(turned_off(row.tool, before, after, keys))


def _switches(row: SilencingRow, path: str, side: Workspace) -> Switches:
    """What holds where the file at *path* lies: by the nearest file, or for a tool that adds them up by this one."""
    assert row.read is not None
    if row.tool == "cpplint" or path.endswith("-ignore"):
        return row.read(side, path)
    config = settings_files.nearest(side, dirname(path), row.marks)
    if config is not None and not config.endswith("-ignore"):
        settings_files.check(side.setting(config), config)
    return row.read(side, config or "") if config or row.tool in ("yamllint", "clang-format") else Switches()


def _counts(row: SilencingRow, path: str, side: Workspace) -> bool:
    text = side.setting(path)
    marks = row.marks[path.rpartition("/")[2]]
    return any(mark in text for mark in marks) if marks else bool(text.strip())


def _part(row: SilencingRow, side: Workspace, path: str) -> object:
    """What of the file is the tool's: its sections, or all of the text."""
    text = side.setting(path)
    if not _counts(row, path, side):
        return None
    try:
        if path.endswith(".toml") and "pyproject" in path:
            return settings_files.toml(text).get(row.tool)
        if path.endswith(("setup.cfg", "tox.ini")):
            marks = tuple(mark.rstrip("]").lstrip("[") for mark in row.marks[path.rpartition("/")[2]])
            return {name: options for name, options in settings_files.ini(text).items() if name.startswith(marks)}
    except (ValueError, RecursionError):
        pass
    return text


def _directories(side: Workspace) -> set[str]:
    """The directories of all files, and those above them."""
    found = {""}
    for file in side.files:
        directory = dirname(file.path)
        while directory not in found:
            found.add(directory)
            directory = dirname(directory)
    return found


def _how(path: str, head: Workspace, base: Workspace) -> str:
    if not base.setting(path):
        return f"{path} is not in the base revision: it has no effect until it is."
    if not head.setting(path):
        return f"{path} is removed here; this run still uses the base revision's."
    return f"{path} differs from the base revision's, which this run uses."


def _what(change: _Change, is_there: bool) -> str:
    messages = []
    if change.off:
        named = sorted(change.off)
        more = f" and {len(named) - MOST_RULES} more" if len(named) > MOST_RULES else ""
        messages.append(f"The change turns off: {', '.join(named[:MOST_RULES])}{more}.")
    if change.unread and is_there:
        messages.append(
            f"The settings for {', '.join(sorted(change.unread))} cannot be read, so the rules that they turn off are unknown."
        )
    return " ".join(messages) or f"No rule of {', '.join(sorted(change.tools))} is known to be turned off."
