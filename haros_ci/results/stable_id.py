# SPDX-License-Identifier: Apache-2.0
"""One id for each finding of a report, for readers that identify findings, and compare two reports, by an id alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from haros_ci.results.fingerprint import digest
from haros_ci.results.known import identity_of
from haros_ci.results.result import BaselineState, Result


def stable_ids(results: Iterable[Result]) -> tuple[tuple[str, Result], ...]:
    """Each of *results* with its id, in output order: 16 hexadecimal digits, no two alike.

    An id depends on rule, file, scope and the text of the line (of a finding about ROS names on these instead), and counts
    equal ones from top to bottom. Lines and columns are not in it, so that it stays when lines move. Give all results
    of a report, also those that are not shown: an id does not depend on what is known. Absent results come last, so that they take no id from a present one.
    """
    ordered = sorted(results, key=lambda result: result.sort_key)
    counts: Counter[tuple[str, ...]] = Counter()
    ids: dict[int, str] = {}
    for i in sorted(range(len(ordered)), key=lambda i: ordered[i].state is BaselineState.ABSENT):
        result = ordered[i]
        identity = identity_of(result)
        about = identity.names or identity.text or identity.template
        key = (result.tool, result.rule, result.location.path, identity.scope, about)
        counts[key] += 1
        ids[i] = digest("\0".join((*key, str(counts[key]))))
    return tuple((ids[i], result) for i, result in enumerate(ordered))
