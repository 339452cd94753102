# SPDX-License-Identifier: Apache-2.0
"""Early ways out: what stands behind ``if (!enabled) return;`` is made under its opposite, and under nothing where no node runs on."""

from __future__ import annotations

import pytest
from follow_kit import cpp, cpp_files, ends, explicit, follow, node, python, ros2_cpp

from haros_ci.model.architecture import Endpoint

#: The functions that the code below calls.
BEFORE = "bool a(); bool b(); int number(); void look();\n"

#: The body of a function of C++ that makes one publisher with ADV, and its conditions.
CPP = (
    ("return", 'if (!a()) return; ADV("x", 1);', ["else !a()"]),
    ("in braces", 'if (!a()) { look(); return; } ADV("x", 1);', ["else !a()"]),
    ("with an else that goes on", 'if (a()) { return; } else { look(); } ADV("x", 1);', ["else a()"]),
    ("in the else", 'if (a()) { look(); } else { return; } ADV("x", 1);', ["if a()"]),
    ("two of them", 'if (a()) return; if (b()) return; ADV("x", 1);', ["else a()", "else b()"]),
    ("else if", 'if (a()) { return; } else if (b()) { return; } ADV("x", 1);', ["else a()", "else b()"]),
    ("else if alone", 'if (a()) { look(); } else if (b()) { return; } ADV("x", 1);', ["else !(a()) && b()"]),
    ("in a block of its own", '{ if (a()) return; } ADV("x", 1);', ["else a()"]),
    ("inside another", 'if (a()) { if (b()) return; look(); } ADV("x", 1);', ["else a() && b()"]),
    ("inside another, behind it", 'if (a()) { if (b()) return; ADV("x", 1); }', ["if a()", "else b()"]),
    ("of two texts", 'if (a() || b()) { if (b() == a()) return; } ADV("x", 1);', ["else (a() || b()) && (b() == a())"]),
    ("in a loop", 'for (int i : xs) { if (a()) return; } ADV("x", 1);', ["else a()"]),
    ("continue", 'for (int i : xs) { if (a()) continue; ADV("x", 1); }', ["for int i : xs", "else a()"]),
    ("break", 'while (b()) { if (a()) break; ADV("x", 1); }', ["while b()", "else a()"]),
    ("continue, after the loop", 'for (int i : xs) { if (a()) continue; } ADV("x", 1);', []),
    ("break, after the loop", 'while (b()) { if (a()) break; } ADV("x", 1);', []),
    ("continue in a switch", 'for (int i : xs) { switch (number()) { case 1: continue; default: look(); } ADV("x", 1); }', ["for int i : xs", "switch number()"]),
    ("switch", 'switch (number()) { case 1: return; default: look(); } ADV("x", 1);', ["switch number()"]),
    ("break of a case", 'switch (number()) { case 1: if (a()) break; ADV("x", 1); }', ["switch number()", "else a()"]),
    ("break of a case, after it", 'switch (number()) { case 1: if (a()) break; look(); } ADV("x", 1);', []),
    ("a flag that is set", 'const bool on = true; if (!on) return; ADV("x", 1);', ["else !on"]),
    ("a flag that is not", 'const bool on = false; if (!on) return; ADV("x", 1);', ["else !on"]),
    ("a flag inside another", 'const bool on = true; if (on) { if (on) return; } ADV("x", 1);', ["else on && on"]),
    ("caught", 'try { if (a()) throw 1; ADV("x", 1); } catch (...) { look(); }', ["else a()"]),
    ("caught, after the block", 'try { if (a()) throw 1; } catch (...) { look(); } ADV("x", 1);', []),
    ("made on both ways", 'if (a()) { make(nh); return; } make(nh);', []),
    ("made on both ways, under a return", 'if (a()) { if (b()) return; make(nh); return; } make(nh);', []),
    ("a callback registered behind it", 'if (a()) return; nh.subscribe("s", 1, cb);', ["else a()"]),
    ("#if", '\n#ifdef X\nif (a()) return;\n#endif\nADV("x", 1);', ["?"]),
    ("#if of this build", '\n#define X\n#ifdef X\nif (a()) return;\n#endif\nADV("x", 1);', ["else a()"]),
    ("#if of no build", '\n#undef X\n#ifdef X\nif (a()) return;\n#endif\nADV("x", 1);', []),
    ("ok of something else", 'if (!door.ok()) return; ADV("x", 1);', ["else !door.ok()"]),
    ("ok of one's own", 'if (!isInitialized()) return; ADV("x", 1);', ["else !isInitialized()"]),
    # no condition
    ("ok of a handle", 'if (!nh.ok()) return; ADV("x", 1);', []),
    ("at the end", 'ADV("x", 1); if (a()) return;', []),
    ("in a function that is called before", 'auto f = [] { if (a()) return; look(); }; f(); ADV("x", 1);', []),
    ("throw", 'if (a()) throw 1; ADV("x", 1);', []),
    ("exit", 'if (a()) { look(); exit(1); } ADV("x", 1);', []),
    ("shutdown", 'if (a()) { ros::shutdown(); return; } ADV("x", 1);', []),
    ("caught by what passes it on", 'try { if (a()) throw 1; ADV("x", 1); } catch (...) { throw; }', []),
    ("in a handler", 'try { look(); } catch (...) { return; } ADV("x", 1);', ["catch ..."]),
    ("in an if of a handler", 'try { look(); } catch (...) { if (a()) return; look(); } ADV("x", 1);', ["catch ..."]),
    ("in a handler inside an if", 'if (a()) { try { look(); } catch (...) { return; } } ADV("x", 1);', ["catch ..."]),
    ("behind a handler that returns", 'if (a()) { try { look(); } catch (...) { return; } if (b()) return; } ADV("x", 1);', ["catch ...", "else a() && b()"]),
    ("continue in a handler", 'for (int i : xs) { try { look(); } catch (...) { continue; } ADV("x", 1); }', ["for int i : xs", "catch ..."]),
    ("continue in a handler, after the loop", 'for (int i : xs) { try { look(); } catch (...) { continue; } } ADV("x", 1);', []),
    ("a handler that goes on", 'try { look(); } catch (...) { a(); } ADV("x", 1);', []),
    ("a handler that passes it on", 'try { look(); } catch (...) { throw; } ADV("x", 1);', []),
    ("a handler that ends the program", 'try { look(); } catch (...) { exit(1); } ADV("x", 1);', []),
    ("in the block before a handler returns", 'try { ADV("x", 1); } catch (...) { return; }', []),
    ("ok", 'if (!ros::ok()) return; ADV("x", 1);', []),
    ("ok or initialized", 'if (!ros::ok() || !ros::isInitialized()) { return; } ADV("x", 1);', []),
    ("ok and more", 'if (!ros::ok() && a()) return; ADV("x", 1);', []),
    ("ok or more", 'if (!ros::ok() || a()) return; ADV("x", 1);', ["else !ros::ok() || a()"]),
    ("a loop while ok", 'while (a()) { if (!ros::ok()) return; look(); } ADV("x", 1);', []),
    ("a pointer", 'acme::Door::Ptr p = acme::find(); if (!p) return; ADV("x", 1);', []),
    ("a pointer to what is given", 'T* p = find(); if (p == nullptr) return; ADV("x", 1);', []),
    ("what was just made", 'auto p = std::make_shared<T>(); if (p == nullptr) return; ADV("x", 1);', []),
    ("what is not there yet", 'static std::shared_ptr<T> p; if (p) return; ADV("x", 1);', []),
    ("a return that comes for sure", 'ADV("x", 1); return;', []),
)  # fmt: skip


