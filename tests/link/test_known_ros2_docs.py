# SPDX-License-Identifier: Apache-2.0
"""docs/known-nodes.md lists the ROS 2 nodes that the data files have. Run this file to write its table anew."""

from __future__ import annotations

import re
from pathlib import Path

from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.known.load import known_packages, load_known, load_user, parse
from haros_ci.systems.known.quality import POLICIES, PRESETS
from haros_ci.systems.known.shape import ROS2_DISTRIBUTIONS, ROS2_KEYS, ROS2_PARAMETER_TYPES

PAGE = Path(__file__).resolve().parents[2] / "docs" / "known-nodes.md"
HEADING = "### Known ROS 2 nodes\n\n"
NEXT = "## What there is\n"


def table() -> str:
    """One row per package."""
    rows = ["| package | node types | endpoints |", "|---|---|---|"]
    total = 0
    for package in known_packages(2):
        nodes = {node.type: node for node in (load_known(package, 2) or {}).values()}
        shown = [f"[`{name}`]({node.source})" for name, node in sorted(nodes.items())]
        rows.append(f"| `{package}` | {', '.join(shown)} | {sum(len(node.endpoints) for node in nodes.values())} |")
        total += len(nodes)
    return f"{total} node types of {len(known_packages(2))} packages.\n\n" + "\n".join(rows) + "\n\n"


def part() -> str:
    text = PAGE.read_text(encoding="utf-8")
    return text.partition("## ROS 2\n")[2].partition(NEXT)[0]


def test_the_table_lists_the_data() -> None:
    assert part().partition(HEADING)[2] == table(), f"run {Path(__file__).name} to write the table anew"


def test_the_form_is_described() -> None:
    text = part().partition(HEADING)[0]
    for word in (*ROS2_KEYS, *POLICIES, "default", "read_only"):
        assert f"`{word}`" in text, word
    for words in (PRESETS, ROS2_DISTRIBUTIONS, ROS2_PARAMETER_TYPES):
        assert ", ".join(words) in text


def test_the_example_is_one() -> None:
    (block,) = re.findall(r"```yml\n(.*?)```", part(), re.DOTALL)
    data = parse(block)
    assert isinstance(data, dict)
    found, problems = load_user(data["known_nodes"], "haros.yaml")
    assert problems == ()
    node = found["acme_arm"]["acme_arm::ArmDriver"]
    assert node.lifecycle and node.node_name == "arm"
    values = {"/cell/arm:arms": ["left", "right"], "/cell/arm:left.topic": "/left/move", "/cell/arm:right.topic": "go"}
    ends = instantiate(
        node, name="/cell/arm", namespace="/cell", arguments=(), parameter=values.get, remap=lambda name: name, ros=2
    )
    assert [(end.kind, end.name) for end in ends] == [
        ("publishers", "/cell/joint_states"),
        ("subscribers", "/left/move"),
        ("subscribers", "/cell/go"),
        ("action_servers", "/cell/arm/move"),
        ("parameters", "/cell/arm:force.sensor"),
        ("parameters", "/cell/arm:arms"),
    ]


if __name__ == "__main__":
    whole = PAGE.read_text(encoding="utf-8")
    before, _, rest = whole.partition("## ROS 2\n")
    here, _, after = rest.partition(NEXT)
    PAGE.write_text(f"{before}## ROS 2\n{here.partition(HEADING)[0]}{HEADING}{table()}{NEXT}{after}", encoding="utf-8")
