# SPDX-License-Identifier: Apache-2.0
"""SARIF logs of other tools, honest and hostile."""

from __future__ import annotations

import json
from typing import Any

import pytest

from haros_ci.model.location import Location
from haros_ci.results.known import known_from_sarif
from haros_ci.results.result import Run
from haros_ci.results.rule import Level
from haros_ci.results.sarif_file import SarifError
from haros_ci.results.sarif_reader import read_sarif


def result(uri: object = "a.cpp", **changes: Any) -> dict[str, Any]:
    place = {
        "artifactLocation": {"uri": uri},
        "region": {"startLine": 3, "startColumn": 5, "endLine": 3, "endColumn": 9},
    }
    return {"ruleId": "r", "message": {"text": "Bad."}, "locations": [{"physicalLocation": place}], **changes}


def log(*results: object, driver: dict[str, Any] | None = None, **run: Any) -> bytes:
    tool = {"driver": {"name": "other", **(driver or {})}}
    return json.dumps({"version": "2.1.0", "runs": [{"tool": tool, "results": list(results), **run}]}).encode()


def read(*results: object, root: str = "", **run: Any) -> Run:
    (found,) = read_sarif(log(*results, **run), "x.sarif", root=root)
    return found


def test_a_plain_log() -> None:
    run = read(
        result(level="error"), driver={"version": "1.2", "semanticVersion": "1.2.3", "informationUri": "https://x"}
    )
    assert (run.tool.name, run.tool.version, run.imported, run.successful) == ("other", "1.2.3", True, True)
    (found,) = run.results
    assert (found.full_id, found.level, found.message) == ("other:r", Level.ERROR, "Bad.")
    assert found.location == Location("a.cpp", 3, 5, 3, 9)
    assert (run.notifications, run.analysed, found.identity) == ((), {"a.cpp"}, None)


PATHS = [
    ("src/a.cpp", "src/a.cpp"),
    ("./src//a.cpp", "src/a.cpp"),
    ("a%20b/%C3%A9.cpp", "a b/é.cpp"),
    ("src\\a.cpp", "src/a.cpp"),
    ("file:///ws/src/a.cpp", "src/a.cpp"),
    ("file://localhost/ws/src/a%20b.cpp", "src/a b.cpp"),
    ("/ws/src/a.cpp", "src/a.cpp"),
    ("src/a.cpp?x#y", "src/a.cpp"),
    ("..a/b..c", "..a/b..c"),
    ("a%25b", "a%b"),
]
NO_PATHS = [
    "../a.cpp", "src/../../a.cpp", "src/%2e%2e/%2e%2e/a.cpp", "..\\a.cpp", "file:///etc/passwd", "/etc/passwd",
    "file:///ws/../etc/passwd", "file:///wsx/a.cpp", "file:///ws", "file://host/ws/a.cpp", "http://x/ws/a.cpp",
    "C:/ws/a.cpp", "C:\\ws\\a.cpp", "\\\\host\\a", "%2Fetc/passwd", "a%00b", "", ".", None, 3, ["a.cpp"], "a" * 5000,
]  # fmt: skip


@pytest.mark.parametrize(("uri", "path"), PATHS)
def test_paths(uri: str, path: str) -> None:
    assert [r.location.path for r in read(result(uri), root="/ws").results] == [path]


@pytest.mark.parametrize("uri", NO_PATHS)
def test_places_outside_are_left_out_and_told(uri: object) -> None:
    run = read(result(uri), result("b.cpp"), root="/ws")
    assert [r.location.path for r in run.results] == ["b.cpp"]
    (note,) = run.notifications
    assert (note.level, note.tool) == (Level.WARNING, "other")
    assert "1 result left out: they stand outside the workspace or nowhere" in note.message


