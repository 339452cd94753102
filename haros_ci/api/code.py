# SPDX-License-Identifier: Apache-2.0
"""The call graph and what it tells of functions and callbacks."""

from __future__ import annotations

from haros_ci.checking.attributes import Unset, unset_attributes
from haros_ci.checking.branches import parsed
from haros_ci.checking.code_text import alone
from haros_ci.checking.old_python import (
    LOADS,
    Misfit,
    commented_blocks,
    misfits,
    parsed_of_any_version,
    switched_off,
    undefined_names,
)
from haros_ci.checking.republishing import publishes_again
from haros_ci.checking.unstarted import weighed
from haros_ci.code.body import (
    Body,
    Call,
    Place,
    Variable,
    last_part,
    names_in,
    nodes,
)
from haros_ci.code.callbacks import (
    DEFAULT,
    Callback,
    callbacks,
    excludes,
    given_function,
    group_name,
    group_of,
)
from haros_ci.code.calls import (
    called,
    callees,
    callers,
    calls_of,
    reached,
)
from haros_ci.code.classes import (
    base_names,
    class_named,
    methods,
    owner_of,
    resolved,
)
from haros_ci.code.clients import (
    ClientOrigin,
    client_made,
    is_node,
    node_name,
    own_method,
)
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.dead import is_dead
from haros_ci.code.empty_loops import turns_never
from haros_ci.code.kinds import (
    attribute_values,
    class_of,
    dotted,
    is_local,
    type_name,
    type_of,
    variable,
)
from haros_ci.code.made_late import late
from haros_ci.code.message_names import ros_type
from haros_ci.code.paths import undone_ways
from haros_ci.code.taint import carried, followed
from haros_ci.code.transforms import ASKED, is_caught, is_lookup
from haros_ci.code.uses import Use, uses
from haros_ci.code.ways import Reached, in_callbacks
from haros_ci.code.ways import place as call_place
from haros_ci.syntax import Parameter as FunctionParameter
from haros_ci.syntax import Program

__all__ = [
    "ASKED",
    "DEFAULT",
    "Body",
    "Call",
    "Callback",
    "Codebase",
    "FunctionParameter",
    "LOADS",
    "ClientOrigin",
    "Misfit",
    "Place",
    "Program",
    "Reached",
    "Routine",
    "Unset",
    "Use",
    "Variable",
    "alone",
    "attribute_values",
    "base_names",
    "call_place",
    "callbacks",
    "called",
    "callees",
    "callers",
    "calls_of",
    "carried",
    "class_named",
    "class_of",
    "client_made",
    "dotted",
    "excludes",
    "followed",
    "given_function",
    "group_name",
    "group_of",
    "in_callbacks",
    "is_caught",
    "is_dead",
    "is_local",
    "is_lookup",
    "is_node",
    "last_part",
    "late",
    "methods",
    "commented_blocks",
    "misfits",
    "names_in",
    "node_name",
    "nodes",
    "own_method",
    "owner_of",
    "parsed",
    "parsed_of_any_version",
    "publishes_again",
    "reached",
    "resolved",
    "ros_type",
    "type_name",
    "type_of",
    "switched_off",
    "undefined_names",
    "turns_never",
    "undone_ways",
    "unset_attributes",
    "uses",
    "variable",
    "weighed",
]
