# SPDX-License-Identifier: Apache-2.0
"""How often nodes publish: what is known, and what is not, with its reason."""

from __future__ import annotations

import json

import pytest
from follow_kit import cpp_files, main, python_files, script
from rates_kit import architecture, by_topic, cpp, python, rates, ros2

from haros_ci.model.architecture import Endpoint
from haros_ci.model.location import Location
from haros_ci.rates.publishers import without_code
from haros_ci.report import model_json, model_text

LOOP = 'ros::Publisher p = ADV("a", 1);\n%s\n'
CLASS = """struct A {
  A(ros::NodeHandle& nh) {
    pub_ = ADV("a", 1);
    %s
  }
  %s
  void got(const std_msgs::String& m) { %s }
  void send() { std_msgs::String m; pub_.publish(m); }
  ros::Publisher pub_; ros::Timer timer_; ros::Subscriber sub_;
};"""
PARAMETER = 'double f; ros::NodeHandle("~").param("f", f, 20.0); '
LAUNCH = '<launch><arg name="f" default="40.0"/><node pkg="p" type="n" name="n"><param name="f" value="$(arg f)"/></node></launch>'


def of_class(constructor: str, callback: str = "", launch: str = "", body: str = "A a(nh);") -> str:
    tick = "void tick(const ros::TimerEvent&) { send(); }" if "tick" in constructor else ""
    return cpp(body, CLASS % (constructor, tick, callback), launch)["/a"]


