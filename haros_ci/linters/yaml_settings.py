# SPDX-License-Identifier: Apache-2.0
"""Settings that are written in YAML as plain values, within fixed limits."""

from __future__ import annotations

import json
from typing import Any

MAX_CHARACTERS = 50_000
MAX_DEPTH = 20
MAX_ALIASES = 20


def read(text: str) -> dict[str, Any]:
    """The map that *text* is in YAML, as JSON could write it. Raises ValueError, with the line where one is known."""
    import yaml

    if len(text) > MAX_CHARACTERS:
        raise ValueError(f"more than {MAX_CHARACTERS} characters")
    depth = aliases = 0
    try:
        for event in yaml.parse(text, Loader=yaml.SafeLoader):
            depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
            aliases += isinstance(event, yaml.AliasEvent)
            if depth > MAX_DEPTH or aliases > MAX_ALIASES:
                raise ValueError("nested too deeply, or too many aliases")
        value = json.loads(json.dumps(yaml.safe_load(text), default=str))
    except yaml.MarkedYAMLError as err:
        line = f"line {err.problem_mark.line + 1}: " if err.problem_mark else ""
        raise ValueError(f"{line}{err.problem}") from err
    except (yaml.YAMLError, RecursionError, TypeError) as err:
        raise ValueError(str(err).partition("\n")[0]) from err
    except (
        KeyError,
        IndexError,
        AttributeError,
    ) as err:  # PyYAML's constructors, of what is not of the type of its tag
        raise ValueError("a value is not of the type that its tag (!!bool, !!int, !!timestamp) names") from err
    if value is not None and not isinstance(value, dict):
        raise ValueError("not a map")
    return value or {}
