# SPDX-License-Identifier: Apache-2.0
"""The YAML of a parameter library as values with their places, within fixed limits and without constructing objects."""

from __future__ import annotations

from typing import Any, ClassVar

from haros_ci.bounded_yaml import TAG, Composer, Scalar, YamlLimits
from haros_ci.records import dataclass

LIMITS = YamlLimits(characters=1_000_000, depth=50, aliases=1_000, values=20_000)
_NUMBERS = frozenset(TAG + name for name in ("int", "float", "bool", "null"))


@dataclass(frozen=True, slots=True)
class Value:
    """A scalar, list or map. *line* and *column*, 1-based, are those of its key, else its own; *size* counts values."""

    line: int
    column: int
    data: Scalar | tuple[Value, ...] | dict[Scalar, Value]
    size: int = 1


def parse_yaml(text: str) -> Value | None:
    """The first document of *text*, None if it is empty; YamlFault for what is malformed or over a limit."""
    return _ParameterComposer(text, LIMITS).document()


class _ParameterComposer(Composer[Value]):
    """Tags of collections are let pass, and so is what follows the first document."""

    SAYS: ClassVar = {
        **Composer.SAYS,
        "undefined": ("*{} refers to nothing that is complete", "define &{} before it"),
        "cycle": ("*{} refers to nothing that is complete", "define &{} before it"),
        "key": ("a list or map is the key of a map", "use a text"),
        "long": ("a number that is too long", "shorten it"),
        "kind": ("{!r} is not of its type", "correct it"),
    }
    SYNTAX = "not valid YAML ({}); correct it"
    is_single = False
    is_strict = False

    def scalar(self, event: Any, tag: str) -> Scalar:
        """The value by YAML 1.1, as PyYAML resolves it; dates and the like stay text."""
        return self.number(event, tag) if tag in _NUMBERS else str(event.value)

    def made(self, event: Any, data: Any, size: int) -> Value:
        return Value(event.start_mark.line + 1, event.start_mark.column + 1, data, size)

    def under(self, value: Value, event: Any) -> Value:
        return self.made(event, value.data, value.size)

    @staticmethod
    def quoted(text: str) -> str:
        return text[:60]
