# SPDX-License-Identifier: Apache-2.0
"""Files of environment variables (``.env``): a ``NAME=value`` on each line."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.regex import regex
from haros_ci.workspace.shell_values import MAX_VALUE
from haros_ci.workspace.shell_variables import Variables

MAX_LINES = 2_000

_LINE = regex(r"(?:export[ \t]+)?([A-Za-z_]\w*)[ \t]*=[ \t]*([^\n]*)")
_COMMENT = regex(r"(?:^|[ \t])#[^\n]*")
_REFERENCE = regex(r"\$(?:\{(\w+)\}|(\w+))|(\$[{(]|`)")


def read_dotenv(text: str, inherited: Mapping[str, str | None] | None = None) -> Variables:
    """What the lines of *text* set; a value refers to variables before it, and to *inherited*, as ``$NAME`` or ``${NAME}``.

    Single quotes keep what is in them as it is; a ``#`` after a blank begins a comment outside of quotes. A value with a quote that is not
    closed on its line, or a reference to what is not set, is not known.
    """
    values: dict[str, str | None] = dict(inherited or {})
    own: set[str] = set()
    for line in text.splitlines()[:MAX_LINES]:
        found = _LINE.fullmatch(line.strip())
        if found is not None:
            own.add(found[1])
            values[found[1]] = _value(found[2], values)
    known = {name: value for name in own if (value := values[name]) is not None}
    return Variables(known, frozenset(own - known.keys()))


def _value(written: str, values: Mapping[str, str | None]) -> str | None:
    quote = written[:1]
    if quote in ("'", '"'):
        inside, end, rest = written[1:].partition(quote)
        if not end or (rest and not _COMMENT.fullmatch(rest)) or (quote == '"' and "\\" in inside):
            return None
        return inside if quote == "'" else _referred(inside, values)
    return _referred(_COMMENT.sub("", written, count=1).strip(), values)


def _referred(text: str, values: Mapping[str, str | None]) -> str | None:
    parts: list[str] = []
    at = size = 0
    for found in _REFERENCE.finditer(text):
        value = None if found[3] else values.get(found[1] or found[2])
        size += len(value or "")
        if value is None or size > MAX_VALUE:
            return None
        parts += (text[at : found.start()], value)
        at = found.end()
    made = "".join((*parts, text[at:]))
    return made if len(made) <= MAX_VALUE else None
