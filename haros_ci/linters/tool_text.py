# SPDX-License-Identifier: Apache-2.0
"""What a tool of the user's own writes, in any of the usual forms, as plain values; all of it is foreign text."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator

from haros_ci.linters.tool_xml import elements
from haros_ci.model.declared_tool import DeclaredTool
from haros_ci.model.digits import whole_number
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.linear_regex import compiled

MAX_LINE = 4_000  # characters of a line that are looked at
MAX_FINDINGS = 100_000  # of one process
MAX_TEXT = 8_000  # characters of a message
MAX_RULE = 200
MAX_NUMBER = 1_000_000_000
MAX_CONTAINERS, MAX_COMMAS = 2_000_000, 5_000_000

#: What terminals obey: colours and cursors (ECMA-48 control sequences), titles and links (OSC).
_ESCAPES = regex("\x1b\\[[0-?]{0,30}[ -/]{0,10}[@-~]|\x1b\\][^\x07\x1b\n]{0,2000}(?:\x07|\x1b\\\\)|\x1b[@-Z\\\\-_]")
_CONTROLS = regex("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]")
_GCC = regex(r"(?P<path>[^:]{1,1000}):(?P<line>\d{1,9}):(?:(?P<column>\d{1,9}):)?")
_WORD = regex(r" ?([\w ]{1,30}): ")
#: Words for levels that are known without ``levels``.
WORDS = frozenset(
    "error fatal critical severe warning warn note info information hint remark style performance portability"
    " convention refactor major minor".split()
) | {"fatal error"}
_GCC_RULE = regex(r"[^\s\[\]][^\[\]]{0,199}")


@dataclass(slots=True)
class ToolFinding:
    """One finding as the tool tells it: numbers are 1-based, 0 for none; *level* is the tool's own word."""

    path: str
    message: str
    line: int = 0
    column: int = 0
    end_line: int = 0
    end_column: int = 0
    rule: str = ""
    level: str = ""
    notes: list[ToolFinding] = field(default_factory=list)


def read(tool: DeclaredTool, data: bytes) -> Iterator[ToolFinding]:
    """Every finding in *data*, in its order. Raises ValueError, RecursionError for what is not of the tool's format."""
    readers: dict[str, Callable[[DeclaredTool, bytes], Iterator[ToolFinding]]] = {
        "gcc": _gcc,
        "regex": _regex,
        "checkstyle": _checkstyle,
        "json": _json,
        "json-lines": _json_lines,
    }
    for count, entry in enumerate(readers[tool.output](tool, data)):
        if count >= MAX_FINDINGS:
            raise ValueError(f"more than {MAX_FINDINGS} findings")
        yield entry


def clean(text: str, limit: int = MAX_TEXT) -> str:
    """*text* without what a terminal would obey, as one line of at most *limit* characters."""
    return " ".join(_CONTROLS.sub(" ", _ESCAPES.sub("", text[: 2 * limit])).split())[:limit]


def _lines(data: bytes) -> Iterator[str]:
    for line in data.decode("utf-8", "replace").split("\n"):
        yield _ESCAPES.sub("", line[: 2 * MAX_LINE]).rstrip("\r")[:MAX_LINE]


def _gcc(tool: DeclaredTool, data: bytes) -> Iterator[ToolFinding]:
    """``path:line:column: level: message [rule]``, as GCC, Clang and many others write it.

    A note without a rule belongs to what is above it.
    """
    own_words = {word for word, _ in tool.levels}
    pending: ToolFinding | None = None
    for line in _lines(data):
        match = _GCC.match(line)
        if match is None or not line[match.end() :].strip():
            continue
        word = _WORD.match(line, match.end())
        level = word[1].strip() if word else ""
        is_level = level.lower() in WORDS or level in own_words
        message, rule = _message_and_rule(line[word.end() if word and is_level else match.end() :].strip())
        level = level if is_level else ""
        entry = ToolFinding(
            match["path"], message, _number(match["line"]), _number(match["column"]), rule=rule, level=level
        )
        if level == "note" and not rule and pending is not None and "note" not in own_words:
            pending.notes.append(entry)
            continue
        if pending is not None:
            yield pending
        pending = entry
    if pending is not None:
        yield pending


def _message_and_rule(text: str) -> tuple[str, str]:
    """The message and the rule in brackets at its end, "" without one."""
    start = text.rfind(" [")
    if start > 0 and text.endswith("]") and _GCC_RULE.fullmatch(text, start + 2, len(text) - 1):
        return text[:start].rstrip(), text[start + 2 : -1]
    return text, ""


