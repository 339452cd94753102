# SPDX-License-Identifier: Apache-2.0
"""Every data file on known nodes: its shape, its names, nothing twice, and no node that cannot be started."""

from __future__ import annotations

from collections import Counter

from every import every

from haros_ci.model.architecture import KINDS, Endpoint
from haros_ci.systems.known import load
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.known.load import known_packages, load_known, parse
from haros_ci.systems.known.shape import DISTRIBUTIONS, read_package

FILES = {package: (load._HERE / f"{package}.yaml").read_text(encoding="utf-8") for package in known_packages()}
NODES = [node for package in known_packages() for node in (load_known(package) or {}).values()]


@every("package", FILES)
def test_a_file_has_its_form(package: str) -> None:
    data = parse(FILES[package])
    assert isinstance(data, dict)
    nodes, problems = read_package(data, package, f"{package}.yaml")
    assert problems == []
    assert sorted(nodes) == sorted(data)
    assert FILES[package].startswith("# SPDX-License-Identifier: Apache-2.0\n")


@every("package", FILES)
def test_keys_of_a_file_stand_once(package: str) -> None:
    keys = [line for line in FILES[package].splitlines() if line[:1] not in ("", " ", "#")]
    assert keys == sorted(set(keys), key=keys.index)


def test_there_are_enough() -> None:
    assert len(NODES) >= 60


@every("node", NODES, ids=lambda node: f"{node.package}:{node.type}")
def test_a_node_says_where_it_is_described(node: KnownNode) -> None:
    assert node.source.startswith("https://")
    if node.nodelet:
        assert node.type.partition("/")[0] == node.package


@every("node", NODES, ids=lambda node: f"{node.package}:{node.type}")
def test_a_node_starts_without_anything(node: KnownNode) -> None:
    for distribution in (None, *DISTRIBUTIONS):
        ends = instantiate(
            node,
            name="/place/it",
            namespace="/place",
            arguments=(),
            parameter=lambda name: None,
            remap=lambda name: name,
            distribution=distribution,
        )
        sure = Counter((end.kind, end.name) for end in ends if not _told(end) & {"name", "conditions"})
        assert [key for key, count in sure.items() if count > 1] == []
        for end in ends:
            assert end.kind in KINDS
            assert end.source == "known-node" and end.location is None
            assert end.name.startswith("/") and "{" not in end.name and "//" not in end.name
            assert ("?" in end.name) == ("name" in _told(end))
            assert (end.type is None) == ("type" in _told(end))


def _told(end: Endpoint) -> set[str]:
    return {why.field for why in end.unknowns}
