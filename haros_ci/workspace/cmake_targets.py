# SPDX-License-Identifier: Apache-2.0
"""CMake's commands that make executables and libraries, of CMake itself and of ROS's build tools."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from itertools import chain
from types import MappingProxyType

from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.regex import regex
from haros_ci.workspace.cmake_genex import resolved
from haros_ci.workspace.cmake_keywords import under
from haros_ci.workspace.cmake_state import CMakeState, CMakeTarget, EvaluatedCommand
from haros_ci.workspace.cmake_words import MAYBE, UNKNOWN, bare, inside, is_certain, place, readable, split_list

#: Targets of one package; the largest packages of ROS have some dozens. What is asked of each looks at the others.
MAX_TARGETS = 1_000
_FULL = " too many targets"
_CODE = (".c", ".cc", ".cpp", ".cxx", ".c++", ".cu", ".m", ".mm")
KINDS = {"STATIC": "library", "SHARED": "library", "MODULE": "library", "UNKNOWN": "library"}
KINDS |= {"OBJECT": "object", "INTERFACE": "interface"}
SKIPPED = frozenset(("EXCLUDE_FROM_ALL", "WIN32", "MACOSX_BUNDLE", "GLOBAL", "MANUAL_FINALIZATION"))
SKIPPED |= {"NO_TARGET_LINK_LIBRARIES", "SKIP_LINKING_MAIN_LIBRARIES", "SKIP_TEST", "NO_EXTRAS", "THIN_LTO", "SYSTEM"}
#: Keywords of test and CUDA commands behind which there are no sources any more.
_SINGLE = ("TIMEOUT", "WORKING_DIRECTORY", "RUNNER", "COMMAND")
_LISTS = ("OPTIONS", "ENV", "APPEND_ENV", "APPEND_LIBRARY_DIRS", "DEPENDENCIES", "ARGS")


def target_name(state: CMakeState, call: EvaluatedCommand, what: str) -> str:
    """The target's name, "" with a problem if it depends on what is not known."""
    if not call.words:
        return ""
    name = call.words[0]
    if is_certain(name):
        return name
    written = call.command.arguments[0].text
    message = f"the name of this {what}, {written}, is only known in a build; it is missing"
    state.problem(call.location, message)
    return ""


def make_target(
    state: CMakeState, call: EvaluatedCommand, kind: str, name: str, *, is_test: bool = False
) -> CMakeTarget:
    """The target of that name, new or, where branches make it twice, the one there is."""
    is_test = is_test or state.testing > 0
    if not is_test:
        state.record(f"{kind} {name}")
    made = state.targets.get(name)
    if made is None:
        made = CMakeTarget(name, kind, call.location, is_conditional=bool(state.doubts), is_test=is_test)
        if call.name.startswith("cs_"):
            made.properties["SIMPLE"] = "1"
        if len(state.targets) < MAX_TARGETS:
            state.targets[name] = made
        elif state.noted.isdisjoint((_FULL,)):
            state.noted.add(_FULL)
            message = f"more than {MAX_TARGETS} targets of one package: the rest is ignored"
            state.problems[Problem(call.location.path, message, call.location.line)] = None
    else:
        made.sources = dict.fromkeys(made.sources, False)
    return made


def add_sources(
    state: CMakeState, made: CMakeTarget, words: list[str], location: Location, *, is_certainly: bool = True
) -> None:
    """Add what *words* name, relative to the directory being read; a problem for what is not in the workspace.

    In quotes a list is one word, and so the property of the target is the same list (add_library(t "${SOURCES}")).
    """
    for word in chain.from_iterable(map(split_list, resolved(words))):
        element = bare(word)
        certain = is_certainly and element == word
        if element.startswith("$<"):
            made.links.setdefault(element[2:-1], certain)
            continue
        if UNKNOWN in element or MAYBE in element:
            message = f"{made.name}: {readable(element)} is only known in a build; it is not among the sources"
            state.problem(location, message)
            continue
        path = inside(place(element, state.source_directory()))
        if path is not None and not state.tree.is_file(path) and "." not in path.rpartition("/")[2]:
            path = next((path + suffix for suffix in _CODE if path + suffix in state.tree.files), path)
        if path is not None and state.tree.is_file(path):
            made.sources[path] = made.sources.get(path, False) or certain
        elif element.endswith(_CODE) and not state.doubts and not made.is_test:
            message = f"{made.name}: {readable(element)} is not in the workspace (generated?); its code is not seen"
            state.problem(location, message)


def own_sources(state: CMakeState, call: EvaluatedCommand, made: CMakeTarget, words: list[str]) -> None:
    is_new = not made.sources and made.location == call.location
    kept = [word for word in words if bare(word) not in SKIPPED]
    add_sources(state, made, kept, call.location, is_certainly=is_new or not state.doubts)


