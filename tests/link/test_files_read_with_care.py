# SPDX-License-Identifier: Apache-2.0
"""Python: YAML files of a package that are found by pathlib, and that are read in a ``try`` whose handler has something in their place."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, names, python_files, script
from follow_kit import node as only_node
from test_ros2_python import CLASS, HEAD, MAIN, SETUP

YAML = "topic: /told\nlist: [/a, /b]\n"
IMPORTS = (
    "import os, pathlib, yaml\nfrom pathlib import Path\nfrom ament_index_python.packages import *\n"
    "from ament_index_python.packages import get_package_share_directory, get_package_share_path\nimport other\n"
)
SHARE = "get_package_share_directory('p')"
OPEN = f"with open(os.path.join({SHARE}, 'config', 'a.yaml')) as f:"


def topics(body: str, methods: str = "") -> list[str]:
    """The topics of a node with this in its constructor."""
    inside = "".join(f"        {line}\n" for line in body.splitlines())
    inside += "".join(f"    {line}\n" for line in methods.splitlines())
    text = HEAD + IMPORTS + CLASS + inside + MAIN + "    rclpy.spin(N())\n"
    files = {"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text, "p/config/a.yaml": YAML}
    found = next(one for one in follow(files, 2).configurations[0].nodes if one.name == "/s/n")
    return sorted(end.name for end in explicit(found))


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        (f"Path({SHARE}) / 'config' / 'a.yaml'", ["/told"]),
        (f"Path({SHARE}) / 'config/a.yaml'", ["/told"]),
        (f"pathlib.Path({SHARE}, 'config', 'a.yaml')", ["/told"]),
        (f"Path({SHARE}).joinpath('config', 'a.yaml')", ["/told"]),
        ("get_package_share_path('p') / 'config' / 'a.yaml'", ["/told"]),
        (f"Path(os.path.join({SHARE}, 'config')) / 'a.yaml'", ["/told"]),
        (f"(Path({SHARE}) / 'config' / 'b.yaml').parent / 'a.yaml'", ["/told"]),
        (f"Path({SHARE}) / 'config' / f'{{\"a\"}}.yaml'", ["/told"]),
        (f"Path({SHARE}) / 'config' / 'b.yaml'", ["/?"]),
        (f"Path({SHARE}) / other.name() / 'a.yaml'", ["/?"]),
        (f"Path({SHARE}) / '/config' / 'a.yaml'", ["/?"]),
        ("Path(other.directory()) / 'config' / 'a.yaml'", ["/?"]),
        ("Path.home() / 'config' / 'a.yaml'", ["/?"]),
        ("Path('config') / 'a.yaml'", ["/?"]),
        ("Path(__file__).parent / 'config' / 'a.yaml'", ["/?"]),
    ],
)
@pytest.mark.parametrize(
    "read",
    [
        "with open(path) as f:\n    data = yaml.safe_load(f)",
        "data = yaml.safe_load(path.read_text())",
        "with path.open('r') as f:\n    data = yaml.safe_load(f)",
        "data = yaml.safe_load(open(str(path)))",
    ],
)
def test_paths_of_pathlib(path: str, expected: list[str], read: str) -> None:
    assert topics(f"path = {path}\n{read}\nself.create_publisher(String, data['topic'], 1)") == expected


def test_the_directory_of_a_program_of_ros1() -> None:
    body = "import yaml\nfrom pathlib import Path\np = Path(__file__).resolve().parent.parent / 'config' / 'a.yaml'\nPUB(yaml.safe_load(p.open())['topic'])"
    assert names(only_node(follow(python_files(script(body)) | {"p/config/a.yaml": YAML}))) == ["/told"]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("data = {}", ["/a", "/b", "/told"]),
        ("data = None", ["/a", "/b", "/told"]),
        ("data = {'topic': 'other', 'list': []}", ["/a", "/b", "/told"]),
        ("self.get_logger().error('no file')\n    data = dict()", ["/a", "/b", "/told"]),
        ("raise", ["/a", "/b", "/told"]),
        ("return", ["/a", "/b", "/told"]),
    ],
)
def test_a_handler_with_something_in_place_of_the_file(body: str, expected: list[str]) -> None:
    read = f"try:\n    {OPEN}\n        data = yaml.safe_load(f)\nexcept Exception as e:\n    {body}\n"
    make = "self.create_publisher(String, data['topic'], 1)\nfor t in data.get('list', []):\n    self.create_publisher(String, t, 1)"
    assert topics(read + make) == expected


@pytest.mark.parametrize(
    "code",
    [
        # the file is not here, or something in the block may fail
        f"try:\n    {OPEN.replace('a.yaml', 'c.yaml')}\n        t = yaml.safe_load(f)['topic']\nexcept Exception:\n    t = 'other'",
        f"try:\n    {OPEN}\n        data = yaml.safe_load(f)\n    t = data['topic'] + other.end()\nexcept Exception:\n    t = 'other'",
        f"try:\n    {OPEN}\n        t = yaml.safe_load(f)['absent']\nexcept KeyError:\n    t = other.name()",
        f"try:\n    t = 'one'\n    other.check()\n    {OPEN}\n        t = yaml.safe_load(f)['topic']\nexcept Exception:\n    t = 'other'",
        # nothing is read in it
        "try:\n    t = other.name()\nexcept Exception:\n    t = 'other'",
        "try:\n    t = other.name()\n    u = 'x'\nexcept Exception:\n    t = 'other'",
        f"{OPEN}\n    data = yaml.safe_load(f)\ntry:\n    t = data['topic'] + other.end()\nexcept Exception:\n    t = 'other'",
    ],
)
def test_what_may_fail_stays_open(code: str) -> None:
    found = topics(f"{code}\nself.create_publisher(String, t, 1)")
    assert found != ["/told"]
    assert "/s/other" in found or "?" in "".join(found)


def test_texts_that_are_no_paths() -> None:
    body = "a = 'x'\nself.create_publisher(String, a.parent, 1)\nself.create_publisher(String, a.strip() + '/y', 1)"
    assert "/s/x/y" in topics(body)
