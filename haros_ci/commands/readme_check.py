# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model --check-readme``: where the interface tables of packages' READMEs and the code disagree."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache

from haros_ci.model.architecture import Architecture
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.report.node_interface import interfaces
from haros_ci.report.readme_compare import Disagreement, KnownPackage, compare, known
from haros_ci.report.readme_tables import rows

#: A line of a parameter file with a key and a value.
_SETTING = regex(r"""^[ \t]*["']?([\w./]+)["']?:[ \t]+("[^"\n]*"|'[^'\n]*'|[^#\n]*[^#\s])[ \t]*(?:#.*)?$""", re.M)
NAMES = ("README.md", "Readme.md", "readme.md", "README.MD")


def differences(workspace: Workspace, architecture: Architecture) -> tuple[Disagreement, ...]:
    """What the README of each package in *workspace* says otherwise than *architecture*, by file and line.

    A package of which no node is in the model and that has no endpoint in its files is passed over: nothing is known
    of it.
    """
    facts = known(interfaces(architecture), architecture)
    found = [
        difference
        for package in architecture.packages
        if package.name in facts
        for difference in _of(package, facts[package.name], workspace)
    ]
    return tuple(sorted(found, key=lambda item: (item.path, item.line, item.rule, item.message)))


def _of(package: Package, facts: KnownPackage, workspace: Workspace) -> Iterator[Disagreement]:
    for name in NAMES:
        path = name if package.path == "." else f"{package.path}/{name}"
        if workspace.reports_on(path):
            yield from compare(path, rows(workspace.text(path)), facts, _settings(package, workspace))


def _settings(package: Package, workspace: Workspace) -> Callable[[str], Iterable[object]]:
    """The scalars that the package's ROS 2 parameter files have for a key; read when they are first asked for."""

    @cache
    def every() -> Mapping[str, tuple[object, ...]]:
        found: dict[str, list[object]] = {}
        for file in workspace.files:
            if file.package == package.name and file.path.endswith((".yaml", ".yml")):
                text = workspace.text(file.path)
                for key, value in _SETTING.findall(text) if "ros__parameters" in text else ():
                    found.setdefault(key.rpartition(".")[2], []).append(_value(value))
        return {key: tuple(values) for key, values in found.items()}

    return lambda key: every().get(key, ())


def _value(text: str) -> object:
    if text[0] == text[-1] and text[0] in "\"'" and len(text) > 1:
        return text[1:-1]
    try:
        return json.loads({"True": "true", "False": "false"}.get(text, text))
    except (ValueError, RecursionError):
        pass
    try:
        return float(text)  # 1. and .5
    except ValueError:
        return text
