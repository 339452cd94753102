# SPDX-License-Identifier: Apache-2.0
"""From the project file and the command line to Settings: which file counts, and which value wins."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

from haros_ci.config.settings import PROFILES, Policy, Settings
from haros_ci.config.suggestion import quoted, suggestion
from haros_ci.errors import UserError
from haros_ci.model import globs
from haros_ci.records import dataclass
from haros_ci.results.rule import Level

#: In one directory the first of these counts; see docs/configuration.md.
FILE_NAMES = (".haros-ci.yaml", "haros.yaml")

Read = Callable[[Path], bytes | None]


class BaseSettings(Protocol):
    """The base revision of a change (``workspace.base_commit.BaseCommit``)."""

    def holds(self, path: Path) -> bool:
        """Whether a change could bring the file at *path*, absolute."""
        ...

    def read(self, path: Path) -> bytes | None:
        """Such a file as it is in the base revision, None if it is not there."""
        ...


@dataclass(frozen=True, slots=True)
class ProjectFile:
    """A project file: the *name* messages give it, and its bytes."""

    name: str
    data: bytes


def load(
    root: Path,
    *,
    start: Path | None = None,
    project: Path | None = None,
    isolated: bool = False,
    base: BaseSettings | None = None,
    base_missing: str = "",
    trust_config: bool = False,
    command_line: Mapping[str, Any] | None = None,
) -> Settings:
    """The settings of a run on the workspace at *root* (absolute); UserError for the user's mistakes.

    The project file is *project*, or else the first of FILE_NAMES in *start* (default: the root) or a directory above
    it, up to the root; one file, never merged with another. *isolated* reads none. With *base* a file that a change could
    bring is read from there, without it from disk. *base_missing* says why a base that was asked for cannot be had: then no file below the
    root counts.

    *command_line* holds flags by their Python name, those not given None or empty; keys that are no setting are passed
    over. Its values beat per-path ones, those the file's, and those the profile; ``exclude`` and ``plugins`` add up.
    """
    settings = Settings(root=root, trust_config=trust_config, base_missing=base_missing)
    if isolated and project is not None:
        raise UserError("--isolated and --project exclude each other", help="leave one of them out")
    if not isolated:
        found, notes = _find(
            root, start or root, project, _BaseFiles(root, base, base_missing) if base or base_missing else None
        )
        if found is not None:
            from haros_ci.config.project import read_project

            parsed = read_project(found.data, found.name, trust_config=trust_config)
            settings = replace(settings, **parsed.values, project_file=found.name, origins=parsed.origins)
            notes = (*notes, *parsed.notes)
        settings = replace(settings, notes=notes)
    return _with_flags(settings, command_line or {})


@dataclass(frozen=True, slots=True)
class _BaseFiles:
    """Where project files are read that a change could bring; *missing* says why they cannot be."""

    root: Path
    base: BaseSettings | None
    missing: str

    def holds(self, path: Path) -> bool:
        """Whether the file at *path*, absolute, is not to be read from disk."""
        return path.is_relative_to(self.root) if self.base is None else self.base.holds(path)

    def read(self, path: Path) -> bytes | None:
        """The bytes of the file at *path* in the revision that settings are read from; None if there is no such file."""
        if not self.holds(path):
            return _from_disk(path, self.root)
        return None if self.base is None else self.base.read(path)

    def difference(self, base: ProjectFile | None, head: ProjectFile | None) -> tuple[str, ...]:
        """What a change does to the settings takes effect once it is in the base revision, and is said until then."""
        if base == head:
            return ()
        if base is None:
            assert head is not None
            if self.missing:
                return (f"{head.name} does not count: it cannot be compared with that of the base revision",)
            return (f"{head.name} is not in the base revision: it has no effect until it is",)
        if head is None:
            return (f"{base.name} is removed here; this run still uses the base revision's",)
        return (f"{head.name} differs from the base revision's {base.name}, which this run uses",)


def _find(
    root: Path, start: Path, project: Path | None, past: _BaseFiles | None
) -> tuple[ProjectFile | None, tuple[str, ...]]:
    """The project file that counts, and what is to be said of the choice."""
    if project is not None:
        return _named(root, project, past)
    if past is None:
        return _discover(root, start, lambda path: _from_disk(path, root)), ()
    base = _discover(root, start, past.read)
    try:
        head = _discover(root, start, lambda path: _from_disk(path, root))
    except UserError:  # the head's file is not used, so what is wrong with it matters only as a difference
        head = ProjectFile("the project file", b"")
    return base, past.difference(base, head)


def _named(root: Path, project: Path, past: _BaseFiles | None) -> tuple[ProjectFile | None, tuple[str, ...]]:
    path = Path(os.path.abspath(project))
    name = path.relative_to(root).as_posix() if path.is_relative_to(root) else str(project)
    here = _from_disk(path)
    head = None if here is None else ProjectFile(name, here)
    base = head
    if past is not None and past.holds(path):
        data = past.read(path)
        base = None if data is None else ProjectFile(name, data)
    if base is None and head is None:
        raise UserError(f"{project}: no such project file", help="give --project the path of a YAML file")
    return base, past.difference(base, head) if past else ()


def _discover(root: Path, start: Path, read: Read) -> ProjectFile | None:
    directories = [start, *start.parents] if start.is_relative_to(root) else [root]
    for directory in directories:
        for name in FILE_NAMES:
            data = read(directory / name)
            if data is not None:
                return ProjectFile((directory / name).relative_to(root).as_posix(), data)
        if directory == root:
            break
    return None


def _from_disk(path: Path, root: Path | None = None) -> bytes | None:
    """The bytes of a regular file, None if there is none; UserError if it leads out of *root* or cannot be read.

    Reads one byte more than a project file may have, so that the parser can refuse it.
    """
    try:
        if not path.is_file():
            return None
        if root is not None and not path.resolve().is_relative_to(root.resolve()):
            raise UserError(
                f"{path.relative_to(root).as_posix()}: a symbolic link out of the workspace",
                help="name the file with --project if you mean it, or use --isolated",
            )
        from haros_ci.config.yaml_lines import MAX_BYTES

        with path.open("rb") as stream:
            return stream.read(MAX_BYTES + 1)
    except OSError as err:
        raise UserError(f"{path.name}: cannot be read: {err.strerror}", help="check its permissions") from err


def _with_flags(settings: Settings, flags: Mapping[str, Any]) -> Settings:  # noqa: C901 - one branch for each option
    """*settings* with what the command line says."""
    changes: dict[str, Any] = {}
    if profile := flags.get("profile"):
        changes["profile"] = _choice("--profile", profile, PROFILES)
        changes["per_package"] = tuple(replace(entry, profile=None) for entry in settings.per_package)
        changes["per_path"] = tuple(replace(entry, profile=None) for entry in settings.per_path)
    if fail_on := flags.get("fail_on"):
        word = _choice("--fail-on", fail_on, ("error", "warning", "note", "never"))
        changes["fail_on"] = None if word == "never" else Level(word)
    policy = Policy(select=_words(flags.get("select")), ignore=_words(flags.get("ignore")))
    if policy != Policy():
        changes["command_line"] = policy
    if exclude := _words(flags.get("exclude")):
        for glob in exclude:
            if fault := globs.fault(glob):
                raise UserError(f"--exclude {quoted(glob)}: {fault}", help="write it like 'src/third_party/**'")
        changes["exclude"] = tuple(dict.fromkeys((*settings.exclude, *exclude)))
    for name in ("compile_database", "baseline"):
        if flags.get(name):
            changes[name] = _below(settings.root, flags[name])
    if flags.get("no_baseline") and "baseline" not in changes:
        changes["baseline"] = None
    if flags.get("require_baseline") is not None:
        changes["require_baseline"] = flags["require_baseline"]
    for name in ("baseline_rev", "exact", "jobs", "cache_dir"):
        if flags.get(name):
            changes[name] = flags[name]
    changes |= _plugins(settings, flags)
    for name in ("imports", "paths"):
        if flags.get(name):
            changes[name] = tuple(flags[name])
    if forgiven := _words(flags.get("allow_tool_failure")):
        changes["allow_tool_failure"] = frozenset(forgiven)

    origins = {
        name.replace("_", "-"): "command line"
        for name in changes
        if name not in ("per_package", "per_path", "command_line")
    }
    return replace(settings, **changes, origins=tuple(sorted({**dict(settings.origins), **origins}.items())))


def _plugins(settings: Settings, flags: Mapping[str, Any]) -> dict[str, Any]:
    """The plug-ins whose code runs: those of haros-ci's API, and those of HAROS, which are recognised by their names."""
    named = tuple(dict.fromkeys((*_words(flags.get("plugins")), *settings.plugins)))
    of_haros = tuple(name for name in named if name.startswith("haros_plugin_"))
    changes: dict[str, Any] = {}
    if named != settings.plugins or of_haros:
        changes["plugins"] = tuple(name for name in named if name not in of_haros)
        changes["haros_plugins"] = of_haros
    for name in ("plugin_whitelist", "plugin_blacklist"):
        if words := _words(flags.get(name)):
            changes[name] = tuple(dict.fromkeys(words))
    if flags.get("plugin_export"):
        changes["plugin_export"] = os.path.abspath(flags["plugin_export"])
    if (of_haros or changes.get("plugin_whitelist")) and not settings.trust_config:
        text = "HAROS plug-ins do not run without --trust-config: they open the workspace's files with code that is not haros-ci's"
        changes["notes"] = (*settings.notes, text)
    return changes


def _words(provided: Iterable[Any] | str | None) -> tuple[str, ...]:
    """A repeatable flag of comma-separated words, each group of words a tuple or a string."""
    groups = (provided,) if isinstance(provided, str) else provided or ()
    return tuple(w for group in groups for w in ((group,) if isinstance(group, str) else tuple(group)) if w)


def _choice(flag: str, word: str, known: tuple[str, ...]) -> str:
    if word not in known:
        raise UserError(f"{flag}: unknown value {quoted(word)}", help=suggestion(word, known))
    return word


def _below(root: Path, value: str | Path) -> str:
    """A path of the command line as Settings holds it: relative to the root if it lies below, else absolute."""
    path = Path(os.path.abspath(value))
    return path.relative_to(root).as_posix() if path.is_relative_to(root) else str(path)
