# SPDX-License-Identifier: Apache-2.0
"""Where node types begin: an executable's ``main``, a nodelet's class, a Python script; and the files they are made of."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow.follow import Entry
from haros_ci.index.index import Index, Source, aliased, is_test
from haros_ci.index.plugins import PluginDescription, written_type
from haros_ci.index.types import resolve_type
from haros_ci.model.build import Build, PluginClass, Target
from haros_ci.records import dataclass, field
from haros_ci.syntax import Argument, Class

#: The base class that a plug-in needs to be a nodelet.
NODELET = "nodelet::Nodelet"

#: Targets by name, and by package and name.
Linkable = tuple[dict[str, Target], dict[str, dict[str, Target]]]
#: A class that a plug-in description names, with its definition and the files of its library.
Described = tuple[PluginClass, Source, Class, frozenset[str]]


@dataclass(frozen=True, slots=True)
class Programs:
    """The workspace's programs by language and path, with their indexes and what the packages build."""

    cpp: Index
    python: Index
    sources: Mapping[str, Source]
    builds: Mapping[str, Build]
    #: Once they have been found: the classes that plug-in descriptions name, what can be linked, the files of targets by their identity.
    described: list[Described] = field(default_factory=list, init=False, repr=False, compare=False)
    linkable: list[Linkable] = field(default_factory=list, init=False, repr=False, compare=False)
    made_of: dict[int, frozenset[str]] = field(default_factory=dict, init=False, repr=False, compare=False)

    def index_of(self, entry: Entry) -> Index:
        return self.python if entry.source.program.language == "python" else self.cpp


def executables(programs: Programs, *, tests: bool = False) -> dict[tuple[str, str], tuple[Entry, frozenset[str]]]:
    """All node types that can be started, by package and executable: where each begins, and its files.

    Those that are built for tests only come with *tests*, and the names in the source space of scripts that are installed under others.
    """
    found: dict[tuple[str, str], tuple[Entry, frozenset[str]]] = {}
    for package, build in sorted(programs.builds.items()):
        for target in build.targets:
            if target.kind != "executable" or (target.is_test and not tests):
                continue
            files = files_of(programs, target)
            entry = main_of(programs, target)
            if entry is not None:
                entry = of_target(programs, entry, target)
                found.setdefault((package, target.output), (entry, files))
        renamed = set() if tests else _renamed(build)
        for path in build.scripts:
            source = programs.sources.get(path) if path not in renamed else None
            if source is not None and source.program.language == "python":
                found.setdefault((package, posixpath.basename(path)), (Entry(source), frozenset((path,))))
        for installed in build.installed:
            source = programs.sources.get(installed.path)
            if installed.kind == "program" and source is not None and source.program.language == "python":
                name = installed.name or posixpath.basename(installed.path)
                found.setdefault((package, name), (Entry(source), frozenset((installed.path,))))
    return found


def _renamed(build: Build) -> set[str]:
    """The scripts that are installed under other names only (``install(PROGRAMS a.py DESTINATION d RENAME a)``)."""
    own = {
        (item.path, item.name or posixpath.basename(item.path)) for item in build.installed if item.kind == "program"
    }
    return {path for path, _ in own if (path, posixpath.basename(path)) not in own}


def plugins(programs: Programs) -> dict[str, PluginDescription]:
    """All classes that plug-in descriptions name, by look-up name and by type: where they are defined."""
    found: dict[str, PluginDescription] = {}
    for described, source, definition, _ in described_classes(programs):
        plugin = PluginDescription(source, definition, _arguments(programs, described))
        found.setdefault(described.name, plugin)
        found.setdefault(described.type.strip(), plugin)
    return found


def plugins_of_base(programs: Programs) -> dict[str, tuple[PluginDescription, ...]]:
    """The classes that plug-in descriptions name by their base class, in the order of their names, but for tests' own."""
    found: dict[str, dict[tuple[str, str], PluginDescription]] = {}
    for described, source, definition, _ in described_classes(programs):
        if is_test(source.path):
            continue
        plugin = PluginDescription(source, definition, _arguments(programs, described))
        found.setdefault(base_of(described), {}).setdefault(plugin.key, plugin)
    return {base: tuple(class_ for _, class_ in sorted(classes.items())) for base, classes in found.items()}


def declared(programs: Programs) -> dict[str, tuple[str, ...]]:
    """By base class of the workspace's own the look-up names of all its plug-ins, in the order in which a loader tells them.

    Whoever derives from such a class outside would have to be built on top of the workspace.
    """
    found: dict[str, set[str]] = {}
    for _, build in sorted(programs.builds.items()):
        for described in build.plugins:
            if base_of(described) in programs.cpp.classes and not is_test(described.location.path):
                found.setdefault(base_of(described), set()).add(described.name)
    return {base: tuple(sorted(names)) for base, names in found.items()}


def base_of(described: PluginClass) -> str:
    """The base class that a plug-in description names."""
    return described.base.replace(" ", "").removeprefix("::")


def _arguments(programs: Programs, described: PluginClass) -> tuple[Argument, ...]:
    """The template arguments of the type that a plug-in description names, also of one that it names by an alias."""
    written = written_type(described.type)
    found = programs.cpp.aliases.get(written.name, []) if not written.arguments else []
    if len(found) == 1 and found[0][1].type.arguments:
        source, alias = found[0]
        scope = written.name.rpartition("::")[0]
        return resolve_type(programs.cpp, alias.type, scope, source, frozenset(), {}).arguments
    return tuple(
        syntax.Type(aliased(programs.cpp, argument.name) or argument.name, argument.arguments, argument.marks)
        if isinstance(argument, syntax.Type) and argument.name not in programs.cpp.classes
        else argument
        for argument in written.arguments
    )


