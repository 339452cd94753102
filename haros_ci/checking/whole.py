# SPDX-License-Identifier: Apache-2.0
"""What all systems of an architecture, and the workspace that they are of, say together: gathered once, for every check."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from haros_ci.interfaces.sums import SumsOfMessages
from haros_ci.model.launch_facts import ArgumentDeclaration, ConstructUse, IncludeUse, ParameterFileUse
from haros_ci.model.location import Location
from haros_ci.regex import regex

if TYPE_CHECKING:
    from haros_ci.checking.launch_readers import LaunchReaders
    from haros_ci.checking.system import System
    from haros_ci.model.package import Package
    from haros_ci.model.workspace import Workspace

#: How the names of source files end, and the files of these that run no node.
CODE = (".cpp", ".hpp", ".cc", ".cxx", ".h", ".hh", ".hxx", ".ipp", ".py")
_OTHER = regex(r"launch[^/]*$|(^|/)tests?/|(^|/)(test_[^/]*|[^/]*_test)\.\w+$")
#: How the names of launch files end, and of those that are not in XML.
LAUNCH_FILES = (".launch", *(f"{sign}launch{end}" for sign in "._" for end in (".xml", ".py", ".yaml", ".yml")))
NOT_XML = (".py", ".yaml", ".yml")
_STARTS = regex(r"<(?:node|include|let|group|executable)\b")
#: Lines that an include's tag with its file takes.
_OF_INCLUDE = 4
_FILE = regex(r"""<include\b[^<>]*?\bfile\s*=\s*["']([^"']*)""")
_SUBSTITUTION = regex(r"(?:\$\((?:arg|var|env|optenv|eval)\s[^()]*\))+|\*+")
#: Where a package is: its name counts only if it is chosen, too, and is taken for that of its directory.
_PACKAGE = regex(r"\$\((?:find|find-pkg-share)\s+(?:([\w-]*\*[\w*-]*)|[\w-]+)\)")
_LITERAL = regex(r"[\w-]{2}")
#: A path has so many chosen parts at most.
_MAX_SIGNS = 4
#: A launch file with so many includes passes the same with all of them.
_SEVERAL = 3
#: Where commands stand that people and scripts start launch files with, and an argument that one gives.
_SHOWING = (".md", ".rst", ".txt", ".sh", ".bash", ".yml", ".yaml", "dockerfile", "makefile")
_READ = (".md", ".rst", ".sh", ".bash")
_LAUNCHED = regex(r"(?<![\w-])[\w-]+(?:[._]launch(?:\.(?:xml|py|ya?ml))?|\.test)\b")
_URL = regex(r"(?:\b(?:https?|ssh|git)://|\bgit@)[^\s\"'`()\[\]<>,;#]{1,300}")
_SHOWN = regex(r"(?<![\w-])([\w-]+):=")


def repositories_named(workspace: Workspace) -> frozenset[str]:
    """The names of repositories that pages and scripts of *workspace* tell to clone."""
    endings = (*_SHOWING, ".repos", ".rosinstall")
    texts = (workspace.text(path) for path in sorted(workspace.names) if path.lower().endswith(endings))
    parts = (url.rstrip("/.").split("/") for text in texts for url in _URL.findall(text))
    return frozenset(name.removesuffix(".git") for part in parts for name in (*part[4:5], part[-1]))


class PackageTables:
    """The packages of an architecture by their names, and by their root-relative directories."""

    def __init__(self, packages: Iterable[Package]) -> None:
        self.by_name: Mapping[str, Package] = {package.name: package for package in packages}
        self.by_path: Mapping[str, Package] = {package.path: package for package in self.by_name.values()}


class Whole:
    """All *systems* of an architecture: what is said of a file that several use has to hold in all of them."""

    def __init__(self, systems: Sequence[System]) -> None:
        self.systems = systems
        self._sources: dict[str, tuple[str, ...]] = {}

    @cached_property
    def taken(self) -> frozenset[tuple[Location, str]]:
        """The places and keys that give something which some node has, or may have."""
        return frozenset(place for system in self.systems for place in system.taken)

    @cached_property
    def sums(self) -> SumsOfMessages:
        """The MD5 sums of messages of ROS 1."""
        first = self.systems[0] if self.systems else None
        return SumsOfMessages(first.workspace, first.packages) if first is not None else SumsOfMessages(None, {})

    @cached_property
    def dependencies(self) -> frozenset[str]:
        """The names of packages and keys of rosdep that any manifest of the workspace declares."""
        packages = self.systems[0].packages.values() if self.systems else ()
        return frozenset(dependency.name for package in packages for dependency in package.dependencies)

    @cached_property
    def declared(self) -> Mapping[str, frozenset[str]]:
        """The names of parameters that any node is seen to declare, with the files that do."""
        found: dict[str, set[str]] = {}
        for system in self.systems:
            for node in system.nodes:
                for key, ends in node.names.declared.items():
                    found.setdefault(key, set()).update(end.location.path for end in ends if end.in_source)
        return {key: frozenset(paths) for key, paths in found.items()}

    @cached_property
    def parameter_files(self) -> Mapping[str, tuple[ParameterFileUse, ...]]:
        """All uses of the parameter files that are known, by path."""
        found: dict[str, list[ParameterFileUse]] = {}
        for system in self.systems:
            for use in system.facts(ParameterFileUse):
                if use.path is not None:
                    found.setdefault(use.path, []).append(use)
        return {path: tuple(uses) for path, uses in found.items()}

    @cached_property
    def used_arguments(self) -> frozenset[tuple[str, str]]:
        """The launch arguments that some file declares and uses, each with the directory of the file."""
        every = (fact for system in self.systems for fact in system.facts(ArgumentDeclaration) if fact.is_used)
        return frozenset((fact.location.path.rpartition("/")[0], fact.name) for fact in every)

    @cached_property
    def passed_arguments(self) -> frozenset[tuple[str, str]]:
        """The launch arguments that includes pass, each with the file's path, or its name alone where the path is not known.

        Of an include of which not even the name is known it is "": it may be any file.
        """
        every = (
            (use, passed.name) for system in self.systems for use in system.facts(IncludeUse) for passed in use.passed
        )
        return frozenset((use.path or _file_name(use.text), name) for use, name in every)

    @cached_property
    def passed_for_nothing(self) -> Mapping[tuple[str, str], tuple[Location, ...]]:
        """The arguments that includes pass to files which neither declare nor read them, by the file's path and the name; where, in order."""
        found: dict[tuple[str, str], set[Location]] = {}
        for system in self.systems:
            for use in system.facts(IncludeUse):
                if not use.is_whole or use.location.path in system.refused:
                    continue
                for passed in use.passed:
                    if passed.name not in use.declared and passed.name not in use.read:
                        found.setdefault((use.path or "", passed.name), set()).add(passed.location)
        places = {
            key: sorted(item, key=lambda at: (at.path, at.line or 0, at.column or 0)) for key, item in found.items()
        }
        return {key: tuple(place) for key, place in places.items()}

    @cached_property
    def passed_with_all(self) -> Mapping[tuple[str, str], tuple[tuple[str, Location], ...]]:
        """Arguments that a launch file of ROS 2 passes with every include (of three or more), by its path and the name: the files that do not know them, and where."""
        includes: dict[str, dict[Location, set[str]]] = {}
        for system in self.systems:
            for use in system.facts(IncludeUse):
                names = includes.setdefault(use.location.path, {}).setdefault(use.location, set())
                names.update(passed.name for passed in use.passed if use.ros == 2)
        found: dict[tuple[str, str], list[tuple[str, Location]]] = {}
        for (path, name), places in self.passed_for_nothing.items():
            every = includes.get(places[0].path, {}).values()
            if len(every) >= _SEVERAL and all(name in names for names in every):
                found.setdefault((places[0].path, name), []).append((path, places[0]))
        order = {
            key: sorted(item, key=lambda one: (one[1].line or 0, one[1].column or 0, one[0]))
            for key, item in found.items()
        }
        return {key: tuple(item) for key, item in order.items() if len(item) > 1}

    @cached_property
    def chosen_files(self) -> tuple[tuple[re.Pattern[str], frozenset[str]], ...]:
        """Patterns of the paths of launch files that an include chooses by an argument, with what it passes.

        ``slam_$(arg method).launch``, ``$(arg robot)_config/launch/start.launch``
        """
        found: dict[str, set[str]] = {}
        names: dict[Location, str] = {}
        for system in self.systems:
            for use in system.facts(IncludeUse):
                if use.location not in names:
                    names[use.location] = _chosen(system, use)
                if written := names[use.location]:
                    found.setdefault(written, set()).update(passed.name for passed in use.passed)
        return tuple((re.compile(written), frozenset(passed)) for written, passed in sorted(found.items()))

    @cached_property
    def foreign_constructs(self) -> Mapping[str, tuple[ConstructUse, ...]]:
        """The constructs of another ROS version that launch files have, by the file."""
        found: dict[str, dict[ConstructUse, None]] = {}
        for system in self.systems:
            for use in system.facts(ConstructUse):
                if use.kind == "foreign":
                    found.setdefault(use.location.path, {})[use] = None
        return {path: tuple(uses) for path, uses in found.items()}

    @cached_property
    def files_by_name(self) -> Mapping[str, tuple[str, ...]]:
        """The files of the workspace by the last part of their paths."""
        found: dict[str, list[str]] = {}
        for path in self._paths:
            found.setdefault(path.rpartition("/")[2], []).append(path)
        return {name: tuple(paths) for name, paths in found.items()}

    @cached_property
    def launch_files(self) -> tuple[str, ...]:
        """The launch files of the workspace, by their names; of those in XML only such that start, include or set something."""
        paths = (path for path in self._paths if path.endswith(LAUNCH_FILES))
        return tuple(path for path in paths if path.endswith(NOT_XML) or _STARTS.search(self._text(path)))

    def is_shown(self, argument: str, path: str, ros: int) -> bool:
        """Whether a page or a script of the workspace, or the launch file at *path*, shows a command that gives the launch *argument*.

        With ROS 1 a command gives it to the launch file that it names, and to those that this one passes it to; with ROS 2 all that are included have it.
        """
        if argument in _SHOWN.findall(self._text(path)):
            return True
        names = self._shown.get(argument, frozenset())
        if ros == 2 or not names.isdisjoint(("", path.rpartition("/")[2])):
            return bool(names)
        return any(self._may_pass(name, argument) for name in names)

    def _may_pass(self, name: str, argument: str) -> bool:
        """Whether a launch file of ROS 1 that is called *name* may pass the *argument* on: it says so, or is not in the workspace."""
        named = rf"""\bname\s{{0,9}}=\s{{0,9}}["']{re.escape(argument)}["']"""
        given = re.compile(rf"pass_all_args|<arg\s(?=[^<>]{{0,300}}{named})(?=[^<>]{{0,300}}\bvalue\s{{0,9}}=)")
        texts = [self._text(path) for path in self._paths if path.rpartition("/")[2] == name]
        return not texts or any(given.search(text) for text in texts)

    def is_of_others(self, path: str) -> bool:
        """Whether the first comment of the launch file at *path* has the copyright of somebody whom no manifest of the workspace names."""
        from haros_ci.checking.foreign_heads import is_of_others

        return is_of_others(self._text(path), self._people)

    @cached_property
    def _people(self) -> frozenset[str]:
        """The words of all manifests: who has written and who maintains what."""
        from haros_ci.model.copyright_owners import words

        manifests = (path for path in self._paths if path.rpartition("/")[2] == "package.xml")
        return frozenset(word for path in manifests for word in words(self._text(path)))

    @cached_property
    def _shown(self) -> Mapping[str, frozenset[str]]:
        """The launch arguments that pages and scripts of the workspace give (``rate`` of ``rate:=10``), with the launch files in the same command, "" where
        there is none.
        """
        found: dict[str, set[str]] = {}
        for path in self._paths:
            text = self._text(path) if path.lower().endswith(_SHOWING) else ""
            for line in text.replace("\\\n", " ").splitlines() if ":=" in text else ():
                for name in _SHOWN.findall(line):
                    found.setdefault(name, set()).update(_LAUNCHED.findall(line) or ("",))
        return {name: frozenset(files) for name, files in found.items()}

    def is_named(self, path: str) -> bool:
        """Whether a page or a script of the workspace has the name of the launch file at *path*: then people start it."""
        return path.rpartition("/")[2] in self._named

    @cached_property
    def _named(self) -> frozenset[str]:
        """The names of launch files in pages and scripts, those of CMake aside."""
        texts = (self._text(path) for path in self._paths if path.lower().endswith(_READ))
        return frozenset(name for text in texts for name in _LAUNCHED.findall(text))

    @cached_property
    def launch_readers(self) -> LaunchReaders:
        """What code of the workspace reads of launch files that it loads itself."""
        from haros_ci.checking.launch_readers import launch_readers

        return launch_readers(self._workspace)

    @cached_property
    def repositories(self) -> frozenset[str]:
        """The names of repositories that pages and scripts of the workspace tell to clone."""
        return repositories_named(self._workspace) if self._workspace is not None else frozenset()

    @cached_property
    def _workspace(self) -> Workspace | None:
        return next((system.workspace for system in self.systems if system.workspace is not None), None)

    @cached_property
    def _paths(self) -> tuple[str, ...]:
        return tuple(sorted(self._workspace.names)) if self._workspace is not None else ()

    def _text(self, path: str) -> str:
        return self._workspace.text(path) if self._workspace is not None else ""

    @cached_property
    def yaml_readers(self) -> tuple[tuple[bool, str], ...]:
        """The texts of files that load YAML themselves (haros_ci/checking/yaml_readers.py)."""
        from haros_ci.checking.yaml_readers import readers

        return readers(self.systems[0]) if self.systems else ()

    @cached_property
    def names(self) -> Mapping[str, frozenset[str]]:
        """The last parts of the names that the nodes of a program have, by ``package/executable``."""
        found: dict[str, set[str]] = {}
        for system in self.systems:
            for node in system.nodes:
                found.setdefault(node.type, set()).add(node.name.rpartition("/")[2])
        return {program: frozenset(names) for program, names in found.items()}

    def sources(self, folder: str, system: System) -> tuple[str, ...]:
        """The texts of the C++ and Python files below *folder* that are no launch files."""
        if folder not in self._sources and system.workspace is not None:
            files = [file.path for file in system.workspace.files if is_in(file.path, folder)]
            names = [path for path in files if path.endswith(CODE) and not _OTHER.search(path)]
            self._sources[folder] = tuple(map(system.workspace.text, names))
        return self._sources.get(folder, ())


def _chosen(system: System, use: IncludeUse) -> str:
    """A pattern of the paths that the file of an include in XML can have, by their ends; "" if it has but one."""
    if system.workspace is None or not use.location.line or use.location.path.endswith(NOT_XML):
        return ""
    lines = system.workspace.text(use.location.path).split("\n")[use.location.line - 1 :][:_OF_INCLUDE]
    written = _FILE.search("\n".join(lines))
    text = _SUBSTITUTION.sub("*", written[1]) if written is not None else ""
    parts = _PACKAGE.sub(lambda found: found[1] or "", text).rpartition("../")[2].split("/")
    while parts and not _LITERAL.search(parts[0]):
        parts.pop(0)  # a package, or a directory of which nothing is known
    signs = [part.count("*") for part in parts]
    name = parts[-1] if parts else ""
    if not any(signs) or sum(signs) > _MAX_SIGNS or "$" in "".join(parts) or len(name.replace("*", "")) <= len(".xml"):
        return ""
    return "(?:.*/)?" + "/".join(r"[\w.-]+".join(map(re.escape, part.split("*"))) for part in parts)


def _file_name(text: str) -> str:
    """The name of the file that an include names; "" if a part of it is not known."""
    last = text.rpartition("/")[2]
    return "" if any(sign in last for sign in "?$(*") else last


def is_in(path: str, folder: str) -> bool:
    """Whether the file at *path* lies in the directory *folder* or below; "" and "." are the root."""
    return folder in ("", ".") or path.startswith(f"{folder}/")