LOOPS = {
    "a rate": ("ros::Rate r(10); while (ros::ok()) { p.publish(m); r.sleep(); }", "10 Hz"),
    "a wall rate": ("ros::WallRate r(10); while (ros::ok()) { p.publish(m); r.sleep(); }", "10 Hz"),
    "a rate of a duration": ("ros::Rate r(ros::Duration(0.5)); while (ros::ok()) { p.publish(m); r.sleep(); }", "2 Hz"),
    "a constant": ("const int f = 25; ros::Rate r(f); while (nh.ok()) { p.publish(m); r.sleep(); }", "25 Hz"),
    "twice a turn": ("ros::Rate r(10); while (ros::ok()) { p.publish(m); p.publish(m); r.sleep(); }", "20 Hz"),
    "sometimes": ("ros::Rate r(10); while (ros::ok()) { if (f()) p.publish(m); r.sleep(); }", "0 to 10 Hz"),
    "a loop that may end": ("ros::Rate r(10); while (ros::ok() && f()) { p.publish(m); r.sleep(); }", "0 to 10 Hz"),
    "a loop that is left": (
        "ros::Rate r(10); while (ros::ok()) { p.publish(m); if (f()) break; r.sleep(); }",
        "0 to 10 Hz",
    ),
    "another sleep": ("ros::Rate r(10); while (ros::ok()) { p.publish(m); usleep(5); r.sleep(); }", "0 to 10 Hz"),
    "behind a way out": (
        "ros::Rate r(10); if (f()) return 1; while (ros::ok()) { p.publish(m); r.sleep(); }",
        "0 to 10 Hz",
    ),
    "once": ("p.publish(m);", "0 Hz"),
    "the sleep in a condition": ("ros::Rate r(10); while (ros::ok()) { p.publish(m); if (!r.sleep()) f(); }", "10 Hz"),
    "a way back before it": (
        "ros::Rate r(10); while (ros::ok()) { if (f()) { r.sleep(); continue; } p.publish(m); r.sleep(); }",
        "0 to 10 Hz",
    ),
    "a sleep of chrono": (
        "while (ros::ok()) { p.publish(m); std::this_thread::sleep_for(std::chrono::milliseconds(50)); }",
        "0 to 20 Hz",
    ),
    "a duration's sleep": ("while (ros::ok()) { p.publish(m); ros::Duration(0.5).sleep(); }", "0 to 2 Hz"),
    "a rate for one turn": ("while (ros::ok()) { p.publish(m); ros::Rate(5).sleep(); }", "0 to 5 Hz"),
    "two sleeps": ("while (ros::ok()) { p.publish(m); usleep(1000); usleep(100000); }", "0 to 10 Hz"),
    "a counted loop": ("for (int i = 0; i < 3; ++i) p.publish(m);", "0 Hz"),
    "a counted loop in each turn": (
        "ros::Rate r(10); while (ros::ok()) { for (int i = 0; i < 3; ++i) p.publish(m); r.sleep(); }",
        "30 Hz",
    ),
    "items that are written out": (
        "ros::Rate r(10); while (ros::ok()) { for (int x : {1, 2}) p.publish(m); r.sleep(); }",
        "20 Hz",
    ),
    "a counted loop that is left": (
        "ros::Rate r(10); while (ros::ok()) { for (int i = 0; i < 3; ++i) { if (f()) break; p.publish(m); } r.sleep(); }",
        "0 to 30 Hz",
    ),
}
UNKNOWN_LOOPS = {
    "a sleep that is not known": ("while (ros::ok()) { p.publish(m); usleep(f()); }", "without a rate"),
    "a sleep of nothing": ("while (ros::ok()) { p.publish(m); usleep(0); }", "without a rate"),
    "a sleep in some turns of chrono": ("while (ros::ok()) { p.publish(m); if (f()) usleep(1000); }", "without a rate"),
    "a counter that is set": (
        "ros::Rate r(9); while (ros::ok()) { for (int i = 0; i < 3; ++i) { i = 0; p.publish(m); } r.sleep(); }", "length"
    ),
    "a counter that is given": (
        "ros::Rate r(9); while (ros::ok()) { for (int i = 0; i < 3; ++i) { f(&i); p.publish(m); } r.sleep(); }", "length"
    ),
    "as many turns as a variable says": (
        "ros::Rate r(9); while (ros::ok()) { for (int i = 0; i < n; ++i) p.publish(m); r.sleep(); }", "length"
    ),
    "a loop in the test of which it is": ("while (f(p.publish(m))) {}", "length"),
    "no rate": ("while (ros::ok()) { p.publish(m); ros::spinOnce(); }", "without a rate"),
    "another loop in it": ("ros::Rate r(10); while (ros::ok()) { for (;f();) p.publish(m); r.sleep(); }", "unknown length"),
    "a list": ("ros::Rate r(10); while (ros::ok()) { for (auto x : xs) p.publish(m); r.sleep(); }", "unknown length"),
    "a sleep in some turns": ("ros::Rate r(10); while (ros::ok()) { p.publish(m); if (f()) r.sleep(); }", "without a rate"),
    "a turn without the sleep": (
        "ros::Rate r(10); while (ros::ok()) { p.publish(m); if (f()) continue; r.sleep(); }", "without the sleep"
    ),
    "a rate that is not known": ("ros::Rate r(g()); while (ros::ok()) { p.publish(m); r.sleep(); }", "not known"),
    "a rate of zero": ("ros::Rate r(0); while (ros::ok()) { p.publish(m); r.sleep(); }", "not greater than zero"),
    "a negative rate": ("ros::Rate r(-5); while (ros::ok()) { p.publish(m); r.sleep(); }", "not greater than zero"),
    "a rate that is set again": (
        "ros::Rate r(10); r = ros::Rate(g()); while (ros::ok()) { p.publish(m); r.sleep(); }", "not seen where the rate"
    ),
    "a publisher that others get": ("use(p); ros::Rate r(10); while (ros::ok()) { p.publish(m); r.sleep(); }", "to others"),
    "a publisher that is never used": ("", "no call is seen"),
    "a rate that is given": ("ros::Rate r(10); ros::Rate& q = pick(r); while (ros::ok()) { p.publish(m); q.sleep(); }", "not"),
}  # fmt: skip


@pytest.mark.parametrize("case", LOOPS)
def test_a_loop_has_the_rate_that_it_sleeps_with(case: str) -> None:
    body, expected = LOOPS[case]
    assert cpp(LOOP % ("std_msgs::String m; " + body))["/a"] == expected


@pytest.mark.parametrize("case", UNKNOWN_LOOPS)
def test_a_loop_whose_rate_is_not_seen_is_unknown_with_its_reason(case: str) -> None:
    body, reason = UNKNOWN_LOOPS[case]
    found = cpp(LOOP % ("std_msgs::String m; " + body))["/a"]
    assert found.startswith(("unknown", "at least")) and reason in found


