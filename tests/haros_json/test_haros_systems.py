# SPDX-License-Identifier: Apache-2.0
"""configurations.json: what each system is made of, and uids that are the same in every run."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import haros_kit as kit

from haros_ci.model.architecture import Condition, Endpoint, Node, Qos


def shown(*systems: Any, **more: Any) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = kit.made(kit.given(systems=systems or None, **more))["configurations.json"]
    return found


def named(items: list[dict[str, Any]], name: str) -> dict[str, Any]:
    (one,) = (item for item in items if item["name"] == name)
    return one


def test_nodes_and_what_they_are_connected_to() -> None:
    (system,) = shown()
    talker = named(system["nodes"], "/talker")
    assert talker["type"] == "base/talker"
    assert talker["args"] == "--fast"
    ends = {key: talker[key] for key in ("publishers", "subscribers", "servers", "clients", "reads", "writes")}
    assert ends == {
        "publishers": ["/chatter"],
        "subscribers": [],
        "servers": [],
        "clients": ["/dock", "/reset"],
        "reads": [],
        "writes": ["/listener/rate"],
    }
    place = {"package": "base", "file": "launch/base.launch", "line": 2, "column": 5, "function": None, "class": None}
    assert talker["traceability"] == [place]
    assert named(system["nodes"], "/listener")["variables"] == ["subscribe@name1"]
    assert system["launch"] == [
        {
            "name": "base.launch",
            "directory": "launch",
            "package": "base",
            "language": "launch",
            "size": 10,
            "timestamp": 0,
            "lines": 1,
            "sloc": 1,
        }
    ]


def test_topics_services_actions_and_parameters() -> None:
    (system,) = shown()
    chatter = named(system["topics"], "/chatter")
    assert (chatter["publishers"], chatter["subscribers"]) == (["/other", "/talker"], ["/listener"])
    assert [one["name"] for one in system["topics"]] == [
        "/chatter",
        "/ns/?",
    ]  # what the client library makes is left out
    reset = named(system["services"], "/reset")
    assert (reset["servers"], reset["type"]) == (["/listener"], "std_srvs/Empty")
    dock = named(system["services"], "/dock")
    assert (dock["servers"], dock["clients"], dock["type"]) == (["/listener"], ["/other", "/talker"], "base/Dock")
    rate = named(system["parameters"], "/listener/rate")
    assert (rate["value"], rate["type"], rate["reads"], rate["writes"]) == (
        1.5,
        "double",
        ["/listener"],
        ["/other", "/talker"],
    )
    assert named(system["topics"], "/ns/?")["variables"] == ["/listener subscribe@name1"]


def test_links_lead_to_what_is_there() -> None:
    (system,) = shown()
    links = system["links"]
    uids = {
        kind: {one["uid"]: one["name"] for one in system[kind]}
        for kind in ("nodes", "topics", "services", "parameters")
    }
    ends = {"topic": "topics", "service": "services", "param": "parameters"}
    every = [link for found in links.values() for link in found]
    for link in every:
        what = next(key for key in ends if key in link)
        assert uids["nodes"][link["node_uid"]] == link["node"]
        assert uids[ends[what]][link[f"{what}_uid"]] == link[what]
    assert len(every) == 5 + 4 * 2
    publisher = next(link for link in links["publishers"] if link["node"] == "/talker")
    assert (publisher["queue"], publisher["latched"], publisher["type"]) == (10, True, "std_msgs/String")
    assert next(link for link in links["clients"] if link["service"] == "/reset")["type"] is None
    assert [link["value"] for link in links["writes"]] == [2.0, 2.0]
    assert [link["value"] for link in links["reads"]] == [5.0]


def test_counts() -> None:
    (system,) = shown()
    counts = {
        key: system[key] for key in ("collisions", "remaps", "unresolved", "conditional", "dependencies", "environment")
    }
    assert counts == {
        "collisions": 0,
        "remaps": 1,
        "unresolved": 1,
        "conditional": 0,
        "dependencies": ["base"],
        "environment": [],
    }


def test_collisions_and_conditions() -> None:
    under = Condition("if", "a && b", kit.HERE)
    made = kit.system()
    nodes = (*made.nodes, replace(made.nodes[0], conditions=(under,), endpoints=()))
    (system,) = shown(replace(made, nodes=nodes))
    assert (system["collisions"], system["conditional"]) == (1, 1)
    twins = [one for one in system["nodes"] if one["name"] == "/talker"]
    assert len({one["uid"] for one in twins}) == 2
    condition = next(one["conditions"] for one in twins if one["conditions"])[0]
    assert (condition["statement"], condition["condition"]) == ("if", "a &amp;&amp; b")
    assert condition["location"]["line"] == 7


def test_names_that_are_not_known_do_not_meet_or_collide() -> None:
    unknown = kit.end("publishers", "/?")
    node = Node(
        name="/a", kind="node", package="base", type="a", endpoints=(unknown, replace(unknown, kind="subscribers"))
    )
    (system,) = shown(replace(kit.system(), nodes=(node,), parameters=()))
    assert [one["name"] for one in system["topics"]] == ["/?", "/?"]
    assert len({one["uid"] for one in system["topics"]}) == 2
    assert (system["collisions"], system["unresolved"]) == (0, 2)


def test_ros2() -> None:
    def end(kind: str, name: str, **more: Any) -> Endpoint:
        return kit.end(kind, name, "std_msgs/msg/String", **more)

    node = Node(
        name="/a",
        kind="lifecycle",
        package="base",
        type="a",
        ros=2,
        endpoints=(
            end("publishers", "/t", qos=Qos(depth=7, durability="transient_local")),
            end("publishers", "/u", qos=Qos(depth="?", durability="?")),
            end("publishers", "/v", qos=Qos(history="keep_all", depth=3)),
            end("parameters", "/a:x.y", value=3),
        ),
    )
    (system,) = shown(replace(kit.system(), nodes=(node,), parameters=()))
    assert [(one["queue"], one["latched"]) for one in system["links"]["publishers"]] == [
        (7, True),
        (None, None),
        (None, False),
    ]
    assert named(system["parameters"], "/a:x.y")["reads"] == ["/a"]


def test_uids_depend_on_the_configuration_and_nothing_else() -> None:
    def uids(*systems: Any) -> list[set[str]]:
        every = shown(*systems)
        return [
            {one["uid"] for kind in ("nodes", "topics", "services", "parameters") for one in system[kind]}
            for system in every
        ]

    first, second = uids(kit.system("a"), kit.system("b"))
    assert not first & second
    assert uids(kit.system("b")) == [second]


def test_hpl_and_environment_of_the_project_file() -> None:
    project = {
        "configurations": {
            "hall": {
                "launch": ["base/launch/base.launch"],
                "hpl": {"properties": ["globally: no /a"], "assumptions": ["globally: some /b"]},
                "environment": {"ROBOT": "r2"},
            }
        },
        "repositories": {"robot": {}, "arm": {}},
    }
    found = kit.made(kit.given(systems=(kit.system("hall"),), project=project))
    (system,) = found["configurations.json"]
    assert system["hpl"] == {"properties": ["globally: no /a"], "assumptions": ["globally: some /b"]}
    assert system["environment"] == ["ROBOT"]
    assert found["projects.json"][0]["repositories"] == ["arm", "robot"]
