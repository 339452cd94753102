# SPDX-License-Identifier: Apache-2.0
"""catkin_lint, where it is installed: CMakeLists.txt against package.xml in ROS 1 packages, offline."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from posixpath import join, normpath
from typing import Any

from haros_ci.linters import installed
from haros_ci.linters.catalogue import rule as rule_of
from haros_ci.linters.catkin_doubts import is_refuted
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import LANGUAGES as EVERY_LANGUAGE
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.submodules import absent
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

NAME = "catkin_lint"
LANGUAGES = frozenset({"package"})
WHEN = When.INSTALLED
COST = 60.0

#: The manifest of a package that is only to be known.
KNOWN = (
    "<package><name>{name}</name><version>0.0.0</version><description>.</description>"
    '<maintainer email="a@example.org">.</maintainer><license>.</license>{build}</package>'
)
#: It reads the launch files and plug-in descriptions of a package, and first lines, and asks which other files there are.
SEES = frozenset(EVERY_LANGUAGE) - {"cpp"}
SEES_NAMES = True
#: A finding names no more other places than this.
MOST = 40
LEVELS = {"errors": Level.ERROR, "warnings": Level.WARNING, "notices": Level.NOTE}


def locate(options: LintOptions) -> Program | None:
    program = installed.python_tool("catkin_lint", "isolation.py")
    if program is not None:
        return Program((*program.argv, "catkin_lint"), program.version)
    return installed.binary("catkin_lint", options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    """Which packages there are, for it looks dependencies up among them, which of them are of ROS 1, and what is not checked out."""
    packages = sorted((package.name, package.ros or 0) for package in workspace.packages)
    return json.dumps([packages, sorted(absent(workspace))])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    """The package's CMake files; its other files come in as salt."""
    return (f.path for f in workspace.files if f.package == file.package and f.language == "cmake")


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    manifests = {join(p.path, "package.xml").removeprefix("./"): p for p in workspace.packages if p.ros == 1}
    for file in workspace.files:
        if file.path in manifests and (needs := tuple(dependencies(workspace, file))):
            others = (_trace(workspace, f) for f in workspace.files if f.package == file.package)
            salt = hashlib.sha256("\n".join(others).encode("utf-8", "surrogatepass")).hexdigest()
            yield Unit(file, dependencies=needs, covers=needs, salt=salt)


def command(program: Program, batch: Batch) -> Command:
    """The other packages are made known by manifests of ours: one that is malformed would end the whole process."""
    here = _packages(batch)
    for number, package in enumerate(p for p in batch.workspace.packages if p not in here):
        place = batch.scratch / "known" / str(number)
        place.mkdir(parents=True)
        build = "<buildtool_depend>catkin</buildtool_depend>" if package.ros == 1 else ""
        (place / "package.xml").write_text(KNOWN.format(name=_escaped(package.name), build=build), encoding="utf-8")
    options = ("--offline", "--json", "-W2", "--quiet", "--no-resolve-env", "--package-path", str(batch.scratch))
    return Command((*program.argv, *options, *("./" + package.path for package in here)))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The JSON report; file names there are relative to the package."""
    if b"Error(s) in package" in output.stderr and len(batch.files) == 1:
        yield GaveUp(batch.files[0].path, "the manifest is not valid")
        return
    report, packages = json.loads(output.stdout), {package.name: package for package in _packages(batch)}
    manifests = {file.package: file.path for file in batch.files}
    warnings = output.stderr.decode("utf-8", "replace")
    lacking = absent(batch.workspace)
    for name in re.findall(r"^catkin_lint: cannot lint ([\w-]+):", warnings, re.MULTILINE):
        yield GaveUp(manifests[name], "a fault of catkin_lint")
    without_catkin = _without_catkin(report)
    places: dict[tuple[str, str, str], list[Finding]] = {}
    for key, level in LEVELS.items():
        for entry in sorted(report[key], key=_order):
            place = entry["location"]
            package = packages.get(place["package"])
            if package is None:
                continue
            location = _location(place, package)
            rule, text = entry["id"], entry["text"]
            if (rule == "CATKIN_ORDER_VIOLATION" and package.name in without_catkin) or is_refuted(
                rule, text, package.path, location, batch.workspace, lacking
            ):
                continue
            weighed = max(level, rule_of(NAME, rule).level, key=lambda level: level.rank)
            finding = Finding(manifests[package.name], Result(NAME, rule, weighed, text, location))
            places.setdefault((package.name, rule, text), []).append(finding)
    for first, *others in places.values():  # what is said of each use of a thing has one cause
        related = tuple(Related(other.result.location, "Here, too.") for other in others[:MOST])
        yield replace(first, result=replace(first.result, related=related))


def _location(place: Mapping[str, Any], package: Package) -> Location:
    line = place.get("line")
    path = normpath(join(package.path, place.get("file") or "package.xml"))
    return Location(path, line if isinstance(line, int) and line > 0 else None)


def _without_catkin(report: Mapping[str, Any]) -> frozenset[str]:
    """The packages without find_package(catkin): MISSING_FIND says so once, what is said of its order repeats it."""
    return frozenset(
        entry["location"]["package"]
        for key in LEVELS
        for entry in report[key]
        if entry["id"] == "MISSING_FIND" and "find_package(catkin)" in entry["text"]
    )


def _order(report: dict[str, Any]) -> tuple[str, int]:
    place = report["location"]
    line = place.get("line")
    return str(place.get("file") or ""), line if isinstance(line, int) else 0


def _trace(workspace: Workspace, file: SourceFile) -> str:
    """What it can see of a file: its name, its mode, and what stands in it, but for C++."""
    mode = workspace.executables is not None and file.path in workspace.executables
    return f"{file.path} {mode} {'' if file.language == 'cpp' else file.digest}"


def _packages(batch: Batch) -> list[Package]:
    names = {file.package for file in batch.files}
    return [package for package in batch.workspace.packages if package.name in names]


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;")