BASES: list[tuple[dict[str, Any], dict[str, Any], str]] = [
    ({"uri": "a.cpp", "uriBaseId": "SRCROOT"}, {}, "a.cpp"),
    ({"uri": "a.cpp", "uriBaseId": "SRCROOT"}, {"SRCROOT": {"uri": "file:///home/x/"}}, "a.cpp"),
    (
        {"uri": "a.cpp", "uriBaseId": "S"},
        {"S": {"uri": "src/", "uriBaseId": "R"}, "R": {"uri": "file:///x/"}},
        "src/a.cpp",
    ),
    ({"uri": "file:///x/a.cpp"}, {"R": {"uri": "file:///x/"}}, "a.cpp"),
    ({"uri": "a.cpp", "uriBaseId": "S"}, {"S": {"uriBaseId": "S"}}, "a.cpp"),
    ({"uri": "a.cpp", "uriBaseId": 3}, {}, "a.cpp"),
]


@pytest.mark.parametrize(("place", "bases", "path"), BASES)
def test_bases(place: dict[str, Any], bases: dict[str, Any], path: str) -> None:
    entry = result(locations=[{"physicalLocation": {"artifactLocation": place}}])
    assert [r.location for r in read(entry, originalUriBaseIds=bases).results] == [Location(path)]


def test_artifacts_by_index() -> None:
    entry = result(locations=[{"physicalLocation": {"artifactLocation": {"index": 1}}}])
    artifacts = [{"location": {"uri": "x"}, "roles": ["analysisTarget"]}, {"location": {"uri": "b.cpp"}}]
    run = read(entry, artifacts=artifacts)
    assert ([r.location.path for r in run.results], run.analysed) == (["b.cpp"], {"b.cpp", "x"})


LEVELS: list[tuple[dict[str, Any], Level | None]] = [
    ({}, Level.NOTE),
    ({"level": "error"}, Level.ERROR),
    ({"level": "none"}, Level.NOTE),
    ({"level": "fatal"}, Level.WARNING),
    ({"level": 3}, Level.WARNING),
    ({"ruleId": "unlisted"}, Level.WARNING),
    ({"kind": "fail"}, Level.NOTE),
    ({"kind": "review", "level": "none"}, Level.NOTE),
    ({"kind": "pass"}, None),
    ({"kind": "notApplicable"}, None),
    ({"kind": "informational"}, None),
    ({"baselineState": "absent"}, None),
]


@pytest.mark.parametrize(("changes", "level"), LEVELS)
def test_levels(changes: dict[str, Any], level: Level | None) -> None:
    rule = {"id": "r", "defaultConfiguration": {"level": "note"}}
    run = read(result(**changes), driver={"rules": [rule]})
    assert [r.level for r in run.results] == ([] if level is None else [level])
    assert run.notifications == ()


RULES: list[tuple[dict[str, Any], str]] = [
    ({"ruleId": "q"}, "q"),
    ({"ruleId": None, "ruleIndex": 0}, "r"),
    ({"ruleId": None, "rule": {"id": "s"}}, "s"),
    ({"ruleId": None, "rule": {"index": 0}}, "r"),
    ({"ruleId": None, "rule": {"index": 0, "toolComponent": {"index": 0}}}, "extended"),
    ({"ruleId": "r/sub", "ruleIndex": 0}, "r"),
    ({"ruleId": "q", "ruleIndex": 99}, "q"),
]


@pytest.mark.parametrize(("changes", "rule"), RULES)
def test_rules_by_name_and_position(changes: dict[str, Any], rule: str) -> None:
    data = json.loads(log(result(**changes), driver={"rules": [{"id": "r"}]}))
    data["runs"][0]["tool"]["extensions"] = [{"name": "e", "rules": [{"id": "extended"}]}]
    (run,) = read_sarif(json.dumps(data).encode(), "x")
    assert [r.rule for r in run.results] == [rule]


