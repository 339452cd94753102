# SPDX-License-Identifier: Apache-2.0
"""Rates that are made where the interpreter does not come by: in what a goal begins, of parameters, members and what functions are given."""

from __future__ import annotations

import pytest
from rates_kit import ROS2_CMAKE, by_topic, cpp

ROS2 = """#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>
#include <std_msgs/msg/string.hpp>
#include <p/action/go.hpp>
struct Settings { double hertz; int turns; };
class Paced : public rclcpp::Rate {
 public:
  template<typename T> explicit Paced(T node, double hertz) : rclcpp::Rate(hertz, node->get_clock()) {}
};
class A : public rclcpp::Node {
 public:
  A() : Node("a") {
    pub_ = create_publisher<std_msgs::msg::String>("out", 1);
    server_ = rclcpp_action::create_server<p::action::Go>(this, "go", &A::asked, &A::left, &A::go);
    %s
  }
 private:
  void go(std::shared_ptr<rclcpp_action::ServerGoalHandle<p::action::Go>> goal) { %s }
  %s
  std_msgs::msg::String m_;
  Settings s_;
  rclcpp_action::Server<p::action::Go>::SharedPtr server_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<A>());
}
"""
LOOP = "while (rclcpp::ok()) { pub_->publish(m_); r.sleep(); }"
READ = 'hertz_ = declare_parameter("hertz", 20.0);'


def rate(constructor: str, goal: str, members: str = "double hertz_;") -> str:
    text = ROS2 % (constructor, goal, members)
    return by_topic({"p/CMakeLists.txt": ROS2_CMAKE, "p/src/main.cpp": text}, 2)["/out"]


FIRES = {
    "a member": (READ, "rclcpp::Rate r(hertz_); " + LOOP, "0 to 20 Hz"),
    "a member that is read into": (
        'declare_parameter("hertz", 20.0); get_parameter("hertz", hertz_);',
        "rclcpp::Rate r(hertz_); " + LOOP,
        "0 to 20 Hz",
    ),
    "a local": ("", 'auto f = declare_parameter<double>("f", 5.0); rclcpp::WallRate r(f); ' + LOOP, "0 to 5 Hz"),
    "a member of a member": (
        's_.hertz = declare_parameter("hertz", 20.0);',
        "rclcpp::Rate r(s_.hertz); " + LOOP,
        "0 to 20 Hz",
    ),
    "one of two": (READ + " if (f()) hertz_ = 30.0;", "rclcpp::Rate r(hertz_); " + LOOP, "0 to 30 Hz"),
    "one part of it": (READ, "rclcpp::Rate r(1.0 / hertz_); " + LOOP, "0 to 0.05 Hz"),
    "a class that is a rate": (READ, "Paced r(this, hertz_); " + LOOP, "0 to 20 Hz"),
}
QUIET = {
    "computed from itself": (READ + " hertz_ *= 2.0;", "rclcpp::Rate r(hertz_); " + LOOP),
    "a function may change it": (READ + " change(hertz_);", "rclcpp::Rate r(hertz_); " + LOOP),
    "what a function returns": ("hertz_ = fastest();", "rclcpp::Rate r(hertz_); " + LOOP),
    "a whole number of it": ("", "int n = 7; rclcpp::Rate r(20 / n); " + LOOP),
    "a parameter that is not declared": (
        'hertz_ = get_parameter("other").as_double();',
        "rclcpp::Rate r(hertz_); " + LOOP,
    ),
    "no value": ('hertz_ = declare_parameter<double>("hertz");', "rclcpp::Rate r(hertz_); " + LOOP),
    "zero": ('hertz_ = declare_parameter("hertz", 0.0);', "rclcpp::Rate r(hertz_); " + LOOP),
    "its address": (READ + " keep(&hertz_);", "rclcpp::Rate r(hertz_); " + LOOP),
    "what the goal says": ("", "rclcpp::Rate r(goal->get_goal()->hertz); " + LOOP),
}


@pytest.mark.parametrize("name", FIRES)
def test_a_rate_where_nothing_is_made_is_that_of_its_number(name: str) -> None:
    constructor, goal, expected = FIRES[name]
    assert rate(constructor, goal) == expected


@pytest.mark.parametrize("name", QUIET)
def test_it_stays_unknown_for_a_reason(name: str) -> None:
    constructor, goal = QUIET[name]
    assert rate(constructor, goal).startswith("unknown (")


def test_what_callers_give_a_function() -> None:
    members = "void run(double f) { rclcpp::Rate r(f); " + LOOP + " }"
    assert rate("", "run(8.0); run(4.0);", members) == "0 to 8 Hz"


def test_what_is_set_again_while_it_runs_begins_with_the_parameter() -> None:
    callback = "add_on_set_parameters_callback([this](const std::vector<rclcpp::Parameter> & every) {"
    again = callback + " for (auto & one : every) { hertz_ = one.as_double(); } return result(); });"
    assert rate(READ + again, "rclcpp::Rate r(hertz_); " + LOOP) == "0 to 20 Hz"


