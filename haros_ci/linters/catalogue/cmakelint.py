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
            (("syntax", "Rw", "Each command is closed."),),
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
                    "A Find module is named FindX.cmake, and CMakeLists.txt as CMake spells it.",
                ),
                ("package/consistency", "Sw", "A Find module calls find_package_handle_standard_args()."),
                ("package/stdargs", "Sw", "A Find module gives find_package_handle_standard_args() its own name."),
            ),
        ),
        Group(
            "",
            ("readability",),
            (
                ("readability/logic", "Sn", "What closes a block, as endif() does, does not repeat the condition."),
                ("readability/mixedcase", "Sn", "The commands of a file are all in lower or all in upper case."),
                ("readability/wonkycase", "Sn", "A command is in lower or in upper case, not in both."),
            ),
        ),
        Group(
            "",
            ("formatting",),
            (
                (
                    "linelength",
                    "Sn",
                    "Lines are no longer than allowed: 140 characters unless .cmakelintrc tells otherwise.",
                ),
                ("whitespace/eol", "Sn", "No line ends with spaces."),
                ("whitespace/extra", "Sn", "No space stands between a command and its parenthesis."),
                ("whitespace/indent", "Sn", "Indentation is a multiple of two spaces, or of what .cmakelintrc tells."),
                (
                    "whitespace/mismatch",
                    "Sn",
                    "Inside parentheses stand as many spaces at the end as at the beginning.",
                ),
                ("whitespace/newline", "Sn", "Lines end with a line feed alone."),
                ("whitespace/tabs", "Sn", "Indentation is made of spaces."),
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
    return TABLE.rule(identifier, "-n", f"Cmakelint's category {identifier} finds nothing.", _OTHER)
