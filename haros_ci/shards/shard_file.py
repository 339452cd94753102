# SPDX-License-Identifier: Apache-2.0
"""Shard files: JSON Lines, a header first and a count last (docs/shards.md). Reading them is bounded and believes nothing."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from haros_ci.regex import regex
from haros_ci.results.confined import SENTENCES
from haros_ci.results.values import LARGEST, NotThat, is_inside, plain, read
from haros_ci.shards.shard import SIDES, Failed, Had, Header, RecordedAnswer, Shard, ShardError, WorkspaceRun

FORMAT = 1
#: Bytes of a file, and of one line of it.
MAX_BYTES = 500_000_000
MAX_LINE = 64_000_000
#: Brackets and commas of a line bound what its parser can allocate.
_MAX_VALUES = 8_000_000

_STRING = r'"(?:[^"\\]|\\.)*"'
_ANSWER = regex(rf'\["answer",({_STRING}),({_STRING}),"([0-9a-f]{{64}})",([0-9]{{1,15}}|null),(.*)\]')
_LONG_NUMBER = regex(r"[0-9]{400}")
_KEY = regex(r"[0-9a-f]{64}")


def written(shard: Shard) -> str:
    """The text of a shard file, ASCII: each answer's line as ``_ANSWER`` expects it."""
    return "\n".join(_lines(shard)) + "\n"


def _lines(shard: Shard) -> Iterator[str]:
    count = 2 + len(shard.answers) + len(shard.failures) + len(shard.wholes)
    head = plain(shard.header)
    yield _json({"haros-ci-shard": FORMAT, **head, "settings": dict(sorted(shard.header.settings.items()))})
    for answer in sorted(shard.answers, key=lambda s: (s.tool, s.path, s.key)):
        names = f'["answer",{_json(answer.tool)},{_json(answer.path)},"{answer.key}"'
        yield f"{names},{'null' if answer.cost is None else answer.cost},{answer.value}]"
    for failed in sorted(shard.failures, key=lambda f: (f.tool, f.message, f.keys)):
        yield _json(["failure", plain(failed)])
    for whole in shard.wholes:
        yield _json(["whole", plain(whole)])
    yield _json({"lines": count})


def parsed(data: bytes, name: str) -> Shard:
    """The shard that the bytes *data* of the file *name* hold. Raises ShardError."""
    if len(data) > MAX_BYTES:
        raise ShardError(f"{name}: larger than {MAX_BYTES // 1_000_000} MB")
    try:
        lines = data.decode("ascii").split("\n")
    except UnicodeDecodeError:
        raise _no_shard(name) from None
    header = _header(lines[0], name)
    last = _loaded(lines[-2], name, len(lines) - 1) if len(lines) > 2 and not lines[-1] else None
    if last != {"lines": len(lines) - 1}:
        raise ShardError(f"{name}: is cut short", help="write or upload it anew")
    answers: list[RecordedAnswer] = []
    failures: list[Failed] = []
    wholes: list[WorkspaceRun] = []
    for number, line in enumerate(lines[1:-2], 2):
        try:
            match = _ANSWER.fullmatch(line) if len(line) <= MAX_LINE else None
            if match is not None:
                answers.append(_answer(match))
                continue
            row = _loaded(line, name, number)
            kind = row[0] if isinstance(row, list) and len(row) == 2 else None
            if kind == "failure":
                failures.append(_failed(read(Failed, row[1])))
            elif kind == "whole":
                wholes.append(_whole(read(WorkspaceRun, row[1])))
            else:
                raise NotThat("neither an answer nor a failure nor a run")
        except NotThat as err:
            raise ShardError(f"{name}:{number}: {err}", help="this is not what haros-ci check --shard writes") from err
    return Shard(header, tuple(answers), tuple(failures), tuple(wholes), name)


