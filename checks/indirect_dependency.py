# SPDX-License-Identifier: Apache-2.0
"""Packages that a package uses by itself, and gets only because others that it declares need them."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, regex
from haros_ci.api.packages import (
    Need,
    Provisions,
    add_dependency,
    dependency_tags,
    imports_of,
    is_of_ros,
    last_dependency,
    needs_of,
)

_SHOWN = 3
#: Packages that a build runs and that nothing of what is built needs (REP 149, buildtool_depend).
_TOOL = regex(r"(?:ament_cmake\w*|\w+_cmake_module|rosidl_default_generators|catkin)$")


def check(project: Project) -> Iterator[Finding]:
    provisions, sources = Provisions(project), project.sources
    for package in project.packages:
        if package.manifest is None:
            continue
        uses = [*needs_of(package, sources), *imports_of(package, sources)]
        tests = [*needs_of(package, sources, tests=True), *imports_of(package, sources, tests=True)]
        provided = provisions.of(package).names if uses or tests else frozenset()
        indirect: dict[str, list[Need]] = {}
        for use in (*uses, *tests):
            names = list(use.providers & provided)  # with several it is not said which one it comes from
            if not use.providers & package.declared and len(names) == 1 and names[0] != package.name:
                if is_of_ros(names[0], project):
                    indirect.setdefault(names[0], []).append(use)
        for name, found in indirect.items():
            yield _finding(package, name, found, all(use in tests for use in found))


def _finding(package: ProjectPackage, name: str, uses: list[Need], is_test: bool) -> Finding:
    is_built = any(use.is_header or use.what.startswith("find_package") for use in uses)
    kind = "exec_depend" if not is_built else "buildtool_depend" if _TOOL.match(name) else "depend"
    kind = "test_depend" if is_test else kind
    fix = add_dependency(package, kind, name)
    return Finding(
        at=last_dependency(package),
        message=f"{package.name} uses {name} ({uses[0].what}), but has it only as a dependency of a dependency: the build "
        f"breaks when that one drops it; add {dependency_tags(package, kind, name)}",
        about=(package.name, name),
        related=tuple((use.location, f"uses {name}: {use.what}") for use in uses[:_SHOWN]),
        apart=(name,),
        fixes=() if fix is None else (fix,),
    )


CHECK = Check(
    id="indirect-dependency",
    summary="Direct use of a package that is only an indirect dependency.",
    level=Level.NOTE,
    project=check,
    tags=("packages", "build"),
    profiles=("strict",),
)
