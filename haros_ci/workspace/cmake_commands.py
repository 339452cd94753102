# SPDX-License-Identifier: Apache-2.0
"""CMake's commands that change variables, and the table of all commands that are followed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from haros_ci.model.digits import whole_number
from haros_ci.workspace.cmake_ament import AMENT_COMMANDS
from haros_ci.workspace.cmake_configured import CONFIGURING
from haros_ci.workspace.cmake_files import FILE_COMMANDS
from haros_ci.workspace.cmake_install import INSTALL_COMMANDS
from haros_ci.workspace.cmake_keywords import under
from haros_ci.workspace.cmake_lists import run_list
from haros_ci.workspace.cmake_math import evaluate_math
from haros_ci.workspace.cmake_parse import ParsedCommand
from haros_ci.workspace.cmake_state import CMakeState, EvaluatedCommand
from haros_ci.workspace.cmake_strings import run_string
from haros_ci.workspace.cmake_targets import TARGET_COMMANDS, taken_for_known
from haros_ci.workspace.cmake_words import absolute, is_certain, join_list, split_list, unknown

#: Makers of targets that are no part of what a package offers.
_HARMLESS = frozenset(("add_custom_target", "add_custom_command", "rosidl_target_interfaces", "add_launch_test"))
_MAKING = ("add_executable", "add_library", "add_node", "add_nodelet", "add_component", "add_plugin", "register_node")


def note_unknown(state: CMakeState, command: ParsedCommand, call: EvaluatedCommand) -> None:
    """A problem, once, for a command that is not known but by its name makes targets; all others change nothing here.

    Such names contain ``add_executable``, ``add_library``, ``add_node``, ``add_nodelet``, ``add_component``,
    ``add_plugin`` or ``register_node``. One that ends in ``_add_executable`` or ``_add_library``, as ``rtmbuild_add_executable``, and is given
    a name and sources of the workspace, is taken for the command of CMake that it ends in, and so the problem says.
    """
    name = command.name
    state.spend()
    if name in _HARMLESS or not any(word in name for word in _MAKING):
        return
    known = taken_for_known(state, call)
    if name in state.noted:
        return
    state.noted.add(name)
    what = f"it is taken for {known}()" if known else "what it builds is missing from the analysis"
    state.problem(state.where(command), f"{name}() is not known; {what}")


def _set(state: CMakeState, call: EvaluatedCommand) -> None:
    if not call.words:
        return
    name, values = call.words[0], call.words[1:]
    if name.startswith("ENV{") and name.endswith("}"):
        state.environment[name[4:-1]] = values[0] if values else ""
        return
    if "CACHE" in values and values.index("CACHE") + 2 < len(values) + 1 and not call.quoted[values.index("CACHE") + 1]:
        at = values.index("CACHE")
        if "FORCE" in values[at:] or state.cache.get(name) is None:
            state.put(name, join_list(values[:at]), state.cache)
            if name in state.scopes[-1]:  # CMP0126, as of old
                state.put(name, None)
        return
    scope = state.scopes[-1]
    if values and values[-1] == "PARENT_SCOPE":
        values = values[:-1]
        if len(state.scopes) < 2:
            return
        scope = state.scopes[-2]
    state.put(name, join_list(values) if values else None, scope)


def _unset(state: CMakeState, call: EvaluatedCommand) -> None:
    name, options = call.words[0] if call.words else "", call.words[1:]
    if name.startswith("ENV{"):
        state.environment.pop(name[4:-1], None)
    elif "CACHE" in options:
        state.put(name, None, state.cache)
    elif "PARENT_SCOPE" not in options:
        state.put(name, None)
    elif len(state.scopes) > 1:
        state.put(name, None, state.scopes[-2])


def _option(state: CMakeState, call: EvaluatedCommand) -> None:
    """option(name help value): what nobody set has its default, OFF."""
    if call.words and state.get(call.words[0]) is None:
        state.put(call.words[0], call.words[2] if len(call.words) > 2 else "OFF", state.cache)


def _project(state: CMakeState, call: EvaluatedCommand) -> None:
    if not call.words:
        return
    name = call.words[0]
    arguments = under(call.words[1:], (), ("VERSION", "DESCRIPTION", "HOMEPAGE_URL"), ("LANGUAGES",))
    here = state.get("CMAKE_CURRENT_SOURCE_DIR") or absolute(state.package.path)
    binary = state.get("CMAKE_CURRENT_BINARY_DIR") or ""
    values = {"PROJECT_NAME": name, "PROJECT_SOURCE_DIR": here, "PROJECT_BINARY_DIR": binary}
    values |= {f"{name}_SOURCE_DIR": here, f"{name}_BINARY_DIR": binary}
    version = arguments.get("VERSION", [""])
    values |= {"PROJECT_VERSION": version[0] if version else "", f"{name}_VERSION": version[0] if version else ""}
    if state.get("CMAKE_PROJECT_NAME") is None:
        values["CMAKE_PROJECT_NAME"] = name
    for key, value in values.items():
        state.put(key, value)


def _math(state: CMakeState, call: EvaluatedCommand) -> None:
    if len(call.words) < 3 or call.words[0].upper() != "EXPR":
        return
    value = evaluate_math(call.words[2]) if is_certain(call.words[2]) else None
    if value is None:
        state.put(call.words[1], unknown(call.words[1]))
    elif "HEXADECIMAL" in call.words:
        state.put(call.words[1], hex(value))
    else:
        state.put(call.words[1], str(value))


_FIND_FLAGS = ("EXACT", "QUIET", "REQUIRED", "MODULE", "CONFIG", "NO_MODULE", "NO_POLICY_SCOPE", "GLOBAL")
_FIND_LISTS = ("COMPONENTS", "OPTIONAL_COMPONENTS", "NAMES", "CONFIGS", "HINTS", "PATHS", "PATH_SUFFIXES")


def find_package(state: CMakeState, call: EvaluatedCommand) -> None:
    """The variables that find_package sets are unknown, but that a required package was found."""
    if not call.words or not is_certain(call.words[0]):
        return
    name = call.words[0]
    arguments = under(call.words[1:], _FIND_FLAGS, (), _FIND_LISTS)
    is_required = "REQUIRED" in arguments
    components = [*arguments.get("REQUIRED", []), *arguments.get("COMPONENTS", [])]
    if is_required:
        components += [word for word in arguments[""] if not word[:1].isdigit() and "COMPONENTS" not in arguments]
    if name in _BUILD_TOOLS and not is_required and state.package.ros not in (None, _BUILD_TOOLS[name]):
        state.put(f"{name}_FOUND", "FALSE")
        return
    _found(state, name, is_required or (name in _BUILD_TOOLS and state.package.ros is not None))
    if name == "catkin":
        for component in components:
            _found(state, component, is_required)


#: The ROS in which a build tool is sure to be found.
_BUILD_TOOLS = {"catkin": 1, "ament_cmake": 2, "ament_cmake_auto": 2}


def _found(state: CMakeState, name: str, is_certainly: bool) -> None:
    state.unknown_prefixes.update((name, name.upper()))
    extras = state.tree.extras(name) if name != state.package.name else None
    if is_certainly or extras is not None:
        state.put(f"{name}_FOUND", "TRUE")
        state.put(f"{name.upper()}_FOUND", "TRUE")
    if extras and name not in state.lent:
        state.lent.add(name)
        state.pending += [(path, directory, name) for path, directory in extras]


def _prefix(state: CMakeState, call: EvaluatedCommand) -> None:
    """pkg_check_modules(PREFIX ...): all below the prefix is unknown."""
    if call.words:
        state.unknown_prefixes.add(call.words[0])
        if "REQUIRED" in call.words:
            state.put(f"{call.words[0]}_FOUND", "TRUE")


def _auto_find(state: CMakeState, _: EvaluatedCommand) -> None:
    """ament_auto_find_build_dependencies(): finds what the manifest names."""
    for dependency in state.package.dependencies:
        if dependency.kind in ("depend", "build_depend", "buildtool_depend", "build_export_depend"):
            _found(state, dependency.name, True)
            if dependency.kind != "buildtool_depend" and state.tree.has_package(dependency.name):
                state.auto_found[dependency.name] = None


def _first_unknown(state: CMakeState, call: EvaluatedCommand) -> None:
    if call.words and state.get(call.words[0]) is None:
        state.put(call.words[0], unknown(call.words[0]))


def _last_unknown(state: CMakeState, call: EvaluatedCommand) -> None:
    if call.words:
        state.put(call.words[-1], unknown(call.words[-1]))


def _outputs_unknown(state: CMakeState, call: EvaluatedCommand) -> None:
    """execute_process and its like: variables behind these keywords."""
    for keyword, name in zip(call.words, call.words[1:], strict=False):
        if keyword in ("OUTPUT_VARIABLE", "RESULT_VARIABLE", "ERROR_VARIABLE", "RESULTS_VARIABLE", "RESULT"):
            state.put(name, unknown(name))


def _parse_arguments(state: CMakeState, call: EvaluatedCommand) -> None:
    """cmake_parse_arguments(prefix options one multi args...) and cmake_parse_arguments(PARSE_ARGV n prefix ...)."""
    words = call.words
    passed: list[str]
    if words[:1] == ["PARSE_ARGV"] and len(words) >= 6 and (first := whole_number(words[1])) is not None:
        words = words[2:]
        total = min(whole_number(state.get("ARGC") or "0") or 0, 10_000)
        passed = [state.get(f"ARGV{index}") or "" for index in range(min(first, 1000), total)]
    else:
        passed = [element for word in words[4:] for element in split_list(word) if element]
    if len(words) < 4:
        return
    prefix = words[0]
    flags, single, multiple = (split_list(word) for word in words[1:4])
    found = under(passed, flags, single, multiple)
    for flag in flags:
        state.put(f"{prefix}_{flag}", "TRUE" if flag in found else "FALSE")
    for name in [*single, *multiple]:
        state.put(f"{prefix}_{name}", join_list(found[name]) if found.get(name) else None)
    state.put(f"{prefix}_UNPARSED_ARGUMENTS", join_list(found[""]) if found[""] else None)


def _include_guard(state: CMakeState, _: EvaluatedCommand) -> None:
    state.guarded.add(state.file)


_Run = Callable[[CMakeState, EvaluatedCommand], None]
COMMANDS: Mapping[str, _Run] = MappingProxyType(
    {
        "set": _set,
        "unset": _unset,
        "option": _option,
        "project": _project,
        "math": _math,
        "list": run_list,
        "string": run_string,
        "find_package": find_package,
        "pkg_check_modules": _prefix,
        "pkg_search_module": _prefix,
        "ament_auto_find_build_dependencies": _auto_find,
        "cmake_parse_arguments": _parse_arguments,
        "include_guard": _include_guard,
        **dict.fromkeys(("find_library", "find_path", "find_file", "find_program"), _first_unknown),
        **dict.fromkeys(("try_compile", "try_run", "get_property", "get_target_property"), _first_unknown),
        **dict.fromkeys(("get_directory_property", "get_source_file_property", "get_cmake_property"), _first_unknown),
        **dict.fromkeys(("check_cxx_compiler_flag", "check_c_compiler_flag", "check_include_file"), _last_unknown),
        **dict.fromkeys(("check_include_files", "check_include_file_cxx", "check_symbol_exists"), _last_unknown),
        **dict.fromkeys(("check_function_exists", "check_cxx_source_compiles", "check_type_size"), _last_unknown),
        **dict.fromkeys(("check_library_exists", "check_c_source_compiles", "check_cxx_symbol_exists"), _last_unknown),
        **dict.fromkeys(("execute_process", "cmake_host_system_information"), _outputs_unknown),
        **FILE_COMMANDS,
        **CONFIGURING,
        **TARGET_COMMANDS,
        **AMENT_COMMANDS,
        **INSTALL_COMMANDS,
    }
)
#: Commands that do nothing but change variables.
UNREMARKABLE = frozenset(("set", "unset", "math", "list", "string", "cmake_parse_arguments", "include_guard"))
#: What commands of packages outside the workspace come to; a definition in the workspace has precedence.
#: autoware_package (autoware_cmake) sets options of the compiler and finds what the manifest names.
SUMMARIES: Mapping[str, _Run] = MappingProxyType(
    {
        "autoware_package": _auto_find,
        "autoware_ament_auto_package": INSTALL_COMMANDS["ament_auto_package"],
    }
)
