# SPDX-License-Identifier: Apache-2.0
"""How it is said that a change silences something."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.results.result import Silenced

MAX_NAMED = 5
#: Of what comments come to hide more is named: it is wrong for certain.
MAX_MORE = 20


def sentences(silenced: Silenced) -> Iterator[str]:
    """Up to three sentences: on findings that are suppressed, on comments whose effect nobody sees, and on old comments, with the first places."""
    if silenced.findings:
        one = silenced.findings == 1
        yield f"{silenced.findings:,} finding{'' if one else 's'} suppressed by comments that this change adds"
    if silenced.comments:
        number = len(silenced.comments)
        named = ", ".join(f"{place} ({name})" for place, name in silenced.comments[:MAX_NAMED])
        more = f" and {number - MAX_NAMED:,} more" if number > MAX_NAMED else ""
        noun = "comment that silences" if number == 1 else "comments that silence"
        yield f"the change adds {number:,} {noun} linters: {named}{more}"
    yield from _more(silenced)


def _more(silenced: Silenced) -> Iterator[str]:
    if silenced.more:
        number = len(silenced.more)
        named = ", ".join(f"{place} ({name})" for place, name in silenced.more[:MAX_MORE])
        more = f" and {number - MAX_MORE:,} more" if number > MAX_MORE else ""
        yield f"comments silence more than they did in {number:,} place{'' if number == 1 else 's'}: {named}{more}"


def counted(silenced: Silenced) -> str:
    """The same in few words, for a summary; "" if there is nothing to say."""
    parts = []
    if silenced.findings:
        parts.append(f"{silenced.findings:,} finding{'' if silenced.findings == 1 else 's'} suppressed by this change")
    if number := len(silenced.comments):
        parts.append(
            f"{number:,} comment{' that silences' if number == 1 else 's that silence'} linters added by this change"
        )
    if number := len(silenced.more):
        parts.append(f"{number:,} more silenced by comments")
    return "; ".join(parts)