def test_a_class_that_a_using_declaration_names() -> None:
    before = """namespace b { struct A {
  A(ros::NodeHandle& nh); void tick(const ros::TimerEvent&); ros::Publisher pub_; ros::Timer timer_;
}; }
using b::A;
A::A(ros::NodeHandle& nh) {
  pub_ = ADV("a", 1);
  timer_ = nh.createTimer(ros::Duration(0.5), &A::tick, this);
}
void A::tick(const ros::TimerEvent&) { std_msgs::String m; pub_.publish(m); }
"""
    assert cpp("A a(nh);", before)["/a"] == "2 Hz"


TIMERS = {
    "a literal": ("timer_ = create_wall_timer(500ms, [this]() { pub_->publish(m_); });", "0 to 2 Hz"),
    "a duration of a member": (
        "timer_ = create_wall_timer(std::chrono::duration<double>(1.0 / hertz_), [this]() { pub_->publish(m_); });",
        "0 to 20 Hz",
    ),
    "the period of a rate": (
        "const auto p = rclcpp::Rate(hertz_).period(); timer_ = rclcpp::create_timer(this, get_clock(), p, [this]() { pub_->publish(m_); });",
        "0 to 20 Hz",
    ),
}
NO_TIMERS = (
    "auto t = create_wall_timer(500ms, [this]() { pub_->publish(m_); }); keep(t);",
    "timer_ = create_wall_timer(std::chrono::milliseconds(count()), [this]() { pub_->publish(m_); });",
)


@pytest.mark.parametrize("name", TIMERS)
def test_a_timer_that_a_goal_makes(name: str) -> None:
    goal, expected = TIMERS[name]
    members = "double hertz_; rclcpp::TimerBase::SharedPtr timer_;"
    assert rate(READ, goal, members) == expected


@pytest.mark.parametrize("goal", NO_TIMERS)
def test_a_timer_that_may_be_one_of_several_or_whose_period_is_computed_stays_unknown(goal: str) -> None:
    assert rate(READ, goal, "double hertz_; rclcpp::TimerBase::SharedPtr timer_;").startswith("unknown (")


def test_what_a_thread_is_given_through_a_bind() -> None:
    members = (
        "double hertz_; std::unique_ptr<std::thread> thread_; void run(double f) { rclcpp::Rate r(f); " + LOOP + " }"
    )
    goal = "thread_ = std::make_unique<std::thread>(std::bind(&A::run, this, hertz_));"
    assert rate(READ, goal, members) == "0 to 20 Hz"


LOOKS = "template<typename T> void look(T p) { if (p->get_subscription_count() > 0) count(p->get_topic_name()); }"


def test_a_publisher_that_a_function_only_looks_at() -> None:
    goal = "rclcpp::Rate r(hertz_); while (rclcpp::ok()) { pub_->publish(m_); look(pub_); r.sleep(); }"
    assert rate(READ, goal, "double hertz_; " + LOOKS) == "0 to 20 Hz"


@pytest.mark.parametrize("body", ["p->publish(m_);", "other(p);", "auto q = p; q->publish(m_);", "p_ = p;"])
def test_a_publisher_that_a_function_may_use_stays_unknown(body: str) -> None:
    goal = "rclcpp::Rate r(hertz_); while (rclcpp::ok()) { pub_->publish(m_); look(pub_); r.sleep(); }"
    assert "unknown (" in rate(READ, goal, "double hertz_; template<typename T> void look(T p) { " + body + " }")


def test_a_plain_call_in_another_class_is_no_call_of_a_method() -> None:
    other = "struct B { virtual void go_on(int n) = 0; void all() { go_on(1); } };\n"
    members = "double hertz_; void go_on() { pub_->publish(m_); }"
    goal = "rclcpp::Rate r(hertz_); while (rclcpp::ok()) { go_on(); r.sleep(); }"
    text = ROS2.replace("class A :", other + "class A :") % (READ, goal, members)
    found = by_topic({"p/CMakeLists.txt": ROS2_CMAKE, "p/src/main.cpp": text}, 2)["/out"]
    assert found == "0 to 20 Hz"


def test_what_filters_pass_on_comes_at_most_as_often_as_their_topic() -> None:
    before = """#include <message_filters/subscriber.h>
#include <message_filters/synchronizer.h>
struct A {
  A(ros::NodeHandle& nh) : one_(nh, "b", 1), two_(nh, "b", 1), sync_(one_, two_, 10) {
    pub_ = ADV("a", 1); in_ = ADV("b", 1);
    sync_.registerCallback(boost::bind(&A::got, this, _1, _2));
    timer_ = nh.createTimer(ros::Duration(0.5), &A::tick, this);
  }
  void tick(const ros::TimerEvent&) { std_msgs::String m; in_.publish(m); }
  void got(const std_msgs::StringConstPtr& a, const std_msgs::StringConstPtr& b) { pub_.publish(*a); }
  message_filters::Subscriber<std_msgs::String> one_, two_;
  message_filters::TimeSynchronizer<std_msgs::String, std_msgs::String> sync_;
  ros::Publisher pub_, in_; ros::Timer timer_;
};"""
    assert cpp("A a(nh); ros::spin();", before)["/a"] == "0 to 2 Hz"
