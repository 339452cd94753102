# SPDX-License-Identifier: Apache-2.0
"""The one place that starts git, in a way that runs nothing a repository's configuration names.

Only plumbing that neither checks out nor cleans files is used, so filters and hooks have no occasion to run. The git
directory and the work tree are always passed explicitly: ``core.worktree`` cannot point elsewhere, and repositories
owned by another user (containers in CI) need no ``safe.directory``.
"""

from __future__ import annotations

import os
import subprocess
from functools import lru_cache
from pathlib import Path
from threading import Timer
from typing import Any

from haros_ci.records import dataclass
from haros_ci.workspace.files import TooLarge, read_regular

TIMEOUT = 120.0  # seconds
#: Seconds in which git has to find what is untracked and not ignored: patterns of a .gitignore can take it any time (``**/`` ten times in one line).
LISTING = 30.0
LARGEST_CONTROL_FILE = 4_000_000

#: How tree entries of regular files begin; the last mode is from git's first years.
REGULAR = (b"100644 ", b"100755 ", b"100664 ")

#: Over whatever the repository configures. An empty core.fsmonitor is "off" in old versions too, where it named a hook.
OVERRIDES = ("core.fsmonitor=", "core.hooksPath=/dev/null", "protocol.allow=never")

#: The environment of git: its own variables (a surrounding hook sets some) are dropped but for these.
KEPT = ("GIT_CONFIG_GLOBAL", "GIT_CONFIG_SYSTEM", "GIT_EXEC_PATH")
ENVIRONMENT = {
    "GIT_ALLOW_PROTOCOL": "none",  # stronger than protocol.*.allow of the repository
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_NO_REPLACE_OBJECTS": "1",
    "GIT_OPTIONAL_LOCKS": "0",
    "GIT_TERMINAL_PROMPT": "0",
    "LC_ALL": "C",
}


class GitError(Exception):
    """git is not there, refused, or took too long. ``code`` is its exit code, None if it did not run to its end."""

    def __init__(self, message: str, code: int | None = None) -> None:
        super().__init__(message)
        self.code = code


class GitTooSlow(GitError):
    """git did not end in its time."""


class BaselineUnavailable(Exception):
    """There is no base revision to compare with; the message says why and what to do."""


@dataclass(frozen=True, slots=True)
class Repository:
    """A work tree: *top* is the absolute directory that holds ``.git`` (a directory, or a file in submodules)."""

    top: Path

    @property
    def git_directory(self) -> Path:
        """Where HEAD and the index are."""
        entry = self.top / ".git"
        pointer = control_text(entry)
        if not pointer.startswith("gitdir:"):
            return entry
        return self.top / pointer.removeprefix("gitdir:").strip()

    @property
    def common_directory(self) -> Path:
        """Where objects, branches and configuration are; differs from ``git_directory`` in linked work trees."""
        directory = self.git_directory
        return directory / (control_text(directory / "commondir").strip() or ".")

    @property
    def is_shallow(self) -> bool:
        return os.path.exists(self.common_directory / "shallow")


def repository_of(root: Path) -> Path | None:
    """The top directory of the innermost repository that *root* lies in; no process is started."""
    for directory in (root, *root.parents):
        if os.path.lexists(directory / ".git"):
            return directory
    return None


def run_git(
    repository: Repository,
    *arguments: str,
    cwd: Path | None = None,
    stdin: bytes = b"",
    environment: dict[str, str] | None = None,
    limit: int | None = None,
    timeout: float = TIMEOUT,
) -> bytes:
    """Run one git command on *repository* and return what it prints; GitError if it fails, or prints more than *limit* bytes.

    GitTooSlow, unless there is a *limit*, if it takes longer than *timeout* seconds.
    """
    program = _program(repository.top, os.environ.get("PATH", os.defpath))
    if program is None:
        raise GitError("git is not installed")
    argv = [program, "--literal-pathspecs", "--no-pager"]
    for override in OVERRIDES:
        argv += ["-c", override]
    inherited = {k: v for k, v in os.environ.items() if not k.startswith("GIT_") or k in KEPT}
    paths = {"GIT_DIR": str(repository.top / ".git"), "GIT_WORK_TREE": str(repository.top)}
    options: dict[str, Any] = {
        "cwd": cwd or repository.top,
        "env": {**inherited, **ENVIRONMENT, **paths, **(environment or {})},
        "stdout": subprocess.PIPE,
        "stderr": subprocess.DEVNULL,
    }
    try:
        if limit is not None:
            return _first_bytes([*argv, *arguments], options, arguments[0], limit)
        done = subprocess.run([*argv, *arguments], input=stdin, timeout=timeout, check=False, **options)
    except subprocess.TimeoutExpired as err:
        raise GitTooSlow(f"git {arguments[0]} took longer than {timeout:g} s") from err
    except OSError as err:
        raise GitError(f"git cannot be started: {err.strerror}") from err
    if done.returncode != 0:
        raise GitError(f"git {arguments[0]} failed with exit code {done.returncode}", done.returncode)
    printed: bytes = done.stdout
    return printed


