# SPDX-License-Identifier: Apache-2.0
"""``haros-ci init``: writes what a repository needs to use haros-ci, says what it did, and overwrites nothing."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click

from haros_ci.config.load import FILE_NAMES
from haros_ci.errors import UserError
from haros_ci.records import dataclass
from haros_ci.report.escape import terminal
from haros_ci.starting import files
from haros_ci.starting.seen import CONFIGURED, look
from haros_ci.workspace.discover import discover
from haros_ci.workspace.files import FileTree, TooLarge, decode
from haros_ci.workspace.git import GitError, Repository, run_git
from haros_ci.workspace.provenance import provenance
from haros_ci.workspace.roots import locate, work_tree
from haros_ci.writing import create

WORKFLOWS = ".github/workflows"
WORKFLOW = f"{WORKFLOWS}/haros-ci.yml"
PRE_COMMIT = (".pre-commit-config.yaml", ".pre-commit-config.yml")
_LIMIT = 1_000_000


@dataclass(frozen=True, slots=True)
class InitPlan:
    """A file to write: *text* at *path*, and *what* it is for. With *left* it is not written, and that is why."""

    path: str
    what: str
    text: str = ""
    left: str = ""


def init(flags: Mapping[str, Any]) -> int:
    """Write a workflow, a pre-commit configuration and a project file as far as they are not there; exit code 0."""
    place = locate((flags["path"],) if flags["path"] else (), Path.cwd())
    root = place.root
    if not place.start.is_dir():
        raise UserError(f"{flags['path']}: not a directory", help="name the directory of your workspace")
    workspace = discover(root, (".",))
    tree = _Top(root)
    seen = look(workspace, tree.names(name for _, name, _ in CONFIGURED), tree.text)
    click.echo(f"Seen: {seen.in_words()}.")
    plans = [*_plans(root, tree), _project(tree, files.project(seen))]
    for plan in plans:
        if plan.left:
            click.echo(f"left   {terminal(plan.path)}: {plan.left}")
        elif flags["dry_run"]:
            click.echo(f"would write {plan.path}: {plan.what}\n")
            click.echo("".join(f"    {terminal(line)}\n" for line in plan.text.splitlines()))
        else:
            _write(root, plan)
            click.echo(f"wrote  {plan.path}: {plan.what}")
    click.echo(
        "Next:  haros-ci check . shows what is found; haros-ci baseline create makes it known, so that only new findings count."
    )
    return 0


def _plans(root: Path, tree: _Top) -> Iterator[InitPlan]:
    """The workflow and the hooks, which need a git repository."""
    if work_tree(root) is None:
        yield InitPlan(WORKFLOW, "", left="not in a git repository")
        yield InitPlan(PRE_COMMIT[0], "", left="not in a git repository")
        return
    using = next((name for name in tree.workflows() if "haros-ci/haros-ci@" in tree.text(name)), None)
    branch = main_branch(root)
    if using:
        yield InitPlan(using, "", left="it runs haros-ci already")
    elif tree.text(".gitlab-ci.yml") and not tree.names((".github",)):
        yield InitPlan(WORKFLOW, "", left="this is a GitLab project; docs/formats.md of haros-ci has the job to copy")
    else:
        what = f"annotates pull requests, and uploads to code scanning what is on {terminal(branch)}"
        yield InitPlan(WORKFLOW, what, files.workflow(branch))
    there = next((name for name in PRE_COMMIT if tree.names((name,))), None)
    if there is None:
        yield InitPlan(PRE_COMMIT[0], "two hooks; pre-commit install turns them on", files.pre_commit())
    elif "haros-ci" in tree.text(there):
        yield InitPlan(there, "", left="it runs haros-ci already")
    else:
        entry = "".join(f"    {line}\n" for line in files.pre_commit().splitlines()[1:])
        yield InitPlan(there, "", left=f"it is yours; add this to its repos:\n{entry}".rstrip("\n"))


def _project(tree: _Top, text: str) -> InitPlan:
    there = next((name for name in FILE_NAMES if tree.names((name,))), None)
    if there == FILE_NAMES[0]:
        return InitPlan(there, "", left="it is there already")
    if there:
        return InitPlan(FILE_NAMES[0], "", left=f"{there} is the project file; another would take its place")
    return InitPlan(FILE_NAMES[0], "the project file, to start from", text)


def main_branch(root: Path) -> str:
    """The branch that pull requests go to: the remote's own, else the one that is checked out, else ``main``."""
    top = work_tree(root)
    if top is not None:
        try:
            reference = run_git(Repository(top), "symbolic-ref", "--quiet", "refs/remotes/origin/HEAD").decode(
                "utf-8", "replace"
            )
            name = reference.strip().removeprefix("refs/remotes/origin/")
            if name and name.isprintable():
                return name
        except GitError:
            pass
    known = provenance(root)
    return (
        known.branch if known and known.branch in ("main", "master", "devel", "develop", "rolling", "ros2") else "main"
    )


class _Top:
    """Files at the root of the workspace by name: hidden ones, which are no part of what is analysed."""

    def __init__(self, root: Path) -> None:
        self._root = root
        self._tree = FileTree(root)

    def names(self, names: Iterator[str] | tuple[str, ...]) -> frozenset[str]:
        return frozenset(name for name in names if os.path.lexists(self._root / name))

    def workflows(self) -> list[str]:
        try:
            found = os.listdir(self._root / WORKFLOWS)
        except OSError:
            return []
        return sorted(f"{WORKFLOWS}/{name}" for name in found if name.endswith((".yml", ".yaml")))

    def text(self, path: str) -> str:
        """The text of a regular file; "" for anything else."""
        try:
            return decode(self._tree.read(path, _LIMIT) or b"")
        except (OSError, TooLarge):
            return ""


def _write(root: Path, plan: InitPlan) -> None:
    """Creates the file; UserError if anything is in its place, or a link on the way would lead elsewhere."""
    try:
        create(root, plan.path, plan.text)
    except OSError as err:
        raise UserError(f"{plan.path}: cannot be written: {err.strerror}", help="what stands above was done") from err
