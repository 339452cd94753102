# SPDX-License-Identifier: Apache-2.0
"""What a run looked at, and what it did not."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from haros_ci.model.workspace import LATIN_1, Problem, Workspace
from haros_ci.results.confined import sentence
from haros_ci.results.result import Coverage

#: Files that a sentence names.
_NAMED = 3


def coverage(
    workspace: Workspace, ways: Collection[str] = (), unused: Sequence[str] = (), copied: Sequence[str] = ()
) -> Coverage:
    """What was looked at, and in whole sentences what was not.

    *ways* are those in which linters were confined, *unused* the files whose findings were left out as nothing uses them,
    and *copied* those that are copies by their owners and licences.
    """
    unseen = []
    if not workspace.packages:
        unseen.append(
            "No package.xml was found: files are analysed one by one, nothing is known of packages. Run haros-ci in a workspace of ROS, or a package."
        )
    problems = (problem for problem in workspace.problems if problem.message != LATIN_1)
    unread = list(
        dict.fromkeys(path for problem in (*problems, *workspace.hiding.unread) for path in _paths(problem, workspace))
    )
    if unread:
        named = ", ".join(unread[:_NAMED]) + (f" and {len(unread) - _NAMED} more" if len(unread) > _NAMED else "")
        unseen.append(f"What could not be read, or not in full, as the warnings say: {named}.")
    reported = [file for file in workspace.files if workspace.reports_on(file.path)]
    if generated := [file.path for file in reported if file.is_generated and not file.third_party]:
        unseen.append(_generated(generated))
    if copies := [file.third_party for file in reported if file.third_party not in ("", file.path)]:
        unseen.append(_third_party(copies))
    if single := [file.path for file in reported if file.third_party == file.path]:
        unseen.append(_single(single))
    if unused:
        unseen.append(_unused(unused))
    if copied:
        unseen.append(_copied(copied))
    own = [file for file in workspace.files if not file.third_party]
    others = {file.package for file in workspace.files} - {file.package for file in own}
    return Coverage(
        packages=sum(package.name not in others for package in workspace.packages),
        files=len(own),
        lines=sum(file.lines for file in own if file.language in ("cpp", "python")),
        targets=None if workspace.targets is None else len(workspace.targets),
        unseen=tuple(unseen),
        sandbox=sentence(ways),
    )


def _paths(problem: Problem, workspace: Workspace) -> Iterator[str]:
    """The place of *problem*, and the directories beside it that git fills from other repositories and of which it speaks."""
    yield problem.path
    if problem.path in workspace.unfetched:
        words = set(re.split(r"[ ,:;]+", problem.message))
        yield from sorted(workspace.unfetched & words)


#: How to see them all the same.
_ASK = "A run that is given their directories (haros-ci check DIRECTORY) reports on them."


def _third_party(directories: Sequence[str]) -> str:
    """The sentence on files in *directories*, one item for each file."""
    named = _named(sorted(set(directories)))
    if len(directories) == 1:
        return f"1 file has no findings, because it is in a copy of another project: {named}. {_ASK}"
    return f"{len(directories)} files have no findings, because they are in copies of other projects: {named}. {_ASK}"


def _single(paths: Sequence[str]) -> str:
    named = _named(paths)
    if len(paths) == 1:
        return f"1 file has no findings, because by its name and first comment it is another project's: {named}."
    return f"{len(paths)} files have no findings, because by their names and first comments they are other projects': {named}."


def _unused(paths: Sequence[str]) -> str:
    named = _named(paths)
    if len(paths) == 1:
        return f"What linters say of 1 file was left out, because nothing compiles, starts or imports it: {named}."
    return f"What linters say of {len(paths)} files was left out, because nothing compiles, starts or imports them: {named}."


def _copied(paths: Sequence[str]) -> str:
    named = _named(paths)
    why = "another owner and another licence than the rest of the project"
    if len(paths) == 1:
        return f"What linters say of 1 file was left out, because its first comment names {why}: {named}."
    return f"What linters say of {len(paths)} files was left out, because their first comments name {why}: {named}."


def _named(paths: Sequence[str]) -> str:
    return ", ".join(paths[:_NAMED]) + (f" and {len(paths) - _NAMED} more" if len(paths) > _NAMED else "")


def _generated(paths: Sequence[str]) -> str:
    named = _named(paths)
    if len(paths) == 1:
        return f"1 file was not linted, because its first comment says that it is generated: {named}."
    return f"{len(paths)} files were not linted, because their first comments say that they are generated: {named}."
