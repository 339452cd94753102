# SPDX-License-Identifier: Apache-2.0
"""The one rule of clang-format."""

from __future__ import annotations

from haros_ci.linters.catalogue.table import Group, Rule, Table

TABLE = Table(
    "clang-format",
    "`// clang-format off` before the lines and `// clang-format on` after them, or a path in `.clang-format-ignore`",
    lambda rule: "https://clang.llvm.org/docs/ClangFormatStyleOptions.html",
    (
        Group(
            "The workspace has a .clang-format, so somebody has decided how its C++ is laid out. `clang-format -i FILE` with"
            " the version that the project uses brings the file there; other versions of clang-format may differ in detail.",
            ("formatting",),
            (("formatting", "Rw", "C and C++ files are laid out as the workspace's .clang-format asks."),),
        ),
    ),
)


def rules() -> dict[str, Rule]:
    """The rule by id."""
    return TABLE.rules()


def invented(identifier: str) -> None:
    """clang-format has no other rule."""
