# SPDX-License-Identifier: Apache-2.0
"""Launch files that commands on pages, in scripts and in images start (``ros2 launch demo all.py``), whatever they are called and wherever they lie."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.model.package import SourceFile
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

#: Languages of files that have commands for people and machines.
_COMMANDING = frozenset(("markdown", "shell", "dockerfile"))
#: The command with its first two words, options in between: a file, or a package and a file.
_COMMAND = regex(
    r"\b(?:roslaunch|ros2[ \t]{1,9}launch)(?:[ \t]{1,9}-[\w=-]{1,40}){0,9}[ \t]{1,9}[\"']?([^\s\"'`|;&<>()]{1,300})[\"']?(?:[ \t]{1,9}([^\s\"'`|;&<>()]{1,300}))?"
)
_ENDINGS = (".py", ".xml", ".launch", ".yaml", ".yml")


@dataclass(frozen=True, slots=True)
class Commanded:
    """Launch files that commands name: *in_packages* by package and name, *paths* as they are written; *ends* are what these may end with."""

    in_packages: frozenset[tuple[str, str]]
    paths: frozenset[str]
    ends: frozenset[str] = field(init=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "ends", frozenset(end for written in self.paths for end in _ends(written)))

    def names(self, file: SourceFile) -> bool:
        """Whether a command starts *file*: by its package and name, or by a path that may be its own."""
        if (file.package or "", file.path.rpartition("/")[2]) in self.in_packages:
            return True
        return file.path in self.ends or any(end in self.paths for end in _ends(file.path))


def _ends(path: str) -> Iterator[str]:
    """*path*, and the same without its first directories."""
    parts = path.split("/")
    return ("/".join(parts[number:]) for number in range(len(parts)))


def commanded(files: Iterable[SourceFile], text: Callable[[str], str]) -> Commanded:
    """The launch files that commands in *files* name; *text* is that of a file by its path."""
    in_packages: set[tuple[str, str]] = set()
    paths: set[str] = set()
    for file in files:
        if file.language not in _COMMANDING or file.third_party:
            continue
        for match in _COMMAND.finditer(text(file.path)):
            if match[1].endswith(_ENDINGS):
                paths.add(match[1].removeprefix("./"))
            elif match[2] and match[2].endswith(_ENDINGS):
                in_packages.add((match[1], match[2].rpartition("/")[2]))
    return Commanded(frozenset(in_packages), frozenset(paths))
