# SPDX-License-Identifier: Apache-2.0
"""Manifests, builds, dependencies, plug-ins, and edits of them."""

from __future__ import annotations

from haros_ci.checking.appearing import is_ignored, may_appear
from haros_ci.checking.cmake import OF_TARGETS, CMake, Install, Link
from haros_ci.checking.editing import (
    add_dependency,
    add_element,
    add_export,
    drop_element,
    drop_lines,
    insert_line,
    rename_element,
    set_attribute,
    set_text,
)
from haros_ci.checking.imports import imports_of
from haros_ci.checking.installing import install_directory, install_line, install_place, landings
from haros_ci.checking.manifests import (
    BUILD,
    EXEC,
    EXPORTED,
    applying,
    brings,
    build_types,
    exports,
    holds,
    is_nested,
    needs,
    place,
    reaches,
    word,
)
from haros_ci.checking.needs import Need, needs_of
from haros_ci.checking.outside_targets import may_have_more
from haros_ci.checking.plugins import (
    MACROS,
    Registration,
    class_names,
    exported_under,
    file_name,
    is_asked_for,
    is_written,
    loaders,
    own_classes,
    registers_otherwise,
    registrations,
)
from haros_ci.checking.provision import (
    Provision,
    Provisions,
    Sources,
    first_provider,
    is_of_ros,
    last_dependency,
    others_of,
)
from haros_ci.checking.requirements import distributions_of, normal, pinned
from haros_ci.checking.unbuilt import SUFFIXES, loose
from haros_ci.checking.uninstalled import (
    Programs,
    Uninstalled,
    installs_nothing,
    is_program,
    may_be_installed,
    uninstalled,
)
from haros_ci.checking.using import Using
from haros_ci.checking.worlds import serves_both
from haros_ci.knowledge.knowledge import Knowledge, knowledge
from haros_ci.model.build import (
    Build,
    CMakeCommand,
    EntryPoint,
    Installed,
    Interface,
    InterfaceField,
    PluginClass,
    Target,
)
from haros_ci.model.element import Element
from haros_ci.model.package import Dependency, Package, SourceFile

__all__ = [
    "BUILD",
    "EXEC",
    "EXPORTED",
    "MACROS",
    "OF_TARGETS",
    "Build",
    "CMake",
    "CMakeCommand",
    "Dependency",
    "Element",
    "EntryPoint",
    "Install",
    "Installed",
    "Interface",
    "InterfaceField",
    "Knowledge",
    "Link",
    "Need",
    "Package",
    "PluginClass",
    "Programs",
    "Provision",
    "Provisions",
    "Registration",
    "SUFFIXES",
    "SourceFile",
    "Sources",
    "Target",
    "Uninstalled",
    "Using",
    "add_dependency",
    "add_element",
    "add_export",
    "applying",
    "brings",
    "build_types",
    "class_names",
    "distributions_of",
    "drop_element",
    "drop_lines",
    "exported_under",
    "exports",
    "file_name",
    "first_provider",
    "holds",
    "imports_of",
    "insert_line",
    "install_directory",
    "install_line",
    "install_place",
    "installs_nothing",
    "is_asked_for",
    "is_ignored",
    "is_nested",
    "is_of_ros",
    "is_program",
    "is_written",
    "knowledge",
    "landings",
    "last_dependency",
    "loaders",
    "loose",
    "may_appear",
    "may_have_more",
    "may_be_installed",
    "needs",
    "needs_of",
    "normal",
    "others_of",
    "own_classes",
    "pinned",
    "place",
    "reaches",
    "registers_otherwise",
    "registrations",
    "rename_element",
    "serves_both",
    "set_attribute",
    "set_text",
    "uninstalled",
    "word",
]
