# SPDX-License-Identifier: Apache-2.0
"""Classes measured over several files: bases, children, coupling and weight."""

from __future__ import annotations

from pathlib import Path

import pytest
from commandline import write

from haros_ci.measuring.measures import class_values, structure
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover


def measured(root: Path, files: dict[str, str]) -> dict[str, dict[str, int]]:
    workspace = discover(write(root, files), (".",))
    return {each.facts.name: class_values(each) for each in structure(workspace, MemoryCache(), 1).classes.every}


def depths(root: Path, files: dict[str, str]) -> dict[str, int]:
    return {name: values["depth-in-tree"] for name, values in measured(root, files).items()}


def couplings(root: Path, files: dict[str, str]) -> dict[str, int]:
    return {name: values["coupling"] for name, values in measured(root, files).items()}


A_H = "namespace n { class A { public: virtual ~A(); void f(); }; }\n"


def test_depth_and_children_over_files(tmp_path: Path) -> None:
    found = measured(
        tmp_path,
        {
            "include/p/a.h": A_H,
            "include/p/b.h": '#include "p/a.h"\nnamespace n { class B : public A { void g(); }; }\n',
            "src/c.cpp": '#include "p/b.h"\nusing namespace n;\nclass C : public B {};\nclass D : public n::A, public B {};\n',
        },
    )
    assert {name: values["depth-in-tree"] for name, values in found.items()} == {"n::A": 1, "n::B": 2, "C": 3, "D": 3}
    assert {name: values["number-of-children"] for name, values in found.items()} == {
        "n::A": 2,
        "n::B": 2,
        "C": 0,
        "D": 0,
    }


@pytest.mark.parametrize(
    ("text", "depth"),
    [
        ("class X {};", 1),
        ("class X : public rclcpp::Node {};", 2),
        ("class X : public std::vector<int>, private Other {};", 2),
        ("template <class T> class X : public T {};", 2),
        ("class Y : public rclcpp::Node {}; using Z = Y; class X : public Z {};", 3),
        ("template <class T> class Y {}; class X : public Y<int> {};", 2),
        ("class X : public X {};", 2),
        ("class X; class Y : public X {}; class X : public Y {};", 1),
        ("struct Y {}; struct X { struct Y : public ::Y {}; };", 1),
    ],
)
def test_bases_that_are_not_known_are_one_level(tmp_path: Path, text: str, depth: int) -> None:
    assert depths(tmp_path, {"a.cpp": text + "\n"})["X"] == depth


def test_a_class_that_cannot_be_seen_is_no_base(tmp_path: Path) -> None:
    """Two packages that know nothing of each other may have classes of one name."""
    manifest = "<package format='3'><name>{}</name></package>"
    files = {
        "one/package.xml": manifest.format("one"),
        "one/include/one/base.h": "class Root {}; class Base : public Root {};\n",
        "two/package.xml": manifest.format("two"),
        "two/src/x.cpp": "class X : public Base {};\n",
    }
    assert depths(tmp_path, files) == {"Root": 1, "Base": 2, "X": 2}
    files["two/src/x.cpp"] = '#include "one/base.h"\nclass X : public Base {};\n'
    assert depths(tmp_path, files)["X"] == 3


def test_methods_defined_elsewhere_weigh(tmp_path: Path) -> None:
    found = measured(
        tmp_path,
        {
            "a.h": "namespace n { class A { public: A(); void f(); void f(int); int g() { return x ? 1 : 2; } }; }\n",
            "a.cpp": '#include "a.h"\nnamespace n { A::A() {} void A::f() { if (a) {} while (b) {} } }\n',
            "b.cpp": '#include "a.h"\nusing namespace n;\nvoid A::f(int) { if (a && b) {} }\n',
            "c.cpp": "void f() { if (a) {} }\nnamespace A { void f() { if (b) {} } }\n",
        },
    )
    assert found["n::A"]["weighted-methods"] == 1 + 3 + 3 + 2
    assert found["n::A"]["methods-available"] == 3


