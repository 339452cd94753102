# SPDX-License-Identifier: Apache-2.0
"""Faults of haros-ci itself, in one file, package or node: they are named there, and the rest of the workspace goes on."""

from __future__ import annotations

import re

#: What such a fault raises. What the machine refuses (MemoryError, OSError) and what a user stops are not among it.
FAULTS = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    NameError,
    RuntimeError,
    StopIteration,
    TypeError,
    ValueError,
    re.error,
)


def fault(what: str, err: Exception) -> str:
    """The sentence for *what* could not be done because of such a fault."""
    return f"{what} ({type(err).__name__}): a fault of haros-ci, please report it"
