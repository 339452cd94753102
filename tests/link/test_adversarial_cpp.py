# SPDX-License-Identifier: Apache-2.0
"""C++ programs that ran beside the model: methods by the class that is declared, copies in loops, exceptions that are thrown for certain."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ros2_cpp
from ros2_cpp_kit import KEPT, explicit, last, policies

BASE = 'struct B { virtual ~B() {} std::string n() { return "b"; } virtual std::string v() { return "b"; } };\n'
DERIVED = BASE + 'struct D : B { std::string n() { return "d"; } std::string v() { return "d"; } };\n'


def made(body: str, before: str = "") -> list[str]:
    """The publishers of a program, ``!`` for those that are ruled out."""
    return sorted(end.name + "!" * end.is_ruled_out for end in cpp(body, before).endpoints if end.kind == "publishers")


@pytest.mark.parametrize(
    ("body", "before", "expected"),
    [
        ("std::shared_ptr<B> p = std::make_shared<D>();\nADV(p->n(), 1);", DERIVED, ["/b"]),
        ("B* p = new D();\nADV(p->n(), 1);", DERIVED, ["/b"]),
        ("std::vector<B*> v;\nv.push_back(new D());\nfor (B* p : v) ADV(p->n(), 1);", DERIVED, ["/b"]),
        # what is virtual, or is not seen to be the base's
        ("std::shared_ptr<B> p = std::make_shared<D>();\nADV(p->v(), 1);", DERIVED, ["/d"]),
        ("B* p = new D();\nADV(p->v(), 1);", DERIVED, ["/d"]),
        ("D d;\nADV(d.n(), 1);", DERIVED, ["/d"]),
        ("std::shared_ptr<D> p = std::make_shared<D>();\nADV(p->n(), 1);", DERIVED, ["/d"]),
        ("auto p = std::make_shared<D>();\nADV(p->n(), 1);", DERIVED, ["/d"]),
        ("B* p = new D();\nADV(p->n(), 1);", DERIVED.replace("struct B {", "struct B : elsewhere::A {"), ["/d"]),
        (
            "B* p = new D();\nADV(p->n(), 1);",
            "struct A { virtual std::string n() = 0; };\n" + DERIVED.replace("B {", "B : A {", 1),
            ["/d"],
        ),
        ("B* p = new D();\nADV(p->n(), 1);", BASE + "struct D : B { };\n", ["/b"]),
    ],
)
def test_the_class_that_is_declared_decides_where_a_method_is_not_virtual(
    body: str, before: str, expected: list[str]
) -> None:
    assert made(body, before) == expected


STRUCT = "struct C { std::string n; };\n"
LIST = 'std::vector<C> v{{"a"}, {"b"}};\n'
USED = "\nADV(v[0].n, 1);"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (LIST + 'for (auto c : v) c.n += "x";' + USED, ["/a"]),
        (LIST + 'for (C c : v) c.n = "x";' + USED, ["/a"]),
        (LIST + 'for (auto c : v) { c.n += "x"; ADV(c.n, 1); }', ["/ax", "/bx"]),
        # what is no copy
        (LIST + 'for (auto& c : v) c.n += "x";' + USED, ["/ax"]),
        (LIST + 'for (C& c : v) c.n += "x";' + USED, ["/ax"]),
        (LIST + 'for (auto&& c : v) c.n += "x";' + USED, ["/ax"]),
        ('std::vector<C*> v;\nv.push_back(new C());\nfor (auto c : v) c->n = "x";\nADV(v[0]->n, 1);', ["/x"]),
        (
            'std::vector<std::shared_ptr<C>> v;\nv.push_back(std::make_shared<C>());\nfor (auto c : v) c->n = "x";\nADV(v[0]->n, 1);',
            ["/x"],
        ),
        (LIST + "for (const auto& c : v) ADV(c.n, 1);", ["/a", "/b"]),
    ],
)
def test_elements_that_a_loop_copies(body: str, expected: list[str]) -> None:
    assert made(body, STRUCT) == expected


THROWS = 'void f(int i) {\nif (i > 1) throw std::runtime_error("x");\nros::NodeHandle nh;\nADV("in", 1);\n}\n'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('try { f(2); ADV("a", 1); } catch (const std::exception& e) { ADV("b", 1); }', ["/a!", "/b", "/in!"]),
        ('try { f(2); ADV("a", 1); } catch (const std::runtime_error& e) { ADV("b", 1); }', ["/a!", "/b", "/in!"]),
        ('try { f(2); ADV("a", 1); } catch (...) { ADV("b", 1); }', ["/a!", "/b", "/in!"]),
        # what is not thrown, not caught, or not for certain
        ('try { f(1); ADV("a", 1); } catch (const std::exception& e) { ADV("b", 1); }', ["/a", "/b", "/in"]),
        ('try { f(2); ADV("a", 1); } catch (const std::out_of_range& e) { ADV("b", 1); }', ["/a", "/b", "/in"]),
        ('try { f(x()); ADV("a", 1); } catch (const std::exception& e) { ADV("b", 1); }', ["/a", "/b", "/in"]),
        ('try { if (x()) f(2); ADV("a", 1); } catch (const std::exception& e) { ADV("b", 1); }', ["/a", "/b", "/in"]),
        ('try { f(2); } catch (const std::exception& e) { }\nADV("a", 1);', ["/a", "/in"]),
        ('f(1);\nADV("a", 1);', ["/a", "/in"]),
    ],
)
def test_what_stands_behind_a_function_that_throws(body: str, expected: list[str]) -> None:
    found = made(body, THROWS.replace("ADV(", "nh.advertise<std_msgs::String>("))
    assert [name.replace("/in!", "/in") for name in found] == [name.replace("/in!", "/in") for name in expected]


CHANGED = "void set(rclcpp::QoS& q) { q.transient_local(); }\nvoid copied(rclcpp::QoS q) { q.transient_local(); }\n"
CHANGED += "void read(const rclcpp::QoS& q) { (void)q; }\n"


@pytest.mark.parametrize(
    ("call", "durability"), [("set(q);", KEPT), ("copied(q);", "volatile"), ("read(q);", "volatile"), ("", "volatile")]
)
def test_a_quality_of_service_that_a_function_changes(call: str, durability: str) -> None:
    body = f'rclcpp::QoS q(7);\n{call}\ncreate_publisher<String>("a", q);'
    (node,) = [node for node in ros2_cpp(body, before=CHANGED).nodes if node.name == "/n"]
    assert policies(explicit(node)[0]) == last(7, durability=durability)


WINDOW = "class W : public %s {\npublic:\nros::NodeHandle nh;\nW(bool on) { if (on) connect(); }\n"
WINDOW += 'void connect() { on_button_connect_clicked(true); }\nvoid %s(bool check) { ADV("a", 1); }\n};\n'


@pytest.mark.parametrize(
    ("base", "name", "conditions"),
    [
        ("QMainWindow", "on_button_connect_clicked", 0),
        ("QWidget", "on_button_connect_clicked", 0),
        # what Qt does not connect
        ("elsewhere::Window", "on_button_connect_clicked", 1),
        ("Quaternion", "on_button_connect_clicked", 1),
    ],
)
def test_slots_that_qt_connects_by_their_names(base: str, name: str, conditions: int) -> None:
    before = (WINDOW % (base, name)).replace("ADV(", "nh.advertise<std_msgs::String>(")
    (end,) = [end for end in cpp("W w(x());", before).endpoints if end.kind == "publishers"]
    assert (end.name, len(end.conditions)) == ("/a", conditions)
