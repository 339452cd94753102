# SPDX-License-Identifier: Apache-2.0
"""Names that nothing defines in files of Python 2, which linters for Python 3 cannot read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from haros_ci.api import Check, Finding, Level, Location, Project, listed
from haros_ci.api.code import LOADS, commented_blocks, parsed_of_any_version, switched_off, undefined_names

#: A file that lacks so many names lacks its imports: one cause.
MANY = 4


def check(project: Project) -> Iterator[Finding]:
    loads: dict[str | None, bool] = {}
    for file in project.workspace.files:
        if file.language != "python" or file.is_generated:
            continue
        found = parsed_of_any_version(project.text(file.path))
        if found is None or not found[2]:
            continue
        if file.package not in loads:
            loads[file.package] = any(
                LOADS.search(project.text(other_file.path))
                for other_file in project.workspace.files
                if other_file.package == file.package and other_file.language == "python"
            )
        if loads[file.package]:
            continue
        names = dict(undefined_names(found[0], found[1]))
        dead = switched_off(found[0]) if names else frozenset()
        blocks = commented_blocks(found[1], names) if names else {}
        groups: dict[tuple[int, str], list[str]] = {}
        is_unwritten = sum(line not in dead and name not in blocks for name, line in names.items()) >= MANY
        for name, line in names.items():
            is_alone = line in dead or (name not in blocks and not is_unwritten)
            groups.setdefault((0, name) if is_alone else (blocks.get(name, 0), ""), []).append(name)
        for (block, _), group in groups.items():
            yield _finding(file.path, {name: names[name] for name in group}, block, names[group[0]] in dead)


def _finding(path: str, names: Mapping[str, int], block: int, is_dead: bool) -> Finding:
    """One for all *names* that are made in one *block* of comments: it is brought back, or what uses them goes, too."""
    first = next(iter(names))
    if len(names) == 1:
        what, mend = f"{first} is not defined in this file: the line raises NameError", "import it, or correct the name"
    else:
        what, mend = f"{listed(list(names))} are not defined in this file: their lines raise NameError", "import them"
    if block:
        mend = f"what would define {'it' if len(names) == 1 else 'them'} is in a comment (line {block}): bring it back, or remove the use"
    if is_dead:
        what = f"{first} is not defined in this file: the line would raise NameError, but is never run"
    return Finding(
        at=Location(path, names[first]),
        message=f"{what}; {mend}",
        about=(path, *names),
        related=tuple((Location(path, line), f"uses {name}") for name, line in names.items() if name != first),
        apart=(path, *names),
        level=Level.NOTE if is_dead else Level.WARNING if block else None,
    )


CHECK = Check(
    id="undefined-name",
    summary="Undefined name in a file of Python 2.",
    level=Level.ERROR,
    tags=("code",),
    project=check,
)
