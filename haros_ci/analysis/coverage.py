# SPDX-License-Identifier: Apache-2.0
"""How many of the call sites of ROS APIs in a workspace's code the model accounts for, and which it does not."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping

from haros_ci.analysis.api_rows import api_rows, plugin_rows
from haros_ci.analysis.code_of import code_of
from haros_ci.analysis.coverage_files import Plugins, area_of, built, copies, imported, loaded, plugins_of, shadowed
from haros_ci.analysis.coverage_nodes import Users, gaps, locations, roots
from haros_ci.code.codebase import Codebase
from haros_ci.config.settings import Settings
from haros_ci.coverage import judge
from haros_ci.coverage.blanked import blanked
from haros_ci.coverage.judge import Places, Seen, Syntax, TextSite
from haros_ci.coverage.names import Names, joined, names_of
from haros_ci.coverage.pieces import Piece, around, pieces_of
from haros_ci.coverage.reach import Reach, reach_of
from haros_ci.coverage.search import TextCall, calls_in, may_have, shown
from haros_ci.index.index import Source
from haros_ci.model.api import Row
from haros_ci.model.coverage import ENDPOINT, ENOUGH, OPEN, OTHER, PRODUCTION, TEST, UNREACHED, Coverage, Site
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.systems.client_libraries import library_files
from haros_ci.systems.link import Linked
from haros_ci.timing import timed
from haros_ci.workspace.views import views

Rows = Mapping[tuple[str, int], Iterable[Row]]
Calls = dict[tuple[str, str, int | None], tuple[TextCall, ...]]


@timed("coverage")
def coverage_of(made: Linked, workspace: Workspace, settings: Settings) -> Coverage:
    """The call sites in *workspace*, found by the names of API rows, and what the architecture that was *made* says of each."""
    if made.views:
        seen = [
            (view, _sites(own, view.workspace, settings))
            for view, own in zip(views(workspace), made.views, strict=True)
        ]
        held = {_order(site): site for view, sites in seen for site in sites if view.holds(site.path)}
        return Coverage(sites=tuple(held[key] for key in sorted(held)))
    return Coverage(sites=tuple(sorted(_sites(made, views(workspace)[0].workspace, settings), key=_order)))


def _sites(made: Linked, workspace: Workspace, settings: Settings) -> Iterator[Site]:
    return judging(made, workspace, settings).sites()


def judging(made: Linked, workspace: Workspace, settings: Settings, calls: Calls | None = None) -> CoverageJudge:
    """What tells the call sites of a workspace, and what the architecture that was *made* says of them.

    *calls* has, and gets, what is found in the text of files.
    """
    rows = api_rows(settings.project.get("apis"), "", [], plugin_rows(settings))
    return CoverageJudge(made, workspace, rows, code_of(made, workspace), calls={} if calls is None else calls)


@timed("coverage")
def uncovered(made: Linked, workspace: Workspace, settings: Settings) -> tuple[str, ...]:
    """A sentence where the model accounts for less than ``ENOUGH`` of the production code's call sites.

    Where enough of them are endpoints, nothing is asked of the others.
    """
    asked = judging(made, workspace, settings)
    found = asked.found()
    places = asked.places()
    area = asked.areas()
    here = [places.has(match) for match in found if area(match.source) == PRODUCTION]
    if sum(here) >= ENOUGH * len(here):
        return ()
    return too_little(Coverage(sites=tuple(asked.sites())))


def too_little(found: Coverage) -> tuple[str, ...]:
    """The sentence of ``uncovered``."""
    counts = found.counts()
    if counts.share is None or counts.share >= ENOUGH:
        return ()
    return (
        f"{counts.accounted:,} of {counts.sites:,} calls of ROS APIs in production code ({int(counts.share * 100)}%) are understood: mistakes in "
        f"topics, services and parameters at the other {counts.sites - counts.accounted:,} are not reported; "
        "findings in manifests, builds and of linters do not depend on it; haros-ci model --coverage lists these calls with the reasons",
    )


def _order(site: Site) -> tuple[str, int, int]:
    return site.path, site.line, site.column


def language_of(source: Source) -> str:
    """The language of a program, as API rows name it."""
    return "python" if source.separator == "." else "cpp"


def _names(rows: Rows) -> Mapping[tuple[str, int | None], Names]:
    """The names of the calls of ROS APIs by language and ROS version; None for files of neither version or both."""
    table: dict[tuple[str, int | None], Names] = {}
    for language in ("cpp", "python"):
        one, two = (names_of(tuple(rows.get((language, ros), ()))) for ros in (1, 2))
        table.update({(language, 1): one, (language, 2): two, (language, None): joined(one, two)})
    return table


@dataclass(slots=True)
class CoverageJudge:
    """The call sites of a workspace, and what the model says of each."""

    made: Linked
    workspace: Workspace
    rows: Rows
    code: Codebase
    texts: dict[str, str] = field(default_factory=dict)
    #: The files of the product's targets and of those for tests, made when they are asked for.
    files: list[tuple[frozenset[str], frozenset[str]]] = field(default_factory=list)
    #: Files of libraries that are copied into a package, each with the directory of its library.
    copies: Mapping[str, str] = field(default_factory=dict)
    #: Files of libraries that the rows describe: they are not followed.
    libraries: frozenset[str] = frozenset()
    #: Modules that only share the last part of their names with one that is imported.
    shadowed: frozenset[str] = frozenset()

    #: What was found in the text of files, by their digest, language and ROS version, for the other revision of a change.
    calls: Calls = field(default_factory=dict)

    def found(self, paths: Collection[str] | None = None) -> list[TextSite]:
        """The call sites in *paths*, or in all files, file by file; a file is searched once."""
        kept: dict[str, tuple[TextSite, ...]] = self.made.kept.setdefault("calls", {})
        names = _names(self.rows)
        digests = {file.path: file.digest for file in self.workspace.files}
        for source in self.code.sources:
            if (paths is None or source.path in paths) and source.path not in kept:
                kind = language_of(source), self.code.ros_of(source)
                kept[source.path] = tuple(self._found(source, names[kind], (digests.get(source.path, ""), *kind)))
        return [site for source in self.code.sources for site in kept.get(source.path, ())]

    def places(self) -> Places:
        """Where the model has endpoints."""
        return judge.places_of(locations(self.made.architecture))

    def _found(self, source: Source, names: Names, key: tuple[str, str, int | None]) -> Iterator[TextSite]:
        if source.path.endswith((".yaml", ".yml")):
            return
        calls = self.calls.get(key) if key[0] else None
        if calls is None:
            has = may_have(self.workspace.text(source.path), names)
            calls = tuple(calls_in(self.text(source), names, source.program.language)) if has else ()
            if key[0]:
                self.calls[key] = calls
        if calls:
            yield from judge.found_in(self.code, source, self.workspace.text(source.path), names, calls)

    def text(self, source: Source) -> str:
        """The text of a file with blanks for comments and texts."""
        if source.path not in self.texts:
            self.texts[source.path] = blanked(self.workspace.text(source.path), language_of(source))
        return self.texts[source.path]

    def sites(self) -> Iterator[Site]:
        """All call sites with what the model says of each."""
        found = self.found()
        places = self.places()
        area = self.areas()
        areas = {match.source.path: area(match.source) for match in found}
        self.copies = copies(self.workspace)
        self.libraries = library_files(self.code.sources, self.made.builds, self.rows)
        pending = [match for match in found if not places.has(match)]
        users = Users(self.made.architecture, self.code.sources)
        verdicts = dict(self.judged(found, places, area)) if pending else {}
        for match in found:
            path = match.source.path
            state, reason, detail = verdicts.get(id(match), (ENDPOINT, "", ""))
            if not state:
                continue
            if areas[path] == TEST and state in (OPEN, UNREACHED):
                state, reason, detail = UNREACHED, "code of a test", ""
            yield Site(
                path=path,
                line=match.line,
                column=match.column,
                name=match.call.name,
                call=shown(self.workspace.text(path), match.call),
                package=match.source.package or "",
                area=areas[path],
                state=state,
                reason=reason,
                detail=detail,
                node_types=users.of(path, match.line) if state == OPEN else (),
            )

    def areas(self) -> Callable[[Source], str]:
        """A function that says what a file is for."""
        if not self.files:
            self.files.append(built(self.code, self.made.builds, self.workspace))
        untested, tested = self.files[0]
        packages = {package.name: package for package in self.workspace.packages}
        of_tests = tested - untested
        return lambda source: area_of(source.path, packages.get(source.package or ""), source.path in of_tests)

    def judged(
        self, found: list[TextSite], places: Places, area: Callable[[Source], str]
    ) -> Iterator[tuple[int, tuple[str, str, str]]]:
        """State, reason and detail of the sites that stand at no endpoint, by identity; no state for what is none."""
        pieces = self._pieces(area)
        where = Syntax(self.code)
        plugins = plugins_of(self.code, self.made.builds)
        found_here = list(_with_pieces(found, pieces))
        known = [piece for match, piece in found_here if piece is not None and places.has(match)]
        reach = self._reach(pieces, plugins, known)
        known_ids = {id(piece) for piece in known}
        below = _below(plugins, reach)
        incomplete = dict(gaps(self.made.architecture))
        seen = Seen(places, judge.wrapped(self.code, where, places), judge.by_routine(self.code, found_here))
        for match, piece in found_here:
            if match.call.made and piece is not None and piece.owner == match.call.name:
                yield id(match), ("", "", "")  # a constructor of that class itself
            elif not places.has(match):
                state, reason, detail = self._verdict(match, piece, seen, where, reach, plugins)
                if state == OPEN and match.source.path in incomplete:
                    reason, detail = "a node is not known as a whole", incomplete[match.source.path]
                elif state == OPEN:
                    reason, detail = _about(match, piece, plugins, known_ids, below)
                yield id(match), (state, reason, detail)

    def _pieces(self, area: Callable[[Source], str]) -> dict[str, list[Piece]]:
        """The pieces of the code that is built or started, by file, without that of tests."""
        return {
            source.path: list(pieces_of(source, self.text(source)))
            for source in self.code.sources
            if source.path in self.files[0][0] and not source.path.endswith((".yaml", ".yml")) and area(source) != TEST
        }

    def _reach(self, pieces: dict[str, list[Piece]], plugins: Plugins, known: Iterable[Piece]) -> Reach:
        """What runs: programs, what the workspace loads, and the *known* pieces, in which the model has an endpoint."""
        modules = imported(self.code, self.made.builds, self.workspace)
        self.shadowed = shadowed(self.code, modules)
        reach = reach_of(self.code, pieces, modules)
        loading = loaded(self.workspace, plugins, self.texts, reach.classes)
        begun = {*roots(self.made.architecture), *loading}
        reach.start(known, sorted(begun))
        return reach

    def _verdict(
        self, found: TextSite, piece: Piece | None, seen: Seen, where: Syntax, reach: Reach, plugins: Plugins
    ) -> tuple[str, str, str]:
        """The state of a site, why, and what is special about it."""
        routine = judge.routine_of(self.code, found, piece)
        if routine is not None and routine in seen.wrappers:
            return ENDPOINT, "in the model where the function around it is called", seen.wrappers[routine]
        none = judge.other(self.code, where, found, seen)
        if none is not None:
            return OTHER, *none
        if found.source.path in self.copies:
            return OTHER, "a copy of another project", self.copies[found.source.path]
        if found.source.path in self.libraries:
            return OTHER, "in a library that the API rows describe", found.source.package or ""
        if piece is None:
            return UNREACHED, "the file is in no target", ""
        if found.source.path in self.shadowed:
            return UNREACHED, "nothing imports the module", ""
        if not reach.runs(piece):
            return UNREACHED, *_idle(found, piece, reach, plugins)
        return OPEN, "", ""


def _with_pieces(
    found: Iterable[TextSite], pieces: Mapping[str, list[Piece]]
) -> Iterator[tuple[TextSite, Piece | None]]:
    """The sites of *found*, each with the piece that it stands in; None for a file without pieces."""
    offsets: dict[str, list[int]] = {}
    for match in found:
        offsets.setdefault(match.source.path, []).append(match.call.offset)
    inside = {path: around(pieces.get(path, ()), here) for path, here in offsets.items()}
    return ((match, inside[match.source.path].get(match.call.offset)) for match in found)


def _about(
    found: TextSite, piece: Piece | None, plugins: Plugins, known: set[int], below: Mapping[str, list[str]]
) -> tuple[str, str]:
    """Where a site stands that the model does not have; in the *known* pieces, by identity, it has others."""
    if piece is None:
        return "", ""
    title = _title(piece)
    if id(piece) in known:
        return "other calls of the function are in the model", title
    for name in (piece.owner, *below.get(piece.owner, ())):
        plugin = plugins.of(piece, name, found.source.package)
        if plugin is not None:
            return "in a plug-in", f"{title}, of {plugin.base}"
    if found.source.package is None:
        return "the file lies in no package", title
    return "nothing of the function is in the model", title


def _below(plugins: Plugins, reach: Reach) -> dict[str, list[str]]:
    """The plug-ins that have a class as a base, by the last part of its name."""
    found: dict[str, list[str]] = {}
    for name in plugins.every:
        for base in _above(reach, name):
            found.setdefault(base, []).append(name)
    return found


def _above(reach: Reach, name: str) -> frozenset[str]:
    """The last parts of the names of a class's bases in the workspace."""
    found: set[str] = set()
    waiting = [name]
    while waiting:
        for base in reach.bases(waiting.pop()):
            if base not in found:
                found.add(base)
                waiting.append(base)
    return frozenset(found)


def _idle(found: TextSite, piece: Piece, reach: Reach, plugins: Plugins) -> tuple[str, str]:
    """Why a piece of code is never run."""
    if piece.function is None and piece.definition is None:
        return "nothing imports the module", ""
    half = reach.half(piece)
    if not half.is_free(piece) and piece.owner not in half.made:
        plugin = plugins.of(piece, piece.owner, found.source.package)
        if plugin is not None:
            return "a plug-in that nothing in the workspace loads", f"{piece.owner}, of {plugin.base}"
        above = half.bases.get(piece.owner, frozenset())
        return "the class is never made", piece.owner if not above else f"{piece.owner} ({', '.join(sorted(above))})"
    return "the function is never called", _title(piece)


def _title(piece: Piece) -> str:
    """The name of a function with its class's."""
    separator = "::" if piece.function is not None and "::" in piece.function.name else "."
    return separator.join(item for item in (piece.owner, piece.name) if item)
