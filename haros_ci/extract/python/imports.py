# SPDX-License-Identifier: Apache-2.0
"""What import statements bind."""

from __future__ import annotations

import ast


def imported(node: ast.Import | ast.ImportFrom) -> list[tuple[str, str]]:
    """(local name, dotted target); ``import a.b`` binds a; a star import is named ``*``; leading dots are kept."""
    if isinstance(node, ast.ImportFrom):
        base = "." * node.level + (node.module or "")
        joint = "" if not base or base.endswith(".") else "."
        return [
            ("*", base) if item.name == "*" else (item.asname or item.name, f"{base}{joint}{item.name}")
            for item in node.names
        ]
    return [(item.asname, item.name) if item.asname else (item.name.partition(".")[0],) * 2 for item in node.names]
