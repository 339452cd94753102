# SPDX-License-Identifier: Apache-2.0
"""Python: files that a program finds by where it lies itself. Of ROS 1 that is where its source is; of ROS 2 it is installed elsewhere."""

from __future__ import annotations

import pytest
from follow_kit import follow, names, node, python_files, script
from test_ros2_python import node as ros2_node

FILES = {
    "p/config/a.yaml": "talk:\n  topic: /told\n  extra: false\n",
    "p/scripts/b.yaml": "topic: /beside\n",
    "a.yaml": "topic: /root\n",
}
HEAD = "import os, yaml\nfrom os.path import dirname, join\nD = os.path.dirname\n"
READ = "with open(path) as f:\n    PUB(yaml.safe_load(f)['topic'])\n"
NESTED = (
    "def get(data, name, default=None):\n    for part in name.split('/'):\n        try:\n            data = data[part]\n"
    "        except Exception:\n            return default\n    return data\n"
)
#: Code, and the names of publishers.
CASES = {
    "beside the program": ("path = join(dirname(__file__), 'b.yaml')\n" + READ, ["/beside"]),
    "two above": (
        "path = join(D(D(os.path.abspath(__file__))), 'config/a.yaml')\n" + READ.replace("['to", "['talk']['to"),
        ["/told"],
    ),
    "with the way up in it": (
        "path = join(D(os.path.realpath(__file__)), '..', 'config', 'a.yaml')\n" + READ.replace("['to", "['talk']['to"),
        ["/told"],
    ),
    "put together with a plus": ("path = D(__file__) + '/b.yaml'\n" + READ, ["/beside"]),
    "a function that looks into it": (
        NESTED + "path = join(D(D(__file__)), 'config/a.yaml')\nPUB(get(yaml.safe_load(open(path)), 'talk/topic'))",
        ["/told"],
    ),
    "a switch": (
        "path = join(D(D(__file__)), 'config/a.yaml')\nd = yaml.safe_load(open(path))['talk']\nif d['extra']:\n    PUB('a')\nelse:\n    PUB('b')",
        ["/a", "/b"],
    ),
    "a file of the workspace outside of the package": ("path = join(D(D(D(__file__))), 'a.yaml')\n" + READ, ["/root"]),
    "a file that is not there": ("path = join(D(__file__), 'c.yaml')\n" + READ, ["/?"]),
    "a file outside of the workspace": ("path = join(D(__file__), '../../../a.yaml')\n" + READ, ["/?"]),
    "above the workspace": ("path = join(D(D(D(D(D(__file__))))), 'a.yaml')\n" + READ, ["/?"]),
    "a directory that is not known": ("path = join(D(__file__), rospy.get_param('~d'), 'b.yaml')\n" + READ, ["/?"]),
    "the name of the directory": ("PUB(os.path.basename(D(__file__)))", ["/?"]),
    "the whole path is no name": ("PUB('a/' + __file__)", ["/a/?/n.py"]),
    "the working directory": ("path = join(os.getcwd(), 'b.yaml')\n" + READ, ["/?"]),
}


@pytest.mark.parametrize(("code", "expected"), CASES.values(), ids=CASES)
def test_a_program_of_ros1(code: str, expected: list[str]) -> None:
    assert names(node(follow(python_files(script(HEAD + code)) | FILES))) == expected


def test_a_branch_that_the_file_decides() -> None:
    found = node(follow(python_files(script(HEAD + CASES["a switch"][0])) | FILES))
    assert {end.name: end.is_ruled_out for end in found.endpoints if end.kind == "publishers"} == {
        "/a": True,
        "/b": False,
    }


def test_a_program_of_ros2_lies_elsewhere() -> None:
    body = f"import os, yaml\npath = os.path.join(os.path.dirname(__file__), 'b.yaml')\n{READ}"
    found = ros2_node(
        body.replace("PUB(yaml.safe_load(f)['topic'])", "self.create_publisher(String, yaml.safe_load(f)['topic'], 1)")
    )
    assert [end.name for end in found.endpoints if end.kind == "publishers" and not end.implicit] == ["/?"]
