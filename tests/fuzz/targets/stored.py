# SPDX-License-Identifier: Apache-2.0
"""Targets of what other programs and other runs have written: logs, baselines, shards, caches, output of tools."""

from __future__ import annotations

import json
import tempfile
from io import BytesIO
from pathlib import Path
from typing import Any

from fuzz.targets.kit import Entry, parts, refused, ros_package, text_of, workspace

from haros_ci.errors import UserError
from haros_ci.extract.cpp import exact
from haros_ci.extract.launch import xml as launch_xml
from haros_ci.haros_json.documents import PROJECTS, added
from haros_ci.html_page import verdicts
from haros_ci.html_page.pool import Pool
from haros_ci.keeping import kept, kept_json
from haros_ci.linters import declared, rows
from haros_ci.linters.compile_db import flags_by_file
from haros_ci.linters.linter import Batch, Finding, LintOptions, Output
from haros_ci.linters.tool_text import clean
from haros_ci.measuring import facts
from haros_ci.model.declared_tool import OUTPUTS, DeclaredTool
from haros_ci.recordings import jsonl, mcap, ros1, sqlite_pages
from haros_ci.recordings.recording import Cut
from haros_ci.registry import built_in
from haros_ci.results.compact import BaselineFormatError, read_compact, write_compact
from haros_ci.results.known import known_from_sarif
from haros_ci.results.result import Report
from haros_ci.results.sarif_file import SarifError
from haros_ci.results.sarif_reader import read_sarif
from haros_ci.shards import costs
from haros_ci.shards.joining import join
from haros_ci.shards.shard import ShardError
from haros_ci.shards.shard_file import parsed, value_of, written
from haros_ci.syntax import codec
from haros_ci.workspace.cache import DiskCache


def sarif(data: bytes) -> object:
    """A log that is read, remembered, and written again in every format."""
    try:
        runs = read_sarif(data, "a.sarif", root="/nowhere")
    except SarifError as err:
        return refused(err)
    known = known_from_sarif(runs)
    read_compact(write_compact(known).encode(), "b.json")
    from haros_ci.commands.output import FORMATS, Extras

    report = Report(runs=runs)
    view = Extras(source=lambda path: "", flags={"why": True, "sarif_for": "github"}, to_file=True)
    return {name: render(report, view) for name, render in FORMATS.items() if name != "github"}


def baseline(data: bytes) -> object:
    try:
        known = read_compact(data, "b.json")
    except BaselineFormatError as err:
        return refused(err)
    text = write_compact(known)
    assert write_compact(read_compact(text.encode(), "b.json")) == text
    return known


def shards(data: bytes) -> object:
    try:
        shard = parsed(data, "a.shard")
    except ShardError as err:
        return refused(err)
    text = written(shard)
    assert written(parsed(text.encode(), "a.shard")) == text  # answers are written in order
    said = [value_of(each) for each in shard.answers]
    try:
        join([shard])
    except ShardError as err:
        said.append(refused(err))
    return said


def shard_costs(data: bytes) -> object:
    try:
        found = costs.parsed(data)
    except costs.NoCosts as err:
        return refused(err)
    assert costs.parsed(costs.written(found).encode()) == found
    return found


def caches(data: bytes) -> object:
    """A cache's file, and each reader of the values that lie in it."""
    with tempfile.TemporaryDirectory() as scratch:
        Path(scratch, "g-0.json").write_bytes(data)
        store = DiskCache(Path(scratch))
        store.put("g", "a\x0c", "k", [1])
        found = [store.get("g", path, "k") for path in ("a", "b", "c", "d", "e", "f", "g", "h")]
        for number in range(16):
            Path(scratch, f"g-{number:x}.json").write_bytes(data)
        store = DiskCache(Path(scratch))
        for path in ("a", "b", "c", "d"):
            found.append(store.get("g", path, "k"))
            store.put("g", path, "k", [1])
        said = store.flush()
        assert said is None, said
        assert DiskCache(Path(scratch)).get("g", "a", "k") == [1]
        return found


def cached_values(data: bytes) -> object:
    try:
        value: Any = json.loads(data, parse_constant=lambda word: None)
    except (ValueError, RecursionError):
        return None
    answer = rows.decode(value, "a.cpp", lambda tool, rule, path: True, {"a.cpp", "b.cpp"})
    if answer is not None:
        stored = json.loads(json.dumps(rows.encode(answer)))
        again = rows.decode(stored, "a.cpp", lambda tool, rule, path: True, {"a.cpp", "b.cpp"})
        assert again is not None and set(again.results) == set(answer.results)
    measured = facts.from_json(value)
    if measured is not None:
        facts.to_json(measured)
    return (
        answer,
        codec.decoded(data.decode("utf-8", "replace")),
        launch_xml.from_json(value),
        measured,
        _record(value),
        _kept(value),
    )


