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
    has_unseen,
    is_unseen,
    lost_in,
    same_end,
)
from haros_ci.checking.changed import (
    in_words as change_said,
)
from haros_ci.checking.left_behind import LeftBehind, left_behind
from haros_ci.checking.left_out import left_out, replaced
from haros_ci.model.changes import Change, Changes

__all__ = [
    "CHANGED_ENDS",
    "Causes",
    "Change",
    "Changes",
    "LeftBehind",
    "Lost",
    "both",
    "change_said",
    "has_unseen",
    "is_unseen",
    "left_behind",
    "left_out",
    "lost_in",
    "replaced",
    "same_end",
]
