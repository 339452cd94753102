# SPDX-License-Identifier: Apache-2.0
"""The API rows of a run: the project file's, those of plug-ins, and the tables'."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.config.settings import Settings
from haros_ci.extract.apis.tables import rows
from haros_ci.model.api import Row, RowError, load_row
from haros_ci.model.workspace import Problem


def plugin_rows(settings: Settings) -> tuple[Row, ...]:
    """The API rows of plug-ins, in their order."""
    if not settings.plugins:
        return ()
    from haros_ci.plugins.load import load

    return tuple(row for plugin in load(settings.plugins, settings.root) for row in plugin.rows)


def api_rows(
    declared: object, where: str, problems: list[Problem], more: tuple[Row, ...] = ()
) -> dict[tuple[str, int], tuple[Row, ...]]:
    """The API rows by language and ROS version; those of the project file come first, then *more*, those of plug-ins."""
    own: list[Row] = []
    for number, item in enumerate(declared if isinstance(declared, (list, tuple)) else (), start=1):
        try:
            if not isinstance(item, Mapping):
                raise RowError("a row is a mapping with a 'call'")
            own.append(load_row(item))
        except RowError as err:
            problems.append(Problem(where, f"row {number} of 'apis': {err}"))
    first = (*own, *more)
    tables = {(language, ros): rows(language, ros) for language in ("cpp", "python") for ros in (1, 2)}
    # The very tables where nothing is added, as what follows from them is worked out once.
    return {version: (*first, *table) for version, table in tables.items()} if first else tables
