# SPDX-License-Identifier: Apache-2.0
"""Queries that want out of the language, or never end: each is refused with a sentence."""

from __future__ import annotations

import pytest
from query_worlds import ROBOT, Thing, asked, fault, scene

from haros_ci.query.engine import Query
from haros_ci.query.fault import QueryError
from haros_ci.query.functions import BUILTINS, METHODS
from haros_ci.query.queries import run
from haros_ci.query.resources import QueryParameter, Resource
from haros_ci.query.source import QueryPackage, QuerySourceFile, SourceNode
from haros_ci.query.system import Collection, QuerySystem
from haros_ci.query.values import QueryEntity, QueryList

WAYS_OUT = [
    "__class__", "__dict__", "__init__", "__globals__", "__getattribute__", "__subclasses__", "__reduce__", "__mro__",
    "secret", "ATTRIBUTES", "METHODS", "KIND", "items", "words", "made", "world", "system", "links", "end", "place",
    "mro", "func_globals", "_made",
]  # fmt: skip


@pytest.mark.parametrize("name", WAYS_OUT)
def test_nothing_of_python_is_an_attribute(name: str) -> None:
    thing = Thing(name="t", s="text", parts=QueryList.of((1,)))
    for value in ("t", "t.s", "t.parts", "t.map", "len", "1", "f", "t.s.lower()"):
        text = f"let f = function(a) {{a}}, v = {value} return v.{name}"
        if name == "items" and value == "t.map":
            continue
        assert f"{name!r}" in fault(text, t=thing) or f"{name} of a" in fault(text, t=thing)


@pytest.mark.parametrize("name", WAYS_OUT)
def test_nothing_of_python_is_an_attribute_of_the_model(name: str) -> None:
    variables = scene()
    for path in ("config", "nodes[0]", "topics[0]", "nodes[0].publishers[0]", "packages", "nodes", "nodes[0].node"):
        with pytest.raises(QueryError):
            Query(f"let v = {path.replace('packages', 'files[0]')} return v.{name}", variables).matches(variables)


def subclasses(kind: type[QueryEntity]) -> list[type[QueryEntity]]:
    return [kind, *(one for child in kind.__subclasses__() for one in subclasses(child))]


def test_every_list_of_what_is_allowed_has_plain_names() -> None:
    kinds = [kind for kind in subclasses(QueryEntity) if kind.__module__.startswith("haros_ci.")]
    assert {QuerySystem, Collection, QueryParameter, QueryPackage, QuerySourceFile, SourceNode} <= set(kinds)
    names = [name for kind in kinds for name in (*kind.ATTRIBUTES, *kind.METHODS)]
    assert all(name.isidentifier() and not name.startswith("_") for name in (*names, *BUILTINS))
    assert "format" not in METHODS[str]


