# SPDX-License-Identifier: Apache-2.0
"""The phases of a plug-in of HAROS, in its own process: which hooks are called, in which order, with what."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from types import ModuleType
from typing import Any

from haros_ci.haros_plugins.interface import Described, Measurement, PluginInterface, Say, Violation, location_of
from haros_ci.haros_plugins.views import EntityView, Model, install
from haros_ci.query.queries import Scenes

#: The kinds of scopes with hooks of their own, in HAROS's order.
ORDER = ("file", "package", "configuration")


class Hosted:
    """The plug-in of *job* on the model (*architecture*, files, project file); what it reports goes to *say*."""

    def __init__(self, job: Mapping[str, Any], model: tuple[Any, Any, Any], say: Say) -> None:
        architecture, files, project = model
        install(sys.modules)
        self.languages = frozenset(job["languages"])
        scenes = Scenes(architecture, files, project)
        views = Model(job["root"])
        paths = frozenset(job["files"])
        packages = [
            views.view(package) for package in scenes.world.packages.values() if package.name in job["packages"]
        ]
        self.scopes: dict[str, list[EntityView]] = {
            "file": [file for package in packages for file in package.source_files if file._entity.path in paths],
            "package": packages,
            "configuration": [views.view(system) for system in scenes.systems],
        }
        reportable = {view.id: view for kind in ORDER for view in self.scopes[kind]}
        every = {f"package:{package.name}": views.view(package) for package in scenes.world.packages.values()}
        self.rules = {item["id"]: Described(**item) for item in job["rules"]}
        self.metrics = {item["id"]: Described(**item) for item in job["metrics"]}
        self.iface = PluginInterface(job["name"], job["home"], self.rules, self.metrics, {**every, **reportable}, say)

    def run(self, module: ModuleType, request: Mapping[str, Any]) -> None:
        """One phase; an exception of the plug-in ends it."""
        if request["phase"] == "analysis":
            self._analysis(module)
        else:
            self._processing(module, request)

    def _analysis(self, module: ModuleType) -> None:
        self.iface.state = module.pre_analysis() if hasattr(module, "pre_analysis") else None
        for kind in ORDER:
            hook: Any = getattr(module, f"{kind}_analysis", None)
            for scope in self.scopes[kind] if hook is not None else ():
                if kind != "file" or scope.language in self.languages:
                    self.iface._scope = scope
                    hook(self.iface, scope)
        self.iface._scope = None
        if hasattr(module, "post_analysis"):
            module.post_analysis(self.iface)

    def _processing(self, module: ModuleType, request: Mapping[str, Any]) -> None:
        """As in HAROS: of each scope first the violations and then the metrics, as they stood after all analyses."""
        self.iface.state = module.pre_process() if hasattr(module, "pre_process") else None
        for kind in ORDER:
            for scope in self.scopes[kind]:
                self.iface._scope = scope
                for what, data in (
                    ("violation", self._violations(request, scope)),
                    ("metric", self._metrics(request, scope)),
                ):
                    hook: Any = getattr(module, f"process_{kind}_{what}", None)
                    for datum in data if hook is not None else ():
                        hook(self.iface, datum)
        self.iface._scope = None
        if hasattr(module, "post_process"):
            module.post_process(self.iface)

    def _violations(self, request: Mapping[str, Any], scope: EntityView) -> Iterator[Violation]:
        for data in request["violations"].get(scope.id, ()):
            rule = Described(data["rule"], data["name"], description=data["description"], tags=data["tags"])
            yield Violation(rule, self._location(data, scope), data["message"], [scope])

    def _metrics(self, request: Mapping[str, Any], scope: EntityView) -> Iterator[Measurement]:
        for data in request["metrics"].get(scope.id, ()):
            metric = self.metrics.get(data["metric"]) or Described(data["metric"], data["metric"])
            yield Measurement(metric, self._location(data, scope), data["value"])

    def _location(self, data: Mapping[str, Any], scope: EntityView) -> Any:
        return scope.location if scope in self.scopes["configuration"] else location_of(data, scope)
