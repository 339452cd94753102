# SPDX-License-Identifier: Apache-2.0
"""Python packages of ROS 2 whose programs or resources setup.py, setup.cfg and the files do not agree on."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Edit, Finding, Fix, Level, Location, Project, ProjectPackage, is_slip, listed, regex
from haros_ci.api.launch import started_programs
from haros_ci.api.packages import (
    EntryPoint,
    entry_point_mistake,
    is_own_module,
    lost_imports,
    misspelt,
    moved_module,
    renamed_module,
)

_MARKERS = "share/ament_index/resource_index/packages"
_NODE = regex(r"\brclpy\.(?:init|spin\w*|create_node)\(|\((?:\w+\.)*(?:Lifecycle)?Node\)\s*:")
#: What sets the directory of programs in setup.py: an attribute or option, or a command class of the project's own.
_SETS = regex(r"[.'\"](?:install_scripts|script_dir)\b")
_COMMANDS = regex(
    r"[\"'](?:install|develop|install_scripts|easy_install)[\"']\s*[:\]]|\b(?:install|develop|install_scripts)\s*="
)
_COMPUTED = regex(r"\bcmdclass\s*=(?!=)\s*(?!\{|dict\b)")
_REMARKS = regex(r"#[^\n]*|\"\"\".{0,20000}?\"\"\"|'''.{0,20000}?'''", re.DOTALL)
_SECTIONS = {"develop": "script_dir", "install": "install_scripts"}


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        yield from _entry_points(package)
        if package.raw.build_type == "ament_python" and package.has("setup.py"):
            yield from lost_imports(package)
            yield from _directories(package)
            yield from _marker(package)
            yield from _packages(package)
        elif package.build.python_roots:
            yield from lost_imports(package)


def _entry_points(package: ProjectPackage) -> Iterator[Finding]:
    """``name = module:function``: the module's file, and the function in it; modules that are not there are one finding of a file."""
    lost: dict[str, list[tuple[EntryPoint, Finding]]] = {}
    for entry_point in package.build.entry_points:
        if package.raw.build_type == "ament_cmake" and entry_point.location.path.endswith("setup.py"):
            continue  # left over: ament_python_install_package() reads setup.cfg alone
        if entry_point.path:
            missing = _missing_name(entry_point, package)
            if missing is not None:
                yield missing
        elif is_own_module(entry_point.module, package):
            found = _missing_module(entry_point, package)
            lost.setdefault("" if "; write " in found.message else entry_point.location.path, []).append(
                (entry_point, found)
            )
        elif name := renamed_module(entry_point.module, package):
            yield _missing_module(entry_point, package, name)
    for path, group in lost.items():
        if path and len(group) > 1:
            yield _missing_modules([entry_point for entry_point, _ in group], package)
        else:
            yield from (found for _, found in group)
    for entry in package.build.refused_entries if package.raw.build_type == "ament_python" else ():
        wrong, right = entry_point_mistake(entry.text, package)
        yield Finding(
            at=entry.location,
            message=f"the entry point '{entry.text}' of package {package.name} {wrong}"
            + (f"; write '{right}'" if right else ""),
            about=(package.name, entry.text),
            apart=(entry.text,),
        )


def _is_there(path: str, package: ProjectPackage) -> bool:
    """Whether the root-relative *path* exists, or is in a submodule that is not checked out."""
    return package.project.exists(path) or package.project.is_absent(path)


def _missing_module(entry_point: EntryPoint, package: ProjectPackage, other: str = "") -> Finding:
    folder, _, last = entry_point.module.rpartition(".")
    beside = sorted(
        path.rpartition("/")[2].removesuffix(".py")
        for path in (file.path for file in package.files if file.language == "python")
        if path.endswith(f"{folder.replace('.', '/')}/{path.rpartition('/')[2]}")
    )
    alike = [
        name
        for name in beside
        if name != last and (is_slip(name, last) or name.replace("_", "") == last.replace("_", ""))
    ]
    names = [other] if other else [f"{folder}.{name}" for name in alike]
    meant = f"; write {names[0]}" if names else _outside(entry_point, package)
    fixes: tuple[Fix, ...] = ()
    if len(names) == 1:
        fixes = _replaced(entry_point, entry_point.module, names[0], package)
    return Finding(
        at=entry_point.location,
        message=f"program {entry_point.name} of package {package.name} cannot start: the module {entry_point.module} does not "
        f"exist{meant}",
        about=(package.name, entry_point.name),
        apart=(entry_point.name,),
        fixes=fixes,
    )


def _missing_modules(entries: list[EntryPoint], package: ProjectPackage) -> Finding:
    """One finding for several programs of which no module is there: what has moved, or was not committed, is one slip."""
    names, modules = tuple(one.name for one in entries), list(dict.fromkeys(one.module for one in entries))
    moved = list(filter(None, (moved_module(module, package) for module in modules)))
    hint = f" ({listed(moved)} have the names)" if len(moved) > 1 else ""
    return Finding(
        at=entries[0].location,
        message=f"programs {listed(list(names))} of package {package.name} cannot start: the modules {listed(modules)} do "
        f"not exist{hint}; add them, or correct or remove the entry points",
        about=(package.name, *names),
        apart=names,
        related=tuple((one.location, f"{one.module}, too") for one in entries[1:]),
    )


