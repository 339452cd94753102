# SPDX-License-Identifier: Apache-2.0
"""C++: what weak pointers lock, and objects that hand out pointers to themselves."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

GO = 'void go() { ADV(std::string("t"), 1); }'
W = "struct W { ros::NodeHandle nh; %s };\nauto w = std::make_shared<W>();\n" % GO
SELF = "struct W : public %s::enable_shared_from_this<W> { ros::NodeHandle nh; %s void init() { %s } void other(std::shared_ptr<W> w) { w->go(); } };\n"
LOCKS = [
    "std::weak_ptr<W> k = w; if (auto p = k.lock()) p->go();",
    "std::weak_ptr<W> k(w); auto p = k.lock(); p->go();",
    "auto k = std::weak_ptr<W>(w); k.lock()->go();",
    "std::weak_ptr<W> k; k = w; k.lock()->go();",
    "std::vector<std::weak_ptr<W>> v; v.push_back(w); for (auto & k : v) k.lock()->go();",
    "std::map<int, std::weak_ptr<W>> v; v[1] = w; for (auto & k : v) k.second.lock()->go();",
    "std::weak_ptr<W> k(w); auto f = [k] { if (auto p = k.lock()) p->go(); }; f();",
    "boost::weak_ptr<W> k(w); if (!k.expired()) k.lock()->go();",
]
SELVES = [
    "auto s = shared_from_this(); s->go();",
    "shared_from_this()->go();",
    "this->shared_from_this()->go();",
    "std::shared_ptr<W> s = shared_from_this(); s->go();",
    "auto s = weak_from_this().lock(); s->go();",
    "auto f = [s = shared_from_this()] { s->go(); }; f();",
    "other(shared_from_this());",
]
QUIET = [
    "std::weak_ptr<W> k = w; auto p = k.lock();",
    "std::weak_ptr<W> k = w; k.reset(); if (k.expired()) return 0;",
    "std::weak_ptr<O> k = std::make_shared<O>(); k.lock()->go();",
    "std::mutex m; m.lock(); m.unlock();",
    "auto m = std::make_shared<std::mutex>(); m->lock();",
    "auto o = std::make_shared<O>(); o->lock();",
    "std::shared_ptr<O> o = std::make_shared<O>(); o->lock(); o->shared_from_this();",
    "O o; o.lock(); o.get();",
    "w->lock();",
]


@pytest.mark.parametrize("body", LOCKS)
def test_what_is_locked(body: str) -> None:
    assert names(cpp(W.split("\n")[1] + body, W.split("\n")[0])) == ["/t"]


@pytest.mark.parametrize("space", ["std", "boost"])
@pytest.mark.parametrize("body", SELVES)
def test_pointers_to_themselves(space: str, body: str) -> None:
    assert names(cpp("auto w = std::make_shared<W>(); w->init();", SELF % (space, GO, body))) == ["/t"]


@pytest.mark.parametrize("body", QUIET)
def test_what_makes_nothing(body: str) -> None:
    other = "struct O { int lock() { return 1; } void go() {} int get() { return 2; } int shared_from_this() { return 3; } };\n"
    assert names(cpp(W.split("\n")[1] + body, W.split("\n")[0] + other)) == []


def test_a_method_of_its_own_is_called() -> None:
    other = 'struct O { ros::NodeHandle nh; void lock() { ADV(std::string("own"), 1); } };\n'
    assert names(cpp("auto o = std::make_shared<O>(); o->lock();", other)) == ["/own"]
