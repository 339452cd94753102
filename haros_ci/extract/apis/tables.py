# SPDX-License-Identifier: Apache-2.0
"""All tables of ROS API calls, checked and parsed, by language and ROS version."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from haros_ci.model.api import Row, load_row

#: Modules of this package, by language and ROS version; each has ``ROWS`` in the form of ``haros_ci.model.api``.
TABLES: tuple[tuple[str, int, tuple[str, ...]], ...] = (
    (
        "cpp",
        1,
        ("roscpp", "nodelet", "transports", "filters", "tf", "actions", "reconfigure", "diagnostics", "tools"),
    ),
    ("python", 1, ("rospy",)),
)


@cache
def rows(language: str, ros: int) -> tuple[Row, ...]:
    """The rows for ``cpp`` or ``python`` under ROS 1 or 2, in the order of the tables; () where there are none."""
    return tuple(
        load_row(row)
        for table_language, version, modules in TABLES
        if (table_language, version) == (language, ros)
        for module in modules
        for row in import_module(f"{__package__}.{module}").ROWS
    )