def _executable(state: CMakeState, call: EvaluatedCommand) -> None:
    name = target_name(state, call, "executable")
    if not name:
        return
    rest = [bare(word) for word in call.words[1:2]]
    if rest in (["ALIAS"], ["IMPORTED"]):
        _other(state, call, name, rest[0])
        return
    made = make_target(state, call, "executable", name)
    own_sources(state, call, made, under(call.words[1:], (), _SINGLE, _LISTS)[""])


def _library(state: CMakeState, call: EvaluatedCommand) -> None:
    name = target_name(state, call, "library")
    if not name:
        return
    kind = "library"
    rest = call.words[1:]
    while rest and bare(rest[0]) in KINDS:
        kind = KINDS[bare(rest[0])]
        rest = rest[1:]
    if rest and bare(rest[0]) in ("ALIAS", "IMPORTED"):
        _other(state, call, name, bare(rest[0]))
        return
    made = make_target(state, call, kind, name)
    own_sources(state, call, made, under(rest, (), _SINGLE, _LISTS)[""])


def _other(state: CMakeState, call: EvaluatedCommand, name: str, kind: str) -> None:
    made = make_target(state, call, kind.lower(), name)
    if kind == "ALIAS" and len(call.words) > 2:
        made.links[bare(call.words[2])] = is_certain(call.words[2])


def _test(skipped: int) -> Callable[[CMakeState, EvaluatedCommand], None]:
    """Commands that make a test's executable; *skipped* words stand between its name and the sources."""

    def run(state: CMakeState, call: EvaluatedCommand) -> None:
        name = target_name(state, call, "test")
        if name:
            made = make_target(state, call, "executable", name, is_test=True)
            own_sources(state, call, made, under(call.words[1 + skipped :], (), _SINGLE, _LISTS)[""])

    return run


_SCOPES = ("PRIVATE", "PUBLIC", "INTERFACE", "LINK_PRIVATE", "LINK_PUBLIC", "LINK_INTERFACE_LIBRARIES")


def _target_sources(state: CMakeState, call: EvaluatedCommand) -> None:
    made = state.targets.get(call.words[0]) if call.words else None
    if made is None:
        return
    keywords = under(call.words[1:], _SCOPES, ("FILE_SET", "TYPE"), ("BASE_DIRS", "FILES"))
    if not made.is_conditional and not made.is_test:
        state.record(f"sources of {made.name}")
    add_sources(state, made, keywords[""], call.location, is_certainly=not state.doubts or made.is_conditional)


def _link(state: CMakeState, call: EvaluatedCommand) -> None:
    """target_link_libraries: names as evaluated; references that only a build resolves stay as ``${NAME}``."""
    made = state.targets.get(call.words[0]) if call.words else None
    if made is None:
        return
    for word in resolved(call.words[1:]):
        element = bare(word)
        if element in _SCOPES or element in ("debug", "optimized", "general") or element in ("", UNKNOWN):
            continue
        name = element[2:-1] if element.startswith("$<") else readable(element)
        certain = element == word and not state.doubts
        made.links[name] = made.links.get(name, False) or certain


def _properties(state: CMakeState, call: EvaluatedCommand) -> None:
    """set_target_properties(targets PROPERTIES name value ...)."""
    if "PROPERTIES" not in call.words:
        return
    at = call.words.index("PROPERTIES")
    pairs = call.words[at + 1 :]
    for name in call.words[:at]:
        made = state.targets.get(name)
        if made is not None:
            for key, value in zip(pairs[::2], pairs[1::2], strict=False):
                _property(state, call, made, key, value)


def _property(state: CMakeState, call: EvaluatedCommand, made: CMakeTarget, key: str, value: str) -> None:
    """Note what the file's name is made of; if that is not known, the target's name stays, with a problem."""
    if key not in ("OUTPUT_NAME", "PREFIX", "SUFFIX", "LIBRARY_OUTPUT_NAME", "RUNTIME_OUTPUT_NAME"):
        return
    if key.endswith("_OUTPUT_NAME") and key.startswith("LIBRARY" if made.kind == "executable" else "RUNTIME"):
        return
    if not is_certain(value) or (state.doubts and not made.is_conditional):
        message = f"{made.name}: its {key} is only known in a build; the file is taken to be named after the target"
        state.problem(call.location, message)
        return
    made.properties["OUTPUT_NAME" if key.endswith("OUTPUT_NAME") else key] = value


def _set_property(state: CMakeState, call: EvaluatedCommand) -> None:
    """set_property(TARGET names PROPERTY key value)."""
    words = call.words
    if words[:1] != ["TARGET"] or "PROPERTY" not in words[:-2]:
        return
    at = words.index("PROPERTY")
    for name in words[1:at]:
        made = state.targets.get(name)
        if made is not None:
            _property(state, call, made, words[at + 1], words[at + 2])


