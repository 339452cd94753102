# SPDX-License-Identifier: Apache-2.0
"""Completion in a shell: click's script, and the words that it cannot know."""

from __future__ import annotations

from collections.abc import Iterable

import click
from click.shell_completion import get_completion_class

#: Click's own name for the variable by which the script asks the program.
VARIABLE = "_HAROS_CI_COMPLETE"


def script(command: click.Command, shell: str) -> str:
    """What *shell* (``bash``, ``zsh``, ``fish``) has to read."""
    kind = get_completion_class(shell)
    assert kind is not None, "the command offers no other shell"
    return kind(command, {}, "haros-ci", VARIABLE).source()


def words(what: str, incomplete: str) -> list[str]:
    """The words of a kind (``rules``, ``profiles``, ``formats``, ``tools``) that complete the last one of a comma-separated list."""
    done, comma, begun = incomplete.rpartition(",")
    return [f"{done}{comma}{word}" for word in sorted({*_all(what)}) if word.startswith(begun)]


def _all(what: str) -> Iterable[str]:
    if what == "profiles":
        from haros_ci.config.settings import PROFILES

        return PROFILES
    if what == "formats":
        from haros_ci.output import FOLDERS, FORMATS

        return (*FORMATS, *FOLDERS)
    from haros_ci.registry import built_in

    known = built_in()
    if what == "tools":
        return known.adapters
    return (
        name for tool, rule in known.documented_rules() for name in (tool, rule.id, f"{tool}:{rule.id}", *rule.tags)
    )
