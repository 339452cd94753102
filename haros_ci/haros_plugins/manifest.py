# SPDX-License-Identifier: Apache-2.0
"""A plug-in of HAROS as its plugin.yaml describes it; nothing of it is imported here."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from haros_ci.bounded_yaml import YamlFault, YamlLimits
from haros_ci.bounded_yaml import data as yaml_data
from haros_ci.errors import UserError
from haros_ci.haros_plugins.common import METRICS, RULES
from haros_ci.plugins.place import digest, located
from haros_ci.records import dataclass, field
from haros_ci.results.rule import Level, Rule

PREFIX = "haros_plugin_"
#: Bytes that a plugin.yaml or plugin.py may have.
LARGEST = 4_000_000
LIMITS = YamlLimits(characters=LARGEST, aliases=1_000)
#: A plug-in is run because somebody names it: all its rules are on, until they are ignored.
PROFILES = ("ros", "strict", "google", "bugs-only", "architecture")


@dataclass(frozen=True, slots=True)
class Metric:
    """A metric with its bounds, None for none."""

    id: str
    name: str = ""
    scope: str = ""
    description: str = ""
    minimum: float | None = None
    maximum: float | None = None


@dataclass(frozen=True, slots=True)
class HarosPlugin:
    """*name* is the module's, *home* its directory. *rules* and *metrics* are its own, by the ids of plugin.yaml.

    *queries* are those rules that HAROS asks as queries, in its own words. *hooks* are the functions that plugin.py has; "*" if they are
    not known.
    """

    name: str
    version: str
    digest: str
    home: Path
    languages: tuple[str, ...] = ()
    rules: Mapping[str, Rule] = field(default_factory=dict)
    metrics: Mapping[str, Metric] = field(default_factory=dict)
    queries: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    hooks: frozenset[str] = frozenset()

    def all_rules(self) -> dict[str, Rule]:
        """Its own rules and those that all plug-ins share."""
        return {**{id: _rule(id, id, "", ("haros",)) for id in RULES}, **self.rules}

    def all_metrics(self) -> dict[str, Metric]:
        """Its own metrics and those that all plug-ins share."""
        shared = {id: Metric(id, id, minimum=low, maximum=high) for id, (low, high) in METRICS.items()}
        return {**shared, **self.metrics}


def read(name: str, root: Path) -> HarosPlugin:
    """The plug-in *name*, which is not to lie in the workspace at *root*; UserError says what is wrong with it."""
    spec = located(name, root)
    if not spec.submodule_search_locations or spec.origin is None:
        raise _malformed(name, "it is no package")
    home = Path(spec.origin).parent
    data = _manifest(name, home)
    hooks = _hooks(name, home / "plugin.py")
    return HarosPlugin(
        name=name,
        version=str(data["version"]),
        digest=digest(spec),
        home=home,
        languages=tuple(str(item) for item in _list(name, data, "languages")),
        rules={
            id: _rule(id, str(item.get("name") or id), str(item.get("description") or ""), _tags(item))
            for id, item in _map(name, data, "rules").items()
            if id not in RULES  # as in HAROS, where a shared rule cannot be overridden
        },
        metrics={id: _metric(name, id, item) for id, item in _map(name, data, "metrics").items() if id not in METRICS},
        queries={id: item for id, item in _map(name, data, "rules").items() if item.get("query") and id not in RULES},
        hooks=hooks,
    )


def _manifest(name: str, home: Path) -> Mapping[str, Any]:
    try:
        data = yaml_data(_text(name, home / "plugin.yaml"), LIMITS)
    except (YamlFault, RecursionError) as err:
        raise _malformed(name, f"plugin.yaml is no YAML: {' '.join(str(err).split())[:300]}") from err
    if not isinstance(data, dict) or data.get("name") != name or "version" not in data:
        raise _malformed(name, f"plugin.yaml has not both 'name: {name}' and 'version'")
    return data


def _hooks(name: str, path: Path) -> frozenset[str]:
    """The functions that the module has, which is only read here."""
    text = _text(name, path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError) as err:
        line = getattr(err, "lineno", None)
        place = f"plugin.py:{line}" if line else "plugin.py"
        raise _malformed(
            name, f"{place} is no Python 3: {getattr(err, 'msg', err)}", "plug-ins for Python 2 cannot be run"
        ) from err
    found: set[str] = set()
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            found.add(node.name)
        elif isinstance(node, ast.ImportFrom):
            found.update(alias.asname or alias.name for alias in node.names)
        elif isinstance(node, (ast.Assign, ast.If, ast.Try)):
            found.update(other_node.id for other_node in ast.walk(node) if isinstance(other_node, ast.Name))
            found.update(other_node.name for other_node in ast.walk(node) if isinstance(other_node, ast.FunctionDef))
    return frozenset(found)


def _text(name: str, path: Path) -> str:
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except OSError as err:
        raise _malformed(name, f"{path.name} cannot be read: {err.strerror}") from err
    if len(data) > LARGEST:
        raise _malformed(name, f"{path.name} has more than {LARGEST:,} bytes")
    return data.decode("utf-8", "replace")


def _map(name: str, data: Mapping[str, Any], key: str) -> dict[str, dict[str, Any]]:
    value = data.get(key) or {}
    if not isinstance(value, dict) or not all(isinstance(v, dict) for v in value.values()):
        raise _malformed(name, f"'{key}' of plugin.yaml is no map from ids to maps")
    return {str(id): item for id, item in value.items()}


def _list(name: str, data: Mapping[str, Any], key: str) -> list[Any]:
    value = data.get(key) or []
    if not isinstance(value, list):
        raise _malformed(name, f"'{key}' of plugin.yaml is no list")
    return value


def _tags(entry: Mapping[str, Any]) -> tuple[str, ...]:
    tags = entry.get("tags")
    return tuple(dict.fromkeys(("haros", *(str(tag) for tag in tags)))) if isinstance(tags, list) else ("haros",)


def _rule(id: str, name: str, description: str, tags: tuple[str, ...]) -> Rule:
    summary = (name.rstrip(". ") or id) + "."
    help = description or f"{summary} A rule of a HAROS plug-in, which gives no more words to it."
    return Rule(id, summary, Level.WARNING, help, profiles=PROFILES, tags=tags, precision="medium")


def _metric(name: str, id: str, entry: Mapping[str, Any]) -> Metric:
    """HAROS reads ``min`` and ``max``; some plug-ins of its own write ``minimum`` and ``maximum``."""
    bounds = []
    for short, long in (("min", "minimum"), ("max", "maximum")):
        bound = entry.get(short, entry.get(long))
        if bound is not None and (isinstance(bound, bool) or not isinstance(bound, (int, float))):
            raise _malformed(name, f"'{short}' of the metric {id} is no number")
        bounds.append(bound)
    title, scope, description = (str(entry.get(key) or "") for key in ("name", "scope", "description"))
    return Metric(id, title, scope, description, *bounds)


def _malformed(name: str, fault: str, help: str = "mend the plug-in, or leave it out") -> UserError:
    return UserError(f"plug-in {name}: {fault}", help=help)
