# SPDX-License-Identifier: Apache-2.0
"""HAROS's limits by level and metric, as the rules of the tool ``metrics`` hold them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.linters.metrics import (
    CLASS_THRESHOLDS,
    FILE_THRESHOLDS,
    FUNCTION_THRESHOLDS,
    STRUCTURE_THRESHOLDS,
    Threshold,
)
from haros_ci.linters.values import FILE_METRICS, FUNCTION_METRICS
from haros_ci.report.measurements import Limit


def _limits(level: str, thresholds: Iterable[Threshold], names: Mapping[str, str]) -> Iterable[Limit]:
    """*names* leads from metrics to what the workers call them."""
    called = {key: metric for metric, key in names.items()}
    for threshold in thresholds:
        yield Limit(
            threshold.rule, level, called.get(threshold.metric, threshold.metric), threshold.limit, threshold.below
        )


LIMITS: tuple[Limit, ...] = (
    *_limits("function", FUNCTION_THRESHOLDS, FUNCTION_METRICS),
    *_limits("function", STRUCTURE_THRESHOLDS, {}),
    *_limits("class", CLASS_THRESHOLDS, {}),
    *_limits("file", FILE_THRESHOLDS, FILE_METRICS),
)
