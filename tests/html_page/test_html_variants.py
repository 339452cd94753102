# SPDX-License-Identifier: Apache-2.0
"""Which nodes come and go under other launch arguments."""

from __future__ import annotations

import pytest
from page_kit import node

from haros_ci.html_page.pool import Pool
from haros_ci.html_page.variants import variants
from haros_ci.model.architecture import Configuration, Node
from haros_ci.model.launch_facts import ArgumentDeclaration
from haros_ci.model.location import Location
from haros_ci.model.presence import Choice, choice


def found(
    *nodes: Node, others: tuple[Node, ...] = (), arguments: dict[str, str], **choices: tuple[str, ...]
) -> list[tuple[str, list[int], list[int]]]:
    facts = tuple(
        ArgumentDeclaration(location=Location("l", 1), name=name, choices=values) for name, values in choices.items()
    )
    one = Configuration(
        name="x", nodes=nodes, alternatives=others, arguments=tuple(arguments.items()), launch_facts=facts
    )
    pool = Pool()
    made = variants(pool, one, nodes, others)
    texts = pool.document().get("texts", [])
    return [(texts[words], gone, come) for words, gone, come in made]


ON, OFF = choice("sim", "true", boolean=True), choice("sim", "false", boolean=True)


def test_what_one_argument_decides() -> None:
    driver, always, simulator = node("/driver", presence=(OFF,)), node("/always"), node("/simulator", presence=(ON,))
    made = found(driver, always, others=(simulator,), arguments={"sim": "False"})
    assert made == [("sim:=True", [0], [0])]


def test_what_is_there_by_default_alone_can_go() -> None:
    assert found(node("/driver", presence=(OFF,)), arguments={"sim": "false"}) == [("sim:=true", [0], [])]


def test_values_that_nodes_ask_for() -> None:
    others = (node("/a", presence=(Choice("kind", "a"),)), node("/b", presence=(Choice("kind", "b"),)))
    base = node("/none", presence=(Choice("kind", "a", False), Choice("kind", "b", False)))
    made = found(base, others=others, arguments={"kind": "c"})
    assert made == [("kind:=a", [0], [0]), ("kind:=b", [0], [1])]


def test_choices_that_are_declared() -> None:
    base = node("/none", presence=(Choice("kind", "c"),))
    assert found(base, arguments={"kind": "c"}, kind=("c", "d")) == [("kind:=d", [0], [])]


def test_two_arguments_at_once_and_what_one_of_them_does_alone() -> None:
    both = node("/both", presence=(Choice("kind", "a"), ON))
    one = node("/one", presence=(Choice("kind", "a"),))
    made = found(node("/x"), others=(both, one), arguments={"sim": "false", "kind": "c"})
    assert made == [("kind:=a", [], [1]), ("kind:=a sim:=true", [], [0, 1])]


@pytest.mark.parametrize(
    ("nodes", "others", "arguments"),
    [
        ((node("/x"),), (), {"sim": "true"}),
        ((node("/x"),), (), {}),
        ((), (), {}),
        # a value that the default excludes and of which no other is known
        (
            (node("/x", presence=(Choice("kind", "c"),)),),
            (node("/y", presence=(Choice("kind", "c", False),)),),
            {"kind": "c"},
        ),
    ],
)
def test_nothing_is_offered(nodes: tuple[Node, ...], others: tuple[Node, ...], arguments: dict[str, str]) -> None:
    assert found(*nodes, others=others, arguments=arguments) == []


def test_what_is_offered_is_bounded() -> None:
    others = tuple(node(f"/n{n}", presence=(Choice("kind", f"v{n}"),)) for n in range(100))
    assert len(found(others=others, arguments={"kind": "c"})) == 40
