# SPDX-License-Identifier: Apache-2.0
"""Functions kept in members, lists and maps: called from code that names no API call itself."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names, python

MAKE = 'void work() { ros::NodeHandle nh; nh.advertise<std_msgs::String>("x", 1); }\n'
OUTSIDE = "#include <vector>\n#include <map>\n#include <string>\n#include <boost/function.hpp>\n#include <functional>\n"

#: A class that keeps a function, what ``main`` does with it, and the publishers that the node has.
CPP = (
    ("struct R { std::function<void()> f; void fire() { f(); } };", "R r; r.f = work; r.fire();", ["/x"]),
    ("struct R { boost::function<void()> f_; R(boost::function<void()> f) : f_(f) {} void fire() { f_(); } };",
     "R r(work); r.fire();", ["/x"]),
    ("struct R { boost::function<void()> f_; R(boost::function<void()> f) : f_(f) {} void fire() { this->f_(); } };",
     "R r(&work); r.fire();", ["/x"]),
    ("typedef boost::function<void()> F; struct R { F f_; void fire() { if (f_) f_(); } };",
     "R r; r.f_ = &work; r.fire();", ["/x"]),
    ("using F = std::function<void()>; struct R { F f_; void set(F f) { f_ = f; } void fire() { f_(); } void go() { fire(); } };",
     "R r; r.set([]() { work(); }); r.go();", ["/x"]),
    ("struct R { std::function<void()> f_; void on() { f_ = &work; } void fire() { f_(); } };",
     "R r; r.on(); r.fire();", ["/x"]),
    ("struct R { void (*f_)(); void fire() { f_(); } };", "R r; r.f_ = work; r.fire();", ["/x"]),
    ("typedef boost::function<void()> F; struct R { std::vector<F> fs; void add(F f) { fs.push_back(f); }"
     " void fire() { for (size_t i = 0; i < fs.size(); ++i) fs[i](); } };", "R r; r.add(&work); r.fire();", ["/x"]),
    ("struct R { std::vector<std::function<void()>> fs; void fire() { for (auto& f : fs) f(); } };",
     "R r; r.fs.push_back(work); r.fire();", ["/x"]),
    ("struct R { std::map<std::string, std::function<void()>> fs; void fire() { fs[\"a\"](); } };",
     'R r; r.fs["a"] = work; r.fire();', ["/x"]),
    ("void fire() { std::vector<std::function<void()>> fs; fs.push_back(work); fs[0](); }", "fire();", ["/x"]),
    # and what is not called, or not it
    ("struct R { std::function<void()> f; void fire() {} };", "R r; r.f = work; r.fire();", []),
    ("struct R { std::function<void()> f; void fire() { f(); } };", "R r; r.f = work;", []),
    ("struct R { std::function<void()> f; void fire() { f(); } };", "R r; r.f = idle; r.fire();", []),
    ("struct R { std::function<void()> f; void fire() { f(); } };", "R r, s; s.f = work; r.f = idle; r.fire();", []),
    ("struct R { std::vector<std::function<void()>> fs; void fire() { for (auto& f : fs) f(); } };",
     "R r; r.fire();", []),
)  # fmt: skip


@pytest.mark.parametrize(("before", "code", "expected"), CPP)
def test_cpp(before: str, code: str, expected: list[str]) -> None:
    before = OUTSIDE + MAKE + "void idle() { int i = 1; }\n" + before
    assert names(cpp('ADV("base", 1); ' + code, before)) == ["/base", *expected]


WORK = 'def work():\n    PUB("x")\ndef idle():\n    pass\n'

PYTHON = (
    ("class R:\n def __init__(self, f):\n  self.f = f\n def fire(self):\n  self.f()\n", "R(work).fire()", ["/x"]),
    ("class R:\n def __init__(self, f):\n  self.f = f\n def fire(self):\n  if self.f:\n   self.f()\n def go(self):\n  self.fire()\n",
     "r = R(lambda: work())\nr.go()", ["/x"]),
    ("class R:\n def __init__(self):\n  self.fs = []\n def add(self, f):\n  self.fs.append(f)\n def fire(self):\n  for f in self.fs:\n   f()\n",
     "r = R()\nr.add(work)\nr.fire()", ["/x"]),
    ("class R:\n def __init__(self):\n  self.fs = {}\n def add(self, n, f):\n  self.fs[n] = f\n def fire(self, n):\n  self.fs[n]()\n",
     'r = R()\nr.add("a", work)\nr.fire("a")', ["/x"]),
    ("class R(object):\n def on(self):\n  self.done = self.finish\n def finish(self):\n  work()\n def fire(self):\n  self.done()\n",
     "r = R()\nr.on()\nr.fire()", ["/x"]),
    ("class R:\n def __init__(self):\n  self.fs = {'a': work}\n def fire(self):\n  for n, f in self.fs.items():\n   f()\n",
     "R().fire()", ["/x"]),
    ("class R:\n def __init__(self):\n  self.fs = {'a': work}\n def fire(self):\n  f = self.fs.get('a')\n  f()\n",
     "R().fire()", ["/x"]),
    ("class R:\n def __init__(self, f):\n  self.f = f\n def fire(self):\n  pass\n", "R(work).fire()", []),
    ("class R:\n def __init__(self, f):\n  self.f = f\n def fire(self):\n  self.f()\n", "R(work)", []),
    ("class R:\n def __init__(self, f):\n  self.f = f\n def fire(self):\n  self.f()\n", "R(idle).fire()", []),
    ("class R:\n def __init__(self, f):\n  self.f = f\n def fire(self):\n  self.f()\n", "R(idle).fire()\nR(work)", []),
)  # fmt: skip


@pytest.mark.parametrize(("before", "code", "expected"), PYTHON)
def test_python(before: str, code: str, expected: list[str]) -> None:
    assert names(python(WORK + before + 'PUB("base")\n' + code)) == ["/base", *expected]
