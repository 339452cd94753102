# SPDX-License-Identifier: Apache-2.0
"""``summary.json``: the numbers of the visualizer's dashboard."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from typing import Any

from haros_ci.model.build import Build
from haros_ci.model.measurement import Measurement
from haros_ci.model.package import SourceFile
from haros_ci.records import dataclass
from haros_ci.regex import regex

NODELET = "nodelet::Nodelet"
COMPONENT = "rclcpp_components::NodeFactory"
#: Counts of lines that can be a function's length; the first that is measured of functions is taken.
LENGTHS = ("ploc", "eloc", "sloc", "lloc")
#: A time as HAROS writes it.
TIME = regex(r"[0-9]{4}(-[0-9]{2}){4}", re.ASCII)
#: What the history has of each revision.
HISTORY = (
    "timestamps",
    "lines_of_code",
    "comments",
    "issues",
    "standards",
    "metrics",
    "complexity",
    "function_length",
)
#: Earlier revisions that are kept in the history.
MOST_POINTS = 1000


@dataclass(frozen=True, slots=True)
class Nodes:
    """How many programs that can be nodes, and how many classes that are loaded as such, the packages build."""

    programs: int
    classes: int


def nodes_of(builds: Iterable[Build]) -> Nodes:
    """As HAROS counts: executables and scripts whether they use ROS or not, without those of tests; nodelets, and components."""
    programs: set[tuple[str, str]] = set()
    classes: set[tuple[str, str]] = set()
    for build in builds:
        package = build.package
        programs |= {(package, t.output) for t in build.targets if t.kind == "executable" and not t.is_test}
        programs |= {(package, point.name) for point in build.entry_points}
        points = {point.path for point in build.entry_points}
        scripts = {*build.scripts, *(one.path for one in build.installed if one.kind == "program")} - points
        programs |= {(package, path.rpartition("/")[2]) for path in scripts if not is_launch_file(path)}
        classes |= {(package, one.type) for one in build.plugins if one.base.replace(" ", "") in (NODELET, COMPONENT)}
    return Nodes(len(programs), len(classes))


def is_launch_file(path: str) -> bool:
    return path.endswith((".launch.py", "_launch.py"))


def summary_json(
    *,
    packages: int,
    files: Sequence[tuple[str, SourceFile]],
    dependencies: int,
    nodes: Nodes,
    systems: Sequence[Mapping[str, Any]],
    tags: Sequence[Iterable[str]],
    violated: int,
    tools: int,
    rules: int,
    user_rules: int,
    measurements: Sequence[Measurement],
    timestamp: str | None,
) -> dict[str, Any]:
    """The whole file. *files* are those of the packages with their path in the package; *tags* those of each finding's rule.

    *rules* are the rules that are on; *timestamp* is that of the revision, in HAROS's form.
    """
    lines = sum(file.lines for _, file in files)
    language = {kind: sum(f.lines for _, f in files if f.language == kind) for kind in ("cpp", "python")}
    coding = sum("code-standards" in tag for tag in tags)
    metrics = sum("metrics" in tag for tag in tags)
    other = sum("code-standards" not in tag and "metrics" not in tag for tag in tags)
    comments = sum(_values(measurements, "comments", of_functions=False))
    complexity = _mean(_values(measurements, "cyclomatic-complexity", of_functions=True))
    lengths = (_values(measurements, metric, of_functions=True) for metric in LENGTHS)
    length = _mean(next((found for found in lengths if found), []))
    point = [] if timestamp is None else [timestamp]

    def history(value: float) -> list[float]:
        return [int(value) if value == int(value) else value] if point else []

    return {
        "source": {
            "packages": packages,
            "files": len(files),
            "scripts": sum(inside.startswith("scripts/") for inside, _ in files),
            "languages": {
                "cpp": _ratio(language["cpp"], lines),
                "cppLOC": language["cpp"],
                "python": _ratio(language["python"], lines),
                "pythonLOC": language["python"],
            },
            "pkgDependencies": dependencies,
        },
        "issues": {
            "total": len(tags),
            "coding": coding,
            "metrics": metrics,
            "other": other,
            "ratio": f"{_ratio(len(tags), lines):.2f}",
        },
        "components": {
            "launchFiles": sum(f.language == "launch" or is_launch_file(f.path) for _, f in files),
            "nodes": nodes.programs,
            "nodelets": nodes.classes,
            "parameterFiles": None,
            "configurations": len(systems),
        },
        "communications": {
            "topics": sum(len(system["topics"]) for system in systems),
            "remappings": sum(system["remaps"] for system in systems),
            **{
                key: sum(f.path.endswith(suffix) for _, f in files)
                for key, suffix in (("messages", ".msg"), ("services", ".srv"), ("actions", ".action"))
            },
        },
        "analysis": {"plugins": tools, "rules": rules, "userRules": user_rules, "violatedRules": violated},
        "history": {
            "timestamps": point,
            "lines_of_code": history(lines),
            "comments": history(comments),
            "issues": history(len(tags)),
            "standards": history(coding),
            "metrics": history(metrics),
            "complexity": history(complexity),
            "function_length": history(length),
        },
    }


def with_history(own: Mapping[str, Any], before: object) -> Mapping[str, Any]:
    """The summary *own* with the points of the summary *before*, of the same project, that are earlier than its own."""
    mine = own["history"]
    points = points_of(before)
    latest = mine["timestamps"][0] if mine["timestamps"] else "9"
    earlier = sorted((point for point in points if point["timestamps"] < latest), key=lambda point: point["timestamps"])
    history = {key: [*(point[key] for point in earlier[-MOST_POINTS:]), *values] for key, values in mine.items()}
    return {**own, "history": history}


def points_of(summary: object) -> list[dict[str, Any]]:
    """The points of the history in a *summary* that anyone may have written: a time and a number for each of ``HISTORY``; [] for none."""
    kept = summary.get("history") if isinstance(summary, Mapping) else None
    if not isinstance(kept, Mapping) or not all(isinstance(kept.get(key), list) for key in HISTORY):
        return []
    return [
        dict(zip(HISTORY, values, strict=True))
        for values in zip(*(kept[key] for key in HISTORY), strict=False)
        if isinstance(values[0], str) and TIME.fullmatch(values[0]) and all(map(_is_number, values[1:]))
    ]


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e300


def _values(measurements: Iterable[Measurement], metric: str, *, of_functions: bool) -> list[float]:
    """What was measured of functions, or of files."""
    return [
        one.value
        for one in measurements
        if one.metric == metric
        and isfinite(one.value)
        and (bool(one.function) if of_functions else bool(one.path) and not one.class_name and not one.function)
    ]


def _mean(values: Sequence[float]) -> float:
    return round(sum(values) / len(values), 2) if values else 0


def _ratio(part: int, whole: int) -> float:
    return round(part / whole, 6) if whole else 0.0