def test_descriptors() -> None:
    rule = {
        "id": "r", "shortDescription": {"text": "S"}, "help": {"text": "t", "markdown": "m"}, "helpUri": "https://h",
        "deprecatedIds": ["old"], "properties": {"tags": ["a", 3], "precision": "low", "security-severity": "7.5"},
    }  # fmt: skip
    (found,) = read(driver={"rules": [rule, {"id": "r"}, {"no": "id"}, 3]}).rules
    assert (found.summary, found.help, found.help_uri, found.deprecated_ids) == ("S", "m", "https://h", ("old",))
    assert (found.tags, found.precision, found.security_severity) == (("a",), "low", "7.5")
    (found,) = read(driver={"rules": [{"id": "r", "properties": {"precision": "x", "security-severity": 7.5}}]}).rules
    assert (found.summary, found.precision, found.security_severity) == ("r", "high", None)


MESSAGES: list[tuple[dict[str, Any], str]] = [
    ({"text": "See [this](1) and [that](-2)."}, "See this and that."),
    ({"text": "a\\[0\\]"}, "a[0]"),
    ({"text": "{0} of {1} {{2}} {9}", "arguments": ["1", "2"]}, "1 of 2 {2} {9}"),
    ({"text": "{0}"}, "{0}"),
    ({"id": "m", "arguments": ["x"]}, "From the rule: x"),
]


@pytest.mark.parametrize(("message", "text"), MESSAGES)
def test_messages(message: dict[str, Any], text: str) -> None:
    rules = [{"id": "r", "messageStrings": {"m": {"text": "From the rule: {0}"}}}]
    assert [r.message for r in read(result(message=message), driver={"rules": rules}).results] == [text]


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"ruleId": 3}, "name no rule"),
        ({"ruleId": None}, "name no rule"),
        ({"message": {}}, "have no message"),
        ({"message": {"text": ""}}, "have no message"),
        ({"message": "Bad."}, "have no message"),
        ({"locations": []}, "have no location"),
        ({"locations": None}, "have no location"),
        ({"locations": [3]}, "no file"),
        ({"locations": [{"physicalLocation": []}]}, "no file"),
    ],
)
def test_what_is_wrong_is_told_once_for_each_kind(changes: dict[str, Any], told: str) -> None:
    run = read(result(), result(**changes), result(**changes))
    assert len(run.results) == 1
    assert [("2 results left out" in note.message, told in note.message) for note in run.notifications] == [
        (True, True)
    ]


def test_results_that_are_no_objects() -> None:
    assert [n.message for n in read(3, None, [], "x").notifications] == [
        "x.sarif: 4 results left out: they are not objects."
    ]


REGIONS: list[tuple[Any, Location]] = [
    ({"startLine": 3}, Location("a.cpp", 3)),
    ({"startLine": 3.0}, Location("a.cpp", 3)),
    ({}, Location("a.cpp")),
    (None, Location("a.cpp")),
    ({"startLine": 0}, Location("a.cpp")),
    ({"startLine": -4}, Location("a.cpp")),
    ({"startLine": True}, Location("a.cpp")),
    ({"startLine": "3"}, Location("a.cpp")),
    ({"startLine": 10**30}, Location("a.cpp")),
    ({"startLine": 1.5}, Location("a.cpp")),
    ({"startLine": 9, "endLine": 3}, Location("a.cpp", 9, None, 9)),
    ({"startColumn": 5}, Location("a.cpp")),
]


@pytest.mark.parametrize(("region", "place"), REGIONS)
def test_regions(region: Any, place: Location) -> None:
    entry = result(locations=[{"physicalLocation": {"artifactLocation": {"uri": "a.cpp"}, "region": region}}])
    assert [r.location for r in read(entry).results] == [place]


def test_suppressions() -> None:
    run = read(
        result(suppressions=[{"kind": "inSource", "justification": "why"}]),
        result(suppressions=[{"kind": "external", "status": "rejected"}]),
        result(suppressions=[{"kind": "external", "status": "underReview"}]),
        result(suppressions=[]),
        result(suppressions=None),
        result(suppressions=3),
    )
    assert sorted(len(r.suppressions) for r in run.results) == [0, 0, 0, 0, 0, 1]
    assert len(known_from_sarif((run,))) == 5


