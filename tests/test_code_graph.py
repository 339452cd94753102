# SPDX-License-Identifier: Apache-2.0
"""The call graph: what a call runs, what a callback is and reaches, in which group; silent where that is not known."""

from __future__ import annotations

import pytest

from haros_ci import syntax
from haros_ci.code.callbacks import Callback, callbacks, excludes
from haros_ci.code.calls import called, callers, reached
from haros_ci.code.clients import client_made, is_node, own_method
from haros_ci.code.codebase import Codebase, Routine, codebase
from haros_ci.code.kinds import dotted, type_name
from haros_ci.code.message_names import ros_type
from haros_ci.code.ways import in_callbacks
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.python.read import read_python
from haros_ci.index.index import Source


def made(**texts: str) -> Codebase:
    """Files by name, ``a_hpp`` for ``a.hpp``, all of one package."""
    files = {name.rpartition("_")[0] + "." + name.rpartition("_")[2]: text for name, text in texts.items()}
    sources = [
        Source(path, "demo", read_python(text), path[:-3])
        if path.endswith(".py")
        else Source(path, "demo", read_cpp(text))
        for path, text in sorted(files.items())
    ]
    return codebase(sources, lambda path: files.get(path, ""))


def routine(code: Codebase, title: str) -> Routine:
    return next(each for path in code.by_path for each in code.routines(path) if each.title == title)


def targets(code: Codebase, title: str) -> list[str]:
    where = routine(code, title)
    return [target.title for call in code.body(where).calls for target in called(code, where, call.whole)]


HELPERS = "void free_one(int) {}\nvoid twice(int) {}\nvoid twice(double) {}\nvoid declared(int);\n"
KNOWN = {
    "method": ("void other() {}", "other();", ["A::other"]),
    "method through this": ("void other() {}", "this->other();", ["A::other"]),
    "method of a member": ("B b_;", "b_.work();", ["B::work"]),
    "method through a smart pointer": ("std::unique_ptr<B> b_;", "b_->work();", ["B::work"]),
    "method of a base": ("", "inherited();", ["Base::inherited"]),
    "method of a local variable": ("", "B b; b.work();", ["B::work"]),
    "method of what auto stands for": ("", "auto b = std::make_shared<B>(); b->work();", ["B::work"]),
    "method of an element": ("std::vector<B> bs_;", "for (auto & b : bs_) { b.work(); }", ["B::work"]),
    "method of what a method returns": ("B make() { return B(); }", "make().work();", ["B::work", "A::make"]),
    "free function": ("", "free_one(1);", ["free_one"]),
    "overload by the number of arguments": ("void f() {} void f(int) {}", "f(1);", ["A::f"]),
    "one variable in two scopes": ("", "{ B b; } { B b; b.work(); }", ["B::work"]),
    "lambda of a variable": ("", "auto f = [this]() { return 1; }; f();", ["the lambda in A::go"]),
}
UNKNOWN = {
    "overloads of one length": ("", "twice(1);"),
    "no body": ("", "declared(1);"),
    "not that many arguments": ("void f(int) {}", "f();"),
    "pure virtual": ("virtual void f() = 0;", "f();"),
    "a library's class": ("ros::Publisher p_;", "p_.publish(1);"),
    "a value that is called": ("std::function<void()> f_;", "f_();"),
    "a parameter of the same name": ("void other() {}", "std::function<void()> other; other();"),
    "a lambda that is only passed": ("", "std::for_each(a, b, [](int) { free_one(1); });"),
    "a variable of unknown type": ("", "auto b = unknown(); b.work();"),
    "one name in two scopes": ("", "{ B b; } { C b; b.work(); }"),
    "a variable that stands for itself": ("", "for (auto & b : b.parts) { b.work(); }"),
}


def cpp(members: str, body: str) -> Codebase:
    return made(
        a_cpp="struct B { void work() {} };\nstruct C { void work() {} };\nstruct Base { void inherited() {} };\n"
        f"{HELPERS}class A : public Base {{ public: void go() {{ {body} }}\n{members} }};\n"
    )


@pytest.mark.parametrize("case", KNOWN)
def test_a_call_runs(case: str) -> None:
    members, body, expected = KNOWN[case]
    assert targets(cpp(members, body), "A::go") == expected


@pytest.mark.parametrize("case", UNKNOWN)
def test_what_a_call_runs_is_not_known(case: str) -> None:
    assert targets(cpp(*UNKNOWN[case]), "A::go") == []


