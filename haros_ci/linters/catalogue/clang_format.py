# SPDX-License-Identifier: Apache-2.0
"""The one rule of clang-format."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.linters.catalogue.table import Group, Rule, Table
from haros_ci.results.rule import Level

TABLE = Table(
    "clang-format",
    "`// clang-format off` before the lines and `// clang-format on` after them, or a path in `.clang-format-ignore`",
    lambda rule: "https://clang.llvm.org/docs/ClangFormatStyleOptions.html",
    (
        Group(
            "The workspace has a .clang-format, so somebody has decided how its C++ is laid out. `clang-format -i FILE` with"
            " the version that the project uses brings the file there; other versions of clang-format may differ in detail.",
            ("formatting",),
            (("formatting", "Rw", "C or C++ file not formatted by the workspace's .clang-format."),),
        ),
    ),
)


def rules() -> dict[str, Rule]:
    """The rule by id: who asks for the tool sees it, and it fails no run by itself, as with Black."""
    return {name: replace(rule, level=Level.NOTE) for name, rule in TABLE.rules().items()}


def invented(identifier: str) -> None:
    """clang-format has no other rule."""