def _record(value: Any) -> object:
    found = kept.begun(value)
    return found and kept.read(found, lambda consulted: True, {"a.cpp": {1: 2}})


def _kept(value: Any) -> object:
    try:
        return repr(kept_json.from_json(value))
    except kept_json.Unfit as err:
        return str(err)


def history(data: bytes) -> object:
    """The summary of an earlier run, which HAROS's web page shows with that of this one."""
    own = {"timestamps": ["2026-01-01 00:00:00"], "issues": [1]}
    files = {PROJECTS: '[{"id": "p"}]', "p/summary.json": json.dumps({"history": own})}
    text = data.decode("utf-8", "replace")
    try:
        made = added(files, lambda path: text)
    except ValueError as err:
        return refused(err)
    return {path: json.loads(each) for path, each in made.items()}


def compile_database(data: bytes) -> object:
    with tempfile.TemporaryDirectory() as scratch:
        root = Path(scratch).resolve()
        (root / "build").mkdir()
        (root / "include").mkdir()
        (root / "build" / "compile_commands.json").write_bytes(data.replace(b"/ROOT", bytes(root)))
        space = workspace({"a.cpp": b"", "src/b.cpp": b""})
        found = flags_by_file(_at(space, root), LintOptions(root=root))
        for flags in found.values():
            assert all(flag.isprintable() for flag in flags), flags
        return json.dumps(found).replace(str(root), "/ROOT")


def _at(space: Any, root: Path) -> Any:
    from dataclasses import replace

    return replace(space, root=root)


SOURCES = {
    "bot/package.xml": ros_package(),
    "bot/a.cpp": b"int a;\nint \xc3\xa9 = 1;\n",
    "bot/a b.py": b"import os\nx = '\xc3\xa9'; y = os\n",
    "bot/CMakeLists.txt": b"project(bot)\n",
    "bot/a.yaml": b"a: 1\n",
    "bot/a.sh": b"#!/bin/sh\necho $a\n",
    "bot/Dockerfile": b"FROM scratch\n",
    "bot/a.launch": b"<launch/>\n",
    "bot/README.md": b"word\n",
}


def tool_output(data: bytes) -> object:
    """What a tool writes, through its adapter: its name, stdout and stderr in parts called ``out`` and ``err``."""
    name, _, body = data.partition(b"\n")
    streams = parts(body, "out")
    space = workspace(SOURCES)
    adapter = next((each for each in built_in().linters if each.NAME.encode() == name.strip()), None)
    if adapter is None:
        return None
    files = tuple(file for file in space.files if file.language in adapter.LANGUAGES)
    with tempfile.TemporaryDirectory() as scratch:
        group = streams.get("group", b"").decode("utf-8", "replace").strip()
        batch = Batch(space, files, LintOptions(), Path(scratch), group or _GROUPS.get(adapter.NAME, ""))
        try:
            said = tuple(adapter.parse(Output(streams.get("out", b""), streams.get("err", b""), 0), batch))
        except EXPECTED as err:
            return type(err).__name__
    for each in said:
        if isinstance(each, Finding):
            line = each.result.location.line
            assert each.result.rule and (line is None or line >= 1), each
    return said


#: What the runner takes for "the output is not what the tool writes".
EXPECTED = (ValueError, KeyError, IndexError, TypeError, AttributeError, RecursionError)
_GROUPS = {"cppcheck": '["c++", [], []]', "cpplint": '["bot", 120]'}


def declared_output(data: bytes) -> object:
    kind, _, body = data.partition(b"\n")
    words = kind.decode("utf-8", "replace").split()
    output = words[0] if words and words[0] in OUTPUTS else "gcc"
    fields = tuple((key, value) for key, _, value in (word.partition("=") for word in words[1:6]))
    pattern = r"(?P<path>\S+):(?P<line>\d+): (?P<message>.*)"
    tool = DeclaredTool(name="t", argv=("t", "{files}"), files=("**",), output=output, pattern=pattern, fields=fields)
    space = workspace(SOURCES)
    (adapter,) = declared.declared([tool])
    with tempfile.TemporaryDirectory() as scratch:
        batch = Batch(space, space.files, LintOptions(), Path(scratch))
        try:
            said = tuple(adapter.parse(Output(body, b"", 0), batch))
        except EXPECTED as err:
            return type(err).__name__
    for each in said:
        assert isinstance(each, Finding)
        message = each.result.message
        assert message == clean(message) and "\x1b" not in message, message
    return said


