# SPDX-License-Identifier: Apache-2.0
"""CMake's commands of ament and of what is built with it that make targets from a manifest, or from YAML."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from haros_ci.workspace.cmake_keywords import under
from haros_ci.workspace.cmake_state import CMakeState, EvaluatedCommand
from haros_ci.workspace.cmake_targets import KINDS, SKIPPED, make_target, own_sources, target_name
from haros_ci.workspace.cmake_words import bare, inside, is_certain, place, readable

_CODE = ("c", "cc", "cpp", "cxx")


def _auto(kind: str) -> Callable[[CMakeState, EvaluatedCommand], None]:
    """ament_auto_add_executable and ament_auto_add_library (ament_cmake_auto).

    DIRECTORY stands for all source files below it. The target is linked with the libraries that were made like it
    before, unless NO_TARGET_LINK_LIBRARIES is there, and with the packages that were found for the manifest.
    """

    def run(state: CMakeState, call: EvaluatedCommand) -> None:
        name = target_name(state, call, kind)
        if not name:
            return
        made_kind = kind
        words = call.words[1:]
        if kind == "library":
            made_kind = next((KINDS[bare(word)] for word in words if bare(word) in KINDS), kind)
            words = [word for word in words if bare(word) not in KINDS]
        keywords = under(words, SKIPPED, ("DIRECTORY",), ())
        sources = list(keywords[""])
        for directory in keywords.get("DIRECTORY", []):
            inner = inside(place(bare(directory), state.source_directory())) if is_certain(directory) else None
            before = state.tree.looked_at
            for suffix in _CODE if inner is not None else ():
                paths = state.tree.glob(f"{inner}/*.{suffix}", recurse=True, directories=False)
                sources += [f"{bare(directory)}{path[len(inner or '') :]}" for path in paths]
            state.spend(5 + (state.tree.looked_at - before) // 10)
        made = make_target(state, call, made_kind, name)
        own_sources(state, call, made, sources)
        if "NO_TARGET_LINK_LIBRARIES" not in keywords:
            for other in state.targets.values():
                if other is not made and "AUTO" in other.properties and other.kind != "executable":
                    made.links.setdefault(other.name, not state.doubts)
        for dependency in state.auto_found:
            made.links.setdefault(libraries_of(dependency), not state.doubts)
        made.properties["AUTO"] = "1"

    return run


def libraries_of(package: str) -> str:
    """How the libraries of another package stand among a target's links until that package is known."""
    return f"${{{package}_LIBRARIES}}"


def _dependencies(state: CMakeState, call: EvaluatedCommand) -> None:
    """ament_target_dependencies(target [SYSTEM] [PUBLIC | INTERFACE] packages...)."""
    made = state.targets.get(call.words[0]) if call.words else None
    if made is None:
        return
    for word in call.words[1:]:
        name = bare(word)
        if is_certain(name) and name not in ("SYSTEM", "PUBLIC", "INTERFACE", "PRIVATE"):
            link = libraries_of(name)
            made.links[link] = made.links.get(link, False) or (name == word and not state.doubts)


def _parameter_library(language: str) -> Callable[[CMakeState, EvaluatedCommand], None]:
    """generate_parameter_library(target yaml [header]) and generate_parameter_module(module yaml [validation])."""

    def run(state: CMakeState, call: EvaluatedCommand) -> None:
        name = target_name(state, call, "parameter library")
        if not name or len(call.words) < 2:
            return
        make_target(state, call, "interface", name)
        word = bare(call.words[1])
        path = inside(place(word, state.source_directory())) if is_certain(word) else None
        if path is not None and state.tree.is_file(path):
            state.parameter_libraries.setdefault((name, path, language), call.location)
        else:
            why = "not among the files" if is_certain(word) else "only known in a build"
            state.missing(call, f"{name}: the parameters in {readable(word)} are {why}; they are missing")

    return run


AMENT_COMMANDS: Mapping[str, Callable[[CMakeState, EvaluatedCommand], None]] = MappingProxyType(
    {
        "ament_auto_add_executable": _auto("executable"),
        "ament_auto_add_library": _auto("library"),
        "ament_target_dependencies": _dependencies,
        "generate_parameter_library": _parameter_library("cpp"),
        "generate_parameter_module": _parameter_library("python"),
    }
)
