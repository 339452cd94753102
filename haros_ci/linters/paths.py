# SPDX-License-Identifier: Apache-2.0
"""Which paths of a workspace tools may get to see."""

from __future__ import annotations


def is_viewed(path: str) -> bool:
    """Whether a path below the root can be in a view at all: one in a hidden directory cannot (``.git`` holds tokens)."""
    return not any(part.startswith(".") and part not in (".", "..") for part in path.split("/"))