def test_every_attribute_of_the_model_gives_a_value_of_the_language() -> None:
    """Follows everything that can be reached: entities, lists, maps, plain data, nothing else."""
    seen: set[int] = set()
    kept: list[object] = []  # an id is another's once its object is gone
    kinds: dict[str, int] = {}
    waiting: list[object] = list(scene().values())
    while waiting:
        value = waiting.pop()
        if id(value) in seen:
            continue
        seen.add(id(value))
        kept.append(value)
        assert (
            value is None
            or isinstance(value, (bool, int, float, str, QueryList, QueryEntity))
            or hasattr(value, "pairs")
        ), value
        if isinstance(value, QueryEntity):
            kinds[type(value).__name__] = kinds.get(type(value).__name__, 0) + 1
            if kinds[type(value).__name__] <= 40:
                waiting += [value.ATTRIBUTES[name](value) for name in value.ATTRIBUTES]
        elif isinstance(value, QueryList):
            waiting += value
        elif hasattr(value, "pairs"):
            waiting += [item for pair in value.pairs for item in (pair.key, pair.value)]
    assert kinds.keys() >= {
        "NodeInstance",
        "Topic",
        "PublishLink",
        "ReadLink",
        "RosCall",
        "SourceCondition",
        "QueryLocation",
        "Collection",
    }
    assert issubclass(QueryParameter, Resource)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("return pow(9, pow(9, pow(9, 9)))", "too large"),
        ("return pow(10, 100000)", "too large"),
        ("return pow(-8, 0.5)", "no such power"),
        ("return pow(0, -1)", "no negative power"),
        ("let a = pow(2, 4000) return a * a", "too large"),
        ("return 'x' * 1000000", "more than"),
        ("return [1, 2] * 1000000", "more than"),
        ("return 1000000 * 'x'", "more than"),
        ("let a = 'x' * 90000 return a + a", "more than"),
        ("let a = 'x' * 90000 return a.replace('x', 'yyyy')", "more than"),
        ("let a = ['x' * 1000] * 99 return a[0].join(a)", "more than"),
        ("return int('9' * 5000)", "no whole number"),
        ("return round(1.5, pow(10, 30))", "digits"),
        ("return round(float('nan'))", "cannot be rounded"),
        ("let f = function(n) { f(n + 1) } return f(0)", "deep"),
        ("let f = function(n) { f(n) + f(n) } return f(0)", "deep"),
        ("for a in <x>, b in <x>, c in <x>, d in <x> where a + b + c + d == -1 return 1", "stopped after"),
        ("for a in <x>, b in <x>, c in <x>, d in <x> where a < b and b < c and c < a return 1", "stopped after"),
        (
            "x[every a in <x> satisfies (every b in <x> satisfies (every c in <x> satisfies (a + b + c + self != -1)))]",
            "stopped after",
        ),
        ("for a in <x> collect [a] as 1 with function(l, v) { [l, v] }", "deep"),
        (
            "let a = [1, 1], b = [a, a], c = [b, b, b, b, b, b, b, b], d = [c, c, c, c, c, c, c, c], e = [d, d, d, d, d, d, d, d],"
            " f = [e, e, e, e, e, e, e, e], g = [f, f, f, f, f, f, f, f], h = [g, g, g, g, g, g, g, g] return 1",
            "elements",
        ),
    ],
)
def test_what_is_too_much_is_stopped(text: str, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if said == "stopped after":
        monkeypatch.setattr(Query.__init__, "__defaults__", (250_000,))  # of any number of steps all of them are taken
    assert said in fault(text, x=list(range(400)))


@pytest.mark.parametrize(
    "text",
    [
        "x[self == '{0.__class__}']",
        "return '{0.__class__}' + '%s'",
        "x/__class__/__mro__",
        "x[self == '__class__']",
        "return 'x' * 1000, pow(2, 100)",
        "let f = function(n) { if n > 0 then f(n - 1) else 0 } return f(20)",
    ],
)
def test_what_only_looks_hostile_is_answered(text: str) -> None:
    asked(text, x=["a"])


def test_all_evaluations_share_the_steps_of_a_query() -> None:
    variables = {"x": QueryList.of(range(100))}
    query = Query("for a in <x>, b in <x> return 1", variables, steps=25_000)
    assert len(query.matches(variables)) == 10_000
    with pytest.raises(QueryError, match="stopped"):
        query.matches(variables)


def test_a_hostile_query_does_not_stop_the_others() -> None:
    rule = {"name": "n", "description": "d", "tags": ["t"], "scope": "configuration"}
    names = ("endless", "deep", "typo", "broken", "right")
    queries = (
        "let f = function(n) { f(n) } return f(1)",
        "(" * 500,
        "nodes[self.nmae == 'x']",
        "nodes[",
        "nodes[self.id == '/walker']",
    )
    project = {"rules": {name: {**rule, "query": query} for name, query in zip(names, queries, strict=True)}}
    found = run(ROBOT, project, "haros.yaml")
    assert [result.rule for result in found.results] == ["user:right", *["failed-query"] * 4]
    assert found.failed == ("user:endless", "user:deep", "user:typo", "user:broken")
    assert all(one.location.path == "haros.yaml" and one.level.value == "error" for one in found.results[1:])


@pytest.mark.parametrize(
    "details", ["{entities.__class__}", "{0}", "{n.real}", "{entities!r}", "{value[0]}", "{", "}{"]
)
def test_details_are_no_format_of_python(details: str) -> None:
    rule = {"name": "n", "description": "d", "tags": ["t"], "scope": "configuration", "details": details}
    project = {"rules": {"r": {**rule, "query": "nodes[self.id == '/walker']"}}}
    (result,) = run(ROBOT, project, "haros.yaml").results
    assert result.message.startswith(details)


@pytest.mark.parametrize(
    "text",
    [
        "for a in <nodes>, b in <nodes>, c in <files>, d in <files> where len(a.rt_outlinks) > len(b.rt_outlinks) + 99 return a",
        "topics[len(self.publishers) + len(config.nodes.all) < 0]",
        "packages[len(self.source_files) > 99]",
    ],
)
def test_what_an_entity_has_is_worked_out_once(text: str) -> None:
    variables = scene()
    node = variables["nodes"].items[0]
    assert node.rt_outlinks is node.rt_outlinks
    assert node.of("publishers") is node.of("publishers")
    assert variables["packages"][0].source_files is variables["packages"][0].source_files
    assert variables["topics"].counter is variables["topics"].counter
    assert Query(text, variables).matches(variables) == ()
