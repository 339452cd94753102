# SPDX-License-Identifier: Apache-2.0
"""Queries of a project file: each a rule with its own id, level and tags, its results at the matched entities."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from query_worlds import FILES, ROBOT, WALK

from haros_ci.query.declared import PLUGIN, DeclaredQuery, declared, rules
from haros_ci.query.queries import QueryOutcome, run
from haros_ci.results.rule import Level

Q = "topics[len(self.types) > 1]"


def rule(query: str = Q, **more: Any) -> dict[str, Any]:
    return {"name": "Types", "description": "One type per topic.", "tags": ["types"], "query": query, **more}


def of_rules(**entries: Any) -> dict[str, Any]:
    return {"rules": entries}


def of_plugin(**queries: Any) -> dict[str, Any]:
    return {"configurations": {name: {"launch": [], "user_data": {PLUGIN: data}} for name, data in queries.items()}}


def one(project: dict[str, Any]) -> DeclaredQuery:
    (found,), said = declared(project)
    assert said == ()
    return found


def asked(project: dict[str, Any], **more: Any) -> QueryOutcome:
    return run(ROBOT, project, "haros.yaml", FILES, **more)


def test_a_rule_with_a_query() -> None:
    found = one(of_rules(one_type=rule(scope="configuration", level="error"))).rule()
    assert (found.id, found.summary, found.level) == ("user:one_type", "Types", Level.ERROR)
    assert found.tags == ("query", "types")
    assert found.help == f"One type per topic.\n\n{Q}"
    assert "ros" in found.profiles


def test_a_query_of_a_plugin() -> None:
    found = one(of_plugin(walk=[{"name": "Query 1 - One Type", "query": Q, "tags": ["mine"]}]))
    assert (found.id, found.configurations) == ("user:query-1-one-type", ("walk",))
    assert found.aliases == ("haros_plugin_pyflwor:query",)
    assert found.tags == ("code-standards", "query", "pyflwor", "computation-graph", "mine")
    assert (found.level, found.scope) == (Level.WARNING, "configuration")


def test_a_query_without_a_name_is_known_by_its_words() -> None:
    first = one(of_plugin(walk=[{"query": Q}]))
    again = one(of_plugin(walk=[{"query": "topics // all\n [ len(self.types)>1 ]"}]))
    other = one(of_plugin(walk=[{"query": "topics[len(self.types) > 2]"}]))
    assert first.id == again.id != other.id
    assert first.id.startswith("user:walk-")


def test_the_same_query_of_two_configurations_is_one_rule() -> None:
    entry = {"name": "Same", "query": Q}
    assert one(of_plugin(walk=[entry], talk=[entry])).configurations == ("walk", "talk")


def test_another_query_of_the_same_name_has_another_id() -> None:
    found, _ = declared(of_plugin(walk=[{"name": "Same", "query": Q}], talk=[{"name": "Same", "query": "nodes"}]))
    assert found[0].id == "user:same"
    assert found[1].id.startswith("user:same-")
    assert list(rules(of_plugin(walk=[{"name": "Same", "query": Q}]))) == ["user:same"]


@pytest.mark.parametrize(
    ("project", "said"),
    [
        (of_rules(r=rule(query=3)), "rules.r: 'query' must be text"),
        (of_rules(r=rule(scope="node")), "rules.r: 'scope' is node, and must be one of global, package, configuration"),
        (of_rules(r=rule(level="bad")), "rules.r: 'level' must be error, warning or note"),
        (of_plugin(walk="nodes"), "user_data.haros_plugin_pyflwor must be a list"),
        (of_plugin(walk=[{"name": "n"}]), "haros_plugin_pyflwor[0] needs a 'query'"),
        (of_plugin(walk=["nodes"]), "haros_plugin_pyflwor[0] needs a 'query'"),
        (of_plugin(walk=[{"query": "nodes"}] * 501), "more than 500 queries"),
    ],
)
def test_what_cannot_be_a_query_is_said(project: dict[str, Any], said: str) -> None:
    assert said in declared(project)[1][0]


@pytest.mark.parametrize(
    "project",
    [
        {},
        {"rules": None},
        of_rules(r={"name": "n", "description": "d", "tags": []}),
        of_rules(r=rule(query=None)),
        {"configurations": {"walk": ["walker/launch/walk.launch"], "talk": {"launch": [], "user_data": {"other": 1}}}},
        of_plugin(walk=None),
        of_plugin(walk=[]),
    ],
)
def test_nothing_is_said_where_no_query_is(project: dict[str, Any]) -> None:
    assert declared(project) == ((), ())
    assert asked(project) == QueryOutcome()


def test_a_result_stands_at_the_first_end_and_names_the_others() -> None:
    (result,) = asked(of_rules(r=rule(scope="configuration"))).results
    assert (result.rule, result.tool, str(result.location)) == ("user:r", "haros-ci", "src/walker/src/walker.cpp:10:5")
    assert result.message == (
        "Query found: Topic('/cmd_vel', geometry_msgs/Twist) (learned from: source, known-node; in walk)"
    )
    assert [str(item.location) for item in result.related] == ["src/walker/src/walker.cpp:20:5"]
    assert result.related[0].message.startswith("Subscription of node '/base' to topic '/cmd_vel'")
    assert result.subject == ("/cmd_vel",)


def test_a_pair_stands_at_its_first_and_is_about_all() -> None:
    query = "for p in <nodes/publishers>, s in <nodes/subscribers> where p.topic == s.topic and p.type != s.type return p, s"
    details = "{n} ends of {entities} {value} {{}}"
    (result,) = asked(of_plugin(walk=[{"name": "pairs", "query": query, "details": details}])).results
    assert str(result.location) == "src/walker/src/walker.cpp:10:5"
    assert [str(item.location) for item in result.related] == ["src/walker/src/walker.cpp:20:5"]
    assert result.message == (
        "2 ends of [Publication of node '/walker' to topic '/cmd_vel' of type 'geometry_msgs/Twist', "
        "Subscription of node '/base' to topic '/cmd_vel' of type 'geometry_msgs/TwistStamped'] None {} "
        "(learned from: source, known-node; in walk)"
    )
    assert result.subject == ("/base", "/cmd_vel", "/walker")
    assert result.roles == ("PublishLink of walker/walker_node", "SubscribeLink of base/BaseNodelet")


@pytest.mark.parametrize(
    ("query", "place", "words"),
    [
        ("nodes[self.id == '/base']", "src/walker/launch/walk.launch:4:3", "learned from: launch"),
        ("nodes/publishers[self.topic_name == '/scan']", "src/walker/launch/walk.launch:4:3", "known-node"),
        ("nodes/publishers[self.topic_name == '/tf']", "src/walker/src/walker.cpp:11:5", "learned from: hint"),
        ("parameters[self.id == '/walker/speed']", "src/walker/launch/walk.launch:5:5", "launch, source"),
        ("config[self.name == 'walk']", "src/walker/launch/walk.launch", "Configuration walk"),
        ("for n in <nodes> where n.id == '/base' return len(n.publishers)", "haros.yaml", "found: 3"),
        ("for n in <nodes> where n.id == '/base' return 'n': n, 'k': 1", "src/walker/launch/walk.launch:4:3", "'k': 1"),
    ],
)
def test_where_results_stand_and_what_they_say(query: str, place: str, words: str) -> None:
    (result,) = asked(of_plugin(walk=[{"name": "q", "query": query}])).results
    assert str(result.location) == place
    assert words in result.message


def test_results_of_other_scopes() -> None:
    found = asked(
        of_rules(
            files=rule(query="files[self.language == 'msg']"),
            calls=rule(query="nodes/advertise[self.name.startswith('/')]", scope="global"),
            packages=rule(query="package[self.name == 'base']", scope="package"),
        )
    ).results
    assert [(result.rule, str(result.location)) for result in found] == [
        ("user:packages", "src/base/package.xml"),
        ("user:files", "src/walker/msg/Step.msg"),
        ("user:calls", "src/walker/src/walker.cpp:11:5"),
    ]


def test_the_same_match_of_several_configurations_is_one_result() -> None:
    robot = replace(ROBOT, configurations=(WALK, replace(WALK, name="run"), replace(WALK, name="rush")))
    found = run(robot, of_rules(r=rule(scope="configuration")), "haros.yaml", FILES).results
    assert [result.message.rpartition("; ")[2] for result in found] == ["in walk and 2 more)"]


def test_a_query_is_asked_of_its_own_configuration_only() -> None:
    assert asked(of_plugin(talk=[{"name": "q", "query": "nodes[self.id == '/walker']"}])).results == ()


def test_only_wanted_queries_are_asked() -> None:
    project = of_rules(a=rule(scope="configuration"), b=rule(query="nodes[", scope="configuration"))
    found = asked(project, is_selected=lambda rule: rule.id == "user:a")
    assert [result.rule for result in found.results] == ["user:a"]
    assert found.notifications == ()
    assert [one.id for one in found.rules] == ["user:a", "user:b"]


def test_a_wrong_query_is_an_error_with_its_place_and_a_suggestion() -> None:
    found = asked(
        of_plugin(walk=[{"name": "Q7", "query": "for p in\n <confg/nodes> return p"}, {"name": "Q8", "query": Q}])
    )
    assert found.failed == ("user:q7",)
    assert [one.message for one in found.results if one.rule == "failed-query"] == [
        "The query user:q7 (configurations.walk.user_data.haros_plugin_pyflwor[0]) has no result: "
        "line 2, column 3: there is no variable 'confg'; did you mean 'config'?"
    ]
    assert [result.rule for result in found.results] == ["user:q8", "failed-query"]
    assert found.notifications == ()


@pytest.mark.parametrize(
    ("query", "same"),
    [
        ("c/nodes/publishers", "config/nodes/publishers"),
        ("for n in <c/nodes> return n", "for n in <config/nodes> return n"),
        ("for c in <nodes> return c", "for n in <nodes> return n"),
    ],
)
def test_c_is_the_configuration_unless_the_query_has_a_c_of_its_own(query: str, same: str) -> None:
    found = [asked(of_plugin(walk=[{"name": "q", "query": text}])) for text in (query, same)]
    assert [one.location for one in found[0].results] == [one.location for one in found[1].results]
    assert found[0].results and not found[0].failed


def test_a_step_that_leads_nowhere_is_a_note() -> None:
    found = asked(of_plugin(walk=[{"name": "q", "query": "nodes/publisher/topic"}]))
    assert (found.failed, found.results) == ((), ())
    (note,) = found.notifications
    assert note.level is Level.NOTE
    assert note.message.endswith("gives nothing for it, as in HAROS; did you mean 'publishers'?")


def test_the_same_input_gives_the_same_results() -> None:
    project = of_rules(r=rule(scope="configuration"), s=rule(query="files | packages"))
    assert asked(project) == asked(project)
