# SPDX-License-Identifier: Apache-2.0
"""What the files of the folder hold: each finding in its place, the model as HAROS has it, rules by HAROS's ids."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import haros_kit as kit
import pytest

from haros_ci.haros_json.documents import documents
from haros_ci.haros_json.rules import METRICS
from haros_ci.model.build import Build, EntryPoint, PluginClass, Target
from haros_ci.model.location import Location
from haros_ci.model.manifest import Manifest
from haros_ci.model.measurement import Measurement
from haros_ci.model.package import Package
from haros_ci.results.result import BaselineState, Suppression

BRACES = kit.result(kit.BRACES, "cpplint")
CONFIG = "base_launch_base.launch"


def test_every_file_that_the_visualizer_asks_for() -> None:
    texts = documents(kit.given([BRACES, kit.mismatch()]))
    kit.read(texts)
    assert sorted(texts) == [
        "default/compliance/runtime/base_launch_base.launch.json",
        "default/compliance/source/base.json",
        "default/compliance/source/extra.json",
        "default/compliance/unknown.json",
        "default/configurations.json",
        "default/metrics.json",
        "default/metrics/base.json",
        "default/metrics/extra.json",
        "default/packages.json",
        "default/rules.json",
        "default/summary.json",
        "projects.json",
    ]
    assert list(texts)[-1] == "projects.json"  # so that a project is listed when its files are there


def test_nothing_at_all_is_fine() -> None:
    found = kit.made(kit.given(packages=(), systems=()))
    assert found["projects.json"] == [{"id": "default", "packages": [], "repositories": []}]
    assert found["summary.json"]["issues"] == {"total": 0, "coding": 0, "metrics": 0, "other": 0, "ratio": "0.00"}


def test_the_same_bytes_whatever_the_order() -> None:
    one = kit.given([BRACES, kit.mismatch()], systems=(kit.system("a"), kit.system("b")))
    turned = replace(one, architecture=replace(one.architecture, configurations=one.architecture.configurations[::-1]))
    assert (
        documents(one)
        == documents(turned)
        == documents(kit.given([BRACES, kit.mismatch()], systems=(kit.system("a"), kit.system("b"))))
    )


# -- issues ------------------------------------------------------------------------------------------------------------


def test_a_finding_of_a_file_is_its_packages() -> None:
    found = kit.made(kit.given([replace(BRACES, message="Missing {.", also=("ruff:E1",), scope="Base::turn")]))
    (issue,) = found["compliance/source/base.json"]
    place = {"package": "base", "file": "src/base.cpp", "line": 7, "column": 3, "function": "Base::turn", "class": None}
    assert issue == {
        "rule": "cpplint:whitespace/braces",
        "comment": "Missing {.<br>Also: ruff:E1",
        "location": place,
        "resources": [],
    }
    assert found["compliance/source/extra.json"] == found["compliance/unknown.json"] == []


def test_a_finding_of_no_package_is_another() -> None:
    found = kit.made(kit.given([kit.result(kit.UNUSED, "pylint", path="tool.py")]))
    (issue,) = found["compliance/unknown.json"]
    assert (issue["location"]["package"], issue["location"]["file"]) == (None, "tool.py")
    assert found["compliance/source/base.json"] == []


def test_a_finding_of_a_configuration_is_its_own_with_all_that_it_is_about() -> None:
    found = kit.made(kit.given([kit.mismatch()]))
    (issue,) = found[f"compliance/runtime/{CONFIG}.json"]
    assert found["compliance/source/base.json"] == []
    assert issue["location"]["configuration"] == CONFIG
    assert (issue["location"]["file"], issue["location"]["line"]) == ("src/base.cpp", 7)
    assert issue["resources"] == [
        {"name": "/talker", "resourceType": "node"},
        {"name": "/chatter", "resourceType": "topic"},
        {"name": "/listener", "resourceType": "node"},
        {"node": "/talker", "topic": "/chatter", "resourceType": "link"},
        {"node": "/listener", "topic": "/chatter", "resourceType": "link"},
    ]
    (system,) = found["configurations.json"]
    (query,) = system["queries"]
    uids = {one["uid"]: one["name"] for kind in ("nodes", "topics") for one in system[kind]}
    assert [
        uids.get(one.get("uid", "")) or (uids[one["node_uid"]], uids[one["topic_uid"]]) for one in query["objects"]
    ] == [
        "/talker",
        "/chatter",
        "/listener",
        ("/talker", "/chatter"),
        ("/listener", "/chatter"),
    ]
    assert (query["qid"], query["rule"], query["name"]) == (
        0,
        "haros-ci:topic-type-mismatch",
        "haros-ci:topic-type-mismatch",
    )


@pytest.mark.parametrize(
    "edges",
    [
        (("node:/gone", "topic:/chatter"),),  # of the system under other launch arguments
        (("node:/listener", "topic:/ns/other"),),
        (("topic:/dock", "topic:/chatter"),),
    ],
)
def test_what_a_configuration_does_not_have_is_not_highlighted(edges: tuple[tuple[str, str], ...]) -> None:
    found = kit.made(kit.given([replace(kit.mismatch(), edges=edges, subject=("/nowhere",))]))
    (issue,) = found[f"compliance/runtime/{CONFIG}.json"]
    assert not [one for one in issue["resources"] if one["resourceType"] == "link"]


def test_a_configuration_that_is_not_there_leaves_the_finding_with_its_package() -> None:
    found = kit.made(kit.given([kit.mismatch("other")]))
    assert len(found["compliance/source/base.json"]) == 1
    assert found[f"compliance/runtime/{CONFIG}.json"] == []


@pytest.mark.parametrize("gone", [{"suppressions": (Suppression("inSource"),)}, {"state": BaselineState.ABSENT}])
def test_what_is_not_there_is_not_shown(gone: dict[str, Any]) -> None:
    found = kit.made(kit.given([replace(BRACES, **gone)]))
    assert found["compliance/source/base.json"] == [] == found["rules.json"]
    assert found["summary.json"]["issues"]["total"] == 0


@pytest.mark.parametrize("state", [BaselineState.NEW, BaselineState.UNCHANGED, BaselineState.UPDATED])
def test_what_a_baseline_knows_is_shown(state: BaselineState) -> None:
    assert len(kit.made(kit.given([replace(BRACES, state=state)]))["compliance/source/base.json"]) == 1


def test_a_users_query_is_an_issue_of_every_configuration_that_it_matches() -> None:
    from haros_ci.query.queries import run

    systems = (kit.system("one"), kit.system("two"), replace(kit.system("three"), nodes=()))
    unasked = kit.given(systems=systems, project=kit.CROWDED)
    asked = run(unasked.architecture, kit.CROWDED, "haros.yaml", unasked.workspace.files)
    found = kit.made(
        kit.given(asked.results, systems, project=kit.CROWDED, where="haros.yaml", user_rules=1, rules_on=4)
    )
    assert len(asked.results) == 1
    for name in ("one", "two"):
        (issue,) = found[f"compliance/runtime/{name}.json"]
        assert issue["resources"] == [{"name": "/chatter", "resourceType": "topic"}]
        assert (issue["rule"], issue["location"]["configuration"]) == ("user:crowded", name)
    assert found["compliance/runtime/three.json"] == found["compliance/source/base.json"] == []
    assert [len(one["queries"]) for one in found["configurations.json"]] == [1, 0, 1]  # by name: one, three, two
    (rule,) = found["rules.json"]
    assert (rule["id"], rule["name"], rule["scope"]) == ("user:crowded", "user:crowded", "configuration")
    assert rule["query"] == "topics[len(self.publishers) > 1]"
    assert found["summary.json"]["issues"]["total"] == 1
    assert found["projects.json"][0]["id"] == "Fleet"


# -- rules -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("tool", "rule", "id"),
    [
        ("metrics", kit.COMPLEX, "max_cyclomatic_complexity_15"),
        ("cpplint", kit.BRACES, "cpplint:whitespace/braces"),  # two rules of HAROS
        ("pylint", kit.UNUSED, "pylint:unused-import"),  # one of two that HAROS has as one
        ("haros-ci", kit.MISMATCH, "haros-ci:topic-type-mismatch"),  # an alias that is not HAROS's
    ],
)
def test_a_rule_goes_by_haross_id_where_one_is_the_other(tool: str, rule: Any, id: str) -> None:
    found = kit.made(kit.given([kit.result(rule, tool)]))
    (shown,) = found["rules.json"]
    assert shown["id"] == id == found["compliance/source/base.json"][0]["rule"]
    assert shown["name"] == f"{tool}:{rule.id}"
    assert shown["tags"] == list(rule.tags)
    assert found["packages.json"][0]["analysis"]["violations"] == {id: 1}


def test_haross_metrics() -> None:
    found = kit.made(kit.given())
    assert (
        [one["id"] for one in found["metrics.json"]] == [row[0] for row in METRICS] == sorted(row[0] for row in METRICS)
    )
    ranges = {one["id"]: (one["minimum"], one["maximum"]) for one in found["metrics.json"]}
    assert ranges["comment_ratio"] == (0, 1)
    assert ranges["maintainability_index"] == (0, 100)
    assert ranges["static_path_count"] == (1, None)


# -- packages and measurements ------------------------------------------------------------------------------------------


def test_a_package() -> None:
    manifest = Manifest(
        description="A <b> & c",
        authors=("B", "A"),
        maintainers=("M",),
        website="https://example.org/a?b&c",
        repository="javascript:alert(1)",
        bugtracker="example.org",
    )
    package = kit.made(kit.given([BRACES], manifests={"base": manifest}))["packages.json"][0]
    assert package == {
        "id": "base",
        "metapackage": False,
        "version": "1.0.0",
        "description": "A &lt;b&gt; &amp; c",
        "wiki": "https://example.org/a?b&amp;c",
        "repository": None,
        "bugTracker": None,
        "authors": ["A", "B"],
        "maintainers": ["M"],
        "dependencies": ["extra", "roscpp"],
        "size": "0.04",
        "lines": 6,
        "sloc": 5,
        "analysis": {"violations": {"cpplint:whitespace/braces": 1}, "metrics": {}},
    }


def test_packages_of_one_name_are_two() -> None:
    found = kit.made(kit.given([BRACES], packages=(Package("base", "base"), Package("base", "extra"))))
    ids = [one["id"] for one in found["packages.json"]]
    assert len(set(ids)) == 2
    assert [len(found[f"compliance/source/{id}.json"]) for id in ids] == [1, 0]


def test_only_packages_that_were_asked_for() -> None:
    one = kit.given(workspace={"targets": frozenset(("extra/package.xml",))})
    assert [each["id"] for each in kit.made(one)["packages.json"]] == ["extra"]


def test_measurements() -> None:
    values = (
        Measurement("base", "", 0, "", "", "comments", 4),
        Measurement("base", "base/src/base.cpp", 0, "", "", "comments", 4.0),
        Measurement("base", "base/src/base.cpp", 3, "Base", "turn", "cyclomatic-complexity", 2.0),
        Measurement("base", "base/src/base.cpp", 9, "", "go", "cyclomatic-complexity", 5.0),
        Measurement("base", "base/src/base.cpp", 9, "", "go", "ploc", 7.5),
        Measurement("base", "base/src/base.cpp", 0, "", "", "halstead-bugs", float("nan")),
        Measurement("", "tool.py", 0, "", "", "comments", 100.0),
    )
    found = kit.made(kit.given(measurements=values, timestamp="2024-01-31-12-00"))
    assert len(found["metrics/base.json"]) == 6
    turn = next(one for one in found["metrics/base.json"] if one["location"]["function"] == "turn")
    assert turn["metric"] == "cyclomatic_complexity"
    assert turn["value"] == 2
    assert (turn["location"]["class"], turn["location"]["line"]) == ("Base", 3)
    whole = next(one for one in found["metrics/base.json"] if one["location"]["file"] is None)
    assert whole["location"]["package"] == "base"
    assert found["packages.json"][0]["analysis"]["metrics"] == {"comments": 4}
    history = found["summary.json"]["history"]
    assert {key: value for key, (value,) in history.items()} == {
        "timestamps": "2024-01-31-12-00",
        "lines_of_code": 7,
        "comments": 4,
        "issues": 0,
        "standards": 0,
        "metrics": 0,
        "complexity": 3.5,
        "function_length": 7.5,
    }


# -- summary -----------------------------------------------------------------------------------------------------------


def test_the_summary() -> None:
    at = Location("base/CMakeLists.txt", 1)
    build = Build(
        package="base",
        targets=(
            Target(name="talker", package="base", kind="executable", output="talker", location=at),
            Target(name="core", package="base", kind="library", output="core", location=at),
            Target(name="check", package="base", kind="executable", output="check", location=at, is_test=True),
        ),
        scripts=("base/scripts/run.py", "base/launch/all.launch.py"),
        entry_points=(EntryPoint(name="go", module="m", function="main", path="", package="base", location=at),),
        plugins=(
            PluginClass(name="n", type="base::L", base="nodelet::Nodelet", library="l", package="base", location=at),
            PluginClass(name="p", type="base::P", base="rviz::Panel", library="l", package="base", location=at),
        ),
    )
    results = [BRACES, kit.result(kit.COMPLEX, "metrics"), kit.mismatch()]
    summary = kit.made(kit.given(results, builds={"base": build}, rules_on=9, user_rules=2))["summary.json"]
    assert summary["source"] == {
        "packages": 2,
        "files": 5,
        "scripts": 1,
        "languages": {"cpp": 0.428571, "cppLOC": 3, "python": 0.142857, "pythonLOC": 1},
        "pkgDependencies": 1,
    }
    assert summary["issues"] == {"total": 3, "coding": 1, "metrics": 1, "other": 1, "ratio": "0.43"}
    assert summary["components"] == {
        "launchFiles": 1,
        "nodes": 3,
        "nodelets": 1,
        "parameterFiles": None,
        "configurations": 1,
    }
    assert summary["communications"] == {"topics": 2, "remappings": 1, "messages": 1, "services": 0, "actions": 0}
    assert summary["analysis"] == {"plugins": 3, "rules": 9, "userRules": 2, "violatedRules": 3}
    assert set(map(tuple, summary["history"].values())) == {()}


def test_the_total_counts_findings_as_every_report_does() -> None:
    """Two of one rule and file that say the same are one there; the lists have both."""
    alike = [kit.result(kit.BRACES, "cpplint", location=Location("base/src/base.cpp", line, 3)) for line in (7, 9)]
    found = kit.made(kit.given(alike))
    assert found["summary.json"]["issues"]["total"] == 1 and len(found["compliance/source/base.json"]) == 2
    others = [
        alike[0],
        kit.result(kit.BRACES, "cpplint", "Another thing.", location=Location("base/src/base.cpp", 9, 3)),
    ]
    assert kit.made(kit.given(others))["summary.json"]["issues"]["total"] == 2
