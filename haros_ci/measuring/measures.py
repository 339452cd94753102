# SPDX-License-Identifier: Apache-2.0
"""Every value of every metric of a workspace; docs/metrics.md defines them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from haros_ci.analysis.programs import programs
from haros_ci.code.codebase import codebase
from haros_ci.config.settings import Settings
from haros_ci.forks import shared
from haros_ci.index.index import Source
from haros_ci.linters import values
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.run import lint
from haros_ci.measuring.classes import Classes, Measured, measure_classes
from haros_ci.measuring.facts import FileFacts, FunctionFacts, from_json, to_json
from haros_ci.measuring.totals import of_files, of_packages
from haros_ci.model.measurement import Measurement
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.own_sources import OF_MEASURES, digest
from haros_ci.records import dataclass
from haros_ci.results.result import Notification, Run
from haros_ci.results.rule import Level
from haros_ci.timing import stage
from haros_ci.workspace.build import builds

Progress = Callable[[str], None]
#: What has these metrics.
TOOL = "metrics"


@dataclass(frozen=True, slots=True)
class Measures:
    """The values, sorted; what could not be measured and why; and the tools that failed, so that values are missing."""

    values: tuple[Measurement, ...]
    notifications: tuple[Notification, ...] = ()
    failed: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Structure:
    """What the syntax tells: facts by file, and the classes of the whole workspace."""

    facts: Mapping[str, FileFacts]
    classes: Classes

    def title(self, path: str, function: FunctionFacts) -> tuple[str, str]:
        """The class of a function ("" for none) and its name without that."""
        owner = self.classes.of_function.get((path, function.line, function.column))
        if owner is None:
            return "", function.name
        separator = owner.source.separator
        return owner.facts.name, function.name.rpartition(separator)[2]


def measured(
    workspace: Workspace, settings: Settings, store: Store, progress: Progress | None = None
) -> tuple[Measurement, ...]:
    """The metrics of functions, classes, files and packages, sorted."""
    return measure(workspace, settings, store, progress).values


def measure(
    workspace: Workspace,
    settings: Settings,
    store: Store,
    progress: Progress | None = None,
    sources: tuple[Source, ...] | None = None,
) -> Measures:
    """The same, with what went wrong; *sources* are the programs of *workspace* where they are at hand."""
    runs = tool_values(workspace, settings, store, progress)
    if progress is not None:
        progress("structure")
    with stage("structure"):
        found = structure(workspace, store, settings.jobs, sources)
    packages = {file.path: file.package or "" for file in workspace.files}
    single = [*_of_runs(runs, packages, found), *_of_structure(found, workspace, packages)]
    single += of_files(single)
    partly = {packages[file.path] for file in workspace.files if not workspace.reports_on(file.path)}
    whole = (measurement for measurement in single if measurement.package not in partly)
    notes = (*(_named(note) for run in runs for note in run.notifications), *problems(found, workspace))
    return Measures(
        tuple(sorted([*single, *of_packages(whole)])),
        tuple(dict.fromkeys(notes)),
        tuple(run.tool.name.removesuffix(values.SUFFIX) for run in runs if not run.successful),
    )


def tool_values(
    workspace: Workspace, settings: Settings, store: Store, progress: Progress | None = None
) -> tuple[Run, ...]:
    """What lizard and radon measure."""
    options = LintOptions(timeout=settings.linter_timeout, jobs=settings.jobs, root=settings.root)
    return lint(workspace, values.ADAPTERS, options, store, lambda tool, rule, path: True, progress)


def measuring_tools(settings: Settings) -> list[str]:
    """What the values of the tools that measure depend on besides the files: which versions there are."""
    options = LintOptions(timeout=settings.linter_timeout, jobs=settings.jobs, root=settings.root)
    return [repr(adapter.locate(options)) for adapter in values.ADAPTERS]


def _named(note: Notification) -> Notification:
    """A note of one of our adapters as one of the tool that it starts."""
    tool = (note.tool or "").removesuffix(values.SUFFIX)
    return replace(note, tool=tool, message=note.message.replace(note.tool or tool, tool, 1))


def structure(
    workspace: Workspace, store: Store, processes: int, sources: tuple[Source, ...] | None = None
) -> Structure:
    """Functions and classes, from *store* as far as the bytes of files are known there."""
    facts = file_facts(workspace, store, processes)
    if sources is None:
        sources = programs(workspace, builds(workspace), store, [], processes, in_full=True)
    code = codebase(sources, workspace.text)
    return Structure(facts, measure_classes(code, facts))


def file_facts(workspace: Workspace, store: Store, processes: int) -> dict[str, FileFacts]:
    """What the syntax of each C++ and Python file tells, by path; from *store* where it is known there."""
    files = [file for file in workspace.files if file.language in ("cpp", "python")]
    kept = {file.path: from_json(store.get(*_place(file))) for file in files}
    new = [file for file in files if kept[file.path] is None]
    jobs = [partial(_read, workspace, file.path, file.language) for file in new]
    for file, data in zip(new, shared(jobs, [file.path for file in new], processes), strict=True):
        store.put(*_place(file), data)
        kept[file.path] = from_json(data)
    return {path: facts for path, facts in kept.items() if facts is not None}


def _place(file: SourceFile) -> tuple[str, str, str]:
    """Where the facts of a file are kept: their kind, the path, and all that they depend on."""
    return f"measured-{file.language}", file.path, f"{digest(OF_MEASURES)} {file.digest}"


def _read(workspace: Workspace, path: str, language: str) -> object:
    if language == "cpp":
        from haros_ci.measuring.cpp import read_cpp as read
    else:
        from haros_ci.measuring.python import read_python as read
    return to_json(read(workspace.text(path)))


def function_values(function: FunctionFacts) -> dict[str, int]:
    """A function's metrics by name, those of its syntax."""
    return {
        "nested-control": function.nesting,
        "function-calls": function.calls,
        "unique-function-calls": function.distinct,
        "static-path-count": function.paths,
    }