def _header(line: str, name: str) -> Header:
    """The first line; the format is looked at first, as another may say everything else in another way."""
    if not line.startswith('{"haros-ci-shard":'):
        raise _no_shard(name)
    found = _loaded(line, name, 1)
    format = found.pop("haros-ci-shard", None)
    if format != FORMAT:
        shown = format if isinstance(format, int) else "?"
        raise ShardError(f"{name}: a shard file of format {shown}, and this haros-ci reads format {FORMAT}", help=SAME)
    try:
        settings = found.pop("settings", None)
        if not isinstance(settings, dict) or not all(isinstance(v, str) for v in settings.values()):
            raise NotThat("no settings")
        if not isinstance(found.get("tools"), list):
            raise NotThat("no tools")
        tools = tuple(read(Had, tool) for tool in found.pop("tools"))
        members = {key: read(type_, found.pop(key, None)) for key, type_ in _MEMBERS.items()}
        if found:
            raise NotThat("unknown members")
        if any(tool.side not in SIDES for tool in tools):
            raise NotThat("a side that is neither head nor base")
        header = Header(settings=settings, tools=tools, **members)
        if not 1 <= header.number <= header.of:
            raise NotThat("no number of a shard")
        if header.confined not in SENTENCES:
            raise NotThat("no way to confine linters")
    except NotThat as err:
        raise ShardError(f"{name}:1: {err}", help="this is not what haros-ci check --shard writes") from err
    return header


#: Members of the header that stand for themselves.
_MEMBERS: dict[str, Any] = {
    "version": str,
    "number": int,
    "of": int,
    "workspace": str,
    "base": str | None,
    "plan": str,
    "confined": str,
}
#: Under whose name the results of a whole stand.
_SPEAKS = {"architecture": "haros-ci", "structure": "metrics"}
SAME = "use the same version of haros-ci for the shards and for merge"


def _no_shard(name: str) -> ShardError:
    return ShardError(f"{name}: not a shard file", help="give the files that haros-ci check --shard has written")


def _answer(match: re.Match[str]) -> RecordedAnswer:
    try:
        tool, path = json.loads(match[1]), json.loads(match[2])
    except ValueError as err:
        raise NotThat("a name that is not JSON text") from err
    if not is_inside(path):
        raise NotThat("a path that leads out of the workspace")
    return RecordedAnswer(tool, path, match[3], None if match[4] == "null" else int(match[4]), match[5])


def _failed(failed: Failed) -> Failed:
    if not all(map(is_inside, failed.paths)):
        raise NotThat("a path that leads out of the workspace")
    if not all(map(_KEY.fullmatch, failed.keys)):
        raise NotThat("a key that is none")
    return failed


def _whole(whole: WorkspaceRun) -> WorkspaceRun:
    if whole.side not in SIDES or (whole.cost is not None and not 0 <= whole.cost <= LARGEST):
        raise NotThat("a run of no side")
    if any(result.tool != _SPEAKS.get(whole.name) for result in whole.run.results):
        raise NotThat("a result of another tool")
    return whole


def value_of(answer: RecordedAnswer) -> object | None:
    """The answer itself, None if it is no JSON: the reader of rows refuses that, too."""
    try:
        value: object = _bounded(answer.value)
    except (ValueError, RecursionError):
        return None
    return value


def _loaded(line: str, name: str, number: int) -> Any:
    try:
        return _bounded(line)
    except (ValueError, RecursionError):
        raise ShardError(
            f"{name}:{number}: not JSON within bounds", help="this is not what haros-ci check --shard writes"
        ) from None


def _bounded(text: str) -> Any:
    if len(text) > MAX_LINE or text.count("[") + text.count("{") + text.count(",") > _MAX_VALUES:
        raise ValueError("too large")
    if _LONG_NUMBER.search(text):
        raise ValueError("a number of a size that none has")
    return json.loads(text, parse_constant=_refuse)


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is not JSON")


def _json(value: object) -> str:
    return json.dumps(value, separators=(",", ":"), allow_nan=False)


__all__ = ["FORMAT", "MAX_BYTES", "parsed", "value_of", "written"]
