# SPDX-License-Identifier: Apache-2.0
"""``Walk.found`` is shared by all nodes with the same files: nothing that belongs to one node may stand there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from follow_kit import ROS2_CMAKE, cpp_files, follow, main, python_files, script
from tree_kit import FROM_TEXT, HEAD, MAIN, REGISTER, SAY, tree

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.follow.frames import Frame
from haros_ci.index.build import build_index
from haros_ci.index.index import Index, Source
from haros_ci.systems import node_types
from haros_ci.values.abstract import Cell, Mapped, Object, Pointer, Sequence
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

EXAMPLES = sorted(path for path in (Path(__file__).parents[2] / "examples").iterdir() if [*path.rglob("package.xml")])
#: What one node has: its variables, scopes, and what has variables inside.
LIVE = (Cell, Frame, Mapped, Object, Pointer, Sequence)


@pytest.fixture
def indexes(monkeypatch: pytest.MonkeyPatch) -> list[Index]:
    """The indexes that are built from now on."""
    made: list[Index] = []

    def build(sources: Iterable[Source]) -> Index:
        made.append(build_index(sources))
        return made[-1]

    monkeypatch.setattr(node_types, "build_index", build)
    return made


def live(value: object, depth: int = 6) -> Iterator[object]:
    """What in a value belongs to one node, inside containers, too."""
    if isinstance(value, LIVE):
        yield value
    elif depth and isinstance(value, dict):
        for key, item in value.items():
            yield from live(key, depth - 1)
            yield from live(item, depth - 1)
    elif depth and isinstance(value, (list, tuple, set, frozenset)):
        for item in value:
            yield from live(item, depth - 1)


def kept(indexes: list[Index]) -> list[object]:
    """The keys of shared look-ups that hold something of a node; there are look-ups."""
    found = [item for index in indexes for cache in index.caches.values() for item in cache.items()]
    assert found
    return [key for key, value in found if next(live(value), None) is not None]


@pytest.mark.parametrize("root", EXAMPLES, ids=lambda path: path.name)
def test_look_ups_of_the_examples_hold_nothing_of_a_node(root: Path, indexes: list[Index]) -> None:
    found = architecture(discover(root, ()), Settings(root=root), MemoryCache(), environment={}, processes=1)
    assert found.configurations
    assert kept(indexes) == []


def tree_files() -> dict[str, str]:
    """A node that creates a behaviour tree, whose class declares a port with a default."""
    program = SAY % 'BT::InputPort<std::string>("topic", "a", "which")' + MAIN % (REGISTER + FROM_TEXT % tree("<Say/>"))
    cmake = ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/n.cpp)\nament_auto_package()\n"
    return {"p/CMakeLists.txt": cmake, "p/src/n.cpp": HEAD + program}


MODULE = "first = []\ndef change():\n    global first\n    first = [1]\n"


@pytest.mark.parametrize(
    "files",
    [
        python_files(script("from lib.own import first\nPUB('a')\n"), own=MODULE),
        python_files(script("from lib import own\nown.change()\nfor x in own.first: PUB('a')\n"), own=MODULE),
        cpp_files(main('static ros::Publisher p = ADV("a", 1);')),
        cpp_files(
            main(
                "S::get().go();",
                'struct S { static S& get() { static S s; return s; } ros::NodeHandle nh; void go() { nh.advertise<std_msgs::String>("a", 1); } };',
            )
        ),
        tree_files(),
    ],
    ids=["global of a module", "module", "static", "singleton", "tree"],
)
def test_look_ups_hold_nothing_of_a_node(files: dict[str, str], indexes: list[Index]) -> None:
    assert follow(files, 2 if "rclcpp" in str(files) else 1).configurations
    assert kept(indexes) == []


def test_what_belongs_to_a_node_is_found() -> None:
    assert [*live({("key",): [(1, Cell(None))]})] != []