def nodelets(programs: Programs) -> dict[str, tuple[PluginClass, Entry, frozenset[str]]]:
    """All nodelet classes by look-up name: the description, where each begins, and its library's files."""
    found: dict[str, tuple[PluginClass, Entry, frozenset[str]]] = {}
    for described, source, definition, files in described_classes(programs):
        if described.base.replace(" ", "") == NODELET:
            arguments = _arguments(programs, described)
            label = described.type.strip() if arguments else ""
            entry = Entry(source, definition=definition, label=label, arguments=arguments)
            found.setdefault(described.name, (described, entry, files))
            found.setdefault(described.type.strip().replace("::", "/"), (described, entry, files))
    return found


def plugin_files(programs: Programs) -> list[tuple[str, frozenset[str]]]:
    """For each class that a plug-in description names, the last part of its base's name, and the files of its library."""
    return [
        (plugin.base.replace(" ", "").rpartition("::")[2], files | {source.path})
        for plugin, source, _, files in described_classes(programs)
    ]


def described_classes(programs: Programs) -> Sequence[Described]:
    """Each described class with its definition and the files of its library; found once."""
    if not programs.described:
        programs.described.extend(_described_classes(programs))
    return programs.described


def _described_classes(programs: Programs) -> Iterator[Described]:
    for _, build in sorted(programs.builds.items()):
        libraries: dict[str, Target] = {}
        for target in build.targets if build.plugins else ():
            if target.kind == "library":
                for name in (target.output, target.name):
                    libraries.setdefault(name, target)
        for plugin in build.plugins:
            library = libraries.get(posixpath.basename(plugin.library).removeprefix("lib"))
            files = files_of(programs, library) if library is not None else frozenset[str]()
            name = plugin.type.strip().partition("<")[0]
            name = name if name in programs.cpp.classes else aliased(programs.cpp, name) or name
            candidates = [item for item in programs.cpp.classes.get(name, ()) if item[1].bases or item[1].fields]
            included = _included(programs, plugin, files) if len(candidates) > 1 else frozenset()
            ranked = [
                (
                    item[0].path not in files,
                    item[0].path not in included,
                    item[0].package != plugin.package,
                    item[0].path,
                )
                for item in candidates
            ]
            if candidates:
                yield plugin, *candidates[ranked.index(min(ranked))], files


def _included(programs: Programs, plugin: PluginClass, files: frozenset[str]) -> frozenset[str]:
    """What those of the *files* of a library include that register the class of *plugin*; what all of them include where none is seen to."""
    last = plugin.type.strip().partition("<")[0].rpartition("::")[2]
    sources = [programs.sources[path] for path in sorted(files) if path in programs.sources]
    registering = [
        source
        for source in sources
        if any(text.strip().rpartition("::")[2] == last for _, words, *_ in source.program.registered for text in words)
    ]
    return frozenset(path for source in registering or sources for path in programs.cpp.reach(source.path))


def files_of(programs: Programs, target: Target) -> frozenset[str]:
    """The sources of a *target* of the builds and of all workspace libraries that it links, transitively; found once."""
    if id(target) not in programs.made_of:
        programs.made_of[id(target)] = _files_of(programs, target)
    return programs.made_of[id(target)]


def _files_of(programs: Programs, target: Target) -> frozenset[str]:
    if not target.links:
        return frozenset((*target.sources, *target.conditional_sources))
    if not programs.linkable:
        programs.linkable.append(_linkable(programs))
    by_name, in_packages = programs.linkable[0]
    local = in_packages.get(target.package, {})
    files: set[str] = set()
    seen: set[str] = set()
    waiting = [target]
    while waiting:
        current = waiting.pop()
        files.update(current.sources)
        files.update(current.conditional_sources)
        for link in current.links:
            linked = local.get(link) or by_name.get(link)
            if linked is not None and linked.name not in seen:
                seen.add(linked.name)
                waiting.append(linked)
    return frozenset(files)


def of_target(programs: Programs, entry: Entry, target: Target) -> Entry:
    """*entry* of a target, whose name is in it where another one compiles the same files with other macros."""
    name = f"{target.package}/{target.name}"
    paths = (*target.sources, *target.conditional_sources)
    every = [{(way.macros, way.undefined) for way in programs.cpp.compiled.get(path, ())} for path in paths]
    return replace(entry, target=name) if any(len(ways) > 1 for ways in every) else entry


def _linkable(programs: Programs) -> Linkable:
    """What can be linked by name: from anywhere, and within each package."""
    every = [t for build in programs.builds.values() for t in build.targets if t.kind != "executable"]
    by_name = {t.name: t for t in every} | {f"{t.package}::{t.name}": t for t in every}
    return by_name, {name: {t.name: t for t in build.targets} for name, build in programs.builds.items()}


def main_of(programs: Programs, target: Target) -> Entry | None:
    """The ``main`` of an executable; None where a macro writes it, or none is found."""
    for path in (*target.sources, *target.conditional_sources):
        source = programs.sources.get(path)
        if source is None:
            continue
        for function in source.program.functions:
            if function.name == "main" and function.body is not None:
                return Entry(source, function)
        for macro, arguments, _, _ in source.program.registered:  # a main that a macro writes
            if macro.endswith("MAIN") and arguments:
                return None
    return None
