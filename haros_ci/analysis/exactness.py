# SPDX-License-Identifier: Apache-2.0
"""The exact second tier: libclang is asked, in processes of its own, about the calls that the first left unknown."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from haros_ci.config.settings import Settings
from haros_ci.extract.cpp.exact import ExactCall, ExactFile, Place, default_headers, failures, parse, requests
from haros_ci.linters import footing
from haros_ci.linters.compile_db import directories, flags_by_file
from haros_ci.linters.linter import Command, LintOptions
from haros_ci.linters.process import Processes, TimedOut, Unstartable
from haros_ci.linters.sandbox import Confinement
from haros_ci.linters.view import of_cpp
from haros_ci.model.architecture import Architecture, Endpoint
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.scratch import scratch_directory

#: Seconds that one file may take.
PATIENCE = 90.0
MISSING = 3  # the worker's exit code where libclang is not installed


def doubtful(architecture: Architecture) -> dict[str, set[tuple[int, int]]]:
    """The places of C++ calls whose name or type is not known, by file."""
    found: dict[str, set[tuple[int, int]]] = {}
    for configuration in architecture.configurations:
        for node in configuration.nodes:
            for end in node.endpoints:
                at = end.location
                if at is None or at.line is None or at.column is None or at.path.endswith(".py"):
                    continue
                if any(why.field in ("name", "type") for why in end.unknowns):
                    found.setdefault(at.path, set()).add((at.line, at.column))
    return found


def ask(
    workspace: Workspace, settings: Settings, places: Mapping[str, Iterable[tuple[int, int]]]
) -> tuple[Mapping[Place, tuple[ExactCall, ...]], tuple[Problem, ...]]:
    """What libclang tells of the calls at *places*, and which files it could not look at."""
    options = LintOptions(compile_database=settings.compile_database, root=settings.root)
    reported: dict[Place, tuple[ExactCall, ...]] = {}
    problems: list[Problem] = []
    processes = Processes()
    with scratch_directory("haros-ci-") as scratch:
        view = of_cpp(workspace, scratch / "view")
        known = flags_by_file(view, options)
        files = [
            ExactFile(path, known.get(path) or _flags(view, path), tuple(sorted(calls)))
            for path, calls in sorted(places.items())
        ]
        headers = default_headers()
        requested = requests(str(view.root), files, headers)
        program = (sys.executable, "-I", "-X", "utf8", "-m", "haros_ci.extract.cpp.exact_worker")
        named = dict.fromkeys(place for file in files for place in directories(file.flags))
        reads = (str(view.root), *footing.of_program(program), *footing.HEADERS, *headers, *named)

        def one(item: tuple[int, str]) -> tuple[str, int]:
            number, request = item
            home = scratch / str(number)
            confinement = Confinement(reads, (str(home), *footing.WRITTEN))
            command = Command(program, stdin=request.encode())
            home.mkdir()
            try:
                output = processes.run(command, root=view.root, scratch=home, timeout=PATIENCE, confinement=confinement)
            except (TimedOut, Unstartable):
                return "", 1
            return output.stdout.decode("utf-8", "replace"), output.code

        try:
            with ThreadPoolExecutor(max(settings.jobs, 1)) as pool:
                for file, (answer, code) in zip(files, pool.map(one, enumerate(requested)), strict=False):
                    if code == MISSING:
                        message = "libclang is not installed, so nothing was asked of it: pip install 'haros-ci[exact]'"
                        return {}, (Problem(".", message),)
                    if code:
                        problems.append(Problem(file.path, "libclang did not get through the file; its blanks stay"))
                    reported.update(parse(answer))
                    problems += failures(answer)
        finally:
            processes.stop()
    return reported, tuple(dict.fromkeys(problems))


def sourced(found: Architecture, before: Architecture) -> Architecture:
    """*found* with libclang, where what is from the sources alone (*before*) has them as its origin: the same kind, name and type at the same place of the same node."""
    known = {
        (configuration.name, node.name, _known_of(end))
        for configuration in before.configurations
        for node in configuration.nodes
        for end in node.endpoints
    }
    return replace(
        found,
        configurations=tuple(
            replace(
                configuration,
                nodes=tuple(
                    replace(
                        node,
                        endpoints=tuple(
                            replace(end, source="source")
                            if end.source == "exact-tier" and (configuration.name, node.name, _known_of(end)) in known
                            else end
                            for end in node.endpoints
                        ),
                    )
                    for node in configuration.nodes
                ),
            )
            for configuration in found.configurations
        ),
    )


def _known_of(end: Endpoint) -> tuple[object, ...]:
    return end.kind, end.location, end.name, end.type


def _flags(workspace: Workspace, path: str) -> tuple[str, ...]:
    """Without a compile database: every package's include directory, and the definition that roscpp's macros need."""
    root = workspace.root
    flags = []
    for package in workspace.packages:
        include = root / package.path / "include"
        if include.is_dir():
            flags.append(f"-I{include}")
        if path.startswith(f"{package.path}/") or package.path == ".":
            flags.append(f'-DROS_PACKAGE_NAME="{package.name}"')
    return ("-std=c++17", *flags)
