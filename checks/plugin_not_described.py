# SPDX-License-Identifier: Apache-2.0
"""Classes that a library registers as plug-ins, and that no description names."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import Registration, exported_under, registrations

#: The macros of pluginlib: what class_loader's own register may be loaded without a description.
_MACRO = "PLUGINLIB_"
_TEST = re.compile(r"(?:^|[/_])(?:tests?|mocks?|dummy|examples?)(?:[/_.]|$)")
#: Where a description may stand, or be made of.
_TEXTS = (".xml", ".in", ".em", ".jinja", ".cmake", ".txt")


def check(project: Project) -> Iterator[Finding]:
    described = {_last(each.type) for package in project.packages for each in package.build.plugins}
    for package in project.packages:
        missing = [each for each in _registered(package) if _last(each.type) not in described]
        if not missing:
            continue
        words = {
            word
            for path in project.workspace.names
            if path.endswith(_TEXTS) and (package.path == "." or path.startswith(f"{package.path}/"))
            for word in re.findall(r"\w+", project.text(path))
        }
        for each in missing:
            if _last(each.type) not in words:
                yield _finding(package, each)


def _registered(package: ProjectPackage) -> Iterator[Registration]:
    """What is registered in files that are compiled for certain, and not for tests."""
    if _TEST.search(package.name):
        return
    built = {
        path
        for target in package.build.targets
        if target.kind == "library" and not (target.is_test or target.is_conditional)
        for path in target.sources
        if path not in target.conditional_sources
    }
    for each in registrations(package):
        is_plain = re.fullmatch(r"[\w:]+", each.type) is not None
        inner = each.location.path.removeprefix(f"{package.path}/")
        space = each.type.lstrip(":").partition("::")[0]
        if space != package.name and package.project.knowledge.is_package(space):
            continue  # a class of another package, which describes it
        if is_plain and each.macro.startswith(_MACRO) and each.location.path in built and not _TEST.search(inner):
            yield each


def _finding(package: ProjectPackage, each: Registration) -> Finding:
    return Finding(
        at=each.location,
        message=f"{package.name} registers {each.type} as a {each.base}, but its plug-in description does not list it: "
        "pluginlib cannot load the class; add a <class> element to the exported description",
        about=(package.name, each.type),
        apart=(each.type,),
        related=tuple((Location(path, 1), "an exported description") for path in exported_under(package)),
    )


def _last(name: str) -> str:
    return name.rpartition("::")[2].strip()


CHECK = Check(
    id="plugin-not-described",
    summary="Registered plug-in class that no plug-in description lists.",
    level=Level.WARNING,
    project=check,
    tags=("plugins",),
)
