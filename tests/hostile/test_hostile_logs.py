# SPDX-License-Identifier: Apache-2.0
"""Logs and baseline files of hostile origin: what cannot be read is refused, what can be read harms no reader."""

from __future__ import annotations

import gzip
import json
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import pytest
from hostile_kit import CONTROL, CONTROL_FINDING, Trap, assert_harmless, assert_the_rest_is_analysed

EVIL = "\x1b]52;c;x\x07\u202e\n::error::pwned\r##[error]x %0A|`<img src=x onerror=1>@team [a](javascript:1) ![b](c)"


def log(*results: object, **more: object) -> dict[str, Any]:
    run = {"tool": {"driver": {"name": "other"}}, "results": list(results), **more}
    return {"version": "2.1.0", "runs": [run]}


def result(
    uri: object = CONTROL, line: object = 2, rule: object = "r", text: object = "A text.", **more: object
) -> dict[str, Any]:
    place = {"physicalLocation": {"artifactLocation": {"uri": uri}, "region": {"startLine": line}}}
    return {"ruleId": rule, "message": {"text": text}, "locations": [place], **more}


def dumped(value: object) -> bytes:
    return json.dumps(value).encode()


@dataclass(frozen=True)
class Case:
    """A file; *code* is the run's with it as ``--import`` and as ``--baseline``, *says* stands in stderr or a notice.

    *code* 1 means that the file is read, less what is wrong in it.
    """

    name: str
    data: bytes
    code: int
    says: str = ""


WRONG: tuple[object, ...] = (None, True, -1, 1e308, "x", [], {}, [None], {"a": None}, [[]], {"text": 3})
FIELDS = "ruleId ruleIndex rule level kind message locations relatedLocations suppressions partialFingerprints properties".split()
TYPES = [result(**{field: value}) for field in FIELDS for value in WRONG] + list(WRONG)
TYPES += (
    [result(uri=value) for value in WRONG]
    + [result(line=value) for value in WRONG]
    + [result(text=value) for value in WRONG]
)
OUTSIDE = [
    "../outside/secret.py",
    "/etc/passwd",
    "file:///etc/passwd",
    "file://host/x",
    "..",
    "a/../../x",
    "%2e%2e/x",
    "C:\\x",
    "\\\\h\\x",
]
OUTSIDE += ["https://example.org/x", "javascript:x", "a\0b", "", "x" * 5_000, "..%2f..%2fetc", "/" * 50]

