# SPDX-License-Identifier: Apache-2.0
"""The functions, classes and files that are furthest over a limit, as a table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.model.measurement import Measurement
from haros_ci.report.escape import terminal
from haros_ci.report.measurements import Limit, level

#: The widest name in the table; of a longer one the end is shown.
WIDEST = 60
HEAD = ("value", "limit", "metric", "of", "what", "where")


def worst(values: Iterable[Measurement], limits: Iterable[Limit], most: int) -> list[tuple[Measurement, Limit]]:
    """The *most* things that are furthest over an upper limit, the worst first: for each the value that is, beside its lowest limit.

    Lower limits (of comments) are left out: a file without one would always be the worst.
    """
    lowest: dict[tuple[str, str], Limit] = {}
    for limit in limits:
        key = (limit.level, limit.metric)
        if not limit.is_lowest and (key not in lowest or limit.limit < lowest[key].limit):
            lowest[key] = limit
    found: dict[tuple[str, str, int, str, str], tuple[float, Measurement, Limit]] = {}
    for value in values:
        beside = lowest.get((level(value), value.metric))
        if beside is None or beside.limit <= 0 or not beside.crossed(value.value):
            continue
        times = value.value / beside.limit
        key_of = (value.package, value.path, value.line, value.class_name, value.function)
        if key_of not in found or times > found[key_of][0]:
            found[key_of] = (times, value, beside)
    ranked = sorted(found.items(), key=lambda item: (-item[1][0], item[0]))
    return [(value, beside) for _, (_, value, beside) in ranked[:most]]


def table(values: Iterable[Measurement], limits: Iterable[Limit], most: int) -> str:
    """The worst under a head, or one sentence if nothing crosses a limit; ends with an empty line."""
    known = list(values)
    chosen = worst(known, limits, most)
    if not chosen:
        return "Nothing is over a limit.\n\n" if known else ""
    rows = [HEAD, *(_row(value, limit) for value, limit in chosen)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEAD))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return f"The worst {len(chosen)}, by value divided by limit:\n" + "".join(f"  {line}\n" for line in lines) + "\n"


def _row(value: Measurement, limit: Limit) -> tuple[str, ...]:
    kind = level(value)
    names = {"function": " ".join(filter(None, (value.class_name, value.function))), "class": value.class_name}
    name = names.get(kind, value.path.rpartition("/")[2])
    at = f"{value.path}:{value.line}" if value.line else value.path
    return (_short(value.value), _short(limit.limit), value.metric, kind, *_fitted(name, at))


def _fitted(*texts: str) -> Iterator[str]:
    for text in map(terminal, texts):
        yield text if len(text) <= WIDEST else f"...{text[3 - WIDEST :]}"


def _short(number: float) -> str:
    return f"{number:.0f}" if number == int(number) else f"{number:.2f}"