def told(end: Endpoint) -> list[str]:
    """Statement and text of each condition; ``never`` of what is ruled out, ``?`` where they are not known as a whole."""
    is_open = any(unknown.field == "conditions" for unknown in end.unknowns)
    return (
        [f"{one.statement} {one.condition}" for one in (*end.conditions, *end.early_ways)]
        + ["never"] * end.is_ruled_out
        + ["?"] * is_open
    )


@pytest.mark.parametrize(("name", "body", "expected"), CPP)
def test_what_stands_behind_it_has_the_opposite_as_a_condition(name: str, body: str, expected: list[str]) -> None:
    before = (
        BEFORE + "struct T { int t; }; T* find(); extern std::vector<int> xs; bool isInitialized(); acme::Door door;\n"
    )
    before += 'void make(ros::NodeHandle& nh) { ADV("x", 1); }\n'
    before += 'void cb(const std_msgs::String&) { ros::NodeHandle nh; ADV("x", 1); }\n'
    made = ends(cpp("f(nh);", f"{before}void f(ros::NodeHandle& nh) {{ {body} }}"))
    assert [told(end) for end in made] == [expected]


#: What ``main`` does with what ``bool start(nh)`` returns, which returns false if ``a()``, and the conditions of what follows in it.
CALLERS = (
    ("start(nh);", ["else a()"]),
    ("if (start(nh)) look();", ["else a()"]),
    ("if (!start(nh)) look();", ["else a()"]),
    ("bool done = start(nh); if (b()) return 1;", ["else a()"]),
    ("if (!start(nh)) return 1;", []),
    ("if (!start(nh)) { look(); return 1; }", []),
    ("if (start(nh) == false) exit(1);", []),
    ("if (!start(nh)) { ros::shutdown(); }", []),
    ("if (!start(nh)) throw 1;", []),
    ("if (start(nh)) { look(); } else { return 1; }", []),
    ("bool done = start(nh); if (!done) return 1;", []),
    ("bool done; done = start(nh); if (!done) { return 1; }", []),
    ("return start(nh) ? 0 : 1;", []),
    ("if (!again(nh)) return 1;", []),
)


