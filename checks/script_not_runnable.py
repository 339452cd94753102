# SPDX-License-Identifier: Apache-2.0
"""Scripts that the system cannot start: without a shebang or with a broken one, without the execute bit where it counts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.api import Check, Edit, Finding, Fix, Level, Location, Project, ProjectPackage, dataclass, listed, regex
from haros_ci.api.code import parsed
from haros_ci.api.launch import ProgramUse
from haros_ci.api.packages import (
    Installed,
    Programs,
    changes_modes,
    gives_modes,
    is_built_by_copying,
    is_for_nobody,
    is_for_noetic,
    is_given_to_another,
    is_imported_beside,
    is_made_program_later,
    is_sourced,
    is_to_be_run,
    is_unfilled,
    paths_by_name,
    rospy_programs,
)

_PYTHON = regex(r"#![ \t]*(?:/usr(?:/local)?/bin/env[ \t]+|/usr/bin/)(python)(2[\d.]*)?[ \t]*\r?\Z")
_SHELL = (".sh", ".bash")
#: Why the bit counts, of one script and of several.
_DEVEL = (
    "it does not start from a devel space, which runs it in place",
    "they do not start from a devel space, which runs them in place",
)
_LINKED = tuple(
    f"colcon build --symlink-install links to {them}, and ros2 run does not find {them}" for them in ("it", "them")
)
_KEPT = (
    "setup.py installs it with its file mode: ros2 run does not find it",
    "setup.py installs them with their file modes: ros2 run does not find them",
)
_LAUNCHED = ("roslaunch does not recognise it as a program", "roslaunch does not recognise them as programs")
_RUN_BY_BUILD = tuple(
    f"dynamic_reconfigure runs {them} during the build, which may stop there" for them in ("it", "them")
)


@dataclass(frozen=True, slots=True)
class _Bit:
    """A script whose execute bit is missing, and why that counts."""

    path: str
    why: tuple[str, ...]
    level: Level = Level.WARNING


def check(project: Project) -> Iterator[Finding]:
    launched, programs = _launched(project), Programs(project)
    level = Level.NOTE if is_built_by_copying(project) else Level.WARNING
    for package in project.packages:
        yield from _joined(package, _of(package, launched.get(package.name, {}), level, programs))


def _of(
    package: ProjectPackage, launched: dict[str, Location], level: Level, programs: Programs
) -> Iterator[Finding | _Bit]:
    seen: set[str] = set()
    former = rospy_programs(package)
    if former:
        yield _of_ros1(package, former)
        seen.update(former)
    for script in package.build.installed:
        if not _is_for_programs(script, package):
            continue
        if script.kind == "directory":
            yield from _unpacked(script, package)
        elif script.path not in seen and package.project.text(script.path) and not is_sourced(script.path, package):
            seen.add(script.path)
            if (
                script.kind == "program"
                and not _is_started(script, package, programs)
                and is_for_nobody(script.path, package)
            ):
                yield _idle(script, package)
            elif not _is_module(script, package, programs):
                yield from _first_line(script.path, package, is_relayed=_is_relayed(script, package))
            yield from _mode(script, package, level, programs)
    yield from _started(package, launched, seen)
    yield from _configured(package)


def _of_ros1(package: ProjectPackage, paths: list[str]) -> Finding:
    """One finding for all such programs of a package."""
    one = len(paths) == 1
    it, them = ("it does", "it") if one else ("they do", "them")
    verb = "is installed as a program and imports" if one else "are installed as programs and import"
    return Finding(
        at=Location(paths[0], 1),
        message=f"{listed(paths)} {verb} rospy, which ROS 2 does not have: {it} not start; port {them} to rclpy, or do not install {them}",
        about=(package.name, *paths),
        level=Level.WARNING,
        related=tuple((Location(path, 1), "imports rospy, too") for path in paths[1:]),
    )


def _joined(package: ProjectPackage, found: Iterable[Finding | _Bit]) -> Iterator[Finding]:
    """The scripts of a package without the execute bit for which the same is at stake in one finding."""
    groups: dict[tuple[tuple[str, ...], Level], list[str]] = {}
    for finding in found:
        if isinstance(finding, Finding):
            yield finding
        else:
            groups.setdefault((finding.why, finding.level), []).append(finding.path)
    for (why, level), paths in groups.items():
        yield _without_bit(package, list(dict.fromkeys(paths)), why, level)


def _configured(package: ProjectPackage) -> Iterator[_Bit]:
    """ROS 1's .cfg files: dynamic_reconfigure-macros.cmake runs them while building, by their own first line; with Noetic by its Python."""
    bits = package.project.workspace.executables
    if bits is None:
        return
    for command in package.commands("generate_dynamic_reconfigure_options"):
        for path in () if command.is_conditional else map(command.place, command.arguments):
            if path and path.endswith(".cfg") and path not in bits and package.project.text(path).startswith("#!"):
                yield _Bit(path, _RUN_BY_BUILD, Level.NOTE if is_for_noetic(package.project) else Level.WARNING)


