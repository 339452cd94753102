# SPDX-License-Identifier: Apache-2.0
"""A function that is registered on several ways: what it makes stands under what all of them have in common."""

from __future__ import annotations

import pytest
from ros2_cpp_kit import SUB, component, explicit, only

SEEN = 'void seen(String::ConstSharedPtr m) { late_ = create_publisher<String>("late", 1); }'
MEMBERS = f"{SEEN}\nrclcpp::Publisher<String>::SharedPtr late_;\nrclcpp::SubscriptionBase::SharedPtr a_, b_, c_;"
PARAMETERS = 'bool one = declare_parameter("one", false);\nbool two = declare_parameter("two", false);\n'
BIND = "std::bind(&N::seen, this, std::placeholders::_1)"
A, B, C = (f'{name}_ = {SUB}("{name}", 1, {BIND});' for name in "abc")
SEVERAL = [("conditions", "it is made on several ways, each under conditions of its own")]


@pytest.mark.parametrize(
    ("body", "conditions", "unknowns"),
    (
        (f"if (one) {{ {A} }}", [("if", "one")], []),
        (f"if (one) {{ {A} {B} }}", [("if", "one")], []),
        (f"if (one) {{ {A} }} else {{ {B} }}", [], []),
        (f"if (one) {{ {A} }} {B}", [], []),
        (f"{A} if (one) {{ {B} }}", [], []),
        (f"if (one) {{ {A} }} if (two) {{ {B} }}", [], SEVERAL),
        (f"if (one) {{ {A} if (two) {{ {B} }} }}", [("if", "one")], []),
        (f"if (one) {{ if (two) {{ {A} }} else {{ {B} }} }}", [("if", "one")], []),
        (f"if (one) {{ if (two) {{ {A} }} else {{ {B} }} }} else {{ {C} }}", [], []),
        (f"if (one) {{ if (two) {{ {A} }} }} else {{ {B} }}", [("else", "one")], []),  # as it is false
        (f"one = std::rand() > 1; if (one) {{ if (two) {{ {A} }} }} else {{ {B} }}", [("else", "one")], []),
        (f"one = two = std::rand() > 1; if (one) {{ if (two) {{ {A} }} }} else {{ {B} }}", [], SEVERAL),
    ),
)
def test_several_registrations(body: str, conditions: list[tuple[str, str]], unknowns: list[tuple[str, str]]) -> None:
    end = only(component(PARAMETERS + body, MEMBERS))
    assert [(each.statement, each.condition) for each in end.conditions] == conditions
    assert [(each.field, each.reason) for each in end.unknowns] == unknowns


def test_registered_again_by_a_callback() -> None:
    more = f"void tick() {{ {B} }}\nrclcpp::TimerBase::SharedPtr timer_;\n"
    body = PARAMETERS + f"if (one) {{ {A} }} timer_ = create_wall_timer(1s, [this] {{ tick(); }});"
    assert only(component(body, MEMBERS + more)).conditions == ()


def test_other_objects_are_others() -> None:
    listener = (
        "struct Listener { rclcpp::Node * node_; std::string name_; rclcpp::PublisherBase::SharedPtr late_;\n"
        "rclcpp::SubscriptionBase::SharedPtr sub_;\n"
        "Listener(rclcpp::Node * node, const std::string & name) : node_(node), name_(name) {\n"
        f"sub_ = node_->{SUB}(name, 1, std::bind(&Listener::seen, this, std::placeholders::_1)); }}\n"
        'void seen(String::ConstSharedPtr m) { late_ = node_->create_publisher<String>(name_ + "/late", 1); } };\n'
    )
    members = "std::shared_ptr<Listener> a_, b_;"
    a, b = (f'{name}_ = std::make_shared<Listener>(this, "{name}");' for name in "ab")
    body = f"{PARAMETERS}if (one) {{ {a} }} else {{ {b} }}"
    found = explicit(component(body, members, listener))
    assert [(end.name, [each.statement for each in end.conditions]) for end in found] == [
        ("/a/late", ["if"]),
        ("/b/late", ["else"]),
    ]


ONE_OF = [("conditions", "one of several functions is called back")]
CALLED = f"auto called = std::rand() > 1 ? &N::seen : &N::other; {A.replace('&N::seen', 'called')}"
OTHER = (
    'void other(String::ConstSharedPtr m) { else_ = create_publisher<String>("else", 1); }\n'
    "rclcpp::Publisher<String>::SharedPtr else_;"
)


@pytest.mark.parametrize(
    ("body", "found"),
    (
        (A, {"/late": []}),
        (CALLED, {"/late": ONE_OF, "/else": ONE_OF}),
        (f"{CALLED} {B}", {"/late": [], "/else": ONE_OF}),
        (f"{B} {CALLED}", {"/late": [], "/else": ONE_OF}),
    ),
)
def test_one_of_several(body: str, found: dict[str, list[tuple[str, str]]]) -> None:
    made = explicit(component(body, MEMBERS + OTHER))
    assert {end.name: [(each.field, each.reason) for each in end.unknowns] for end in made} == found