def _components(state: CMakeState, call: EvaluatedCommand) -> None:
    """rclcpp_components_register_node(lib PLUGIN class EXECUTABLE name) and ..._nodes(lib class...)."""
    if not call.words:
        return
    library = call.words[0]
    single = ("PLUGIN", "EXECUTABLE", "EXECUTOR", "RESOURCE_INDEX")
    keywords = under(call.words[1:], (), single, ())
    needed = [library, *keywords[""], *keywords.get("PLUGIN", []), *keywords.get("EXECUTABLE", [])]
    vague = next((word for word in needed if not is_certain(word)), None)
    if vague is not None:
        message = f"{call.name}: {readable(vague)} is only known in a build; the component is missing"
        state.problem(call.location, message)
        return
    for name in [*keywords.get("PLUGIN", []), *(keywords[""] if call.name.endswith("nodes") else [])]:
        state.components.append((name, library, call.location))
    for name in keywords.get("EXECUTABLE", []):
        made = make_target(state, call, "executable", name)
        made.links[library] = True
        made.properties["COMPONENT"] = next(iter(keywords.get("PLUGIN", [])), "")
        made.is_installed = True


#: ``-DX``, ``-DX=1`` and, where only definitions are taken, ``X=1`` (cmake.org: add_compile_definitions).
FLAG = regex(r"(?:^|[\s;\"'])[-/]D\s*([A-Za-z_]\w*)")
_DEFINITION = regex(r"(?:-D)?([A-Za-z_]\w*)(?:=|$)")


def _definitions(state: CMakeState, call: EvaluatedCommand) -> None:
    """target_compile_definitions and add_compile_definitions: macros whose values only a build knows for sure."""
    words = call.words[1:] if call.name.startswith("target") else call.words
    found = (_DEFINITION.match(bare(word)) for word in resolved(words) if word not in _SCOPES)
    state.defined.update(match[1] for match in found if match)


def _options(state: CMakeState, call: EvaluatedCommand) -> None:
    """Compiler options, among them definitions."""
    state.defined.update(name for word in resolved(call.words) for name in FLAG.findall(bare(word)))


TARGET_COMMANDS: Mapping[str, Callable[[CMakeState, EvaluatedCommand], None]] = MappingProxyType(
    {
        **dict.fromkeys(("add_executable", "cuda_add_executable", "hip_add_executable"), _executable),
        **dict.fromkeys(("rosbuild_add_executable", "cs_add_executable"), _executable),
        **dict.fromkeys(("qt_add_executable", "qt6_add_executable"), _executable),
        **dict.fromkeys(("add_library", "cuda_add_library", "qt_add_library", "qt6_add_library"), _library),
        **dict.fromkeys(("rosbuild_add_library", "cs_add_library", "hip_add_library"), _library),
        **dict.fromkeys(("pybind11_add_module", "python_add_library", "qt_add_plugin"), _library),
        **dict.fromkeys(("catkin_add_gtest", "catkin_add_gmock", "rosbuild_add_gtest", "cs_add_gtest"), _test(0)),
        **dict.fromkeys(("catkin_add_executable_with_gtest", "catkin_add_executable_with_gmock"), _test(0)),
        **dict.fromkeys(("ament_add_gtest", "ament_add_gmock", "ament_auto_add_gtest"), _test(0)),
        **dict.fromkeys(("ament_add_gtest_executable", "ament_add_gmock_executable"), _test(0)),
        **dict.fromkeys(("ament_add_ros_isolated_gtest", "ament_add_ros_isolated_gmock"), _test(0)),
        "ament_add_google_benchmark": _test(0),
        **dict.fromkeys(("add_rostest_gtest", "add_rostest_gmock"), _test(1)),
        "target_sources": _target_sources,
        "target_link_libraries": _link,
        **dict.fromkeys(("target_compile_definitions", "add_compile_definitions"), _definitions),
        **dict.fromkeys(("add_definitions", "add_compile_options", "target_compile_options"), _options),
        "set_target_properties": _properties,
        "set_property": _set_property,
        **dict.fromkeys(("rclcpp_components_register_node", "rclcpp_components_register_nodes"), _components),
    }
)


def taken_for_known(state: CMakeState, call: EvaluatedCommand) -> str:
    """The command of CMake that one which is not known is taken for, by the end of its name; "" for none.

    That is one which is given a name, then sources of the workspace among other words.
    """
    words = [bare(word) for word in call.words]
    if len(words) < 2 or not is_certain(words[0]) or not re.fullmatch(r"[\w.+-]+", words[0]):
        return ""
    places = (
        inside(place(word, state.source_directory())) for word in words[1:] if word.endswith(_CODE) and is_certain(word)
    )
    if not any(path is not None and state.tree.is_file(path) for path in places):
        return ""
    known = next((name for name in ("add_executable", "add_library") if call.name.endswith(f"_{name}")), "")
    if known:
        TARGET_COMMANDS[known](state, call)
        if words[0] in state.targets:
            state.targets[words[0]].is_installed = True  # nobody knows that it is not
    return known
