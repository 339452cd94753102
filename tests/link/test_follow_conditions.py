# SPDX-License-Identifier: Apache-2.0
"""Conditions: the statements around a call on the whole way from the entry, with their exact places."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, because, conditions, cpp, ends, follow, node, python, ros2_cpp

from haros_ci.model.architecture import Endpoint

HEAD = """#include <ros/ros.h>
#include <std_msgs/String.h>
bool cond();
bool other();
ros::NodeHandle* h;
void make() { ros::NodeHandle nh; nh.advertise<std_msgs::String>("a", 1); }
"""
#: What goes before main, main's body (from line 10 on, column 1), and the conditions of the only publisher.
CPP = (
    ("guarded function", "\n#ifdef X\nvoid f() { make(); }\n#endif", "f();", [("#if", "#ifdef X", 9, 1)]),
    (
        "guarded class",
        "\n#ifdef X\nstruct C { C() { make(); } };\n#endif",
        "C c;",
        [("#if", "#ifdef X", 9, 1)],
    ),
    ("none", "", "make();", []),
    ("if", "", "if (cond())\n  make();", [("if", "cond()", 10, 1)]),
    ("else", "", "if (cond()) {\n} else {\n  make(); }", [("else", "cond()", 11, 3)]),
    (
        "else if",
        "",
        "if (cond()) {\n} else if (other()) {\n  make(); }",
        [("else", "cond()", 11, 3), ("if", "other()", 11, 8)],
    ),
    ("for", "", "for (int i = 0; cond(); ++i) make();", [("for", "cond()", 10, 1)]),
    ("range-for", "", "for (auto x : xs) make();", [("for", "auto x : xs", 10, 1)]),
    ("while", "", "while (cond()) make();", [("while", "cond()", 10, 1)]),
    ("do", "", "do { make(); } while (cond());", []),
    ("switch", "", "switch (number()) {\n case 1: make(); }", [("switch", "number()", 10, 1)]),
    (
        "catch",
        "",
        "try { cond(); }\ncatch (const std::exception& e) { make(); }",
        [("catch", "const std::exception& e", 11, 1)],
    ),
    ("try", "", "try { make(); } catch (...) {}", []),
    ("#ifdef", "", "\n#ifdef X\nmake();\n#endif", [("#if", "#ifdef X", 11, 1)]),
    ("#else", "", "\n#ifdef X\n#else\nmake();\n#endif", [("#if", "#else", 12, 1)]),
    (
        "nested",
        "",
        "if (cond()) {\n while (other()) {\n make(); } }",
        [("if", "cond()", 10, 1), ("while", "other()", 11, 2)],
    ),
    ("through a caller", "void f() { if (cond()) make(); }", "f();", [("if", "cond()", 8, 12)]),
    (
        "through two callers",
        "void f() { if (cond()) make(); }",
        "if (other()) f();",
        [("if", "other()", 10, 1), ("if", "cond()", 8, 12)],
    ),
    ("through a constructor", "struct C { C() { if (cond()) make(); } };", "C c;", [("if", "cond()", 8, 18)]),
    ("constructed under one", "struct C { C() { make(); } };", "if (cond()) { C c; }", [("if", "cond()", 10, 1)]),
    (
        "through a callback",
        "void cb(const std_msgs::String& m) { make(); }",
        'if (cond()) nh.subscribe("x", 1, cb);',
        [("if", "cond()", 10, 1)],
    ),
    (
        "in a callback",
        'void cb(const std_msgs::String& m) { if (m.data == "") make(); }',
        'nh.subscribe("x", 1, cb);',
        [("if", 'm.data == ""', 8, 38)],
    ),
    ("known, too", "", "if (true) make();", [("if", "true", 10, 1)]),
    ("twice, once without", "", "if (cond()) make();\nmake();", []),
    ("twice, first without", "", "make();\nif (cond()) make();", []),
    ("by a lambda", "", "auto f = [] { make(); };\nif (cond()) f();", [("if", "cond()", 11, 1)]),
    ("ternary", "", "cond() ? make() : (void) 0;", None),
    ("and", "", "cond() && (make(), true);", None),
    ("and with a name", "", 'cond() && nh.advertise<std_msgs::String>("b", 1);', None),
    (
        "ternary with a name",
        "",
        'ros::Publisher p = cond() ? nh.advertise<std_msgs::String>("b", 1) : ros::Publisher();',
        None,
    ),
    ("spaces", "", "if ( cond( )\n   && other() )\n  make();", [("if", "cond( ) && other()", 10, 1)]),
    ("early return of a caller", "void f() { if (cond()) return; make(); }", "f();", []),
)
#: Why a row does not hold yet.
DEFECTS = because(
    "guards of functions and classes are no conditions (Function.guards is not read in link)",
)


def is_told(end: Endpoint) -> bool:
    """Whether what ``&&``, ``||`` and ``?:`` make is told to be made on some paths only."""
    return "conditions" in {unknown.field for unknown in end.unknowns}


def publisher(before: str, body: str) -> Endpoint:
    text = (
        HEAD
        + "int number();\n"
        + before
        + '\nint main(int c, char** v) { ros::init(c, v, "n"); ros::NodeHandle nh;\n'
        + body
        + "\n}\n"
    )
    made = ends(node(follow({"p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n m.cpp)\n", "p/m.cpp": text})))
    assert len(made) == 1
    return made[0]


@pytest.mark.parametrize(("name", "before", "body", "expected"), CPP)
def test_conditions_of_cpp(
    name: str, before: str, body: str, expected: list[tuple[str, str, int, int]] | None, request: pytest.FixtureRequest
) -> None:
    if name in DEFECTS:
        request.applymarker(pytest.mark.xfail(strict=True, reason=DEFECTS[name]))
    got = publisher(before, body)
    if expected is None:
        assert is_told(got), "made on some paths only"
    else:
        assert conditions(got) == expected


#: A script's text from line 5 on, and the conditions of the only publisher.
PYTHON = (
    ("none", "make()", []),
    ("if", "if cond():\n    make()", [("if", "cond()", 7, 1)]),
    ("else", "if cond():\n    pass\nelse:\n    make()", [("else", "cond()", 9, 1)]),
    ("elif", "if cond():\n    pass\nelif other():\n    make()", [("else", "cond()", 9, 1), ("if", "other()", 9, 1)]),
    ("for", "for x in xs:\n    make()", [("for", "x in xs", 7, 1)]),
    ("while", "while not rospy.is_shutdown():\n    make()", [("while", "not rospy.is_shutdown()", 7, 1)]),
    ("except", "try:\n    cond()\nexcept ValueError:\n    make()", [("catch", "ValueError", 9, 1)]),
    ("in a function", "def f():\n    if cond():\n        make()\nf()", [("if", "cond()", 8, 5)]),
    ("under a call", "def f():\n    make()\nif cond():\n    f()", [("if", "cond()", 9, 1)]),
    (
        "in a callback",
        'def cb(m):\n    if m.data:\n        make()\nrospy.Subscriber("x", String, cb)',
        [("if", "m.data", 8, 5)],
    ),
    ("conditional expression", "make() if cond() else None", None),
    ("or", "cond() or make()", None),
    ("twice", "if cond():\n    make()\nmake()", []),
)


@pytest.mark.parametrize(("name", "body", "expected"), PYTHON)
def test_conditions_of_python(
    name: str, body: str, expected: list[tuple[str, str, int, int]] | None, request: pytest.FixtureRequest
) -> None:
    if f"python: {name}" in DEFECTS:
        request.applymarker(pytest.mark.xfail(strict=True, reason=DEFECTS[f"python: {name}"]))
    made = ends(python(f'def make():\n    PUB("a")\n{body}\n'))
    assert len(made) == 1
    if expected is None:
        assert is_told(made[0]), "made on some paths only"
    else:
        assert conditions(made[0]) == expected


def test_the_guard_of_a_main_block_is_no_condition() -> None:
    made = ends(python('if __name__ == "__main__":\n    PUB("a")\n'))
    assert [conditions(end) for end in made] == [[]]


#: Guards as they are written, whether what is below them is made, and whether it is ruled out.
GUARDS = (
    ('if __name__ == "main":', True, True),
    ('if __name__ != "__main__":', True, True),
    ('if __name__ in ("__main__", "n"):', True, False),
    ('if not __name__ == "__main__":', True, True),
    ('if "__main__" == __name__:', True, False),
    ('if __name__ == "__main__" and True:', True, False),
    ('if __name__ == "__main__" or False:', True, False),
)


@pytest.mark.parametrize(("guard", "is_made", "is_ruled_out"), GUARDS)
def test_other_guards_with_the_name_of_the_module(guard: str, is_made: bool, is_ruled_out: bool) -> None:
    made = ends(python(f'{guard}\n    PUB("a")\n'))
    assert [end.is_ruled_out for end in made] == [is_ruled_out] * is_made


def test_two_names_at_one_place_have_their_own_conditions() -> None:
    made = ends(python('def f(n):\n    PUB(n)\nf("a")\nif cond():\n    f("b")\n'))
    assert [(end.name, conditions(end)) for end in made] == [("/a", []), ("/b", [("if", "cond()", 8, 1)])]
    assert len({end.location for end in made}) == 1


WAYS = (
    ("if (a) { if (b) make(); } if (c) make();", [], True),
    ("if (a) make(); if (b) make();", [], True),
    ("if (a) { if (b) make(); if (c) make(); }", ["a"], True),
    ("if (a) make(); else if (b) make();", [], True),
    ("if (a) { if (b) make(); } else make();", [], True),
    ("if (a) make(); make();", [], False),
    ("if (a) { if (b) make(); make(); }", ["a"], False),
    ("if (a) make(); else make();", [], False),
    ("if (a) { if (b) make(); else make(); }", ["a"], False),
    ("if (a) { if (b) make(); }", ["a", "b"], False),
    ("auto f = [&] { if (b) make(); }; if (a) f(); f();", ["b"], False),
    ("auto f = [&] { if (b) make(); }; if (a) f(); if (c) f();", ["b"], True),
    ("auto f = [&] { if (b) make(); }; if (a) f(); else f();", ["b"], False),
    ("a && (make(), true);", [], True),
    ("make(); a && (make(), true);", [], False),
    ("a && (make(), true); make();", [], False),
    ("a && (make(), true); if (b) make();", [], True),
    ("if (a) make(); if (a) { b && (make(), true); }", [], True),
)


#: The same where it is known what holds: a way that is ruled out adds nothing to one that is not.
DECIDED = (
    ("if (a) { if (b) make(); } else make();", "a = true, b = number()", ["a", "b"]),
    ("if (a) { if (b) make(); } else make();", "a = false, b = number()", ["a"]),
    ("if (a) { if (b) make(); } if (b) make();", "a = false, b = number()", ["b"]),
    ("if (b) make(); if (a) { if (c) make(); }", "a = false, b = number(), c = number()", ["b"]),
    ("if (a) make(); if (c) make(); if (b) make();", "a = false, b = number(), c = false", ["b"]),
    ("if (b) make(); if (a) make(); if (c) make();", "a = false, b = number(), c = false", ["b"]),
    ("if (a) make(); else make();", "a = true", []),
    ("make(); if (a) make();", "a = false", []),
    ("if (a) { if (b) make(); }", "a = false, b = number()", ["a", "b"]),
)


@pytest.mark.parametrize(("body", "values", "told"), DECIDED)
def test_a_way_that_is_ruled_out_does_not_count_beside_one_that_is_not(body: str, values: str, told: list[str]) -> None:
    _check_ways(body, values, told, False)


@pytest.mark.parametrize(("body", "common", "is_open"), WAYS)
def test_of_several_ways_counts_what_they_have_in_common(body: str, common: list[str], is_open: bool) -> None:
    """And that the rest is not told is told."""
    _check_ways(body, "a = number(), b = number(), c = number()", common, is_open)


def _check_ways(body: str, values: str, common: list[str], is_open: bool) -> None:
    text = HEAD + 'void make() { ros::NodeHandle nh; nh.advertise<std_msgs::String>("a", 1); }\n'
    text += "int number();\n"
    text += f'int main(int n, char** v) {{ ros::init(n, v, "n"); bool {values};\n{body}\n}}\n'
    files = {"p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n m.cpp)\n", "p/m.cpp": text}
    made = ends(node(follow(files)))
    assert [[condition for _, condition, _, _ in conditions(end)] for end in made] == [common]
    assert ["conditions" in {unknown.field for unknown in end.unknowns} for end in made] == [is_open]


#: Members of a component, and the conditions of its only publisher, which a thread makes.
THREADS = (
    (
        "a device that is looked for",
        "acme::Device device_;",
        "while (!device_) { look(); if (device_) start(); }",
        ["file.empty()", "!device_", "device_"],
    ),
    ("no loop", "acme::Device device_;", "if (!device_) start();", ["file.empty()", "!device_"]),
    (
        "a pointer under a name of the library",
        "acme::DevicePtr device_ = acme::open();",
        "if (device_) start();",
        ["file.empty()", "device_"],
    ),
    (
        "a pointer that is not set",
        "std::shared_ptr<acme::Device> device_;",
        "if (!device_) start();",
        ["file.empty()", "!device_"],
    ),
)


@pytest.mark.parametrize(("name", "members", "body", "expected"), THREADS)
def test_an_else_way_through_a_thread_is_not_lost(name: str, members: str, body: str, expected: list[str]) -> None:
    found = ros2_cpp(
        'std::string file = declare_parameter("file", std::string(""));\n'
        "if (!file.empty()) { device_ = acme::load(file); start(); }\n"
        f"if (file.empty()) {{ thread_ = std::thread([this]() {{ {body} }}); }}",
        f"{members} std::thread thread_; rclcpp::Publisher<String>::SharedPtr pub_;\nvoid look();\n"
        'void start() { pub_ = create_publisher<String>("a", 1); }',
    )
    (end,) = [each for node in found.nodes for each in ends(node) if not each.implicit]
    assert [condition for _, condition, _, _ in conditions(end)] == expected


@pytest.mark.parametrize(
    ("kind", "is_pointer"),
    (
        ("device_ptr", True),
        ("DeviceRef", True),
        ("Device", False),
        ("Xref", False),
        ("Interptr", False),
    ),
)
def test_an_object_of_a_library_is_true_under_the_name_of_a_pointer(kind: str, is_pointer: bool) -> None:
    (end,) = ends(cpp(f'acme::{kind} device; if (!device) ADV("a", 1);', ""))
    assert end.is_ruled_out == is_pointer


EXITS = (
    ("exit", 'std::string s = "a"; if (cond()) { s = "b"; exit(1); }', "/a"),
    ("std::exit", 'std::string s = "a"; if (cond()) { s = "b"; std::exit(1); }', "/a"),
    ("abort in a handler", 'std::string s = "a"; try { cond(); } catch (...) { s = "b"; std::abort(); }', "/a"),
    ("a method of that name", 'std::string s = "a"; Door d; if (cond()) { s = "b"; d.exit(1); }', "/?"),
    ("a function of that name", 'std::string s = "a"; if (cond()) { s = "b"; door::exit(1); }', "/?"),
    ("at the end of the program only", 'std::string s = "a"; if (cond()) { s = "b"; atexit(stop); }', "/?"),
)


@pytest.mark.parametrize(("name", "code", "expected"), EXITS)
def test_what_ends_the_program_leaves_nothing_behind(name: str, code: str, expected: str) -> None:
    before = "bool cond(); void stop(); struct Door { void exit(int); }; namespace door { void exit(int) {} }"
    (end,) = ends(cpp(f"{code} ADV(s, 1);", before))
    assert end.name == expected


def test_a_module_that_one_branch_loads_is_loaded_in_the_other() -> None:
    lamp = "import rospy\nfrom std_msgs.msg import String\nTOPIC = 'lamp'\n"
    lamp += "def light(name=TOPIC):\n    rospy.Publisher(name, String, queue_size=1)\n"
    made = ends(python("from lib.lamp import light\nif cond():\n    light()\nelse:\n    light()\n", lamp=lamp))
    assert [(end.name, conditions(end)) for end in made] == [("/lamp", [])]


def test_a_static_that_one_branch_makes_is_made_in_the_other() -> None:
    before = 'bool cond(); struct C { std::string s; C() { s = "lamp"; } };\n'
    before += "void light(ros::NodeHandle& nh) { static C c; ADV(c.s, 1); }"
    made = ends(cpp("if (cond()) light(nh); else light(nh);", before))
    assert [(end.name, conditions(end)) for end in made] == [("/lamp", [])]


def test_what_a_callback_makes_that_is_registered_where_nothing_is_taken_is_ruled_out() -> None:
    body = 'bool on = false; if (on) nh.subscribe("x", 1, cb);'
    before = "void cb(const std_msgs::String& m) { ros::NodeHandle nh; ADV(m.data, 1); }"
    (end,) = ends(cpp(body, before))
    assert end.is_ruled_out
    (end,) = ends(cpp(body + ' nh.subscribe("x", 1, cb);', before))
    assert not end.is_ruled_out and not end.conditions
