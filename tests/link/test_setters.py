# SPDX-License-Identifier: Apache-2.0
"""Numbers and flags that methods set before anything is called back are known; what may run by then is not passed over."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends, names
from ros2_cpp_kit import component, explicit
from test_ros2_python import node

CLASS = """struct D {
  D(ros::NodeHandle nh) : nh_(nh) {}
  void load() { n_ = 2; flag_ = false; }
  void more() { n_ = 9; flag_ = true; }
  void set(int n) { n_ = n; }
  void setFlag(bool on) { flag_ = on; }
  void count() { n_++; }
  void longer() { for (int i = 0; i < 9; i++) n_ += i; }
  void both() { load(); count(); }
  void lamp() { flag_ = false; }
  void run() { n_ = 9; flag_ = true; }
  void cb(const std_msgs::String& m) { more(); }
  void use() {
    if (n_ > 2) p_ = nh_.advertise<std_msgs::String>("number", 1);
    if (flag_) p_ = nh_.advertise<std_msgs::String>("flag", 1);
  }
  void later(const std_msgs::String& m) { use(); }
  ros::NodeHandle nh_; ros::Publisher p_; int n_ = 7; bool flag_ = true;
};
void configure(D& d) { d.n_ = 1; d.flag_ = false; }
"""
SUB = 'ros::Subscriber s = nh.subscribe("x", 1, &D::cb, &d);'
LATER = 'ros::Subscriber l = nh.subscribe("y", 1, &D::later, &d);'
#: What ``main`` does with ``d`` and ``e``; which of the two publishers are ruled out.
KNOWN = {
    "a method": ("d.load(); d.use();", "flag number"),
    "with an argument": ("d.set(1); d.setFlag(false); d.use();", "flag number"),
    "with an argument that makes it": ("d.set(3); d.setFlag(true); d.use();", ""),
    "a free function": ("configure(d); d.use();", "flag number"),
    "one after the other": ("d.more(); d.load(); d.use();", "flag number"),
    "the last one counts": ("d.load(); d.more(); d.use();", ""),
    "one calls the other": ("d.both(); d.lamp(); d.use();", "flag"),
    "through a pointer": ("D* q = &d; q->load(); d.use();", "flag number"),
    "a callback that writes nothing": (f"d.load(); {LATER}", "flag number"),
    "a callback registered before that writes nothing": (f"{LATER} d.load();", "flag number"),
    "the same on both ways": ("if (std::rand()) d.load(); else d.load(); d.use();", "flag number"),
}
QUIET = {
    "not called": ("d.use();", ""),
    "after the use": ("d.use(); d.load();", ""),
    "of another object": ("e.load(); d.use();", ""),
    "called under a condition": ("if (std::rand()) d.load(); d.use();", ""),
    "with an argument that is not known": ("d.load(); d.set(std::rand()); d.use();", "flag"),
    "in a loop that goes on": ("while (ros::ok()) { d.use(); d.load(); }", ""),
    "a loop counts": ("d.load(); while (ros::ok()) { d.count(); d.use(); }", "flag"),
    "a loop of unknown length": ("d.load(); for (int i = 0; i < std::rand(); i++) d.count(); d.use();", "flag"),
    "with a loop in it": ("d.load(); d.longer(); d.use();", "flag"),
    "a callback sets it": (f"d.load(); {SUB} {LATER}", ""),
    "a callback sets it between turns": (f"d.load(); {SUB} while (ros::ok()) {{ ros::spinOnce(); d.use(); }}", ""),
    "a callback that may run": (f"d.load(); {SUB} ros::AsyncSpinner a(2); a.start(); d.use();", ""),
    "a callback that may have run": (f"{SUB} ros::AsyncSpinner a(2); a.start(); d.load(); d.use();", ""),
    "a thread that runs before": ("std::thread t(&D::run, &d); d.load(); d.use();", ""),
    "a thread that runs by then": ("d.load(); std::thread t(&D::run, &d); d.use();", ""),
    "a thread of a function": ("d.load(); std::thread t([&d]() { d.run(); }); d.use();", ""),
    "a thread on some ways": ("d.load(); if (std::rand()) std::thread t(&D::run, &d); d.use();", ""),
    "something that is not known runs it": ("d.load(); post(std::bind(&D::run, &d)); d.use();", ""),
    "on one of two ways": ("if (std::rand()) d.load(); else d.more(); d.use();", ""),
    "one that returns early": ("d.set(std::rand()); d.lamp(); d.use();", "flag"),
}


@pytest.mark.parametrize(("body", "expected"), [*KNOWN.values(), *QUIET.values()], ids=[*KNOWN, *QUIET])
def test_in_main(body: str, expected: str) -> None:
    found = ends(cpp(f"D d(nh), e(nh); {body}", CLASS))
    assert sorted(end.name[1:] for end in found if end.is_ruled_out) == expected.split()
    assert {end.name for end in found} == {"/flag", "/number"}


def test_the_number_is_part_of_a_name() -> None:
    use = 'd.p_ = nh.advertise<std_msgs::String>("n" + std::to_string(d.n_), 1);'
    (one,) = ends(cpp(f"D d(nh); d.load(); {use}", CLASS))
    (other,) = ends(cpp(f"D d(nh); d.load(); {SUB} {use}", CLASS))
    assert one.name == "/n2"
    assert other.name == "/n?" and [unknown.reason for unknown in other.unknowns] == ["D::cb may change it"]


def test_lists_and_texts_stay_as_they_are() -> None:
    given = CLASS.replace("void lamp", "std::vector<std::string> t_{}; void log() { n_ = 1; show(t_); } void lamp")
    use = "for (auto& t : d.t_) d.p_ = nh.advertise<std_msgs::String>(t, 1);"
    found = ends(cpp(f'D d(nh); d.t_ = {{"a", "b"}}; d.log(); {use}', given))
    assert [end.name for end in found] == ["/a", "/b"]


PUT = """
void put(std::string* t, int* n, int k) {
  if (k > 3) { *n = k; } else { *n = k + 1; }
  *n += 1;
  if (t != nullptr) { *t = "b"; }
}
ros::Publisher q;
void tick(const ros::TimerEvent&) { ros::NodeHandle nh; q = nh.advertise<std_msgs::String>("late", 1); }
"""


@pytest.mark.parametrize("before", ["", "put(nullptr, &n, 1);", "put(nullptr, &n, 1); put(nullptr, &n, 5);"])
def test_a_function_that_sets_a_number_in_one_call_sets_a_text_in_another(before: str) -> None:
    """What a call is followed for is that call's: the text is not known afterwards, and callbacks are registered."""
    found = cpp(
        f'int n = 0; std::string s = "a"; {before} put(&s, &n, 2); ADV(s, 1);'
        " ros::Timer t = nh.createTimer(ros::Duration(1), tick);",
        PUT,
    )
    assert names(found) == ["/?", "/late"]


