# SPDX-License-Identifier: Apache-2.0
"""How many of the call sites of ROS APIs in a workspace's code the model accounts for, and which it does not."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from haros_ci.analysis.architecture import api_rows, plugin_rows
from haros_ci.code.codebase import Codebase, Routine, codebase
from haros_ci.config.settings import Settings
from haros_ci.coverage import judge
from haros_ci.coverage.blanked import blanked
from haros_ci.coverage.judge import Found, Places, Syntax
from haros_ci.coverage.names import Names, joined, names_of
from haros_ci.coverage.pieces import Piece, at, last_name, pieces_of
from haros_ci.coverage.reach import Reach, reach_of
from haros_ci.coverage.search import shown
from haros_ci.index.index import HEADERS, is_test
from haros_ci.model.api import Row
from haros_ci.model.architecture import Architecture, Node
from haros_ci.model.build import Build
from haros_ci.model.coverage import ENDPOINT, ENOUGH, EXAMPLE, OPEN, OTHER, PRODUCTION, TEST, UNREACHED, Coverage, Site
from haros_ci.model.package import Package
from haros_ci.model.unbuilt import is_whole
from haros_ci.model.workspace import Workspace
from haros_ci.systems.link import Linked
from haros_ci.timing import timed

Rows = Mapping[tuple[str, int], Iterable[Row]]
#: Names of folders, inside a package, for code that shows how others are used.
_EXAMPLES = frozenset("example examples demo demos tutorial tutorials sample samples".split())
_TEST_FILE = re.compile(r"(?:test_\w+|\w+_tests?|conftest|\w+[._]gtest)\.\w+")
_TEST_PACKAGE = re.compile(r"(?:.+_)?(?:tests?|testing|system_tests)|test_.+")
_LOADER = re.compile(r"\bClassLoader\s*<\s*([\w:]+)")
#: What registers a class with Gazebo.
_SIMULATED = re.compile(r"(?:GZ|IGN|IGNITION|GAZEBO)_(?:REGISTER_\w*PLUGIN|ADD_PLUGIN)$")
#: Kinds of files that name plug-ins which are to be loaded, and ends of names of others.
_NAMING = frozenset(("yaml", "launch", "xml"))
_DESCRIBING = (".world", ".sdf", ".urdf", ".xacro", ".gazebo", ".launch.py")
_PROGRAM = re.compile(r"^if[ \t(]+__name__\b|^#!", re.MULTILINE)


@timed("coverage")
def coverage_of(made: Linked, workspace: Workspace, settings: Settings, code: Codebase | None = None) -> Coverage:
    """The call sites in *workspace*, found by the names of API rows, and what the architecture that was *made* says of each."""
    rows = api_rows(settings.project.get("apis"), "", [], plugin_rows(settings))
    if code is None:
        ros = {package.name: package.ros for package in workspace.packages if package.ros is not None}
        code = codebase(made.sources, workspace.text, ros)
    return Coverage(sites=tuple(sorted(_Judge(made, workspace, rows, code).sites(), key=_order)))


def too_little(found: Coverage) -> tuple[str, ...]:
    """A sentence where the model accounts for less than ``ENOUGH`` of the production code's call sites."""
    counts = found.counts()
    if counts.share is None or counts.share >= ENOUGH:
        return ()
    return (
        f"The model accounts for {counts.accounted:,} of {counts.sites:,} calls of ROS APIs in production code "
        f"({int(counts.share * 100)}%), so nodes may have more topics, services and parameters than the checks know; "
        "haros-ci model --coverage lists the calls that are missing",
    )


def _order(site: Site) -> tuple[str, int, int]:
    return site.path, site.line, site.column


