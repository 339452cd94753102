# SPDX-License-Identifier: Apache-2.0
"""The codes of flake8's own plug-ins (pyflakes, pycodestyle, mccabe), and those of others by their letters."""

from __future__ import annotations

from haros_ci.linters.catalogue.flake8_layout import SUMMARIES
from haros_ci.linters.catalogue.group import Group, Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

PYFLAKES = "https://flake8.pycqa.org/en/latest/user/error-codes.html"
PYCODESTYLE = "https://pycodestyle.pycqa.org/en/latest/intro.html#error-codes"
SUPPRESS = "`# noqa: CODE` on the line"

GROUPS: tuple[Group, ...] = (
    Group(
        "Python cannot read the file, so nothing in it runs.",
        ("correctness", "syntax"),
        (
            ("E901", "B", "Python file that cannot be tokenized."),
            ("E902", "B", "File that cannot be read."),
            ("E999", "B", "Python syntax error."),
            ("F701", "B", "break outside a loop."),
            ("F702", "B", "continue outside a loop."),
            ("F704", "B", "yield outside a function."),
            ("F706", "B", "return outside a function."),
            ("F707", "B", "except clause for all exceptions before another one."),
            ("F708", "B", "Lazy import outside the top level of a module."),
            ("F709", "B", "Lazy import of everything (*)."),
            ("F831", "B", "Duplicate parameter name."),
        ),
        level=Level.ERROR,
    ),
    Group(
        "The name does not exist when this line runs, which is a NameError: import or define it, or correct the spelling.",
        ("correctness", "names"),
        (
            ("F821", "B", "Undefined name."),
            ("F822", "B", "Undefined name in __all__."),
            ("F823", "B", "Local variable used before its assignment."),
        ),
        level=Level.ERROR,
    ),
    Group(
        "Import what is used, once, by its name: remove or list it.",
        ("correctness", "imports"),
        (
            ("F401", "R", "Unused import."),
            ("F402", "R", "Loop variable that hides an import."),
            ("F403", "S", "Import of everything (*)."),
            ("F404", "B", "__future__ import after another statement."),
            ("F405", "-", "Name that may come from an import of everything (*)."),
            ("F406", "B", "Import of everything (*) outside the top level of a module."),
            ("F407", "B", "Unknown __future__ feature."),
            ("F811", "R", "Redefinition of an unused name."),
            ("F851", "S", "Lazy import used at the top level."),
        ),
    ),
    Group(
        "The text and its arguments do not fit each other: at run time that is an exception or a wrong text.",
        ("correctness", "format"),
        (
            ("F501", "B", "Invalid % format."),
            ("F502", "B", "% format with names, but without a mapping."),
            ("F503", "B", "% format without names, but with a mapping."),
            ("F504", "R", "% format with unused named arguments."),
            ("F505", "B", "% format with missing named arguments."),
            ("F506", "B", "% format that mixes named and positional arguments."),
            ("F507", "B", "% format with the wrong number of arguments."),
            ("F508", "B", "* in a % format without a tuple."),
            ("F509", "B", "Unknown conversion in a % format."),
            ("F521", "B", "Invalid format string."),
            ("F522", "R", "Format call with unused named arguments."),
            ("F523", "R", "Format call with unused positional arguments."),
            ("F524", "B", "Format call with missing arguments."),
            ("F525", "B", "Format string that mixes numbered and unnumbered fields."),
            ("F541", "S", "f-string without fields."),
            ("F542", "S", "Template string without fields."),
        ),
    ),
    Group(
        "It means something else than it looks like, or nothing.",
        ("correctness",),
        (
            ("F601", "B", "Duplicate key in a dict literal."),
            ("F602", "S", "Duplicate variable as a key of a dict literal."),
            ("F621", "B", "Unpacking with too many targets."),
            ("F622", "B", "Unpacking with two starred targets."),
            ("F631", "B", "assert on a tuple, which is always true."),
            ("F632", "R", "Literal compared with is."),
            ("F633", "B", "print as a statement with >>."),
            ("F634", "B", "Tuple as a condition, which is always true."),
            ("F721", "S", "Syntax error in a doctest."),
            ("F722", "R", "Syntax error in a quoted annotation."),
            ("F824", "S", "global or nonlocal name that is never assigned."),
            ("F841", "R", "Unused variable."),
            ("F842", "S", "Unused annotated variable."),
            ("F901", "B", "NotImplemented raised instead of NotImplementedError."),
            ("E711", "S", "Comparison with None by == or !=."),
            ("E712", "S", "Comparison with True or False by == or !=."),
            ("E713", "S", "not x in y instead of x not in y."),
            ("E714", "S", "not x is y instead of x is not y."),
            ("E721", "S", "Types compared with ==."),
            ("E722", "S", "Bare except."),
            ("E731", "-", "lambda assigned to a name."),
            ("E741", "-", "Ambiguous variable name l, O or I."),
            ("E742", "-", "Ambiguous class name l, O or I."),
            ("E743", "-", "Ambiguous function name l, O or I."),
            ("W605", "R", "Invalid escape sequence."),
            ("C901", "S", "Function more complex than max-complexity."),
        ),
    ),
)

#: (letters of a plug-in's codes, what they are about); the first that fits holds.
PREFIXES: tuple[tuple[str, str], ...] = (
    ("CNL", "line breaks after commas"),
    ("ANN", "annotations"),
    ("SIM", "simpler code"),
    ("E", "layout"),
    ("W", "layout"),
    ("F", "mistakes that pyflakes finds"),
    ("B", "likely bugs, as flake8-bugbear sees them"),
    ("C4", "comprehensions"),
    ("C8", "commas"),
    ("D", "docstrings"),
    ("I", "the order of imports"),
    ("N", "names"),
    ("Q", "quotes"),
    ("S", "security"),
    ("A", "names of builtins"),
    ("T", "left-over prints and debuggers"),
)


def rules() -> dict[str, Rule]:
    """The codes of the tables, by code."""
    found = {code: _rule(code, letters, summary, group) for group in GROUPS for code, letters, summary in group.rows}
    return {**found, **{code: _rule(code, "-", summary, _LAYOUT) for code, summary in SUMMARIES.items()}}


def invented(code: str) -> Rule:
    """A rule for any other code, of a newer version or a plug-in."""
    subject = next((subject for prefix, subject in PREFIXES if code.startswith(prefix)), "")
    return _rule(code, "-", _generic(code, subject), _OTHER)


_LAYOUT = Group("Only the layout is concerned; a formatter settles it.", ("layout",), ())
_OTHER = Group("The plug-in that has this code explains it.", (), (), precision="medium")


def _generic(code: str, subject: str) -> str:
    return f"Finding of flake8's code {code} ({subject})." if subject else f"Finding of flake8's code {code}."


def _rule(code: str, letters: str, summary: str, group: Group) -> Rule:
    return Rule(
        id=code,
        summary=summary,
        level=group.level or level_of(letters, Level.NOTE),
        help=help_text(code, summary, group.advice, SUPPRESS),
        help_uri=PYCODESTYLE if code[0] in "EW" else PYFLAKES,
        precision=group.precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "flake8", *group.tags),
    )
