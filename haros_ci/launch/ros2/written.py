# SPDX-License-Identifier: Apache-2.0
"""Files that a launch file writes itself, as nodes read them."""

from __future__ import annotations

from haros_ci.launch.ros2.context import Context
from haros_ci.launch.ros2.substitutions import perform
from haros_ci.model.launch_actions import Action
from haros_ci.regex import regex
from haros_ci.substitutions.names import MARK, Text

#: Paths and contents that are kept for one workspace.
MOST = 20_000
#: A part that is not known stands in a value: behind a key, a dash, or inside of braces.
_IN_VALUE = regex(rf"[^{MARK}\n]{{1,2000}}?(?::[ \t]|-[ \t]|[{{\[])[^\n]*")


def note_written(context: Context, action: Action) -> None:
    """Keep what is written into a file; nothing where something else is asked than what is there."""
    written = context.places.written
    if context.is_asking or context.assumed or len(written) >= MOST:
        return
    path = perform(context, action.get("path") or (), 0)
    content: Text | str = action.reason
    if not content:
        performed = perform(context, action.get("content") or (), 0)
        content = _why_not(performed) or performed
    key = (path.raw, path.reasons)
    if not path.known and key in written and written[key][0] != content:
        content = "which of several files it is, is not known"
    written[key] = (content, action.location)


def _why_not(content: Text) -> str:
    """Why it is not known what *content* sets, if a part that is not known may be more than a value."""
    for line in content.raw.split("\n"):
        if MARK in line and _IN_VALUE.fullmatch(line) is None:
            return content.reasons[0]
    return ""
