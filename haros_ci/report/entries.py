# SPDX-License-Identifier: Apache-2.0
"""What a manifest lacks, as lines to write: a finding on an entry that is missing has no line of its own to show."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.regex import regex
from haros_ci.results.own import TOOL
from haros_ci.results.result import Result

#: Rules on entries that a package.xml lacks; they stand behind those that there are.
_LACKING = regex(r"undeclared-[a-z-]{1,40}")
_ADVICE = regex(r"\badd (?=<)")
_TAG = regex(r"<(\w{1,40})>[^<>\s]{1,200}</\1>")
_BETWEEN = regex(r"(?:, | and )(?=<)")
#: So many lines are shown.
MOST = 30


def lines_to_add(results: Iterable[Result]) -> tuple[str, ...]:
    """The entries that *results* at one line of a package.xml ask for, those that they stand for in the same file included; each once, MOST at most."""
    found: dict[str, None] = {}
    for result in results:
        for one in (result, *result.copies):
            if _is_lacking(one) and one.location.path == result.location.path:
                found.update(dict.fromkeys(_tags(one.message)))
    return tuple(found)[:MOST]


def _is_lacking(result: Result) -> bool:
    is_manifest = result.location.path.rpartition("/")[2] == "package.xml"
    return is_manifest and result.tool == TOOL and _LACKING.fullmatch(result.rule) is not None


def _tags(message: str) -> list[str]:
    """The tags of the first advice to add some: ``add <depend>a</depend>, <depend>b</depend> and …``."""
    advice = _ADVICE.search(message)
    tags: list[str] = []
    at = advice.end() if advice else len(message)
    while (tag := _TAG.match(message, at)) is not None:
        tags.append(tag[0])
        between = _BETWEEN.match(message, tag.end())
        at = between.end() if between else len(message)
    return tags
