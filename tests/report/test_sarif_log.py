# SPDX-License-Identifier: Apache-2.0
"""What stands in a SARIF log, and what must not."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from typing import Any

import pytest
from report_samples import (
    COMPARED,
    CPP,
    CPPCHECK_RUN,
    EMPTY,
    FAILED,
    HOSTILE,
    IMPORTED,
    NULL,
    NULL_RESULT,
    PLAIN,
    PY,
    SCOPE_RESULT,
    SHAPES,
    SOURCES,
    SUPPRESSED,
    hostile,
)

from haros_ci.model.location import Location
from haros_ci.report import sarif
from haros_ci.results.fingerprint import partial_fingerprints
from haros_ci.results.result import Provenance, Report, Result, Run, Tool
from haros_ci.results.rule import Level, Rule


def source(path: str) -> str:
    return SOURCES.get(path, "")


def read(report: Report, audience: sarif.Audience = "archive") -> dict[str, Any]:
    log = json.loads(sarif.render(report, audience=audience, source=source))
    assert isinstance(log, dict)
    return log


def runs(report: Report, audience: sarif.Audience = "archive") -> dict[str, Any]:
    return {run["tool"]["driver"]["name"]: run for run in read(report, audience)["runs"]}


def only_result(result: Result, audience: sarif.Audience = "archive") -> dict[str, Any]:
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(result,)),))
    (written,) = runs(report, audience)["cppcheck"]["results"]
    assert isinstance(written, dict)
    return written


def place(result: dict[str, Any]) -> dict[str, Any]:
    (location,) = result["locations"]
    return location["physicalLocation"]  # type: ignore[no-any-return]


def nulls(value: object, path: str = "") -> list[str]:
    if isinstance(value, dict):
        return [found for name, item in value.items() for found in nulls(item, f"{path}/{name}")]
    if isinstance(value, list):
        return [found for i, item in enumerate(value) for found in nulls(item, f"{path}/{i}")]
    return [path] if value is None or value == -1 else []


@pytest.mark.parametrize("report", SHAPES.values(), ids=SHAPES)
def test_logs_are_deterministic_and_free_of_the_library_s_traps(report: Report) -> None:
    text = sarif.render(report, source=source)
    turned = replace(
        report, runs=tuple(replace(r, results=r.results[::-1], rules=r.rules[::-1]) for r in report.runs[::-1])
    )
    assert sarif.render(turned, source=source) == text
    log = json.loads(text)
    assert list(log) == ["$schema", "version", "runs"] and log["version"] == "2.1.0"
    assert nulls(log) == []
    assert "_" not in {key[0] for run in log["runs"] for key in run} and "schema_uri" not in text
    assert all(isinstance(run["results"], list) for run in log["runs"])
    assert "Utc" not in text and "file://" not in text


def test_one_result_is_one_line() -> None:
    lines = sarif.render(PLAIN).splitlines()
    assert sum(line.startswith('{"message":{"text":"Null pointer') for line in lines) == 1


def test_the_guid_follows_the_content() -> None:
    def guid(report: Report) -> str:
        return str(runs(report)["cppcheck"]["automationDetails"]["guid"])

    other = replace(CPPCHECK_RUN, results=(SCOPE_RESULT,))
    assert guid(PLAIN) == guid(PLAIN) != guid(replace(PLAIN, runs=(other,)))


def test_categories_are_distinct() -> None:
    ids = [run["automationDetails"]["id"] for run in read(IMPORTED)["runs"]]
    assert ids == ["haros_ci/cppcheck/", "haros_ci/import-A-Tool-With-Many-Words/", "haros_ci/import-cppcheck/"]
    twice = replace(PLAIN, runs=(CPPCHECK_RUN, CPPCHECK_RUN))
    assert [run["automationDetails"]["id"] for run in read(twice)["runs"]] == [
        "haros_ci/cppcheck/",
        "haros_ci/cppcheck-2/",
    ]


def test_a_rule_has_all_that_github_reads() -> None:
    run = runs(PLAIN)["cppcheck"]
    rule, scope = run["tool"]["driver"]["rules"]
    assert rule["id"] == "nullPointer" and rule["name"] == "CppcheckNullPointer"
    assert rule["shortDescription"] == {"text": "Null pointer dereference."}
    assert rule["fullDescription"] == {"text": "A pointer that is null is dereferenced."}
    assert rule["help"]["text"] == NULL.help and rule["help"]["markdown"].startswith(NULL.help)
    assert rule["defaultConfiguration"] == {"level": "error"}
    assert rule["properties"] == {
        "precision": "high",
        "problem.severity": "error",
        "security-severity": "5.5",
        "tags": ["security", "external/cwe/cwe-476", "bugs"],
    }
    (relationship,) = rule["relationships"]
    (taxonomy,) = run["taxonomies"]
    assert relationship["kinds"] == ["superset"]
    assert taxonomy["taxa"][relationship["target"]["index"]]["id"] == relationship["target"]["id"] == "CWE-476"
    assert relationship["target"]["toolComponent"]["guid"] == taxonomy["guid"]
    assert scope["deprecatedIds"] == ["reduceScope"] and "relationships" not in scope
    assert "taxonomies" not in runs(PLAIN)["pylint"]


@pytest.mark.parametrize(
    ("rule", "severity"),
    [
        (replace(NULL, security_severity="10.0"), "10.0"),
        (replace(NULL, tags=("bugs",)), None),
        (replace(NULL, security_severity="Medium"), None),
        (replace(NULL, security_severity="0.0"), None),
        (replace(NULL, security_severity="11"), None),
        (replace(NULL, security_severity=None), None),
    ],
)
def test_security_severity_only_where_it_belongs(rule: Rule, severity: str | None) -> None:
    run = runs(replace(PLAIN, runs=(Run(Tool("t"), (rule,)),)))["t"]
    assert run["tool"]["driver"]["rules"][0]["properties"].get("security-severity") == severity


@pytest.mark.parametrize(
    ("id", "name"),
    [
        ("build/include_order", "BuildIncludeOrder"),
        ("unused-import", "UnusedImport"),
        ("C0114", "ToolC0114"),
        ("nullPointer", "ToolNullPointer"),
        ("c++11", "C11"),
        ("===", "Tool"),
    ],
)
def test_names_differ_from_ids(id: str, name: str) -> None:
    run = runs(replace(PLAIN, runs=(Run(Tool("tool"), (Rule(id, "x"),)),)))["tool"]
    assert run["tool"]["driver"]["rules"][0]["name"] == name


@pytest.mark.parametrize(
    ("version", "written", "semantic"),
    [
        ("4.1.0", "4.1.0", "4.1.0"),
        ("2.22", "2.22", None),
        ("", "0 (unknown)", None),
        ("v1", "0 (v1)", None),
        ("1.2.3-rc.1", "1.2.3-rc.1", "1.2.3-rc.1"),
        ("01.2.3", "01.2.3", None),
    ],
)
def test_versions(version: str, written: str, semantic: str | None) -> None:
    driver = runs(replace(PLAIN, runs=(Run(Tool("t", version)),)))["t"]["tool"]["driver"]
    assert (driver["version"], driver.get("semanticVersion")) == (written, semantic)


def test_every_result_finds_its_rule() -> None:
    for report in SHAPES.values():
        for run in read(report)["runs"]:
            rules = run["tool"]["driver"]["rules"]
            assert [rule["id"] for rule in rules] == sorted({rule["id"] for rule in rules})
            assert all(rules[result["ruleIndex"]]["id"] == result["ruleId"] for result in run["results"])


def test_a_result_says_its_level_although_the_library_takes_warning_for_granted() -> None:
    assert only_result(replace(NULL_RESULT, level=Level.WARNING))["level"] == "warning"


@pytest.mark.parametrize(
    ("where", "region", "text"),
    [
        (Location(CPP, 7, 4, 7, 5), (7, 4, 7, 5), "p"),
        (Location(CPP, 7, 4), (7, 4, 7, 10), "p = 1;"),
        (Location(CPP, 7), (7, 3, 7, 10), "*p = 1;"),
        (Location(CPP, 3, 6, 8, 2), (3, 6, 3, 24), "Odometry::update()"),
        (Location(CPP), (1, 1, 1, 29), "#include <base/odometry.hpp>"),
        (Location(PY, 7, 23, 7, 32), (7, 23, 7, 32), "undefined"),
        (Location(CPP, 2), (2, 1, 2, 2), None),
        (Location(CPP, 7, 10), (7, 10, 7, 10), None),
        (Location(CPP, 7, 4, 7, 4), (7, 4, 7, 5), "p"),
        (Location("gone.cpp", 7, 4), (7, 4, 7, 5), None),
        (Location("gone.cpp"), (1, 1, 1, 2), None),
    ],
)
def test_regions_are_one_tight_line(where: Location, region: tuple[int, ...], text: str | None) -> None:
    written = place(only_result(replace(NULL_RESULT, location=where, related=(), identity=None)))["region"]
    assert (written["startLine"], written["startColumn"], written["endLine"], written["endColumn"]) == region
    assert written.get("snippet", {}).get("text") == text


def test_context_is_around_the_region() -> None:
    context = place(only_result(NULL_RESULT))["contextRegion"]
    assert (context["startLine"], context["endLine"]) == (4, 8)
    assert context["snippet"]["text"] == "\n".join(SOURCES[CPP].splitlines()[3:])


def test_without_source_the_snippet_of_the_result_is_quoted() -> None:
    report = replace(PLAIN, runs=(replace(CPPCHECK_RUN, results=(NULL_RESULT,)),))
    (run,) = json.loads(sarif.render(report))["runs"]
    where = place(run["results"][0])
    assert where["region"]["snippet"] == {"text": "p"} and where["contextRegion"]["snippet"] == {"text": "  *p = 1;"}


def test_a_result_names_function_fingerprint_and_related_places() -> None:
    result = only_result(NULL_RESULT)
    assert result["locations"][0]["logicalLocations"] == [
        {"fullyQualifiedName": "Odometry::update", "kind": "function"}
    ]
    assert result["partialFingerprints"]["primaryLocationLineHash"] == "5b2c1f0d9e8a7c66:1"
    assert result["partialFingerprints"] == partial_fingerprints(NULL_RESULT)
    assert result["properties"] == {"template": "Null pointer dereference: p"}
    (near,) = result["relatedLocations"]
    assert near["id"] == 1 and "](1)" in result["message"]["text"]
    assert near["physicalLocation"]["region"] == {"startColumn": 12, "startLine": 6}


@pytest.mark.parametrize(
    ("path", "uri"),
    [
        ("a b/ü.cpp", "a%20b/%C3%BC.cpp"),
        ("a:b.cpp", "a%3Ab.cpp"),
        ("50%.cpp", "50%25.cpp"),
        ("a?b#c", "a%3Fb%23c"),
        ("caf\udce9.cpp", "caf%E9.cpp"),
        ("x\ud800", "x%EF%BF%BD"),
    ],
)
def test_paths_are_percent_encoded(path: str, uri: str) -> None:
    assert place(only_result(replace(NULL_RESULT, location=Location(path, 1))))["artifactLocation"]["uri"] == uri


def test_states_stand_on_all_results_or_none() -> None:
    compared = runs(COMPARED)
    assert [r["baselineState"] for r in compared["cppcheck"]["results"]] == ["absent", "updated", "unchanged", "new"]
    assert "baselineGuid" in compared["cppcheck"]
    assert all("baselineState" not in r for r in compared["pylint"]["results"])
    assert all("baselineGuid" not in run and "baselineState" not in str(run["results"]) for run in runs(PLAIN).values())
    half = replace(CPPCHECK_RUN, results=(NULL_RESULT, COMPARED.runs[0].results[1]))
    assert [r["baselineState"] for r in runs(replace(PLAIN, runs=(half,)))["cppcheck"]["results"]] == [
        "unchanged",
        "new",
    ]


def test_what_is_gone_quotes_no_line_of_today() -> None:
    absent = next(r for r in runs(COMPARED)["cppcheck"]["results"] if r["baselineState"] == "absent")
    assert "snippet" not in str(absent)


def test_suppressions_stand_on_all_results_or_none() -> None:
    results = runs(SUPPRESSED)["cppcheck"]["results"]
    assert [[s["kind"] for s in r["suppressions"]] for r in results] == [["inSource"], ["external"], []]
    assert results[0]["suppressions"][0]["justification"] == "Read by the debugger."
    assert "suppressions" not in sarif.render(PLAIN)


def test_github_gets_what_is_open_or_known_and_no_noise() -> None:
    compared = runs(COMPARED, "github")["cppcheck"]
    assert [r["baselineState"] for r in compared["results"]] == ["updated", "unchanged", "new"]
    assert [r["ruleId"] for r in runs(SUPPRESSED, "github")["cppcheck"]["results"]] == ["nullPointer"]
    for shape in SHAPES.values():
        text = json.dumps(runs(shape, "github"))
        assert not any(
            f'"{name}"' in text for name in ("suppressions", "contextRegion", "artifacts", "reason", "absent")
        )


def test_trouble_is_in_the_log() -> None:
    failed = runs(FAILED)
    (done,) = failed["pylint"]["invocations"]
    assert done["executionSuccessful"] is True
    (note,) = done["toolExecutionNotifications"]
    assert note["descriptor"]["id"] == "file-given-up"
    assert note["locations"][0]["physicalLocation"]["region"] == {"startLine": 3}
    (broken,) = failed["cppcheck"]["invocations"]
    assert broken["executionSuccessful"] is False
    assert [n["level"] for n in broken["toolExecutionNotifications"]] == ["error"]
    (missing,) = failed["clang-tidy"]["invocations"]
    assert missing["executionSuccessful"] is False
    assert "did not finish" in str(missing["toolExecutionNotifications"])
    assert [n["level"] for n in missing["toolConfigurationNotifications"]] == ["note"]
    assert "No baseline: the clone is shallow." in str(failed)
    for run in failed.values():
        descriptors = run["tool"]["driver"].get("notifications", [])
        (invocation,) = run["invocations"]
        for kind in ("toolExecutionNotifications", "toolConfigurationNotifications"):
            for n in invocation.get(kind, []):
                assert descriptors[n["descriptor"]["index"]]["id"] == n["descriptor"]["id"]


def test_artifacts_are_those_that_the_run_saw() -> None:
    run = runs(PLAIN)["cppcheck"]
    (artifact,) = run["artifacts"]
    assert artifact == {
        "hashes": {"sha-256": "0f" * 32},
        "length": 120,
        "location": {"uri": CPP, "uriBaseId": "SRCROOT"},
        "roles": ["analysisTarget"],
        "sourceLanguage": "cplusplus",
    }
    assert run["originalUriBaseIds"].keys() == {"SRCROOT"} and "uri" not in run["originalUriBaseIds"]["SRCROOT"]
    assert all(place(r)["artifactLocation"]["index"] == 0 for r in run["results"])


@pytest.mark.parametrize(
    "address",
    ["", "git@github.com:acme/base.git", "https://user:pw@host/x", "/srv/git/base", "https://a b", 'https://a"b'],
)
def test_odd_addresses_are_left_out(address: str) -> None:
    assert "versionControlProvenance" not in sarif.render(replace(PLAIN, provenance=Provenance(address, "c0ffee")))


def test_provenance_is_mapped_to_the_root() -> None:
    (details,) = runs(PLAIN)["cppcheck"]["versionControlProvenance"]
    assert details["repositoryUri"] == "https://github.com/acme/base" and details["mappedTo"] == {
        "uriBaseId": "SRCROOT"
    }


def test_imported_help_is_not_trusted() -> None:
    rules = read(IMPORTED)["runs"][2]["tool"]["driver"]["rules"]
    assert "<b>" not in rules[0]["help"]["markdown"] and "@team" not in rules[0]["help"]["markdown"]
    assert "javascript" not in str(rules)


def test_an_empty_report_is_a_run_of_ours() -> None:
    (run,) = read(EMPTY)["runs"]
    assert run["tool"]["driver"]["name"] == "haros-ci" and run["results"] == []


@pytest.mark.parametrize("text", HOSTILE)
def test_no_control_character_gets_in(text: str) -> None:
    def strings(value: object) -> list[str]:
        if isinstance(value, dict):
            return [s for item in (*value, *value.values()) for s in strings(item)]
        if isinstance(value, list):
            return [s for item in value for s in strings(item)]
        return [value] if isinstance(value, str) else []

    written = sarif.render(hostile(text), source=lambda path: text)
    assert written.isascii()
    for string in strings(json.loads(written)):
        assert string.replace("\n", "").replace("\t", "").isprintable(), string


def test_the_object_model_is_loaded_only_for_a_log() -> None:
    rooms = "github, json_report, sarif, statistics, text"
    program = f"import sys; from haros_ci.report import {rooms}; sys.exit('sarif_om' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
