# SPDX-License-Identifier: Apache-2.0
"""Where properties stand in project files, and where their parts stand there."""

from __future__ import annotations

import pytest

from haros_ci.behaviour.declared import in_file, in_project

FILES = {"p/a.hpl": ("src/p/a.hpl", "globally: no /f\nglobally: no {\n")}
PROJECT = """\
configurations:
  one:
    launch: [p/x.launch]
    hpl:
      properties:
        - globally:no /topic
        - 'globally: no /topic {x = "it''s"}'
        - "globally: no /topic {x = \\"a\\" and
             y.topic > 1}"
        - |
          # id: block
          globally:
            no /topic
        - >-
          globally:
          no /topic
      assumptions: ['globally: some /topic']
      axioms: [&shared 'globally: no /topic {x}', *shared]
      files: [p/a.hpl]
      other: [passed over]
  two: [p/x.launch]
  three:
nodes:
  p/x:
    hpl: {properties: ['globally: no /topic']}
"""


def test_where_they_stand() -> None:
    found = in_project(PROJECT, "haros.yaml", FILES.get)
    assert [(str(each.owner), each.is_axiom, each.fault is None) for each in found] == [
        *[("the configuration one", False, True)] * 5,
        *[("the configuration one", True, True)] * 3,
        ("the configuration one", False, True),
        ("the configuration one", False, False),
        ("the node p/x", False, True),
    ]
    lines = PROJECT.split("\n")
    for each in found:
        for event in each.parsed.events if each.parsed is not None else ():
            place = each.at(event.topic_at)
            text = FILES["p/a.hpl"][1].split("\n") if place.path == "src/p/a.hpl" else lines
            assert place.line is not None and place.column is not None and place.end_column is not None
            assert text[place.line - 1][place.column - 1 : place.end_column - 1] == event.topic


def test_a_part_behind_escapes_and_folds() -> None:
    found = in_project(PROJECT, "haros.yaml", FILES.get)
    third = found[2]
    assert third.parsed is not None
    (event,) = third.parsed.pattern.behaviour
    assert event.predicate is not None
    place = third.at(event.predicate.right.at)  # type: ignore[union-attr]
    assert (place.line, place.column) == (9, 14)
    assert found[3].identity == "block"
    assert found[0].identity == "globally: no /topic"


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("hpl: {properties: [globally: no /a]}", 3, "put it in quotes: YAML takes 'globally:' as a key"),
        ("hpl: {properties: [3]}", 3, "a property must be text"),
        ("hpl: {properties: 'globally: no /a'}", 3, "'properties' must be a list"),
        ("hpl: ['globally: no /a']", 3, "'hpl' must be a map"),
        ("hpl: {files: [p/none.hpl]}", 3, "no file p/none.hpl"),
        ("hpl: {files: [7]}", 3, "the name of a file must be text"),
        ("hpl:\n      properties:\n        - 'globally: no /a {x > }'", 5, "a value"),
    ],
)
def test_what_is_no_property(text: str, line: int, said: str) -> None:
    (found,) = in_project(f"nodes:\n  p/x:\n    {text}\n", "haros.yaml", FILES.get)
    assert found.fault is not None and said in found.fault.whole
    assert found.location.line == line


@pytest.mark.parametrize(
    "text",
    ["", "nodes: {p/x: {}}", "nodes: {p/x: {hpl: }}", "nodes: {p/x: {hpl: {}}}", "nodes: {p/x: {hpl: {properties: }}}", "hpl: {properties: [x]}", "nodes: [hpl]",
     "configurations: hpl", "hpl: {a: b: c}", "nodes: {p/x: {hpl: {properties: []}}}", "# hpl\n"],
)  # fmt: skip
def test_none_are_stated(text: str) -> None:
    assert in_project(text, "haros.yaml", FILES.get) == ()


def test_files_have_an_end() -> None:
    named = ", ".join(["p/a.hpl"] * 150)
    found = in_project(f"nodes:\n  p/x:\n    hpl: {{files: [{named}]}}\n", "haros.yaml", FILES.get)
    assert len(found) == 201
    assert found[-1].fault is not None and "more than 100 files" in found[-1].fault.message


def test_a_file_alone() -> None:
    found = tuple(in_file("# id: a\nglobally: no /a\n\nglobally: no /b {\n", "x.hpl"))
    assert [(each.location.line, each.identity) for each in found[:1]] == [(2, "a")]
    assert found[1].fault is not None and found[1].location.line == 5 and str(found[1].owner) == "the workspace"
