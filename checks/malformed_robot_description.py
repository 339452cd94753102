# SPDX-License-Identifier: Apache-2.0
"""Descriptions of robots that are no XML."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project
from haros_ci.api.robots import is_left_over, malformed

#: What tinyxml2, by which urdfdom reads the file, refuses, too; it takes a bare ``<`` or ``&`` in a text. xacro refuses all.
_REFUSED = ("mismatched tag", "no element found", "unclosed token", "unclosed CDATA section")


def check(project: Project) -> Iterator[Finding]:
    for at, what in malformed(project):
        is_xacro = at.path.endswith(".xacro")
        if is_xacro or (at.path.endswith(".urdf") and what in _REFUSED):
            yield Finding(
                at=at,
                message=f"the description of a robot is not well-formed XML ({what}): {'xacro' if is_xacro else 'urdfdom'} refuses the whole "
                "file; correct the XML",
                about=(at.path,),
                level=Level.NOTE if _is_old(at.path, project) else None,
            )


def _is_old(path: str, project: Project) -> bool:
    """Whether the file has been left behind, and is as it was at the base revision."""
    if project.base is not None and project.base.text(path) != project.text(path):
        return False
    return is_left_over(path, project)


CHECK = Check(
    id="malformed-robot-description",
    summary="Description of a robot (xacro, URDF) that is not well-formed XML.",
    level=Level.ERROR,
    tags=("robot-description",),
    project=check,
)
