# SPDX-License-Identifier: Apache-2.0
"""The executables that load plug-ins (ROS 2) or create behaviour trees: which are followed once more, with all of these."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci import syntax
from haros_ci.index import behavior_tree_files
from haros_ci.syntax import Type
from haros_ci.systems import system
from haros_ci.systems.following import Types
from haros_ci.systems.ros2_system import PLUGINS, alone
from haros_ci.systems.system import TREES, Job


def hosts(types: Types) -> Iterable[Job]:
    """The executables of packages with a pluginlib loader for plug-ins of the workspace, once more with all of these.

    What a plug-in that no configuration loads makes is modelled there, and not at the node as it is started. Of several
    executables the one that has the loaders of the others, too, stands for them; of those alike the one of most files,
    a component before a program.
    """
    loading, packages = _loaders(types)
    candidates: list[tuple[frozenset[str], int, bool, tuple[str, str]]] = []
    seen: set[int] = set()
    for package, name in sorted(types.ros2_programs):
        entry, files = types.ros2_programs[package, name]
        if package not in packages or id(entry) in seen or entry.source.separator != "::":
            continue
        seen.add(id(entry))
        reached = {item for path in (entry.source.path, *files) for item in (path, *types.programs.cpp.reach(path))}
        own = frozenset(base for path in reached & loading.keys() for base in loading[path])
        candidates.append((own, len(files), entry.definition is None, (package, name)))
    chosen: list[frozenset[str]] = []
    for own, _, _, (package, name) in sorted(
        candidates, key=lambda candidate: (-len(candidate[0]), -candidate[1], *candidate[2:])
    ):
        if own and not any(own <= other for other in chosen):
            chosen.append(own)
            yield alone(types, package, name, label=PLUGINS)
    yield from tree_hosts(types)


def tree_hosts(types: Types) -> Iterable[Job]:
    """The executables that create behaviour trees, once more with the nodes of all trees of the workspace."""
    cpp = types.programs.cpp
    using = behavior_tree_files.users(cpp) if types.trees is not None else frozenset[str]()
    seen: set[int] = set()
    for programs, started in ((types.ros2_programs, alone), (types.executables, system.alone)) if using else ():
        for package, name in sorted(programs):
            entry, files = programs[package, name]
            is_new = id(entry) not in seen and entry.source.separator == "::"
            if is_new and behavior_tree_files.runs_trees(cpp, using, (entry.source.path, *files)):
                seen.add(id(entry))
                yield started(types, package, name, label=TREES)


def _loaders(types: Types) -> tuple[dict[str, set[str]], set[str | None]]:
    """The files with classes that have loaders for plug-ins of the workspace: of which bases; and the packages of these."""
    loading: dict[str, set[str]] = {}
    packages: set[str | None] = set()
    for found in types.programs.cpp.classes.values():
        for source, definition in found:
            for member in definition.fields:
                expected = f"::{_loaded_base(member.type)}"
                base = next((item for item in types.of_base if f"::{item}".endswith(expected)), None)
                if base is not None:
                    loading.setdefault(source.path, set()).add(base)
                    packages.add(source.package)
    return loading, packages


def _loaded_base(kind: Type) -> str:
    """The base class of a loader's type, also behind a pointer to it; ``?`` if it is no loader."""
    while kind.name and kind.name.rpartition("::")[2] != "ClassLoader":
        kind = kind.arguments[0] if kind.arguments and isinstance(kind.arguments[0], syntax.Type) else syntax.Type("")
    return str(kind.arguments[0].name) if kind.arguments and isinstance(kind.arguments[0], syntax.Type) else "?"
