# SPDX-License-Identifier: Apache-2.0
"""Python modules that lie beside the script that is run: its directory comes first in ``sys.path``."""

from __future__ import annotations

import pytest
from follow_kit import follow, names, node, python_files, script

ARM = 'import rospy\nfrom std_msgs.msg import String\nclass Arm:\n    def __init__(self, name):\n        rospy.Publisher(name, String)\nNAME = "n"\n'
PRINT = "def show():\n    pass\n"


def publishers(code: str, beside: dict[str, str]) -> list[str]:
    """The names that a script with this code publishes; *beside* are files of its directory."""
    files = {f"p/scripts/{name}.py": text for name, text in beside.items()}
    return names(node(follow(python_files(script(code), lib="") | files)))


@pytest.mark.parametrize(
    ("code", "beside"),
    [
        ('from arm import Arm\nArm("a")\n', {"arm": ARM}),
        ('import arm\narm.Arm("a")\n', {"arm": ARM}),
        ('import arm as m\nm.Arm("a")\n', {"arm": ARM}),
        ('from arm import *\nArm("a")\n', {"arm": ARM}),
        ("import left\nleft.make()\n", {"arm": ARM, "left": 'from arm import Arm\ndef make():\n    Arm("a")\n'}),
        (
            "import arm\nclass B(arm.Arm):\n    def __init__(self):\n        super().__init__('a')\nB()\n",
            {"arm": ARM},
        ),
        ('from parts.arm import Arm\nArm("a")\n', {"parts/arm": ARM}),
        ('import parts.arm\nparts.arm.Arm("a")\n', {"parts/arm": ARM, "parts/__init__": ""}),
        ('from parts import Arm\nArm("a")\n', {"parts/arm": ARM, "parts/__init__": "from .arm import Arm\n"}),
        (
            "from parts.b import make\nmake()\n",
            {"parts/arm": ARM, "parts/b": 'from .arm import Arm\ndef make():\n    Arm("a")\n'},
        ),
        (
            "from parts.in_.b import make\nmake()\n",
            {"parts/arm": ARM, "parts/in_/b": 'from ..arm import Arm\ndef make():\n    Arm("a")\n'},
        ),
    ],
)
def test_a_module_beside_the_script_is_followed(code: str, beside: dict[str, str]) -> None:
    assert publishers(code, beside) == ["/a"]


@pytest.mark.parametrize(
    ("code", "beside"),
    [
        ('from legs import Arm\nArm("a")\n', {"arm": ARM}),  # no such file
        ('from arm import Arm\nArm("a")\n', {"parts/arm": ARM}),  # not in that directory
        ('from arm import Leg\nLeg("a")\n', {"arm": ARM}),  # no such class
        ('from .arm import Arm\nArm("a")\n', {"other/arm": ARM}),
        ('from queue import Arm\nArm("a")\n', {"queue": ARM}),  # a module of Python
        ('from actionlib import Arm\nArm("a")\n', {"actionlib": ARM}),  # a library that is known
        ("import arm\n", {"arm": ARM}),
        ("import n\n", {"arm": ARM}),  # itself
        ("import one\n", {"one": "import two\nfrom two import b\n", "two": "import one\nfrom one import a\nb = a\n"}),
    ],
)
def test_nothing_is_made_of_what_is_not_there(code: str, beside: dict[str, str]) -> None:
    assert publishers(code, beside) == []


def test_interfaces_are_those_of_the_package_also_beside_a_script_of_its_name() -> None:
    files = python_files(script('from p.msg import M\nrospy.Publisher("a", M)\n'), lib="")
    files |= {"p/scripts/p.py": PRINT, "p/msg/M.msg": "int32 a\n"}
    (end,) = node(follow(files)).endpoints
    assert (end.name, end.type) == ("/a", "p/M")


def test_a_module_of_the_package_does_not_look_beside_itself() -> None:
    files = python_files(
        script("import lib.tool\nlib.tool.make()\n"), tool="from arm import Arm\ndef make():\n    Arm('a')\n"
    )
    assert names(node(follow(files | {"p/src/arm.py": "Arm = len\n", "p/scripts/arm.py": ARM}))) == ["/a"]
