# SPDX-License-Identifier: Apache-2.0
"""Which rules let a node have which ends."""

from __future__ import annotations

import pytest

from haros_ci.model.location import Location
from haros_ci.security.permissions import Permission, needs_of, verdict


def rules(*said: tuple[str, str, bool]) -> tuple[Permission, ...]:
    return tuple(Permission(kind=k, name=n, allows=a, location=Location("p.xml", 1)) for k, n, a in said)


@pytest.mark.parametrize(
    ("kind", "topics"),
    [
        ("publishers", ["publish rt/a"]),
        ("subscribers", ["subscribe rt/a"]),
        ("servers", ["publish rr/aReply", "subscribe rq/aRequest"]),
        ("clients", ["publish rq/aRequest", "subscribe rr/aReply"]),
        ("parameters", []),
    ],
)
def test_what_an_end_needs(kind: str, topics: list[str]) -> None:
    assert sorted(f"{need.verb} {need.topic}" for need in needs_of(kind, "/a")) == topics


def test_an_action_is_three_services_and_two_topics() -> None:
    server = {(need.verb, need.topic) for need in needs_of("action_servers", "/a")}
    assert len(server) == 8
    assert ("publish", "rt/a/_action/feedback") in server and ("subscribe", "rq/a/_action/send_goalRequest") in server
    turned = {"publish": "subscribe", "subscribe": "publish"}
    assert {(turned[verb], topic) for verb, topic in server} == {
        (need.verb, need.topic) for need in needs_of("action_clients", "/a")
    }


ALLOWED = [
    ("publishers", "/a/b", ("publishers", "/a/b", True)),
    ("publishers", "/a/b", ("publishers", "/*", True)),
    ("publishers", "/a/b", ("publishers", "/a/?", True)),
    ("servers", "/a", ("servers", "/*", True)),
    ("action_servers", "/a", ("action_servers", "/[ab]", True)),
]
MISSING = [
    ("publishers", "/a/b", ("subscribers", "/a/b", True)),
    ("publishers", "/a/b", ("publishers", "/a", True)),
    ("publishers", "/a/b", ("publishers", "/A/b", True)),
    ("servers", "/a", ("clients", "/a", True)),
    ("servers", "/a", ("publishers", "/*", True)),
    ("action_servers", "/a", ("action_clients", "/a", True)),
    ("action_clients", "/a", ("clients", "/a/_action/*", True)),
]


@pytest.mark.parametrize(("kind", "name", "rule"), ALLOWED)
def test_is_allowed(kind: str, name: str, rule: tuple[str, str, bool]) -> None:
    assert verdict(kind, name, rules(rule)) == "allowed"


@pytest.mark.parametrize(("kind", "name", "rule"), MISSING)
def test_is_not_allowed(kind: str, name: str, rule: tuple[str, str, bool]) -> None:
    assert verdict(kind, name, rules(rule)) == "missing"


def test_what_is_denied_stays_denied() -> None:
    both = rules(("publishers", "/*", True), ("publishers", "/a", False))
    assert verdict("publishers", "/a", both) == "denied"
    assert verdict("publishers", "/b", both) == "allowed"
    assert verdict("subscribers", "/a", both) == "missing"


def test_an_action_may_be_allowed_by_its_parts() -> None:
    parts = rules(("clients", "/a/_action/*", True), ("subscribers", "/a/_action/*", True))
    assert verdict("action_clients", "/a", parts) == "allowed"
    assert verdict("action_clients", "/a", parts[:1]) == "missing"
