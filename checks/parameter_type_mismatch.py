# SPDX-License-Identifier: Apache-2.0
"""Parameters that are given a value of another type than the node declares: it throws when it starts."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Given, Level, System, line_of, regex

#: The types that are compared.
TYPES = frozenset(kind + array for kind in ("bool", "int", "double", "str") for array in ("", "[]"))

#: Values that a script is to put something in the place of: ``__RATE__``, ``@RATE@``, ``${RATE}``, ``{{ rate }}``, ``%RATE%``.
_PLACEHOLDER = regex(r"__\w+__|@\w+@|\$\{?\w+\}?|\{\{[^{}]{1,80}\}\}|%\w+%")


def check(system: System) -> Iterator[Finding]:
    """One finding stands for all placeholders that a node is given by one file."""
    left: dict[tuple[str, str], list[tuple[Given, End]]] = {}
    for parameter, end in _mismatches(system):
        if isinstance(parameter.value, str) and _PLACEHOLDER.fullmatch(parameter.value.strip()):
            left.setdefault((parameter.node.name, parameter.at.path), []).append((parameter, end))
        else:
            yield _finding(parameter, end)
    for found in left.values():
        parameter, end = min(found, key=lambda item: item[0].at.sort_key)
        yield _finding(parameter, end, len(found) - 1)


def _mismatches(system: System) -> Iterator[tuple[Given, End]]:
    for parameter in system.given:
        declared = parameter.node.names.declared.get(parameter.key, ())
        if not declared or parameter.type not in TYPES:
            continue
        if any(
            end.raw.source == "known-node" or end.raw.is_dynamic or end.type not in TYPES or end.type == parameter.type
            for end in declared
        ):
            continue
        yield parameter, declared[0]


def _finding(parameter: Given, end: End, more: int | None = None) -> Finding:
    """*more*, where the value is a placeholder, are as many others of the file that the node is given."""
    instead = _instead(parameter, end) if more is None else _filled(more)
    return Finding(
        at=parameter.at,
        message=(
            f"{parameter.node.type} declares the parameter {parameter.key} as {end.type} ({line_of(end.location)}), but "
            f"{parameter.node} gets {_shown(parameter)}, {_a(parameter.type)}: the node throws at the "
            f"declaration{instead}"
        ),
        about=(parameter.node, parameter.key),
        related=((end.location, f"declared as {end.type}"),) if end.in_source else (),
        flow=(
            (parameter.tag, f"{parameter.node} is given the parameters"),
            (parameter.at, f"{_a(parameter.type)}"),
        ),
        presence=parameter.presence,
    )


def _filled(more: int) -> str:
    """What to write in place of a placeholder, where *more* parameters of the file have one."""
    others = f", and so are those of {more} more parameters of the file" if more > 1 else ""
    others = ", and so is that of another parameter of the file" if more == 1 else others
    return f"; the value is a placeholder{others}: give the node a file with values"


def _instead(parameter: Given, end: End) -> str:
    """What to write."""
    value = parameter.value
    if end.type == "double" and isinstance(value, int):
        return f"; write {value}.0"
    if end.type == "double[]" and parameter.type == "int[]":
        return "; write a decimal point in each number"
    if end.type == "int" and isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return f"; write {int(value)}"
    keeping = _keeping(parameter) if end.type == "str" else ""
    if keeping and not isinstance(value, (int, float)):
        return f"; {keeping}"
    if keeping:
        return f"; declare it as {parameter.type} if a {'switch' if parameter.type == 'bool' else 'number'} is meant; {keeping}"
    if end.type == "str" and isinstance(value, (bool, int, float)):
        return (
            f"; declare it as {parameter.type} if a number is meant, else give it as text"
            if parameter.type != "bool"
            else "; put the value in quotes"
        )
    if end.type == "bool" and value in (0, 1):
        return f"; write {'true' if value else 'false'}"
    return ""


def _keeping(parameter: Given) -> str:
    """How a value that stands in a launch file itself stays a text: launch reads texts as YAML (launch_ros, ``evaluate_parameters``)."""
    if parameter.raw.origin is not None:
        return ""
    # launch_ros writes y and n without quotes, as PyYAML takes them for texts, and rcl reads them as YAML 1.1 does
    but = " (but for y and n, which become truths even so: write another word)" if parameter.type == "bool" else ""
    if parameter.tag.path.endswith(".py"):
        return f"launch reads a text here as YAML, ParameterValue(…, value_type=str) keeps it a text{but}"
    if parameter.tag.path.endswith((".xml", ".launch")):
        return f'launch reads a value here as YAML, type="str" keeps it a text{but}'
    return ""


def _shown(parameter: Given) -> str:
    text = str(parameter.value).lower() if isinstance(parameter.value, bool) else repr(parameter.value)
    return text if len(text) <= 60 else f"{text[:59]}…"


def _a(kind: str | None) -> str:
    return f"an {kind}" if kind is not None and kind[0] == "i" else f"a {kind}"


CHECK = Check(
    id="parameter-type-mismatch",
    summary="Parameter value of another type than declared.",
    level=Level.ERROR,
    catalogue="P03",
    tags=("parameters",),
    run=check,
)
