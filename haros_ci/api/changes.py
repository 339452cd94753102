# SPDX-License-Identifier: Apache-2.0
"""What is otherwise than at the base revision."""

from __future__ import annotations

from haros_ci.checking.changed import (
    WHATS as CHANGED_ENDS,
)
from haros_ci.checking.changed import (
    Causes,
    Lost,
    both,
    lost_in,
    same_end,
)
from haros_ci.checking.changed import (
    in_words as change_said,
)
from haros_ci.model.changes import Change, Changes

__all__ = [
    "CHANGED_ENDS",
    "Causes",
    "Change",
    "Changes",
    "Lost",
    "both",
    "change_said",
    "lost_in",
    "same_end",
]
