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
                ("E0103", "Be", "break() or continue() outside a loop."),
                ("E0108", "Re", "Duplicate argument name of a function."),
                ("E0109", "Re", "Invalid argument name."),
                ("W0101", "Rw", "Unreachable code after return(), break() or continue()."),
                ("W0105", "Rw", "Variable that differs from a CMake variable by case only."),
                ("W0106", "Rw", "Malformed variable reference."),
            ),
        ),
        Group(
            "cmake-lint knows the arguments of CMake's own commands; those of others it is told in its configuration.",
            ("correctness",),
            (
                ("E1120", "-w", "Missing arguments of a command."),
                ("E1121", "-w", "Too many arguments of a command."),
                ("E1122", "Sw", "Duplicate keyword of a command."),
                ("E1125", "-w", "Missing keyword of a command."),
                ("E1126", "-w", "Invalid first argument that selects the form of a command."),
            ),
            precision="medium",
        ),
        Group(
            "",
            ("maintainability",),
            (
                ("W0104", "Sw", "Deprecated CMake command."),
                ("E0011", "Sw", "Unknown cmake-lint option in a comment."),
                ("E0012", "Sw", "Invalid value of a cmake-lint option in a comment."),
                ("C0201", "Sn", "Arguments parsed without cmake_parse_arguments()."),
                ("C0202", "Sn", "Argument names that differ by case only."),
                ("R0911", "-n", "Function with many return statements."),
                ("R0912", "-n", "Function with many branches."),
                ("R0913", "-n", "Function with many named arguments."),
                ("R0914", "-n", "Function with many local variables."),
                ("R0915", "-n", "Function with many statements."),
            ),
        ),
        Group(
            "",
            ("readability",),
            (
                ("C0102", "-n", "Name from the list of forbidden names."),
                ("C0103", "-n", "Name that does not match the configured pattern."),
                ("C0111", "-n", "Function without a comment."),
                ("C0112", "Sn", "Empty comment of a function."),
                ("C0113", "-n", "Statement without a comment."),
                ("C0114", "Sn", "Computed argument that selects the form of a command."),
            ),
        ),
        Group(
            "",
            ("formatting",),
            (
                ("C0301", "Sn", "Line too long."),
                ("C0303", "Sn", "Trailing spaces."),
                ("C0304", "Sn", "Missing newline at the end of the file."),
                ("C0305", "Sn", "Wrong number of line feeds between statements."),
                ("C0306", "Sn", "Wrong indentation character."),
                ("C0307", "Sn", "Wrong indentation of a block."),
                ("C0321", "Sn", "Several statements on one line."),
                ("C0327", "Sn", "Wrong line ending."),
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
    return TABLE.rule(identifier, "-n", f"Finding of cmake-lint's rule {identifier}.", _OTHER)
