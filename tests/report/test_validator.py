# SPDX-License-Identifier: Apache-2.0
"""The real SARIF validator finds nothing in logs of every shape, and something in a bad one."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from multitool import Said, validate_all
from report_samples import HOSTILE, PLAIN, SHAPES, SOURCES, hostile

from haros_ci.report import sarif


def source(path: str) -> str:
    return SOURCES.get(path, "")


def without_description(log: dict[str, Any]) -> None:
    del log["runs"][0]["tool"]["driver"]["rules"][0]["shortDescription"]


def without_region(log: dict[str, Any]) -> None:
    del log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["region"]


def with_dangling_index(log: dict[str, Any]) -> None:
    log["runs"][0]["results"][0]["ruleIndex"] = 99


def spoiled(spoil: Callable[[dict[str, Any]], None]) -> str:
    log = json.loads(sarif.render(PLAIN))
    spoil(log)
    return json.dumps(log)


def of_hostile(text: str) -> str:
    return sarif.render(hostile(text), source=lambda path: f"a\nb\n{text}")


GOOD = {
    **{f"{name}-archive": sarif.render(report, source=source) for name, report in SHAPES.items()},
    **{f"{name}-archive-no-source": sarif.render(report) for name, report in SHAPES.items()},
    **{f"{name}-github": sarif.render(report, audience="github") for name, report in SHAPES.items()},
    **{f"hostile-{i}": of_hostile(text) for i, text in enumerate(HOSTILE)},
}
BAD = {
    "without description": (without_description, ("error", "GH2012")),
    "without region": (without_region, ("warning", "SARIF2017")),
    "with a dangling index": (with_dangling_index, ("error", "SARIF1009")),
}


@pytest.fixture(scope="module")
def said() -> dict[str, Said]:
    return validate_all({**GOOD, **{name: spoiled(spoil) for name, (spoil, _) in BAD.items()}})


@pytest.mark.parametrize("name", GOOD)
def test_no_errors_and_no_warnings(said: dict[str, Said], name: str) -> None:
    assert said[name] == []


@pytest.mark.parametrize("name", BAD)
def test_the_check_can_fail(said: dict[str, Said], name: str) -> None:
    assert BAD[name][1] in {(level, rule) for level, rule, _ in said[name]}


def test_the_notes_that_remain() -> None:
    """Ids stay the tools' own, messages are whole sentences, and rules without a page have no address."""
    (notes,) = validate_all({"plain": GOOD["plain-archive"]}, notes=True).values()
    assert {rule for _, rule, _ in notes} == {"SARIF2002", "SARIF2009", "SARIF2012", "SARIF2013"}
