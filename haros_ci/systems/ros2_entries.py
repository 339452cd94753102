# SPDX-License-Identifier: Apache-2.0
"""Where ROS 2 node types begin: executables, components by package and class, console scripts of Python packages."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping
from functools import partial

from haros_ci.follow import commands
from haros_ci.follow.follow import Entry
from haros_ci.index.index import Source, aliased
from haros_ci.model.api import Row
from haros_ci.model.build import Target
from haros_ci.syntax import Class
from haros_ci.systems.entries import Programs, base_of, described_classes, executables, files_of, of_target

#: The base class of what rclcpp_components_register_node registers, and the macro that registers a class in its source.
FACTORY = "rclcpp_components::NodeFactory"
REGISTER = "RCLCPP_COMPONENTS_REGISTER_NODE"

Found = tuple[Entry, frozenset[str]]


def components(programs: Programs) -> dict[tuple[str, str], Found]:
    """All components of the workspace by package and full class: where each begins, and its library's files."""
    found: dict[tuple[str, str], Found] = {}
    for package, build in sorted(programs.builds.items()):
        libraries = {t.name: t for t in build.targets if t.kind == "library"}
        for plugin in build.plugins:
            if plugin.base != FACTORY or (package, plugin.type) in found:
                continue
            target = libraries.get(plugin.library)
            entry = _component(programs, package, plugin.type, target)
            if entry is not None:
                found[package, plugin.type] = entry
    for package, source, name in _registered(programs):
        if (package, name) not in found:
            targets = (t for t in programs.builds[package].targets if source.path in t.sources)
            entry = _component(programs, package, name, next(targets, None))
            if entry is not None:
                found[package, name] = entry
    return found


def hosted(programs: Programs, rows: Mapping[str, tuple[Row, ...]]) -> dict[tuple[str, str], Found]:
    """The plug-ins of a library's program (RViz's panels, displays, tools) by package and class.

    They are those whose description names a base class outside the workspace of which *rows* know the methods that the
    program calls.
    """
    found: dict[tuple[str, str], Found] = {}
    for plugin, source, definition, files in described_classes(programs):
        base = base_of(plugin)
        if base not in programs.cpp.classes and any(row.is_class and row.entry for row in rows.get(base, ())):
            entry = Entry(source, definition=definition, is_hosted=True)
            found.setdefault((plugin.package, plugin.type.strip()), (entry, files))
    return found


def _registered(programs: Programs) -> Iterator[tuple[str, Source, str]]:
    """The package, file and class of each macro that registers a component."""
    for _, source in sorted(programs.sources.items()):
        for macro, arguments, _, _ in source.program.registered:
            if macro == REGISTER and arguments and source.package in programs.builds:
                yield str(source.package), source, arguments[0].strip().removeprefix("::")


def _component(programs: Programs, package: str, name: str, target: Target | None) -> Found | None:
    files = files_of(programs, target) if target is not None else frozenset[str]()
    defined = class_named(programs, package, name, files)
    if defined is None:
        return None
    entry = Entry(defined[0], definition=defined[1])
    return (of_target(programs, entry, target) if target is not None else entry), files


def class_named(programs: Programs, package: str, name: str, files: frozenset[str]) -> tuple[Source, Class] | None:
    """The workspace's class of that full name, in the library's own files or else nearest to them."""
    name = name.strip().removeprefix("::")
    known = name if name in programs.cpp.classes else aliased(programs.cpp, name) or name
    candidates = sorted(
        (item for item in programs.cpp.classes.get(known, ()) if item[1].bases or item[1].fields),
        key=lambda item: (item[0].path not in files, item[0].package != package, item[0].path),
    )
    return candidates[0] if candidates else None


def programs_of(programs: Programs, components: Mapping[tuple[str, str], Found]) -> dict[tuple[str, str], Found]:
    """All executables by package and name: with a ``main``, of a component, Python scripts and console scripts."""
    found = dict(executables(programs))
    for package, build in sorted(programs.builds.items()):
        installed = {installed.path for installed in build.installed if installed.kind == "program"}
        for path in {point.path for point in build.entry_points} - installed:  # a module, in spite of its shebang
            found.pop((package, posixpath.basename(path)), None)
        for target in build.targets:
            if target.kind == "executable" and target.component:
                entry = components.get((package, target.component))
                if entry is not None:
                    found[package, target.output] = entry
        for point in build.entry_points:
            source = programs.sources.get(point.path)
            if source is None:
                continue
            named = (
                f for f in source.program.functions if f.name == point.function and f.body is not None and not f.owner
            )
            function = next(named, None)
            if function is not None:
                found[package, point.name] = Entry(source, function), frozenset[str]()
            else:  # a variable, what the module imports, a method
                begin = partial(commands.start, point.function, source)
                found[package, point.name] = Entry(source, begin=begin, label=point.function), frozenset[str]()
        for path in build.scripts:
            if path.endswith(".launch.py") or posixpath.basename(path).endswith("_launch.py"):
                found.pop((package, posixpath.basename(path)), None)
    return found
