# SPDX-License-Identifier: Apache-2.0
"""Many nodes under new names: so many pairs are compared, and beyond that none is taken for renamed."""

from __future__ import annotations

import pytest

from haros_ci.changes import nodes
from haros_ci.model.architecture import Node
from haros_ci.model.location import Location


def many(mark: str, count: int) -> list[Node]:
    place = Location("all.launch", 1)
    return [
        Node(
            name=f"/{mark}{number}",
            location=place,
            kind="node",
            package="demo",
            type="talker",
            source="launch",
            ros=2,
            process="p",
        )
        for number in range(count)
    ]


@pytest.mark.parametrize(("count", "renamed"), [(0, 0), (1, 1), (3, 3), (200, 200), (201, 0), (500, 0)])
def test_nodes_under_new_names(count: int, renamed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    likened = 0
    before = nodes.likeness

    def counting(one: str, other: str) -> float:
        nonlocal likened
        likened += 1
        return before(one, other)

    monkeypatch.setattr(nodes, "likeness", counting)
    kept = many("kept", 300)
    pairs = nodes.pair([*kept, *many("old", count)], [*many("new", count), *kept])
    assert len(pairs.both) == 300 + renamed
    assert len(pairs.removed) == len(pairs.added) == count - renamed
    assert likened == renamed * renamed <= 40_000
