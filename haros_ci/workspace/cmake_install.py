# SPDX-License-Identifier: Apache-2.0
"""CMake's commands that install and declare: programs, directories, interfaces, configurations, Python packages."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Mapping
from types import MappingProxyType

from haros_ci.regex import regex
from haros_ci.workspace.cmake_configured import install_made
from haros_ci.workspace.cmake_keywords import under
from haros_ci.workspace.cmake_state import CMakeState, EvaluatedCommand
from haros_ci.workspace.cmake_words import bare, inside, is_certain, join_list, place, readable, split_list
from haros_ci.workspace.installed_beside import keeps_permissions
from haros_ci.workspace.tree import MAX_MATCHED

_ARTEFACTS = ("ARCHIVE", "LIBRARY", "RUNTIME", "OBJECTS", "FRAMEWORK", "BUNDLE", "PUBLIC_HEADER", "PRIVATE_HEADER")
_TARGET_FLAGS = (*_ARTEFACTS, "RESOURCE", "OPTIONAL", "EXCLUDE_FROM_ALL", "NAMELINK_ONLY", "NAMELINK_SKIP")
_SINGLE = ("DESTINATION", "EXPORT", "COMPONENT", "NAMELINK_COMPONENT", "RENAME", "TYPE", "PATTERN", "REGEX", "FILE_SET")
_LISTS = ("PERMISSIONS", "CONFIGURATIONS", "INCLUDES", "FILE_PERMISSIONS", "DIRECTORY_PERMISSIONS")
_FLAGS = ("OPTIONAL", "FILES_MATCHING", "USE_SOURCE_PERMISSIONS", "MESSAGE_NEVER", "EXCLUDE", "EXCLUDE_FROM_ALL")
_WHAT = {"PROGRAMS": "program", "FILES": "file", "DIRECTORY": "directory"}
_SLASHES = regex("/{2,}")
#: Where install(... TYPE t) puts things, by the GNU conventions.
_TYPES = {"BIN": "bin", "SBIN": "sbin", "LIB": "lib", "INCLUDE": "include", "SYSCONF": "etc", "DATA": "share"}


def _install(state: CMakeState, call: EvaluatedCommand) -> None:
    if not call.words:
        return
    what, rest = call.words[0], call.words[1:]
    if what == "TARGETS":
        _install_targets(state, under(rest, _TARGET_FLAGS, _SINGLE, _LISTS)[""])
    elif what in _WHAT:
        install_files(state, call, _WHAT[what], rest)


def _install_targets(state: CMakeState, names: list[str]) -> None:
    """Mark targets; one that is found by another name only (unknown) is left alone."""
    for name in names:
        made = state.targets.get(bare(name))
        if made is not None:
            made.is_installed = True


def install_files(state: CMakeState, call: EvaluatedCommand, kind: str, words: list[str]) -> None:
    """What install(FILES | PROGRAMS | DIRECTORY) names. A directory that ends in a slash, or in a dot, becomes its destination."""
    keywords = under(words, _FLAGS, _SINGLE, _LISTS)
    destination = readable(next(iter(keywords.get("DESTINATION", [])), ""))
    destination = tidy(destination) or _TYPES.get(next(iter(keywords.get("TYPE", [])), ""), "")
    renamed = next(iter(keywords.get("RENAME", [])), "")
    paths = keywords[""] if "PATTERN" not in keywords and "REGEX" not in keywords else _before_patterns(words)
    for word in paths:
        element = bare(word)
        if not is_certain(element) or "$<" in element:
            continue
        path = inside(place(element, state.source_directory()))
        if path is None:
            install_made(state, element, kind, destination, readable(renamed))
            continue
        base = path.rpartition("/")[2]
        if kind == "directory":
            is_content = element.endswith(("/", "/.")) or element == "."
            final = destination if is_content else f"{destination}/{base}".lstrip("/")
            state.installed.setdefault((path, kind, final, ""), call.location)
            if keeps_permissions(words):
                _programs_beside(state, call, path, final)
        else:
            state.installed.setdefault((path, kind, destination, readable(renamed) or base), call.location)


def _programs_beside(state: CMakeState, call: EvaluatedCommand, directory: str, destination: str) -> None:
    """The programs of a *directory* that lies outside of the package: ``ros2 run`` and rosrun look for them below ``lib/<package>``."""
    start, goal = state.package.path, f"lib/{state.package.name}"
    is_own = start == "." or f"{directory}/".startswith(f"{start}/") or f"{start}/".startswith(f"{directory}/")
    if is_own or not f"{destination}/".startswith(f"{goal}/"):
        return
    workspace = state.tree.workspace
    for path in state.tree.below(directory)[:MAX_MATCHED]:
        is_executable = workspace.executables is None or path in workspace.executables
        if is_executable and workspace.text(path).startswith("#!"):
            inner = posixpath.dirname(path[len(directory) + 1 :])
            final = posixpath.join(destination, inner) if inner else destination
            state.installed.setdefault((path, "program", final, posixpath.basename(path)), call.location)


def tidy(destination: str) -> str:
    """*destination* without doubled and trailing slashes."""
    return _SLASHES.sub("/", destination).rstrip("/")


def _before_patterns(words: list[str]) -> list[str]:
    """The files of an install() with PATTERN: what follows such a keyword belongs to it."""
    stop = min((i for i, word in enumerate(words) if word in (*_SINGLE, *_LISTS, *_FLAGS)), default=len(words))
    return words[:stop]


def _install_python(state: CMakeState, call: EvaluatedCommand) -> None:
    """catkin_install_python(PROGRAMS ... DESTINATION d)."""
    words = call.words[1:] if call.words[:1] in (["PROGRAMS"], ["FILES"]) else call.words
    install_files(state, call, "program", words)


#: Directories that cs_install() installs where they are there (catkin_simple-extras.cmake).
_SIMPLE_FOLDERS = ("launch", "rviz", "urdf", "meshes", "maps", "worlds", "Media", "param")


def _simple_install(state: CMakeState, call: EvaluatedCommand) -> None:
    """cs_install: what cs_add_* made, the targets named, the headers, and directories of common names (catkin_simple)."""
    for made in state.targets.values():
        if "SIMPLE" in made.properties or made.name in call.words:
            made.is_installed = True
    project = state.get("PROJECT_NAME") or state.package.name
    folders = {f"include/{project}": f"include/{state.package.name}"}
    folders |= {name: f"share/{state.package.name}/{name}" for name in _SIMPLE_FOLDERS}
    for name, destination in folders.items():
        path = inside(place(name, state.source_directory()))
        if path is not None and path in state.tree.directories:
            state.installed.setdefault((path, "directory", destination, ""), call.location)


def _simple_scripts(state: CMakeState, call: EvaluatedCommand) -> None:
    """cs_install_scripts(programs...)."""
    install_files(state, call, "program", [*call.words, "DESTINATION", f"lib/{state.package.name}"])


def _auto_package(state: CMakeState, call: EvaluatedCommand) -> None:
    """ament_auto_package: installs what ament_auto_add_* made, ``include``, and INSTALL_TO_SHARE directories."""
    keywords = under(call.words, ("INSTALL_TO_PATH", "NO_INSTALL"), (), ("INSTALL_TO_SHARE", "CONFIG_EXTRAS"))
    for made in state.targets.values():
        if "AUTO" in made.properties:
            made.is_installed = True
    headers = inside(place("include", state.source_directory()))
    if headers is not None and headers in state.tree.directories:
        state.installed.setdefault((headers, "directory", "include", ""), call.location)
    share = f"share/{state.package.name}"
    for word in keywords.get("INSTALL_TO_SHARE", []):
        path = inside(place(bare(word), state.source_directory())) if is_certain(bare(word)) else None
        if path is not None:
            final = f"{share}/{path.rpartition('/')[2]}"
            state.installed.setdefault((path, "directory", final, ""), call.location)


#: The directory, and ending, that these commands take definitions from.
_MESSAGE_KINDS = {
    "add_message_files": "msg",
    "add_service_files": "srv",
    "add_action_files": "action",
    "rosbuild_genmsg": "msg",
    "rosbuild_gensrv": "srv",
}


def _interface_files(state: CMakeState, call: EvaluatedCommand) -> None:
    """add_message_files and its like: FILES in DIRECTORY, by default all in ``msg``, ``srv``, ``action``."""
    suffix = _MESSAGE_KINDS[call.name]
    _generates(state, "generate_messages_cpp")
    keywords = under(call.words, ("NOINSTALL",), ("DIRECTORY", "BASE_DIR"), ("FILES",))
    directory = next(iter(keywords.get("DIRECTORY", [])), suffix)
    state.declares_interfaces = True
    if not is_certain(directory):
        return
    names = keywords.get("FILES")
    inner = inside(place(directory, state.source_directory()))
    if names is None and inner is not None:
        for path in state.tree.glob(f"{inner}/*.{suffix}", recurse=False, directories=False):
            state.interfaces.setdefault(path, call.location)
    for name in names or ():
        _declare(state, call, f"{directory}/{bare(name)}")


def _declare(state: CMakeState, call: EvaluatedCommand, word: str) -> None:
    path = inside(place(word, state.source_directory())) if is_certain(word) else None
    if path is None:
        state.problem(call.location, f"the interface {readable(word)} is only known in a build; it is missing")
    elif state.tree.is_file(path):
        state.interfaces.setdefault(path, call.location)
    else:
        state.missing(call, f"the interface {readable(word)} is not among the files")


def _generate_interfaces(state: CMakeState, call: EvaluatedCommand) -> None:
    """rosidl_generate_interfaces(target "msg/A.msg" ...); ``dir:file`` is a path, too."""
    flags = ("SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK", "ADD_LINTER_TESTS")
    keywords = under(call.words[1:], flags, ("LIBRARY_NAME",), ("DEPENDENCIES",))
    state.declares_interfaces = True
    for word in keywords[""]:
        _declare(state, call, bare(word).replace(":", "/"))


def _generates(state: CMakeState, what: str) -> None:
    """Add a target to those that catkin's macros name in ``<project>_EXPORTED_TARGETS`` (genmsg, dynamic_reconfigure)."""
    project = state.get("PROJECT_NAME") or state.package.name
    name = f"{project}_EXPORTED_TARGETS"
    made = split_list(state.get(name) or "")
    if f"{project}_{what}" not in made:
        state.put(name, join_list([*made, f"{project}_{what}"]))


