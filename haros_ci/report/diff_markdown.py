# SPDX-License-Identifier: Apache-2.0
"""What a change does, as Markdown for a pull request: a short table, and a picture of the part of the graph that changed."""

from __future__ import annotations

from haros_ci.model.changes import CHANGED, RENAMED, Change, Changes
from haros_ci.report.diff_mermaid import diagram
from haros_ci.report.diff_text import NOTHING, headline, place, several, title, users, value
from haros_ci.report.escape import markdown, markdown_code

#: Rows of the table; the rest is in the JSON.
ROWS = 100
#: Ends of a new or removed node that are written out.
ENDS = 12
HEAD = ("What", "Where", "Before", "After", "Users")


def render(found: Changes, base: str = "", head: str | None = None) -> str:
    """A heading with a table and a picture; one line if nothing has changed."""
    if not found.changes:
        return f"{NOTHING}\n"
    lines = [f"**{markdown(headline(found))}**", ""]
    lines += [f"| {' | '.join(HEAD)} |", f"|{' --- |' * len(HEAD)}"]
    lines += (f"| {' | '.join(_cells(change))} |" for change in found.changes[:ROWS])
    if len(found.changes) > ROWS:
        lines += ["", f"and {len(found.changes) - ROWS} more: `haros-ci diff --format json` has them all."]
    picture = diagram(found)
    if picture:
        lines += ["", "```mermaid", picture.rstrip("\n"), "```"]
    return "\n".join(lines) + "\n"


def _cells(change: Change) -> tuple[str, ...]:
    names = change.old_names if change.action == RENAMED else change.names
    what = f"{markdown(title(change))} {_codes(names)}"
    if change.what == "interface" and change.action == CHANGED:
        what += f": {markdown(change.aspect)}"
    where = "<br>".join(
        part
        for part in (markdown(several(change.programs)), markdown_code(place(change)) if place(change) else "")
        if part
    )
    details = _details(change)
    before, after = _value(change.before), _value(change.after)
    if details:
        before, after = (f"{before}<br>{details}", after) if change.after is None else (before, f"{after}<br>{details}")
    return what, where, before, after, markdown(users(change))


def _codes(names: tuple[str, ...]) -> str:
    shown = ", ".join(markdown_code(value(name)) for name in names[:3])
    return shown + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _value(text: str | None) -> str:
    return "—" if text is None else markdown_code(value(text))


def _details(change: Change) -> str:
    if not change.details:
        return ""
    more = len(change.details) - ENDS
    message = "<br>".join(markdown(value(word)) for word in change.details[:ENDS])
    return message + (f"<br>and {more} more" if more > 0 else "")