def test_specialisations_have_their_own_methods(tmp_path: Path) -> None:
    workspace = discover(
        write(
            tmp_path,
            {
                "a.h": "template <class T> struct A { void f() {} };\n"
                "template <> struct A<int> { void f() { if (a) {} } void g() {} };\n"
            },
        ),
        (".",),
    )
    found = [class_values(each) for each in structure(workspace, MemoryCache(), 1).classes.every]
    assert [each["weighted-methods"] for each in found] == [1, 3]


def test_a_class_without_methods_has_no_weight(tmp_path: Path) -> None:
    assert set(measured(tmp_path, {"a.h": "struct A { int x; };\n"})["A"]) == {
        "coupling", "depth-in-tree", "number-of-children",
    }  # fmt: skip


USED = "class B; using Bs = std::vector<std::shared_ptr<B>>;\nclass B { public: static void make(); enum E { X }; };\nnamespace m { class C {}; }\nclass D {};\n"


@pytest.mark.parametrize(
    ("members", "coupling"),
    [
        ("B b_;", 1),
        ("std::shared_ptr<B> b_; std::map<int, m::C> c_;", 2),
        ("void f(const B & b, m::C * c);", 2),
        ("D g();", 1),
        ("using L = std::map<int, std::vector<B>>; L all_;", 1),
        ("Bs all_;", 1),
        ("void f() { B b; auto c = new m::C; }", 2),
        ("void f() { B::make(); }", 1),
        ("void f() { x = B::X; y = m::C(); static_cast<D *>(z); }", 3),
        ("void f() { try {} catch (const D & d) {} }", 1),
        ("void f() { B b1; B b2; } B b3;", 1),
        # quiet
        ("void f();", 0),
        ("A * next_; void f(A & a);", 0),
        ("int b; std::string s; Unknown u; rclcpp::Node::SharedPtr n;", 0),
        ('void f() { /* B b; */ log("D d"); }', 0),
        ("friend class B;", 0),
        ("struct N { B b; };", 1),
    ],
)
def test_coupling(tmp_path: Path, members: str, coupling: int) -> None:
    files = {"b.h": USED, "a.h": f'#include "b.h"\nclass A\n{{\n{members}\n}};\n'}
    assert couplings(tmp_path, files)["A"] == (0 if "struct N" in members else coupling)


def test_coupling_of_methods_elsewhere_and_of_bases(tmp_path: Path) -> None:
    files = {
        "b.h": USED,
        "a.h": '#include "b.h"\nclass A : public D { void f(); };\n',
        "a.cpp": '#include "a.h"\nvoid A::f() { m::C c; }\nvoid g() { B b; }\n',
    }
    assert couplings(tmp_path, files) == {"A": 2, "B": 0, "m::C": 0, "D": 0}


PYTHON = {
    "package.xml": "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>",
    "setup.py": "from setuptools import setup\nsetup(name='p', packages=['p'])\n",
    "p/__init__.py": "",
    "p/base.py": "from rclpy.node import Node\n\n\nclass Base(Node):\n    def f(self):\n        if a:\n            pass\n",
    "p/other.py": "class Plain(object):\n    pass\n\n\nclass Error(Exception):\n    pass\n",
    "p/main.py": (
        "from p.base import Base\nfrom . import other\nimport p.other as again\n\n\n"
        "class Main(Base):\n"
        "    def g(self, x: other.Plain):\n        raise again.Error(x)\n"
        "    def h(self):\n        return Unknown(Base)\n\n\n"
        "class Local(Main, Mixin):\n    pass\n"
    ),
}  # fmt: skip


def test_python(tmp_path: Path) -> None:
    found = measured(tmp_path, PYTHON)
    assert {name: values["depth-in-tree"] for name, values in found.items()} == {
        "Base": 2, "Plain": 1, "Error": 2, "Main": 3, "Local": 4,
    }  # fmt: skip
    assert {name: values["number-of-children"] for name, values in found.items() if values["number-of-children"]} == {
        "Base": 1, "Main": 1,
    }  # fmt: skip
    assert {name: values["coupling"] for name, values in found.items()} == {
        "Base": 0, "Plain": 0, "Error": 0, "Main": 3, "Local": 1,
    }  # fmt: skip
    assert found["Main"]["weighted-methods"] == 2
