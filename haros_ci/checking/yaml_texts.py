# SPDX-License-Identifier: Apache-2.0
"""Whether a parameter file is YAML at all."""

from __future__ import annotations

import re

#: Text that a program fills in before it is YAML.
_TEMPLATE = re.compile(r"\{\{|\{%|<%|@\(|\$\(|\bxmlns:")
#: Characters of a file that are read, as roslaunch and rcl files have them.
_MAX = 1_000_000
_DEPTH = 200


def yaml_fault(text: str) -> tuple[int, str] | None:
    """The line at which *text* stops being YAML, and why; None if it is YAML, too large, or a template."""
    if len(text) > _MAX or _TEMPLATE.search(text):
        return None
    import yaml

    depth = 0
    try:
        for event in yaml.parse(text, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
            depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
            if depth > _DEPTH:
                return None
    except yaml.MarkedYAMLError as err:
        mark = err.problem_mark or err.context_mark
        return (mark.line + 1 if mark else 1), str(err.problem or err.context or "it is cut off")
    except (yaml.YAMLError, UnicodeError):
        return None
    return None