def _first_bytes(argv: list[str], options: dict[str, Any], command: str, limit: int) -> bytes:
    """What *argv* prints, as long as it is no more than *limit* bytes: a few objects can stand for trees without end."""
    with subprocess.Popen(argv, stdin=subprocess.DEVNULL, **options) as process:
        assert process.stdout is not None
        clock = Timer(TIMEOUT, process.kill)
        clock.start()
        try:
            data: bytes = process.stdout.read(limit + 1)
        except BaseException:
            process.kill()  # else the end of the block would wait for it
            raise
        finally:
            clock.cancel()
        if len(data) > limit:
            process.kill()
            raise GitError(f"git {command} prints more than {limit} bytes")
        if code := process.wait(TIMEOUT):
            raise GitError(f"git {command} failed with exit code {code}", code)
    return data


@dataclass(frozen=True, slots=True)
class GitFiles:
    """What git lists: *files*, the repositories *nested* in them, *executables* and, by *tracked* path, the name of what the index holds.

    *is_whole* is false where git did not find in its time what is not tracked: none of that is among them then. *sparse* are the tracked
    files that it leaves out of the work tree (git-sparse-checkout(1)).
    """

    files: list[str]
    nested: list[str]
    executables: list[str]
    tracked: dict[str, str]
    is_whole: bool = True
    sparse: tuple[str, ...] = ()


def listed_files(repository: Repository, cwd: Path, directories: tuple[str, ...]) -> GitFiles:
    """Tracked and untracked, not ignored files below *directories*.

    *directories* and all paths that come back are relative to *cwd*, a directory of the work tree. Files that are
    tracked but deleted are among them. Of executable ones only those are known that git tracks. GitError if git does not work.
    """
    tracked_only = ("ls-files", "-z", "-t", "-s", "-c")
    is_whole = True
    try:
        listed = run_git(
            repository, *tracked_only, "-o", "--exclude-standard", "--", *directories, cwd=cwd, timeout=LISTING
        )
    except GitTooSlow:
        is_whole = False
        listed = run_git(repository, *tracked_only, "--", *directories, cwd=cwd)
    files: set[str] = set()
    nested: set[str] = set()
    executables: set[str] = set()
    tracked: dict[str, str] = {}
    sparse: list[str] = []
    for record in listed.split(b"\0"):
        if record.startswith(b"? "):  # untracked; a repository of its own ends with a slash
            path = os.fsdecode(record[2:])
            (nested if path.endswith("/") else files).add(path.rstrip("/"))
        elif record:
            entry, _, name = record.partition(b"\t")
            path = os.fsdecode(name)
            (nested if entry[2:].startswith(b"160000") else files).add(path)
            if entry[2:].startswith(b"100755"):
                executables.add(path)
            tracked[path] = entry[9:-2].decode("ascii")
            if entry.startswith(b"S "):
                sparse.append(path)
    return GitFiles(sorted(files), sorted(nested), sorted(executables), tracked, is_whole, tuple(sorted(sparse)))


