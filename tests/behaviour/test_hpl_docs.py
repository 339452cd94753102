# SPDX-License-Identifier: Apache-2.0
"""The examples of docs/hpl.md are properties, and what it says of others is said."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from haros_ci.behaviour.declared import in_project
from haros_ci.behaviour.dialect import FUNCTIONS
from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.kinds import PARAMETERS
from haros_ci.behaviour.meaning import mistakes
from haros_ci.behaviour.parser import parse_file, parse_property
from haros_ci.behaviour.rules import parse_rule
from haros_ci.behaviour.text import canonical
from haros_ci.registry import checks

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "hpl.md").read_text(encoding="utf-8")


def fence(language: str) -> str:
    (found,) = re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    return str(found)


def test_the_examples_are_properties() -> None:
    found = parse_file(fence("hpl"))
    assert len(found) == fence("hpl").strip().count("\n") + 1
    assert not any(map(mistakes, found))


def test_the_project_file_states_properties() -> None:
    found = in_project(fence("yaml"), "haros.yaml", lambda name: (name, "globally: no /a"))
    assert len(found) == 4 and all(each.parsed is not None and not mistakes(each.parsed) for each in found)


@pytest.mark.parametrize(("text", "said"), re.findall(r"^\| `(globally: [^\n]*)` \| ([^\n]*) \|$", PAGE, re.MULTILINE))
def test_what_is_said_of_the_others(text: str, said: str) -> None:
    with pytest.raises(HplFault) as caught:
        parse_property(text.replace("\\|", "|"))
    assert said in caught.value.help


ROWS = re.findall(r"^\| `((?:when|if) [^\n`]*)` \| ([^\n]*) \|$", PAGE, re.MULTILINE)


@pytest.mark.parametrize(("text", "property"), [row for row in ROWS if row[1].startswith("`")])
def test_the_rules_are_these_properties(text: str, property: str) -> None:
    found = parse_rule(text)
    assert f"`{canonical(found)}`" == property and not mistakes(found)


@pytest.mark.parametrize(("text", "said"), [row for row in ROWS if not row[1].startswith("`")])
def test_what_is_said_of_other_rules(text: str, said: str) -> None:
    with pytest.raises(HplFault) as caught:
        parse_rule(text)
    assert said in caught.value.whole


def test_there_are_rules_of_both_kinds() -> None:
    assert [row[1].startswith("`") for row in ROWS] == [True] * 6 + [False] * 10


def test_every_function_and_every_check_is_named() -> None:
    assert set(FUNCTIONS) == set(PARAMETERS)
    assert all(f"`{name}`" in PAGE or f"`{name}(" in PAGE for name in FUNCTIONS)
    named = re.findall(r"^\| \[(hpl-[a-z-]+)\]", PAGE, re.MULTILINE)
    assert sorted(named) == [check.id for check in checks() if check.id.startswith("hpl-")]
