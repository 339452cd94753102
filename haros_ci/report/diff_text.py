# SPDX-License-Identifier: Apache-2.0
"""What a change does, a line each: for terminals, and the words that Markdown shares."""

from __future__ import annotations

from collections import Counter

from haros_ci.model.changes import CHANGED, RENAMED, Change, Changes
from haros_ci.report.escape import log_line
from haros_ci.report.summary import plural

#: Names that are written out.
SHOWN = 3
#: The longest value that is written out, in characters.
LONGEST = 120
#: What it is called where nothing has changed.
NOTHING = "No change to interfaces, nodes, topics, services, actions or parameters."


def render(found: Changes, base: str, head: str | None) -> str:
    """Plain text; one line if nothing has changed."""
    if not found.changes:
        return f"{NOTHING}\n"
    lines = [f"{headline(found)} ({revisions(base, head)})"]
    lines += (_line(change) for change in found.changes)
    return "\n".join(map(log_line, lines)) + "\n"


def headline(found: Changes) -> str:
    """``5 changes: 3 parameters, 2 publishers``."""
    counts = Counter(change.what for change in found.changes)
    message = ", ".join(noun(number, what) for what, number in counts.items())
    return f"{plural(len(found.changes), 'change')}: {message}"


def noun(number: int, what: str) -> str:
    return f"{number} {what}" if what == "QoS" else plural(number, what)


def revisions(base: str, head: str | None) -> str:
    return f"{base[:12]} to {head[:12] if head else 'work tree'}"


def title(change: Change) -> str:
    """``parameter max_vel: default changed`` without the names: ``parameter default changed``."""
    what = f"QoS of {change.aspect}" if change.what == "QoS" else change.what
    if change.what == "node" and change.aspect == "program" and change.action != CHANGED:
        what = "program"
    if change.aspect == "plug-in":
        what = "parameters"
    aspect = change.aspect if change.action == CHANGED and change.what not in ("QoS", "interface") else ""
    return " ".join(part for part in (what, aspect, change.action) if part)


def several(names: tuple[str, ...], most: int = SHOWN) -> str:
    """The first names, and how many more there are."""
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more} more" if more > 0 else "")


def place(change: Change) -> str:
    """``path:line`` at head, of what is removed at the base."""
    location = change.location
    if location is None:
        return ""
    return f"{location.path}:{location.line}" if location.line is not None else location.path


def value(text: str | None) -> str:
    if text is None:
        return "—"
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"


def users(change: Change) -> str:
    """Who else uses it, or whom a rate affects, and in how many configurations it is seen."""
    messages = [several(change.users)] if change.users else []
    if change.what == "rate" and change.users:
        be = "is" if len(change.users) == 1 else "are"
        messages = [f"{plural(len(change.users), 'node')} {be} affected: {messages[0]}"]
    if len(change.configurations) > 1:
        messages.append(plural(len(change.configurations), "configuration"))
    return "; ".join(messages)


def _line(change: Change) -> str:
    names = several(change.names)
    if change.action == RENAMED:
        message = f"{several(change.old_names)} → {names}"
    elif change.action == CHANGED:
        message = f"{names}: {change.aspect if change.what == 'interface' else ''}".rstrip(": ")
        if change.what != "interface":
            message += f": {value(change.before)} → {value(change.after)}"
    else:
        text = change.after if change.after is not None else change.before
        message = f"{names}: {value(text)}" if text is not None else names
    where = several(change.programs)
    if where and where in message.replace(": ", ", ").split(", "):  # it is what comes or goes
        where = ""
    parts = [
        f"{title(change)}: {message}",
        where,
        place(change),
        f"used by {users(change)}" if change.users and change.what != "rate" else users(change),
    ]
    return "  " + "; ".join(part for part in parts if part)
