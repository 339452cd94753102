# SPDX-License-Identifier: Apache-2.0
"""The rules of ruff that a profile enables, and the rest by the prefix of their code."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

DOCUMENTATION = "https://docs.astral.sh/ruff/rules/"
SUPPRESS = "`# noqa: CODE` on the line"

#: (code, profile letter, summary)
ROWS: tuple[tuple[str, str, str], ...] = (
    ("B002", "B", "Python has no ++ operator."),
    ("B003", "R", "os.environ is changed in place rather than replaced."),
    ("B005", "R", "strip gets each character once."),
    ("B006", "R", "A default is not a list or dict, which all calls would share."),
    ("B008", "S", "A default is not computed by a call."),
    ("B012", "R", "A finally block is not left with return, break or continue."),
    ("B015", "R", "The result of a comparison is used."),
    ("B016", "B", "Only exceptions are raised."),
    ("B017", "S", "A test expects an exception more specific than Exception."),
    ("B018", "R", "The value of an expression is used."),
    ("B020", "R", "A loop does not rebind what it iterates over."),
    ("B021", "R", "A docstring is not an f-string."),
    ("B023", "R", "A callback made in a loop does not capture the loop variable, which moves on."),
    ("B025", "B", "An exception is caught once."),
    ("B029", "R", "An except clause catches something."),
    ("B030", "B", "Only exceptions are caught."),
    ("B031", "R", "A group of groupby is used up once."),
    ("B032", "R", "An assignment is not written as an annotation."),
    ("B033", "R", "A set literal has each value once."),
    ("B035", "B", "The keys of a dict comprehension vary."),
    ("B904", "S", "An exception raised in an except clause names its cause."),
    ("F401", "S", "An imported name is used."),
    ("F402", "R", "A loop variable does not hide an import."),
    ("F403", "S", "Imported names are listed."),
    ("F404", "B", "A __future__ import is the first statement."),
    ("F407", "B", "A __future__ import names a feature that exists."),
    ("F541", "S", "An f-string has fields."),
    ("F601", "B", "A dict literal has each key once."),
    ("F602", "S", "A dict literal has each key once."),
    ("F621", "B", "An unpacking has no more targets than Python allows."),
    ("F622", "B", "An unpacking has one starred target."),
    ("F631", "B", "An assert tests its condition rather than a tuple."),
    ("F632", "R", "Literals are compared with == rather than is."),
    ("F633", "B", "print is a function."),
    ("F634", "B", "A condition is not a tuple."),
    ("F811", "R", "A definition is used before it is replaced."),
    ("F821", "B", "A name is defined or imported before it is used."),
    ("F822", "B", "__all__ names what the module defines."),
    ("F823", "B", "A local variable is assigned before it is used."),
    ("F841", "S", "A variable is used."),
    ("F901", "B", "NotImplementedError is raised rather than NotImplemented."),
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
                code, letters, f"Ruff's rule {code} on {subject} is kept.", "high" if letters != "-" else "medium"
            )
    return _rule(code, "-", f"Ruff's rule {code} is kept.", "medium")


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
