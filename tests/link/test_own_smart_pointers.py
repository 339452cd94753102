# SPDX-License-Identifier: Apache-2.0
"""Smart pointers that the workspace writes itself: ``operator->`` and ``operator*`` lead to what they point to."""

from __future__ import annotations

import pytest
from follow_kit import CPP_HEAD, cpp_files, follow

CLASSES = (
    "struct Talker {\n  Talker(ros::NodeHandle& n) : nh(n) {}\n"
    '  void start() { pub = nh.advertise<std_msgs::String>("talk", 1); }\n'
    '  std::string name = "own"; ros::NodeHandle nh; ros::Publisher pub; };\n'
    "template <class T> struct Ptr {\n  Ptr(T* t) : t_(t) {}\n  T* operator->() const { return t_; }\n"
    "  T& operator*() const { return *t_; }\n  T* get() { return t_; }\n"
    '  void reset() { ros::NodeHandle n; pub_ = n.advertise<std_msgs::String>("reset", 1); }\n  T* t_; ros::Publisher pub_; };\n'
)
MADE = "Ptr<Talker> p(new Talker(nh)); "


def names(body: str, classes: str = CLASSES) -> list[str]:
    main = f'int main(int argc, char** argv) {{ ros::init(argc, argv, "n"); ros::NodeHandle nh; ros::Publisher q; {body} }}'
    ((found,),) = (each.nodes for each in follow(cpp_files(f"{CPP_HEAD}{classes}{main}")).configurations)
    return sorted(end.name for end in found.endpoints if end.kind == "publishers" and not end.implicit)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (MADE + "p->start();", ["/talk"]),
        (MADE + "(*p).start();", ["/talk"]),
        ("auto p = Ptr<Talker>(new Talker(nh)); p->start();", ["/talk"]),
        (MADE + "q = nh.advertise<std_msgs::String>(p->name, 1);", ["/own"]),
        (MADE + 'p->name = "new"; q = nh.advertise<std_msgs::String>(p->name, 1);', ["/new"]),
        ("auto p = std::make_shared<Ptr<Talker>>(new Talker(nh)); (*p)->start();", ["/talk"]),
        ("std::vector<Ptr<Talker>> v; v.push_back(Ptr<Talker>(new Talker(nh))); for (auto& p : v) p->start();", ["/talk"]),
        # What the class has itself is that.
        (MADE + "p.reset();", ["/reset"]),
        (MADE + "p.get()->start();", ["/talk"]),
        ("Ptr<Talker>* p = new Ptr<Talker>(new Talker(nh)); p->get()->start();", ["/talk"]),
        ("Ptr<Talker>* p = new Ptr<Talker>(new Talker(nh)); p->reset();", ["/reset"]),
    ],
)  # fmt: skip
def test_what_it_leads_to(body: str, expected: list[str]) -> None:
    assert names(body) == expected


@pytest.mark.parametrize(
    "classes",
    [
        CLASSES.replace("return t_; }\n  T& op", "return other(); }\n  T& op"),  # what it leads to is not known
        CLASSES.replace("T* operator->() const", "T* at() const").replace("T& operator*() const", "T& on() const"),
        CLASSES.replace("T* operator->() const", "T* operator->*(int) const").replace("T& operator*() const", "T& operator*(int) const"),
        "struct Talker { Talker(ros::NodeHandle&) {} };\n" + CLASSES[CLASSES.index("template") :],
    ],
)  # fmt: skip
def test_what_is_not_known_makes_nothing(classes: str) -> None:
    assert names(MADE + "p->start();", classes) == []


def test_operators_that_compute() -> None:
    vector = (
        "struct V { int x; V operator*(int k) const { return V{x * k}; } V operator-() const { return V{-x}; } };\n"
    )
    body = 'V v{2}; V w = v * 3; q = nh.advertise<std_msgs::String>("m", 1); w.missing(); if (w.other) return 1;'
    assert names(body, vector) == ["/m"]


def test_one_that_leads_to_itself() -> None:
    classes = CLASSES.replace("T* operator->() const { return t_; }", "Ptr* operator->() { return this; }").replace(
        "  T& operator*() const { return *t_; }\n", ""
    )
    assert names(MADE + "p->start();", classes) == []