def _regex(tool: DeclaredTool, data: bytes) -> Iterator[ToolFinding]:
    pattern = compiled(tool.pattern)
    for line in _lines(data):
        groups = pattern.search(line)
        if groups is not None and groups["path"] and groups["message"]:
            yield _of_parts({name.replace("_", "-"): value for name, value in groups.items()})


def _checkstyle(tool: DeclaredTool, data: bytes) -> Iterator[ToolFinding]:
    for file in elements(data, "file", "error"):
        for error in file.children:
            rule = {"rule": error.get("source"), "level": error.get("severity")}
            yield _of_parts({**error, **rule, "path": file.attributes.get("name")})


def _json(tool: DeclaredTool, data: bytes) -> Iterator[ToolFinding]:
    """Entries under ``results``; a part that an entry lacks is looked for in what encloses it, from the inside out."""
    fields = dict(tool.fields)
    text = data.decode("utf-8-sig", "replace").strip()
    if not text:  # some write nothing for nothing
        return
    for chain in _entries(_loaded(text), fields.get("results", "").split(".") if fields.get("results") else []):
        if isinstance(chain[-1], dict):
            yield _from_json(chain, fields)


def _json_lines(tool: DeclaredTool, data: bytes) -> Iterator[ToolFinding]:
    fields = {key: value for key, value in tool.fields if key != "results"}
    for line in data.decode("utf-8-sig", "replace").split("\n"):
        if line.strip():
            entry = _loaded(line)
            if isinstance(entry, dict):
                yield _from_json([entry], fields)


def _loaded(text: str) -> object:
    if text.count("{") + text.count("[") > MAX_CONTAINERS or text.count(",") > MAX_COMMAS:
        raise ValueError("too many values")
    return json.loads(text)


def _entries(document: object, steps: list[str]) -> Iterator[list[object]]:
    """The chains of values from *document* to each entry; ``*`` stands for every entry of a list or map."""
    waiting: list[tuple[list[object], list[str]]] = [([document], steps)]
    while waiting:
        chain, left = waiting.pop()
        here = chain[-1]
        if not left:
            if isinstance(here, list):
                waiting += (([*chain, entry], []) for entry in reversed(here) if isinstance(entry, dict))
            else:
                yield chain
        elif left[0] == "*":
            inner = list(here.values()) if isinstance(here, dict) else here if isinstance(here, list) else []
            waiting += (([*chain, entry], left[1:]) for entry in reversed(inner))
        elif isinstance(here, dict) and left[0] in here:
            waiting.append(([*chain, here[left[0]]], left[1:]))


def _from_json(chain: list[object], fields: dict[str, str]) -> ToolFinding:
    parts = {}
    for part in ("path", "line", "column", "end-line", "end-column", "rule", "message", "level"):
        steps = fields.get(part, part).split(".")
        values = (_at(value, steps) for value in reversed(chain))
        parts[part] = next((value for value in values if value is not None), None)
    if not isinstance(parts["path"], str) or parts["message"] in (None, ""):
        raise ValueError(
            f"an entry without {'path' if not isinstance(parts['path'], str) else 'message'}: check 'fields'"
        )
    return _of_parts(parts)


def _at(value: object, steps: list[str]) -> object:
    for step in steps:
        if isinstance(value, dict):
            value = value.get(step)
        elif isinstance(value, list) and (index := whole_number(step)) is not None and index < len(value):
            value = value[index]
        else:
            return None
    return value if isinstance(value, str | int | float) else None


def _of_parts(parts: dict[str, object] | dict[str, str | None] | dict[str, str]) -> ToolFinding:
    numbers = {key: _number(parts.get(key)) for key in ("line", "column", "end-line", "end-column")}
    return ToolFinding(
        path=_word(parts.get("path")),
        message=_word(parts.get("message")),
        line=numbers["line"],
        column=numbers["column"],
        end_line=numbers["end-line"],
        end_column=numbers["end-column"],
        rule=_word(parts.get("rule")),
        level=_word(parts.get("level")),
    )


def _word(value: object) -> str:
    return "" if value is None else value if isinstance(value, str) else str(value)[:MAX_RULE]


def _number(value: object) -> int:
    """A line or column: a number or its digits; 0 for anything else."""
    if isinstance(value, str) and value.isascii() and value.isdigit() and len(value) < 11:
        value = int(value)
    return value if type(value) is int and 0 < value <= MAX_NUMBER else 0
