# SPDX-License-Identifier: Apache-2.0
"""Variables of the environment that launch files set, by which nodes of ROS 2 do not find each other: the model connects them all the same.

docs.ros.org, About Domain ID, and Improved Dynamic Discovery.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments
from haros_ci.results.result import Notification

#: Places that are named; the rest is counted.
MOST = 10
_VARIABLE = regex(
    r"(?<!\w)(?:ROS_DOMAIN_ID|ROS_LOCALHOST_ONLY|ROS_AUTOMATIC_DISCOVERY_RANGE|ROS_STATIC_PEERS|ROS_DISCOVERY_SERVER|RMW_IMPLEMENTATION)(?!\w)"
)
_COMMENT = regex(r"<!--(?:[^-]|-(?!->))*(?:-->|\Z)")
_REMARK = regex(r"(?:^|[ \t])#[^\n]*", re.MULTILINE)
_OF_LAUNCH = regex(r"\blaunch(?:_ros)?\.actions\b|\blaunch_ros\b")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such variable in launch files of *head* that no file of *base* which changed or is gone has; none without a base."""
    if base is None:
        return ()
    rest = "places of launch files name variables by which nodes may not find each other, since this change"
    return notes(brought(head, base, _look), MOST, rest)


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    def look(file: SourceFile) -> Iterator[Found]:
        is_read = file.language in ("launch", "python", "xml", "yaml")
        for line, name in variables(workspace.text(file.path), file.language) if is_read else ():
            words = f"{name} may be another one for a part of the nodes, which then do not find the others"
            yield line, words, f"since this change {words}; the model connects them all the same; look at it"

    return look


def variables(text: str, language: str | None) -> Iterator[tuple[int, str]]:
    """The lines of these variables in a launch file of that *language*, outside of comments; takes linear time."""
    if "ROS_" not in text and "RMW_" not in text:
        return
    if language == "python" or text.lstrip("\ufeff \t\r\n").startswith(("import", "from", "#!", '"""')):
        if _OF_LAUNCH.search(text) is None:
            return
        code = without_comments(text, "python")
    elif text.lstrip("\ufeff \t\r\n").startswith("<"):
        code = _COMMENT.sub(lambda match: "\n" * match[0].count("\n"), text)
    else:
        code = _REMARK.sub("", text)
    line, last = 1, 0
    for match in _VARIABLE.finditer(code):
        line, last = line + code.count("\n", last, match.start()), match.start()
        yield line, match[0]
