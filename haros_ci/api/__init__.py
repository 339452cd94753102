# SPDX-License-Identifier: Apache-2.0
"""What every check needs (docs/adding-a-check.md): systems, projects, findings and fixes. Each kind of input has a module beside this one."""

from __future__ import annotations

from haros_ci.checking.check import API_VERSION, Check, Decidability, Finding, Status
from haros_ci.checking.closed import unmet
from haros_ci.checking.coexistence import by_types, can_meet, is_never_made
from haros_ci.checking.compatibility import in_words as qos_in_words
from haros_ci.checking.compatibility import refused_pairs, refuses
from haros_ci.checking.given import (
    Given,
    Names,
    is_mentioned,
    misplaced,
    near,
)
from haros_ci.checking.given_names import is_given_away
from haros_ci.checking.incompatible import incompatible
from haros_ci.checking.kinds import ACTION, NO_SYSTEMS, SERVICE, TOPIC
from haros_ci.checking.likeness import all_nearest, is_letter_slip, is_moved, is_slip, may_be, nearest
from haros_ci.checking.offered import type_mismatches
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.checking.remapping import is_idle, named_at, rule_of, way_to
from haros_ci.checking.run import command
from haros_ci.checking.stated import of_properties
from haros_ci.checking.system import Channel, End, System, SystemNode
from haros_ci.checking.whole import Whole
from haros_ci.checking.whole_graph import WholeGraph, is_opaque
from haros_ci.checking.wording import alternatives, line_of, listed, spelled_out
from haros_ci.checking.yaml_readers import is_read_besides
from haros_ci.model.architecture import (
    Condition,
    Endpoint,
    Parameter,
    Qos,
    RemapRule,
)
from haros_ci.model.location import Location
from haros_ci.model.presence import ALWAYS, Presence, together
from haros_ci.model.slips import equally_near
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.fix import Edit, Fix
from haros_ci.results.rule import Level

__all__ = [
    "API_VERSION",
    "ACTION",
    "ALWAYS",
    "NO_SYSTEMS",
    "SERVICE",
    "TOPIC",
    "Channel",
    "Check",
    "Condition",
    "Decidability",
    "Edit",
    "End",
    "Endpoint",
    "Finding",
    "Fix",
    "Given",
    "Level",
    "Location",
    "Names",
    "Parameter",
    "Presence",
    "Project",
    "ProjectPackage",
    "Qos",
    "RemapRule",
    "Status",
    "System",
    "SystemNode",
    "Whole",
    "WholeGraph",
    "all_nearest",
    "alternatives",
    "by_types",
    "can_meet",
    "command",
    "equally_near",
    "incompatible",
    "is_given_away",
    "is_idle",
    "is_mentioned",
    "is_read_besides",
    "is_letter_slip",
    "is_moved",
    "is_never_made",
    "is_opaque",
    "is_slip",
    "line_of",
    "listed",
    "spelled_out",
    "may_be",
    "nearest",
    "misplaced",
    "named_at",
    "near",
    "of_properties",
    "qos_in_words",
    "refused_pairs",
    "refuses",
    "rule_of",
    "together",
    "type_mismatches",
    "unmet",
    "way_to",
    "dataclass",
    "field",
    "regex",
]