TIMERS = {
    "a timer": ("timer_ = nh.createTimer(ros::Duration(0.1), &A::tick, this);", "10 Hz"),
    "a timer of a rate": ("timer_ = nh.createTimer(ros::Rate(30), &A::tick, this);", "30 Hz"),
    "a parameter": (PARAMETER + "timer_ = nh.createTimer(ros::Duration(1.0 / f), &A::tick, this);", "20 Hz"),
    "under a condition": ("if (g()) timer_ = nh.createTimer(ros::Duration(0.1), &A::tick, this);", "0 to 10 Hz"),
}
UNKNOWN_TIMERS = {
    "a period that is not known": ("timer_ = nh.createTimer(ros::Duration(g()), &A::tick, this);", "its period is not known"),
    "a timer for once": ("timer_ = nh.createTimer(ros::Duration(0.1), &A::tick, this, true);", "fires once"),
    "whether it is for once is not known": ("timer_ = nh.createTimer(ros::Duration(1), &A::tick, this, g());", "once"),
    "two ways": ("timer_ = nh.createTimer(ros::Duration(1), &A::tick, this); keep(&A::send);", "gives it to others"),
    "nobody": ("", "not seen who calls it"),
    "a list of timers": (
        "for (int i = 0; i < 2; ++i) ts_[i] = nh.createTimer(ros::Duration(1), &A::tick, this);", ""
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", TIMERS)
def test_a_callback_has_the_rate_of_its_timer(case: str) -> None:
    constructor, expected = TIMERS[case]
    assert of_class(constructor) == expected


@pytest.mark.parametrize("case", UNKNOWN_TIMERS)
def test_a_timer_that_is_not_seen_to_repeat_is_unknown(case: str) -> None:
    constructor, reason = UNKNOWN_TIMERS[case]
    found = of_class(constructor)
    assert found.startswith(("unknown", "0 to")) and reason in found


def test_two_programs_or_objects_of_one_class_are_not_one_timer() -> None:
    timer = "timer_ = nh.createTimer(ros::Duration(0.1), &A::tick, this);"
    assert of_class(timer, body="A a(nh), b(nh);").startswith("unknown (one call makes several timers")


def test_a_launch_argument_is_the_rate() -> None:
    timer = PARAMETER + "timer_ = nh.createTimer(ros::Duration(1.0 / f), &A::tick, this);"
    assert of_class(timer, launch=LAUNCH) == "40 Hz"


INHERITED = {
    "each message": ("send();", "10 Hz"),
    "under a condition": ("if (m.data.empty()) send();", "0 to 10 Hz"),
    "behind a way out": ("if (m.data.empty()) return; send();", "0 to 10 Hz"),
    "twice": ("send(); send();", "20 Hz"),
    "in a loop": ("for (char c : m.data) send();", "unknown (it is in a loop of unknown length)"),
}


@pytest.mark.parametrize("case", INHERITED)
def test_a_callback_inherits_the_rate_of_its_topic(case: str) -> None:
    callback, expected = INHERITED[case]
    loop = 'A a(nh); ros::Publisher p = ADV("in", 1); std_msgs::String m; ros::Rate r(10);'
    loop += " while (ros::ok()) { p.publish(m); ros::spinOnce(); r.sleep(); }"
    assert of_class('sub_ = nh.subscribe("in", 1, &A::got, this);', callback, body=loop) == expected


def test_a_topic_that_nobody_publishes_has_no_rate() -> None:
    found = of_class('sub_ = nh.subscribe("in", 1, &A::got, this);', "send();")
    assert found == "unknown (it comes with messages on /in, which no node of the configuration publishes)"


def test_a_cycle_ends_without_a_bound() -> None:
    timer = "timer_ = nh.createTimer(ros::Duration(0.1), &A::tick, this);"
    found = of_class('sub_ = nh.subscribe("a", 1, &A::got, this);' + timer, "send();")
    assert found.startswith("at least ") and "callbacks publish what calls them again" in found


def test_a_cycle_over_two_topics_has_no_bound_either() -> None:
    body = (
        "a = PUB('a')\nb = PUB('b')\ndef tick(event):\n    a.publish('')\ndef got_a(m):\n    b.publish('')\n"
        "def got_b(m):\n    a.publish('')\nrospy.Subscriber('a', String, got_a)\nrospy.Subscriber('b', String, got_b)\n"
        "rospy.Timer(rospy.Duration(0.1), tick)\nrospy.spin()\n"
    )
    found = python(body)
    assert all("callbacks publish what calls them again" in found[topic] for topic in ("/a", "/b"))


def test_a_cycle_that_nothing_starts_publishes_nothing() -> None:
    assert of_class('sub_ = nh.subscribe("a", 1, &A::got, this);', "send();") == "0 Hz"


RATES_2 = {
    "a literal": ("timer_ = create_wall_timer(100ms, [this]() { pub_->publish(m_); });", "10 Hz"),
    "seconds": ("timer_ = create_wall_timer(std::chrono::seconds(2), std::bind(&A::tick, this));", "0.5 Hz"),
    "a parameter": (
        'int p = declare_parameter("p", 20); timer_ = create_wall_timer(std::chrono::milliseconds(p), std::bind(&A::tick, this));',
        "50 Hz",
    ),
}

CLOCK = "timer_ = rclcpp::create_timer(this, get_clock(), %s, std::bind(&A::tick, this));"
RATES_2 |= {
    "the period of a rate": (CLOCK % "rclcpp::Rate(40.0).period()", "40 Hz"),
    "the period of a rate in a variable": (
        'const auto period = rclcpp::Rate(declare_parameter<double>("hz", 25.0)).period();' + CLOCK % "period", "25 Hz"
    ),
    "a duration of rclcpp": (CLOCK % "rclcpp::Duration::from_seconds(0.2)", "5 Hz"),
    "a duration of seconds": (CLOCK % "std::chrono::duration<double>(0.1)", "10 Hz"),
    "a duration that is cast": (
        CLOCK % "std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(0.02))", "50 Hz"
    ),
    "a duration with a ratio": (CLOCK % "std::chrono::duration<double, std::milli>(20)", "50 Hz"),
    "a duration of another ratio": (
        CLOCK % "std::chrono::duration<double, std::ratio<1, 30>>(1)",
        "unknown (its period is no duration that is known)",
    ),
    "a number is no duration": (CLOCK % "7", "unknown (its period is no duration that is known)"),
    "a function's result": (CLOCK % "choose()", "unknown (its period is no duration that is known)"),
}  # fmt: skip


@pytest.mark.parametrize("case", RATES_2)
def test_wall_timers_of_ros_2(case: str) -> None:
    body, expected = RATES_2[case]
    assert ros2(body) == expected


PYTHON = {
    "a rate": ("p = PUB('a')\nr = rospy.Rate(10)\nwhile not rospy.is_shutdown():\n    p.publish('')\n    r.sleep()\n", "10 Hz"),
    "a function": (
        "def main():\n    p = PUB('a')\n    r = rospy.Rate(5)\n    while not rospy.is_shutdown():\n        p.publish('')\n"
        "        r.sleep()\nif __name__ == '__main__':\n    main()\n",
        "5 Hz",
    ),
    "a timer": (
        "p = PUB('a')\ndef tick(event):\n    p.publish('')\nrospy.Timer(rospy.Duration(0.5), tick)\nrospy.spin()\n", "2 Hz"
    ),
    "a function of the name of a publisher's method": (
        "p = PUB('a')\ndef publish():\n    p.publish('')\nr = rospy.Rate(10)\nwhile not rospy.is_shutdown():\n    publish()\n"
        "    r.sleep()\n",
        "10 Hz",
    ),
    "the same, called through what may be a module": (
        "p = PUB('a')\ndef publish():\n    p.publish('')\ndef other(q):\n    q.publish()\nother(choose())\npublish()\n",
        "unknown (other may call it)",
    ),
    "a timer for once": (
        "p = PUB('a')\ndef tick(event):\n    p.publish('')\nrospy.Timer(rospy.Duration(0.5), tick, oneshot=True)\n",
        "unknown (the timer fires once each time that it is started)",
    ),
    "a sleep": ("import time\np = PUB('a')\nwhile not rospy.is_shutdown():\n    p.publish('')\n    time.sleep(0.1)\n", "0 to 10 Hz"),
    "rospy.sleep": ("p = PUB('a')\nwhile True:\n    p.publish('')\n    rospy.sleep(0.5)\n", "0 to 2 Hz"),
    "a sleep of another library": (
        "import other\np = PUB('a')\nwhile not rospy.is_shutdown():\n    p.publish('')\n    other.sleep(0.1)\n",
        "unknown (it is in a loop without a rate)",
    ),
    "a counted loop": (
        "p = PUB('a')\nr = rospy.Rate(10)\nwhile not rospy.is_shutdown():\n    for i in range(3):\n        p.publish('')\n"
        "    r.sleep()\n",
        "30 Hz",
    ),
    "a thread of a callback": (
        "import threading\np = PUB('a')\ndef work():\n    p.publish('')\ndef got(m):\n"
        "    threading.Thread(target=work).start()\nrospy.Subscriber('in', String, got)\nrospy.spin()\n",
        "unknown (a thread begins with it whenever something else happens)",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", PYTHON)
def test_rospy(case: str) -> None:
    body, expected = PYTHON[case]
    assert python(body)["/a"] == expected


TWO = 'ros::Publisher p = ADV("a", 1), q = ADV("b", 1); std_msgs::String m; ros::Rate r(10); while (ros::ok()) { p.publish(m); r.sleep(); }'


def test_the_model_has_rates_only_where_they_are_asked_for() -> None:
    found = architecture(cpp_files(main(TWO)))
    data = json.loads(model_json.render(found))["configurations"][0]["rates"]
    assert [(one["topic"], one["low"], one["high"]) for one in data["published"]] == [
        ("/a", 10.0, 10.0),
        ("/b", 0.0, None),
    ]
    assert data["published"][1]["reason"] == "no call is seen to publish it"
    assert "/n publishes /a: 10 Hz" in model_text.render(found)


def test_publishers_of_a_topic_add_up() -> None:
    launch = '<launch><node pkg="p" type="n" name="x"/><node pkg="p" type="n" name="y"/></launch>'
    assert {name: str(rate) for name, rate in rates(cpp_files(main(TWO), launch)).topics}["/a"] == "20 Hz"


VIRTUAL = """struct Base { virtual void send() {} };
struct A : Base {
  A(ros::NodeHandle& nh) { pub_ = ADV("a", 1); }
  void send() override { std_msgs::String m; pub_.publish(m); }
  ros::Publisher pub_;
};
struct B { void send() {} };"""
PERHAPS = {
    "a method of the base": ("Base* b = &a; ros::Rate r(10); while (ros::ok()) { b->send(); r.sleep(); }", "0 to 10 Hz"),
    "an object that is not known": ("auto b = pick(a); ros::Rate r(10); while (ros::ok()) { b->send(); r.sleep(); }", "0 to 10 Hz"),
    "both": ("Base* b = &a; ros::Rate r(10); while (ros::ok()) { b->send(); a.send(); r.sleep(); }", "10 to 20 Hz"),
    "another class": ("B b; ros::Rate r(10); while (ros::ok()) { b.send(); a.send(); r.sleep(); }", "10 Hz"),
    "without a bound": ("Base* b = &a; while (ros::ok()) { b->send(); ros::spinOnce(); }", "unknown (it is in a loop without a rate)"),
}  # fmt: skip


@pytest.mark.parametrize("case", PERHAPS)
def test_a_call_that_may_be_of_the_method_bounds_it(case: str) -> None:
    body, expected = PERHAPS[case]
    assert cpp("A a(nh); " + body, VIRTUAL)["/a"] == expected


THREADS = {
    "one that is kept": ("t_ = std::thread(&A::work, this);", "0 to 10 Hz"),
    "one on the heap": ("t_ = std::make_unique<std::thread>(&A::work, this);", "0 to 10 Hz"),
    "one that is detached": ("std::thread t(&A::work, this); t.detach();", "unknown"),
    "one that is detached later": ("t_ = std::thread(&A::work, this); t_.detach();", "unknown"),
    "one of boost, which goes on": ("t_ = boost::thread(&A::work, this);", "unknown"),
}


@pytest.mark.parametrize("case", THREADS)
def test_a_thread_that_a_callback_begins_runs_once_at_a_time_where_it_is_kept(case: str) -> None:
    start, expected = THREADS[case]
    work = "std::thread t_; void work() { ros::Rate r(10); while (ros::ok()) { send(); r.sleep(); } } "
    found = cpp("A a(nh);", CLASS % ('sub_ = nh.subscribe("in", 1, &A::got, this);', work, start))["/a"]
    assert found.startswith(expected)


def test_programs_that_no_file_imports_both_of_are_not_one() -> None:
    files = python_files(script("p = PUB('a')\ndef go():\n    p.publish('')\ngo()\n"))
    other = {"p/src/tool.py": "def check(x):\n    while True:\n        x.go()\n        go()\n"}
    assert by_topic({**files, **other})["/a"] == "0 Hz"


@pytest.mark.parametrize(
    ("source", "location", "reason"),
    [
        ("hint", True, "a hint of the project file says what it is: the code that publishes it is not looked for"),
        ("hint", False, "a hint of the project file says what it is: the code that publishes it is not looked for"),
        ("known-node", False, "no code of the workspace publishes it"),
        ("launch", True, "no code of the workspace publishes it"),
        ("source", False, "no code of the workspace publishes it"),
        ("source", True, ""),
        ("exact-tier", True, ""),
    ],
)
def test_why_no_code_is_looked_for(source: str, location: bool, reason: str) -> None:
    """What a hint names can be published by code of the workspace: that there is none would be wrong."""
    place = Location("a.cpp", 3, 1) if location else None
    end = Endpoint(kind="publisher", name="/a", original_name="/a", type=None, location=place, source=source)
    assert without_code(end, "publishes") == reason
