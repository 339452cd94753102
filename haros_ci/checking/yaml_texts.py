# SPDX-License-Identifier: Apache-2.0
"""Whether a parameter file is YAML at all."""

from __future__ import annotations

from haros_ci.bounded_yaml import YamlFault, YamlLimits, YamlTooLarge, check
from haros_ci.regex import regex

#: Text that a program fills in before it is YAML.
_TEMPLATE = regex(r"\{\{|\{%|<%|@\(|\$\(|\bxmlns:")
_LIMITS = YamlLimits(characters=1_000_000, depth=200)


def yaml_fault(text: str) -> tuple[int, str] | None:
    """The line at which *text* stops being YAML, and why; None if it is YAML, too large, or a template."""
    if _TEMPLATE.search(text[: _LIMITS.characters]):
        return None
    try:
        check(text, _LIMITS)
    except YamlTooLarge:
        return None
    except YamlFault as err:
        return err.line, err.problem
    return None
