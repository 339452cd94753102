# SPDX-License-Identifier: Apache-2.0
"""Policies of SROS2: read from files, and written from nodes."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from haros_ci.model.architecture import Endpoint, Node, Unknown
from haros_ci.model.element import Element
from haros_ci.security.enclaves import enclave_of, is_common
from haros_ci.security.permissions import LISTS, verdict
from haros_ci.security.policy import Policy, read_policy
from haros_ci.security.write import policy_of
from haros_ci.workspace.xml import XmlError, parse_xml

POLICY = '<policy version="0.2.0"><enclaves>{}</enclaves></policy>'
ENCLAVE = '<enclave path="/e"><profiles><profile ns="{}" node="n">{}</profile></profiles></enclave>'
TOPICS = '<topics publish="ALLOW"><topic>{}</topic></topics>'


def read(files: Mapping[str, str], path: str = "p/a.policy.xml") -> Policy | None:
    def element(name: str) -> Element | None:
        try:
            return parse_xml(files[name].encode()) if name in files else None
        except XmlError:
            return None

    return read_policy(path, element)


def one(body: str, space: str = "/", **files: str) -> Policy:
    others = {name.replace("__", "/") + ".xml": text for name, text in files.items()}
    found = read({"p/a.policy.xml": POLICY.format(ENCLAVE.format(space, body)), **others})
    assert found is not None
    return found


@pytest.mark.parametrize(
    ("space", "name", "full"),
    [
        ("/", "chatter", "/chatter"),
        ("/", "/chatter", "/chatter"),
        ("/", "~/state", "/n/state"),
        ("/robot", "chatter", "/robot/chatter"),
        ("/robot/", " a/b ", "/robot/a/b"),
        ("/robot", "~/a", "/robot/n/a"),
        ("/robot", "/*", "/*"),
    ],
)
def test_names_are_expanded(space: str, name: str, full: str) -> None:
    policy = one(TOPICS.format(name), space)
    assert [rule.name for rule in policy.rules("/e")] == [full]
    assert [profile.node for profile in policy.profiles] == [space.rstrip("/") + "/n"]
    assert policy.is_whole and policy.is_told("/e")


def test_each_attribute_is_a_rule() -> None:
    body = '<services reply="ALLOW" request="DENY"><service>s</service></services><actions call="ALLOW"><action>a</action></actions>'
    found = {(rule.kind, rule.name, rule.allows) for rule in one(body).rules("/e")}
    assert found == {("servers", "/s", True), ("clients", "/s", False), ("action_clients", "/a", True)}


def test_includes_bring_enclaves_profiles_and_lists() -> None:
    files = {
        "p/a.policy.xml": POLICY.format('<xi:include href="b.policy.xml" xpointer="xpointer(/policy/enclaves/*)"/>'),
        "p/b.policy.xml": POLICY.format(
            ENCLAVE.format("/", '<xi:include href="common/node.xml" xpointer="xpointer(/profile/*)"/>')
        ),
        "p/common/node.xml": '<profile><xi:include href="log.xml" xpointer="xpointer(/profile/*)"/></profile>',
        "p/common/log.xml": f"<profile>{TOPICS.format('rosout')}</profile>",
    }
    files = {name: text.replace("<policy", '<policy xmlns:xi="x"', 1) for name, text in files.items()}
    policy = read(files)
    assert policy is not None and policy.is_whole
    assert [(r.name, r.location.path, r.is_included) for r in policy.rules("/e")] == [
        ("/rosout", "p/common/log.xml", True)
    ]
    assert policy.profiles[0].location.path == "p/b.policy.xml"


@pytest.mark.parametrize(
    "include",
    [
        '<xi:include href="missing.xml" xpointer="xpointer(/profile/*)"/>',
        '<xi:include href="b.xml"/>',
        '<xi:include href="b.xml" xpointer="xpointer(//topics)"/>',
        '<xi:include href="../../etc/passwd" xpointer="xpointer(/profile/*)"/>',
        '<xi:include href="/etc/passwd" xpointer="xpointer(/profile/*)"/>',
        '<xi:include href="loop.xml" xpointer="xpointer(/profile/*)"/>',
    ],
)
def test_what_cannot_be_included_leaves_the_profile_open(include: str) -> None:
    loop = '<profile><xi:include href="loop.xml" xpointer="xpointer(/profile/*)"/></profile>'
    policy = one(include, p__b="<profile/>", p__loop=loop)
    assert not policy.profiles[0].is_whole and not policy.is_told("/e")


def test_many_includes_end() -> None:
    include = '<xi:include href="wide.xml" xpointer="xpointer(/profile/*)"/>' * 50
    policy = one(include, p__wide=f"<profile>{include}</profile>")
    assert not policy.is_told("/e")


@pytest.mark.parametrize("text", ["<policies/>", "<policy", "<profile/>"])
def test_what_is_no_policy(text: str) -> None:
    assert read({"p/a.policy.xml": text}) is None


def node(name: str, *ends: tuple[str, str], **more: object) -> Node:
    endpoints = tuple(Endpoint(kind=k, name=n, original_name=n, type=None, location=None) for k, n in ends)
    given = {"kind": "node", "package": "demo", "type": "t", "ros": 2, "process": name, **more}
    return Node(name=name, endpoints=endpoints, **given)  # type: ignore[arg-type]


NODES = (
    node("/talker", ("publishers", "/chatter"), ("publishers", "/rosout"), ("servers", "/talker/get_parameters")),
    node("/arm/driver", ("subscribers", "/arm/state"), ("clients", "/other/s"), ("action_servers", "/arm/driver/move")),
    node("/arm/viewer", ("action_clients", "/arm/driver/move"), ("parameters", "/arm/viewer:x"), process="/arm/box"),
    node("/arm/box", ("servers", "/arm/box/_container/load_node")),
    node("/safe", ("publishers", "/a&b"), arguments="--ros-args --enclave /locked/up -r a:=b"),
)


def test_a_written_policy_keeps_to_the_format() -> None:
    """The rules of sros2's schema, in words: order, required attributes, at least one entry in each list."""
    written = policy_of(NODES)
    assert written is not None and not written.gaps
    root = parse_xml(written.text.encode())
    assert (root.tag, root.attributes) == ("policy", {"version": "0.2.0"})
    assert [child.tag for child in root.children] == ["enclaves"]
    enclaves = root.children[0].children
    assert [(e.tag, e.attributes) for e in enclaves] == [
        ("enclave", {"path": path}) for path in ("/arm/box", "/arm/driver", "/locked/up", "/talker")
    ]
    for enclave in enclaves:
        assert [child.tag for child in enclave.children] == ["profiles"]
        profiles = enclave.children[0].children
        assert profiles and all(p.tag == "profile" and set(p.attributes) == {"ns", "node"} for p in profiles)
        for rows in (rows for profile in profiles for rows in profile.children):
            word, verbs = LISTS[rows.tag]
            assert set(rows.attributes) <= set(verbs) and set(rows.attributes.values()) == {"ALLOW"}
            assert rows.children and all(row.tag == word and row.text.strip() for row in rows.children)
    assert [(p.attributes["ns"], p.attributes["node"]) for p in enclaves[0].children[0].children] == [
        ("/arm", "box"),
        ("/arm", "viewer"),
    ]


