# SPDX-License-Identifier: Apache-2.0
"""dynamic_reconfigure files that generate a class of another name than their own (dynamic_reconfigure-macros.cmake, NAME_WE)."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project

_CALL = re.compile(r"\bgenerate\s*\(")


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        listed = {
            command.place(word): command
            for command in package.commands("generate_dynamic_reconfigure_options")
            for word in command.arguments
        }
        for config in package.build.configs:
            stem = posixpath.basename(config.path).partition(".")[0]
            command = listed.get(config.path)
            if command is None or config.name == stem:
                continue
            text = project.text(config.path)
            calls = list(_CALL.finditer(text))
            yield Finding(
                at=Location(config.path, text.count("\n", 0, calls[-1].start()) + 1 if calls else 1),
                message=f"{posixpath.basename(config.path)} generates {config.name}Config, but CMake waits for {stem}Config: the headers are "
                "made again in each build, with all that includes them, or not in time; give generate() the name of the file, "
                f'"{stem}", and include <{package.name}/{stem}Config.h>, or rename the file to {config.name}.cfg',
                about=(package.name, config.path),
                related=((command.location, "CMake takes the name from the file's name here"),),
            )


CHECK = Check(
    id="config-name-mismatch",
    summary="Configuration of dynamic_reconfigure that is not named like its file.",
    level=Level.WARNING,
    tags=("build", "parameters"),
    project=check,
)
