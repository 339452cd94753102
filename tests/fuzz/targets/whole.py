# SPDX-License-Identifier: Apache-2.0
"""A target of everything behind the readers: checks, queries, suppressions and every format on a small workspace."""

from __future__ import annotations

from fuzz.targets.kit import ROOT, Entry, parts, ros_package, workspace

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.inspection import inspected
from haros_ci.commands.output import FORMATS, Extras
from haros_ci.config.settings import Settings
from haros_ci.pipeline import finished, own_run, selected, selection_of
from haros_ci.registry import built_in
from haros_ci.report import model_dot, model_json, model_mermaid, model_text
from haros_ci.results.result import Report, distribute, results_of
from haros_ci.results.rule import Level
from haros_ci.workspace.cache import MemoryCache


def checks(data: bytes) -> object:
    """Files of a workspace through every check; none of them may fail."""
    files = parts(data, "bot/CMakeLists.txt")
    space = workspace({"bot/package.xml": ros_package(), **files})
    settings = Settings(root=ROOT, profile="all")
    known = built_in()
    selection, _ = selection_of(settings, known)
    architectures = Architectures(settings, MemoryCache(), known)
    run = inspected(own_run(space, known), space, selection, architectures, None)
    assert run.successful, [note.message for note in run.notifications if note.level is Level.ERROR]
    results = selected(results_of((run,)), selection, space)
    runs = finished(distribute((run,), results), space, selection, settings)
    report = Report(runs=runs)
    view = Extras(source=space.text, flags={"why": True, "sarif_for": "github"}, to_file=True)
    made = {name: render(report, view) for name, render in FORMATS.items() if name != "github"}
    assert "\x1b" not in made["text"]
    found = architectures.of(space).architecture
    return made, [module.render(found) for module in (model_dot, model_json, model_mermaid, model_text)]


TARGETS = {
    "checks": Entry(
        checks,
        "a workspace of several files, through all checks and formats",
        ("checking", "analysis.architectures", "report"),
        (b"@@ bot/CMakeLists.txt\n", b"@@ bot/launch/a.launch.py\n", b"@@ bot/src/a.cpp\n", b"@@ bot/package.xml\n"),
    )
}
