# SPDX-License-Identifier: Apache-2.0
"""The pure functions of two benches: the unknown rate's search and verdicts, and the comparison with launch lists."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from bench import launch_lists, unknown_rate
from bench.unknown_rate import Api, Site, blanked, is_test, production, sites, standing, table, verdicts

QOS = {"history": "keep_last", "depth": 10, "reliability": "reliable", "durability": "volatile"}


def calls(text: str, language: str = "cpp") -> list[tuple[str, str, int, int]]:
    """Kind, name, first and last line of each call that the search finds."""
    found = sites("src/a.cpp", text, language)
    return [(site.api.kind, site.api.name, site.line, site.end) for site in found if not site.declared]


@pytest.mark.parametrize(
    ("text", "kind", "name", "lines"),
    [
        ("pub_ = create_publisher<String>(topic, 10);", "publishers", "create_publisher", (1, 1)),
        ("x(\n this->create_subscription<\n A<B>, C>(\n 1));", "subscribers", "create_subscription", (2, 4)),
        ("p = node\n  ->\n  template create_publisher<T>(n);", "publishers", "create_publisher", (1, 3)),
        ("p = a.b(1)[2].get<N>()\n.create_service<T>(n, f);", "servers", "create_service", (1, 2)),
        ("return create_client<T>(n);", "clients", "create_client", (1, 1)),
        ("a && create_client<T>(n);", "clients", "create_client", (1, 1)),
        ("c_ = rclcpp_action::create_client<A>(this, n);", "action_clients", "create_client", (1, 1)),
        ("c_ = rclcpp_action::create_server<A>(this, n);", "action_servers", "create_server", (1, 1)),
        ("s = create_action_server<A>(n);", "action_servers", "create_action_server", (1, 1)),
        ("Base::create_generic_publisher(n, t, q);", "publishers", "create_generic_publisher", (1, 1)),
        ("tf2_ros::TransformListener listener_{buffer_};", "subscribers", "TransformListener", (1, 1)),
        ("l = std::make_shared<\n tf2_ros::TransformListener>(\n b);", "subscribers", "TransformListener", (1, 3)),
        ("l.reset(new tf2_ros::TransformBroadcaster(this));", "publishers", "TransformBroadcaster", (1, 1)),
        ("message_filters::Subscriber<A, B<C>> s(n, t);", "subscribers", "Subscriber", (1, 1)),
        ("using message_filters::X;\ns_.subscribe(this, t);", "subscribers", "subscribe", (2, 2)),
        ("image_transport::X it;\nit.advertiseCamera(t, 1);", "publishers", "advertiseCamera", (2, 2)),
        (
            "poll::InterProcessPollingSubscriber<T> s_{\n this, t};",
            "subscribers",
            "InterProcessPollingSubscriber",
            (1, 2),
        ),
        ("adaptor.init_pub(pub_);", "publishers", "init_pub", (1, 1)),
        ("debug_->publish<Number>(topic, 1);", "publishers", "publish", (1, 1)),
        ("x = declare_or_get_parameter(n, 1.0);", "parameters", "declare_or_get_parameter", (1, 1)),
        ("int n = 1'000; auto s = create_service<T>(n); char c = '\"';", "servers", "create_service", (1, 1)),
    ],
)
def test_calls_are_found(text: str, kind: str, name: str, lines: tuple[int, int]) -> None:
    assert calls(text) == [(kind, name, *lines)]


@pytest.mark.parametrize(
    "text",
    [
        "// create_publisher<T>(n)",
        "/* create_publisher<T>(n)\n */",
        'auto s = "create_publisher<T>(n)";',
        'auto s = R"x(create_publisher<T>(n) " )x";',
        "template <class T>\nstd::shared_ptr<P<T>> create_publisher(const std::string & n);",
        "void Node::create_publisher(int n) {}",
        "Publisher & create_publisher(int n);",
        "auto f = &Node::create_publisher;",
        "create_publisher<T>;",
        "my_create_publisher(n);",
        "create_publishers(n);",
        "tf2_ros::TransformListener listener_;",
        "std::shared_ptr<tf2_ros::TransformListener> listener_{nullptr};",
        "explicit TransformListener(rclcpp::Node * node);",
        "namespace tf2_ros { class TransformListener; }",
        "other::Subscriber<T> s(n, t);",
        "message_filters::Subscriber<T> s_;",
        "using message_filters::X;\ns_.subscribe();",
        "s_.subscribe(this, t);",
        "it.advertise(t, 1);",
        "void init_pub(P & p) const {}",
        "pub_->publish(message);",
        "rclcpp_x::create_server(n);",
        "create_publisher<T>(n",
    ],
)
def test_what_is_no_call_is_not_found(text: str) -> None:
    assert calls(text) == []


def test_calls_of_python() -> None:
    text = (
        "class ActionClient(object):\n"
        "    def create_publisher(self, n): pass  # create_client(A, n)\n"
        '    """ create_service(A, n) """\n'
        "a = self.node.create_publisher(\n    String, 'create_client(', 10)\n"
        "ActionServer(node, F, 'f', call)\n"
        "from x import (ActionServer, Subscriber)\n"
    )
    assert calls(text, "python") == [
        ("publishers", "create_publisher", 4, 5),
        ("action_servers", "ActionServer", 6, 6),
    ]


def test_blanks_keep_every_place() -> None:
    text = 'a("x\\"y" /* b\nc */, 1); // d\ne();'
    assert blanked(text, "cpp") == 'a("    "     \n    , 1);     \ne();'
    assert blanked("a = '''b\nc''' # d\ne('f')", "python") == 'a = "   \n   "    \ne(" ")'


@pytest.mark.parametrize(
    "path",
    ["p/test/a.cpp", "tests/a.py", "p/src/test_a.cpp", "p/src/a_test.cpp", "p/a_gtest.cpp", "p_tests/src/a.cpp"],
)
def test_tests_are_not_production(path: str) -> None:
    assert is_test(path)


@pytest.mark.parametrize("path", ["p/src/attest.cpp", "latest/a.cpp", "p/src/testify.cpp", "p_test_utils/src/a.cpp"])
def test_production(path: str) -> None:
    assert not is_test(path)


def test_files_that_are_searched(tmp_path: Path) -> None:
    for name, text in {
        "p/src/a.cpp": "",
        "p/scripts/tool": "#!/usr/bin/env python3\n",
        "p/scripts/shell": "#!/bin/sh\n",
        "p/src/b.cpp": "#include <gtest/gtest.h>\n",
        "p/README.md": "",
        ".hidden/a.cpp": "",
        "build/a.cpp": "",
        "ignored/COLCON_IGNORE": "",
        "ignored/src/a.cpp": "",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    assert [(path, language) for path, _, language in production(tmp_path)] == [
        ("p/scripts/tool", "python"),
        ("p/src/a.cpp", "cpp"),
    ]


def end(**changes: Any) -> dict[str, Any]:
    return {"name": "/a", "type": "p/msg/A", "qos": QOS, "unknowns": []} | changes


TOPIC = Site("a.cpp", 3, 5, Api("create_publisher", "publishers"))
PARAMETER = Site("a.cpp", 3, 5, Api("declare_parameter", "parameters"))


@pytest.mark.parametrize(
    ("ends", "unknown"),
    [
        ([], ("absent",)),
        ([end()], ()),
        ([end(name="/?"), end()], ()),
        ([end(name="/?"), end(name="/b/?")], ("name",)),
        ([end(type=None)], ("type",)),
        ([end(qos=None)], ("qos",)),
        ([end(qos=QOS | {"depth": "?"})], ("qos",)),
        ([end(qos=QOS | {"deadline": "?"})], ()),
        ([end(qos=QOS | {"reliability": None})], ()),
        ([end(name="/?", type=None, qos=None)], ("name", "type", "qos")),
        ([end(name="/?"), end(type=None)], ()),
    ],
)
def test_verdicts(ends: list[dict[str, Any]], unknown: tuple[str, ...]) -> None:
    assert verdicts(TOPIC, ends) == unknown


def test_verdicts_of_parameters() -> None:
    assert verdicts(PARAMETER, [end(type=None, qos=None)]) == ()
    said = [{"field": "type", "reason": "r", "location": None}]
    assert verdicts(PARAMETER, [end(type=None, qos=None, unknowns=said)]) == ("type",)


def test_an_endpoint_on_the_first_line_beats_one_inside_the_call() -> None:
    first, inner, other = end(name="/first"), end(name="/inner"), end(name="/other")
    assert standing(TOPIC, {("a.cpp", "publishers"): [(3, first), (4, inner), (6, other)]}) == [first]
    assert standing(TOPIC, {("a.cpp", "publishers"): [(4, inner), (6, other)]}) == [inner]
    assert standing(TOPIC, {("a.cpp", "subscribers"): [(3, first)], ("b.cpp", "publishers"): [(3, other)]}) == []


def test_wrappers_of_the_workspace_are_counted_inside() -> None:
    name = "InterProcessPollingSubscriber"
    definition = f"namespace a::polling {{ template <class T> class {name} : public B {{}}; }}"
    (declared,) = sites("a.hpp", definition, "cpp")
    assert declared.declared and declared.scope == {"polling"}
    own = {(name, "polling")}

    def forwards(text: str) -> list[bool]:
        return [unknown_rate.forwards(site, own) for site in sites("b.cpp", text, "cpp")]

    assert forwards(f"a::polling::{name}<T> s(this, t);") == [True]
    assert forwards(f"namespace a::polling {{ {name}<T> s(this, t); }}") == [True]
    assert forwards(f"other::{name}<T> s(this, t);") == [False]
    assert forwards(f"{name}<T> s(this, t);") == [False]
    assert forwards("create_publisher<T>(n);") == [False]


def test_the_table_and_what_is_declared(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    source = tmp_path / "ws" / "p" / "src" / "a.cpp"
    source.parent.mkdir(parents=True)
    source.write_text("a = create_publisher<T>(n);\nb = create_publisher<T>(n);\nc = create_service<T>(n);\n")
    place = {"path": "p/src/a.cpp", "line": 1}
    why = [{"field": "name", "reason": "it is read", "location": place}]
    node = {"publishers": [end(name="/?", location=place, unknowns=why)]}
    model, excused = tmp_path / "model.json", tmp_path / "excused.yaml"
    model.write_text(json.dumps({"configurations": [{"nodes": [node]}]}))
    excused.write_text("- {path: p/src/a.cpp, line: 3, reason: not built}\n- {path: x.cpp, line: 1, reason: gone}\n")
    words = ["", str(model), str(source.parents[2]), "--verbose", f"--not-endpoints={excused}"]
    monkeypatch.setattr(sys, "argv", words)
    unknown_rate.main()
    printed = capsys.readouterr()
    assert printed.out.splitlines()[:2] == [
        "p/src/a.cpp:1: create_publisher: name it is read (p/src/a.cpp:1)",
        "p/src/a.cpp:2: create_publisher: absent",
    ]
    assert "| publishers | 2 | 1 | 1 | 0 | 0 | 1 | 100.0% | 50.0% | 50.0% | 0 | 0 |" in printed.out
    assert "| servers | 0 | 0 | 0 | 0 |  | 0 |  |  |  | 1 | 0 |" in printed.out
    assert "| **all** | 2 | 1 | 1 | 0 | 0 | 1 | 100.0% | 50.0% | 50.0% | 1 | 0 |" in printed.out
    assert printed.err == "not needed: x.cpp:1: gone\n"


def test_no_sites_no_rate() -> None:
    assert table({}).splitlines()[2] == "| **all** | 0 | 0 | 0 | 0 |  | 0 |  |  |  | 0 | 0 |"


def row(name: str | None = "/a", **changes: Any) -> dict[str, Any]:
    given = {"name": name, "package": "p", "type": "a", "container": None, "certain": True, "file": "f.py", "line": 3}
    return given | changes


def node(name: str = "/a", **changes: Any) -> dict[str, Any]:
    place = {"path": "f.py", "line": 3}
    given = {"name": name, "package": "p", "type": "a", "container": None, "conditions": [], "location": place}
    return given | {"source": "launch"} | changes


def test_what_is_as_listed() -> None:
    rows = [row(), row(None, type="b"), row(None, type="b", namespace="/n"), row("/c", package="?", type="?")]
    nodes = [node("/n/y", type="b"), node("/x", type="b"), node(), node("/c", package="?", type="?")]
    result = launch_lists.compare(rows, nodes)
    assert (len(result.found), result.missing, result.open, result.extra, result.different) == (4, (), (), (), ())


def test_what_a_listed_program_makes_is_not_extra() -> None:
    result = launch_lists.compare([row()], [node(), node("/a/inner", source="source"), node("/b")])
    assert [extra["name"] for extra in result.extra] == ["/b"]


def test_missing_and_open() -> None:
    result = launch_lists.compare([row(), row("/b", certain=False), row(None, type="c")], [])
    assert ([r["name"] for r in result.missing], [r["name"] for r in result.open]) == (["/a", None], ["/b"])


@pytest.mark.parametrize(
    ("listed", "there", "what"),
    [
        (row(), node("/b"), "name: /a, /b"),
        (row(), node(type="b"), "type: a, b"),
        (row(container="/c"), node(), "container: /c, None"),
        (row(), node(location={"path": "f.py", "line": 4}), "place: f.py:3, f.py:4"),
        (row(), node(conditions=[{}]), "certain: True, False"),
        (row(certain=False), node(), "certain: False, True"),
        (row(None, namespace="/n"), node("/a"), "namespace: /n, /a"),
        (row(package="?", type="?"), node(package="?"), "type: ?, a"),
    ],
)
def test_what_is_not_as_listed(listed: dict[str, Any], there: dict[str, Any], what: str) -> None:
    ((_, _, differences),) = launch_lists.compare([listed], [there]).different
    assert differences == (what,)


def test_twice_the_same_is_listed_twice() -> None:
    result = launch_lists.compare([row(None), row(None)], [node("/x"), node("/x"), node("/x")])
    assert (len(result.found), len(result.extra)) == (2, 1)


def test_the_lists_are_well_formed() -> None:
    lists = sorted((Path(__file__).parent / "bench" / "launch_lists").glob("*.json"))
    assert len(lists) >= 12
    for path in lists:
        listed = json.loads(path.read_text())
        assert listed["nodes"] and len(listed["commit"]) == 40, path.name
        for each in listed["nodes"]:
            assert each.keys() - {"namespace"} == {*row(), "kind", "note"}, path.name
            assert (each["name"] is None) == ("namespace" in each), path.name
            assert (each["kind"] == "component") == (each["container"] is not None), path.name
