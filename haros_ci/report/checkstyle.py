# SPDX-License-Identifier: Apache-2.0
"""Checkstyle's XML, which Jenkins' warnings plugin, reviewdog and many editors read: the open findings by file.

``source`` is ``haros-ci.TOOL.RULE``: readers take what stands behind the last dot for the rule and the word before for its
category. Columns count Unicode code points. The format has no place for what is known, suppressed or gone, nor for trouble with tools.
"""

from __future__ import annotations

from itertools import groupby

from haros_ci.report.message import plain
from haros_ci.report.xml_tags import HEAD, tag
from haros_ci.results.result import Report, Result
from haros_ci.results.rule import Level

#: Of Checkstyle's severities (error, warning, info, ignore) those that mean something here.
SEVERITIES = {Level.ERROR: "error", Level.WARNING: "warning", Level.NOTE: "info"}
#: The format's version as readers know it; it has not changed since.
VERSION = "4.3"


def render(report: Report) -> str:
    """The document. A finding on a whole file is on line 1, as Checkstyle writes its own."""
    text = [f"{HEAD}{tag('checkstyle', {'version': VERSION})}"]
    for path, results in groupby(report.shown(), lambda result: result.location.path):
        text += [tag("file", {"name": path}), *map(_error, results), "</file>"]
    return "\n".join([*text, "</checkstyle>", ""])


def _error(result: Result) -> str:
    place = result.location
    attributes: dict[str, str | int | None] = {
        "line": place.line or 1,
        "column": place.column,
        "severity": SEVERITIES[result.level],
        "message": plain(result),
        "source": f"haros-ci.{result.tool}.{result.rule}",
    }
    return tag("error", attributes, closed=True)
