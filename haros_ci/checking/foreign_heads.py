# SPDX-License-Identifier: Apache-2.0
"""Files that somebody else has written: their first comment has a copyright line of an owner whom no manifest of the workspace names."""

from __future__ import annotations

import re

from haros_ci.model.copyright_owners import owners_in
from haros_ci.regex import regex

#: Characters of a file that are looked at.
_MOST = 8_192
#: The first comments, of XML, or of Python and YAML.
_HEAD = regex(r"\s*(?:<\?xml[^>\n]{0,200}\?>\s*)?(<!--.*?-->|#[^\n]*(?:\n[ \t]*#[^\n]*)*)", re.DOTALL)


def is_of_others(text: str, people: frozenset[str]) -> bool:
    """Whether the first comment of *text* has copyright lines, each of an owner of whose name no word is in *people*, the words of all manifests."""
    head = _HEAD.match(text[:_MOST].removeprefix("\ufeff"))
    owners = owners_in(head[1]) if head is not None else frozenset()
    return bool(owners) and owners.isdisjoint(people)
