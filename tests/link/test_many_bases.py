# SPDX-License-Identifier: Apache-2.0
"""Classes with many classes above them: what is left out is said, of every node that has it, and nothing else is left out."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, follow, main, names, only, python_files, script

from haros_ci.follow import bases, construct, linear
from haros_ci.model.architecture import Node

TWICE = '<launch><node pkg="p" type="{0}" name="a" ns="a"/><node pkg="p" type="{0}" name="b" ns="b"/></launch>'
PYTHON = (
    "class C0(object):\n    NAME = 'x'\n    def go(self):\n        rospy.Publisher(self.NAME, String, queue_size=1)\n"
)
CPP = 'struct C0 { void go() { ros::NodeHandle nh; nh.advertise<std_msgs::String>("x", 1); } };\n'


def python(count: int) -> list[Node]:
    """Two nodes of one program that calls a method of the topmost of *count* classes, one above another."""
    classes = "".join(f"class C{n}(C{n - 1}):\n    pass\n" for n in range(1, count))
    return list(
        only(follow(python_files(script(PYTHON + classes + f"C{count - 1}().go()"), TWICE.format("n.py")))).nodes
    )


def cpp(count: int, use: str) -> list[Node]:
    """The same in C++; *use* has ``{0}`` for the class at the bottom."""
    classes = "".join(f"struct C{n} : public C{n - 1} {{}};\n" for n in range(1, count))
    return list(only(follow(cpp_files(main(use.format(f"C{count - 1}"), CPP + classes), TWICE.format("n")))).nodes)


def gaps(found: Node) -> list[str]:
    return [unknown.reason for unknown in found.unknowns if unknown.field == "endpoints"]


MADE = "{0} object; object.go();"


def test_so_many_are_looked_at() -> None:
    for node in python(linear.MOST + 1):
        assert (names(node), gaps(node)) == ([f"{node.name[:2]}/x"], [])
    for node in cpp(construct.MOST_PARTS, MADE):
        assert (names(node), gaps(node)) == ([f"{node.name[:2]}/x"], [])


@pytest.mark.parametrize("more", [2, 40])
def test_what_is_left_out_is_said_once_of_every_node(more: int) -> None:
    for node in python(linear.MOST + more):
        assert gaps(node) == [bases.CUT.format(linear.MOST)]
    for node in cpp(construct.MOST_PARTS + more, MADE):
        assert gaps(node) == [construct.TOO_MANY.format(f"C{construct.MOST_PARTS + more - 1}", construct.MOST_PARTS)]
    for node in cpp(bases.MOST + more, MADE):
        assert bases.CUT.format(bases.MOST) in gaps(node)


#: Bases, and in which order the constructors of the parts run: a base that is not virtual is a part of each class that has it.
PARTS = (
    ('struct L : A { L() : A("l") {} }; struct R : A { R() : A("r") {} }; struct D : L, R {};', ["/l", "/r"]),
    ('struct L : A { L() : A("l") {} }; struct R : L {}; struct D : R {};', ["/l"]),
    (
        'template <class T> struct B { B() { ros::NodeHandle nh; nh.advertise<T>("x", 1); } }; struct D : B<X>, B<Y> {};',
        ["/x"],
    ),
)


@pytest.mark.parametrize(("classes", "expected"), PARTS)
def test_all_parts_of_an_object_are_constructed(classes: str, expected: list[str]) -> None:
    first = "struct A { A(const char * n) { ros::NodeHandle nh; nh.advertise<std_msgs::String>(n, 1); } };\n"
    (found,) = only(follow(cpp_files(main("D d;", first + classes)))).nodes
    assert sorted(set(names(found))) == expected


#: A constructor that delegates does so to another one, also where the type of what it hands on is not known.
DELEGATING = (
    (
        'N(int n) { nh_.advertise<std_msgs::String>("a", 1); } template <class T> explicit N(T t) : N(t->base()) {}',
        ["/a"],
    ),
    (
        'template <class T> explicit N(T t) : N(t->base()) {} N(int n) { nh_.advertise<std_msgs::String>("a", 1); }',
        ["/a"],
    ),
    ("template <class T> explicit N(T t) : N(t->base()) {}", []),
    ('N(int n) : N(text()) {} N(std::string t) { nh_.advertise<std_msgs::String>("b", 1); }', ["/b"]),
)


@pytest.mark.parametrize(("members", "expected"), DELEGATING)
def test_a_constructor_that_delegates(members: str, expected: list[str]) -> None:
    before = f"std::string text();\nstruct N {{ ros::NodeHandle nh_; {members} }};\n"
    use = "N n(1);" if "N(int n) :" in members else "N n(outside());"
    (found,) = only(follow(cpp_files(main(use, before)))).nodes
    assert (names(found), gaps(found)) == (expected, [])
