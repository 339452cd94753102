# SPDX-License-Identifier: Apache-2.0
"""Python: imports inside of functions, in blocks that have no scopes of their own."""

from __future__ import annotations

import pytest
from follow_kit import ends, explicit, follow, names, only, python

CODE = "def f():\n    %s\n    rospy.Publisher('a', %s, queue_size=1)\nf()\n"
BLOCKS = {
    "plain": "from geometry_msgs.msg import Twist",
    "try": "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        return",
    "try with a note": "try:\n        from geometry_msgs.msg import Twist\n    except ImportError as err:\n        print(err)\n        raise",
    "if": "if True:\n        from geometry_msgs.msg import Twist",
    "with": "with lock:\n        from geometry_msgs.msg import Twist",
    "try or none": "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        Twist = None",
    "none, then try": "Twist = None\n    try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        pass",
    "once more": "from std_msgs.msg import String as Twist\n    from geometry_msgs.msg import Twist",
}


@pytest.mark.parametrize("name", BLOCKS)
def test_a_type_that_a_block_imports(name: str) -> None:
    (end,) = ends(python(CODE % (BLOCKS[name], "Twist")))
    assert (end.name, end.type) == ("/a", "geometry_msgs/Twist")


@pytest.mark.parametrize(
    "block",
    [
        "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        from other.msg import Twist",
        "try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        Twist = String",
    ],
)
def test_one_of_several_is_not_known(block: str) -> None:
    (end,) = ends(python(CODE % (block, "Twist")))
    assert end.type is None and [u.field for u in end.unknowns] == ["type"]


def test_a_name_of_another_function() -> None:
    other = (
        "def g():\n    try:\n        from geometry_msgs.msg import Twist\n    except ImportError:\n        pass\ng()\n"
    )
    (end,) = ends(python(other + CODE % ("pass", "String")))
    assert end.type == "std_msgs/String"


STAND_IN = "class Talker:\n    def __init__(self, *args, **others):\n        pass\n"
INSTEAD = (
    ("try:\n    from lib.talk import Talker\nexcept ImportError:\n%s", ["/talk"]),
    ("if f():\n    from lib.talk import Talker\nelse:\n%s", ["/talk"]),
    ("try:\n    from elsewhere import Talker\nexcept ImportError:\n%s", []),
    ("from lib.talk import Talker\n%s", []),
    ("%s", []),
)


@pytest.mark.parametrize(("text", "expected"), INSTEAD)
def test_a_class_that_stands_in_for_what_cannot_be_imported(text: str, expected: list[str]) -> None:
    inner = "".join(f"    {line}\n" for line in STAND_IN.splitlines()) if text.startswith(("try", "if")) else STAND_IN
    talk = 'import rospy\nfrom std_msgs.msg import String\nclass Talker:\n    def __init__(self):\n        rospy.Publisher("talk", String)\n'
    assert names(python(text % inner + "Talker()\n", talk=talk)) == expected


def test_the_node_class_of_rclpy_is_meant_where_there_is_a_stand_in() -> None:
    text = (
        "try:\n    import rclpy\n    from rclpy.node import Node\n    from std_msgs.msg import String\n"
        "except ImportError:\n    class Node:\n        pass\n"
        "class L(Node):\n    def __init__(self):\n        super().__init__('l')\n        self.create_publisher(String, 'a', 5)\n"
        "def main():\n    rclpy.init()\n    rclpy.spin(L())\n"
    )
    setup = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.m:main']})"
    (made,) = only(follow({"p/setup.py": setup, "p/p/__init__.py": "", "p/p/m.py": text}, 2)).nodes
    assert [end.name for end in explicit(made)] == ["/a"]
