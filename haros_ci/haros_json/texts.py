# SPDX-License-Identifier: Apache-2.0
"""Texts as the visualizer can show them: it puts what it reads into its pages as HTML (``<%= %>`` of its templates)."""

from __future__ import annotations

import html
from urllib.parse import urlsplit

from haros_ci.report.escape import terminal

LONGEST = 4000


def words(text: str) -> str:
    """*text* on one line, nothing of it HTML."""
    return html.escape(terminal(" ".join(text[:LONGEST].split())), quote=True)


def name(text: str) -> str:
    """A name or path, its spaces kept; nothing of it HTML."""
    return html.escape(terminal(text[:LONGEST]), quote=True)


def optional(text: str | None) -> str | None:
    return None if text is None else name(text)


def paragraphs(*lines: str) -> str:
    """*lines*, each escaped, with HTML's line breaks between: the visualizer makes one only of the first line feed."""
    return "<br>".join(words(line) for line in lines if line)


def link(address: str) -> str | None:
    """*address*, if it is one of the web: the visualizer makes a link of it, and shows its host."""
    try:
        parts = urlsplit(address.strip())
    except ValueError:
        return None
    is_link = parts.scheme in ("http", "https") and parts.netloc and not any(c.isspace() for c in address.strip())
    return name(address.strip()) if is_link else None
