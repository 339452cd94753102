# SPDX-License-Identifier: Apache-2.0
"""Digests of settings: runs with equal ones find the same in the same files."""

from __future__ import annotations

import hashlib
import os
from dataclasses import fields

from haros_ci.config.settings import Settings
from haros_ci.results.result import Tool
from haros_ci.results.values import plain

#: Settings that say how the run is made or reported, not what the tools are to find.
_REPORTING = frozenset(
    {
        "root",
        "project_file",
        "fail_on",
        "jobs",
        "imports",
        "baseline",
        "baseline_rev",
        "base",
        "buffer",
        "base_missing",
        "require_baseline",
        "allow_tool_failure",
        "cache_dir",
        "notes",
        "origins",
        "is_measured",
    }
)

#: Where the others are given, if not in the project file.
_OPTIONS = {
    "paths": "the paths",
    "profile": "--profile",
    "command_line": "--select or --ignore",
    "exclude": "--exclude",
    "compile_database": "--compile-database",
    "exact": "--exact",
    "trust_config": "--trust-config",
    "plugins": "--plugin",
}


def settings_digests(settings: Settings, components: tuple[Tool, ...]) -> dict[str, str]:
    """A digest of the settings that change what the tools are to find, by where they are given; *components* are the plug-ins."""
    values: dict[str, list[object]] = {}
    for field in fields(settings):
        if field.name not in _REPORTING:
            value = getattr(settings, field.name)
            if field.name == "compile_database" and value is not None:
                value = os.path.relpath(os.path.join(settings.root, value), settings.root)
            values.setdefault(_OPTIONS.get(field.name, "the project file"), []).append(plain(value))
    values["--plugin"] = [plain(components)]
    return {name: _digest(repr(value)) for name, value in values.items()}


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]
