# SPDX-License-Identifier: Apache-2.0
"""docs/queries.md: its examples are evaluated, and it names every attribute that there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from query_worlds import scene

from haros_ci.query.engine import Query
from haros_ci.query.functions import BUILTINS, METHODS
from haros_ci.query.links import LINKS
from haros_ci.query.places import QueryLocation, QueryQos, RosName, SourceCondition
from haros_ci.query.queries import VARIABLES
from haros_ci.query.resources import NodeInstance, QueryAction, QueryParameter, Service, Topic
from haros_ci.query.source import SourceNode
from haros_ci.query.system import Collection, QuerySystem

PAGE = (Path(__file__).parents[2] / "docs" / "queries.md").read_text(encoding="utf-8")
EXAMPLES = [
    "\n".join(line.strip() for line in block.splitlines())
    for block in PAGE.partition("## Examples")[2].split("\n\n")
    if block.strip()
]


@pytest.mark.parametrize("text", EXAMPLES)
@pytest.mark.parametrize("name", ["walk", "talk"])
def test_every_example_is_answered(text: str, name: str) -> None:
    scope = "global" if "(scope global)" in text else "configuration"
    query = Query(text, VARIABLES[scope])
    query.matches(scene(scope, name))
    assert query.notes() == ()


def test_there_are_examples() -> None:
    assert len(EXAMPLES) >= 6


@pytest.mark.parametrize(
    "kind",
    [
        QuerySystem,
        Collection,
        NodeInstance,
        Topic,
        Service,
        QueryAction,
        QueryParameter,
        RosName,
        SourceCondition,
        QueryLocation,
        QueryQos,
    ]
    + [link for link, _, _ in LINKS.values()],
    ids=lambda kind: kind.__name__,
)
def test_every_attribute_is_named(kind: type) -> None:
    words = set(re.findall(r"\w+", PAGE))
    assert {*kind.ATTRIBUTES, *kind.METHODS} - words == set()  # type: ignore[attr-defined]


def test_every_function_method_and_variable_is_named() -> None:
    words = set(re.findall(r"\w+", PAGE))
    names = {*BUILTINS, *(name for methods in METHODS.values() for name in methods), *SourceNode.METHODS}
    assert names | {name for scope in VARIABLES.values() for name in scope} <= words
