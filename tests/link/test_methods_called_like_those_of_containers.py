# SPDX-License-Identifier: Apache-2.0
"""Methods of a program's own classes that are called ``reset``, ``get``, ``clear``, as those of pointers and containers are."""

from __future__ import annotations

import pytest
from follow_kit import cpp, python

NAMES = ("reset", "get", "set", "clear", "find", "begin", "swap", "has", "lock", "start")
OTHERS = ("reset", "set", "clear", "swap", "has", "push", "start")
OWN = """struct H {
  ros::NodeHandle nh; ros::Publisher p;
  void NAME() { p = ADV("in", 1); }
};
struct A {
  ros::NodeHandle nh; std::shared_ptr<H> h; std::unique_ptr<H> u; ros::Publisher p;
  A() : h(new H) { go(); }
  void go() { help(); }
  void help() { CALL }
};
"""


def made(body: str, before: str = "") -> list[str]:
    """The publishers of a C++ program, ``!`` for those that are ruled out."""
    return sorted(end.name + "!" * end.is_ruled_out for end in cpp(body, before).endpoints if end.kind == "publishers")


def made_by_python(text: str) -> list[str]:
    """The publishers of a Python program."""
    return sorted(end.name for end in python(text).endpoints if end.kind == "publishers")


@pytest.mark.parametrize("name", NAMES)
def test_a_method_of_the_object_itself(name: str) -> None:
    text = (
        f"class B:\n    def {name}(self):\n        PUB('base')\n"
        f"class A(B):\n    def {name}(self):\n        PUB('own')\n        super().{name}()\n    def go(self):\n        self.{name}()\n"
        "a = A()\nrospy.Timer(1, lambda e: a.go())\n"
    )
    assert made_by_python(text) == ["/base", "/own"]


@pytest.mark.parametrize("name", OTHERS)
def test_a_method_of_another_object(name: str) -> None:
    text = (
        f"class H:\n    def {name}(self):\n        PUB('other')\n"
        f"class A:\n    def __init__(self):\n        self.h = H()\n    def go(self):\n        self.h.{name}()\n"
        "a = A()\nrospy.Timer(1, lambda e: a.go())\n"
    )
    assert made_by_python(text) == ["/other"]


def test_a_method_behind_a_pointer() -> None:
    """In C++ such a name alone is no reason to follow a function: mostly it is a container's. What else the function makes is one."""
    other = 'p = ADV("a", 1);'
    assert made("A a;", OWN.replace("NAME", "start").replace("CALL", "h->start();")) == ["/in"]
    assert made("A a;", OWN.replace("NAME", "reset").replace("CALL", "h->reset();" + other)) == ["/a", "/in"]
    assert made("A a;", OWN.replace("NAME", "clear").replace("CALL", "h->clear();" + other)) == ["/a", "/in"]


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ('h->reset(); if (h) p = ADV("a", 1);', ["/a", "/in"]),
        ('(*h).reset(); if (h) p = ADV("a", 1);', ["/a", "/in"]),
        ('std::vector<std::shared_ptr<H>> v{h}; v[0]->reset(); if (v[0]) p = ADV("a", 1);', ["/a", "/in"]),
        # what is the pointer's own
        ('h.reset(); if (h) p = ADV("a", 1); else p = ADV("b", 1);', ["/a!", "/b"]),
        ('u.reset(); if (u) p = ADV("a", 1);', ["/a!"]),
        ('u.reset(new H); if (u) p = ADV("a", 1);', ["/a"]),
        ('h.get()->reset(); if (h) p = ADV("a", 1);', ["/a", "/in"]),
    ],
)
def test_whose_method_it_is(call: str, expected: list[str]) -> None:
    assert made("A a;", OWN.replace("NAME", "reset").replace("CALL", call)) == expected


@pytest.mark.parametrize(
    "call",
    [
        "self.items.clear()",
        "self.table.get('x')",
        "self.event.set()",
        "self.text.find('x')",
        "self.lock.acquire()",
    ],
)
def test_methods_of_containers_make_nothing(call: str) -> None:
    text = (
        "import threading\nclass A:\n    def __init__(self):\n        self.items = [1]\n        self.table = {}\n        self.text = 'x'\n"
        "        self.event = threading.Event()\n        self.lock = threading.Lock()\n"
        f"    def go(self):\n        {call}\n        PUB('known')\n"
        "a = A()\nrospy.Timer(1, lambda e: a.go())\n"
    )
    assert made_by_python(text) == ["/known"]
