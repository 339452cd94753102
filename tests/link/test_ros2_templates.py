# SPDX-License-Identifier: Apache-2.0
"""What templates make depends on what they are used for: each use is followed, however many there are."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_cpp
from ros2_cpp_kit import component


def test_a_wrapper_template_makes_what_each_class_makes() -> None:
    names = [f"m{number}" for number in range(40)]
    classes = "".join(
        f'struct {name} {{ explicit {name}(rclcpp::Node & node) {{ pub = node.create_publisher<String>("{name}", 1); }} '
        "rclcpp::Publisher<String>::SharedPtr pub; };\n"
        for name in names
    )
    wrapper = (
        "struct Base { virtual void init(rclcpp::Node & node) = 0; };\n"
        "template <class T> struct Wrapper : Base {\n"
        "void init(rclcpp::Node & node) override { int a = 0; int b = a; int c = b; (void)c; part_ = std::make_unique<T>(node); }\n"
        "std::unique_ptr<T> part_; };\n"
    )
    uses = "".join(f"auto w_{name} = std::make_shared<Wrapper<{name}>>(); w_{name}->init(*this);\n" for name in names)
    (node,) = ros2_cpp(uses, before=classes + wrapper).nodes
    assert sorted(end.name for end in explicit(node)) == sorted(f"/{name}" for name in names)


def test_a_class_that_makes_nothing_is_of_no_interest() -> None:
    before = (
        "struct Plain { int value = 0; };\n"
        "template <class T> struct Holder { void set() { part_ = std::make_unique<T>(); } std::unique_ptr<T> part_; };\n"
    )
    (node,) = ros2_cpp('Holder<Plain> h; h.set(); create_publisher<String>("x", 1);', before=before).nodes
    assert [end.name for end in explicit(node)] == ["/x"]


#: A class, a class template and a node with the functions that rclcpp's macro gives them.
MADE = (
    "struct Foo { RCLCPP_SMART_PTR_DEFINITIONS(Foo) explicit Foo(rclcpp::Node * n) "
    '{ n->create_publisher<String>("foo", 1); } };\n'
    "namespace a { template <class T> struct Bar { RCLCPP_SMART_PTR_DEFINITIONS(Bar) explicit Bar(rclcpp::Node * n) "
    "{ n->create_publisher<T>(T::name, 1); } };\n"
    "template <class T> typename Bar<T>::SharedPtr make(rclcpp::Node * n) { return Bar<T>::make_shared(n); } }\n"
    'struct Spec { static constexpr char name[] = "spec"; };\n'
    'struct Other : public rclcpp::Node { Other() : Node("other") { create_publisher<String>("other", 1); } };\n'
)


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("auto f = Foo::make_shared(this);", ["/foo"]),
        ("auto f = Foo::make_unique(this);", ["/foo"]),
        ("auto f = a::Bar<Spec>::make_shared(this);", ["/spec"]),
        ("auto f = a::make<Spec>(this);", ["/spec"]),
        ('auto f = Other::make_shared("x");', []),  # that of rclcpp::Node
        ('auto f = Gone::make_shared("x");', []),
    ],
)
def test_functions_that_make_an_object_of_their_class(statement: str, expected: list[str]) -> None:
    assert [end.name for end in explicit(component(statement, "", MADE))] == expected
