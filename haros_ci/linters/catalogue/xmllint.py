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
            (("parser-error", "Be", "An XML file is well-formed."),),
            precision="very-high",
        ),
        Group(
            "A prefix such as `xacro:` needs its `xmlns:xacro` on the root element: without it the element has no meaning to"
            " programs that look for its namespace.",
            ("correctness", "xml"),
            (
                ("namespace-error", "Rw", "A namespace prefix is declared before it is used."),
                ("namespace-warning", "Sn", "The name of a namespace is a whole URI."),
            ),
        ),
        Group(
            "",
            ("xml",),
            (
                ("parser-warning", "Sn", "An XML file gives its reader no reason to wonder."),
                ("validity-error", "-w", "An XML file keeps to the document type that it declares."),
                ("validity-warning", "-n", "A declared document type is consistent."),
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
