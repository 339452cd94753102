# SPDX-License-Identifier: Apache-2.0
"""``packages.json`` and ``metrics/``: what each package is, what was found in it, what was measured of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from math import isfinite
from typing import Any

from haros_ci.haros_json.places import JsonPlaces
from haros_ci.haros_json.texts import link, name, words
from haros_ci.model.location import Location
from haros_ci.model.manifest import Manifest
from haros_ci.model.measurement import Measurement
from haros_ci.model.package import Package, SourceFile

#: The dependencies that HAROS counts (``extractor.py:PackageParser``), in all formats of the manifest.
DEPENDENCIES = ("build_depend", "run_depend", "depend", "build_export_depend", "exec_depend")


def needed(package: Package) -> frozenset[str]:
    """The names of the packages that *package* needs to be built or run."""
    return frozenset(one.name for one in package.dependencies if one.kind in DEPENDENCIES) - {package.name}


def package_json(
    package: Package,
    manifest: Manifest,
    files: Iterable[SourceFile],
    issues: Iterable[Mapping[str, Any]],
    measurements: Iterable[Measurement],
    places: JsonPlaces,
    sloc: Callable[[str], int],
) -> dict[str, Any]:
    """The entry of ``packages.json``; *sloc* counts a file's lines that are not blank."""
    files = tuple(files)
    return {
        "id": places.ids[package.path],
        "metapackage": package.is_metapackage,
        "version": words(package.version),
        "description": words(manifest.description),
        "wiki": link(manifest.website),
        "repository": link(manifest.repository),
        "bugTracker": link(manifest.bugtracker),
        "authors": sorted(words(one) for one in manifest.authors),
        "maintainers": sorted(words(one) for one in manifest.maintainers),
        "dependencies": sorted({places.named(one) or name(one) for one in needed(package)}),
        "size": f"{sum(file.size for file in files) / 1000:.2f}",
        "lines": sum(file.lines for file in files),
        "sloc": sum(sloc(file.path) for file in files),
        "analysis": {
            "violations": dict(sorted(Counter(issue["rule"] for issue in issues).items())),
            "metrics": {
                haros_metric(one.metric): value(one) for one in measurements if not one.path and isfinite(one.value)
            },
        },
    }


def measurement_json(one: Measurement, places: JsonPlaces) -> dict[str, Any]:
    """The entry of a package's file of measurements."""
    place = Location(one.path, one.line or None) if one.path else None
    location = places.location(place, function=one.function or None, class_name=one.class_name or None)
    if place is None:
        location["package"] = places.named(one.package)
    return {"metric": haros_metric(one.metric), "value": value(one), "location": location}


def haros_metric(metric: str) -> str:
    """A metric as HAROS calls it."""
    return metric.replace("-", "_")


def value(one: Measurement) -> float | int | None:
    """Whole numbers without a fraction; null for what is no number."""
    if not isfinite(one.value):
        return None
    return int(one.value) if one.value == int(one.value) else one.value