def test_a_method_is_defined_in_another_file() -> None:
    code = made(
        a_hpp="namespace n { class A { void go(); void work(); }; }",
        a_cpp='#include "a.hpp"\nnamespace n { void A::go() { work(); } void A::work() {} }',
        b_cpp="namespace n { class A { void work() { other(); } }; }",
    )
    assert targets(code, "A::go") == ["A::work"]
    found = routine(code, "A::go")
    target = called(code, found, code.body(found).calls[0].whole)[0]
    assert target.path == "a.cpp"
    assert [(each.title, call.line) for each, call in callers(code, target)] == [("A::go", 2)]


def test_python_calls() -> None:
    code = made(
        base_py="class Base:\n  def inherited(self): pass\ndef helper(): pass\n",
        a_py="import base\nfrom base import Base, helper as h\nclass Part:\n  def work(self): pass\n"
        "class A(Base):\n  def __init__(self):\n    self.part = Part()\n    self.either = Part()\n    self.either = Base()\n"
        "  def go(self, h2):\n    self.part.work()\n    self.inherited()\n    super().inherited()\n    h()\n    base.helper()\n"
        "    def inner(): pass\n    inner()\n    h2()\n    self.either.work()\n    unknown.work()\n",
    )
    expected = ["Part.work", "Base.inherited", "Base.inherited", "helper", "helper", "go.inner"]
    assert [each.rpartition(".")[2] for each in targets(code, "A.go")] == [each.rpartition(".")[2] for each in expected]


def test_dotted_names_go_through_imports() -> None:
    code = made(
        a_py="import time as t\nfrom os import system\ndef f(eval):\n  import subprocess as sp\n  t.sleep(1)\n  system('')\n  sp.run('')\n  eval('')\n"
    )
    where = routine(code, "f")
    names = [dotted(code, where, call.callee) for call in code.body(where).calls]
    assert names == ["time.sleep", "os.system", "subprocess.run", ""]


NODE = "#include <rclcpp/rclcpp.hpp>\nclass N : public rclcpp::Node {{ public: N() {{ {make} }}\nvoid tick() {{ work(); }} void work() {{}}\n{members} }};\n"


def one(code: Codebase) -> Callback:
    (found,) = callbacks(code)
    return found


@pytest.mark.parametrize(
    ("make", "kind", "title", "group"),
    [
        ('create_subscription<M>("t", 1, std::bind(&N::tick, this));', "subscription", "N::tick", ""),
        ('create_subscription<M>("t", 1, [this](M m) { tick(); });', "subscription", "the lambda in N::N", ""),
        ("create_wall_timer(1s, std::bind(&N::tick, this));", "timer", "N::tick", ""),
        ("create_wall_timer(1s, [this]() { tick(); }, g_);", "timer", "the lambda in N::N", "N.g_"),
        ('this->create_service<M>("s", std::bind(&N::tick, this));', "service", "N::tick", ""),
        ("auto f = [this]() { tick(); }; create_wall_timer(1s, f);", "timer", "the lambda in N::N", ""),
        ("create_wall_timer(1s, f ? a : b, [this]() {});", "timer", "the lambda in N::N", None),
    ],
)
def test_a_callback_and_its_group(make: str, kind: str, title: str, group: str | None) -> None:
    found = one(made(n_cpp=NODE.format(make=make, members="rclcpp::CallbackGroup::SharedPtr g_;")))
    assert (found.kind, found.routine.title, found.group, found.ros) == (kind, title, group, 2)


@pytest.mark.parametrize(
    "make",
    [
        "create_wall_timer(1s, callback_);",
        "create_wall_timer(1s, make_callback());",
        'foo.subscribe("t", 1, &N::tick, this);',
        "createTimer(1.0, &N::tick);",
        "create_wall_timer(1s, std::bind(&Other::tick, other_));",
    ],
)
def test_no_callback_that_is_known(make: str) -> None:
    assert callbacks(made(n_cpp=NODE.format(make=make, members=""))) == ()


def test_options_give_a_subscription_its_group() -> None:
    make = 'rclcpp::SubscriptionOptions o; o.callback_group = g_; create_subscription<M>("t", 1, [](M m) {}, o);'
    assert one(made(n_cpp=NODE.format(make=make, members="int g_;"))).group == "N.g_"
    make = 'rclcpp::SubscriptionOptions o; create_subscription<M>("t", 1, [](M m) {}, o);'
    assert one(made(n_cpp=NODE.format(make=make, members=""))).group == ""
    make = 'auto o = options(); create_subscription<M>("t", 1, [](M m) {}, o);'
    assert one(made(n_cpp=NODE.format(make=make, members=""))).group is None


