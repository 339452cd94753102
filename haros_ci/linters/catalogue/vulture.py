# SPDX-License-Identifier: Apache-2.0
"""What vulture calls unused, and how sure it is of each."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

DOCUMENTATION = "https://github.com/jendrikseipp/vulture#types-of-unused-code"

#: (rule, profile letter, vulture's code for noqa comments, summary)
ROWS: tuple[tuple[str, str, str, str], ...] = (
    ("unreachable-code", "R", "V201", "Unreachable code or constant condition."),
    ("unused-attribute", "-", "V101", "Attribute that the package never reads."),
    ("unused-class", "-", "V102", "Class that the package never uses."),
    ("unused-function", "-", "V103", "Function that the package never uses."),
    ("unused-import", "R", "V104", "Unused import."),
    ("unused-method", "-", "V105", "Method that the package never uses."),
    ("unused-property", "-", "V106", "Property that the package never uses."),
    ("unused-variable", "S", "V107", "Unused variable or parameter."),
)
GUESS = (
    "Vulture matches names over the whole package and cannot see what launch files, other packages or ROS itself call;"
    " it tells of this only where `min_confidence` of `[tool.vulture]` is 60 or less."
)


def rules() -> dict[str, Rule]:
    """The kinds of unused code."""
    return {name: _rule(name, letters, code, summary) for name, letters, code, summary in ROWS}


def invented(name: str) -> Rule:
    """A rule for a kind of a newer version."""
    return _rule(name, "-", "", f"Finding of vulture's check '{name}'.")


def _rule(name: str, letters: str, code: str, summary: str) -> Rule:
    return Rule(
        id=name,
        summary=summary,
        level=level_of(letters, Level.NOTE),
        help=help_text(
            name, summary, GUESS if letters == "-" else "", f"`# noqa: {code}` on the line" if code else "`# noqa`"
        ),
        help_uri=DOCUMENTATION,
        precision="low" if letters == "-" else "high",
        profiles=profiles(letters),
        tags=tags_of("code-standards", "vulture", "unused"),
    )
