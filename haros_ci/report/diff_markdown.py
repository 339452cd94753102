# SPDX-License-Identifier: Apache-2.0
"""What a change does, as Markdown for a pull request: a short table, and a picture of the part of the graph that changed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from urllib.parse import quote

from haros_ci.model.changes import CHANGED, REMOVED, RENAMED, Change, Changes
from haros_ci.report.diff_mermaid import diagram
from haros_ci.report.diff_text import NOTHING, headline, place, several, title, users, value
from haros_ci.report.escape import markdown, markdown_code

#: Rows of the table; the rest is in the JSON.
ROWS = 100
#: Ends of a new or removed node that are written out in its cell; the others stand in a list below the table, so many of each node.
ENDS = 3
MOST_ENDS = 40
HEAD = ("What", "Where", "Before", "After", "Users")


def render(found: Changes, base: str = "", head: str | None = None, blob: str = "") -> str:
    """A heading with a table and a picture; one line if nothing has changed.

    *blob* is the address below which the files of head can be read, for links to lines; "" for none.
    """
    if not found.changes:
        return f"{NOTHING}\n"
    lines = [f"**{markdown(headline(found))}**", ""]
    lines += [f"| {' | '.join(HEAD)} |", f"|{' --- |' * len(HEAD)}"]
    lines += (f"| {' | '.join(_cells(change, blob))} |" for change in found.changes[:ROWS])
    if len(found.changes) > ROWS:
        lines += ["", f"and {len(found.changes) - ROWS} more: `haros-ci diff --format json` has them all."]
    lines += _lists(found.changes[:ROWS])
    picture = diagram(found)
    if picture:
        lines += ["", "```mermaid", picture.rstrip("\n"), "```"]
    return "\n".join(lines) + "\n"


def _cells(change: Change, blob: str) -> tuple[str, ...]:
    names = change.old_names if change.action == RENAMED else change.names
    what = f"{markdown(title(change))} {_codes(names)}"
    if change.what == "interface" and change.action == CHANGED:
        what += f": {markdown(change.aspect)}"
    where = "<br>".join(filter(None, (markdown(several(change.programs)), _linked(change, blob))))
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


def _linked(change: Change, blob: str) -> str:
    """The place, as a link where it is at head and *blob* is known."""
    text = place(change)
    if not text or change.location is None:
        return ""
    if not blob or change.action == REMOVED:
        return markdown_code(text)
    return linked(text, change.location.path, change.location.line, blob)


def linked(text: str, path: str, line: int | None, blob: str) -> str:
    """*text* as code that leads to a line of a file below the address *blob*."""
    address = f"{blob.rstrip('/')}/{quote(path)}" + (f"#L{line}" if line is not None else "")
    return f"[{markdown_code(text)}]({address})"


def _details(change: Change) -> str:
    if not change.details:
        return ""
    more = len(change.details) - ENDS
    message = "<br>".join(markdown(value(word)) for word in change.details[:ENDS])
    return message + (f"<br>and {more} more" if more > 0 else "")


def _lists(changes: Iterable[Change]) -> Iterator[str]:
    """All details of those changes whose cells have only the first, behind a line that opens."""
    for change in changes:
        if len(change.details) > ENDS:
            left = len(change.details) - MOST_ENDS
            yield f"\n<details><summary>{markdown(title(change))} {_codes(change.names)}</summary>\n"
            yield from (f"- {markdown(value(word))}" for word in change.details[:MOST_ENDS])
            if left > 0:
                yield f"- and {left} more"
            yield "\n</details>"
