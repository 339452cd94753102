# SPDX-License-Identifier: Apache-2.0
"""All that a check needs (docs/adding-a-check.md): what it sees, and what it says."""

from __future__ import annotations

from haros_ci.changes.interfaces import InterfaceChange, containing
from haros_ci.changes.interfaces import in_words as change_in_words
from haros_ci.checking.appearing import may_appear
from haros_ci.checking.changed import WHATS as CHANGED_ENDS
from haros_ci.checking.changed import Causes, Lost, both, lost_in, same_end
from haros_ci.checking.changed import in_words as change_said
from haros_ci.checking.check import Check, Decidability, Finding, Status
from haros_ci.checking.closed import unmet
from haros_ci.checking.cmake import OF_TARGETS, CMake, Install, Link
from haros_ci.checking.compatibility import in_words as qos_in_words
from haros_ci.checking.compatibility import refused_pairs, refuses
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
from haros_ci.checking.given import Given, Names, Whole, is_mentioned, misplaced, near
from haros_ci.checking.imports import imports_of
from haros_ci.checking.incompatible import incompatible
from haros_ci.checking.installing import install_directory, install_line, install_place, landings
from haros_ci.checking.interface_users import InterfaceUsers, always_at, changes_of, defined_in
from haros_ci.checking.kinds import ACTION, NO_SYSTEMS, SERVICE, TOPIC
from haros_ci.checking.launch_edits import renamed_keyword
from haros_ci.checking.launching import included_by, meant, owner
from haros_ci.checking.likeness import is_moved, is_slip, may_be
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
from haros_ci.checking.message_fields import Missing as MissingField
from haros_ci.checking.message_fields import missing_fields
from haros_ci.checking.needs import Need, needs_of
from haros_ci.checking.offered import type_mismatches
from haros_ci.checking.plugins import (
    MACROS,
    Registration,
    exported_under,
    file_name,
    is_written,
    loaders,
    registers_otherwise,
    registrations,
)
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.checking.provision import (
    Provision,
    Provisions,
    Sources,
    first_provider,
    is_of_ros,
    last_dependency,
    others_of,
)
from haros_ci.checking.remapping import named_at, rule_of, way_to
from haros_ci.checking.robots import descriptions, is_by_itself, lead, place_of
from haros_ci.checking.system import Channel, End, System, SystemNode, can_meet
from haros_ci.checking.transforms import Broadcast, broadcasts
from haros_ci.checking.using import Using
from haros_ci.code.body import Body, Call, Place, Variable, last_part, names_in, nodes
from haros_ci.code.callbacks import DEFAULT, Callback, callbacks, excludes, given_function, group_name, group_of
from haros_ci.code.calls import called, callees, callers, calls_of, reached
from haros_ci.code.classes import base_names, class_named, methods, owner_of, resolved
from haros_ci.code.clients import Made, client_made, is_node, node_name, own_method
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.kinds import attribute_values, class_of, dotted, is_local, type_name, type_of, variable
from haros_ci.code.message_names import ros_type
from haros_ci.code.paths import undone_ways
from haros_ci.code.taint import carried, followed
from haros_ci.code.transforms import ASKED, is_caught, is_lookup
from haros_ci.code.uses import Use, uses
from haros_ci.code.ways import Reached, in_callbacks
from haros_ci.code.ways import place as call_place
from haros_ci.interfaces.references import Reference as InterfaceReference
from haros_ci.interfaces.references import references_to
from haros_ci.knowledge.knowledge import Knowledge, knowledge
from haros_ci.model.architecture import Condition, Endpoint, Parameter, Qos, RemapRule
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
from haros_ci.model.changes import Change, Changes
from haros_ci.model.element import Element
from haros_ci.model.launch_facts import (
    ArgumentDeclaration,
    ArgumentRead,
    CommandUse,
    Comparison,
    ConditionUse,
    ConstructUse,
    FileUse,
    IncludeUse,
    LaunchFact,
    NodePattern,
    PackageUse,
    ParameterFileUse,
    PassedArgument,
    PathUse,
    ProgramUse,
)
from haros_ci.model.location import Location
from haros_ci.model.package import Dependency, Package, SourceFile
from haros_ci.model.presence import ALWAYS, Presence, together
from haros_ci.model.program import Program
from haros_ci.model.robot import Description, Fault, Joint, Mesh, Robot
from haros_ci.model.robot import Link as RobotLink
from haros_ci.results.fix import Edit, Fix
from haros_ci.results.rule import Level
from haros_ci.security.enclaves import enclave_of, is_common
from haros_ci.security.permissions import Permission, verdict
from haros_ci.security.policy import NodeProfile, Policy, read_policy

