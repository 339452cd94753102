# SPDX-License-Identifier: Apache-2.0
"""Manifests, builds, dependencies, plug-ins, and edits of them."""

from __future__ import annotations

from haros_ci.checking.appearing import brings_files, is_ignored, is_told_of, may_appear
from haros_ci.checking.boost import boost_keys
from haros_ci.checking.build_tool import AMENT, CATKIN, always_called, undeclared_build_tools
from haros_ci.checking.built_against import is_built_against
from haros_ci.checking.cmake import OF_TARGETS, CMake, Install, Link
from haros_ci.checking.cmake_variables import is_found_by_others, may_set_variables
from haros_ci.checking.conflicts import CONFLICT_BEGINS, CONFLICT_ENDS, conflicts
from haros_ci.checking.console_scripts import entry_point_mistake, is_own_module, moved_module, renamed_module
from haros_ci.checking.copying_builds import is_built_by_copying
from haros_ci.checking.counterparts import COUNTERPARTS
from haros_ci.checking.devel_spaces import DevelSpaces
from haros_ci.checking.editing import (
    add_dependency,
    add_element,
    add_export,
    dependency_tags,
    drop_element,
    insert_line,
    rename_element,
    set_attribute,
    set_text,
)
from haros_ci.checking.entries import NO_ENTRIES, entries_of, paths_by_name
from haros_ci.checking.gone_packages import said_gone
from haros_ci.checking.idle_packages import BUILD_TOOLS, idle_commands
from haros_ci.checking.imports import imported, imports_of, is_called_after
from haros_ci.checking.installing import (
    install_commands,
    install_directory,
    install_line,
    install_place,
    is_made_program_later,
    is_said_not_installed,
    landings,
    left_out_on_purpose,
)
from haros_ci.checking.interface_uses import interfaces_in_use
from haros_ci.checking.interpreted import (
    is_for_nobody,
    is_given_to_another,
    is_imported_beside,
    is_sourced,
    is_to_be_run,
)
from haros_ci.checking.left_to_write import is_unfilled, lacks_interface
from haros_ci.checking.leftovers import Leftovers
from haros_ci.checking.linked_builds import is_built_with_links
from haros_ci.checking.lookups import Lookup, launch_lookups, lookups
from haros_ci.checking.lost_imports import lost_imports
from haros_ci.checking.manifest_names import ENVIRONMENT, has_environment, is_nowhere
from haros_ci.checking.manifests import (
    BUILD,
    EXEC,
    EXPORTED,
    applying,
    brings,
    build_types,
    counted,
    exports,
    holds,
    holds_for_python,
    is_nested,
    needs,
    place,
    reaches,
    said_misplaced,
    said_never,
    word,
)
from haros_ci.checking.meant_plugins import described_classes, is_seen_through, library_of, meant_classes
from haros_ci.checking.needs import Need, lacking, needs_of
from haros_ci.checking.outside_targets import downloads, may_be_added, may_have_more
from haros_ci.checking.package_names import meant_here, meant_released, stem_of_system
from haros_ci.checking.pages import is_for_noetic, is_for_older
from haros_ci.checking.plugin_readers import is_of_node, may_load
from haros_ci.checking.plugin_uses import (
    PLUGIN_NAME,
    PluginUse,
    Unlisted,
    plugins_in_parameters,
    plugins_in_yaml,
    unlisted_plugins,
)
from haros_ci.checking.plugins import (
    MACROS,
    Registration,
    class_names,
    compiled_into,
    exported_under,
    file_name,
    is_asked_for,
    is_written,
    loaders,
    may_be_base,
    own_classes,
    registrations,
    variant,
)
from haros_ci.checking.proposals import Reason, proposed_before
from haros_ci.checking.provision import (
    OF_PYTHON,
    Provision,
    Provisions,
    Sources,
    first_provider,
    is_of_ros,
    last_dependency,
    others_of,
)
from haros_ci.checking.requirements import distributions_of, left_to_pip, normal, pinned
from haros_ci.checking.script_sections import misspelt
from haros_ci.checking.scripts import changes_modes, gives_modes, rospy_programs
from haros_ci.checking.set_aside import is_copy_by_name
from haros_ci.checking.test_support import is_for_tests, only_for_tests
from haros_ci.checking.unbuilt import SUFFIXES, loose
from haros_ci.checking.undeclared import (
    asks_what_is_installed,
    brought_by,
    closes_a_cycle,
    dependency_place,
    is_aside,
    is_left_out,
    is_of_tests,
    is_to_be_had,
    provided,
    used_by_launch_files,
)
from haros_ci.checking.uninstalled import (
    Programs,
    Uninstalled,
    describes_installed,
    installs_nothing,
    is_program,
    lost_plugins,
    may_be_installed,
    plugin_library,
    uninstalled,
)
from haros_ci.checking.unreached import unreached
from haros_ci.checking.using import Using
from haros_ci.checking.whole import repositories_named
from haros_ci.checking.worlds import dependency_tag, serves_both
from haros_ci.checking.writers import writer_of
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
from haros_ci.model.cycles import circles
from haros_ci.model.element import Element
from haros_ci.model.package import Dependency, Package, SourceFile

