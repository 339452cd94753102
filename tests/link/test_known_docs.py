# SPDX-License-Identifier: Apache-2.0
"""docs/known-nodes.md lists what the data files have. Run this file to write its table anew."""

from __future__ import annotations

import re
from pathlib import Path

from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.known.load import known_packages, load_known, load_user, parse
from haros_ci.systems.known.shape import COMMON_KEYS, DISTRIBUTIONS, NODE_KEYS
from haros_ci.systems.known.text import HOLES

PAGE = Path(__file__).resolve().parents[2] / "docs" / "known-nodes.md"
HEADING = "## What there is\n\n"


def table() -> str:
    """One row per node type."""
    rows = ["| package | node type | distributions | endpoints | described at |", "|---|---|---|---|---|"]
    count = 0
    for package in known_packages():
        for node in (load_known(package) or {}).values():
            kind = f"`{node.type}`" + (" (nodelet)" if node.nodelet else "")
            where = ", ".join(node.distributions) or "all"
            rows.append(f"| `{package}` | {kind} | {where} | {len(node.endpoints)} | [page]({node.source}) |")
            count += 1
    return f"{count} node types of {len(known_packages())} packages.\n\n" + "\n".join(rows) + "\n"


def test_the_table_lists_the_data() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert text.partition(HEADING)[2] == table(), f"run {Path(__file__).name} to write the table anew"


def test_the_form_is_described() -> None:
    text = PAGE.read_text(encoding="utf-8").partition(HEADING)[0]
    for word in (*NODE_KEYS, *COMMON_KEYS, "queue_size", "latched", "default"):
        assert f"`{word}`" in text, word
    for hole in HOLES:
        assert f"{{{hole}" in text, hole
    assert f"some of {', '.join(DISTRIBUTIONS)}" in text


def test_the_example_is_one() -> None:
    (block,) = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    data = parse(block)
    assert isinstance(data, dict)
    found, problems = load_user(data["known_nodes"], "haros.yaml")
    assert problems == ()
    assert {p: sorted(nodes) for p, nodes in found.items()} == {"acme_arm": ["acme_arm/GripperNodelet", "arm_driver"]}
    ends = instantiate(
        found["acme_arm"]["arm_driver"],
        name="/arm",
        namespace="/",
        arguments=(),
        parameter={"/arm/command_topic": "/trajectory"}.get,
        remap=lambda name: name,
    )
    assert [(end.kind, end.name) for end in ends] == [
        ("publishers", "/joint_states"),
        ("subscribers", "/trajectory"),
        ("getters", "/arm/rate"),
    ]


if __name__ == "__main__":
    before = PAGE.read_text(encoding="utf-8").partition(HEADING)[0]
    PAGE.write_text(before + HEADING + table(), encoding="utf-8")
