# SPDX-License-Identifier: Apache-2.0
"""What was launched before in one workspace, and how many steps are left for all that has not been."""

from __future__ import annotations

from collections.abc import MutableMapping
from typing import Any

#: Steps for the launch files of one workspace together: twenty times what those of a large one take (384 launches of autoware: 300,000).
TOGETHER = 6_000_000
#: Steps that a launch has at least: most take less. Once all are used up it has the fewer ones.
LEAST, FEWEST = 5_000, 1_000

#: What was launched before, by files, arguments and environment.
Memo = MutableMapping[tuple[object, ...], Any]


class LaunchMemory(dict[tuple[object, ...], Any]):
    """A Memo with the steps *left*: files that each take all that one may would take minutes together."""

    def __init__(self, left: int = TOGETHER) -> None:
        super().__init__()
        self.left = left


def steps_for(memo: Memo | None, most: int) -> int:
    """The steps that one more launch may take, *most* of them where nothing is counted."""
    if not isinstance(memo, LaunchMemory):
        return most
    return min(most, max(LEAST, memo.left) if memo.left > 0 else FEWEST)


def take(memo: Memo | None, steps: int) -> None:
    """Counts the *steps* that a launch has taken."""
    if isinstance(memo, LaunchMemory):
        memo.left -= steps
