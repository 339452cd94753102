# SPDX-License-Identifier: Apache-2.0
"""Properties in HPL, and what can be said of them (docs/hpl.md)."""

from __future__ import annotations

from haros_ci.behaviour.clauses import Reader
from haros_ci.behaviour.comparing import excluded, follows
from haros_ci.behaviour.deciding import Predicate, is_always, is_never, overlap
from haros_ci.behaviour.declared import Stated
from haros_ci.behaviour.meaning import Slip, mistakes, mistyped, unused_aliases
from haros_ci.behaviour.messages import Missing, Scene, kind_of
from haros_ci.behaviour.ranges import outside
from haros_ci.behaviour.text import event_text, events_text, expression_text
from haros_ci.behaviour.tree import (
    Event,
    Expression,
    Field,
    Item,
    PatternKind,
    parts,
)
from haros_ci.checking.closed import is_certainly_absent
from haros_ci.checking.properties import OF_ALL, Properties, found

__all__ = [
    "OF_ALL",
    "Event",
    "Expression",
    "Field",
    "Item",
    "Missing",
    "PatternKind",
    "Predicate",
    "Properties",
    "Reader",
    "Scene",
    "Slip",
    "Stated",
    "event_text",
    "events_text",
    "excluded",
    "expression_text",
    "follows",
    "found",
    "is_always",
    "is_never",
    "kind_of",
    "is_certainly_absent",
    "mistakes",
    "mistyped",
    "outside",
    "overlap",
    "parts",
    "unused_aliases",
]
