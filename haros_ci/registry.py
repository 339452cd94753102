# SPDX-License-Identifier: Apache-2.0
"""The built-in linters, in the order of their runs, and the built-in checks with their rules."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

from haros_ci import PROJECT_URL
from haros_ci.checking.check import Check
from haros_ci.linters import catkin_lint, clang_tidy, cppcheck, cpplint, lizard, pylint, radon, ruff
from haros_ci.linters.linter import Linter
from haros_ci.results.rule import Rule

LINTERS: tuple[Linter, ...] = (cppcheck, cpplint, pylint, lizard, radon, ruff, clang_tidy, catkin_lint)


@cache
def checks() -> tuple[Check, ...]:
    """The built-in checks."""
    from haros_ci_checks import CHECKS

    return CHECKS


def page_of(check: Check) -> str:
    """The text of a check's page; every check has one (tests/test_checks.py)."""
    return files("haros_ci_checks").joinpath(page_name(check)).read_text(encoding="utf-8")


def page_name(check: Check) -> str:
    return check.id.replace("-", "_") + ".md"


@cache
def check_rules() -> dict[str, Rule]:
    """The rules of the built-in checks by id."""
    return {
        check.id: check.rule(page_of(check), f"{PROJECT_URL}/blob/main/checks/{page_name(check)}") for check in checks()
    }