@dataclass(slots=True)
class _Judge:
    made: Linked
    workspace: Workspace
    rows: Rows
    code: Codebase

    def sites(self) -> Iterator[Site]:
        """All call sites, file by file."""
        table: dict[tuple[str, int | None], Names] = {}
        for language in ("cpp", "python"):
            one, two = (names_of(self.rows.get((language, ros), ())) for ros in (1, 2))
            table.update({(language, 1): one, (language, 2): two, (language, None): joined(one, two)})
        texts: dict[str, str] = {}
        found: list[Found] = []
        names: dict[str, Names] = {}
        for source in self.code.sources:
            if not source.path.endswith((".yaml", ".yml")):
                language = "python" if source.separator == "." else "cpp"
                texts[source.path] = text = blanked(self.workspace.text(source.path), language)
                names[source.path] = table[language, self.code.ros_of(source)]
                found += judge.found_in(self.code, source, text, names[source.path])
        if not found:
            return
        places = judge.places_of(_locations(self.made.architecture))
        where = Syntax(self.code)
        wrappers = judge.wrapped(self.code, where, places)
        untested, tested = _built(self.code, self.made.builds, self.workspace.packages)
        packages = {package.name: package for package in self.workspace.packages}
        areas = {
            source.path: _area(source.path, packages.get(source.package or ""), source.path in tested - untested)
            for source in self.code.sources
        }
        tests = frozenset(path for path, area in areas.items() if area == TEST)
        pieces = {
            source.path: list(pieces_of(self.code, source, texts[source.path]))
            for source in self.code.sources
            if source.path in texts and source.path in untested and source.path not in tests
        }
        modules = _modules(self.code, self.made.builds, texts)
        plugins = _plugins(self.workspace, self.code, self.made.builds)
        loaded = {*_roots(self.made.architecture), *_loaded(self.workspace, plugins, texts)}
        reach = reach_of(self.code, pieces, modules)
        found_here = [(each, _at(pieces, each)) for each in found]
        reach.start([piece for each, piece in found_here if piece is not None and places.has(each)], loaded)
        told = {id(piece) for each, piece in found_here if places.has(each)}
        for each, piece in found_here:
            path = each.source.path
            package = each.source.package or ""
            area = areas[path]
            if each.call.made and piece is not None and piece.owner == each.call.name:
                continue  # a constructor of that class itself
            state, reason, detail = self._verdict(each, piece, places, where, wrappers, names[path], reach, plugins)
            if area == TEST and state in (OPEN, UNREACHED):
                state, reason, detail = UNREACHED, "code of a test", ""
            if state == OPEN and not reason:
                reason, detail = _about(piece, plugins, told, reach)
            yield Site(
                path=path,
                line=each.line,
                column=each.column,
                name=each.call.name,
                call=shown(self.workspace.text(path), each.call),
                package=package,
                area=area,
                state=state,
                reason=reason,
                detail=detail,
            )

    def _verdict(
        self,
        found: Found,
        piece: Piece | None,
        places: Places,
        where: Syntax,
        wrappers: Mapping[Routine, str],
        names: Names,
        reach: Reach,
        plugins: Mapping[str, Plugin],
    ) -> tuple[str, str, str]:
        """The state of a site, why, and what is special about it."""
        if places.has(found):
            return ENDPOINT, "", ""
        if piece is not None and piece.routine is not None and piece.routine in wrappers:
            return ENDPOINT, "told where the function is called that it stands in", wrappers[piece.routine]
        none = judge.other(self.code, where, found, names)
        if none is not None:
            return OTHER, *none
        if piece is None:
            return UNREACHED, "the file is in no target", ""
        if piece not in reach.running:
            return UNREACHED, *_idle(piece, reach, plugins)
        return OPEN, *_missing(self.made.architecture, found)


def _at(pieces: Mapping[str, list[Piece]], found: Found) -> Piece | None:
    return at(pieces, found.source.path, found.call.offset)


def _about(piece: Piece | None, plugins: Mapping[str, Plugin], told: set[int], reach: Reach) -> tuple[str, str]:
    """Where a site stands that the model does not have."""
    if piece is None:
        return "", ""
    title = piece.routine.title if piece.routine is not None else piece.name
    if id(piece) in told:
        return "other calls of the function are in the model", title
    names = [piece.owner, *(name for name in plugins if piece.owner in _above(reach, name))]
    for name in names:
        if name in plugins:
            return "in a plug-in", f"{title}, of {plugins[name].base}"
    return "nothing of the function is in the model", title


def _above(reach: Reach, name: str) -> frozenset[str]:
    """The last parts of the names of a class's bases in the workspace."""
    found: set[str] = set()
    waiting = [name]
    while waiting:
        for base in reach.bases.get(waiting.pop(), ()):
            if base not in found:
                found.add(base)
                waiting.append(base)
    return frozenset(found)


def _idle(piece: Piece, reach: Reach, plugins: Mapping[str, Plugin]) -> tuple[str, str]:
    """Why a piece of code is never run."""
    if piece.routine is None and piece.definition is None:
        return "nothing imports the module", ""
    if piece.owner in reach.classes and piece.owner not in reach.made:
        if piece.owner in plugins:
            return "a plug-in that nothing in the workspace loads", f"{piece.owner}, of {plugins[piece.owner].base}"
        above = reach.bases.get(piece.owner, frozenset())
        return "the class is never made", piece.owner if not above else f"{piece.owner} ({', '.join(sorted(above))})"
    title = piece.routine.title if piece.routine is not None else piece.name
    return "the function is never called", title


def _missing(found: Architecture, site: Found) -> tuple[str, str]:
    """Why a site is not in the model, as far as a node says that it is not known as a whole there."""
    for configuration in found.configurations:
        for node in configuration.nodes:
            for unknown in node.unknowns:
                at = unknown.location
                if unknown.field == "endpoints" and at is not None and at.path == site.source.path:
                    return "a node is not known as a whole", f"{node.name}: {unknown.reason}"
    return "", ""


