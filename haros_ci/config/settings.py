# SPDX-License-Identifier: Apache-2.0
"""The frozen settings of one run: what the command line and the project file together ask for."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from haros_ci.model.access import AccessRule
from haros_ci.model.declared_tool import DeclaredTool
from haros_ci.model.workspace import Buffer
from haros_ci.records import dataclass, field
from haros_ci.results.rule import Level

PROFILES = ("ros", "strict", "google", "bugs-only", "architecture", "all")


@dataclass(frozen=True, slots=True, kw_only=True)
class LinterSettings:
    """What a project says of one tool. ``enabled`` None means: as the tool's adapter has it (linters.linter.When).

    ``timeout`` is in seconds for one batch; ``arguments`` are passed on only under ``--trust-config``.
    """

    enabled: bool | None = None
    timeout: float | None = None
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Policy:
    """Selectors that choose rules: ids, ``tool:id``, ``tool``, globs of these, tags and aliases.

    The most specific selector that names a rule decides (the ranks stand in selector.py); between equals ``ignore``
    beats ``select``, and both beat the profile. ``levels`` maps selectors to levels, None is ``off``; the most
    specific match wins, between equals the last.
    """

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    levels: tuple[tuple[str, Level | None], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalPolicy:
    """A Policy and, if set, a profile for some of the files."""

    policy: Policy
    profile: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class PathPolicy(LocalPolicy):
    """For the files that match one of *globs* (``**`` crosses directories)."""

    globs: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PackagePolicy(LocalPolicy):
    """For the files of packages whose name matches one of *names* (globs)."""

    names: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Exemption:
    """Findings that the project accepts: those that match all keys of an exception.

    ``files`` are globs, ``packages`` globs of names, ``rules`` selectors, ``message`` a pattern of linear_regex.py that
    is searched for. ``origin`` is ``FILE:LINE`` and identifies the exemption.
    """

    files: tuple[str, ...] = ()
    packages: tuple[str, ...] = ()
    rules: tuple[str, ...] = ()
    message: str = ""
    reason: str = ""
    origin: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """Everything a run depends on besides the workspace's bytes.

    ``root`` is absolute; ``paths`` are POSIX-style, relative to it (``.`` is all of it). ``fail_on`` None never fails.
    ``baseline`` and ``compile_database`` are absolute or relative to ``root``, so ``root / value`` is right for both.
    ``exact`` asks libclang for what the model does not know. ``base`` is the merge base of HEAD and ``baseline_rev``, found once for the whole
    run: the top directory of the repository, and the name of the commit.
    ``base_missing`` says why the base revision that was asked for cannot be had, "" if it can or none was: then nothing that a change could
    have brought counts, neither project file nor settings of tools nor marker files.
    ``with_copies``: copies of public packages have findings, too; else only where there is something to compare with.
    ``require_baseline`` None: a baseline need not be asked for, but one that is asked for must be had; False: it need not be had either.
    ``project`` is the project file as plain data. ``packages`` are the packages to analyse, empty for all.
    ``ignore_files`` are HAROS patterns on ``<package>/<path in package>`` (``Selection.ignores_file`` matches them).
    ``plugins`` are modules, those of the command line and the environment before those that a trusted project file names;
    ``haros_plugins`` are those among them that are HAROS's (``haros_plugin_*``), which run only under ``trust_config``, through the two
    lists. ``plugin_export`` is the directory for the files that these export.
    ``declared`` are the tools that the project file declares, trusted or not: they run only under ``trust_config``.
    ``buffer`` is the file that the run is about, in place of ``paths``, as standard input has it.
    ``access`` are the rules of who may use which topics and services, each with its line in the project file.
    ``origins`` says where a value stands, ``FILE:LINE`` or
    ``command line``, by key (``fail-on``), ``selector <text>``, ``haros <text>`` (a selector of a HAROS ignore list) or
    ``linter <tool>``; what it does not name is a default.
    ``notes`` are sentences on how the configuration was read (what was accepted but has no effect, what differs at
    the head of a pull request), which the report repeats as notifications. ``is_measured`` says that an output wants all values of metrics,
    not only those beyond a limit.
    """

    root: Path
    paths: tuple[str, ...] = (".",)
    project_file: str | None = None
    project: dict[str, object] = field(default_factory=dict)
    profile: str = "ros"
    policy: Policy = Policy()
    command_line: Policy = Policy()
    per_package: tuple[PackagePolicy, ...] = ()
    per_path: tuple[PathPolicy, ...] = ()
    exemptions: tuple[Exemption, ...] = ()
    access: tuple[AccessRule, ...] = ()
    exclude: tuple[str, ...] = ()
    linters: tuple[tuple[str, LinterSettings], ...] = ()
    declared: tuple[DeclaredTool, ...] = ()
    linter_timeout: float = 600.0
    fail_on: Level | None = Level.WARNING
    jobs: int = 1
    max_file_size: int = 2_000_000
    compile_database: str | None = None
    exact: bool = False
    imports: tuple[str, ...] = ()
    baseline: str | None = None
    baseline_rev: str | None = None
    base: tuple[Path, str] | None = None
    base_missing: str = ""
    with_copies: bool = False
    require_baseline: bool | None = None
    allow_tool_failure: frozenset[str] = frozenset()
    trust_config: bool = False
    cache_dir: Path | None = None  # None: no cache on disk
    notes: tuple[str, ...] = ()
    packages: tuple[str, ...] = ()
    ignore_files: tuple[str, ...] = ()
    plugins: tuple[str, ...] = ()
    haros_plugins: tuple[str, ...] = ()
    plugin_whitelist: tuple[str, ...] = ()
    plugin_blacklist: tuple[str, ...] = ()
    plugin_export: str | None = None
    buffer: Buffer | None = None
    origins: tuple[tuple[str, str], ...] = ()
    is_measured: bool = False

    @property
    def without_base(self) -> str:
        """Why there is no base revision, and what is used instead of what it would say; "" where it is not missing."""
        if not self.base_missing:
            return ""
        return (
            f"{self.base_missing.rstrip('.')}. The defaults and the command line are used: the project file, the baseline file "
            "and the marker files of this checkout do not count, as the change may have brought them"
        )

    @property
    def local(self) -> tuple[LocalPolicy, ...]:
        """What holds for some of the files, the later before the earlier."""
        return (*self.per_package, *self.per_path)

    @property
    def policies(self) -> tuple[Policy, ...]:
        """Every policy, in the order of the layers."""
        return (self.policy, *(entry.policy for entry in self.local), self.command_line)

    @property
    def tools(self) -> tuple[DeclaredTool, ...]:
        """The declared tools that may run."""
        return self.declared if self.trust_config else ()

    @property
    def claims(self) -> Callable[[str], bool] | None:
        """Whether a declared tool is for the file at a path, whatever its kind; None where none says so."""
        tools = tuple(tool for tool in self.tools if tool.files)
        return (lambda path: any(tool.names(path) for tool in tools)) if tools else None
