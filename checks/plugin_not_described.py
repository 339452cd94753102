# SPDX-License-Identifier: Apache-2.0
"""Classes that a library registers as plug-ins, and that no description names."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, regex
from haros_ci.api.packages import Registration, exported_under, meant_classes, registrations

#: The macros of pluginlib: what class_loader's own register may be loaded without a description.
_MACRO = "PLUGINLIB_"
_TEST = regex(r"(?:^|[/_])(?:tests?|mocks?|dummy|examples?)(?:[/_.]|$)")
#: Where a description may stand, or be made of.
_TEXTS = (".xml", ".in", ".em", ".jinja", ".cmake", ".txt")


def check(project: Project) -> Iterator[Finding]:
    # In other letters, too: plugin-not-loadable says of TestNc that TestNC is registered.
    described = {_last(plugin.type).lower() for package in project.packages for plugin in package.build.plugins}
    for package in project.packages:
        missing = [
            registration for registration in _registered(package) if _last(registration.type).lower() not in described
        ]
        if not missing:
            continue
        meant = set(meant_classes(package).values())  # plugin-not-loadable says what to write in the description
        words = {
            word
            for path in project.below(package.path)
            if path.endswith(_TEXTS)
            for word in re.findall(r"\w+", project.text(path))
        }
        for registration in missing:
            if registration not in meant and _last(registration.type) not in words:
                yield _finding(package, registration)


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
    for registration in registrations(package):
        is_plain = re.fullmatch(r"[\w:]+", registration.type) is not None
        inner = registration.location.path.removeprefix(f"{package.path}/")
        space = registration.type.lstrip(":").partition("::")[0]
        if space != package.name and package.project.knowledge.is_package(space):
            continue  # a class of another package, which describes it
        if (
            is_plain
            and registration.macro.startswith(_MACRO)
            and registration.location.path in built
            and not _TEST.search(inner)
        ):
            yield registration


def _finding(package: ProjectPackage, registration: Registration) -> Finding:
    return Finding(
        at=registration.location,
        message=f"{package.name} registers {registration.type} as a {registration.base}, but its plug-in description does not list it: "
        "pluginlib cannot load the class; add a <class> element to the exported description",
        about=(package.name, registration.type),
        apart=(registration.type,),
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
