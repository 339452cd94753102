# SPDX-License-Identifier: Apache-2.0
"""The metric thresholds as rules; their tags name the standards that the numbers come from."""

from __future__ import annotations

from haros_ci.linters.catalogue import haros
from haros_ci.linters.catalogue.group import Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

_BRANCHES = (
    "Every branch, loop, `case`, `catch`, `?:`, `&&` and `||` adds a path that a test has to take. Callbacks of"
    " robots grow this way; split the function by task, or turn the branches into a table."
)
_LENGTH = "Long functions hide more than one task. Move each task into a function with a name of its own."
_COMMENTS = (
    "The part of the non-blank lines that hold a comment (in Python docstrings too, licence headers included). Say"
    " what the code cannot: units, frames, assumptions, why."
)
_HALSTEAD = (
    "Halstead's volume is N · log2 n, with N operators and operands in all, n of them distinct; bugs are estimated as"
    " V / 3000. Split the file along its classes or tasks."
)
_INDEX = (
    "171 − 5.2 ln V − 0.23 ΣCC − 16.2 ln lines + 50 sin √(2.46 · comments), scaled to 0–100 per file. Long files"
    " with many branches score low; split them."
)

#: (id, profile letter, tags, summary, advice)
ROWS: tuple[tuple[str, str, str, str, str], ...] = (
    (
        "max-cyclomatic-complexity-10",
        "S",
        "nasa-satc his cyclomatic-complexity",
        "The cyclomatic complexity of a function is at most 10.",
        _BRANCHES,
    ),
    (
        "max-cyclomatic-complexity-15",
        "R",
        "kth ros cyclomatic-complexity",
        "The cyclomatic complexity of a function is at most 15.",
        _BRANCHES,
    ),
    (
        "max-function-length-40",
        "S",
        "code-standards google-cpp verifysoft functions lines-of-code loc",
        "A function has at most 40 lines of code.",
        _LENGTH,
    ),
    (
        "max-eloc-50",
        "S",
        "nasa-satc his eloc lines-of-code loc",
        "A function has at most 50 lines of code that are more than braces.",
        _LENGTH,
    ),
    (
        "max-eloc-70",
        "S",
        "kth ros eloc lines-of-code loc",
        "A function has at most 70 lines of code that are more than braces.",
        _LENGTH,
    ),
    (
        "max-function-parameters-6",
        "S",
        "code-standards hicpp functions parameters",
        "A function has at most 6 parameters.",
        "Arguments in a row are easily swapped. Group those that belong together into a struct or a message.",
    ),
    (
        "max-file-length-400",
        "S",
        "verifysoft lines-of-code loc",
        "A file has at most 400 lines of code.",
        "A file that long holds more than one thing. Give each class or task a file of its own.",
    ),
    (
        "min-comment-ratio-20",
        "-",
        "nasa-satc his unak ros comments comment-ratio",
        "At least 20 percent of a file's lines hold a comment.",
        _COMMENTS,
    ),
    (
        "max-comment-ratio-30",
        "-",
        "nasa-satc comments comment-ratio",
        "At most 30 percent of a file's lines hold a comment.",
        _COMMENTS,
    ),
    (
        "max-comment-ratio-40",
        "-",
        "unak comments comment-ratio",
        "At most 40 percent of a file's lines hold a comment.",
        _COMMENTS,
    ),
    (
        "halstead-volume-above-8000",
        "S",
        "verifysoft halstead halstead-volume",
        "The Halstead volume of a file is at most 8000.",
        _HALSTEAD,
    ),
    (
        "halstead-bugs-above-2",
        "-",
        "verifysoft halstead halstead-bugs bugs",
        "The number of bugs in a file, as Halstead estimates it, is at most 2.",
        _HALSTEAD,
    ),
    (
        "mi-below-20",
        "R",
        "microsoft maintainability mi maintainability-index",
        "The maintainability index of a file is at least 20.",
        _INDEX,
    ),
    (
        "mi-below-65",
        "-",
        "verifysoft maintainability mi maintainability-index",
        "The maintainability index of a file is at least 65.",
        _INDEX + " On this scale nearly every file longer than a page is below 65.",
    ),
)


def rules() -> dict[str, Rule]:
    """Every metric rule by id."""
    return {
        identifier: Rule(
            id=identifier,
            summary=summary,
            level=level_of(letters, Level.NOTE),
            help=help_text(identifier, summary, advice, "a comment on the line of the signature"),
            help_uri="https://github.com/git-afsantos/haros/blob/master/haros/definitions.yaml",
            precision="very-high",
            profiles=profiles(letters),
            tags=tags_of("metrics", *tags.split()),
            aliases=haros.aliases("metrics", identifier),
        )
        for identifier, letters, tags, summary, advice in ROWS
    }


def invented(identifier: str) -> Rule | None:
    """No other metric exists."""
    return None
