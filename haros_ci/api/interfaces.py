# SPDX-License-Identifier: Apache-2.0
"""Definitions of messages, services and actions, and who uses them."""

from __future__ import annotations

from haros_ci.changes.interfaces import InterfaceChange, containing
from haros_ci.changes.interfaces import in_words as change_in_words
from haros_ci.checking.field_values import WrongValue, wrong_values
from haros_ci.checking.interface_users import InterfaceUsers, always_at, changes_of, defined_in, is_written_here
from haros_ci.checking.message_fields import Missing as MissingField
from haros_ci.checking.message_fields import missing_fields
from haros_ci.checking.unnamed_values import UnnamedValues, unnamed_values
from haros_ci.interfaces.references import Reference as InterfaceReference
from haros_ci.interfaces.references import of_include, references_to

__all__ = [
    "InterfaceChange",
    "InterfaceReference",
    "InterfaceUsers",
    "MissingField",
    "UnnamedValues",
    "WrongValue",
    "always_at",
    "change_in_words",
    "changes_of",
    "containing",
    "defined_in",
    "is_written_here",
    "missing_fields",
    "of_include",
    "references_to",
    "unnamed_values",
    "wrong_values",
]
