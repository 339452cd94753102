# SPDX-License-Identifier: Apache-2.0
"""Packages that generate messages, services or actions, and do not declare what that takes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from haros_ci.api import Check, Finding, Fix, Level, Project, ProjectPackage, dataclass, regex, spelled_out
from haros_ci.api.packages import (
    BUILD,
    EXPORTED,
    CMakeCommand,
    Element,
    add_dependency,
    add_element,
    applying,
    brings,
    dependency_tags,
    needs,
    place,
    reaches,
    said_misplaced,
    set_attribute,
    word,
)

GROUP = "rosidl_interface_packages"
#: For each ROS: the generator's package and all that contain it, then the same for what generated code runs with.
PARTS = {
    2: (
        ("rosidl_default_generators", "rosidl_core_generators"),
        ("rosidl_default_runtime", "rosidl_core_runtime"),
    ),
    1: (("message_generation", "genmsg"), ("message_runtime",)),
}

#: Commands that list interfaces.
LISTS = ("add_message_files", "add_service_files", "add_action_files", "rosidl_generate_interfaces")
#: Options of rosidl_generate_interfaces() that end the list of DEPENDENCIES.
KEYWORDS = ("ADD_LINTER_TESTS", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK", "LIBRARY_NAME")
#: Packages that come with the generator, at least in some distributions.
OF_THE_GENERATOR = ("builtin_interfaces", "action_msgs", "service_msgs", "unique_identifier_msgs")
#: Names of macros that may find packages, but for those that do not.
FINDING = regex("find|package|depend|setup|config|include")
TAME = ("find_package", "add_dependencies", "ament_export_dependencies", "ament_target_dependencies", "configure_file",
        "ament_export_include_directories", "include_directories", "target_include_directories")  # fmt: skip


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        call = _call(package, "rosidl_generate_interfaces")
        old = _call(package, "generate_messages") if package.ros != 2 else None
        if package.manifest is None or package.raw.build_type == "ament_python":
            continue  # nothing runs its CMake: wrong-build-type tells of it
        if call is not None and not {"SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK"} & set(call.arguments):
            yield from _group(package, package.manifest, call)
        if call is not None:
            yield from _unfound(package, call)
        if call is not None and "SKIP_INSTALL" not in call.arguments:
            yield from _parts(package, call, 2)
        elif old is not None:
            yield from _parts(package, old, 1)


def _call(package: ProjectPackage, name: str) -> CMakeCommand | None:
    return next((c for c in package.commands(name) if not c.is_conditional and not c.is_test), None)


def _group(package: ProjectPackage, root: Element, call: CMakeCommand) -> Iterator[Finding]:
    """rosidl_generate_interfaces() stops unless the manifest says so (rosidl_cmake)."""
    if any(word(element) == GROUP for element in applying(package, root, "member_of_group")):
        return
    yield Finding(
        at=place(package, None),
        message=f"{package} generates interfaces, but is not a member of the group {GROUP}: rosidl_generate_interfaces() "
        f"stops the build; add <member_of_group>{GROUP}</member_of_group>",
        about=(package.name, GROUP),
        related=((call.location, "interfaces are generated here"),),
        fixes=_membership(package, root),
        level=Level.ERROR,
    )


def _membership(package: ProjectPackage, root: Element) -> tuple[Fix, ...]:
    """In format 2 the manifest becomes one of format 3, which has groups and is else the same (REP 149)."""
    text = "declare the membership"
    fix = add_element(package, "member_of_group", GROUP, text)
    if fix is None or package.raw.format == 3:
        return () if fix is None else (fix,)
    newer = set_attribute(package, root, "format", "3", text) if package.raw.format == 2 else None
    return () if newer is None else (Fix(text, (*newer.edits, *fix.edits)),)


def _unfound(package: ProjectPackage, call: CMakeCommand) -> Iterator[Finding]:
    """What DEPENDENCIES names has to be found before, by itself or with a package that exports it."""
    before = list(package.build.commands[: package.build.commands.index(call)])
    if any(FINDING.search(command.name) and command.name not in TAME for command in before):
        return
    found = {command.arguments[0] for command in before if command.name == "find_package" and command.arguments}
    if any("${" in name for name in found):
        return
    tools = {name for name in found if name.startswith("ament_")}
    for name in call.after("DEPENDENCIES", *KEYWORDS):
        if "${" not in name and name not in OF_THE_GENERATOR and brings(package, found - tools, name) is False:
            yield Finding(
                at=call.location,
                message=f"rosidl_generate_interfaces() of {package} depends on {name}, but no find_package({name}) precedes it: "
                f"the build stops; call find_package({name} REQUIRED) before it",
                about=(package.name, name, "DEPENDENCIES"),
                apart=(name,),
                level=Level.ERROR,
            )


def _parts(package: ProjectPackage, call: CMakeCommand, ros: int) -> Iterator[Finding]:
    generators, runtimes = PARTS[ros]
    if package.name in (*generators, *runtimes):
        return
    made, runtime = _generator(package, ros), _runtime(package, ros)
    if made is not None:
        yield _missing(package, call, (made, runtime) if runtime is not None else (made,))
    elif runtime is not None:
        yield _missing(package, call, (runtime,))


@dataclass(frozen=True, slots=True)
class _Part:
    """A dependency *name* that is missing, of this *kind*, and what comes of it."""

    name: str
    kind: str
    effect: str
    level: Level


def _generator(package: ProjectPackage, ros: int) -> _Part | None:
    generators, _ = PARTS[ros]
    if {need.name for need in needs(package)} & {*generators}:
        return None
    is_missing = reaches(package, (*BUILD, *EXPORTED), *generators) is False
    effect = "on a machine with only the declared dependencies the generator is missing"
    kind = "buildtool_depend" if ros == 2 else "build_depend"
    return _Part(generators[0], kind, effect, Level.ERROR if is_missing else Level.WARNING)


def _runtime(package: ProjectPackage, ros: int) -> _Part | None:
    generators, runtimes = PARTS[ros]
    if not _makes_some(package) or {need.name for need in needs(package, *EXPORTED)} & {*runtimes, *generators}:
        return None
    effect, level = "on a machine with only the declared dependencies its interfaces may not load", Level.WARNING
    bringing = next((need.name for need in needs(package, *EXPORTED) if brings(package, (need.name,), *runtimes)), None)
    if bringing is not None:
        effect, level = f"it is there only because {bringing} brings it", Level.NOTE
    return _Part(runtimes[0], "exec_depend", effect, level)


def _makes_some(package: ProjectPackage) -> bool:
    """Whether there is an interface to make, or a list of them: generate_messages() alone makes nothing."""
    return bool(package.build.interfaces or package.commands(*LISTS))


def _missing(package: ProjectPackage, call: CMakeCommand, parts: Sequence[_Part]) -> Finding:
    """One finding for what is missing: the generator, what its interfaces run with, or both; what comes of the first is said."""
    first, *_ = parts
    renamed = {"exec_depend": "run_depend"} if package.raw.format == 1 else {}
    kinds = [(renamed.get(part.kind, part.kind), part.name) for part in parts]
    fixes = [add_dependency(package, kind, name) for kind, name in kinds]
    names = tuple(name for _, name in kinds)
    tags = spelled_out([dependency_tags(package, kind, name) for kind, name in kinds])
    does, at, advice = "generates interfaces", "interfaces are generated here", "add"
    if not _makes_some(package):
        does, at, advice = f"calls {call.name}() without an interface", "it is called here", "remove the call, or add"
    return Finding(
        at=place(package, None),
        message=f"{package} {does}, but does not depend on {spelled_out(names)}: {first.effect}; {advice} {tags}{said_misplaced(package, names)}",
        about=(package.name, first.name),
        related=((call.location, at),),
        fixes=_together(fixes),
        level=first.level,
        apart=(first.name,),
    )


def _together(fixes: Sequence[Fix | None]) -> tuple[Fix, ...]:
    """One fix that makes the edits of all; none where one cannot be made."""
    made = [fix for fix in fixes if fix is not None]
    if len(made) < len(fixes):
        return ()
    return (Fix("; ".join(fix.description for fix in made), tuple(edit for fix in made for edit in fix.edits)),)


CHECK = Check(
    id="incomplete-interface-package",
    summary="Interface package without the dependencies or the group membership that rosidl needs.",
    level=Level.ERROR,
    catalogue="M09",
    tags=("packages", "interfaces"),
    project=check,
)