def exact_answers(data: bytes) -> object:
    """What the process that holds libclang answers."""
    text = text_of(data, "json") or ""
    return exact.parse(text), exact.failures(text)


_JSON = (b"null", b"true", b"[]", b"{}", b'""', b"1e999", b"-1", b'"a.cpp"', b'"\\ud800"', b'"\\u0000"', b"NaN")
_NAMES = tuple(f"{each.NAME}\n".encode() for each in built_in().linters)


def verdicts_of_recordings(data: bytes) -> object:
    """What a monitor wrote, for the page."""
    text = text_of(data)
    if text is None:
        return None
    try:
        found = verdicts.recorded(text, "verdicts.json")
    except UserError as err:
        return str(err)
    return repr(verdicts.verdicts(Pool(), [found]))


def recordings(data: bytes) -> object:
    """Lines of JSON, the chunks of bags of ROS 1 and of MCAP files, and the pages of SQLite files."""
    found: list[object] = []
    for line in data.splitlines()[:100]:
        try:
            topic, time, message = jsonl.message_of(line)
            found += [topic, time, repr(message)]
        except (jsonl.NoMessage, jsonl.OfService) as err:
            found.append(str(err))
    for read in (ros1.Ros1File(Path("run.bag")).chunk, mcap.McapFile(Path("run.mcap")).chunk):
        topics: dict[str, set[str]] = {}
        try:
            found += [(channel.topic, channel.type, time, raw) for channel, time, raw in read(data, topics)]
        except Cut as cut:
            found.append(str(cut))
    file = mcap.McapFile(Path("run.mcap"))
    try:
        found += [(channel.topic, time) for channel, time, _ in file.records(BytesIO(data), {})]
    except Cut as cut:
        found.append(str(cut))
    try:
        pages = sqlite_pages.Pages(BytesIO(data))
        found += [*pages.others(), *pages.tables()]
    except Cut as cut:
        found.append(str(cut))
    return found


TARGETS = {
    "sarif": Entry(
        sarif,
        "SARIF logs",
        ("results.sarif_reader", "results.sarif_file", "results.sarif_graph_reader", "results.sarif_uri"),
        _JSON,
    ),
    "recordings": Entry(
        recordings,
        "recordings in lines of JSON, of ROS 1, of MCAP and of SQLite",
        ("recordings.jsonl", "recordings.ros1", "recordings.mcap", "recordings.sqlite_pages"),
        (
            b'{"topic": "/a", "time": 1}\n',
            b"op=\x02",
            b"conn=\x00\x00\x00\x00",
            b"time=\x00\x00\x00\x00\x00\x00\x00\x00",
            b"topic=/a",
            b"SQLite format 3\0\2\0".ljust(59, b"\0") + b"\1".ljust(41, b"\0") + b"\r\0\0\0\1\1\0\0\0\x80",
        ),
    ),
    "verdicts": Entry(
        verdicts_of_recordings,
        "verdicts of a monitor",
        ("html_page.verdicts",),
        (*_JSON, b'{"recording": {}, "properties": []}'),
    ),
    "baseline": Entry(baseline, "compact baselines", ("results.compact",), _JSON),
    "shards": Entry(shards, "shard files", ("shards.shard_file", "results.values", "shards.joining"), _JSON),
    "shard-costs": Entry(shard_costs, "costs of shards", ("shards.costs",), _JSON),
    "caches": Entry(caches, "files of the cache", ("workspace.cache",), _JSON),
    "cached-values": Entry(
        cached_values,
        "values of the cache",
        ("linters.rows", "syntax.codec", "keeping.kept", "keeping.kept_json"),
        _JSON,
    ),
    "history": Entry(history, "the summary of HAROS's web page", ("haros_json.summary", "haros_json.documents"), _JSON),
    "compile-database": Entry(compile_database, "compile_commands.json", ("linters.compile_db",), _JSON),
    "tool-output": Entry(
        tool_output, "what linters write", ("linters",), (*_NAMES, b"\n@@ err\n", b"@@ out\n", b"./bot/a.cpp:1:")
    ),
    "declared-output": Entry(
        declared_output, "what declared tools write", ("linters.tool_text", "linters.tool_xml"), _JSON
    ),
    "exact-answers": Entry(exact_answers, "answers of the exact tier", ("extract.cpp.exact",), _JSON),
}
