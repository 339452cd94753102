# SPDX-License-Identifier: Apache-2.0
"""dynamic_reconfigure files that generate a class of another name than their own (dynamic_reconfigure-macros.cmake, NAME_WE), or in the namespace of
another package (parameter_generator_catkin.py, generate)."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, regex

_CALL = regex(r"\bgenerate\s*\(")
_GENERATE = regex(r"\bgenerate\s*\(\s*(?:[\"'](\w+)[\"']|(\w+))\s*,")
_ASSIGNED = r"^{0}\s*=\s*[\"'](\w+)[\"']\s*(?:#.*)?$"


def check(project: Project) -> Iterator[Finding]:
    yield from _classes(project)
    for package in project.packages:
        for config in package.build.configs:
            yield from _name_spaces(package, config.path, config.name)


def _name_spaces(package: ProjectPackage, path: str, name: str) -> Iterator[Finding]:
    """The C++ class is in the namespace that generate() is given first, its header in the directory of CMake's project."""
    project = package.project
    listed = (c.place(word) for c in package.commands("generate_dynamic_reconfigure_options") for word in c.arguments)
    text = project.text(path)
    calls = list(_GENERATE.finditer(text))
    if path not in listed or len(calls) != 1:
        return
    call = calls[0]
    assigned = re.findall(_ASSIGNED.format(re.escape(call[2])), text, re.MULTILINE) if call[2] else [call[1]]
    other = assigned[0] if len(assigned) == 1 else package.name
    if other == package.name or project.package(other) is not None or project.knowledge.is_known(other):
        return
    header, right = f"{other}/{name}Config.h", f"{package.name}/{name}Config.h"
    is_used = re.compile(rf"(?<![\w:]){re.escape(package.name)}::{re.escape(name)}Config\b")
    for file in package.files:
        code = project.text(file.path) if file.language == "cpp" else ""
        includes = re.search(rf"^[ \t]*#[ \t]*include[ \t]*[<\"]{re.escape(header)}[>\"]", code, re.MULTILINE)
        found = includes or is_used.search(code)
        if found is None:
            continue
        line = code.count("\n", 0, found.start()) + 1
        message = f"includes {header}" if includes else f"uses {package.name}::{name}Config"
        yield Finding(
            at=Location(path, text.count("\n", 0, call.start()) + 1),
            message=f"{posixpath.basename(path)} generates {name}Config for the package {other}, but it belongs to {package.name}: the header is "
            f"{right}, with the class in the namespace {other}, and {file.path} {message}, so that it does not build; write "
            f'"{package.name}" as the package, and in the code {right} and {package.name}::{name}Config',
            about=(package.name, path),
            related=((Location(file.path, line), message),),
            level=Level.ERROR,
        )
        return


def _classes(project: Project) -> Iterator[Finding]:
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
            use = f"include <{package.name}/{stem}Config.h>"
            if not _is_included(package, (stem, config.name)):
                use = f"import {stem}Config from {package.name}.cfg"
            yield Finding(
                at=Location(config.path, text.count("\n", 0, calls[-1].start()) + 1 if calls else 1),
                message=f"{posixpath.basename(config.path)} generates {config.name}Config, but CMake waits for {stem}Config: the headers are "
                "made again in each build, with all that includes them, or not in time; give generate() the name of the file, "
                f'"{stem}", and {use}, or rename the file to {config.name}.cfg',
                about=(package.name, config.path),
                related=((command.location, "CMake takes the name from the file's name here"),),
            )


def _is_included(package: ProjectPackage, names: tuple[str, str]) -> bool:
    """Whether C++ of the workspace includes a header of one of the *names*, or no Python imports such a class: C++ elsewhere may."""
    project = package.project
    words = "|".join(re.escape(name) for name in names)
    header = re.compile(rf"\b{re.escape(package.name)}/(?:{words})Config\.h\b")
    imported = re.compile(rf"\b{re.escape(package.name)}\.cfg\b[^\n]{{0,200}}\b(?:{words})Config\b")
    texts = [
        (file.language, project.text(file.path))
        for file in project.workspace.files
        if file.language in ("cpp", "python")
    ]
    if any(language == "cpp" and header.search(text) for language, text in texts):
        return True
    return not any(language == "python" and imported.search(text) for language, text in texts)


CHECK = Check(
    id="config-name-mismatch",
    summary="Configuration of dynamic_reconfigure that is not named like its file, or its package.",
    level=Level.WARNING,
    tags=("build", "parameters"),
    project=check,
)