@pytest.mark.parametrize(("call", "expected"), CALLERS)
def test_a_failure_that_ends_the_program_is_none(call: str, expected: list[str]) -> None:
    before = BEFORE + 'bool start(ros::NodeHandle& nh) { if (a()) return false; ADV("x", 1); return true; }\n'
    before += "bool again(ros::NodeHandle& nh) { if (!start(nh)) return false; return true; }\n"
    (end,) = ends(cpp(call, before))
    assert told(end) == expected


def test_a_return_of_main_ends_the_program() -> None:
    (end,) = ends(cpp('if (argc < 2) return 1; if (a()) { look(); return 2; } ADV("x", 1);', BEFORE))
    assert told(end) == []


#: A managed node's method that starts it, and the conditions of its only publisher.
STARTS = (
    ("on_configure", "if (a()) return CallbackReturn::FAILURE;", []),
    ("on_configure", "if (a()) { return CallbackReturn::ERROR; }", []),
    ("on_activate", "if (a()) return CallbackReturn::FAILURE;", []),
    ("on_configure", "if (a()) return CallbackReturn::SUCCESS;", ["else a()"]),
)


@pytest.mark.parametrize(("method", "body", "expected"), STARTS)
def test_a_failure_to_start_is_none(method: str, body: str, expected: list[str]) -> None:
    kind = "rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::CallbackReturn"
    text = f"using CallbackReturn = {kind};\nbool a();\n"
    members = f"CallbackReturn {method}(const rclcpp_lifecycle::State&) override {{ {body}\n"
    members += 'pub_ = create_publisher<String>("x", 1); return CallbackReturn::SUCCESS; }\n'
    files = text + "class M : public rclcpp_lifecycle::LifecycleNode { public:\n"
    files += f'explicit M(const rclcpp::NodeOptions& o) : LifecycleNode("m", o) {{}}\n{members}\n'
    files += "rclcpp_lifecycle::LifecyclePublisher<String>::SharedPtr pub_; };\n"
    found = ros2_cpp("auto m = std::make_shared<M>(options);", "", files)
    made = [end for node in found.nodes for end in explicit(node) if end.name == "/x"]
    assert [told(end) for end in made] == [expected]


def test_which_overload_is_called_is_no_condition() -> None:
    before = 'void put(ros::NodeHandle& nh, int i) { ADV("x", 1); }\nvoid put(ros::NodeHandle& nh, double d) { ADV("y", 1); }\n'
    (end,) = ends(cpp("put(nh, acme::number());", before))
    assert told(end) == []


