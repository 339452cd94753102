# SPDX-License-Identifier: Apache-2.0
"""The model as Mermaid flowcharts in Markdown."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from test_model_json import BASE, HOSTILE, ODOM, ROBOT, SAMPLE, VIEW

from haros_ci.model.architecture import Architecture
from haros_ci.report import model_mermaid

LABEL = re.compile(r'"(?:[A-Za-z0-9_/?.~, -]|#\d+;)+"')


def test_the_whole_text() -> None:
    assert (
        model_mermaid.render(SAMPLE)
        == """### robot

```mermaid
flowchart LR
  n0["/base"]
  n1["/view"]
  class n1 conditional
  t0x(["/base/?"])
  class t0x unknown
  t0x --> n0
  t1x(["/base/?"])
  class t1x conditional
  class t1x unknown
  t1x -.-> n1
  t2x(["/odom"])
  class t2x conditional
  n0 -.-> t2x
  t2x -.-> n1
  s3x{"/reset"}
  class s3x conditional
  n1 -.-> s3x
  a4x{{"/go"}}
  class a4x conditional
  n1 -.-> a4x
  classDef conditional stroke-dasharray:5 5
  classDef unknown stroke:red,color:red
```
"""
    )


@pytest.mark.parametrize(
    "name",
    [
        HOSTILE,
        '"]\n  n0 --> n9',
        "```\n# x",
        "`md`",
        "%%{init: {}}%%",
        "<img src=x>",
        "#quot;",
        "end",
        "1. x",
        "",
        "@team",
    ],
)
def test_hostile_names_stay_in_their_label(name: str) -> None:
    node = replace(BASE, name=name, endpoints=(replace(ODOM, name=name),))
    text = model_mermaid.render(Architecture(configurations=(replace(ROBOT, name=name, nodes=(node, VIEW)),)))
    heading, rest = text.split("\n", 1)
    bare = LABEL.sub("L", rest)
    assert re.fullmatch(r"[A-Za-z0-9 =;,:{}()\[\]\n>.`-]*", bare) and '"' not in bare
    assert bare.count("```") == 2 and bare.startswith("\n```mermaid\n") and bare.endswith("\n```\n")
    assert not re.search(r"[<>@`\[\]|]|::", heading)


@pytest.mark.parametrize(
    ("text", "label"),
    [
        ("/a/b_1", '"/a/b_1"'),
        ("/a?", '"/a?"'),
        ('"', '"#34;"'),
        ("a`b", '"a#96;b"'),
        ("a;b#c", '"a#59;b#35;c"'),
        ("1. x", '"#49;. x"'),
        ("- x", '"#45; x"'),
        ("\u202e", '"#65533;"'),
        ("é", '"#233;"'),
        ("", '"#32;"'),
    ],
)
def test_labels(text: str, label: str) -> None:
    assert model_mermaid.label(text) == label


def test_what_is_too_large_is_not_drawn() -> None:
    ends = tuple(replace(ODOM, name=f"/t{number}") for number in range(501))
    text = model_mermaid.render(
        Architecture(configurations=(replace(ROBOT, nodes=(replace(BASE, endpoints=ends),)), replace(ROBOT, name="a")))
    )
    assert text.count("```mermaid") == 1
    assert text.endswith(
        "### robot\n\nToo large for a diagram here (1 node, 501 edges): print it as DOT and draw it with GraphViz.\n"
    )


def test_nothing() -> None:
    assert model_mermaid.render(Architecture()) == "No configurations.\n"
