# SPDX-License-Identifier: Apache-2.0
"""The coverage of call sites as JSON, schema version 1: keys are added, never renamed (docs/model.md)."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from haros_ci.model.coverage import AREAS, Counts, Coverage
from haros_ci.report.escape import json_document

SCHEMA_VERSION = 1


def render(found: Coverage) -> str:
    """The document; ASCII, with a final newline."""
    document = {
        "schema_version": SCHEMA_VERSION,
        "total": {area: _counts(found.counts(area)) for area in AREAS},
        "packages": [
            {"name": name or None, **{area: _counts(found.counts(area, name)) for area in AREAS}}
            for name in found.packages()
        ],
        "incomplete": found.incomplete(),
        "sites": [
            {
                **asdict(site),
                "package": site.package or None,
                "reason": site.reason or None,
                "detail": site.detail or None,
            }
            for site in found.sites
        ],
    }
    return json_document(document, 1) + "\n"


def _counts(counts: Counts) -> dict[str, Any]:
    share = counts.share
    return {**asdict(counts), "accounted": counts.accounted, "share": None if share is None else round(share, 4)}
