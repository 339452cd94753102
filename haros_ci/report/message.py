# SPDX-License-Identifier: Apache-2.0
"""The sentence that a result says: plain for people, with embedded links for SARIF (§3.11.6)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import isfinite

from haros_ci.regex import regex
from haros_ci.report.escape import terminal
from haros_ci.results.own import TOOL
from haros_ci.results.result import Related, Result

MAX_MESSAGE = 2000
MAX_LABEL = 100
MAX_LINKS = 10
_LINK = regex(r"\[((?:[^\[\]\\]|\\[\[\]\\])*)\]\((\d{1,4})\)")


def plain(result: Result) -> str:
    """The message as one line ending in a period, its links replaced by their words."""
    return sentence("".join(text for text, _ in _parts(result)))


def linked(result: Result) -> str:
    """The message as SARIF text: every related location is linked by its id, all other brackets are literal."""
    parts = tuple(_parts(result))
    words = [f"[{_escape(text)}]({link})" if link else literal(text) for text, link in parts]
    text = sentence("".join(words))
    named = {link for _, link in parts}
    rest = [(n, place) for n, place in enumerate(result.related, start=1) if n not in named][:MAX_LINKS]
    if not rest:
        return text
    return f"{text} See {', '.join(f'[{_escape(label(place))}]({n})' for n, place in rest)}."


def sentence(text: str) -> str:
    """One line with single spaces, without control characters, ending in a period (SARIF multitool, SARIF2001)."""
    line = shorten(terminal(" ".join(text.split())), MAX_MESSAGE)
    if not line:
        return "No message."
    return line if line[-1] in ".!?" else line + "."


def label(place: Related) -> str:
    """What a related place is called: its message without the final period, else ``path:line``."""
    words = terminal(" ".join(place.message.split())).rstrip(".")
    return shorten(words or terminal(str(place.location)), MAX_LABEL)


def shorten(text: str, limit: int) -> str:
    """*text*, cut to *limit* characters with an ellipsis if it is longer."""
    return text if len(text) <= limit else text[: limit - 3] + "..."


def number(value: float | None) -> float | int | None:
    """A metric's value as JSON can hold it: whole numbers without a fraction, None for what is no number."""
    if value is None or not isfinite(value):
        return None
    return int(value) if value == int(value) else value


def _parts(result: Result) -> Iterator[tuple[str, int]]:
    """The message in pieces, each with the id that it links to, or 0. Checks of haros-ci write no links: what reads so is a name of the workspace."""
    text, start = result.message[: MAX_MESSAGE * 2], 0
    for match in _LINK.finditer(text) if result.related and result.tool != TOOL else ():
        if 1 <= int(match[2]) <= len(result.related):
            yield text[start : match.start()], 0
            yield re.sub(r"\\([\[\]\\])", r"\1", match[1]), int(match[2])
            start = match.end()
    yield text[start:], 0


def literal(text: str) -> str:
    """*text* for a message of SARIF that has no links: brackets stay readable as they are, unless a reader could take them for a link (§3.11.6)."""
    return _escape(text) if "](" in text else text


def _escape(text: str) -> str:
    return text.replace("\\", "\\\\").replace("[", "\\[").replace("]", "\\]")
