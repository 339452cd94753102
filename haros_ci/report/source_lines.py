# SPDX-License-Identifier: Apache-2.0
"""Lines of source as reports quote them: split as editors do, cut, masked."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache

from haros_ci.regex import regex
from haros_ci.report.escape import terminal

#: Reads a file of the workspace by its path; "" if it is not there.
Reader = Callable[[str], str]

MAX_QUOTED = 400
_SECRET = regex(
    r"""(?i:pass(?:word|wd)|secret|token|api_?key|credentials?)["']?\s*[:=]\s*["'](?P<value>[^"']{4,})"""
    r"""|\b(?:gh[pousr]_\w{20,}|github_pat_\w{20,}|glpat-[\w-]{20,}|AKIA[0-9A-Z]{16}|xox[abprs]-[\w-]{10,})"""
)
#: One of these stands in every line that ``_SECRET`` matches; looking for them is ten times faster.
_MARKS = ('"', "'", "ghp_", "gho_", "ghu_", "ghs_", "ghr_", "github_pat_", "glpat-", "AKIA", "xox")


def split(text: str) -> list[str]:
    """Lines without their ends; CR LF, LF and CR each end one, form feeds and Unicode separators do not."""
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def lines_of(read: Reader) -> Callable[[str], list[str]]:
    """*read*, then split; remembers the last few files, as results come sorted by path."""
    return lru_cache(maxsize=16)(lambda path: split(read(path)))


@lru_cache(maxsize=4096)
def quoted(line: str) -> str:
    """A line for a log: cut, control characters replaced and secrets masked, one for one, so that columns still fit."""
    line = line[:MAX_QUOTED]
    if not line.isprintable():
        line = "\t".join(terminal(part) for part in line.split("\t"))
    return _SECRET.sub(_masked, line) if any(mark in line for mark in _MARKS) else line


def _masked(match: re.Match[str]) -> str:
    start, end = match.span("value") if match["value"] is not None else match.span()
    return match.string[match.start() : start] + "*" * (end - start)