def test_a_case_of_a_switch_is_the_one() -> None:
    made = "".join(f'case {i}: p_ = nh_.advertise<std_msgs::String>("cam{i}", 1);' for i in (3, 2, 1))
    cameras = CLASS.replace("void lamp", f"void open() {{ switch (n_) {{ {made} }} }} void lamp")
    found = ends(cpp("D d(nh); d.load(); d.open();", cameras))
    assert {end.name: end.is_ruled_out for end in found} == {"/cam3": True, "/cam2": False, "/cam1": False}


MEMBERS = """
void load() { n_ = 2; }
void more() { n_ = 9; }
void use() { if (n_ > 2) create_publisher<String>("number", 1); }
int n_ = 7; rclcpp::TimerBase::SharedPtr t_, u_;"""
TIMER = "t_ = create_wall_timer(1s, [this]() { %s });"
COMPONENT = {
    "in the constructor": ("load(); use();", True),
    "a timer uses it": ("load(); " + TIMER % "use();", True),
    "a timer sets it before": ("load(); " + TIMER % "load(); use();", False),
    "a timer sets it after": ("load(); " + TIMER % "use(); more();", False),
    "another timer sets it": ("load(); " + TIMER % "use();" + TIMER.replace("t_", "u_") % "more();", False),
    "set while a timer may set it": (TIMER % "more();" + " load(); use();", False),
}


@pytest.mark.parametrize(("body", "expected"), COMPONENT.values(), ids=COMPONENT)
def test_in_a_component(body: str, expected: bool) -> None:
    (end,) = explicit(component(body, MEMBERS))
    assert end.is_ruled_out == expected


START = "import threading\nself.n = 7\n"
LOAD = "def load(self):\n    self.n = 2\ndef more(self):\n    self.n = 9\ndef count(self):\n    self.n += 1\n"
USE = "if self.n > 2: self.create_publisher(String, 'number', 1)"
PYTHON = {
    "in the constructor": ("self.load()\n" + USE, "", True),
    "a callback uses it": (
        "self.load()\nself.create_subscription(String, 'x', self.cb, 1)",
        f"def cb(self, m):\n    {USE}",
        True,
    ),
    "a callback sets it by a method": (
        "self.load()\nself.create_subscription(String, 'x', self.cb, 1)",
        f"def cb(self, m):\n    {USE}\n    self.more()",
        False,
    ),
    "a callback counts it by a method": (
        "self.load()\nself.create_timer(1.0, self.cb)",
        f"def cb(self):\n    self.count()\n    {USE}",
        False,
    ),
    "another callback sets it": (
        "self.load()\nself.create_timer(1.0, self.more)\nself.create_timer(1.0, self.cb)",
        f"def cb(self):\n    {USE}",
        False,
    ),
    "a thread sets it": ("self.load()\nthreading.Thread(target=self.more).start()\n" + USE, "", False),
    "a thread of its own class": (
        "self.load()\nT(self).start()\n" + USE,
        "",
        False,
    ),
    "counted in a loop": ("self.load()\nwhile rclpy.ok():\n    self.count()\n    " + USE, "", False),
    "set on some ways": ("if input():\n    self.load()\n" + USE, "", False),
    "set after the use": (USE + "\nself.load()", "", False),
}
THREAD = (
    "import threading\nclass T(threading.Thread):\n    def __init__(self, o):\n        super().__init__()\n"
    "        self.o = o\n    def run(self):\n        self.o.n = 9\n"
)


@pytest.mark.parametrize(("body", "methods", "expected"), PYTHON.values(), ids=PYTHON)
def test_in_python(body: str, methods: str, expected: bool) -> None:
    (end,) = explicit(node(START + body, LOAD + methods, THREAD))
    assert end.is_ruled_out == expected