def test_related_places_and_scope() -> None:
    near, outside = ({"physicalLocation": {"artifactLocation": {"uri": uri}}} for uri in ("b.cpp", "../b.cpp"))
    entry = result(relatedLocations=[{**near, "message": {"text": "here"}}, outside])
    entry["locations"][0]["logicalLocations"] = [{"fullyQualifiedName": "a::f"}]
    (found,) = read(entry).results
    assert [(near.location.path, near.message) for near in found.related] == [("b.cpp", "here")]
    assert found.scope == "a::f"


def test_a_failed_tool_is_not_a_clean_one() -> None:
    invocation = {
        "executionSuccessful": False,
        "toolExecutionNotifications": [{"level": "error", "message": {"text": "Crash"}}],
    }
    run = read(invocations=[invocation])
    assert (run.successful, [(n.level, n.message) for n in run.notifications]) == (False, [(Level.ERROR, "Crash")])


def nested(depth: int) -> bytes:
    return b'{"version":"2.1.0","runs":' + b"[" * depth + b"]" * depth + b"}"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "not JSON"),
        (b"{", "not JSON"),
        (b"\xff\xfe{}", "not UTF-8"),
        (b"[]", "not a JSON object"),
        (b"null", "not a JSON object"),
        (b"{}", "not a SARIF 2.1.0 log"),
        (b'{"version": "2.0.0"}', "not a SARIF 2.1.0 log"),
        (b'{"version": ["2.1.0"]}', "not a SARIF 2.1.0 log"),
        (b'{"version": "2.1.0"}', "'runs' is not an array"),
        (b'{"version": "2.1.0", "runs": {}}', "'runs' is not an array"),
        (b'{"version": "2.1.0", "runs": [3]}', "tool.driver.name is missing"),
        (b'{"version": "2.1.0", "runs": [{"tool": {"driver": {"name": ""}}}]}', "tool.driver.name is missing"),
        (b'{"version": "2.1.0", "runs": [' + b"{}," * 100 + b"{}]}", "at most 100"),
        (b'{"version": "2.1.0", "runs": [{"results": [' + b"0," * 250_000 + b"0]}]}", "at most 250000"),
        (nested(200_000), "nested too deeply"),
        (b'{"x": ' + b"{}," * 2_000_001 + b"}", "too many values"),
        (b'{"x": ' + b"1," * 5_000_001 + b"}", "too many values"),
        (b" " * 64_000_001, "larger than 64 MB"),
    ],
    ids=range(18),
)
def test_refused(data: bytes, message: str) -> None:
    with pytest.raises(SarifError) as caught:
        read_sarif(data, "x.sarif")
    assert str(caught.value).startswith("x.sarif: ")
    assert message in str(caught.value)


@pytest.mark.parametrize("junk", [None, 3, "x", [], {}, [[]], [{}], True, 1e308])
@pytest.mark.parametrize(
    "key",
    ["tool.driver.rules", "tool.extensions", "artifacts", "originalUriBaseIds", "invocations", "results",
     "results.0.locations", "results.0.properties", "results.0.partialFingerprints", "results.0.relatedLocations",
     "results.0.rule", "results.0.ruleIndex", "results.0.message", "results.0.suppressions", "results.0.kind",
     "results.0.locations.0.logicalLocations"],
)  # fmt: skip
def test_wrong_types_anywhere(key: str, junk: object) -> None:
    data = json.loads(log(result()))
    *path, last = key.split(".")
    at: Any = data["runs"][0]
    for part in path:
        at = at[int(part)] if isinstance(at, list) else at[part]
    at[last] = junk
    (run,) = read_sarif(json.dumps(data).encode(), "x.sarif")
    assert len(run.results) <= 1


def test_a_tool_of_a_name_that_no_baseline_can_hold_is_refused() -> None:
    assert read(result(), driver={"name": "n" * 1000}).tool.name == "n" * 1000
    with pytest.raises(SarifError, match=r"x\.sarif: runs\[0\]: tool\.driver\.name has more than 1000 characters"):
        read(result(), driver={"name": "n" * 1001})
