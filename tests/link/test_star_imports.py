# SPDX-License-Identifier: Apache-2.0
"""Modules that bring in all names of others: a name is looked for once in each, and found wherever it is."""

from __future__ import annotations

import sys
from typing import Any

import pytest
from follow_kit import PYTHON_HEAD, PYTHON_INIT, ends, follow, names, node, python_files

from haros_ci.model.architecture import Node

PUBLISH = "def PUB(n):\n    return rospy.Publisher(n, String, queue_size=1)\n"


def script(body: str, modules: dict[str, str]) -> Node:
    files = python_files(PYTHON_HEAD + PUBLISH + PYTHON_INIT + body, **modules)
    return node(follow(files))


def layers(depth: int) -> dict[str, str]:
    """Two modules in each layer, both of which bring in both of the next: 2 ** *depth* ways lead to the last."""
    found = {
        f"{side}{number}": f"from lib.a{number + 1} import *\nfrom lib.b{number + 1} import *\n"
        for number in range(depth)
        for side in "ab"
    }
    return found | {f"a{depth}": 'TOPIC = "deep"\n', f"b{depth}": ""}


def calls(depth: int, name: str) -> int:
    """How many functions are called to follow a script that looks for *name* through so many layers."""
    count = 0

    def called(frame: Any, event: str, argument: object) -> None:
        nonlocal count
        count += event == "call" and "/follow/" in frame.f_code.co_filename

    before = sys.getprofile()
    sys.setprofile(called)
    try:
        script(f"from lib.a0 import *\nPUB({name})", layers(depth))
    finally:
        sys.setprofile(before)
    return count


@pytest.mark.parametrize("name", ["TOPIC", "NOWHERE"])
def test_a_module_is_asked_once_for_a_name(name: str) -> None:
    assert calls(8, name) - calls(6, name) < 2 * (calls(6, name) - calls(4, name))


def test_the_name_is_found_through_all_layers() -> None:
    assert names(script("from lib.a0 import *\nPUB(TOPIC)", layers(8))) == ["/deep"]


@pytest.mark.parametrize(
    ("modules", "expected"),
    [
        ({"a": "from lib.b import *\n", "b": "from lib.a import *\nTOPIC = 'b'\n"}, ["/b"]),
        ({"a": "from lib.b import *\nTOPIC = 'a'\n", "b": "from lib.a import *\n"}, ["/a"]),
        ({"a": "from lib.c import *\nfrom lib.b import *\n", "b": "from lib.c import *\n", "c": "TOPIC = 'c'\n"}, ["/c"]),
        # What is brought in last counts.
        ({"a": "from lib.b import *\nfrom lib.c import *\n", "b": "TOPIC = 'b'\n", "c": "TOPIC = 'c'\n"}, ["/c"]),
        ({"a": "from lib.c import *\nfrom lib.b import *\n", "b": "TOPIC = 'b'\n", "c": "TOPIC = 'c'\n"}, ["/b"]),
        # A module that looks for the same name while it is loaded.
        ({"a": "from lib.b import *\n", "b": "from lib.c import *\nOTHER = TOPIC\n", "c": "TOPIC = 'c'\n"}, ["/c"]),
        ({"a": "from lib.b import *\nfrom lib.c import *\n", "b": "from lib.c import *\n", "c": "TOPIC = 'c'\n"}, ["/c"]),
    ],
)  # fmt: skip
def test_which_module_has_it(modules: dict[str, str], expected: list[str]) -> None:
    assert names(script("from lib.a import *\nPUB(TOPIC)", modules)) == expected


def test_a_name_that_no_module_has_is_not_known() -> None:
    modules = {"a": "from lib.b import *\n", "b": "from lib.a import *\n"}
    assert [end.name for end in ends(script("from lib.a import *\nPUB(TOPIC)", modules))] == ["/?"]
