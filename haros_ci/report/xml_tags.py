# SPDX-License-Identifier: Apache-2.0
"""XML 1.0 as text, from foreign names and messages: always well-formed, one tag a line."""

from __future__ import annotations

import re
from collections.abc import Iterable

from haros_ci.regex import regex
from haros_ci.report.escape import REPLACEMENT, terminal

HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
_NO_CHARACTER = regex("[\ufffe\uffff]")  # XML 1.0 §2.2 leaves them out, beside those that ``terminal`` replaces


def escaped(text: str) -> str:
    """*text* as one line that reads the same in an attribute and in an element: what ``terminal`` leaves of it."""
    line = _NO_CHARACTER.sub(REPLACEMENT, terminal(text))
    return line.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")


def tag(name: str, attributes: dict[str, str | int | None], *, closed: bool = False) -> str:
    """A start tag, or a whole element with *closed*; an attribute that is None is left out."""
    written = "".join(f' {key}="{escaped(str(value))}"' for key, value in attributes.items() if value is not None)
    return f"<{name}{written}{'/>' if closed else '>'}"


def lines(texts: Iterable[str]) -> str:
    """The text of an element, one line for each of *texts*.

    A line that begins with ``::`` is a command to a GitHub runner that reads it in a log: its first colon becomes a
    character reference, which a reader of XML does not see.
    """
    written = (escaped(text) for text in texts)
    return "\n".join(re.sub(r"^(\s*):(?=:)", r"\1&#58;", line) for line in written)
