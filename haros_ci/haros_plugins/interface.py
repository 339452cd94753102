# SPDX-License-Identifier: Apache-2.0
"""What HAROS's plug-ins are given to speak through (HAROS ``analysis_manager.py``: PluginInterface), and their data."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from haros_ci.haros_plugins.views import CLASSES, EntityView, ReportedLocation
from haros_ci.records import dataclass, field

Say = Callable[[dict[str, Any]], None]


class AnalysisScopeError(Exception):
    """A plug-in reports on something that cannot be reported on."""


@dataclass
class Described:
    """A rule or a metric, with all that HAROS gives either."""

    id: str
    name: str = ""
    scope: str = ""
    description: str = ""
    tags: list[str] = field(default_factory=list)
    query: str | None = None
    minimum: float | None = None
    maximum: float | None = None

    def to_JSON_object(self) -> dict[str, Any]:
        return dict(vars(self))


@dataclass
class Violation:
    """What a rule's breach is to the hooks of processing."""

    rule: Described
    location: Any
    details: str | None = None
    affected: list[Any] = field(default_factory=list)

    @property
    def scope(self) -> Any:
        return self.location.smallest_scope

    def to_JSON_object(self) -> dict[str, Any]:
        return {"rule": self.rule.id, "comment": self.details, "location": _json(self.location), "resources": []}


@dataclass
class Measurement:
    """A metric's value, to the hooks of processing."""

    metric: Described
    location: Any
    value: float

    @property
    def scope(self) -> Any:
        return self.location.smallest_scope

    def to_JSON_object(self) -> dict[str, Any]:
        return {"metric": self.metric.id, "value": self.value, "location": _json(self.location)}


def _json(location: Any) -> Any:
    return location.to_JSON_object() if location is not None else None


class PluginInterface:
    """*say* tells haros-ci what the plug-in reports.

    Names of methods and arguments are HAROS's.
    """

    def __init__(
        self,
        name: str,
        home: str,
        rules: Mapping[str, Described],
        metrics: Mapping[str, Described],
        scopes: Mapping[str, EntityView],
        say: Say,
    ) -> None:
        self.state: Any = None
        self._scope: EntityView | None = None
        self._name, self._home, self._say = name, home, say
        self._rules, self._metrics, self._scopes = rules, metrics, scopes

    def get_file(self, relative_path: str) -> str:
        """The absolute path of a file of the plug-in's package."""
        return os.path.join(self._home, relative_path)

    def export_file(self, relative_path: str) -> None:
        """Keep a file of the temporary directory that the plug-in runs in."""
        self._say({"kind": "export", "path": str(relative_path)})

    def find_package(self, scope_id: str) -> Any:
        return self._found(scope_id, "package")

    def find_configuration(self, scope_id: str) -> Any:
        return self._found(scope_id, "configuration")

    def _found(self, scope_id: str, kind: str) -> Any:
        whole = scope_id if scope_id.startswith(f"{kind}:") else f"{kind}:{scope_id}"
        return self._scopes.get(whole)

    def log_debug(self, msg: object) -> None:
        """Said to nobody."""

    def log_warning(self, msg: object) -> None:
        self._say({"kind": "log", "level": "warning", "message": str(msg)[:2000]})

    def log_error(self, msg: object) -> None:
        self._say({"kind": "log", "level": "error", "message": str(msg)[:2000]})

    def report_violation(
        self,
        rule_id: str,
        msg: object,
        scope: Any = None,
        line: int | None = None,
        function: str | None = None,
        class_: str | None = None,
    ) -> None:
        place = self._place(scope, line, function, class_)
        rule = self._known(rule_id, self._rules)
        if rule is not None:
            self._say({"kind": "violation", "rule": rule.id, "message": str(msg)[:20_000], **place})

    def report_runtime_violation(self, rule_id: str, msg: object, resources: Iterable[Any] | None = None) -> None:
        if not isinstance(self._scope, CLASSES["Configuration"]):
            raise AnalysisScopeError("must provide a Configuration scope")
        about = list(resources or ())
        kinds = (CLASSES["Resource"], CLASSES["RosPrimitive"])
        if any(not isinstance(item, kinds) or item.configuration is not self._scope for item in about):  # type: ignore[attr-defined]  # the kinds that are looked at first have it
            raise AnalysisScopeError("must point to resources within the Configuration scope")
        rule = self._known(rule_id, self._rules)
        if rule is not None:
            message = {"kind": "violation", "rule": rule.id, "message": str(msg)[:20_000]}
            self._say(
                {**message, **self._place(None, None, None, None), "resources": [_resource(item) for item in about]}
            )

    def report_metric(
        self,
        metric_id: str,
        value: float,
        scope: Any = None,
        line: int | None = None,
        function: str | None = None,
        class_: str | None = None,
    ) -> None:
        place = self._place(scope, line, function, class_)
        metric = self._known(metric_id, self._metrics)
        if metric is None:
            return
        number = float(value)
        low, high = metric.minimum, metric.maximum
        if not (number >= (low if low is not None else number) and number <= (high if high is not None else number)):
            text = f"{number:g} is no value of the metric {metric.id} ({_bounds(low, high)}) and is left out"
            self._say({"kind": "log", "level": "warning", "message": text})
            return
        self._say({"kind": "metric", "metric": metric.id, "value": number, **place})

    def _place(self, scope: Any, line: int | None, function: str | None, class_: str | None) -> dict[str, Any]:
        """Where it is reported; HAROS ends a plug-in that reports on nothing, or on what it does not analyse."""
        scope = scope or self._scope
        if scope is None:
            raise AnalysisScopeError("must provide a scope")
        if self._scopes.get(getattr(scope, "id", "")) is None:
            scope = getattr(getattr(scope, "location", None), "smallest_scope", scope)
        if self._scopes.get(getattr(scope, "id", "")) is None:
            raise AnalysisScopeError(f"invalid scope: {getattr(scope, 'id', scope)}")
        return {
            "scope": scope.id,
            "line": None if line is None else int(line),
            "function": str(function or ""),
            "class": str(class_ or ""),
        }

    def _known(self, id: str, known: Mapping[str, Described]) -> Described | None:
        """HAROS drops what it does not know without a word."""
        return known.get(id) or known.get(str(id).removeprefix(f"{self._name}:"))


def _resource(view: EntityView) -> dict[str, Any]:
    """The name of a resource, or of what a link leads to, and where it stands."""
    entity = view._entity
    place = getattr(entity, "place", None)
    name = getattr(entity, "full", None) or getattr(getattr(entity, "resource", None), "full", "")
    node = getattr(getattr(entity, "node", None), "full", "")
    return {
        "names": [item for item in (name, node) if item],
        "path": getattr(place, "path", None),
        "line": getattr(place, "line", None),
        "column": getattr(place, "column", None),
        "words": str(view),
    }


def _bounds(low: float | None, high: float | None) -> str:
    return ", ".join(
        text
        for text in (f"least {low:g}" if low is not None else "", f"most {high:g}" if high is not None else "")
        if text
    )


def location_of(data: Mapping[str, Any], scope: EntityView) -> ReportedLocation:
    """The place of a datum of another plug-in, or of haros-ci, in *scope*."""
    file = scope if isinstance(scope, CLASSES["SourceFile"]) else None
    package = scope.package if file is not None else scope if isinstance(scope, CLASSES["Package"]) else None
    return ReportedLocation(
        package, file, data.get("line"), None, data.get("function") or None, data.get("class") or None
    )
