# SPDX-License-Identifier: Apache-2.0
"""The table of targets: every reader of bytes that a workspace, a log, a shard or a tool brings has one.

A group is imported when one of its targets is asked for: a process that fuzzes one reader need not have all others.
"""

from __future__ import annotations

from importlib import import_module

from fuzz.targets.kit import Entry

GROUPS = {
    "build_files": (
        *("cmake", "cmake-words", "condition", "git-files", "idl", "interfaces", "names", "package-xml", "plugins-xml"),
        *("reconfigure", "setup-files", "setup-texts"),
    ),
    "launch_files": (
        *("behavior-trees", "commands", "launch-xml", "parameter-yaml", "policies", "robots", "roslaunch"),
        *("ros2-launch-python", "ros2-launch-xml", "ros2-launch-yaml"),
    ),
    "settings": (
        *(
            "haros-file",
            "linter-plans",
            "linter-settings",
            "patterns",
            "project-file",
            "properties",
            "queries",
            "readme-tables",
        ),
        *("yaml-lines",),
    ),
    "sources": (
        *(
            "code-texts",
            "comments",
            "cpp",
            "defined-again",
            "followed-cpp",
            "followed-python",
            "followed-ros1",
            "includes",
            "inclusions",
            "line-maps",
        ),
        *("lizard", "measured-cpp", "measured-python", "parameter-library", "python", "radon"),
    ),
    "stored": (
        *("baseline", "cached-values", "caches", "compile-database", "declared-output", "exact-answers", "history"),
        *("recordings", "sarif", "shard-costs", "shards", "tool-output", "verdicts"),
    ),
    "whole": ("checks",),
}
NAMES = tuple(sorted(name for names in GROUPS.values() for name in names))


def entry(name: str) -> Entry:
    """The target *name*, which is one of NAMES."""
    (group,) = (group for group, names in GROUPS.items() if name in names)
    found: Entry = import_module(f"fuzz.targets.{group}").TARGETS[name]
    return found
