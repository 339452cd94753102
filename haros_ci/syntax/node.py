# SPDX-License-Identifier: Apache-2.0
"""What all parts of a program are: frozen records whose JSON is an array of their fields, in their order.

A part that may stand where others may, too, has a tag, which comes first.
"""

from __future__ import annotations

import msgspec
from msgspec.structs import replace as replace


class Record(msgspec.Struct, frozen=True, array_like=True, gc=False, forbid_unknown_fields=True):
    """A part of which its place tells what it is."""


class Node(Record, frozen=True, tag_field="tag"):
    """A type, an expression, a statement: a part with a tag."""
