# SPDX-License-Identifier: Apache-2.0
"""Unified diffs of tools that would rewrite files: where each begins to differ."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from haros_ci.regex import regex

_HUNK = regex(r"@@ -(\d+)")


def first_changes(diff: str, names: Mapping[str, str]) -> Iterator[tuple[str, int]]:
    """Path and first changed line (of the file as it is) for each file in *diff*; *names* are paths by their heading.

    No line of a file can be taken for a heading: in a hunk none begins with ``@@``. Raises ValueError for a file of
    another name.
    """
    lines = diff.split("\n")
    for i in range(len(lines) - 2):
        hunk = _HUNK.match(lines[i + 2])
        if hunk and lines[i].startswith("--- ") and lines[i + 1].startswith("+++ "):
            name = lines[i][4:].rpartition("\t")[0]
            if name not in names:
                raise ValueError("a difference in a file that was not asked for")
            context = 0
            while i + 3 + context < len(lines) and lines[i + 3 + context].startswith(" "):
                context += 1
            yield names[name], max(1, int(hunk[1]) + context)
