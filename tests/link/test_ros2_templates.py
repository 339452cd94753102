# SPDX-License-Identifier: Apache-2.0
"""What templates make depends on what they are used for: each use is followed, however many there are."""

from __future__ import annotations

from follow_kit import explicit, ros2_cpp


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
