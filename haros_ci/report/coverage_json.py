# SPDX-License-Identifier: Apache-2.0
"""The coverage of call sites as JSON, schema version 1: keys are added, never renamed (docs/model.md)."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from haros_ci.model.coverage import AREAS, Counts, Coverage

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
    return json.dumps(document, indent=1, ensure_ascii=True) + "\n"


def _counts(counts: Counts) -> dict[str, Any]:
    share = counts.share
    return {**asdict(counts), "accounted": counts.accounted, "share": None if share is None else round(share, 4)}
