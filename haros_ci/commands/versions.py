# SPDX-License-Identifier: Apache-2.0
"""``haros-ci --version``: ours, and those of the tools whose rules decide which findings there are."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

#: What decides findings of pylint besides pylint.
BESIDES = ("astroid",)


def tool_versions() -> Iterator[tuple[str, str]]:
    """The tools that run without being asked for and those that measure, by name: version, or "missing"; none is taken from the workspace."""
    from haros_ci.config.load import load
    from haros_ci.linters.installed import distribution
    from haros_ci.linters.linter import LintOptions, When
    from haros_ci.linters.values import ADAPTERS, SUFFIX
    from haros_ci.registry import built_in

    options = LintOptions(root=load(Path.cwd(), isolated=True, command_line={}).root)
    always = [linter for linter in built_in().linters if linter.WHEN is When.ALWAYS]
    adapters = {adapter.NAME.removesuffix(SUFFIX): adapter for adapter in (*always, *ADAPTERS)}
    found = {name: program.version if (program := adapters[name].locate(options)) else None for name in adapters}
    found.update({name: place.version for name in BESIDES if (place := distribution(name)) is not None})
    for name in sorted(found):
        yield name, found[name] or "missing"


def text(version: str) -> str:
    """Two lines: haros-ci, and what it runs with."""
    tools = ", ".join(f"{name} {number}" for name, number in tool_versions())
    return f"haros-ci, version {version}\nwith {tools}, Python {sys.version_info[0]}.{sys.version_info[1]}"
