# SPDX-License-Identifier: Apache-2.0
"""The codes of cmakelang's cmake-lint as rules; their first letter is the kind that cmake-lint gives them."""

from __future__ import annotations

from haros_ci.linters.catalogue.table import Group, Rule, Table

TABLE = Table(
    "cmake-lint",
    "`# cmake-lint: disable=CODE` before the line, or at the head of the file for all of it",
    lambda rule: "https://cmake-format.readthedocs.io/en/latest/lint-implemented.html",
    (
        Group(
            "CMake stops here, or does something else than it looks like.",
            ("correctness",),
            (
                ("E0103", "Be", "break() and continue() stand in a loop."),
                ("E0108", "Re", "The arguments of a function have different names."),
                ("E0109", "Re", "The name of an argument is one that CMake can read."),
                ("W0101", "Rw", "Code after return(), break() or continue() can be reached."),
                ("W0105", "Rw", "No variable differs from one of CMake's own by its case alone."),
                ("W0106", "Rw", "A reference to a variable has its dollar, its braces and its end."),
            ),
        ),
        Group(
            "cmake-lint knows the arguments of CMake's own commands; those of others it is told in its configuration.",
            ("correctness",),
            (
                ("E1120", "-w", "A command gets the arguments that it needs."),
                ("E1121", "-w", "A command gets no more arguments than it takes."),
                ("E1122", "Sw", "A keyword stands once in a command."),
                ("E1125", "-w", "A command gets the keywords that it needs."),
                ("E1126", "-w", "The first argument, which chooses the form of a command, is one that it has."),
            ),
            precision="medium",
        ),
        Group(
            "",
            ("maintainability",),
            (
                ("W0104", "Sw", "No command is used that CMake calls deprecated."),
                ("E0011", "Sw", "An option in a comment is one that cmake-lint has."),
                ("E0012", "Sw", "An option in a comment has a value that cmake-lint knows."),
                ("C0201", "Sn", "Arguments are parsed with cmake_parse_arguments()."),
                ("C0202", "Sn", "Names of arguments differ by more than their case."),
                ("R0911", "-n", "A function has few return statements."),
                ("R0912", "-n", "A function has few branches."),
                ("R0913", "-n", "A function has few named arguments."),
                ("R0914", "-n", "A function has few local variables."),
                ("R0915", "-n", "A function has few statements."),
            ),
        ),
        Group(
            "",
            ("readability",),
            (
                ("C0102", "-n", "No name is on the list of names to avoid."),
                ("C0103", "-n", "Names have the form that the configuration asks for."),
                ("C0111", "-n", "A function has a comment that describes it."),
                ("C0112", "Sn", "The comment on a function says something."),
                ("C0113", "-n", "A statement that can have a comment has one."),
                ("C0114", "Sn", "The argument that chooses the form of a command is written out."),
            ),
        ),
        Group(
            "",
            ("formatting",),
            (
                ("C0301", "Sn", "Lines are no longer than allowed."),
                ("C0303", "Sn", "No line ends with spaces."),
                ("C0304", "Sn", "The last line ends with a newline."),
                ("C0305", "Sn", "One or two line feeds stand between statements."),
                ("C0306", "Sn", "Indentation is made of what the configuration asks for."),
                ("C0307", "Sn", "Indentation is that of the block."),
                ("C0321", "Sn", "A line has one statement."),
                ("C0327", "Sn", "Lines end as the configuration asks."),
            ),
        ),
    ),
)
_OTHER = Group("", ("readability",), (), precision="medium")


def rules() -> dict[str, Rule]:
    """The rules by id."""
    return TABLE.rules()


def invented(identifier: str) -> Rule:
    """A code that a newer cmake-lint has."""
    return TABLE.rule(identifier, "-n", f"The rule {identifier} of cmake-lint is kept.", _OTHER)
