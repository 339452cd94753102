# SPDX-License-Identifier: Apache-2.0
"""What is known of the rules of each tool, as tables; each tool's table is read when first asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from importlib import import_module
from types import MappingProxyType, ModuleType
from typing import Final

from haros_ci.linters.catalogue.group import help_text
from haros_ci.linters.catalogue.haros import UNSERVED
from haros_ci.linters.catalogue.same_defect import SAME_DEFECT
from haros_ci.linters.catalogue.standards import tagged
from haros_ci.results.rule import Rule

#: The tools with a table, by the name that results carry, and its module.
_MODULES: Final = MappingProxyType(
    {
        "bandit": "bandit",
        "black": "black",
        "catkin_lint": "catkin_lint",
        "clang-format": "clang_format",
        "clang-tidy": "clang_tidy",
        "cmake-lint": "cmake_lint",
        "cmakelint": "cmakelint",
        "codespell": "codespell",
        "cppcheck": "cppcheck",
        "cpplint": "cpplint",
        "flake8": "flake8",
        "flawfinder": "flawfinder",
        "hadolint": "hadolint",
        "isort": "isort",
        "metrics": "metrics",
        "mypy": "mypy",
        "pylint": "pylint",
        "ruff": "ruff",
        "shellcheck": "shellcheck",
        "vulture": "vulture",
        "xmllint": "xmllint",
        "yamllint": "yamllint",
    }
)
TOOLS = tuple(_MODULES)

#: Tools that say how bad each finding is; of the others the table tells, which knows the rule alone.
WEIGHING: Final = frozenset({"catkin_lint", "cppcheck", "pylint"})


@cache
def rules_of(tool: str) -> Mapping[str, Rule]:
    """The rules of *tool* (the name that its results carry) by id; empty for a tool without a table."""
    rules = _table(tool).rules() if tool in _MODULES else {}
    return MappingProxyType({id: tagged(tool, rule) for id, rule in rules.items()})


@cache
def rule(tool: str, identifier: str) -> Rule:
    """The rule *identifier* of *tool*; one is invented where no table has it, so that nothing found is ever lost.

    catkin_lint writes its ids in either case; the rule keeps the case that was asked for, as results refer to it.
    """
    known = rules_of(tool)
    found = known.get(identifier) or (known.get(identifier.lower()) if tool == "catkin_lint" else None)
    if found is not None:
        return found if found.id == identifier else replace(found, id=identifier)
    made = _table(tool).invented(identifier) if tool in _MODULES else None
    return tagged(tool, made) if made else _unknown(tool, identifier)


def _table(tool: str) -> ModuleType:
    return import_module(f"{__name__}.{_MODULES[tool]}")


def _unknown(tool: str, identifier: str) -> Rule:
    summary = f"Finding of {tool}'s rule {identifier}."
    return Rule(
        id=identifier,
        summary=summary[:1024],
        help=help_text(identifier, summary, "", "the tool's own comment"),
        precision="medium",
        tags=("code-standards",),
    )


__all__ = ["SAME_DEFECT", "TOOLS", "UNSERVED", "rule", "rules_of"]