def _locations(found: Architecture) -> Iterator[tuple[str, int, int]]:
    for configuration in found.configurations:
        for node in (*configuration.nodes, *configuration.alternatives):
            for endpoint in node.endpoints:
                at = endpoint.location
                if at is not None and at.line is not None:
                    yield at.path, at.line, at.column or 0


def _roots(found: Architecture) -> Iterator[str]:
    """The last parts of the names of classes that nodes are made of."""
    nodes: Iterable[Node] = (node for each in found.configurations for node in (*each.nodes, *each.alternatives))
    for node in nodes:
        yield last_name((node.class_name or node.type).replace("/", "::"))


@dataclass(frozen=True, slots=True)
class Plugin:
    """A class that others load by a name: one of *words* stands where it is loaded, in files of configurations."""

    base: str
    words: frozenset[str]


def _plugins(workspace: Workspace, code: Codebase, builds: Mapping[str, Build]) -> dict[str, Plugin]:
    """The classes that plug-in descriptions name, and those that macros of Gazebo register, by the last parts of their names."""
    found: dict[str, Plugin] = {}
    for build in builds.values():
        for plugin in build.plugins:
            words = frozenset((plugin.name.strip(), plugin.type.strip()))
            found[last_name(plugin.type.strip().partition("<")[0])] = Plugin(plugin.base.strip(), words)
    libraries = {path: target for build in builds.values() for target in build.targets for path in target.sources}
    for source in code.sources:
        for macro, arguments, _, _ in source.program.registered:
            if _SIMULATED.match(macro) and arguments:
                target = libraries.get(source.path)
                words = frozenset((target.output, target.name) if target is not None else ())
                found.setdefault(last_name(arguments[0].strip()), Plugin("the simulator", words))
    return found


def _loaded(workspace: Workspace, plugins: Mapping[str, Plugin], texts: Mapping[str, str]) -> Iterator[str]:
    """Those of *plugins* that a loader of the workspace may load, or that a file of a configuration names."""
    bases = {last_name(base) for text in texts.values() if "ClassLoader" in text for base in _LOADER.findall(text)}
    waiting = {name: plugin for name, plugin in plugins.items() if last_name(plugin.base) not in bases}
    yield from (name for name in plugins if name not in waiting)
    for file in workspace.files if waiting else ():
        if file.language not in _NAMING and not file.path.endswith(_DESCRIBING) or is_test(file.path):
            continue
        text = workspace.text(file.path)
        if "<class" in text and "base_class_type" in text:
            continue  # the description itself
        for name, plugin in tuple(waiting.items()):
            if any(word in text for word in plugin.words):
                del waiting[name]
                yield name


def _built(
    code: Codebase, builds: Mapping[str, Build], packages: Iterable[Package]
) -> tuple[frozenset[str], frozenset[str]]:
    """The files that targets are made of, of others and of tests; Python is in both. All where a build is not known as a whole."""
    known = {each.name for each in packages if each.name in builds and is_whole(builds[each.name], each)}
    sides: list[set[str]] = [set(), set()]
    for build in builds.values():
        for target in build.targets:
            sides[target.is_test].update((*target.sources, *target.conditional_sources))
    for source in code.sources:
        is_header = source.path.endswith(HEADERS)
        is_unknown = source.package not in known and not is_header and source.path not in sides[1]
        if source.separator == "." or is_unknown:
            sides[0].add(source.path)
    for side in sides:
        for path in tuple(side):
            if path in code.cpp.sources:
                side |= code.cpp.reach(path)
    return frozenset(sides[0]), frozenset(sides[1])


def _modules(code: Codebase, builds: Mapping[str, Build], texts: Mapping[str, str]) -> frozenset[str]:
    """The Python files that run only if something imports them."""
    programs = {path for build in builds.values() for path in build.scripts}
    programs |= {entry.path for build in builds.values() for entry in build.entry_points}
    programs |= {each.path for build in builds.values() for each in build.installed if each.kind == "program"}
    return frozenset(
        source.path
        for source in code.sources
        if source.separator == "." and source.path not in programs and not _PROGRAM.search(texts.get(source.path, ""))
    )


def _area(path: str, package: Package | None, is_of_test: bool) -> str:
    name = posixpath.basename(path)
    if is_of_test or is_test(path) or _TEST_FILE.fullmatch(name):
        return TEST
    if package is None:
        return PRODUCTION
    if _TEST_PACKAGE.fullmatch(package.name):
        return TEST
    inside = path if package.path == "." else path[len(package.path) + 1 :]
    return EXAMPLE if _EXAMPLES.intersection(inside.split("/")[:-1]) else PRODUCTION