def _outside(entry_point: EntryPoint, package: ProjectPackage) -> str:
    """Where the module's file is, if it is in the package of ROS but not in that of Python: in ``scripts`` beside it."""
    inner = entry_point.module.partition(".")[2].replace(".", "/")
    if not inner or not package.project.exists(package.inside(f"{inner}.py")):
        moved = moved_module(entry_point.module, package)
        return (
            f"; {moved} has its name: correct the entry point, or move it back"
            if moved
            else "; add it, or remove the entry point"
        )
    place = f"{entry_point.module.replace('.', '/')}.py"
    return f": {inner}.py is not in the Python package; move it to {place}"


def _missing_name(entry_point: EntryPoint, package: ProjectPackage) -> Finding | None:
    """The function, as far as the module's text can tell: star imports and assignments of all kinds are in doubt."""
    name = entry_point.function.partition(".")[0]
    program = package.project.programs.get(entry_point.path)
    text = package.project.text(entry_point.path)
    if (
        program is None
        or program.problems
        or not text
        or re.search(r"\bimport\s*\*|__getattr__|globals\(\)|setattr\(", text)
    ):
        return None
    own = [function.name for function in program.functions if function.name and not function.owner]
    known = {
        *own,
        *(c.name for c in program.classes),
        *(v.name for v in program.variables),
        *(a.name for a in program.aliases),
    }
    if name in known or re.search(
        rf"(?:def|class|as)\s+{name}\b|\b{name}\s*(?::[^=\n]*)?=[^=]|import\b[^\n]*\b{name}\b", text
    ):
        return None
    if re.search(rf"^[ \t]*{name}[ \t]*(?:,[ \t]*)?(?:#.*)?$", text, re.M):
        return None  # perhaps a line of an import in parentheses
    alike = sorted(other for other in own if is_slip(other, name))
    meant = f"; write {alike[0]}" if alike else "; add it, or correct the entry point"
    return Finding(
        at=entry_point.location,
        message=f"program {entry_point.name} of package {package.name} cannot start: {entry_point.path} has no function "
        f"{entry_point.function}(){meant}",
        about=(package.name, entry_point.name),
        related=((Location(entry_point.path, 1), f"the module {entry_point.module}"),),
        apart=(entry_point.name,),
        fixes=_replaced(
            entry_point, f"{entry_point.module}:{entry_point.function}", f"{entry_point.module}:{alike[0]}", package
        )
        if len(alike) == 1
        else (),
    )


def _replaced(entry_point: EntryPoint, old: str, new: str, package: ProjectPackage) -> tuple[Fix, ...]:
    """*new* in the place of *old* in the line of the entry point, where it stands once."""
    lines = package.project.text(entry_point.location.path).splitlines()
    number = entry_point.location.line or 0
    line = lines[number - 1] if 0 < number <= len(lines) else ""
    if line.count(old) != 1:
        return ()
    at = line.index(old)
    start, end = (number, at + 1), (number, at + 1 + len(old))
    return (Fix(f"start {new}", (Edit(entry_point.location.path, start, end, new),)),)


def _directories(package: ProjectPackage) -> Iterator[Finding]:
    """setup.cfg: programs have to go to ``lib/<package>`` to be found by ros2 run and launch files."""
    started = started_programs(package)
    nodes = [
        entry_point
        for entry_point in package.build.entry_points
        if _is_node(entry_point, package) or entry_point.name in started
    ]
    if not nodes:
        return
    expected = f"$base/lib/{package.name}"
    path = package.inside("setup.cfg")
    directories = {section: (value, line) for section, value, line in package.build.script_directories}
    for section, (value, line) in directories.items():
        if value.strip("\"'") != expected and value.startswith("$base/lib/") and "{" not in value:
            if section == "develop" and directories.get("install", (value, 0))[0] == value:
                continue  # reported once, for install
            fixes = []
            for other, number in directories.values():
                if other == value:
                    text = package.project.text(path).splitlines()[number - 1]
                    at = text.rindex(value)
                    fixes.append(Edit(path, (number, at + 1), (number, at + 1 + len(value)), expected))
            yield Finding(
                at=Location(path, line),
                message=(
                    f"programs of package {package.name} are installed to {value.removeprefix('$base/')}: ros2 run and launch "
                    f"files search for {nodes[0].name} in lib/{package.name} and do not find it; write "
                    f"$base/lib/{package.name}"
                ),
                about=(package.name, section),
                fixes=(Fix(f"put them into lib/{package.name}", tuple(fixes)),),
            )
    if _is_set_by_setup(package):
        return
    if "install" not in directories:
        yield _no_directory(package, nodes[0], path, directories)
    elif "develop" not in directories and (wrong := misspelt(package.project.text(path), "develop", "script_dir")):
        yield Finding(
            at=Location(path, wrong.line),
            message=(
                f"setup.cfg of package {package.name} has {wrong.wrong}, which setuptools does not know: with colcon build "
                f"--symlink-install programs are put into bin, where ros2 run does not find {nodes[0].name}; write {wrong.right}"
            ),
            about=(package.name, "script_dir"),
            level=Level.WARNING,
            fixes=(wrong.fix(path),),
        )