__all__ = [
    "AMENT",
    "BUILD",
    "BUILD_TOOLS",
    "Build",
    "CATKIN",
    "CMake",
    "CMakeCommand",
    "CONFLICT_BEGINS",
    "CONFLICT_ENDS",
    "COUNTERPARTS",
    "Dependency",
    "DevelSpaces",
    "ENVIRONMENT",
    "EXEC",
    "EXPORTED",
    "Element",
    "EntryPoint",
    "Install",
    "Installed",
    "Interface",
    "InterfaceField",
    "Knowledge",
    "Leftovers",
    "Link",
    "Lookup",
    "MACROS",
    "NO_ENTRIES",
    "Need",
    "OF_PYTHON",
    "OF_TARGETS",
    "PLUGIN_NAME",
    "Package",
    "PluginClass",
    "PluginUse",
    "Programs",
    "Provision",
    "Provisions",
    "Reason",
    "Registration",
    "SUFFIXES",
    "SourceFile",
    "Sources",
    "Target",
    "Uninstalled",
    "Unlisted",
    "Using",
    "add_dependency",
    "add_element",
    "add_export",
    "always_called",
    "applying",
    "asks_what_is_installed",
    "boost_keys",
    "brings",
    "brings_files",
    "brought_by",
    "build_types",
    "changes_modes",
    "circles",
    "class_names",
    "closes_a_cycle",
    "compiled_into",
    "conflicts",
    "counted",
    "dependency_place",
    "dependency_tag",
    "dependency_tags",
    "described_classes",
    "describes_installed",
    "distributions_of",
    "downloads",
    "drop_element",
    "entries_of",
    "entry_point_mistake",
    "exported_under",
    "exports",
    "file_name",
    "first_provider",
    "gives_modes",
    "has_environment",
    "holds",
    "holds_for_python",
    "imported",
    "idle_commands",
    "imports_of",
    "insert_line",
    "install_commands",
    "install_directory",
    "install_line",
    "install_place",
    "installs_nothing",
    "interfaces_in_use",
    "is_aside",
    "is_asked_for",
    "is_built_against",
    "is_built_by_copying",
    "is_built_with_links",
    "is_called_after",
    "is_copy_by_name",
    "is_for_nobody",
    "is_for_noetic",
    "is_for_older",
    "is_for_tests",
    "is_found_by_others",
    "is_given_to_another",
    "is_ignored",
    "is_imported_beside",
    "is_left_out",
    "is_made_program_later",
    "is_nested",
    "is_nowhere",
    "is_of_node",
    "is_of_ros",
    "is_of_tests",
    "is_own_module",
    "is_program",
    "is_said_not_installed",
    "is_seen_through",
    "is_sourced",
    "is_to_be_had",
    "is_to_be_run",
    "is_told_of",
    "is_unfilled",
    "is_written",
    "knowledge",
    "lacking",
    "lacks_interface",
    "landings",
    "last_dependency",
    "launch_lookups",
    "left_out_on_purpose",
    "left_to_pip",
    "library_of",
    "loaders",
    "lookups",
    "loose",
    "lost_imports",
    "lost_plugins",
    "may_appear",
    "may_be_added",
    "may_be_base",
    "may_be_installed",
    "may_have_more",
    "may_load",
    "may_set_variables",
    "meant_classes",
    "meant_here",
    "meant_released",
    "misspelt",
    "moved_module",
    "needs",
    "needs_of",
    "normal",
    "only_for_tests",
    "others_of",
    "own_classes",
    "paths_by_name",
    "pinned",
    "place",
    "plugin_library",
    "plugins_in_parameters",
    "plugins_in_yaml",
    "proposed_before",
    "provided",
    "reaches",
    "registrations",
    "rename_element",
    "renamed_module",
    "repositories_named",
    "rospy_programs",
    "said_gone",
    "said_misplaced",
    "said_never",
    "serves_both",
    "set_attribute",
    "set_text",
    "stem_of_system",
    "undeclared_build_tools",
    "uninstalled",
    "unlisted_plugins",
    "unreached",
    "used_by_launch_files",
    "variant",
    "word",
    "writer_of",
]
