# SPDX-License-Identifier: Apache-2.0
"""What PyYAML makes of a number, a truth or nothing that stands in a text."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import yaml

#: Characters of a number: those of YAML 1.1 in base 60 take quadratic time.
MAX_NUMBER = 100
TAG = "tag:yaml.org,2002:"

Scalar = str | int | float | bool | None


def scalar_value(kind: str, text: str) -> Scalar:
    """What ``yaml.safe_load`` makes of *text* as an int, float, bool or null (*kind*); ValueError otherwise, or too long."""
    if len(text) > MAX_NUMBER:
        raise ValueError(f"longer than {MAX_NUMBER} characters")
    import yaml

    make, node = _constructors()[TAG + kind], yaml.ScalarNode(TAG + kind, text)
    try:
        return make(node)
    except (LookupError, ArithmeticError, yaml.YAMLError) as err:
        raise ValueError(f"no {kind}") from err


@lru_cache(maxsize=1)
def _constructors() -> Mapping[str, Callable[[yaml.ScalarNode], Scalar]]:
    """What PyYAML makes of a scalar, by its tag; it keeps none of the nodes."""
    import yaml

    constructor = yaml.constructor.SafeConstructor()
    return {tag: partial(make, constructor) for tag, make in constructor.yaml_constructors.items() if tag}