def _is_set_by_setup(package: ProjectPackage) -> bool:
    """Whether setup.py sets the directory for programs itself, or has command classes that may."""
    text = _REMARKS.sub("", package.project.text(package.inside("setup.py")))
    if _SETS.search(text) is not None or _COMPUTED.search(text) is not None:
        return True
    return "cmdclass" in text and _COMMANDS.search(text) is not None


def _no_directory(
    package: ProjectPackage, node: EntryPoint, path: str, directories: dict[str, tuple[str, int]]
) -> Finding:
    text = package.project.text(path)
    wrong = misspelt(text, "install", "install_scripts")
    lacking = [section for section in _SECTIONS if section not in directories and f"[{section}]" not in text]
    fixes: tuple[Fix, ...] = ()
    if text.endswith("\n") and "install" in lacking:
        end = (len(text.splitlines()) + 1, 1)
        lines = "".join(f"[{section}]\n{_SECTIONS[section]}=$base/lib/{package.name}\n" for section in lacking)
        fixes = (Fix(f"put programs into lib/{package.name}", (Edit(path, end, end, lines),)),)
    if wrong is not None:
        what = f"setup.cfg of package {package.name} has {wrong.wrong}, which setuptools does not know, and so does not set"
        mend, fixes = f"write {wrong.right}", (wrong.fix(path),)
    elif package.has("setup.cfg"):
        what = f"setup.cfg of package {package.name} does not set"
        mend = f"write install_scripts=$base/lib/{package.name} under [install]"
    else:
        what = f"package {package.name} has no setup.cfg, which sets"
        keys = [f"{key}=$base/lib/{package.name} under [{section}]" for section, key in _SECTIONS.items()]
        mend = f"add setup.cfg with {' and '.join(keys)}"
    return Finding(
        at=Location(path, wrong.line if wrong is not None else 1) if text else node.location,
        message=(
            f"{what} the directory for programs: they are installed to bin, where ros2 run does not find {node.name}; {mend}"
        ),
        about=(package.name, "install_scripts"),
        fixes=fixes,
    )


def _is_node(entry_point: EntryPoint, package: ProjectPackage) -> bool:
    """Whether a program runs a ROS node: other tools (ros2cli, linters) are put into ``bin`` on purpose."""
    return _NODE.search(package.project.text(entry_point.path)) is not None


def _marker(package: ProjectPackage) -> Iterator[Finding]:
    """The marker in the ament index, by which the package is found."""
    others = package.project.text(package.inside("setup.cfg")) + package.project.text(package.inside("pyproject.toml"))
    if any("data_files" in problem.message for problem in package.build.problems) or re.search("data[-_]files", others):
        return
    here = [installed for installed in package.build.installed if installed.destination == _MARKERS]
    if any(installed.name == package.name for installed in here):
        return
    setup = package.inside("setup.py")
    wrong = f"data_files installs the marker {here[0].name}, which differs from the package name" if here else ""
    there = "" if package.has(f"resource/{package.name}") else f" an empty file resource/{package.name} and"
    yield Finding(
        at=here[0].location if here else Location(setup, _line_with(package.project.text(setup), "data_files")),
        message=(
            f"{wrong or 'data_files installs no marker for the package index'}: colcon warns and writes one itself, but installed in "
            f"another way ros2 does not find the package {package.name}; add{there} ('{_MARKERS}', "
            f"['resource/{package.name}'])"
        ),
        about=(package.name, "resource"),
        level=Level.WARNING,
    )


def _packages(package: ProjectPackage) -> Iterator[Finding]:
    """``packages=[...]``: their directories."""
    roots = dict(package.build.python_roots) or {"": package.path}
    for name, where in package.build.python_packages:
        root = next(
            (
                root
                for root in sorted(roots, key=len, reverse=True)
                if not root or name == root or name.startswith(f"{root}.")
            ),
            None,
        )
        if root is None:
            continue
        rest = name[len(root) :].lstrip(".").replace(".", "/") if root else name.replace(".", "/")
        directory = "/".join(part for part in (roots[root].removeprefix("./").removesuffix("."), rest) if part).replace(
            "//", "/"
        )
        if package.project.workspace.names and not _is_there(directory, package):
            yield Finding(
                at=where,
                message=f"setup.py of package {package.name} names the Python package {name}, but the directory {directory} does "
                "not exist: the build stops; correct the name",
                about=(package.name, name),
                apart=(name,),
            )


def _line_with(text: str, word: str) -> int:
    return next((number for number, line in enumerate(text.splitlines(), 1) if word in line), 1)


CHECK = Check(
    id="python-package-incomplete",
    summary="Entry point, module or resource of a Python package that does not exist or is installed in the wrong place.",
    level=Level.ERROR,
    catalogue="B08",
    tags=("build", "python"),
    project=check,
)
