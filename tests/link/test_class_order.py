# SPDX-License-Identifier: Apache-2.0
"""Python: the order in which a class and its bases are looked through, and attributes of classes and of objects."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, names, only, python

A = 'class A(object):\n    t = "A"\n    def n(self):\n        return "A"\n'
M = (
    'class M(A):\n    t = "M"\n    def n(self):\n        return "M" + super(M, self).n()\n'
    'class K(A):\n    t = "K"\n    def n(self):\n        return "K" + super().n()\n'
)
#: Code, and the names that follow.
CASES = (
    (A + M + "class C(M, K):\n    pass\nPUB(C().n())", ["/MKA"]),
    (A + M + "class C(K, M):\n    pass\nPUB(C().n())", ["/KMA"]),
    (A + M + "class C(M):\n    pass\nPUB(C().n())", ["/MA"]),
    (A + M + "class B(A):\n    pass\nclass C(B, K):\n    pass\nPUB(C().t)", ["/K"]),
    (A + M + "class B(A):\n    pass\nclass C(B, K):\n    pass\nPUB(C.t)", ["/K"]),
    (A + M + "class B(A):\n    pass\nclass C(B):\n    pass\nPUB(C().t)", ["/A"]),
    (A + 'class B(A):\n    def n(self):\n        return A.n(self) + "B"\nPUB(B().n())', ["/AB"]),
    (A + 'a = A()\na.t = "x"\nPUB(A.t)', ["/A"]),
    (A + 'a = A()\na.t = "x"\nPUB(A().t)', ["/A"]),
    (A + 'a = A()\na.t = "x"\nPUB(a.t)', ["/x"]),
    (A + 'A.t = "x"\nPUB(A().t)', ["/x"]),
    (A + 'a = A()\nA.t = "x"\nPUB(a.t)', ["/x"]),
    (A + 'a = A()\na.t += "x"\nPUB(a.t + A.t)', ["/AxA"]),
    (
        "class A:\n    c = 0\n    def __init__(self):\n        A.c += 1\n        PUB('t%d' % A.c)\nA()\nA()",
        ["/t1", "/t2"],
    ),
    (
        "class A:\n    c = 0\n    def __init__(self):\n        self.c += 1\n        PUB('t%d' % self.c)\nA()\nA()",
        ["/t1"],
    ),
    (
        "class A:\n    l = []\n    def __init__(self, n):\n        self.l.append(n)\nA('a')\nA('b')\nPUB(''.join(A.l))",
        ["/ab"],
    ),
)


@pytest.mark.parametrize(("code", "expected"), CASES)
def test_names_of_classes(code: str, expected: list[str]) -> None:
    assert names(python(code + "\n")) == expected


HEAD = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
MIXIN = (
    "class {0}:\n    def __init__(self, *args, **kwargs):\n        super().__init__(*args, **kwargs)\n"
    "        self.create_publisher(String, '{0}', 1)\n"
)
MAIN = "def main():\n    rclpy.init()\n    rclpy.spin(N())\n"
SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"


@pytest.mark.parametrize("bases", ["A, B, Node", "B, A, Node"])
def test_what_mixins_make_in_their_turn(bases: str) -> None:
    own = f"class N({bases}):\n    def __init__(self):\n        super().__init__('n')\n"
    text = HEAD + MIXIN.format("A") + MIXIN.format("B") + own + MAIN
    found = only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text}, 2))
    (node,) = found.nodes
    assert (node.name, sorted(end.name for end in explicit(node))) == ("/n", ["/A", "/B"])


@pytest.mark.parametrize(
    "call",
    [
        "type(self).create_publisher(self, String, 'a', 1)",
        "self.__class__.create_publisher(self, String, 'a', 1)",
        "N.create_publisher(self, String, 'a', 1)",
        "Node.create_publisher(self, String, 'a', 1)",
        "rclpy.node.Node.create_publisher(self, String, topic='a', qos_profile=1)",
    ],
)
def test_a_method_of_a_library_by_its_class(call: str) -> None:
    own = f"import rclpy.node\nclass N(Node):\n    def __init__(self):\n        super().__init__('n')\n        {call}\n"
    (node,) = only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": HEAD + own + MAIN}, 2)).nodes
    assert (node.name, [end.name for end in explicit(node)]) == ("/n", ["/a"])


@pytest.mark.parametrize(
    "call",
    [
        "B.create_publisher(self, String, 'a', 1)",
        "N.create_publisher(String, 'a', 1)",
        "N.give(self, String, 'a', 1)",
        "C.create_publisher(self, String, 'a', 1)",
    ],
)
def test_another_method_by_its_class(call: str) -> None:
    own = (
        "class C(Node):\n    pass\nclass B:\n    def create_publisher(self, *a):\n        pass\n"
        f"class N(B, Node):\n    def __init__(self):\n        Node.__init__(self, 'n')\n        {call}\n"
    )
    (node,) = only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": HEAD + own + MAIN}, 2)).nodes
    assert (node.name, explicit(node)) == ("/n", [])


def test_a_node_does_not_call_who_stands_behind_it() -> None:
    own = "class N(Node, A):\n    def __init__(self):\n        super().__init__('n')\n"
    text = HEAD + MIXIN.format("A") + own + MAIN
    (node,) = only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text}, 2)).nodes
    assert (node.name, explicit(node)) == ("/n", [])
