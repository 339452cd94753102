# SPDX-License-Identifier: Apache-2.0
"""Plug-ins that pluginlib cannot load: what the description, the macro, the library and the export say does not fit together."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import replace

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, dataclass, field, listed, regex
from haros_ci.api.packages import (
    MACROS,
    PluginClass,
    Registration,
    Target,
    class_names,
    compiled_into,
    described_classes,
    exported_under,
    file_name,
    is_asked_for,
    is_seen_through,
    is_written,
    library_of,
    loaders,
    may_be_added,
    may_be_base,
    meant_classes,
    own_classes,
    registrations,
    variant,
)

_ROOTS = ("library", "class_libraries")
MAX_LEFT_OVER = 50  # descriptions of one package that are looked for in all files
_TEST = regex(r"(?:^|/)(?:tests?|examples?|templates?)(?:/|$)")


@dataclass(slots=True)
class _Package:
    """What a package says of its plug-ins."""

    package: ProjectPackage
    registered: tuple[Registration, ...]
    exports: dict[str, dict[str, Location]]
    libraries: dict[str, Target]
    by_type: dict[str, list[Registration]] = field(default_factory=dict)
    by_last: dict[str, list[Registration]] = field(
        default_factory=dict
    )  # by the last part of the class's name, in small letters
    described: list[PluginClass] = field(default_factory=list)
    awaits_description: bool = False  # a class is registered that no description names
    left_over: int = 0

    def __post_init__(self) -> None:
        for registration in self.registered:
            self.by_type.setdefault(registration.type, []).append(registration)
            self.by_last.setdefault(registration.type.rpartition("::")[2].lower(), []).append(registration)
        self.described += described_classes(self.package, self.exports)
        types = {plugin.type for plugin in self.described}
        self.awaits_description = any(registration.type not in types for registration in self.registered)


def check(project: Project) -> Iterator[Finding]:
    loading = loaders(project)
    found = []
    for package in project.packages:
        libraries = {file_name(t): t for t in package.build.targets if t.kind == "library"}
        exports = exported_under(package)
        own = registrations(package)
        if exports or own:
            found.append(_Package(package, own, exports, libraries))
    classes = class_names(project.programs.values()) if found else set()
    others = {macro.type for package in found for macro in package.registered}
    for exporter in found:
        wrong = tuple(_described(exporter, others))
        yield from wrong
        yield from _exported(exporter, loading, {name for finding in wrong for name in finding.apart})
        yield from _not_exported(exporter)
        yield from _in_two(exporter)
        yield from _unknown_classes(exporter, classes)


def _described(found: _Package, others: Container[str]) -> Iterator[Finding]:
    """Each class of the descriptions: its library, its macro in it, its base."""
    seen_through: dict[str, bool] = {}
    meant = meant_classes(found.package)
    for plugin in found.described:
        if "." in plugin.type or not plugin.library or "$" in plugin.library or "@" in plugin.library:
            continue  # Python's, or made by the build
        library = library_of(plugin, found.libraries, found.package.ros)
        if library is None:
            if not _may_be_elsewhere(plugin, found, others):
                yield _left_over(plugin, found, _no_library(plugin, found))
            continue
        if library.name not in seen_through:
            seen_through[library.name] = is_seen_through(library, found.package)
        if not seen_through[library.name]:
            continue
        macros = found.by_type.get(plugin.type, [])
        inside = compiled_into(library, found.package)
        here = [macro for macro in macros if macro.location.path in inside]
        if not here and all(_is_source(macro.location.path) for macro in macros):
            if not is_written(plugin.type, MACROS, inside, found.package.project):
                hint, related = _correction(plugin, found, macros, meant.get(plugin))
                finding = _not_registered(plugin, library, found, hint, related)
                yield _left_over(plugin, found, finding)
        elif here and not any(may_be_base(macro.base, plugin.base) for macro in here):
            yield _other_base(plugin, found, here[0])


def _may_be_elsewhere(plugin: PluginClass, found: _Package, others: Container[str]) -> bool:
    """Whether what is not seen may make the library: another package, unknown makers of targets, names that a build decides on, a branch
    of CMake that is not followed, as under an option that is off by default.
    """
    is_only_elsewhere = not found.by_type.get(plugin.type) and plugin.type in others
    if is_only_elsewhere or may_be_added(found.package, plugin.library):
        return True
    words = ("is not known", "only known in a build")
    return not found.package.build.targets or any(
        any(word in problem.message for word in words) and ("library" in problem.message or "()" in problem.message)
        for problem in found.package.build.problems
    )


def _no_library(plugin: PluginClass, found: _Package) -> Finding:
    name = posixpath.basename(plugin.library)
    lacking = found.package.ros == 1 and f"lib{name}" in found.libraries
    macros = [macro for macro in found.by_type.get(plugin.type, []) if _is_source(macro.location.path)]
    makers = sorted({file_name(t) for m in macros for t in found.libraries.values() if m.location.path in t.sources})
    if lacking:
        hint = f"the file is lib{name}.so, and ROS 1 adds no lib prefix: write lib/lib{name}"
    elif makers:
        hint = f"the class is in {makers[0].removeprefix('lib')}: write that library"
    else:
        hint = "build the library, or remove the description"
    return Finding(
        at=plugin.location,
        message=f"plug-in {plugin.name} cannot be loaded: package {found.package} builds no library {plugin.library!r}; {hint}",
        about=(found.package.name, plugin.type),
        apart=(plugin.type,),
    )


def _left_over(plugin: PluginClass, found: _Package, finding: Finding) -> Finding:
    """A warning where the description is all that is left: no class of the package has the name, none waits for a description,
    and no file asks for it. Then nothing stops working, but whoever lists what there is to load shows one that is not."""
    found.left_over += 1
    if found.left_over > MAX_LEFT_OVER:
        return finding
    if _has_class(plugin, found) or found.awaits_description:
        return finding
    if is_asked_for((plugin.name, plugin.type), found.package.project):
        return finding
    remedy = "build it, or remove the description and what offers it"
    message = f"{finding.message.rpartition(';')[0]}; no class of the package has this name: {remedy}"
    return replace(finding, message=message, level=Level.WARNING)


def _has_class(plugin: PluginClass, found: _Package) -> bool:
    """Whether a class of the package may be the one described: it is called so, and is not another one that is described or registered."""
    programs = found.package.project.programs
    last = plugin.type.rpartition("::")[2]
    if last not in class_names(programs.get(file.path) for file in found.package.files):
        return False
    others = {plugin.type for plugin in found.described} | {macro.type for macro in found.registered}
    alike = {name for name in own_classes(found.package) if name.rpartition("::")[2] == last}
    return not alike or not alike <= others - {plugin.type}


def _not_registered(
    plugin: PluginClass, library: Target, found: _Package, hint: str, related: tuple[tuple[Location, str], ...]
) -> Finding:
    return Finding(
        at=plugin.location,
        message=f"plug-in {plugin.name} cannot be loaded: library {library.name} does not register {plugin.type}; {hint}",
        about=(found.package.name, plugin.type),
        related=related,
        apart=(plugin.type,),
    )


def _correction(
    plugin: PluginClass, found: _Package, macros: list[Registration], meant: Registration | None
) -> tuple[str, tuple[tuple[Location, str], ...]]:
    """What to do about a class that its library does not register, and the place that shows it."""
    last = plugin.type.rpartition("::")[2]
    alike = [m for m in found.by_last.get(last.lower(), ()) if m.type != plugin.type]
    if macros:
        hint = f"add {macros[0].location.path}, which registers it, to the sources if it compiles, or remove the class here"
        return hint, ((macros[0].location, "it is registered here"),)
    if alike:
        hint = f"{alike[0].type} is registered: write the same name in both places"
        return hint, ((alike[0].location, f"{alike[0].type} is registered here"),)
    if meant is not None:
        hint = f'the library registers {meant.type}, which no description names: write type="{meant.type}"'
        return hint, ((meant.location, f"{meant.type} is registered here"),)
    return "add PLUGINLIB_EXPORT_CLASS for it to a source", ()


def _other_base(plugin: PluginClass, found: _Package, macro: Registration) -> Finding:
    return Finding(
        at=plugin.location,
        message=(
            f"plug-in {plugin.name} cannot be loaded: the description gives the base class {plugin.base}, the "
            f"registration {macro.base}; write the same base class in both places"
        ),
        about=(found.package.name, plugin.type),
        related=((macro.location, f"it is registered as a {macro.base} here"),),
        apart=(plugin.type,),
    )


def _exported(
    found: _Package, loading: Mapping[str, Mapping[str, Location]], wrong: Container[str]
) -> Iterator[Finding]:
    """Each description: exported to the package that the loaders of its base classes name."""
    for path, packages in found.exports.items():
        for plugin in found.described:
            requested = loading.get(plugin.base, {})
            if plugin.location.path != path or plugin.type in wrong or not requested or set(packages) & set(requested):
                continue
            if plugin.base.removeprefix("::").partition("::")[0] in packages:
                continue  # where all look for it
            name, where = sorted(requested.items())[0]
            package, at = list(packages.items())[0]
            yield Finding(
                at=at,
                message=(
                    f"{posixpath.basename(path)} is exported to {package}, but pluginlib searches plug-ins of {plugin.base} in "
                    f"exports to {name}: {plugin.name} is not found; export it to {name}"
                ),
                about=(found.package.name, posixpath.relpath(path, found.package.path), package),
                related=((where, f"{name} is searched here"),),
            )
            break


def _not_exported(found: _Package) -> Iterator[Finding]:
    """Descriptions of classes that are built and registered, which nothing exports."""
    package = found.package
    built = {path for target in package.build.targets if not target.is_test for path in target.sources}
    types = {registration.type for registration in found.registered if registration.location.path in built}
    if not types or any(
        "pluginlib" in word for c in package.build.commands for word in c.arguments[:1] if c.name != "find_package"
    ):
        return
    described = {plugin.type for plugin in found.described}
    for file in package.files:
        if file.language != "xml" or file.path in found.exports or _TEST.search(file.path.removeprefix(package.path)):
            continue
        root = package.project.element(file.path)
        if root is None or root.tag not in _ROOTS:
            continue
        libraries = [root] if root.tag == "library" else list(root.all("library"))
        inside = [tag.attributes.get("type", "").strip() for library in libraries for tag in library.all("class")]
        missing = [name for name in inside if name in types and name not in described]
        if missing and not _is_mentioned(posixpath.basename(file.path), package):
            how = (
                'package.xml exports it (<base_package plugin="${prefix}/..."/>)'
                if package.ros == 1
                else "pluginlib_export_plugin_description_file() exports it"
            )
            yield Finding(
                at=Location(file.path, root.line),
                message=f"this plug-in description of {missing[0]} is not exported: pluginlib does not find it until {how}",
                about=(package.name, posixpath.relpath(file.path, package.path)),
                level=Level.WARNING,
            )


def _is_mentioned(name: str, package: ProjectPackage) -> bool:
    """Whether CMake does something with a file, but install it, or code names it."""
    done = (c for c in package.build.commands if c.name not in ("install", "ament_auto_package"))
    if any(name in word for command in done for word in command.arguments):
        return True
    return any(
        name in package.project.text(file.path)
        for file in package.files
        if file.language in ("cpp", "python", "cmake") and not file.path.endswith("CMakeLists.txt")
    )


def _in_two(found: _Package) -> Iterator[Finding]:
    """A class whose macro is compiled into two shared libraries."""
    for macro in found.registered:
        holders = sorted(
            name
            for name, target in found.libraries.items()
            if macro.location.path in target.sources
            and macro.location.path not in target.conditional_sources
            and target.is_installed
            and not target.is_conditional
        )
        made = [variant(found.package, found.libraries[name]) for name in holders]
        holders = [name for name, variant in zip(holders, made, strict=True) if made.count(variant) > 1]
        if len(holders) > 1:
            yield Finding(
                at=macro.location,
                message=(
                    f"{macro.type} is registered in {len(holders)} libraries, {listed(holders)}, because all of them "
                    "compile this file: if both are loaded, the load order decides which one is used; compile the file in "
                    "one library only"
                ),
                about=(found.package.name, macro.type),
                level=Level.WARNING,
            )


def _unknown_classes(found: _Package, classes: Container[str]) -> Iterator[Finding]:
    """Macros for classes of the package's own namespaces that the workspace, whose *classes* are given by their last parts, lacks."""
    built = {path for target in found.package.build.targets for path in target.sources}
    for macro in found.registered:
        space, _, last = macro.type.removeprefix("::").rpartition("::")
        if macro.location.path not in built or last in classes or not re.fullmatch(r"[\w:]+::\w+", macro.type):
            continue
        own = own_classes(found.package)
        if any(name.startswith(f"{space}::") for name in own):
            yield Finding(
                at=macro.location,
                message=f"{macro.macro} names the class {macro.type}, which does not exist: this does not compile; correct the name",
                about=(found.package.name, macro.type),
            )


def _is_source(path: str) -> bool:
    return path.endswith((".cpp", ".cc", ".cxx", ".c++", ".C", ".cu"))


CHECK = Check(
    id="plugin-not-loadable",
    summary="Plug-in that pluginlib cannot load: description, registration, library and export disagree.",
    level=Level.ERROR,
    catalogue="B10",
    tags=("build", "plugins"),
    project=check,
)
