# SPDX-License-Identifier: Apache-2.0
"""The categories of cmakelint as rules."""

from __future__ import annotations

from haros_ci.linters.catalogue.table import Group, Rule, Table

TABLE = Table(
    "cmakelint",
    "`# lint_cmake: -CODE` in the file, which holds for all of it",
    lambda rule: "https://github.com/cmake-lint/cmake-lint",
    (
        Group(
            "cmakelint could not find where a command ends: a parenthesis or a quote is missing.",
            ("correctness",),
            (("syntax", "Rw", "Unclosed command."),),
            precision="medium",
        ),
        Group(
            "CMake finds a Find module by its file's name, and find_package_handle_standard_args() sets the variables that"
            " the callers of find_package() look at by the name that it is given.",
            ("correctness",),
            (
                (
                    "convention/filename",
                    "Sw",
                    "Wrong file name of a Find module or CMakeLists.txt.",
                ),
                ("package/consistency", "Sw", "Find module without find_package_handle_standard_args()."),
                ("package/stdargs", "Sw", "Wrong name in find_package_handle_standard_args()."),
            ),
        ),
        Group(
            "",
            ("readability",),
            (
                ("readability/logic", "Sn", "Repeated condition in endif() or another closing command."),
                ("readability/mixedcase", "Sn", "Mixed upper-case and lower-case commands in one file."),
                ("readability/wonkycase", "Sn", "Command with upper-case and lower-case letters."),
            ),
        ),
        Group(
            "",
            ("formatting",),
            (
                (
                    "linelength",
                    "Sn",
                    "Line longer than the limit (140 characters unless .cmakelintrc sets another).",
                ),
                ("whitespace/eol", "Sn", "Trailing spaces."),
                ("whitespace/extra", "Sn", "Space between a command and its parenthesis."),
                (
                    "whitespace/indent",
                    "Sn",
                    "Indentation that is not a multiple of two spaces (or of the value in .cmakelintrc).",
                ),
                (
                    "whitespace/mismatch",
                    "Sn",
                    "Unequal spaces inside parentheses.",
                ),
                ("whitespace/newline", "Sn", "Line ending other than LF."),
                ("whitespace/tabs", "Sn", "Indentation with tabs."),
            ),
        ),
    ),
)
_OTHER = Group("", ("formatting",), (), precision="medium")


def rules() -> dict[str, Rule]:
    """The rules by id."""
    return TABLE.rules()


def invented(identifier: str) -> Rule:
    """A category that a newer cmakelint has."""
    return TABLE.rule(identifier, "-n", f"Finding of cmakelint's category {identifier}.", _OTHER)
