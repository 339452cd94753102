# SPDX-License-Identifier: Apache-2.0
"""The codes of flake8's own plug-ins (pyflakes, pycodestyle, mccabe), and those of others by their letters."""

from __future__ import annotations

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
            ("E901", "B", "A file can be split into tokens."),
            ("E902", "B", "A file can be read."),
            ("E999", "B", "A file is Python that this interpreter can read."),
            ("F701", "B", "break stands inside a loop."),
            ("F702", "B", "continue stands inside a loop."),
            ("F704", "B", "yield stands inside a function."),
            ("F706", "B", "return stands inside a function."),
            ("F707", "B", "An except clause for everything is the last one."),
            ("F708", "B", "A lazy import stands at the top of a module."),
            ("F709", "B", "A lazy import names what it imports."),
            ("F831", "B", "The parameters of a function have different names."),
        ),
        level=Level.ERROR,
    ),
    Group(
        "The name does not exist when this line runs, which is a NameError: import or define it, or correct the spelling.",
        ("correctness", "names"),
        (
            ("F821", "B", "A name is defined or imported before it is used."),
            ("F822", "B", "__all__ names what the module defines."),
            ("F823", "B", "A local variable is assigned before it is used."),
        ),
        level=Level.ERROR,
    ),
    Group(
        "Import what is used, once, by its name: remove or list it.",
        ("correctness", "imports"),
        (
            ("F401", "R", "An imported name is used."),
            ("F402", "R", "A loop variable does not hide an import."),
            ("F403", "S", "Imported names are listed."),
            ("F404", "B", "A __future__ import is the first statement."),
            ("F405", "-", "A name does not come from an import of everything."),
            ("F406", "B", "An import of everything stands at the top of a module."),
            ("F407", "B", "A __future__ import names a feature that exists."),
            ("F811", "R", "A definition is used before it is replaced."),
            ("F851", "S", "A lazy import is used later than where it stands."),
        ),
    ),
    Group(
        "The text and its arguments do not fit each other: at run time that is an exception or a wrong text.",
        ("correctness", "format"),
        (
            ("F501", "B", "A % format can be read."),
            ("F502", "B", "A % format with names gets a mapping."),
            ("F503", "B", "A % format without names gets a tuple."),
            ("F504", "R", "A % format uses all its named arguments."),
            ("F505", "B", "A % format has an argument for every name."),
            ("F506", "B", "A % format has names everywhere or nowhere."),
            ("F507", "B", "A % format has as many arguments as places."),
            ("F508", "B", "A * in a % format gets a tuple."),
            ("F509", "B", "A % format has conversions that exist."),
            ("F521", "B", "A format string can be read."),
            ("F522", "R", "A format call uses all its named arguments."),
            ("F523", "R", "A format call uses all its arguments."),
            ("F524", "B", "A format call has an argument for every field."),
            ("F525", "B", "Fields are numbered everywhere or nowhere."),
            ("F541", "S", "An f-string has fields."),
            ("F542", "S", "A template string has fields."),
        ),
    ),
    Group(
        "It means something else than it looks like, or nothing.",
        ("correctness",),
        (
            ("F601", "B", "A dict literal has each key once."),
            ("F602", "S", "A dict literal has each variable as a key once."),
            ("F621", "B", "An unpacking has no more targets than Python allows."),
            ("F622", "B", "An unpacking has one starred target."),
            ("F631", "B", "An assert tests its condition rather than a tuple."),
            ("F632", "R", "Literals are compared with == rather than is."),
            ("F633", "B", "print is a function."),
            ("F634", "B", "A condition is not a tuple."),
            ("F721", "S", "A doctest is Python."),
            ("F722", "R", "An annotation in quotes can be read."),
            ("F824", "S", "A name that is declared global or nonlocal is assigned."),
            ("F841", "R", "A variable is used."),
            ("F842", "S", "An annotated variable is used."),
            ("F901", "B", "NotImplementedError is raised rather than NotImplemented."),
            ("E711", "S", "None is compared with is."),
            ("E712", "S", "True and False are compared with is, or not at all."),
            ("E713", "S", "Absence is tested with not in."),
            ("E714", "S", "Difference is tested with is not."),
            ("E721", "S", "Types are compared with is, or with isinstance."),
            ("E722", "S", "An except clause names the exceptions."),
            ("E731", "-", "A function is defined with def rather than assigned."),
            ("E741", "-", "A variable is not called l, O or I."),
            ("E742", "-", "A class is not called l, O or I."),
            ("E743", "-", "A function is not called l, O or I."),
            ("W605", "R", "A backslash in a text begins an escape that exists."),
            ("C901", "S", "A function is not more complex than max-complexity."),
        ),
    ),
)

#: Layout: (the first digits of codes, codes, what they are about); in no profile but ``all``.
LAYOUT: tuple[tuple[str, str], ...] = (
    ("E101 E111 E112 E113 E114 E115 E116 E121 E122 E123 E124 E125 E126 E127 E128 E129 E131 E133", "indentation"),
    ("E201 E202 E203 E204 E211 E221 E222 E223 E224 E225 E226 E227 E228 E231 E241 E242 E251 E252", "spaces in a line"),
    ("E261 E262 E265 E266 E271 E272 E273 E274 E275", "spaces around comments and keywords"),
    ("E301 E302 E303 E304 E305 E306 W391", "blank lines"),
    ("E401 E402", "the place of imports"),
    ("E501 E502 W505", "the length of lines"),
    ("E701 E702 E703 E704", "one statement on a line"),
    ("W191", "tabs"),
    ("W291 W292 W293", "spaces and newlines at the end"),
    ("W503 W504", "where an expression is broken"),
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
    for codes, subject in LAYOUT:
        found.update((code, _rule(code, "-", _generic(code, subject), _LAYOUT)) for code in codes.split())
    return found


def invented(code: str) -> Rule:
    """A rule for any other code, of a newer version or a plug-in."""
    subject = next((subject for prefix, subject in PREFIXES if code.startswith(prefix)), "")
    return _rule(code, "-", _generic(code, subject), _OTHER)


_LAYOUT = Group("Only the layout is concerned; a formatter settles it.", ("layout",), ())
_OTHER = Group("The plug-in that has this code explains it.", (), (), precision="medium")


def _generic(code: str, subject: str) -> str:
    return f"The code {code} of flake8 on {subject} is kept." if subject else f"The code {code} of flake8 is kept."


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
