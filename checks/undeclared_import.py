# SPDX-License-Identifier: Apache-2.0
"""Packages whose Python modules installed files import, and that no declared dependency brings."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import (
    Need,
    Provisions,
    Sources,
    add_dependency,
    first_provider,
    imports_of,
    is_of_ros,
    last_dependency,
    needs_of,
    others_of,
)

_SHOWN = 3
_PIP = re.compile(r"\bpip3?\s+install\s+([^;&|]*)")
_KEY = re.compile(r"^python3?-|-pip$")


def check(project: Project) -> Iterator[Finding]:
    provisions, sources = Provisions(project), Sources(project)
    for package in project.packages:
        needs = list(imports_of(package, sources)) if package.manifest is not None else []
        provided = provisions.of(package, tests=False) if needs else None
        by_pip = set(_by_pip(package)) if needs else set()
        missing: dict[frozenset[str], list[Need]] = {}
        for need in needs:
            names = {_KEY.sub("", name).lower() for name in (need.what.removeprefix("import "), *need.providers)}
            if provided is not None and not names & by_pip and provisions.lacks(provided, need.providers):
                missing.setdefault(need.providers, []).append(need)
        built = _for_building(package, provisions, sources) if missing else frozenset()
        for providers, uses in missing.items():
            if not providers & built:
                yield _finding(package, uses)


def _for_building(package: ProjectPackage, provisions: Provisions, sources: Sources) -> frozenset[str]:
    """What undeclared-dependency has *package* declare: that is there when it runs, too."""
    provided = provisions.of(package, tests=False)
    lacking = (need.providers for need in needs_of(package, sources) if provisions.lacks(provided, need.providers))
    return frozenset(first_provider(providers, package) for providers in lacking)


def _by_pip(package: ProjectPackage) -> Iterator[str]:
    """What the build itself installs with pip."""
    for command in package.commands("execute_process", "add_custom_command", "add_custom_target", "install"):
        for match in _PIP.finditer(" ".join(command.arguments)):
            yield from (re.split(r"[=<>~!\[]", word.strip("\"'"))[0].lower() for word in match[1].split())


def _finding(package: ProjectPackage, uses: list[Need]) -> Finding:
    tested = sorted(uses[0].providers & package.declared)
    if tested:
        return _only_tested(package, tested[0], uses)
    name = first_provider(uses[0].providers, package)
    others = others_of(uses[0].providers, name, package)
    kind = "exec_depend" if package.raw.format > 1 else "run_depend"
    is_certain = not others and is_of_ros(name, package.project)
    fix = add_dependency(package, "exec_depend", name) if is_certain else None
    is_pip = all(key.endswith("-pip") for key in (name, *others))
    if name.startswith("python3-") and not name.endswith("-pip"):
        others = []  # of Python 2, of pip, or with more than the module
    alternative = f" (or {', '.join(others)})" if others else ""
    module = uses[0].what.removeprefix("import ")
    return Finding(
        at=last_dependency(package),
        message=f"{package.name} imports {module}, but package.xml declares no package that provides it: the import fails "
        f"on a machine without {name}; add <{kind}>{name}</{kind}>{alternative}",
        about=(package.name, name),
        related=tuple((use.location, f"needs {name}: {use.what}") for use in uses[:_SHOWN]),
        apart=(name,),
        level=Level.NOTE if is_pip else None,  # bloom takes no keys of pip: many have their users install such by hand
        fixes=() if fix is None else (fix,),
    )


def _only_tested(package: ProjectPackage, name: str, uses: list[Need]) -> Finding:
    """What the manifest has for tests alone, and more than tests use."""
    kind = "exec_depend" if package.raw.format > 1 else "run_depend"
    line = next((each.line for each in package.raw.dependencies if each.name == name), None)
    return Finding(
        at=Location(package.manifest_path, line or 1),
        message=f"{package.name} imports {name} ({uses[0].what}), but declares it for tests only: an installation without "
        f"tests lacks it; write <{kind}>{name}</{kind}>",
        about=(package.name, name),
        level=Level.WARNING,
        related=tuple((use.location, f"needs {name}: {use.what}") for use in uses[:_SHOWN]),
        apart=(name,),
    )


CHECK = Check(
    id="undeclared-import",
    summary="Python import that package.xml does not declare.",
    level=Level.ERROR,
    project=check,
    catalogue="M02",
    tags=("packages", "python"),
)
