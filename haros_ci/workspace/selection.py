# SPDX-License-Identifier: Apache-2.0
"""Which of a tree's paths are analysed: pure decisions on names, the same on disk and in a revision."""

from __future__ import annotations

from collections.abc import Callable, Collection, Container, Iterable, Iterator, Mapping
from typing import Protocol

from haros_ci.model.package import OTHER
from haros_ci.records import dataclass
from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.language import describes, language_of, sets_environment

Also = Callable[[str], bool]

#: Files that keep build tools out of a directory: colcon-core, ament_package, catkin_pkg.
IGNORE_MARKERS = frozenset(("COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"))

#: Files that colcon, catkin_make and catkin_tools leave at the top of a build, install or devel tree.
OUTPUT_MARKERS = frozenset((".colcon_install_layout", ".catkin", ".built_by", "pyvenv.cfg"))
_OTHER_MARKERS = frozenset(
    ("setup.bash", "local_setup.bash", "CMakeCache.txt", "CMakeLists.txt", "package.xml", ".catkin_workspace")
)
#: Those without which a directory that holds others counts as output.
IGNORED_WITHOUT = frozenset(("CMakeLists.txt", "package.xml"))
MARKERS = IGNORE_MARKERS | OUTPUT_MARKERS | _OTHER_MARKERS

#: What stands beside ``src`` in a workspace that was built.
OUTPUT_NAMES = frozenset(("build", "install", "devel", "log", "logs"))

_NOT_SOURCE = frozenset(("node_modules", "__pycache__"))


@dataclass(frozen=True, slots=True)
class AnalysedPaths:
    """What a run is about, relative to the root: directories to enter, whatever covers them, and single files.

    ``named`` is False where the directory is only the default.
    """

    directories: tuple[str, ...]
    files: tuple[str, ...] = ()
    named: bool = True

    def given(self, path: str) -> str | None:
        """The innermost given directory that *path* lies in."""
        while True:
            if path in self.directories:
                return path
            if path == ".":
                return None
            path = path.rpartition("/")[0] or "."


class MarkersAtBase(Protocol):
    """What a change cannot alter about markers: its base revision has the paths *base*, git tracks the paths *tracked* now."""

    @property
    def base(self) -> Mapping[str, str]: ...

    @property
    def tracked(self) -> Container[str]: ...

    def counts(self, path: str) -> bool:
        """Whether the marker at *path*, which is there now, may hide something."""
        ...


@dataclass(frozen=True, slots=True)
class CandidatePath:
    """A path to read; *language* is None where only the first line of the file shows whether it is a script, *fallback* is its language if it is not."""

    path: str
    language: str | None
    fallback: str | None = None


def is_output(names: set[str]) -> bool:
    """Whether a directory that holds *names* is no source: marked as ignored, built, installed or a virtual environment."""
    if names & IGNORE_MARKERS or names & OUTPUT_MARKERS:
        return True
    if "CMakeCache.txt" in names and "CMakeLists.txt" not in names:  # else CMake was run inside the source
        return True
    return {"setup.bash", "local_setup.bash"} <= names and "package.xml" not in names


def is_never_source(name: str) -> bool:
    """Whether a directory's name alone says that it belongs to a tool. Hidden ones do."""
    return name.startswith(".") or name in _NOT_SOURCE or name.endswith(".egg-info")


def select(
    paths: Iterable[str],
    scope: AnalysedPaths,
    excludes: Excludes,
    also: Also | None = None,
    standing: MarkersAtBase | None = None,
) -> list[CandidatePath]:
    """The analysed ones of *paths* (a whole listing, as it carries the markers), sorted.

    *also* tells of which paths the files are read whatever their kind. With *standing* a change hides nothing by the markers that
    it adds or removes.
    """
    listing = sorted(set(paths))
    outputs = output_directories(listing, standing)
    named = frozenset(scope.files)
    kept = dict.fromkeys((".", *scope.directories), True)  # given directories are entered whatever covers them

    def is_kept(directory: str) -> bool:
        chain = []
        while directory not in kept:
            chain.append(directory)
            directory = directory.rpartition("/")[0] or "."
        verdict = kept[directory]
        for directory in reversed(chain):
            name = directory.rpartition("/")[2]
            verdict = verdict and not is_never_source(name) and directory not in outputs
            verdict = verdict and not excludes.match(directory, is_directory=True)
            kept[directory] = verdict
        return verdict

    chosen = []
    within: dict[str, bool] = {}
    for path in listing:
        directory, _, name = path.rpartition("/")
        directory = directory or "."
        if directory not in within:
            within[directory] = scope.given(directory) is not None
        if (within[directory] or path in named) and is_kept(directory) and not excludes.match(path, is_directory=False):
            language = language_of(name)
            is_read = sets_environment(name) or describes(name) or (also is not None and also(path))
            fallback = OTHER if language is None and is_read else None
            chosen.append(CandidatePath(path, language, fallback))
    return chosen


def _marked(listing: Iterable[str], standing: MarkersAtBase | None) -> dict[str, set[str]]:
    """The names of the marker files that count, by their directory."""
    marked: dict[str, set[str]] = {}

    def mark(paths: Iterable[str], counts: Callable[[str, str], bool]) -> None:
        for path in paths:
            directory, _, name = path.rpartition("/")
            if counts(name, path):
                marked.setdefault(directory or ".", set()).add(name)

    if standing is None:
        mark(listing, lambda name, path: name in MARKERS)
        return marked
    mark(listing, lambda name, path: name in MARKERS and (name in IGNORED_WITHOUT or standing.counts(path)))
    mark(standing.base, lambda name, path: name in IGNORED_WITHOUT)
    return marked


def output_directories(listing: Collection[str], standing: MarkersAtBase | None = None) -> frozenset[str]:
    """The directories that is_output tells, and their unmarked neighbours in a built workspace.

    With *standing*, only by markers that count, and not for the lack of what the base revision has.
    """
    marked = _marked(listing, standing)
    stood: Collection[str] = listing
    if standing is not None:
        stood = [*standing.base, *(path for path in listing if path not in standing.tracked)]
    outputs = {directory for directory, names in marked.items() if is_output(names)}
    roots = {directory for directory, names in marked.items() if ".catkin_workspace" in names}
    for directory in outputs:
        parent, _, name = directory.rpartition("/")
        if name in OUTPUT_NAMES and "package.xml" not in marked.get(parent or ".", ()):
            roots.add(parent or ".")
    for root in roots:
        prefix = "" if root == "." else f"{root}/"
        if any(path.startswith(f"{prefix}src/") for path in stood):
            outputs.update(prefix + name for name in OUTPUT_NAMES)
    return frozenset(outputs)


def parents(path: str) -> Iterator[str]:
    """The directories above a root-relative *path*, the innermost first, without the root."""
    while "/" in path:
        path = path.rpartition("/")[0]
        yield path