def test_what_was_written_allows_all_that_the_nodes_do() -> None:
    written = policy_of(NODES)
    assert written is not None
    policy = read({"p/a.policy.xml": written.text})
    assert policy is not None and policy.is_whole
    for each in NODES:
        (profile,) = policy.of(each.name)
        for end in each.endpoints:
            if end.kind != "parameters":
                assert verdict(end.kind, end.name, policy.rules(profile.enclave)) == "allowed", (each.name, end)
        own = {(end.kind, end.name) for end in each.endpoints}
        assert all((rule.kind, rule.name) in own or is_common(rule.kind, rule.name) for rule in profile.rules)


def test_names_are_written_short() -> None:
    written = policy_of(NODES)
    assert written is not None
    for entry in ("<topic>chatter</topic>", "<service>~/get_parameters</service>", "<topic>state</topic>",
                  "<service>/other/s</service>", "<action>~/move</action>", "<action>driver/move</action>"):  # fmt: skip
        assert entry in written.text


def test_the_same_nodes_give_the_same_text() -> None:
    first, second = policy_of(NODES), policy_of(tuple(reversed(NODES)))
    assert first is not None and second is not None and first.text == second.text


def test_what_is_not_known_is_told_and_not_allowed() -> None:
    unknown = Unknown("endpoints", "a call that was not followed")
    written = policy_of(
        (
            node("/a", ("publishers", "/?/x"), ("publishers", "/y")),
            node("/?", ("publishers", "/z")),
            node("/b", ("publishers", "/y"), unknowns=(unknown,)),
            node("/old", ("publishers", "/y"), ros=1),
        )
    )
    assert written is not None
    assert "?" not in written.text.partition("\n")[2] and "/z" not in written.text and "old" not in written.text
    assert len(written.gaps) == 3
    assert policy_of((node("/old", ros=1),)) is None


@pytest.mark.parametrize(
    ("arguments", "enclave"),
    [
        ("--ros-args --enclave /a/b", "/a/b"),
        ("--ros-args -r x:=y -e a --log-level info", "/a"),
        ("--enclave /", "/"),
        ("--ros-args -r x:=y", None),
        ("", None),
        ("--ros-args --enclave $(var e)", None),
    ],
)
def test_the_enclave_of_a_node(arguments: str, enclave: str | None) -> None:
    assert enclave_of(node("/a", arguments=arguments)) == enclave
