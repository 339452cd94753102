# SPDX-License-Identifier: Apache-2.0
"""What libxml2 reports as rules: the part of libxml2 that speaks, and how bad it finds it."""

from __future__ import annotations

from haros_ci.linters.catalogue.table import Group, Rule, Table

TABLE = Table(
    "xmllint",
    "no comment of its own: xmllint cannot be silenced",
    lambda rule: "https://gnome.pages.gitlab.gnome.org/libxml2/xmllint.html",
    (
        Group(
            "Every program that reads the file stops here. A tag that is not closed, a bare & or <, an attribute that stands"
            " twice or without quotes, and an entity that XML does not know (`&nbsp;`) are the usual causes.",
            ("correctness", "xml"),
            (("parser-error", "Be", "XML file that is not well-formed."),),
            precision="very-high",
        ),
        Group(
            "A prefix such as `xacro:` needs its `xmlns:xacro` on the root element: without it the element has no meaning to"
            " programs that look for its namespace.",
            ("correctness", "xml"),
            (
                ("namespace-error", "Rw", "Undeclared namespace prefix."),
                ("namespace-warning", "Sn", "Relative namespace URI."),
            ),
        ),
        Group(
            "",
            ("xml",),
            (
                ("parser-warning", "Sn", "XML file with a parser warning."),
                ("validity-error", "-w", "XML file that violates its document type."),
                ("validity-warning", "-n", "Inconsistent document type."),
            ),
        ),
    ),
)
_OTHER = Group("", ("xml",), (), precision="medium")


def rules() -> dict[str, Rule]:
    """The rules by id."""
    return TABLE.rules()


def invented(identifier: str) -> Rule:
    """A rule for another part of libxml2."""
    words = identifier.replace("-", " ")
    return TABLE.rule(identifier, "-w", f"Libxml2 reports no {words}.", _OTHER)