__all__ = [
    "ACTION",
    "ALWAYS",
    "ASKED",
    "BUILD",
    "CHANGED_ENDS",
    "DEFAULT",
    "EXEC",
    "EXPORTED",
    "MACROS",
    "NO_SYSTEMS",
    "OF_TARGETS",
    "SERVICE",
    "TOPIC",
    "ArgumentDeclaration",
    "ArgumentRead",
    "Body",
    "Broadcast",
    "Build",
    "CMake",
    "CMakeCommand",
    "Call",
    "Callback",
    "Causes",
    "Change",
    "Changes",
    "Channel",
    "Check",
    "Codebase",
    "CommandUse",
    "Comparison",
    "Condition",
    "ConditionUse",
    "ConstructUse",
    "Decidability",
    "Dependency",
    "Description",
    "Edit",
    "Element",
    "End",
    "Endpoint",
    "EntryPoint",
    "Fault",
    "FileUse",
    "Finding",
    "Fix",
    "Given",
    "IncludeUse",
    "Install",
    "Installed",
    "Interface",
    "InterfaceChange",
    "InterfaceField",
    "InterfaceReference",
    "InterfaceUsers",
    "Joint",
    "Knowledge",
    "LaunchFact",
    "Level",
    "Link",
    "Location",
    "Lost",
    "Made",
    "Mesh",
    "MissingField",
    "Names",
    "Need",
    "NodePattern",
    "NodeProfile",
    "Package",
    "PackageUse",
    "Parameter",
    "ParameterFileUse",
    "PassedArgument",
    "PathUse",
    "Permission",
    "Place",
    "PluginClass",
    "Policy",
    "Presence",
    "Program",
    "ProgramUse",
    "Project",
    "ProjectPackage",
    "Provision",
    "Provisions",
    "Qos",
    "Reached",
    "Registration",
    "RemapRule",
    "Robot",
    "RobotLink",
    "Routine",
    "SourceFile",
    "Sources",
    "Status",
    "System",
    "SystemNode",
    "Target",
    "Use",
    "Using",
    "Variable",
    "Whole",
    "add_dependency",
    "add_element",
    "add_export",
    "always_at",
    "applying",
    "attribute_values",
    "base_names",
    "both",
    "brings",
    "broadcasts",
    "build_types",
    "call_place",
    "callbacks",
    "called",
    "callees",
    "callers",
    "calls_of",
    "can_meet",
    "carried",
    "change_in_words",
    "change_said",
    "changes_of",
    "class_named",
    "class_of",
    "client_made",
    "containing",
    "defined_in",
    "descriptions",
    "dotted",
    "drop_element",
    "drop_lines",
    "enclave_of",
    "excludes",
    "exported_under",
    "exports",
    "file_name",
    "first_provider",
    "followed",
    "given_function",
    "group_name",
    "group_of",
    "holds",
    "imports_of",
    "in_callbacks",
    "included_by",
    "incompatible",
    "insert_line",
    "install_directory",
    "install_line",
    "install_place",
    "is_by_itself",
    "is_caught",
    "is_common",
    "is_local",
    "is_lookup",
    "is_mentioned",
    "is_moved",
    "is_nested",
    "is_node",
    "is_of_ros",
    "is_slip",
    "is_written",
    "knowledge",
    "landings",
    "last_dependency",
    "last_part",
    "lead",
    "loaders",
    "lost_in",
    "may_appear",
    "may_be",
    "meant",
    "methods",
    "misplaced",
    "missing_fields",
    "named_at",
    "names_in",
    "near",
    "needs",
    "needs_of",
    "node_name",
    "nodes",
    "others_of",
    "own_method",
    "owner",
    "owner_of",
    "place",
    "place_of",
    "qos_in_words",
    "reached",
    "reaches",
    "read_policy",
    "references_to",
    "refused_pairs",
    "refuses",
    "registers_otherwise",
    "registrations",
    "rename_element",
    "renamed_keyword",
    "resolved",
    "ros_type",
    "rule_of",
    "same_end",
    "set_attribute",
    "set_text",
    "together",
    "type_mismatches",
    "type_name",
    "type_of",
    "undone_ways",
    "unmet",
    "uses",
    "variable",
    "verdict",
    "way_to",
    "word",
]
