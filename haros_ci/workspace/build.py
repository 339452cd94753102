# SPDX-License-Identifier: Apache-2.0
"""What packages build, install and declare, from CMake, manifests, setup.py, definitions and .cfg files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice

from haros_ci.model.build import (
    Build,
    ConfigFile,
    Installed,
    Interface,
    ParameterLibrary,
    PluginClass,
    Target,
)
from haros_ci.model.faults import FAULTS, fault
from haros_ci.model.once import once
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.cmake import follow
from haros_ci.workspace.cmake_configured import written_files
from haros_ci.workspace.cmake_state import MAX_MESSAGE, MAX_PROBLEMS, CMakeState, CMakeTarget
from haros_ci.workspace.cmake_targets import FLAG
from haros_ci.workspace.cmake_words import MAYBE, written
from haros_ci.workspace.exported import linked
from haros_ci.workspace.interfaces import read_interface
from haros_ci.workspace.language import HEAD, script_language
from haros_ci.workspace.plugins_xml import exported_descriptions, read_plugins
from haros_ci.workspace.reconfigure import read_config
from haros_ci.workspace.setup_cfg import script_directories
from haros_ci.workspace.setup_py import Setup, read_setup
from haros_ci.workspace.tree import PathTree

#: The base class of what rclcpp_components_register_node registers.
COMPONENT = "rclcpp_components::NodeFactory"

_SHOWN = 5


def builds(workspace: Workspace) -> dict[str, Build]:
    """The build of every package, by name; of two packages with one name, the first by path."""
    tree = PathTree(workspace)
    found: dict[str, Build] = {}
    for package in workspace.packages:
        if package.name not in found:
            try:
                found[package.name] = build_of(workspace, package, tree)
            except FAULTS as err:
                message = fault("the build files of the package could not be read", err)
                found[package.name] = Build(
                    package=package.name, problems=(Problem(f"{_base(package)}package.xml", message),)
                )
    return linked(found, frozenset(package.name for package in workspace.packages if package.ros == 1))


@once
def _by_package(files: tuple[SourceFile, ...]) -> Mapping[str | None, Sequence[SourceFile]]:
    found: dict[str | None, list[SourceFile]] = {}
    for file in files:
        found.setdefault(file.package, []).append(file)
    return found


def build_of(workspace: Workspace, package: Package, tree: PathTree | None = None) -> Build:
    """All of one package, read and never run. What cannot be known or read is among its problems; nothing is raised.

    *tree* may be given where several packages of one workspace are asked for.
    """
    tree = PathTree(workspace) if tree is None else tree
    own = [file for file in _by_package(workspace.files).get(package.name, ()) if _within(file.path, package.path)]
    problems: list[Problem] = []
    cmake = f"{_base(package)}CMakeLists.txt"
    state = follow(tree, package) if tree.is_file(cmake) else CMakeState(tree, package)
    problems += [*state.problems, *_hidden(state)]
    setup = Setup()
    if tree.is_file(f"{_base(package)}setup.py"):
        setup = read_setup(tree, package)
        problems += setup.problems
    is_setup_alone = package.build_type == "ament_python" and tree.is_file(f"{_base(package)}setup.py")
    installed = [*(() if is_setup_alone else _installed(state)), *setup.installed]  # colcon runs no CMake for it
    plugins = _plugins(tree, package, state, problems)
    interfaces = _interfaces(workspace, [f.path for f in own if f.language == "interface"], package, state, problems)
    python = [file.path for file in own if file.language == "python"]
    roots = dict(setup.roots)
    roots.update(state.python_packages)
    flags = state.get("CMAKE_CXX_FLAGS") or ""
    return Build(
        package=package.name,
        targets=tuple(_target(made, package) for made in state.targets.values()),
        installed=tuple(installed),
        plugins=tuple(plugins),
        configs=tuple(_configs(workspace, package, state, problems)),
        interfaces=tuple(interfaces),
        entry_points=setup.entry_points,
        refused_entries=setup.refused_entries,
        distribution=setup.distribution,
        scripts=_scripts(workspace, package, python, installed),
        python_roots=tuple(sorted(roots.items())),
        defined=_defined(state),
        flags=written(flags),
        are_flags_known=MAYBE not in flags,
        parameter_libraries=_parameter_libraries(tree, package, state, setup),
        problems=tuple(sorted(set(problems), key=lambda p: (p.path, p.line or 0, p.message))),
        commands=tuple(state.commands),
        written=written_files(state),
        python_packages=setup.packages,
        are_python_packages_all=setup.are_packages_all,
        script_directories=tuple(
            (section, *place)
            for section, place in script_directories(workspace.text(f"{_base(package)}setup.cfg")).items()
        ),
    )


def _defined(state: CMakeState) -> tuple[str, ...]:
    flags = " ".join(state.get(name) or "" for name in ("CMAKE_CXX_FLAGS", "CMAKE_C_FLAGS"))
    return tuple(sorted({*state.defined, *FLAG.findall(flags)}))


def _base(package: Package) -> str:
    return "" if package.path == "." else f"{package.path}/"


def _within(path: str, directory: str) -> bool:
    return directory == "." or path.startswith(f"{directory}/")


def _hidden(state: CMakeState) -> list[Problem]:
    """A problem for each construct that is not decided and around something."""
    found = []
    for doubt, things in islice(state.hidden.items(), MAX_PROBLEMS):
        names = list(things)
        shown = ", ".join(names[:_SHOWN]) + (f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else "")
        message = f"whether ({doubt.text}) holds is only known in a build; taken as possible: {shown}"
        found.append(Problem(doubt.path, message[:MAX_MESSAGE], doubt.line))
    return found


def _target(made: CMakeTarget, package: Package) -> Target:
    is_library = made.kind == "library"
    properties = made.properties
    return Target(
        name=made.name,
        package=package.name,
        kind=made.kind,
        output=properties.get("OUTPUT_NAME", made.name),
        location=made.location,
        sources=tuple(made.sources),
        links=tuple(name for name in made.links if name != made.name),
        is_installed=made.is_installed,
        is_conditional=made.is_conditional,
        is_test=made.is_test,
        conditional_sources=tuple(path for path, certain in made.sources.items() if not certain),
        prefix=properties.get("PREFIX", "lib" if is_library else ""),
        suffix=properties.get("SUFFIX", ".so" if is_library else ""),
        component=properties.get("COMPONENT", ""),
    )


def _installed(state: CMakeState) -> list[Installed]:
    return [
        Installed(
            path=path, kind=kind, package=state.package.name, destination=destination, location=location, name=name
        )
        for (path, kind, destination, name), location in state.installed.items()
    ]


def _plugins(tree: PathTree, package: Package, state: CMakeState, problems: list[Problem]) -> list[PluginClass]:
    """Of the descriptions that the manifest or CMake export, and the components that CMake registers."""
    exported, missing = exported_descriptions(tree, package)
    if not state.plugin_files:  # ROS 2: what CMake exports counts, and manifests keep stale names
        problems += missing
    paths = dict.fromkeys([*(path for path, _ in exported), *state.plugin_files])
    found: list[PluginClass] = []
    for path in paths:
        if not tree.is_file(path):
            where = state.plugin_files[path]
            problems.append(Problem(where.path, f"the plug-in description {path} is not among the files", where.line))
            continue
        classes, bad = read_plugins(path, tree.workspace.text(path), package.name)
        found += classes
        problems += bad
    for name, library, location in state.components:
        found.append(
            PluginClass(name=name, type=name, base=COMPONENT, library=library, package=package.name, location=location)
        )
    return found


def _parameter_libraries(
    tree: PathTree, package: Package, state: CMakeState, setup: Setup
) -> tuple[ParameterLibrary, ...]:
    """Those that CMake and setup.py name, in that order."""
    named = [(*key, location) for key, location in state.parameter_libraries.items()]
    named += [(name, path, "python", location) for name, path, location in setup.parameter_modules]
    return tuple(
        ParameterLibrary(name=name, package=package.name, path=path, language=language, location=location)
        for name, path, language, location in named
        if tree.is_file(path)
    )


def _configs(workspace: Workspace, package: Package, state: CMakeState, problems: list[Problem]) -> list[ConfigFile]:
    """Of the .cfg files that CMake names."""
    found = []
    for path, where in state.configs.items():
        text = workspace.text(path)
        if not text:
            message = f"{path} is not in the workspace; its parameters are missing"
            problems.append(Problem(where.path, message, where.line))
            continue
        config, bad = read_config(path, text, package.name)
        problems += bad
        if config is not None:
            found.append(config)
    return found


def _interfaces(
    workspace: Workspace, paths: list[str], package: Package, state: CMakeState, problems: list[Problem]
) -> list[Interface]:
    """All definitions in the package, those that CMake does not name marked as not generated."""
    found = []
    for path in sorted({*paths, *state.interfaces}):
        is_generated = path in state.interfaces or not state.declares_interfaces
        made, bad = read_interface(path, workspace.text(path), package.name, is_generated=is_generated)
        found.append(made)
        problems += bad
    return found


def _scripts(workspace: Workspace, package: Package, paths: list[str], installed: list[Installed]) -> tuple[str, ...]:
    """Python files that are installed as programs, or begin with a shebang; setup.py and their like are none."""
    found = {thing.path for thing in installed if thing.kind == "program" and thing.path in paths}
    for path in paths:
        is_other = path.endswith((".cfg", ".launch.py", "__init__.py")) or path == f"{_base(package)}setup.py"
        if not is_other and script_language(workspace.text(path)[:HEAD].encode()) == "python":
            found.add(path)
    return tuple(sorted(found))