def resolve_commit(repository: Repository, rev: str) -> str:
    """The commit that *rev* names; BaselineUnavailable if there is none."""
    readable = rev and not rev.startswith("-") and rev.isprintable()
    try:
        if readable:
            arguments = ("rev-parse", "--verify", "--quiet", "--end-of-options", f"{rev}^{{commit}}")
            return run_git(repository, *arguments).decode("ascii").strip()
    except GitError as err:
        if err.code is None:
            raise BaselineUnavailable(f"{err}; install git or use a baseline file") from err
    if rev == "HEAD":
        raise BaselineUnavailable("the repository has no commit yet; use a baseline file")
    hint = "this clone is shallow: fetch the revision first (actions/checkout: fetch-depth: 0)"
    advice = hint if repository.is_shallow else "check the spelling, or fetch it first"
    raise BaselineUnavailable(f"unknown revision {rev!r}; {advice}")


def merge_base(root: Path, rev: str) -> str:
    """The commit at which the history of HEAD left that of *rev*; of several, the one that git names first.

    BaselineUnavailable says whether git, the repository, the revision or (in a shallow clone) history is missing.
    """
    repository, _ = _repository_around(root)
    commit = resolve_commit(repository, rev)
    head = resolve_commit(repository, "HEAD")
    try:
        return run_git(repository, "merge-base", commit, head).decode("ascii").strip()
    except GitError as err:
        if err.code != 1:
            raise BaselineUnavailable(f"{err}; use a baseline file") from err
    if repository.is_shallow:
        raise BaselineUnavailable(
            f"this shallow clone does not reach the commit that {rev!r} and HEAD have in common; "
            "fetch more history (actions/checkout: fetch-depth: 0)"
        )
    raise BaselineUnavailable(
        f"{rev!r} and HEAD have no commit in common; name another revision or use a baseline file"
    )


def read_at(root: Path, rev: str, path: str) -> bytes | None:
    """The file at *path* (POSIX-style, relative to *root*) as it is in *rev*; None if there is no such regular file.

    BaselineUnavailable as for merge_base.
    """
    repository, prefix = _repository_around(root)
    return read_in_commit(repository, resolve_commit(repository, rev), path, prefix)


def read_in_commit(repository: Repository, commit: str, path: str, prefix: str = "") -> bytes | None:
    """The file at *prefix* and *path* (POSIX-style) as it is in *commit*, a name that git gave; None if there is no such regular file.

    BaselineUnavailable if git cannot read it.
    """
    parts = path.split("/")
    inner = "/".join(part for part in parts if part not in ("", "."))
    if not inner or path.startswith("/") or ".." in parts or "\0" in path:
        return None
    name = prefix + inner
    try:
        entry = run_git(repository, "ls-tree", "-z", "--full-tree", commit, "--", name).rstrip(b"\0")
        kind, _, found = entry.partition(b"\t")
        if os.fsdecode(found) != name or not kind.startswith(REGULAR):
            return None
        return run_git(repository, "cat-file", "blob", kind.split()[2].decode("ascii"))
    except GitError as err:
        raise BaselineUnavailable(f"{path} cannot be read in {commit!r}: {err}") from err


def _repository_around(root: Path) -> tuple[Repository, str]:
    """The repository that *root* lies in, and what to put before paths relative to *root*."""
    root = root.resolve()
    top = repository_of(root)
    if top is None:
        raise BaselineUnavailable("not in a git repository; use a baseline file instead of a revision")
    return Repository(top), "" if root == top else f"{root.relative_to(top).as_posix()}/"


def control_text(path: Path) -> str:
    """A file of a git directory as text, "" if there is no such regular file."""
    try:
        return (read_regular(path, LARGEST_CONTROL_FILE) or b"").decode("utf-8", "replace")
    except (OSError, TooLarge, ValueError):  # a path with NUL is a ValueError
        return ""


@lru_cache(maxsize=64)
def _program(top: Path, path: str) -> str | None:
    """git by absolute path, from no directory of the work tree *top*, which may have been put on *path* (PATH)."""
    here = (top, top.resolve())
    for directory in path.split(os.pathsep):
        places = (Path(directory), Path(os.path.realpath(directory)))
        if not os.path.isabs(directory) or any(place.is_relative_to(root) for place in places for root in here):
            continue
        candidate = os.path.join(directory, "git")
        if os.path.isfile(candidate) and os.access(candidate, os.X_OK):
            return candidate
    return None
