# SPDX-License-Identifier: Apache-2.0
"""Descriptions of what is simulated, expanded: what xacro makes of a file, a file, a text, a world, a model by its name."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping

from haros_ci.launch.facts.files import Finder
from haros_ci.model.build import Build
from haros_ci.model.environment import key_of
from haros_ci.model.location import Location
from haros_ci.model.named_distribution import MAX_PAGE, is_page, names_noetic
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.robot.commands import xacro_command
from haros_ci.robot.expand import expand
from haros_ci.robot.nodes import XmlNode
from haros_ci.robot.places import by_builds, found
from haros_ci.robot.sources import DescriptionSources
from haros_ci.robot.unknown import UnknownValue
from haros_ci.systems.simulation.stock import MODELS, WORLDS

MODEL = "model://"
PAGES = ("markdown", "shell", "dockerfile")
_EMPTY = Location(".")


@dataclass(frozen=True, slots=True)
class DescriptionTree:
    """A description; *root* is None where there is none, *reason* says why, or why it may not be all of it."""

    root: XmlNode | None
    reason: str = ""


@dataclass(slots=True)
class DescriptionTrees:
    """Reads descriptions of *workspace*, each once; *builds* say where installed files come from."""

    workspace: Workspace
    builds: Mapping[str, Build]
    _finder: Finder | None = field(default=None, init=False)
    _sources: DescriptionSources | None = field(default=None, init=False)
    _read: dict[tuple[object, ...], DescriptionTree] = field(default_factory=dict, init=False)
    _is_noetic: list[bool] = field(default_factory=list, init=False)
    _models: dict[str, list[str]] | None = field(default=None, init=False)

    @property
    def finder(self) -> Finder:
        if self._finder is None:
            self._finder = Finder(self.workspace, self.builds)
        return self._finder

    @property
    def sources(self) -> DescriptionSources:
        if self._sources is None:
            self._sources = DescriptionSources(self.workspace, by_builds(self.finder), self.finder.written)
        return self._sources

    def of_command(self, command: str, environment: Mapping[str, str]) -> DescriptionTree:
        """What a launch file's *command* prints in an *environment*, if it is xacro."""
        call = xacro_command(command)
        if call is None:
            if re.fullmatch(r"cat [^\s'\"]+|cat '[^']+'|cat \$\([\w-]+ [^\s)]+\)\S+", command.strip()):
                return self.of_file(command.strip()[4:].strip("'"))
            return DescriptionTree(None, f"what the command {command[:100]!r} prints is not known")
        path = found(self.finder, call.file).path
        if path is None:
            return DescriptionTree(None, f"{call.file} is not in the workspace")
        return self.of_xacro(path, call.arguments, environment)

    def of_xacro(
        self, path: str, arguments: Mapping[str, str | UnknownValue], environment: Mapping[str, str]
    ) -> DescriptionTree:
        """The file at *path* as xacro expands it."""
        provided = tuple(sorted((name, str(value)) for name, value in arguments.items()))
        key = (path, provided, key_of(environment))
        if key not in self._read:
            made = expand(
                self.sources,
                path,
                arguments,
                legacy=self._is_old(path),
                environment=environment,
                is_before_noetic=self._is_before_noetic,
            )
            why = "" if made.is_whole else f"a part of {path} includes, or depends on, what is not known"
            self._read[key] = DescriptionTree(made.root, why if made.root is not None else f"{path} could not be read")
        return self._read[key]

    def of_file(self, text: str) -> DescriptionTree:
        """The file that a launch file names *text*, as it is."""
        if "?" in text:
            return DescriptionTree(None, f"which file {text} is, is not known")
        path = found(self.finder, text).path if text.startswith("$(") else None
        if path is None:
            return DescriptionTree(None, f"{text or 'a file'} is not in the workspace")
        return self.of_path(path)

    def text_of(self, text: str) -> str:
        """What the file has that a launch file names *text*; "" if it is not in the workspace."""
        path = found(self.finder, text).path if text.startswith("$(") and "?" not in text else None
        return self.sources.text(path) if path is not None else ""

    def of_path(self, path: str) -> DescriptionTree:
        """The file at *path* as it is."""
        root = self.sources.read(path)
        return DescriptionTree(root, "" if root is not None else f"{path} is no XML, or could not be read")

    def of_text(self, text: str, location: Location) -> DescriptionTree:
        """A description that is written out."""
        key = ("text", text, location.path)
        if key not in self._read:
            root = self.sources.parsed(text, location.path)
            self._read[key] = DescriptionTree(root, "" if root is not None else "the description is no XML")
        return self._read[key]

    def of_world(self, text: str) -> DescriptionTree:
        """The world that a simulator is given on its command line; one of Gazebo's own has no plug-ins that make something in ROS."""
        if posixpath.basename(text) in WORLDS and (not text.startswith("$(") or "gazebo_ros)" in text):
            return DescriptionTree(XmlNode("sdf", {}, _EMPTY))
        return self.of_file(text) if text else DescriptionTree(XmlNode("sdf", {}, _EMPTY))

    def of_model(self, uri: str) -> DescriptionTree:
        """The model that an ``<include>`` names; of Gazebo's own models those are known that have no plug-ins."""
        if not uri.startswith(MODEL):
            if uri.startswith("file://"):
                return DescriptionTree(None, f"where {uri} is, is not known")
            return DescriptionTree(None, f"the model {uri or '?'} is not in the workspace")
        name = uri.removeprefix(MODEL).strip("/")
        places = [at for at in self._by_name().get(name.rpartition("/")[2], []) if f"/{at}".endswith(f"/{name}")]
        if len(places) == 1:
            return self._of_directory(places[0])
        if not places and name in MODELS:
            return DescriptionTree(XmlNode("sdf", {}, _EMPTY))
        if places:
            return DescriptionTree(None, f"there are several models called {name}: {', '.join(places[:3])}")
        return DescriptionTree(None, f"the model {name} is not in the workspace")

    def _by_name(self) -> dict[str, list[str]]:
        if self._models is None:
            self._models = {}
            for path in sorted(self.sources.names):
                if path.endswith("/model.config"):
                    folder = path.rpartition("/")[0]
                    self._models.setdefault(folder.rpartition("/")[2], []).append(folder)
        return self._models

    def _of_directory(self, folder: str) -> DescriptionTree:
        config = self.sources.read(f"{folder}/model.config")
        named = [] if config is None else list(config.all("sdf"))
        latest = max(named, key=lambda node: _version(node.given("version")), default=None)
        file = latest.text.strip() if latest is not None and isinstance(latest.text, str) else "model.sdf"
        return self.of_path(posixpath.normpath(f"{folder}/{file}"))

    def _is_before_noetic(self) -> bool | None:
        """Whether xacro takes macros without ``xacro:``, as nothing says that the workspace is for Noetic alone; None if something does."""
        if not self._is_noetic:
            pages = (file.path for file in self.workspace.files if file.language in PAGES and is_page(file.path))
            self._is_noetic = [names_noetic(self.workspace.text(path)[:MAX_PAGE] for path in pages)]
        return None if self._is_noetic[0] else True

    def _is_old(self, path: str) -> bool:
        around = (p for p in self.workspace.packages if p.path == "." or path.startswith(f"{p.path}/"))
        owner = max(around, key=lambda package: len(package.path), default=None)
        return owner is not None and owner.ros == 1


def _version(text: str | None) -> tuple[int, ...]:
    parts = (text or "").split(".")
    return tuple(int(part) for part in parts) if all(part.isdecimal() and len(part) < 6 for part in parts) else ()