def _is_for_programs(script: Installed, package: ProjectPackage) -> bool:
    return script.destination in ("bin", f"lib/{package.name}")


def _first_line(path: str, package: ProjectPackage, *, is_relayed: bool = False) -> Iterator[Finding]:
    """The shebang: missing, too low, with a carriage return at its end, of an interpreter that is not there."""
    text = package.project.text(path)
    lines = text.splitlines(keepends=True)
    first, at = lines[0], Location(path, 1)
    if not first.startswith("#!"):
        if (path.endswith(_SHELL) or is_to_be_run(path, package.project)) and not is_given_to_another(path, package):
            yield _without(path, package, lines, is_relayed)
    elif first.endswith("\r\n"):
        yield Finding(
            at=at,
            message=(
                f"the first line of {path} ends with a carriage return: the system searches for the interpreter "
                f"{_interpreter(first)!r} including that character and does not find it; use line feeds only"
            ),
            about=(package.name, path),
            fixes=(
                Fix("remove the carriage return from the first line", (Edit(path, (1, 1), (2, 1), first[:-2] + "\n"),)),
            ),
        )
    elif package.ros == 2 and (found := _PYTHON.match(first.rstrip("\n"))) is not None:
        fix = Fix("ask for python3", (Edit(path, (1, found.start(1) + 1), (1, found.end(1) + 1), "python3"),))
        is_sure = found[2] is None and parsed(text) is not None
        yield Finding(
            at=at,
            message=(
                f"{path} requests {_interpreter(first)!r}, which ROS 2 platforms do not have: the script does not start; "
                "write python3"
            ),
            about=(package.name, path),
            level=Level.WARNING,
            fixes=(fix,) if is_sure else (),
        )


def _without(path: str, package: ProjectPackage, lines: list[str], is_relayed: bool) -> Finding:
    """A file that does not begin with a shebang; one further down belongs to the top."""
    where = " from an install space (a devel space gives it to Python by itself)" if is_relayed else ""
    line = next((number for number, line in enumerate(lines[:30], 1) if line.startswith("#!")), 0)
    fixes: tuple[Fix, ...] = ()
    if line:
        what, todo = f"has its shebang in line {line}, not in the first", "move it to the first line"
        edits = (Edit(path, (1, 1), (1, 1), lines[line - 1]), Edit(path, (line, 1), (line + 1, 1), ""))
        fixes = (Fix("move the shebang to the first line", edits),) if lines[line - 1].endswith("\n") else ()
    else:
        what, todo = "has no shebang", "begin it with one"
        if not path.endswith(_SHELL) and package.ros == 2:
            fixes = (Fix("begin with a shebang", (Edit(path, (1, 1), (1, 1), "#!/usr/bin/env python3\n"),)),)
    return Finding(
        at=Location(path, 1),
        message=f"{path} is installed as a program and {what}: the start{where} fails with 'Exec format error'; {todo}",
        about=(package.name, path),
        level=Level.WARNING if path.endswith(_SHELL) else None,
        fixes=fixes,
    )


def _idle(script: Installed, package: ProjectPackage) -> Finding:
    """A module among the programs, which a shebang would not make one."""
    return Finding(
        at=Location(script.path, 1),
        message=f"{script.path} is installed as a program, but does nothing when it is run, and nothing here starts or imports it: take it "
        "out of the programs that are installed",
        about=(package.name, script.path),
        related=((script.location, "it is installed here"),),
        level=Level.NOTE,
    )


def _mode(script: Installed, package: ProjectPackage, level: Level, programs: Programs) -> Iterator[Finding | _Bit]:
    """The execute bit: taken away by the installation, or missing where the source's own counts."""
    text = package.project.text(script.path)
    if not text.startswith("#!"):
        return
    if script.kind == "file":
        if _is_read_alone(script, package, programs) or is_made_program_later(package, script.path, script):
            return
        if not script.keeps_mode and is_to_be_run(script.path, package.project) and not gives_modes(script, package):
            yield Finding(
                at=script.location,
                message=(
                    f"install(FILES) installs {script.path} next to programs, but without the execute bit: {_run(package)} does not "
                    f"find it{_there(package, [script.path])}; use install(PROGRAMS)"
                ),
                about=(package.name, script.path),
                level=Level.WARNING if _there(package, [script.path]) else None,
            )
        return
    bits = package.project.workspace.executables
    has_bit = bits is None or script.path in bits or _is_relayed(script, package) or changes_modes(package)
    if has_bit or not is_to_be_run(script.path, package.project):
        return
    if is_given_to_another(script.path, package) or _is_module(script, package, programs, with_shebang=True):
        return
    if script.keeps_mode:
        why: tuple[str, ...] = _KEPT
    elif package.ros == 1:
        why = _DEVEL
    else:
        why = _LINKED
    if script.keeps_mode or package.ros is not None:
        counted = level if why is _LINKED else Level.WARNING
        yield _Bit(script.path, why, Level.NOTE if is_unfilled(script.path, package) else counted)