def class_values(other_measured: Measured) -> dict[str, int]:
    """A class's metrics by name; one without methods has no weight and nothing available."""
    found = {
        "coupling": len(other_measured.coupled),
        "depth-in-tree": other_measured.depth,
        "number-of-children": other_measured.children,
    }
    if other_measured.facts.methods:
        found |= {
            "weighted-methods": other_measured.weighted_methods,
            "methods-available": other_measured.facts.available,
        }
    return found


def _of_structure(found: Structure, workspace: Workspace, packages: Mapping[str, str]) -> Iterator[Measurement]:
    for path, facts in found.facts.items():
        if not workspace.reports_on(path):
            continue
        for function in facts.functions:
            title = found.title(path, function)
            for metric, value in function_values(function).items():
                yield Measurement(packages[path], path, function.line, *title, metric, value)
    for other_measured in found.classes.every:
        path = other_measured.source.path
        for metric, value in class_values(other_measured).items() if workspace.reports_on(path) else ():
            yield Measurement(
                packages[path], path, other_measured.facts.line, other_measured.facts.name, "", metric, value
            )


def _of_runs(runs: Iterable[Run], packages: Mapping[str, str], found: Structure) -> Iterator[Measurement]:
    """What lizard and radon measured, under the names that the syntax has for the functions at the same places."""
    at: dict[tuple[str, int], list[FunctionFacts]] = defaultdict(list)
    for path, facts in found.facts.items():
        for function in facts.functions:
            at[path, function.line].append(function)
    for run in runs:
        for result in run.results:
            path, line, scope = result.location.path, result.location.line or 0, result.scope
            here = at.get((path, line), ())
            same = (
                here
                if len(here) == 1
                else [function_facts for function_facts in here if _last(function_facts.name) == _last(scope)]
            )
            title = found.title(path, same[0]) if scope and same else ("", scope)
            if result.value is not None:
                yield Measurement(packages.get(path, ""), path, line, *title, result.rule, result.value)


def _last(name: str) -> str:
    """The last part of a name in either language."""
    return name.rpartition("::")[2].rpartition(".")[2]


def problems(found: Structure, workspace: Workspace) -> Iterator[Notification]:
    """What the syntax does not tell: files and functions that cannot be read."""
    for path, facts in found.facts.items():
        for line, message in facts.problems if workspace.reports_on(path) else ():
            yield Notification(Level.WARNING, message, TOOL, path, line)
