# SPDX-License-Identifier: Apache-2.0
"""``--fix`` and ``--diff``: what the findings offer to mend, as new texts of files, as a patch, and on disk."""

from __future__ import annotations

import os
import re
import stat
import sys
from collections.abc import Callable, Collection, Iterable, Iterator
from difflib import unified_diff
from pathlib import Path

import click

from haros_ci.config.settings import Settings
from haros_ci.errors import EXIT_TOOL_TROUBLE
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.report.escape import patch as shown
from haros_ci.report.escape import terminal
from haros_ci.results.fix import Edit, Fix, applied
from haros_ci.results.result import Report, Result
from haros_ci.workspace.files import FileTree, TooLarge, read_regular
from haros_ci.writing import replace

#: A file larger than this is left as it is; manifests, CMake and launch files are far smaller.
MAX_BYTES = 4_000_000


@dataclass(frozen=True, slots=True)
class Mended:
    """A file with all edits made: its text *before* and *after*, and whether its execute bits are to be set."""

    path: str
    before: str
    after: str
    is_executable: bool = False


@dataclass(frozen=True, slots=True)
class FixPlan:
    """What is to be written, and the findings that this mends."""

    files: tuple[Mended, ...] = ()
    mended: tuple[Result, ...] = ()

    def without(self, paths: Collection[str]) -> int:
        """How many findings are mended if the files at *paths* stay as they are."""
        return sum(not any(edit.path in paths for edit in result.fixes[0].edits) for result in self.mended)


def show_patch(report: Report, workspace: Workspace, settings: Settings) -> int:
    """``--diff``: what ``--fix`` would change, as a patch; nothing is written."""
    made = plan(report.shown(), workspace.text)
    text = patch(made)
    read_here = sys.stdout.isatty() or os.environ.get(
        "GITHUB_ACTIONS"
    )  # by a person, or a runner that obeys what it reads
    click.echo(shown(text) if read_here else text, nl=False)
    if set(report.failed_tools()) - settings.allow_tool_failure:
        return EXIT_TOOL_TROUBLE
    return 1 if made.files else 0


def mend(report: Report, workspace: Workspace, settings: Settings) -> bool:
    """``--fix``: mend what is open and can be mended; whether any file was changed."""
    made = plan(report.shown(), workspace.text)
    left = write(settings.root, made)
    for path, why in left.items():
        click.echo(f"warning: {terminal(path)}: left as it is: {terminal(why)}", err=True)
    if len(left) < len(made.files):
        click.echo(f"mended: {made.without(left)} findings, in {len(made.files) - len(left)} files", err=True)
    return len(left) < len(made.files)


def plan(results: Iterable[Result], text: Callable[[str], str]) -> FixPlan:
    """The first fix of each of *results*, all of its edits or none; of two that overlap the earlier finding's."""
    edits: dict[str, list[Edit]] = {}
    executables: set[str] = set()
    mended = []
    for result in results:
        if not result.fixes or not _fits(result.fixes[0], edits, text):
            continue
        mended.append(result)
        for edit in result.fixes[0].edits:
            if edit.is_executable:
                executables.add(edit.path)
            elif edit not in edits.setdefault(edit.path, []):
                edits[edit.path].append(edit)
    files = []
    for path in sorted({*edits, *executables}):
        before = text(path)
        files.append(Mended(path, before, applied(before, edits.get(path, ())), path in executables))
    return FixPlan(tuple(files), tuple(mended))


def _fits(fix: Fix, edits: dict[str, list[Edit]], text: Callable[[str], str]) -> bool:
    """Whether the edits of *fix* can be made beside those that are there already."""
    for path in {edit.path for edit in fix.edits if not edit.is_executable}:
        own = [edit for edit in fix.edits if edit.path == path and not edit.is_executable]
        try:
            applied(text(path), dict.fromkeys((*edits.get(path, ()), *own)))
        except ValueError:
            return False
    return True


def patch(made: FixPlan) -> str:
    """The plan as a patch that ``git apply`` reads."""
    return "".join(line for file in made.files for line in _patch(file))


def _patch(file: Mended) -> Iterator[str]:
    if file.is_executable:
        yield f"diff --git {_named('a/' + file.path)} {_named('b/' + file.path)}\nold mode 100644\nnew mode 100755\n"
    before, after = (re.findall(r"[^\n]*\n|[^\n]+", text) for text in (file.before, file.after))
    for line in unified_diff(before, after, _named(f"a/{file.path}"), _named(f"b/{file.path}")):
        yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _named(path: str) -> str:
    """*path* as git writes it: in quotes where a reader would take it for another (git-config(1), core.quotePath)."""
    if path.isprintable() and '"' not in path and "\\" not in path:
        return path
    plain = (chr(byte) if 32 <= byte < 127 and byte not in b'"\\' else f"\\{byte:03o}" for byte in path.encode())
    return f'"{"".join(plain)}"'


def write(root: Path, made: FixPlan) -> dict[str, str]:
    """Write the plan below *root*; the paths of files that are left as they are, and why.

    A file is replaced as a whole, with its permissions: no symbolic link is followed, nothing but UTF-8 is touched, and nothing that has
    changed since it was read.
    """
    tree = FileTree(root)
    return {file.path: problem for file in made.files if (problem := _write(tree, file))}


def _write(tree: FileTree, file: Mended) -> str:
    try:
        place = tree.place(file.path)
        data = read_regular(place, MAX_BYTES)
        mark = b"\xef\xbb\xbf" if data is not None and data.startswith(b"\xef\xbb\xbf") else b""
        if data is None or data[len(mark) :] != file.before.encode():
            return "it is not UTF-8, or has changed meanwhile"
        known = os.lstat(place)
        mode = known.st_mode | ((known.st_mode & 0o444) >> 2 if file.is_executable else 0)
        if file.after != file.before:
            if not os.access(place, os.W_OK):
                return "it is read-only"
            replace(place, mark + file.after.encode(), known, stat.S_IMODE(mode))
        elif mode != known.st_mode:
            os.chmod(place, stat.S_IMODE(mode))
    except (OSError, ValueError, TooLarge) as err:
        return getattr(err, "strerror", None) or str(err) or "it is too large"
    return ""
