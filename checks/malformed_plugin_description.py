# SPDX-License-Identifier: Apache-2.0
"""Exported descriptions of plug-ins that are no XML."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project
from haros_ci.api.packages import exported_under

_SAID = "not well-formed XML: "
#: What tinyxml2, by which pluginlib reads the file, refuses, too; it takes a bare ``<`` or ``&`` in a text.
_REFUSED = ("mismatched tag", "no element found", "unclosed token", "unclosed CDATA section")


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        exports = exported_under(package)
        for problem in package.build.problems:
            what = problem.message.removeprefix(_SAID)
            if problem.path in exports and problem.message.startswith(_SAID) and what in _REFUSED:
                bases = ", ".join(sorted(exports[problem.path]))
                yield Finding(
                    at=Location(problem.path, problem.line or 1),
                    message=f"the plug-in description for {bases} is not well-formed XML ({what}): pluginlib can load none of its "
                    "classes; correct the XML",
                    about=(package.name, problem.path.removeprefix(f"{package.path}/")),
                    related=tuple((place, "exported here") for place in exports[problem.path].values()),
                )


CHECK = Check(
    id="malformed-plugin-description",
    summary="Plug-in description that is not well-formed XML.",
    level=Level.ERROR,
    project=check,
    tags=("plugins",),
)
