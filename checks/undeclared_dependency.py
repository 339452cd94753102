# SPDX-License-Identifier: Apache-2.0
"""Packages whose headers or CMake configuration a build needs, and that no declared dependency brings."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage, listed, regex
from haros_ci.api.packages import (
    BUILD_TOOLS,
    COUNTERPARTS,
    ENVIRONMENT,
    Need,
    Provisions,
    add_dependency,
    boost_keys,
    closes_a_cycle,
    counted,
    dependency_tags,
    downloads,
    first_provider,
    has_environment,
    idle_commands,
    is_nowhere,
    is_of_ros,
    last_dependency,
    needs_of,
    others_of,
    repositories_named,
    said_misplaced,
    said_never,
    stem_of_system,
    undeclared_build_tools,
)

#: Boost without its libraries.
HEADERS = "libboost-dev"
#: What rosdep's keys have beside the name of the library: libnlopt-cxx-dev.
_AFFIXES = regex(r"^lib|-(?:dev|devel|cxx|cpp|all|vendor)\b|(?:-?\d[\d.]*)$|-dev\b")
#: The beginnings of names of packages that tests alone need.
_TESTING = (
    "ament_lint_",
    "ament_cmake_gtest",
    "ament_cmake_gmock",
    "ament_cmake_pytest",
    "ament_cmake_test",
    "launch_testing",
    "ros_testing",
)
_GENERATORS = ("rosidl_default_generators", "message_generation")
_SHOWN = 3
#: A condition of CMake that reads a variable that ros_environment sets.
_VARIABLE = regex(r"^[ \t]*(?:else)?if[ \t]*\([^\n#]*\$ENV\{(ROS_DISTRO|ROS_VERSION)\}", re.IGNORECASE | re.MULTILINE)


def check(project: Project) -> Iterator[Finding]:
    yield from undeclared_build_tools(project)
    provisions, sources = Provisions(project), project.sources
    proposed: dict[
        str, frozenset[str]
    ] = {}  # by package what is advised so far: two advices must close no cycle either
    for package in project.packages:
        needs = list(needs_of(package, sources)) if package.manifest is not None else []
        provided = provisions.of(package, tests=False) if package.manifest is not None else None
        missing: dict[frozenset[str], list[Need]] = {}
        for need in needs:
            if provided is not None and provisions.lacks(provided, need.providers):
                _put(missing, need)
        undeclared = {
            providers: uses for providers, uses in missing.items() if not _is_reported_elsewhere(package, providers)
        }
        brought = _coming_along(package, undeclared, provisions)
        for providers, uses in undeclared.items():
            if providers in brought:
                continue
            name = first_provider(providers, package)
            if name not in package.declared and closes_a_cycle(package.name, name, project.manifests, proposed):
                yield _circular(package, name, uses)
            else:
                proposed[package.name] = proposed.get(package.name, frozenset()) | {name}
                others = [undeclared[group] for group, by in brought.items() if by == providers]
                yield _finding(package, providers, uses, others, provisions)
        deciding = [] if provided is None or provided.is_open else list(_environment(package))
        if deciding and not has_environment(package, provisions):
            yield from deciding


def _is_reported_elsewhere(package: ProjectPackage, providers: frozenset[str]) -> bool:
    """Whether another check has it declared: foreign-dependency for one of the other ROS, incomplete-interface-package for a generator, misspelt-dependency
    for a name with other separators (``pose-cov-ops``) or a version (``opencv2``)."""
    plain = {name.replace("-", "_").lower() for name in providers}
    for name in package.declared:
        stem = stem_of_system(name)
        written = {name.replace("-", "_").lower(), stem, f"lib{stem}_dev", f"python3_{stem}"}
        if not written.isdisjoint(plain) and is_nowhere(name, package.project):
            return True
    instead = (
        {COUNTERPARTS[package.ros].get(name) for name in package.declared} if package.ros in COUNTERPARTS else set()
    )
    generates = package.commands("rosidl_generate_interfaces", "generate_messages")
    return bool(providers & instead) or (bool(generates) and not providers.isdisjoint(_GENERATORS))


def _coming_along(
    package: ProjectPackage, missing: Mapping[frozenset[str], list[Need]], provisions: Provisions
) -> dict[frozenset[str], frozenset[str]]:
    """Of what is *missing* that of which headers alone are needed, and which another missing package brings, each with that one."""
    found: dict[frozenset[str], frozenset[str]] = {}
    for providers, uses in missing.items():
        if not all(use.is_header for use in uses) or providers & package.declared or _is_interface(providers):
            continue
        for other in missing:
            if other != providers and other not in found and not other & package.declared:
                if providers & provisions.closure(first_provider(other, package), package.ros):
                    found[providers] = other
                    break
    return found


def _is_interface(providers: frozenset[str]) -> bool:
    """Whether they are packages of messages, which everybody declares who includes them."""
    return any(name.endswith(("_msgs", "_interfaces", "_srvs")) for name in providers)


def _put(missing: dict[frozenset[str], list[Need]], need: Need) -> None:
    """Put *need* to those that one package meets together with it: a header and the CMake package of one library."""
    for providers in missing:
        if common := providers & need.providers:
            uses = missing.pop(providers)
            missing.setdefault(common, []).extend((*uses, need))
            return
    missing[need.providers] = [need]


def _finding(
    package: ProjectPackage,
    providers: frozenset[str],
    uses: list[Need],
    brought: Sequence[list[Need]],
    provisions: Provisions,
) -> Finding:
    """*brought* is what else is needed and comes with the same package."""
    tested = sorted(providers & {dependency.name for dependency in counted(package)})
    if tested:
        return _only_tested(package, tested[0], uses)
    name = HEADERS if HEADERS in providers else first_provider(providers, package)
    keys = boost_keys(package) if name == HEADERS else (name,)
    others = others_of(providers, name, package) if name != HEADERS else []
    kind = _kind(name, uses)
    is_test = kind == "test_depend"
    idle = idle_commands(package, name, uses, provisions) if not brought else ()
    is_certain = not others and is_of_ros(name, package.project) and not idle and not is_test
    fix = add_dependency(package, kind, name) if is_certain else None
    own, parts = _own(package, brought)
    tags = listed([dependency_tags(package, kind, key) for key in (*keys, *own)])
    packages = listed(keys)
    guard = "move find_package() into if(BUILD_TESTING), as tests alone need it, and " if is_test else ""
    fixes = [fix, *(add_dependency(package, kind, other) for other in own)]
    edits = tuple(edit for one in fixes if one is not None for edit in one.edits)
    return Finding(
        at=last_dependency(package),
        message=f"{package.name} needs {packages} to build ({uses[0].what}), but package.xml does not declare {'it' if len(keys) == 1 else 'them'}: the build "
        f"fails on a machine without {packages}; {_removal(idle) if idle else guard}add {tags}{_besides(name, others, parts, bool(own))}{said_misplaced(package, providers)}{said_never(package, providers)}",
        about=(package.name, name),
        related=tuple(
            (use.location, f"needs {other}: {use.what}")
            for other, item in ((name, uses), *((name, item) for item in parts), *own.items())
            for use in item[:_SHOWN]
        ),
        apart=(name,),
        level=Level.NOTE if _is_built_from_source(package, providers, provisions) else None,
        fixes=() if None in fixes else (Fix(f"declare {listed([name, *own])}", edits),),
    )


def _kind(name: str, uses: Sequence[Need]) -> str:
    """The tag by which a manifest declares the package *name*: whose headers are included is needed by more than tools and tests."""
    if any(use.is_header for use in uses):
        return "depend"
    return (
        "test_depend" if name.startswith(_TESTING) else "buildtool_depend" if name.startswith(BUILD_TOOLS) else "depend"
    )


def _besides(name: str, others: Sequence[str], parts: Sequence[list[Need]], has_own: bool) -> str:
    """What may be declared instead of *name*, and which *parts* it brings."""
    alternative = f" (or {', '.join(others)})" if others else ""
    if parts:
        headers = listed([item[0].what.removeprefix("#include ") for item in parts])
        alternative += f", {f'of which {name}' if has_own else 'which'} brings {headers}, too"
    return alternative


def _own(package: ProjectPackage, brought: Sequence[list[Need]]) -> tuple[dict[str, list[Need]], list[list[Need]]]:
    """Of what is *brought* the packages of distributions, which another one brings in some and not in others, and the rest."""
    own: dict[str, list[Need]] = {}
    parts: list[list[Need]] = []
    for item in brought:
        name = first_provider(item[0].providers, package)
        if is_of_ros(name, package.project) and package.project.package(name) is None:
            own[name] = [*own.get(name, ()), *item]
        else:
            parts.append(item)
    return own, parts


def _removal(commands: Sequence[str]) -> str:
    """What is better than to declare what nothing uses."""
    return f"nothing else here uses it: remove it from {listed([f'{command}()' for command in commands])}, or "


def _is_built_from_source(package: ProjectPackage, providers: frozenset[str], provisions: Provisions) -> bool:
    """Whether a library of the system may come from sources that are fetched: rosdep would bring another one.

    A page, a script or a workflow of the workspace fetches them, or the build of a package that *package* depends on downloads a project,
    which may have the library among its own. A package of ROS is to be declared all the same: build tools go by it.
    """
    project = package.project
    if any(is_of_ros(name, project) for name in providers):
        return False
    brought = map(project.package, provisions.of(package, tests=False).names - {package.name})
    if any(one is not None and downloads(one) for one in brought):
        return True
    fetched = {name.lower() for name in repositories_named(project.workspace)}
    stems = {_AFFIXES.sub("", name.lower()) for name in providers}
    return any(stem in fetched or f"lib{stem}" in fetched for stem in stems)


def _circular(package: ProjectPackage, name: str, uses: list[Need]) -> Finding:
    """The package *name* needs *package*: build tools refuse both in a row."""
    return Finding(
        at=last_dependency(package),
        message=f"{package.name} needs {name} to build ({uses[0].what}), but package.xml does not declare it, and {name} needs "
        f"{package.name} in turn: with it declared the build tool stops at the circular dependency; move what both need to a "
        "package of its own",
        about=(package.name, name),
        related=tuple((use.location, f"needs {name}: {use.what}") for use in uses[:_SHOWN]),
        apart=(name,),
        level=Level.WARNING,
    )


def _environment(package: ProjectPackage) -> Iterator[Finding]:
    """Variables of the environment that ros_environment sets, where CMake decides by them."""
    commands = package.build.commands if package.ros == 2 and package.name != ENVIRONMENT else ()
    for path in sorted({command.location.path for command in commands}):
        text = package.project.text(path)
        found = _VARIABLE.search(text)
        if found is None:
            continue
        at = Location(path, text.count("\n", 0, found.start(1)) + 1)
        kind = "buildtool_depend" if package.raw.format == 1 else "build_depend"
        fix = add_dependency(package, kind, ENVIRONMENT)
        yield Finding(
            at=last_dependency(package),
            message=f"{package.name} decides by $ENV{{{found[1]}}} (line {at.line} of {path}), which {ENVIRONMENT} sets, but package.xml does not "
            f"declare it: the variable is empty on a build farm; add {dependency_tags(package, kind, ENVIRONMENT)}",
            about=(package.name, ENVIRONMENT),
            level=Level.NOTE,
            related=((at, f"reads $ENV{{{found[1]}}}"),),
            apart=(ENVIRONMENT,),
            fixes=() if fix is None else (fix,),
        )
        return


def _only_tested(package: ProjectPackage, name: str, uses: list[Need]) -> Finding:
    """What the manifest has for tests alone, and more than tests use."""
    line = next((dependency.line for dependency in package.raw.dependencies if dependency.name == name), None)
    return Finding(
        at=Location(package.manifest_path, line or 1),
        message=f"{package.name} needs {name} to build ({uses[0].what}), but declares it for tests only: a build without "
        f"tests may lack it; write {dependency_tags(package, 'depend', name)}",
        about=(package.name, name),
        level=Level.WARNING,
        related=tuple((use.location, f"needs {name}: {use.what}") for use in uses[:_SHOWN]),
        apart=(name,),
    )


CHECK = Check(
    id="undeclared-dependency",
    summary="Build dependency that package.xml does not declare.",
    level=Level.ERROR,
    project=check,
    catalogue="M01",
    tags=("packages", "build"),
)
