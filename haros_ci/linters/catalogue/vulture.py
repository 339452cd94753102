# SPDX-License-Identifier: Apache-2.0
"""What vulture calls unused, and how sure it is of each."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

DOCUMENTATION = "https://github.com/jendrikseipp/vulture#types-of-unused-code"

#: (rule, profile letter, vulture's code for noqa comments, summary)
ROWS: tuple[tuple[str, str, str, str], ...] = (
    ("unreachable-code", "R", "V201", "Every statement can be reached, and every condition can be true and false."),
    ("unused-attribute", "-", "V101", "An attribute is read somewhere in the package."),
    ("unused-class", "-", "V102", "A class is used somewhere in the package."),
    ("unused-function", "-", "V103", "A function is used somewhere in the package."),
    ("unused-import", "R", "V104", "An imported name is used."),
    ("unused-method", "-", "V105", "A method is used somewhere in the package."),
    ("unused-property", "-", "V106", "A property is used somewhere in the package."),
    ("unused-variable", "S", "V107", "A variable or parameter is used."),
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
    return _rule(name, "-", "", f"Vulture's '{name}' finds nothing.")


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
