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
            (("syntax", "Be", "A YAML file can be parsed."),),
            precision="very-high",
        ),
        Group(
            "Loaders take one of the values without a word, most of them the last, so that what stands above has no effect.",
            ("correctness",),
            (
                ("key-duplicates", "Bw", "A map has each key once."),
                ("anchors", "Rw", "An alias refers to an anchor that was defined before, and each anchor once."),
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
                    "Booleans are written true and false; yes, no, on and off are quoted if they are texts.",
                ),
                ("octal-values", "Rw", "A number does not begin with a zero that makes it octal."),
                ("float-values", "Sn", "A floating point number has digits on both sides of its point."),
                ("empty-values", "Sn", "A key has a value; nothing stands for null."),
                ("quoted-strings", "-n", "Texts are quoted as the configuration asks."),
            ),
        ),
        Group(
            "",
            ("formatting",),
            (
                ("braces", "Sn", "Flow maps have the spaces inside their braces that the configuration asks for."),
                ("brackets", "Sn", "Flow lists have the spaces inside their brackets that the configuration asks for."),
                ("colons", "Sn", "No more spaces stand around a colon than allowed."),
                ("commas", "Sn", "Spaces stand after a comma and not before it."),
                ("comments", "Sn", "A comment begins with a space after its hash, away from the content."),
                ("comments-indentation", "Sn", "A comment is indented as what it stands beside."),
                ("document-end", "-n", "The end of a document is marked, or not, as the configuration asks."),
                ("document-start", "-n", "The start of a document is marked, or not, as the configuration asks."),
                ("empty-lines", "Sn", "No more empty lines follow each other than allowed."),
                ("hyphens", "Sn", "No more spaces stand after a hyphen than allowed."),
                ("indentation", "Sn", "Indentation is even throughout the file."),
                ("key-ordering", "-n", "Keys are in order, if the configuration asks for it."),
                ("line-length", "Sn", "Lines are no longer than allowed."),
                ("new-line-at-end-of-file", "Sn", "The last line ends with a newline."),
                ("new-lines", "Sn", "Lines end as the configuration asks."),
                ("trailing-spaces", "Sn", "No line ends with spaces."),
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
    return TABLE.rule(identifier, "-n", f"Yamllint's rule {identifier} is kept.", _OTHER)
