# SPDX-License-Identifier: Apache-2.0
"""YAML of ``<rosparam>`` as values that know their lines, within fixed limits; nothing is constructed but plain data.

As rosparam reads it (wiki rosparam, "YAML format"): YAML 1.1, ``deg(...)``, ``rad(...)``, ``!degrees``, ``!radians``.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, ClassVar

from haros_ci.bounded_yaml import MAX_NUMBER, MERGE, TAG, Composer, YamlFault, YamlLimits
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.substitutions.expression import ExpressionScopes, Undecided, Wrong, compute
from haros_ci.substitutions.names import MARK, Text, quoted, unknown

LIMITS = YamlLimits(characters=1_000_000, depth=50, aliases=1_000, values=50_000)

_SCALARS = {TAG + name for name in ("str", "int", "float", "bool", "null", "timestamp", "value", "binary")}
_ANGLE = regex(r"(deg|rad)\([^)]*\)\Z")
_ANGLES = {"!degrees": "deg", "!radians": "rad"}


#: Not YAML that roslaunch can load, or refused.
YamlError = YamlFault


@dataclass(frozen=True, slots=True)
class OpaqueNode:
    """A scalar whose value is not known: *type* is its parameter type if known, *unknown* its text."""

    reason: str
    type: str | None = None
    shown: str | None = None
    unknown: Text | None = None


@dataclass(frozen=True, slots=True)
class YamlValue:
    """A scalar, list or map; *line* is the line that says it, that of its key inside a map. *size* counts values."""

    line: int
    data: Any
    size: int = 1


def read_yaml(text: Text) -> YamlValue:
    """The one document in *text*, None as data if it is empty; YamlError for what roslaunch or a limit refuses."""
    return _SubstitutingComposer(text).document() or YamlValue(1, None)


def plain(data: Any) -> object:
    """*data* as bare lists, maps and scalars. Opaque parts must have been excluded."""
    if isinstance(data, dict):
        return {str(key): plain(item.data) for key, item in data.items()}
    return [plain(item.data) for item in data] if isinstance(data, tuple) else data


def parts(value: YamlValue) -> list[Any]:
    """*value*'s data and those of everything in it, keys included."""
    found: list[Any] = []
    todo = [value.data]
    while todo:
        data = todo.pop()
        found.append(data)
        if isinstance(data, dict):
            todo.extend((*data.keys(), *(item.data for item in data.values())))
        elif isinstance(data, tuple):
            todo.extend(item.data for item in data)
    return found


class _SubstitutingComposer(Composer[YamlValue]):
    quoted = staticmethod(quoted)
    SAYS: ClassVar = {
        **Composer.SAYS,
        "scalar": ("tag {} is not known to roslaunch", "write plain data"),
        "angle": ("{} is no angle", "write deg(90) or rad(pi/2)"),
    }

    def __init__(self, text: Text) -> None:
        super().__init__(text.raw, LIMITS)
        self.text = text

    def made(self, event: Any, data: Any, size: int) -> YamlValue:
        return YamlValue(event.start_mark.line + 1, data, size)

    def under(self, value: YamlValue, event: Any) -> YamlValue:
        return replace(value, line=event.start_mark.line + 1)

    again = under

    def scalar(self, event: Any, tag: str) -> Any:
        if MARK in event.value:
            return self.unknown(event, tag)
        angle = _ANGLES.get(tag)
        if angle is not None:
            return self.angle(event, angle)
        if tag not in _SCALARS and tag != MERGE:
            raise self.fault(event, "scalar", quoted(tag))
        kind = tag.removeprefix(TAG)
        if kind == "binary":
            return OpaqueNode("binary data (base64), which is none of the plain types")
        if kind == "timestamp":
            return OpaqueNode("a date, which is none of the plain types; quote it if it is text", shown=event.value)
        if kind not in ("int", "float", "bool", "null"):
            return str(event.value)
        return self.number(event, tag)

    def unknown(self, event: Any, tag: str) -> OpaqueNode:
        first = self.text.raw.count(MARK, 0, event.start_mark.index)
        count = event.value.count(MARK)
        reasons = self.text.reasons[first : first + count] or ("part of it is not known",)
        is_text = not event.implicit[0] or "/" in event.value or (tag == TAG + "str" and event.tag is not None)
        text = Text(event.value, tuple((*reasons, *reasons * count)[:count]))
        return OpaqueNode("; ".join(dict.fromkeys(reasons)), "str" if is_text else None, text.shown, text)

    def angle(self, event: Any, kind: str) -> Any:
        """``deg(90)``, ``!degrees 90``: a number; ``rad(pi/2)``, ``!radians pi/2``: an expression."""
        source = event.value.strip()
        if source.startswith(kind + "("):
            source = source[4:-1]
        try:
            if kind == "deg":
                return float(source[:MAX_NUMBER]) * math.pi / 180.0
            number = compute(source, ExpressionScopes({}, unknown, {}, ""))
            return float(str(number)) if isinstance(number, (int, float)) else self.no_angle(event)
        except Undecided as err:
            return OpaqueNode(str(err).replace("$(eval ...)", quoted(event.value)), "double")
        except (ValueError, OverflowError, Wrong):
            return self.no_angle(event)

    def no_angle(self, event: Any) -> Any:
        raise self.fault(event, "angle", quoted(event.value))

    def tag(self, event: Any) -> str:
        match = _ANGLE.match(event.value) if event.tag in (None, "!") and event.implicit[0] else None
        if match:
            return "!degrees" if match[1] == "deg" else "!radians"
        return super().tag(event)
