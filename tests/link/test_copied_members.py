# SPDX-License-Identifier: Apache-2.0
"""``m_(*p)`` copies an object of its own class, where no constructor of that class takes one; ``m_(p)`` is what a constructor says."""

from __future__ import annotations

import pytest
from follow_kit import cpp, explicit, names

CLASSES = """
struct Pm { Pm(ros::NodeHandle* nh) : nh_(*nh) { pub_ = ADV2(nh_, "one", 1); } ros::NodeHandle nh_; ros::Publisher pub_; };
struct Task { Task(Pm* pm); Pm pm_; };
Task::Task(Pm* pm) : pm_(*pm) { ADV2(pm_.nh_, "two", 1); }
struct Self { Self(Self* parent) { ros::NodeHandle n; ADV2(n, parent ? "child" : "top", 1); } };
struct Shared { Shared(std::shared_ptr<Pm> pm) { ADV2(pm->nh_, "shared", 1); } };
""".replace("ADV2(", "adv(")
BEFORE = (
    "template <class H> ros::Publisher adv(H& h, const std::string& name, int q)"
    " { return h.template advertise<std_msgs::String>(name, q); }\n" + CLASSES
)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("Task t(&pm);", ["/one", "/two"]),
        ("Pm q(pm);", ["/one"]),
        ("Pm q = pm;", ["/one"]),
        ("Pm q(*(&pm));", ["/one"]),
        ("auto sp = std::make_shared<Pm>(&nh); Pm q(*sp);", ["/one"]),
        ("Self s(nullptr); Self u(s);", ["/one", "/top"]),
        ("Self s(nullptr); Self u(&s);", ["/child", "/one", "/top"]),
        ("Self s(nullptr); Self* p = &s; Self u(p);", ["/child", "/one", "/top"]),
        ("Self s(nullptr); Self* p = &s; Self u(*p);", ["/one", "/top"]),
        ("Shared s(std::make_shared<Pm>(&nh));", ["/one", "/shared"]),
        ("Shared s(std::make_shared<Pm>(&nh)); Shared u(s);", ["/one", "/shared"]),
    ],
)
def test_copies(body: str, expected: list[str]) -> None:
    node = cpp(f"Pm pm(&nh); {body}", BEFORE)
    assert sorted(set(names(node))) == expected
    assert not any(end.unknowns for end in explicit(node))


@pytest.mark.parametrize(
    ("third", "latched"), [("true", True), ("false", False), ("this", True), ("1", True), ("*this", None)]
)
def test_a_pointer_for_a_flag(third: str, latched: bool | None) -> None:
    members = "operator bool() const { return go_; } bool go_;" if latched is None else ""
    before = f'struct N {{ N(ros::NodeHandle& nh) {{ p = nh.advertise<std_msgs::String>("t", 1, {third}); }} ros::Publisher p; {members} }};'
    (end,) = explicit(cpp("N n(nh);", before))
    assert end.latched is latched
