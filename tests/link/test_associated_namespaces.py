# SPDX-License-Identifier: Apache-2.0
"""C++: an unqualified function is also looked up in the namespaces of its arguments' types ([basic.lookup.argdep])."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

PEOPLE = (
    "namespace inner { struct Base {}; struct Holder { struct Nested {}; };\n"
    '  void tell(ros::NodeHandle & nh, const Base & of) { ADV(std::string("told"), 1); }\n'
    '  void tell(ros::NodeHandle & nh, const Holder::Nested & of) { ADV(std::string("nested"), 1); }\n'
    '  struct Hidden { void ask(ros::NodeHandle & nh) { ADV(std::string("hidden"), 1); } };\n'
    "}\n"
    "namespace outer { struct Derived : inner::Base {}; template <class T> struct Of {}; }\n"
)
FOUND = [
    pytest.param("inner::Base a; tell(nh, a);", "", "/told", id="an object"),
    pytest.param("inner::Base a; inner::Base & b = a; tell(nh, b);", "", "/told", id="a reference"),
    pytest.param("auto a = std::make_unique<inner::Base>(); tell(nh, *a);", "", "/told", id="what a pointer holds"),
    pytest.param("inner::Base * a = new inner::Base(); tell(nh, *a);", "", "/told", id="what is new"),
    pytest.param("inner::Base * a = made(); tell(nh, *a);", "inner::Base * made();", "/told", id="what is not known"),
    pytest.param("tell(nh, inner::Base());", "", "/told", id="a temporary"),
    pytest.param("outer::Derived a; tell(nh, a);", "", "/told", id="a base class"),
    pytest.param("inner::Holder::Nested a; tell(nh, a);", "", "/nested", id="a nested class"),
    pytest.param("outer::Derived a; between(nh, a);", "void between(ros::NodeHandle & nh, outer::Derived & a) { tell(nh, a); }", "/told", id="between"),
    pytest.param("inner::Base a; between(nh, a);", "template <class T> void between(ros::NodeHandle & nh, T & a) { tell(nh, a); }", "/told", id="a template"),
    pytest.param(
        "far::A a; say(nh, a);",
        "namespace far { struct A {}; namespace { void say(ros::NodeHandle & nh, A & a) { ADV(std::string(\"say\"), 1); } } }",
        "/say",
        id="without a name",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("body", "before", "expected"), FOUND)
def test_it_is_found(body: str, before: str, expected: str) -> None:
    assert names(cpp(body, PEOPLE + before)) == [expected]


OWN = 'void tell(ros::NodeHandle & nh, int of) { ADV(std::string("own"), 1); }\n'
NOT = [
    pytest.param("tell(nh, 1);", OWN, ["/own"], id="one's own"),
    pytest.param("tell(nh, 1);", "", [], id="a number"),
    pytest.param("inner::Base a; ::tell(nh, a);", "", [], id="global by its name"),
    pytest.param("inner::Base a; outer::tell(nh, a);", "", [], id="another namespace by its name"),
    pytest.param("inner::Hidden a; ask(nh, a);", "", [], id="a method"),
    pytest.param("inner::Base a; shout(nh, a);", "", [], id="no such function"),
    pytest.param("inner::Base a; auto tell = [](ros::NodeHandle & nh, inner::Base & a) {}; tell(nh, a);", "", [], id="a variable"),
    pytest.param("outer::Of<int> a; tell(nh, a);", "", [], id="a template's own namespace"),
    pytest.param("std::string a; tell(nh, a);", "", [], id="a library's type"),
]  # fmt: skip


@pytest.mark.parametrize(("body", "before", "expected"), NOT)
def test_it_is_not(body: str, before: str, expected: list[str]) -> None:
    assert names(cpp(body, PEOPLE + before)) == expected
