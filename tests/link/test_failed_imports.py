# SPDX-License-Identifier: Apache-2.0
"""Classes whose base is imported in a ``try`` and stands for nothing where that fails."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, names, node, python

from haros_ci.model.architecture import Node

SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"
MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>"
BODY = """
class Wing(Node):
    def __init__(self):
        super().__init__("wing")
        self.out = self.create_publisher(String, "lift", 10)

def main():
    rclpy.init()
    rclpy.spin(Wing())
"""


def _node(head: str, body: str = BODY) -> Node:
    text = f"from std_msgs.msg import String\n{head}{body}"
    files = {"p/setup.py": SETUP, "p/package.xml": MANIFEST, "p/p/__init__.py": "", "p/p/n.py": text}
    return node(follow(files, 2))


TRY = "try:\n    import rclpy\n    from rclpy.node import Node\n"
#: The name is bound again to what stands for no class.
STANDS_FOR_NONE = (
    f"{TRY}except Exception:  # pragma: no cover\n    rclpy = None\n    Node = object\n",
    f"{TRY}except ImportError:\n    Node = object\n",
    f"{TRY}except ImportError:\n    rclpy = Node = None\n",
    f"{TRY}except (ImportError, OSError) as e:\n    rclpy, Node = None, object\n",
    f"{TRY}except ImportError:\n    rclpy: object = None\n    Node: type = object\n",
    f"READY = True\n{TRY}except ModuleNotFoundError:\n    READY = False\n    Node = object\n",
    f"{TRY}    from std_msgs.msg import String\nexcept ImportError:\n    Node = String = object\n",
    "try:\n    import rclpy\n    import rclpy.node as rn\nexcept ImportError:\n    rclpy = rn = None\nNode = rn.Node\n",
    "try:\n    import rclpy\n    from rclpy.lifecycle import LifecycleNode as Node\nexcept ImportError:\n    Node = object\n",
)


@pytest.mark.parametrize("head", STANDS_FOR_NONE)
def test_the_base_is_the_class_that_is_imported(head: str) -> None:
    found = _node(head)
    assert (found.name, [end.name for end in explicit(found)], found.unknowns) == ("/wing", ["/lift"], ())


def test_a_class_of_another_module() -> None:
    text = f"from p.base import Node, rclpy\nfrom std_msgs.msg import String\n{BODY}"
    files = {"p/setup.py": SETUP, "p/package.xml": MANIFEST, "p/p/__init__.py": "", "p/p/n.py": text}
    files["p/p/base.py"] = STANDS_FOR_NONE[0]
    assert node(follow(files, 2)).name == "/wing"


@pytest.mark.parametrize("other", ["None", "object"])
def test_a_module_of_ros1(other: str) -> None:
    body = (
        f"try:\n    from lib.bases import Base\nexcept ImportError:\n    Base = {other}\n"
        "class Wing(Base):\n    def __init__(self):\n        super().__init__('lift')\nWing()\n"
    )
    base = "import rospy\nfrom std_msgs.msg import String\nclass Base(object):\n    def __init__(self, name):\n"
    base += "        self.pub = rospy.Publisher(name, String, queue_size=1)\n"
    assert names(python(body, bases=base)) == ["/lift"]


#: Another class that may be meant, or none of the import.
NOT_KNOWN = (
    f"{TRY}except ImportError:\n    from elsewhere import Node\n",
    f"{TRY}except ImportError:\n    from unittest.mock import MagicMock\n    Node = MagicMock\n",
    f"{TRY}except ImportError:\n    Node = type('Node', (), {{}})\n",
    f"{TRY}except ImportError:\n    Node = made()\n",
    f"{TRY}except ImportError:\n    pass\nNode = object\n",
    f"{TRY}except ImportError:\n    pass\nNode = made()\n",
    "import rclpy\nfrom rclpy.node import Node\nNode = object\n",
    "import rclpy\nNode = object\n",
    "import rclpy\ntry:\n    from elsewhere import Node\nexcept ImportError:\n    Node = object\n",
    "import rclpy\ntry:\n    from elsewhere import Node\nexcept ImportError:\n    from rclpy.node import Node\n",
)


@pytest.mark.parametrize("head", NOT_KNOWN)
def test_what_another_class_may_do_is_not_known(head: str) -> None:
    found = _node(head)
    assert found.name == "/?" or found.unknowns
