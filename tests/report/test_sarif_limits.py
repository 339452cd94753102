# SPDX-License-Identifier: Apache-2.0
"""Past GitHub's limits the least is left out, and said so."""

from __future__ import annotations

import gzip
import json
from dataclasses import replace
from typing import Any

import pytest
from report_samples import COMPARED, CPP, CPPCHECK_RUN, NULL, NULL_RESULT, PLAIN, PYLINT_RUN, SCOPE_RESULT, SHAPES

from haros_ci.model.location import Location
from haros_ci.report import sarif
from haros_ci.report.sarif_limits import Limits
from haros_ci.results.result import BaselineState, Related, Report, Result
from haros_ci.results.rule import Level


def read(report: Report, limits: Limits) -> tuple[list[dict[str, Any]], list[str]]:
    text, notes = sarif.log(report, limits=limits)
    said = json.loads(text)["runs"]
    messages = [note.message for note in notes]
    assert all(message in text for message in messages), "what is cut is said in the log, too"
    return said, messages


def at(line: int, level: Level, state: BaselineState | None = None) -> Result:
    return replace(SCOPE_RESULT, location=Location(CPP, line), level=level, state=state)


@pytest.mark.parametrize("report", SHAPES.values(), ids=SHAPES)
def test_nothing_is_cut_within_the_limits(report: Report) -> None:
    text, notes = sarif.log(report)
    assert notes == ()
    assert sum(len(run["results"]) for run in json.loads(text)["runs"]) == len(report.results)


def test_results_lowest_level_last_sorted_first() -> None:
    results = (at(1, Level.NOTE), at(2, Level.WARNING), at(3, Level.NOTE), at(4, Level.ERROR), at(5, Level.NOTE))
    (run,), said = read(replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=results),)), Limits(results=3))
    assert [r["locations"][0]["physicalLocation"]["region"]["startLine"] for r in run["results"]] == [1, 2, 4]
    assert said == ["Only the 3 most severe of 5 results are in this log."]


def test_new_results_outlast_known_ones() -> None:
    results = (at(1, Level.ERROR, BaselineState.UNCHANGED), at(2, Level.NOTE, BaselineState.NEW))
    (run,), _ = read(replace(COMPARED, runs=(replace(CPPCHECK_RUN, results=results),)), Limits(results=1))
    assert [r["baselineState"] for r in run["results"]] == ["new"]


def test_runs() -> None:
    (run,), said = read(replace(PLAIN, runs=(PYLINT_RUN, CPPCHECK_RUN)), Limits(runs=1))
    assert run["tool"]["driver"]["name"] == "cppcheck"
    assert said == ["Only 1 runs fit in one log; left out: pylint."]


def test_rules_without_results_go_first() -> None:
    (run,), said = read(replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(SCOPE_RESULT,)),)), Limits(rules=1))
    assert [rule["id"] for rule in run["tool"]["driver"]["rules"]] == ["variableScope"]
    assert said == ["Only 1 of 2 rules are described in this log."]


def test_locations() -> None:
    near = tuple(Related(Location(CPP, n), f"Step {n}") for n in range(1, 9))
    run = replace(CPPCHECK_RUN, results=(replace(NULL_RESULT, related=near),))
    (written,), said = read(replace(PLAIN, runs=(run,)), Limits(locations=4))
    assert [place["id"] for place in written["results"][0]["relatedLocations"]] == [1, 2, 3]
    assert said == ["Related locations past the first 3 are left out of 1 results."]


def test_tags() -> None:
    rule = replace(NULL, tags=("security", *(f"tag{n:02}" for n in range(30))), cwe=(1, 2))
    (run,), said = read(replace(PLAIN, runs=(replace(CPPCHECK_RUN, rules=(rule,), results=()),)), Limits())
    tags = run["tool"]["driver"]["rules"][0]["properties"]["tags"]
    assert len(tags) == 20 and tags[:3] == ["security", "external/cwe/cwe-001", "external/cwe/cwe-002"]
    assert said == ["Tags past the first 20 are left out of 1 rules."]


def test_descriptions_are_cut() -> None:
    rule = replace(NULL, summary="word " * 1000, help="word " * 10_000)
    (run,), _ = read(replace(PLAIN, runs=(replace(CPPCHECK_RUN, rules=(rule,), results=()),)), Limits())
    (written,) = run["tool"]["driver"]["rules"]
    assert len(written["shortDescription"]["text"]) <= 1024 and len(written["fullDescription"]["text"]) <= 1024


def test_compressed_size() -> None:
    # Lines of digits that differ, so that compression cannot make them vanish.
    results = tuple(
        replace(at(n, Level.ERROR if n % 10 == 0 else Level.NOTE), message=f"{n * 2654435761 % 2**32:x} " * 3)
        for n in range(1, 3001)
    )
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=results),), artifacts=())
    limit = 20_000
    text, notes = sarif.log(report, limits=Limits(bytes=limit))
    assert limit * 0.6 < len(gzip.compress(text.encode(), 6, mtime=0)) <= limit
    (run,) = json.loads(text)["runs"]
    kept = run["results"]
    assert 300 < len(kept) < 3000 and sum(r["level"] == "error" for r in kept) == 300
    (note,) = notes
    assert (
        note.message
        == f"Only the {len(kept)} most severe of 3000 results are in this log, which would be too big for GitHub."
    )
    assert note.message in text


def test_a_log_that_never_fits_still_ends() -> None:
    text, (note,) = sarif.log(PLAIN, limits=Limits(bytes=10))
    assert all(run["results"] == [] for run in json.loads(text)["runs"])
    assert note.message.startswith("Only the 0 most severe of 4")
