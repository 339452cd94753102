# SPDX-License-Identifier: Apache-2.0
"""The rules of yamllint, and ``syntax`` for what is no YAML."""

from __future__ import annotations

from haros_ci.linters.catalogue.table import Group, Rule, Table

TABLE = Table(
    "yamllint",
    "`# yamllint disable-line rule:CODE` on the line",
    lambda rule: f"https://yamllint.readthedocs.io/en/stable/rules.html#module-yamllint.rules.{rule.replace('-', '_')}",
    (
        Group(
            "The file cannot be loaded as it stands: no parameter in it reaches a node.",
            ("correctness",),
            (("syntax", "Be", "YAML syntax error."),),
            precision="very-high",
        ),
        Group(
            "Loaders take one of the values without a word, most of them the last, so that what stands above has no effect.",
            ("correctness",),
            (
                ("key-duplicates", "Bw", "Duplicate key."),
                ("anchors", "Rw", "Undefined alias or duplicate anchor."),
            ),
        ),
        Group(
            "YAML 1.1, which ROS reads, takes yes, no, on and off for booleans, 010 for eight and .5e3 for a number or a text,"
            " by the loader. Quote what is meant as text; write numbers and booleans in their plain form.",
            ("suspicious",),
            (
                (
                    "truthy",
                    "Rw",
                    "yes, no, on or off as a boolean or an unquoted string.",
                ),
                ("octal-values", "Rw", "Number with a leading zero, read as octal."),
                ("float-values", "Sn", "Floating-point number without digits on both sides of the point."),
                ("empty-values", "Sn", "Key without a value."),
                ("quoted-strings", "-n", "String not quoted as configured."),
            ),
        ),
        Group(
            "",
            ("formatting",),
            (
                ("braces", "Sn", "Wrong spaces inside braces."),
                ("brackets", "Sn", "Wrong spaces inside brackets."),
                ("colons", "Sn", "Too many spaces around a colon."),
                ("commas", "Sn", "Wrong spaces around a comma."),
                ("comments", "Sn", "Comment without a space after #, or too close to the content."),
                ("comments-indentation", "Sn", "Wrong indentation of a comment."),
                ("document-end", "-n", "Missing or unwanted end of document marker."),
                ("document-start", "-n", "Missing or unwanted start of document marker."),
                ("empty-lines", "Sn", "Too many consecutive empty lines."),
                ("hyphens", "Sn", "Too many spaces after a hyphen."),
                ("indentation", "Sn", "Inconsistent indentation."),
                ("key-ordering", "-n", "Keys not in order."),
                ("line-length", "Sn", "Line too long."),
                ("new-line-at-end-of-file", "Sn", "Missing newline at the end of the file."),
                ("new-lines", "Sn", "Wrong line ending."),
                ("trailing-spaces", "Sn", "Trailing spaces."),
            ),
        ),
    ),
)
_OTHER = Group("", ("formatting",), (), precision="medium")


def rules() -> dict[str, Rule]:
    """The rules by id."""
    return TABLE.rules()


def invented(identifier: str) -> Rule:
    """A rule that a newer yamllint has."""
    return TABLE.rule(identifier, "-n", f"Finding of yamllint's rule {identifier}.", _OTHER)
