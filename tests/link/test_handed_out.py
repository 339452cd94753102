# SPDX-License-Identifier: Apache-2.0
"""What a library has the address of may change at any time: what it began with rules nothing out."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends

CLASS = """struct D : Lib {
  D(ros::NodeHandle nh) : nh_(nh) {}
  void use() { if (flag_) p_ = nh_.advertise<std_msgs::String>("flag", 1); }
  void later(const std_msgs::String& m) { use(); }
  void give() { GIVE }
  ros::NodeHandle nh_; ros::Publisher p_; bool flag_ = false; Options o_; Registry* r_;
};
bool set(bool& b) { return b; }
bool put(bool* b) { return *b; }
"""
LATER = 'ros::Subscriber l = nh.subscribe("y", 1, &D::later, &d);'
GIVEN = {
    "a reference": 'add("x", std::ref(flag_));',
    "a reference of Boost": 'add("x", boost::ref(flag_));',
    "of this": 'add("x", std::ref(this->flag_));',
    "an address": 'add("x", &flag_);',
    "an address in brackets": 'add("x", (&flag_));',
    "an address as another": 'add("x", reinterpret_cast<char*>(&flag_));',
    "to a pointer's method": 'r_->add("x", &flag_);',
    "to a member's method": 'o_.add("x", std::ref(flag_));',
    "to a base's method": 'this->add("x", &flag_);',
    "to a function of a namespace": 'lib::add("x", &flag_);',
    "to a constructor": 'Thing t("x", &flag_);',
    "a reference to a constructor": 'Thing t("x", std::ref(flag_));',
    "to new": 'auto t = new Thing("x", &flag_);',
    "to make_shared": 'auto t = std::make_shared<Thing>("x", &flag_);',
    "in an object": 'add(Thing("x", &flag_));',
    "in a list": 'add({"x", &flag_});',
    "a reference in a list": 'add({"x", std::ref(flag_)});',
    "through a pointer": "bool* q = &flag_; add(q);",
    "through a reference wrapper": "auto r = std::ref(flag_); add(r);",
    "to a member": "o_.value = &flag_;",
    "bound": "add(std::bind(&set, std::ref(flag_)));",
    "an address that is bound": "add(std::bind(&put, &flag_));",
    "to a thread": "std::thread t(&set, std::ref(flag_));",
    "an address to a thread": "std::thread t(&put, &flag_);",
}
QUIET = {
    "as a constant": 'add("x", std::cref(flag_));',
    "printed": 'printf("%d", *(&flag_));',
    "another": 'bool other = false; add("x", &other);',
    "its size": "add(sizeof(flag_));",
    "the object": 'add("x", this);',
    "a method": 'add("x", &D::use, this);',
    "a constant expression": 'add("x", !flag_);',
}


def _is_ruled_out(body: str, give: str) -> list[bool]:
    found = ends(cpp(f"D d(nh); {body}", CLASS.replace("GIVE", give)))
    return [end.is_ruled_out for end in found if end.name == "/flag"]


@pytest.mark.parametrize("give", GIVEN.values(), ids=GIVEN)
def test_then_it_may_have_changed(give: str) -> None:
    assert _is_ruled_out("d.give(); d.use();", give) == [False]
    assert _is_ruled_out(f"d.give(); d.flag_ = false; {LATER}", give) == [False]


@pytest.mark.parametrize("give", QUIET.values(), ids=QUIET)
def test_what_is_not_given_stays_as_it_is(give: str) -> None:
    assert _is_ruled_out("d.give(); d.use();", give) == [True]
    assert _is_ruled_out(f"d.give(); {LATER}", give) == [True]


def test_what_is_written_after_that_holds_until_something_is_called_back() -> None:
    assert _is_ruled_out("d.give(); d.flag_ = false; d.use();", 'add("x", &flag_);') == [True]
    assert _is_ruled_out("d.use(); d.give();", 'add("x", &flag_);') == [True]


def test_functions_of_the_workspace_are_followed() -> None:
    before = CLASS.replace("GIVE", "set(std::ref(flag_)); put(&flag_);")
    assert [end.is_ruled_out for end in ends(cpp("D d(nh); d.give(); d.use();", before)) if end.name == "/flag"] == [
        True
    ]
    body = "void turn(bool& b) { b = true; } " + CLASS.replace("GIVE", "turn(std::ref(flag_));")
    assert [end.is_ruled_out for end in ends(cpp("D d(nh); d.give(); d.use();", body))] == [False]