def _without_bit(package: ProjectPackage, paths: list[str], why: tuple[str, ...], level: Level) -> Finding:
    """One finding for all *paths*: the first is its place, the others are related."""
    have, reason = ("has", why[0]) if len(paths) == 1 else ("have", why[1])
    return Finding(
        at=Location(paths[0], 1),
        message=f"{listed(paths)} {have} no execute bit: {reason}; set it (git update-index --chmod=+x)",
        about=(package.name, *paths),
        apart=tuple(paths),
        related=tuple((Location(path, 1), f"{path} has no execute bit") for path in paths[1:]),
        level=level,
        fixes=(Fix("make it executable", tuple(map(Edit.executable, paths))),),
    )


def _unpacked(script: Installed, package: ProjectPackage) -> Iterator[Finding]:
    """install(DIRECTORY) gives its files no execute bit, unless its arguments ask for it."""
    if gives_modes(script, package) or script.keeps_mode or changes_modes(package):
        return
    inside = [file.path for file in package.files if file.path.startswith(f"{script.path}/")]
    programs = [path for path in inside if package.project.text(path).startswith("#!")]
    programs = [path for path in programs if is_to_be_run(path, package.project)]
    programs = [path for path in programs if not is_made_program_later(package, path, script)]
    if programs:
        yield Finding(
            at=script.location,
            message=(
                f"install(DIRECTORY) installs {', '.join(programs[:3])} next to programs, but without the execute bit: "
                f"{_run(package)} does not find {('it' if len(programs) == 1 else 'them')}{_there(package, programs)}; use "
                "install(PROGRAMS), or add USE_SOURCE_PERMISSIONS"
            ),
            about=(package.name, script.path),
            level=Level.WARNING if _there(package, programs) else None,
        )


def _started(package: ProjectPackage, launched: dict[str, Location], seen: set[str]) -> Iterator[Finding | _Bit]:
    """ROS 1: what launch files start and is not installed runs in place, if it can."""
    bits = package.project.workspace.executables
    if package.ros != 1 or bits is None:
        return
    targets = {target.output for target in package.build.targets}
    for path in package.build.scripts:
        name = path.rpartition("/")[2]
        if name in launched and name not in targets and path not in seen and path not in bits:
            alike = paths_by_name(package.project.workspace.names).get(name, ())
            if not any(other in bits for other in alike):
                yield _Bit(path, _LAUNCHED, Level.ERROR)
                yield from _first_line(path, package)


def _launched(project: Project) -> dict[str, dict[str, Location]]:
    """The programs that launch files of ROS 1 start, by package."""
    found: dict[str, dict[str, Location]] = {}
    for system in project.systems:
        if system.ros == 1:
            for use in system.facts(ProgramUse):
                if use.kind == "executable":
                    found.setdefault(use.package, {}).setdefault(use.program, use.location)
    return found


def _is_module(script: Installed, package: ProjectPackage, programs: Programs, *, with_shebang: bool = False) -> bool:
    """Whether a file is there to be imported: scripts beside it do, and nothing starts it by its name. It has no shebang, or no main block if it may be *with_shebang*."""
    text = package.project.text(script.path)
    if ("__main__" in text if with_shebang else text.startswith("#!")) or not script.path.endswith(".py"):
        return False
    return not _is_started(script, package, programs) and is_imported_beside(script.path, package)


def _is_read_alone(script: Installed, package: ProjectPackage, programs: Programs) -> bool:
    """Whether an interpreter is given the file, and nothing starts it by its name."""
    return not _is_started(script, package, programs) and is_given_to_another(script.path, package)


def _is_started(script: Installed, package: ProjectPackage, programs: Programs) -> bool:
    """Whether a launch file or a page starts the script by its name."""
    return (package.name, script.name) in programs.started or programs.documented(package.name, script.name) is not None


def _is_relayed(script: Installed, package: ProjectPackage) -> bool:
    """catkin_install_python makes an executable of its own in the devel space."""
    return any(command.location == script.location for command in package.commands("catkin_install_python"))


def _interpreter(line: str) -> str:
    return line[2:].strip().rpartition("/")[2]


def _run(package: ProjectPackage) -> str:
    return "ros2 run" if package.ros == 2 else "rosrun"


def _there(package: ProjectPackage, paths: list[str]) -> str:
    """Where programs of ROS 1 are not found that have the execute bit in the sources: rosrun looks there, too, in a devel space."""
    bits = package.project.workspace.executables
    is_found = package.ros == 1 and bits is not None and bits.issuperset(paths)
    return " in an install space (in a devel space it does, by the bit of the source)" if is_found else ""


CHECK = Check(
    id="script-not-runnable",
    summary="Installed script that the system cannot start.",
    level=Level.ERROR,
    catalogue="B12",
    tags=("build",),
    project=check,
)
