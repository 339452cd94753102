# SPDX-License-Identifier: Apache-2.0
"""The architectures of a run, made once or had from the cache; and what the checks see of one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from haros_ci.config.digests import settings_digests
from haros_ci.config.settings import Settings
from haros_ci.model.access import AccessRule
from haros_ci.model.element import Element
from haros_ci.model.workspace import Store, Workspace
from haros_ci.registry import Registry, registry
from haros_ci.timing import stage
from haros_ci.workspace.views import views

if TYPE_CHECKING:  # they are loaded where there is something to check
    from haros_ci.analysis.architecture import Common
    from haros_ci.analysis.architecture_codec import Lines
    from haros_ci.analysis.kept_architecture import KeptArchitectures
    from haros_ci.behaviour.declared import Stated
    from haros_ci.checking.cpp_texts import CppTexts
    from haros_ci.checking.project import Project
    from haros_ci.checking.system import System
    from haros_ci.code.codebase import Codebase
    from haros_ci.systems.link import Linked

#: A workspace in a run: its root, and which packages of it are seen.
_Key = tuple[Path, tuple[str, ...]]


def _key(workspace: Workspace) -> _Key:
    return workspace.root, tuple(package.path for package in workspace.packages)


class Architectures:
    """The architecture of each workspace of a run, made once: that of the base revision is asked for by both sides."""

    def __init__(self, settings: Settings, store: Store, known: Registry | None = None) -> None:
        self.settings = settings
        self.store = store
        self.registry = known or registry(settings)
        self._made: dict[_Key, Linked] = {}
        self._projects: dict[_Key, Project] = {}
        self._common: Common | None = None

    def under(self, store: Store) -> Architectures:
        """The same, what is made from now on kept in *store*; without a cache what the run has in memory counts on."""
        if self.settings.cache_dir is not None:
            self.store = store
        return self

    def project(self, workspace: Workspace) -> Project:
        """What the checks have seen of the workspace, or see of it, for who shows more of that."""
        if _key(workspace) not in self._projects:
            from haros_ci.checking.system import systems

            made = self.of(workspace)
            found = tuple(systems(made.architecture, workspace))
            where = self.settings.project_file or ""
            access = self.settings.access
            self._projects[_key(workspace)] = project_of(made, workspace, found, project_file=where, access=access)
        return self._projects[_key(workspace)]

    def seen(self, project: Project) -> Project:
        """Keep what the checks see."""
        self._projects[_key(project.workspace)] = project
        return project

    def kept(self, workspace: Workspace, base: Workspace | None = None, lines: Lines | None = None) -> Linked:
        """``of`` *workspace*, from the cache, which has it from then on: it is the base of a change, or will be.

        With *lines*, it is what the cache has of *base*, of which code has only moved to these.
        """
        key, kept = _key(workspace), self.keeping()
        if kept is None or key in self._made:
            return self.of(workspace)
        found = kept.get(workspace, lambda: self._linked(workspace), base or workspace, lines)
        if found is not None:
            self._made[key] = found
        elif not lines:  # the base's is the same
            kept.put(base or workspace, self.of(workspace).architecture)
        return self.of(workspace)

    def keeping(self) -> KeptArchitectures | None:
        """Where architectures are kept; nowhere where they depend on more than files and settings."""
        if self.settings.plugins or self.settings.exact or self.settings.cache_dir is None:
            return None
        with stage("loading"):
            from haros_ci.analysis.kept_architecture import KeptArchitectures

        return KeptArchitectures(options_of(self.settings, self.registry), self.store, self.settings.jobs)

    def has_made(self, workspace: Workspace) -> bool:
        """Whether the systems of *workspace* are there already."""
        return _key(workspace) in self._made

    def of(self, workspace: Workspace) -> Linked:
        with stage("loading"):
            from haros_ci.analysis.views import joined

        key = _key(workspace)
        if key not in self._made:
            parts = views(workspace)
            if parts[0].workspace is workspace:
                self._made[key] = self._linked(workspace)
            else:
                where = self.settings.project_file or "the project file"
                self._made[key] = joined(workspace, parts, [self.of(view.workspace) for view in parts], where)
        return self._made[key]

    def _linked(self, workspace: Workspace) -> Linked:
        with stage("loading"):
            from haros_ci.analysis.architecture import Common, varied

        if self._common is None:
            self._common = Common()
        settings = self.settings
        return varied(
            workspace, settings, self.store, exact=settings.exact, processes=settings.jobs, common=self._common
        )


def options_of(settings: Settings, known: Registry) -> str:
    """A digest of the settings that what is found in an architecture depends on."""
    return repr((settings.project_file, settings_digests(settings, known.components)))


def project_of(
    made: Linked,
    workspace: Workspace,
    systems: tuple[System, ...],
    base: Project | Callable[[], Project | None] | None = None,
    renames: Mapping[str, str] | None = None,
    *,
    project_file: str = "",
    stated: Sequence[Stated] | None = None,
    access: Sequence[AccessRule] = (),
    hidden: frozenset[str] = frozenset(),
    code: Callable[[], Codebase] | None = None,
    cpp_texts: CppTexts | None = None,
) -> Project:
    """What the checks of packages see, from what the architecture was *made* of; *base* is that of the base revision.

    *stated* are the properties that count in place of those of the project file, *code* is the call graph in place of that of all texts. Where files
    are *hidden*, their programs are refused (``checking.unseen``).
    """
    from haros_ci.analysis.comparison import revision_of
    from haros_ci.checking.project import Project
    from haros_ci.checking.unseen import NoRobots, PartPrograms
    from haros_ci.robot.descriptions import Descriptions
    from haros_ci.workspace.xml import XmlError, parse_xml

    def element(path: str) -> Element | None:
        try:
            return parse_xml(workspace.text(path).encode())
        except (XmlError, UnicodeEncodeError):
            return None

    def of_all() -> Codebase:
        from haros_ci.analysis.code_of import code_of

        with stage("call graph"):
            return code_of(made, workspace)

    programs = {source.path: source.program for source in made.sources}
    return Project(
        workspace,
        made.builds,
        PartPrograms(programs, hidden) if hidden else programs,
        systems,
        read_xml=element,
        base=base,
        renames=renames,
        revision=None if code else revision_of(workspace, made),
        robots=NoRobots() if code else Descriptions(workspace, made.builds),
        code=code or of_all,
        project_file=project_file,
        stated=stated,
        access=access,
        cpp_texts=cpp_texts,
    )