def test_which_groups_exclude_their_callbacks() -> None:
    code = made(
        a_py="from rclpy.callback_groups import ReentrantCallbackGroup, MutuallyExclusiveCallbackGroup\nclass A:\n  def __init__(self):\n"
        "    self.one = MutuallyExclusiveCallbackGroup()\n    self.many = ReentrantCallbackGroup()\n"
    )
    assert excludes(code, "", "")
    assert excludes(code, "A.one", "A.one")
    for pair in (("A.many", "A.many"), ("A.one", ""), ("", None), (None, None), ("A.given", "A.given")):
        assert not excludes(code, *pair)


def test_what_a_callback_reaches_with_its_way() -> None:
    code = made(n_cpp=NODE.format(make="create_wall_timer(1s, std::bind(&N::tick, this));", members=""))
    assert [(each.title, len(path)) for each, path in reached(code, one(code).routine)] == [
        ("N::tick", 0),
        ("N::work", 1),
    ]
    last = in_callbacks(code)[-1]
    assert last.routine.title == "N::work"
    words = [text for _, text in last.flow(code.body(last.path[-1][0]).calls[0], "here")]
    assert words == ["N::tick is the callback of a timer", "N::tick calls work", "here"]


def test_calls_in_a_circle_end() -> None:
    code = made(a_cpp="void b(); void a() { b(); } void b() { a(); }")
    assert [each.title for each, _ in reached(code, routine(code, "a"))] == ["a", "b"]


def test_ros1_callbacks() -> None:
    code = made(
        a_cpp='#include <ros/ros.h>\nstruct A { void cb(); void init() { nh_.subscribe("t", 1, &A::cb, this); }\nros::NodeHandle nh_; };\n'
        'void cb() {}\nvoid f() { ros::NodeHandle nh; nh.subscribe("t", 1, cb); }\n',
        b_py="import rospy\nfrom rospy import Timer\ndef cb(m): pass\nrospy.Subscriber('t', M, cb)\nTimer(1, callback=cb)\nSubscriber('t', M, cb)\n",
    )
    found = [(each.maker.path, each.kind, each.ros, each.role) for each in callbacks(code)]
    assert found == [
        ("a.cpp", "subscription", 1, "2"),
        ("b.py", "subscription", 1, "2"),
        ("b.py", "timer", 1, "callback"),
    ]


def test_how_a_client_was_made() -> None:
    members = "rclcpp::Client<S>::SharedPtr c_, d_; rclcpp::CallbackGroup::SharedPtr g_;"
    code = made(
        n_cpp=NODE.format(make='c_ = create_client<S>("s"); d_ = node_->create_client<S>("s", q, g_);', members=members)
    )
    where = routine(code, "N::tick")
    client = client_made(code, where, syntax.Name("c_"))
    assert client is not None and (client.node, client.group) == ("N.this", "")
    client = client_made(code, where, syntax.Name("d_"))
    assert client is not None and (client.node, client.group) == ("N.node_", "N.g_")
    assert client_made(code, where, syntax.Name("e_")) is None


def test_whether_something_is_a_node() -> None:
    code = made(n_cpp=NODE.format(make="", members="ros::NodeHandle nh_; Foo foo_; void create_timer();"))
    where = routine(code, "N::tick")
    assert is_node(code, where, None) and is_node(code, where, syntax.Name("nh_"))
    assert not is_node(code, where, syntax.Name("foo_")) and not is_node(code, where, syntax.Name("unknown_"))
    assert type_name(code, where, syntax.Name("nh_")) == "ros::NodeHandle"
    body = made(n_cpp=NODE.format(make="create_timer(1s, x); create_service<S>(y);", members="void create_timer();"))
    calls = {call.name: call for call in body.body(routine(body, "N::N")).calls}
    assert own_method(body, routine(body, "N::N"), calls["create_timer"])
    assert not own_method(body, routine(body, "N::N"), calls["create_service"])


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("std_msgs::msg::String", "std_msgs/String"),
        ("std_msgs.msg.String", "std_msgs/String"),
        ("std_msgs::StringConstPtr", "std_msgs/String"),
        ("demo::srv::Start::Request", "demo/Start"),
        ("std_msgs::msg::String::SharedPtr", "std_msgs/String"),
        ("std::vector", None),
        ("String", None),
        ("a.b.c.d", None),
    ],
)
def test_message_names(name: str, expected: str | None) -> None:
    assert ros_type(name) == expected