def _typesupport(state: CMakeState, call: EvaluatedCommand) -> None:
    """rosidl_get_typesupport_target(variable target typesupport): the name of the target that generated code is linked by."""
    if len(call.words) > 2:
        state.put(call.words[0], f"{call.words[1]}__{call.words[2]}")


def _configs(state: CMakeState, call: EvaluatedCommand) -> None:
    """generate_dynamic_reconfigure_options(cfg...)."""
    _generates(state, "gencfg")
    for word in call.words:
        element = bare(word)
        path = inside(place(element, state.source_directory())) if is_certain(element) else None
        if path is not None:
            state.configs.setdefault(path, call.location)


def _python_package(state: CMakeState, call: EvaluatedCommand) -> None:
    """ament_python_install_package(name [PACKAGE_DIR dir])."""
    if call.words and is_certain(call.words[0]):
        single = ("PACKAGE_DIR", "VERSION", "SETUP_CFG", "DESTINATION", "SCRIPTS_DESTINATION")
        keywords = under(call.words[1:], (), single, ())
        directory = next(iter(keywords.get("PACKAGE_DIR", [])), call.words[0])
        path = inside(place(directory, state.source_directory())) if is_certain(directory) else None
        if path is not None:
            state.python_packages[call.words[0]] = path


def _plugin_file(state: CMakeState, call: EvaluatedCommand) -> None:
    """pluginlib_export_plugin_description_file(package file)."""
    if len(call.words) > 1 and is_certain(bare(call.words[1])):
        path = inside(place(bare(call.words[1]), state.source_directory()))
        if path is not None:
            state.plugin_files.setdefault(path, call.location)


INSTALL_COMMANDS: Mapping[str, Callable[[CMakeState, EvaluatedCommand], None]] = MappingProxyType(
    {
        "install": _install,
        "catkin_install_python": _install_python,
        "ament_auto_package": _auto_package,
        "cs_install": _simple_install,
        "cs_install_scripts": _simple_scripts,
        **dict.fromkeys(_MESSAGE_KINDS, _interface_files),
        "rosidl_generate_interfaces": _generate_interfaces,
        "rosidl_get_typesupport_target": _typesupport,
        "generate_dynamic_reconfigure_options": _configs,
        "ament_python_install_package": _python_package,
        "pluginlib_export_plugin_description_file": _plugin_file,
    }
)
