# SPDX-License-Identifier: Apache-2.0
"""Conditions of ROS 2 launch files as facts: what is written, whether it depends on anything, what it compares."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from haros_ci.model.launch_actions import Phrase, Substitution, Test
from haros_ci.model.launch_facts import Comparison
from haros_ci.regex import regex
from haros_ci.substitutions.names import MARK

#: Substitutions that give what their arguments say.
_PURE = frozenset(("eval", "equals", "not-equals", "not", "and", "or", "any", "all", "if"))
#: Stands for a launch configuration inside an expression.
_SLOT = "\ue003{}\ue003"
_LEFT = regex(r"(['\"]?)\ue003(\d+)\ue003\1\s*(==|!=)\s*(['\"])([^'\"]*)\4")
_RIGHT = regex(r"(['\"])([^'\"]*)\1\s*(==|!=)\s*(['\"]?)\ue003(\d+)\ue003\4")
_LITERAL = regex(r"\w+\(\s*(?:predicate_expression\s*=\s*)?(['\"])[^'\"]*\1\s*(?:,\s*)?\)")
#: How launch files spell truths.
TRUTHS = frozenset(("true", "false", "1", "0"))


def written(phrase: Phrase) -> str:
    """*phrase* as an XML launch file has it."""
    parts = []
    for part in phrase:
        if isinstance(part, str):
            parts.append(part)
        elif part.kind == "?":
            parts.append("?")
        else:
            parts.append("$(" + " ".join((part.kind, *(written(argument) for argument in part.arguments))) + ")")
    return "".join(parts)


def is_constant(test: Test) -> bool:
    """Whether nothing that *test* asks depends on anything; in Python only where a literal is written."""
    if test.kind not in ("if", "unless") or not test.phrases:
        return False
    if test.location is not None and test.location.path.endswith(".py"):
        return _LITERAL.fullmatch(test.text) is not None
    return _is_constant(test.phrases[0])


def _is_constant(phrase: Phrase) -> bool:
    return bool(phrase) and all(
        isinstance(part, str)
        or (part.kind in _PURE and bool(part.arguments) and all(_is_constant(argument) for argument in part.arguments))
        for part in phrase
    )


def comparisons(test: Test, values: Mapping[str, Mapping[str, None]]) -> tuple[Comparison, ...]:
    """What *test* compares with literals; *values* are those that each launch configuration can have."""
    if test.kind in ("equals", "not-equals") and len(test.phrases) == 2:
        name, right = (_literal(phrase) for phrase in test.phrases)
        if name is None or right is None:
            return ()
        return (Comparison(name, right, _known(values.get(name)), "==" if test.kind == "equals" else "!="),)
    return tuple(found for phrase in test.phrases for found in _compared(phrase, values))


def _compared(phrase: Phrase, values: Mapping[str, Mapping[str, None]]) -> Iterator[Comparison]:
    for part in phrase:
        if isinstance(part, str):
            continue
        if part.kind == "eval" and part.arguments:
            yield from _in_expression(part.arguments[0], values)
        for argument in part.arguments if part.kind in _PURE else ():
            yield from _compared(argument, values)


def _in_expression(phrase: Phrase, values: Mapping[str, Mapping[str, None]]) -> Iterator[Comparison]:
    slots: list[Substitution] = []
    text = ""
    for part in phrase:
        if isinstance(part, str):
            text += part
        else:
            text += _SLOT.format(len(slots))
            slots.append(part)
    found = [(match[1], match[2], match[3], match[5]) for match in _LEFT.finditer(text)]
    found += [(match[4], match[5], match[3], match[2]) for match in _RIGHT.finditer(text)]
    for quote, slot, sign, right in found:
        requested = slots[int(slot)] if int(slot) < len(slots) else None
        name = (
            _literal(requested.arguments[0])
            if requested is not None and requested.kind == "var" and requested.arguments
            else None
        )
        if name is not None and len(right) < 200:
            yield Comparison(f"$(var {name})", right, _known(values.get(name)), sign, bool(quote))


def _literal(phrase: Phrase) -> str | None:
    """*phrase* if it is only text."""
    parts = [part for part in phrase if isinstance(part, str)]
    return "".join(parts) if len(parts) == len(phrase) else None


def _known(values: Mapping[str, None] | None) -> tuple[str, ...]:
    """The values, () if one of them is not known."""
    return () if values is None or any(MARK in value for value in values) else tuple(values)
