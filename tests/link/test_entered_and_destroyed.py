# SPDX-License-Identifier: Apache-2.0
"""What is made where a ``with`` begins or ends, in destructors, and with a type whose import a handler of exceptions replaces by None."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_main
from test_ros2_python import program

MANAGER = (
    "class M:\n    def __init__(self, n):\n        self.n = n\n    def __enter__(self):\n        self.n.create_publisher(String, '/in', 1)\n"
    "        return self\n    def __exit__(self, a, b, c):\n        self.n.create_publisher(String, '/out', 1)\n"
    "    def go(self):\n        self.n.create_publisher(String, '/go', 1)\n"
)
NODE = (
    "class M(Node):\n    def __init__(self):\n        super().__init__('n')\n    def __enter__(self):\n"
    "        self.create_publisher(String, '/in', 1)\n        return self\n    def __exit__(self, *a):\n        pass\n"
)
OTHER = "class M:\n    def __init__(self, n):\n        self.n = n\n    def __enter__(self):\n        return self.n\n    def __exit__(self, *a):\n        pass\n"
PLAIN = MANAGER.replace("__enter__", "enter").replace("__exit__", "exit")


def made(body: str, before: str = "") -> list[str]:
    (node,) = program(body, before).nodes
    return sorted(end.name for end in explicit(node))


@pytest.mark.parametrize(
    ("body", "before", "expected"),
    [
        ("n = Node('n')\nwith M(n) as m:\n    m.go()", MANAGER, ["/go", "/in", "/out"]),
        ("n = Node('n')\nm = M(n)\nwith m:\n    m.go()", MANAGER, ["/go", "/in", "/out"]),
        ("n = Node('n')\nwith M(n):\n    pass", MANAGER, ["/in"]),
        ("with M() as n:\n    rclpy.spin(n)", NODE, ["/in"]),
        ("with M(Node('n')) as n:\n    n.create_publisher(String, '/x', 1)", OTHER, ["/x"]),
    ],
)
def test_managers_of_the_workspace(body: str, before: str, expected: list[str]) -> None:
    assert made(body, before) == expected


@pytest.mark.parametrize(
    ("body", "before"),
    [
        ("n = Node('n')\nm = M(n)\nm.go()", MANAGER),
        ("n = Node('n')\nwith M(n) as m:\n    m.go()", PLAIN),
        ("n = Node('n')\nwith open('f') as f:\n    n.create_publisher(String, '/' + 'go', 1)", MANAGER),
        ("n = Node('n')\nwith n.lock:\n    n.create_publisher(String, '/go', 1)", MANAGER),
        ("n = Node('n')\nwith outside.It(n) as m:\n    n.create_publisher(String, '/go', 1)", "import outside\n"),
        ("import tempfile\nn = Node('n')\nwith tempfile.TemporaryDirectory() as d:\n    n.create_publisher(String, '/go', 1)", MANAGER),
    ],
)  # fmt: skip
def test_no_manager_or_one_that_makes_nothing(body: str, before: str) -> None:
    assert made(body, before) == ["/go"]


HOLDER = (
    "class D { public: D(rclcpp::Node::SharedPtr n) : n_(n) {} %s rclcpp::Node::SharedPtr n_; int k_ = 1; };\n"
    "class E : public D { public: using D::D; };\n"
)
MAKING = '~D() { n_->create_publisher<String>("/x", 1); }'
BEGIN = 'auto n = std::make_shared<rclcpp::Node>("n"); '


@pytest.mark.parametrize(
    "body", ["{ D d(n); }", "auto d = std::make_shared<D>(n); rclcpp::spin(n);", "D d(n); rclcpp::spin(n);"]
)
def test_destructors(body: str) -> None:
    (node,) = ros2_main(BEGIN + body, HOLDER % MAKING).nodes
    assert [end.name for end in explicit(node)] == ["/x"]


@pytest.mark.parametrize(
    ("body", "members"),
    [
        ("rclcpp::spin(n);", MAKING),
        ("D d(n);", "~D() { k_ = 0; }"),
        ("D d(n);", "~D() = default;"),
        ("D d(n);", "virtual ~D();"),
        ("D d(n);", 'void end() { n_->create_publisher<String>("/x", 1); }'),
    ],
)
def test_destructors_that_make_nothing_or_do_not_run(body: str, members: str) -> None:
    (node,) = ros2_main(BEGIN + body, HOLDER % members).nodes
    assert explicit(node) == []


def test_what_a_destructor_sets_is_not_set_before() -> None:
    text = HOLDER % (
        '~D() { n_->create_publisher<String>("/x", 1); k_ = 0; }'
        'void go() { if (k_) { n_->create_publisher<String>("/y", 1); } else { n_->create_publisher<String>("/z", 1); } }'
    )
    (node,) = ros2_main(BEGIN + "D d(n); d.go();", text).nodes
    assert {end.name: end.is_ruled_out for end in explicit(node)} == {"/x": False, "/y": False, "/z": True}


TRIED = "try:\n    from a_msgs.msg import Foo\nexcept ImportError:\n    Foo = None\n"
MODULE = "try:\n    import a_msgs.msg\nexcept ImportError:\n    a_msgs = None\n"


@pytest.mark.parametrize(
    ("body", "before"),
    [
        ("n.create_publisher(Foo, '/x', 1)", TRIED),
        ("if Foo is not None:\n    n.create_publisher(Foo, '/x', 1)", TRIED),
        ("if Foo:\n    n.create_publisher(Foo, '/x', 1)", TRIED),
        ("if Foo is None:\n    return\nn.create_publisher(Foo, '/x', 1)", TRIED),
        ("n.create_publisher(a_msgs.msg.Foo, '/x', 1)", MODULE),
        ("n.create_publisher(Foo, '/x', 1)", TRIED.replace("None", "None\n    print('none')")),
        ("n.create_publisher(Foo, '/x', 1)", TRIED.replace("Foo = None", "pass")),
        (
            "try:\n    from a_msgs.msg import Foo\nexcept ImportError:\n    Foo = None\nn.create_publisher(Foo, '/x', 1)",
            "",
        ),
    ],
)
def test_a_type_that_may_be_none(body: str, before: str) -> None:
    (node,) = program("n = Node('n')\n" + body, before).nodes
    (end,) = explicit(node)
    assert (end.name, end.type, end.is_ruled_out) == ("/x", "a_msgs/msg/Foo", False)


@pytest.mark.parametrize(
    ("before", "kind"),
    [
        (TRIED.replace("Foo = None", "from b_msgs.msg import Foo"), None),
        (TRIED.replace("Foo = None", "Foo = String"), None),
        ("Foo = None\n", None),
        ("Foo = String\n", "std_msgs/msg/String"),
    ],
)
def test_types_that_are_one_of_two_or_none(before: str, kind: str | None) -> None:
    (node,) = program("n = Node('n')\nn.create_publisher(Foo, '/x', 1)", before).nodes
    (end,) = explicit(node)
    assert end.type == kind


DEL = "class M:\n    def __init__(self, n):\n        self.n = n\n    def %s(self):\n        self.n.create_publisher(String, '/x', 1)\n"


@pytest.mark.parametrize(
    ("method", "body", "expected"),
    [
        ("__del__", "m = M(n)\ndel m", ["/x"]),
        ("__del__", "m = M(n)\nrclpy.spin(n)", ["/x"]),
        ("__del__", "pass", []),
        ("delete", "m = M(n)", []),
    ],
)
def test_what_python_calls_in_the_end(method: str, body: str, expected: list[str]) -> None:
    assert made("n = Node('n')\n" + body, DEL % method) == expected


YIELDS = "import contextlib\nfrom contextlib import contextmanager\n@%s\ndef m(t):\n    n = Node(t)\n    n.create_publisher(String, '/in', 1)\n    %s\n    n.create_publisher(String, '/out', 1)\n"


@pytest.mark.parametrize(
    ("decorator", "yields", "expected"),
    [
        ("contextmanager", "yield n", ["/in", "/out", "/q/x"]),
        ("contextlib.contextmanager", "yield n", ["/in", "/out", "/q/x"]),
        ("contextmanager", "try:\n        yield n\n    finally:\n        pass", ["/in", "/out", "/q/x"]),
        ("contextmanager", "x = yield n", ["/?/x", "/in", "/out"]),
        ("outside.manager", "yield n", ["/?/x", "/in", "/out"]),
    ],
)
def test_what_a_generator_yields_to_a_with(decorator: str, yields: str, expected: list[str]) -> None:
    body = "with m('q') as a:\n    a.create_publisher(String, '~/x', 1)"
    assert made(body, "import outside\n" + YIELDS % (decorator, yields)) == expected
