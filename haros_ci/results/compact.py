# SPDX-License-Identifier: Apache-2.0
"""The compact baseline file: a version line, then one known finding a line, sorted, without line numbers or counts.

Two branches that add or drop findings touch different lines, so that git merges them.
"""

from __future__ import annotations

import json
from collections.abc import Iterable

from haros_ci.regex import regex
from haros_ci.results.fingerprint import MOST_NAMES, names_digest
from haros_ci.results.known import KnownFinding

VERSION_KEY = "haros-ci-baseline"
VERSION = 1
MAX_BYTES = 64_000_000
MAX_ENTRIES = 250_000

#: Keys in the order they are written, with the field they hold; an empty field is left out.
_STRINGS = {
    "path": "path",
    "tool": "tool",
    "rule": "rule",
    "scope": "scope",
    "message": "template",
    "text": "text",
    "shape": "shape",
    "before": "before",
    "after": "after",
    "roles": "roles",
    "reason": "reason",
}
_REQUIRED = ("path", "tool", "rule")
_HASHES = frozenset({"text", "shape", "before", "after", "roles"})
_HASH = regex(r"[0-9a-f]{16}\Z")
_LONGEST = 4_000
_ANEW = "restore it from git, or write it anew with 'haros-ci baseline create'"
_CONFLICT = ("<<<<<<<", "|||||||", "=======", ">>>>>>>")


class BaselineFormatError(ValueError):
    """*message* says what is wrong in line *line* (1-based) of a compact baseline and what to do."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(f"line {line}: {message}")
        self.line = line
        self.message = message


def write_compact(known: Iterable[KnownFinding]) -> str:
    """The file's text: the same findings give the same bytes."""
    lines = (json.dumps(_entry(entry)) for entry in sorted(known, key=lambda entry: entry.sort_key))
    return "\n".join((json.dumps({VERSION_KEY: VERSION}), *dict.fromkeys(lines), ""))


def read_compact(data: bytes, name: str) -> tuple[KnownFinding, ...]:
    """The known findings in the bytes *data* of the file *name*. Raises BaselineFormatError."""
    if len(data) > MAX_BYTES:
        raise BaselineFormatError(1, f"{name} is larger than {MAX_BYTES // 1_000_000} MB, which no baseline is")
    try:
        lines = data.decode("utf-8").split("\n")
    except UnicodeDecodeError as err:
        raise BaselineFormatError(data.count(b"\n", 0, err.start) + 1, f"not UTF-8; {_ANEW}") from None
    if len(lines) > MAX_ENTRIES:
        raise BaselineFormatError(MAX_ENTRIES, f"more than {MAX_ENTRIES} lines, which no baseline has")
    entries: dict[KnownFinding, None] = {}
    versioned = False
    for number, line in enumerate(lines, 1):
        if line.startswith(_CONFLICT):
            raise BaselineFormatError(
                number, "a merge conflict; keep the lines of both sides, delete the markers, then run "
                "'haros-ci baseline update'"
            )  # fmt: skip
        if not line.strip():
            continue
        fields = _object(line, number)
        if not versioned:
            _check_version(fields, number)
            versioned = True
        else:
            entries[_known(fields, number)] = None
    if not versioned:
        raise BaselineFormatError(1, f"the file is empty; {_ANEW}")
    return tuple(sorted(entries, key=lambda entry: entry.sort_key))


def _entry(known: KnownFinding) -> dict[str, object]:
    fields: dict[str, object] = {key: getattr(known, field) for key, field in _STRINGS.items() if getattr(known, field)}
    if known.subject:
        fields["subject"] = list(known.subject)
    if known.occurrence != 1:
        fields["occurrence"] = known.occurrence
    return fields


def _object(line: str, number: int) -> dict[str, object]:
    try:
        value = json.loads(line)
    except (ValueError, RecursionError):
        raise BaselineFormatError(number, f"not a JSON object; {_ANEW}") from None
    if not isinstance(value, dict):
        raise BaselineFormatError(number, f"not a JSON object; {_ANEW}")
    return value


def _check_version(fields: dict[str, object], number: int) -> None:
    version = fields.get(VERSION_KEY)
    if version is None:
        raise BaselineFormatError(number, f'the first line must be {{"{VERSION_KEY}": {VERSION}}}')
    if version != VERSION or isinstance(version, bool) or len(fields) != 1:
        raise BaselineFormatError(number, f"format version {version!s:.20}; this haros-ci reads {VERSION}")


def _known(fields: dict[str, object], number: int) -> KnownFinding:
    strings: dict[str, str] = {}
    occurrence = 1
    subject: tuple[str, ...] = ()
    for key, value in fields.items():
        if key == "occurrence":
            if not isinstance(value, int) or isinstance(value, bool) or not 0 < value < 10**9:
                raise BaselineFormatError(number, "'occurrence' is not a number from 1 on")
            occurrence = value
        elif key == "subject":
            subject = _names(value, number)
        elif key not in _STRINGS:
            names = ", ".join((*_STRINGS, "subject", "occurrence"))
            raise BaselineFormatError(number, f"unknown key '{key:.40}'; known are {names}")
        elif not isinstance(value, str) or len(value) > _LONGEST:
            raise BaselineFormatError(number, f"'{key}' is not a text of at most {_LONGEST} characters")
        elif key in _HASHES and value and not _HASH.match(value):
            raise BaselineFormatError(number, f"'{key}' is not a hash of 16 hexadecimal digits")
        else:
            strings[_STRINGS[key]] = value
    for key in _REQUIRED:
        if not strings.get(key):
            raise BaselineFormatError(number, f"'{key}' is missing")
    if strings["path"].startswith("/") or ".." in strings["path"].split("/"):
        raise BaselineFormatError(number, "'path' is not relative to the workspace root")
    return KnownFinding(
        tool=strings["tool"],
        rule=strings["rule"],
        path=strings["path"],
        scope=strings.get("scope", ""),
        text=strings.get("text", ""),
        shape=strings.get("shape", ""),
        before=strings.get("before", ""),
        after=strings.get("after", ""),
        template=strings.get("template", ""),
        occurrence=occurrence,
        names=names_digest(subject),
        roles=strings.get("roles", ""),
        subject=subject,
        reason=strings.get("reason", ""),
    )


def _names(value: object, number: int) -> tuple[str, ...]:
    names = tuple(name for name in value if isinstance(name, str) and name) if isinstance(value, list) else ()
    if not isinstance(value, list) or len(names) != len(value) or len(names) > MOST_NAMES:
        raise BaselineFormatError(number, f"'subject' is not a list of at most {MOST_NAMES} names")
    return names
