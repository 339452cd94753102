# SPDX-License-Identifier: Apache-2.0
"""C++: a member of a base class by its qualified name, ``Base::member``."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

BASE = 'struct Base { std::string topic = "old"; static std::string shared; ros::NodeHandle nh; void tell() { ADV(topic, 1); } };\n'
DERIVED = "struct Derived : Base { void start() { %s } };"
NEW = [
    pytest.param(DERIVED % 'Base::topic = "new"; ADV(topic, 1);', id="written"),
    pytest.param(DERIVED % 'this->Base::topic = "new"; ADV(topic, 1);', id="written by this"),
    pytest.param(DERIVED % 'topic = "new"; ADV(Base::topic, 1);', id="read"),
    pytest.param(DERIVED % 'topic = "new"; ADV(this->Base::topic, 1);', id="read by this"),
    pytest.param(DERIVED % 'Base::topic = "new"; tell();', id="read in the base"),
    pytest.param(DERIVED % 'Base::topic = "new"; Base::tell();', id="read in the base by its name"),
    pytest.param(DERIVED % 'Derived::topic = "new"; ADV(topic, 1);', id="its own name"),
    pytest.param(
        'struct Mid : Base {};\nstruct Derived : Mid { void start() { Base::topic = "new"; tell(); } };',
        id="two levels",
    ),
    pytest.param(
        'struct Mid : Base {};\nstruct Derived : Mid { void start() { Mid::topic = "new"; tell(); } };', id="inherited"
    ),
    pytest.param(
        'struct Derived : Base { typedef Base Super; void start() { Super::topic = "new"; tell(); } };',
        id="another name",
    ),
    pytest.param(
        "template <class T> struct Of : Base { T held; };\n"
        'struct Derived : Of<int> { void start() { Of<int>::topic = "new"; tell(); } };',
        id="template",
    ),
    pytest.param(
        "template <class T> struct Of : Base { T held; };\n"
        'template <class T> struct Mid : Of<T> { void start() { this->Of<T>::topic = "new"; Of<T>::tell(); } };\n'
        "struct Derived : Mid<int> {};",
        id="template parameter",
    ),
    pytest.param(DERIVED % '[this]() { Base::topic = "new"; }(); tell();', id="lambda"),
    pytest.param(DERIVED % '{ std::string topic; Base::topic = "new"; } tell();', id="beside a variable"),
]


def found(text: str) -> list[str]:
    return names(cpp("Derived d; d.start();", BASE + text))


@pytest.mark.parametrize("text", NEW)
def test_a_qualified_member_is_the_member(text: str) -> None:
    assert found(text) == ["/new"]


OTHER = [
    (DERIVED % "tell();", ["/old"]),
    (DERIVED % 'std::string topic = "new"; tell();', ["/old"]),
    (DERIVED % 'Base other; other.Base::topic = "new"; tell();', ["/old"]),
    (DERIVED % 'Base other; other.topic = "new"; ADV(Base::topic, 1);', ["/old"]),
    (DERIVED % 'Other::topic = "new"; tell();', ["/old"]),
    ("namespace Other { std::string topic; }\n" + DERIVED % 'Other::topic = "new"; tell();', ["/old"]),
    ("struct Other { static std::string topic; };\n" + DERIVED % 'Other::topic = "new"; tell();', ["/old"]),
    (DERIVED % 'Base::shared = "new"; ADV(Base::shared, 1);', ["/new"]),
    (DERIVED % 'Base::shared = "new"; tell();', ["/old"]),
    (
        'struct Derived : Base { std::string topic = "mine"; void start() { Base::topic = "new"; ADV(topic, 1); } };',
        ["/mine"],
    ),
    ('struct Derived : Base { std::string topic = "mine"; void start() { ADV(Base::topic, 1); } };', ["/?"]),
    (
        'struct Derived : Base { std::string topic; void start() { Base::topic = "new"; ADV(Base::topic, 1); } };',
        ["/new"],
    ),
    ('struct Derived : Base, Lost { void start() { Lost::topic = "new"; tell(); } };', ["/old"]),
    (DERIVED % 'if (f()) Base::topic = "new"; tell();', ["/?"]),
    (
        """namespace a { struct B { std::string t = "old"; }; }
namespace b { struct B { std::string t = "new"; }; }
struct Derived : a::B, b::B { ros::NodeHandle nh; void start() { ADV(b::B::t, 1); } };""",
        ["/?"],
    ),
]


@pytest.mark.parametrize(("text", "expected"), OTHER)
def test_what_is_another_variable_stays_one(text: str, expected: list[str]) -> None:
    assert found(text) == expected