REFUSED = [
    Case("nothing", b"", 2),
    Case("no JSON", b"::error::x\x1b[31m##[error]", 2),
    Case("half of it", dumped(log(result()))[:60], 2),
    Case("not UTF-8", b'{"version": "2.1.0", "runs": [\xff]}', 2, "not UTF-8"),
    Case("compressed", gzip.compress(dumped(log(result()))), 2),
    Case("binary", b"\x7fELF\0\0\0", 2),
    Case("a list", b'["runs"]', 2),
    Case("another version", b'{"version": "1.0.0\\u001b[31m", "runs": []}', 2, "not a SARIF 2.1.0 log"),
    Case("no runs", b'{"version": "2.1.0", "runs": null}', 2, "'runs' is not an array"),
    Case("runs that are none", b'{"version": "2.1.0", "runs": [null, 1]}', 2, "tool.driver.name is missing"),
    Case("deep", b'{"version": "2.1.0", "runs": ' + b"[" * 100_000 + b"]" * 100_000 + b"}", 2),
    Case("deep objects", b'{"version": "2.1.0", "runs": ' + b'{"a":' * 100_000 + b"1" + b"}" * 100_000 + b"}", 2),
    Case("many values", b'{"version": "2.1.0", "runs": [' + b"[]," * 2_100_000 + b"[]]}", 2, "too many values"),
    Case(
        "many runs", dumped({"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "x"}}}] * 200}), 2, "at most 100"
    ),
    Case(
        "many results", b'{"version": "2.1.0", "runs": [{"results": [' + b"0," * 300_000 + b"0]}]}", 2, "at most 250000"
    ),
    Case("a long number", b'{"version": "2.1.0", "runs": [' + b"9" * 10_000 + b"]}", 2),
]
READ = [
    Case("no results", b'{"version": "2.1.0", "runs": []}', 1),
    Case("infinite numbers", dumped(log(result())).replace(b'"startLine": 2', b'"startLine": 1e999'), 1),
    Case("not a number", dumped(log(result())).replace(b'"startLine": 2', b'"startLine": NaN'), 1),
    Case("keys twice", dumped(log(result())).replace(b'"runs"', b'"runs": 1, "version": "2.1.0", "runs"'), 1),
    Case("wrong types everywhere", dumped(log(*TYPES, invocations=[1, {"toolExecutionNotifications": 3}], artifacts={})), 1),
    Case("places outside", dumped(log(*(result(uri=uri) for uri in OUTSIDE))), 1, "stand outside the workspace"),
    Case(
        "bases that turn in a circle",
        dumped(log(result(), originalUriBaseIds={"A": {"uri": "a/", "uriBaseId": "B"}, "B": {"uriBaseId": "A"}})).replace(
            b'"uri": "control.py"', b'"uriBaseId": "A", "uri": "control.py"'
        ),
        1,
    ),
    Case("a base at the root", dumped(log(result(uri="/etc/passwd"), originalUriBaseIds={"A": {"uri": "file:///"}})), 1),
    Case("hostile text", dumped(log(result(text=EVIL, rule=EVIL), tool={"driver": {"name": EVIL, "fullName": EVIL, "version": EVIL}})), 1),
    Case("a hostile place", dumped(log(result(uri="a%1b%0a::error::%E2%80%AE##[error].py", relatedLocations=[
        {"message": {"text": EVIL}, "physicalLocation": {"artifactLocation": {"uri": "x%0a::error::y"}}}
    ]))), 1),
    Case("hostile notifications", dumped(log(invocations=[{"executionSuccessful": True, "toolExecutionNotifications": [
        {"message": {"text": EVIL}, "level": EVIL}, {"message": {"text": EVIL}, "level": "error"}
    ]}])), 1),
    Case("hostile rules", dumped(log(result(), tool={"driver": {"name": "x", "rules": [
        {"id": "r", "name": EVIL, "shortDescription": {"text": EVIL}, "helpUri": "javascript:alert(1)", "help": {"markdown": EVIL},
         "properties": {"tags": [EVIL], "security-severity": EVIL, "precision": EVIL}, "deprecatedIds": [EVIL]}
    ]}})), 1),
    Case("hostile suppressions", dumped(log(result(suppressions=[{"kind": EVIL, "justification": EVIL}]))), 1),
    Case("arguments without end", dumped(log(result(text="{0}" * 2_000))).replace(b'"A text."', b'""'), 1),
    Case("links without end", dumped(log(result(text="[" * 5_000 + "](1)" * 500))), 1),
    Case("a text of 5 MB", dumped(log(result(text="a" * 5_000_000, rule="b" * 100_000))), 1),
]  # fmt: skip


def assert_read(trap: Trap, case: Case, *arguments: str) -> None:
    outcome = trap.run(*arguments)
    assert outcome.code == case.code, (outcome.stderr, case.code)
    assert outcome.says(case.says), outcome.stderr
    assert_harmless(trap, outcome)
    if case.code == 2:
        assert outcome.stderr.startswith("error: ") and "help: " in outcome.stderr
    else:
        assert_the_rest_is_analysed(outcome)
        assert not any(path.startswith(("/", "..")) for path, _, _ in outcome.findings())


@pytest.mark.parametrize("case", [*REFUSED, *READ], ids=lambda case: case.name)
def test_imported(case: Case, trap: Trap) -> None:
    trap.write("other.sarif", case.data)
    assert_read(trap, case, "--import=other.sarif")


@pytest.mark.parametrize(
    "case", [REFUSED[1], REFUSED[4], *REFUSED[10:13], *READ[4:6], READ[8]], ids=lambda case: case.name
)
def test_as_baseline(case: Case, trap: Trap) -> None:
    """The same readers; a baseline that cannot be read is never an empty one."""
    trap.write("known.sarif", case.data)
    assert_read(trap, replace(case, says=""), "--baseline=known.sarif")


HEAD = b'{"haros-ci-baseline": 1}\n'
ENTRY = b'{"path": "control.py", "tool": "pylint", "rule": "undefined-variable"}\n'
COMPACT = [
    Case("an empty file", b"", 2),
    Case("no version", ENTRY, 2, "1: the first line must be"),
    Case("another version", HEAD.replace(b"1", b"99"), 2, "1: format version 99"),
    Case("a version that is none", HEAD.replace(b"1", b'"\\u001b[31m::error::x"'), 2, "1: format version"),
    Case("merge markers", HEAD + b"<<<<<<< ours\n" + ENTRY + b"=======\n" + ENTRY + b">>>>>>> theirs\n", 2, "2: a merge conflict"),
    Case("no object", HEAD + b"[]\n", 2, "2: not a JSON object"),
    Case("deep", HEAD + b"[" * 100_000 + b"\n", 2, "2: not a JSON object"),
    Case("an unknown key", HEAD + ENTRY.replace(b'"tool"', b'"\\u001b[31m##[error]"'), 2, "2: unknown key"),
    Case("wrong types", HEAD + ENTRY.replace(b'"control.py"', b"[1]"), 2, "2: 'path' is not a text"),
    Case("a number beyond all", HEAD + ENTRY.replace(b"}", b', "occurrence": 1e999}'), 2, "2: 'occurrence' is not a number"),
    Case("a path that leads out", HEAD + ENTRY.replace(b"control.py", b"../../etc/passwd"), 2, "2: 'path' is not relative"),
    Case("an absolute path", HEAD + ENTRY.replace(b"control.py", b"/etc/passwd"), 2, "2: 'path' is not relative"),
    Case("a long text", HEAD + ENTRY.replace(b"control.py", b"a" * 10_000), 2, "2: 'path' is not a text of at most"),
    Case("many lines", HEAD + b"\n" * 300_000, 2, "more than 250000 lines"),
    Case("not UTF-8", HEAD + b"\xff\n", 2, "2: not UTF-8"),
    Case("hostile text", HEAD + dumped({"path": "gone\x1b::error::x.py", "tool": EVIL, "rule": EVIL, "message": EVIL, "reason": EVIL}), 1),
]  # fmt: skip


@pytest.mark.parametrize("case", COMPACT, ids=lambda case: case.name)
def test_compact_baselines(case: Case, trap: Trap) -> None:
    trap.write(".haros-ci-baseline.jsonl", case.data)
    assert_read(trap, case, "--why")
    assert_harmless_line_by_line(trap.command("baseline", "show"))


def assert_harmless_line_by_line(text: str) -> None:
    assert (
        "\x1b" not in text
        and "##[" not in text
        and not any(line.lstrip().startswith("::") for line in text.splitlines())
    )


@pytest.mark.parametrize("option", ["--import", "--baseline"])
@pytest.mark.parametrize(
    ("name", "build"),
    [
        ("a pipe", lambda t: os.mkfifo(t.root / "log")),
        ("a directory", lambda t: (t.root / "log").mkdir()),
        ("nothing there", lambda t: None),
        ("a link that leads out", lambda t: (t.root / "log").symlink_to(t.outside / "victim.json")),
        ("a device", lambda t: (t.root / "log").symlink_to("/dev/zero")),
        ("100 MB", lambda t: t.sparse("log", 100_000_000)),
    ],
)
def test_what_is_no_file(name: str, build: Callable[[Trap], object], option: str, trap: Trap) -> None:
    build(trap)
    outcome = trap.run(f"{option}=log")
    assert outcome.code == 2 and outcome.stderr.startswith("error: log: ")
    assert_harmless(trap, outcome)


def test_a_pipe_in_place_of_the_baseline(trap: Trap) -> None:
    """What is used without being named is a file or nothing."""
    os.mkfifo(trap.root / ".haros-ci-baseline.jsonl")
    outcome = trap.run()
    assert outcome.code == 1 and outcome.report["baseline"] is None
    assert_the_rest_is_analysed(outcome)


def test_a_log_cannot_speak_for_our_tools(trap: Trap) -> None:
    """An imported log that calls itself pylint adds to what is found and takes nothing away."""
    trap.write(
        "other.sarif", dumped(log(tool={"driver": {"name": "pylint"}}, invocations=[{"executionSuccessful": True}]))
    )
    outcome = trap.run("--import=other.sarif")
    assert outcome.code == 1 and CONTROL_FINDING in outcome.findings()


def test_a_log_of_a_tool_that_failed(trap: Trap) -> None:
    """Trouble of an imported tool is trouble of the run."""
    trap.write("other.sarif", dumped(log(invocations=[{"executionSuccessful": False}])))
    outcome = trap.run("--import=other.sarif")
    assert outcome.code == 3
    assert trap.run("--import=other.sarif", "--allow-tool-failure=other").code == 1
