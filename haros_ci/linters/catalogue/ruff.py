# SPDX-License-Identifier: Apache-2.0
"""The rules of ruff that a profile enables, and the rest by the prefix of their code."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

DOCUMENTATION = "https://docs.astral.sh/ruff/rules/"
SUPPRESS = "`# noqa: CODE` on the line"

#: (code, profile letter, summary)
ROWS: tuple[tuple[str, str, str], ...] = (
    ("B002", "B", "Nonexistent operator ++."),
    ("B003", "R", "Replaced os.environ."),
    ("B005", "R", "Duplicate character in a strip argument."),
    ("B006", "S", "Mutable default argument, shared by all calls."),
    ("B008", "S", "Function call in a default argument."),
    ("B012", "R", "return, break or continue in a finally block."),
    ("B015", "R", "Unused result of a comparison."),
    ("B016", "B", "Raised object that is not an exception."),
    ("B017", "S", "Test that expects any Exception."),
    ("B018", "S", "Expression whose value is not used."),
    ("B020", "S", "Loop variable that overwrites its iterable."),
    ("B021", "R", "f-string as a docstring."),
    ("B023", "S", "Loop variable captured by a function created in the loop."),
    ("B025", "B", "Exception caught twice."),
    ("B029", "R", "except clause with an empty tuple."),
    ("B030", "B", "Caught object that is not an exception."),
    ("B031", "R", "groupby group used more than once."),
    ("B032", "R", "Annotation instead of an assignment."),
    ("B033", "R", "Duplicate value in a set literal."),
    ("B035", "B", "Constant key in a dict comprehension."),
    ("B904", "S", "Exception raised in an except clause without from."),
    ("F401", "S", "Unused import."),
    ("F402", "S", "Loop variable that hides an import."),
    ("F403", "S", "Import of everything (*)."),
    ("F404", "B", "__future__ import after another statement."),
    ("F407", "B", "Unknown __future__ feature."),
    ("F541", "S", "f-string without fields."),
    ("F601", "B", "Duplicate key in a dict literal."),
    ("F602", "S", "Duplicate key in a dict literal."),
    ("F621", "B", "Unpacking with too many targets."),
    ("F622", "B", "Unpacking with two starred targets."),
    ("F631", "B", "assert on a tuple, which is always true."),
    ("F632", "R", "Literal compared with is."),
    ("F633", "B", "print as a statement with >>."),
    ("F634", "B", "Tuple as a condition, which is always true."),
    ("F811", "S", "Redefinition of an unused name."),
    ("F821", "S", "Undefined name."),
    ("F822", "B", "Undefined name in __all__."),
    ("F823", "B", "Local variable used before its assignment."),
    ("F841", "S", "Unused variable."),
    ("F901", "B", "NotImplemented raised instead of NotImplementedError."),
)

#: (prefix of codes, profile letter, what they are about); the first that fits holds.
PREFIXES: tuple[tuple[str, str, str], ...] = (
    ("E9", "B", "files that Python cannot read"),
    ("F50", "R", "format strings that do not match their arguments"),
    ("F52", "R", "format strings that do not match their arguments"),
    ("F70", "B", "statements that stand where Python does not allow them"),
    ("F72", "R", "annotations that cannot be read"),
    ("F", "-", "mistakes that pyflakes finds"),
    ("B", "-", "likely bugs, as flake8-bugbear sees them"),
    ("S", "-", "security"),
    ("D", "-", "docstrings"),
    ("N", "-", "names"),
    ("I", "-", "the order of imports"),
    ("E", "-", "layout"),
    ("W", "-", "layout"),
)


def rules() -> dict[str, Rule]:
    """The rules with a row of their own by code."""
    return {code: _rule(code, letters, summary, "high") for code, letters, summary in ROWS}


def invented(code: str) -> Rule:
    """A rule for any other code, by its prefix."""
    for prefix, letters, subject in PREFIXES:
        if code.startswith(prefix):
            return _rule(
                code, letters, f"Finding of ruff's rule {code} ({subject}).", "high" if letters != "-" else "medium"
            )
    return _rule(code, "-", f"Finding of ruff's rule {code}.", "medium")


def _rule(code: str, letters: str, summary: str, precision: str) -> Rule:
    fatal = code.startswith(("E9", "F70", "F821", "F823"))  # F72 is of annotations, F822 of wildcard imports
    return Rule(
        id=code,
        summary=summary,
        level=Level.ERROR if fatal else level_of(letters, Level.NOTE),
        help=help_text(code, summary, f"`ruff rule {code}` explains it at length.", SUPPRESS),
        help_uri=DOCUMENTATION,
        precision=precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "ruff"),
    )