def test_what_starts_without_a_result_fails_by_no_return() -> None:
    text = "#include <nodelet/nodelet.h>\n#include <std_msgs/String.h>\nbool a();\n"
    text += "class N : public nodelet::Nodelet { void onInit() override { initialize(); }\n"
    text += 'void initialize() { if (a()) return; getNodeHandle().advertise<std_msgs::String>("x", 1); } };\n'
    text += 'int main(int argc, char** argv) { ros::init(argc, argv, "n"); N n; n.initialize(); }\n'
    (end,) = ends(node(follow(cpp_files(text))))
    assert told(end) == ["else a()"]


#: A script of Python that makes one publisher, and its conditions.
PYTHON = (
    ("return", 'def f():\n    if not a():\n        return\n    PUB("x")\nf()', ["else not a()"]),
    ("elif", 'def f():\n    if a():\n        return\n    elif b():\n        return\n    PUB("x")\nf()', ["else a()", "else b()"]),
    ("elif alone", 'def f():\n    if a():\n        b()\n    elif b():\n        return\n    PUB("x")\nf()', ["else not (a()) and b()"]),
    ("continue", 'for x in xs:\n    if a(x):\n        continue\n    PUB("x")', ["for x in xs", "else a(x)"]),
    ("a constructor", 'class C:\n    def __init__(self):\n        if a():\n            return\n        PUB("x")\nC()', ["else a()"]),
    ("a callback", 'def cb(m):\n    if m.data:\n        return\n    PUB("x")\nrospy.Subscriber("s", String, cb)', ["else m.data"]),
    ("a parameter", 'def f():\n    if not rospy.get_param("~on", True):\n        return\n    PUB("x")\nf()', ['else not rospy.get_param("~on", True)']),
    ("match", 'def f():\n    match a():\n        case 1:\n            return\n    PUB("x")\nf()', ["switch a()"]),
    # no condition
    ("main", 'def main():\n    if a():\n        return\n    PUB("x")\nif __name__ == "__main__":\n    main()', []),
    ("raise", 'def f():\n    if a():\n        raise ValueError\n    PUB("x")\nf()', []),
    ("sys.exit", 'import sys\nif a():\n    sys.exit(1)\nPUB("x")', []),
    ("signal_shutdown", 'def f():\n    if a():\n        rospy.signal_shutdown("x")\n        return\n    PUB("x")\nf()', []),
    ("is_shutdown", 'def f():\n    while a():\n        if rospy.is_shutdown():\n            return\n    PUB("x")\nf()', []),
    ("except", 'def f():\n    try:\n        a()\n    except ValueError:\n        return\n    PUB("x")\nf()', ["catch ValueError"]),
    ("not there yet", 'class C:\n    p = None\n    def f(self):\n        if self.p is not None:\n            return\n        self.p = PUB("x")\nc = C()\nc.f()\nc.f()', []),
)  # fmt: skip


@pytest.mark.parametrize(("name", "body", "expected"), PYTHON)
def test_the_same_of_python(name: str, body: str, expected: list[str]) -> None:
    assert [told(end) for end in ends(python(f"{body}\n"))] == [expected]


#: What a callback of a class with the flag ``on_``, which begins as false, does: whether what it makes is ruled out.
CALLBACKS = (
    ('if (on_) { ADV("x", 1); }', True),
    ('if (!on_) return; ADV("x", 1);', False),
    ('if (!on_) { on_ = true; return; } ADV("x", 1);', False),
    ('if (on_) return; on_ = true; ADV("x", 1);', False),
)


@pytest.mark.parametrize(("body", "expected"), CALLBACKS)
def test_a_callback_may_come_there_in_its_next_run(body: str, expected: bool) -> None:
    before = "struct C { ros::NodeHandle nh; bool on_ = false; ros::Subscriber s;\n"
    before += f'C() {{ s = nh.subscribe("s", 1, &C::cb, this); }} void cb(const std_msgs::String&) {{ {body} }} }};\n'
    (end,) = ends(cpp("C c;", before))
    assert end.is_ruled_out is expected
