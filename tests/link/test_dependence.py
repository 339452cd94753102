# SPDX-License-Identifier: Apache-2.0
"""Which inputs of a node cause which outputs: what is found, what is not there, and what is not known."""

from __future__ import annotations

import pytest
from dependence_kit import of_class, python

DIRECT, COUNT, MESSAGE = "direct", "state count_", "state m_"
#: What the callbacks do, and all that is said of /out.
CPP = {
    "its callback publishes": ("@one pub_.publish(m);", {"/one": DIRECT}),
    "a function that it calls does": ("@one send();", {"/one": DIRECT, }),
    "two callbacks": ("@one pub_.publish(m); @two pub_.publish(m);", {"/one": DIRECT, "/two": DIRECT}),
    "a timer": ("@tick pub_.publish(std_msgs::String());", {"timer": DIRECT}),
    "a timer sends what came": ("@one m_ = m; @tick send();", {"timer": DIRECT, "/one": MESSAGE}),
    "a part of what came": ("@one m_.data = m.data; @tick send();", {"timer": DIRECT, "/one": MESSAGE}),
    "a flag decides": ("@one ready_ = true; @tick if (ready_) pub_.publish(std_msgs::String());",
                       {"timer": DIRECT, "/one": "state ready_"}),
    "a flag lets it return": ("@one ready_ = true; @tick if (!ready_) return; std_msgs::String s; pub_.publish(s);",
                              {"timer": DIRECT, "/one": "state ready_"}),
    "a number is counted": ("@one ++count_; @tick std_msgs::String s; s.data = std::to_string(count_); pub_.publish(s);",
                            {"timer": DIRECT, "/one": COUNT}),
    "through a local": ("@one ++count_; @tick int n = count_ + 1; std_msgs::String s; fill(s, n); pub_.publish(s);",
                        {"timer": DIRECT, "/one": COUNT}),
    "over two members": ("@one count_ = 1; @two if (count_) m_ = m; @tick send();",
                         {"timer": DIRECT, "/two": MESSAGE, "/one": "state count_, m_"}),
    "a callback stops the timer": ("@one timer_.stop(); @tick send();", {"timer": DIRECT, "/one": "state timer_"}),
    "one member alone": ("@one count_ = 1; @two m_ = m; @tick send();", {"timer": DIRECT, "/two": MESSAGE}),
    "what is written and never read": ("@one count_ = 1; @tick send();", {"timer": DIRECT}),
    "what decides on something else": ("@one ready_ = true; @tick if (ready_) count_ = 3; send();", {"timer": DIRECT}),
    "a local of the same name": ("@one int count_ = 1; count_++; @tick std_msgs::String s; fill(s, this->count_); pub_.publish(s);",
                                 {"timer": DIRECT}),
    "a log": ('@one ROS_INFO("%d", count_); @tick send();', {"timer": DIRECT}),
    "what a function logs": ('@one count_ = 1; @tick look(); send();', {"timer": DIRECT}),
    "a function decides that logs": ("@one count_ = 1; @tick if (told()) send();", {"timer": DIRECT}),
    "a function decides": ("@one count_ = 1; @tick if (asked()) send();", {"timer": DIRECT, "/one": COUNT}),
    "a function sets it": ("@one count_ = 1; @tick begin(); send();", {"timer": DIRECT}),
    "a function sets and decides": ("@one count_ = 1; @tick if (begin()) send();", {"timer": DIRECT}),
    "a number is shifted": ("@one int n = 4; n = n >> count_; @tick if (count_) send();", {"timer": DIRECT}),
    "taken out of a stream": ("@one std::stringstream s; s >> count_; @tick if (count_) send();", {"timer": DIRECT, "/one": COUNT}),
    "a loop around it": ("@one count_ = 2; @tick for (int i = 0; i < count_; ++i) send();", {"timer": DIRECT, "/one": COUNT}),
    "an unknown library changes it": ("@one mix(m_); @tick send();", {"timer": DIRECT, "/one": "? state m_"}),
    "a method of a container": ("@one m_.data.append(m.data); @tick send();", {"timer": DIRECT, "/one": MESSAGE}),
    "a method that only looks": ("@one if (m_.data.size() > 3) count_ = 1; @tick send();", {"timer": DIRECT}),
    "an alias": ("@one auto& s = m_; s.data = m.data; @tick send();", {"timer": DIRECT, "/one": MESSAGE}),
    "a copy": ("@one auto s = m_; s.data = m.data; @tick send();", {"timer": DIRECT}),
}  # fmt: skip

METHODS = """void look() { ROS_INFO("%d", count_); }
bool told() { ROS_WARN_STREAM_COND(!count_, "so many"); return true; }
bool begin() { count_ = 0; return true; }
bool asked() { return count_ > 0; }"""


@pytest.mark.parametrize("case", CPP)
def test_callbacks_of_a_class_cause_what_they_send_or_decide_on(case: str) -> None:
    callbacks, expected = CPP[case]
    assert of_class(callbacks, METHODS) == expected


def test_a_callback_is_not_run_where_it_is_registered() -> None:
    more = "other_ = nh.createTimer(ros::Duration(made(period_)), &A::often, this);"
    members = (
        "void often(const ros::TimerEvent&) { if (count_ > period_) count_ = 0; } double period_; ros::Timer other_;"
    )
    found = of_class("@one count_ = 1; @tick if (period_ > 3) send();", members, more)
    assert "/one" not in found and found["timer"] == DIRECT


HELPER = "struct H { int n = 0; int m = 0; void put(int v) { n = v; } int get() const { return n; } int other() { return m; } };"
OBJECTS = {
    "an object keeps it": ("@one h_.put(1); @tick if (h_.get()) send();", "state n"),
    "another member of it": ("@one h_.put(1); @tick if (h_.other()) send();", None),
    "a member of it is set": ("@one h_.n = 3; @tick if (h_.get()) send();", "state n"),
    "an object of a library": ("@one q_.turn(1); @tick if (q_.angle()) send();", "? state q_"),
    "given by reference": ("@one mend(count_); @tick if (count_) send();", "state count_"),
    "given by value": ("@one look(count_); @tick if (count_) send();", None),
    "by a pointer": ("@one H* p = &h_; p->n = 4; @tick if (h_.get()) send();", "state n"),
}
FREE = HELPER + " inline void mend(int& c) { c = 1; } inline void look(int c) { c = 1; }"


@pytest.mark.parametrize("case", OBJECTS)
def test_state_in_objects_counts(case: str) -> None:
    callbacks, expected = OBJECTS[case]
    found = of_class(callbacks, "H h_; lib::Quaternion q_;", before=FREE)
    assert found.get("/one") == expected and found["timer"] == DIRECT


UNSEEN = {
    "another class has it": ("@tick send();", "std::shared_ptr<int> p_;", "keep_ = std::make_shared<K>(p_);", None),
    "the publisher is given away": ("@tick send();", "", "use(pub_);", "to others"),
    "a function of it is given away": ("@tick send();", "", "hand(&A::send);", "gives it to others"),
}


@pytest.mark.parametrize("case", UNSEEN)
def test_what_is_not_seen_has_its_reason(case: str) -> None:
    callbacks, members, more, reason = UNSEEN[case]
    found = of_class(callbacks, members, more)
    assert (reason is None and "more" not in found) or (reason is not None and reason in found["more"])


FILES = {
    "a variable of the file": (
        "int ready = 0;\nvoid got(const std_msgs::String& m) { ready = 1; }",
        "if (ready) p.publish(s);",
    ),
    "a function that sends": ("ros::Publisher p;\nvoid got(const std_msgs::String& m) { p.publish(m); }", None),
}


@pytest.mark.parametrize("case", FILES)
def test_programs_without_a_class(case: str) -> None:
    from dependence_kit import cpp, said

    before, loop = FILES[case]
    if loop is None:
        body = 'p = ADV("/out", 1); ros::Subscriber sub = SUB("/one", 1, got);'
    else:
        body = 'ros::Publisher p = ADV("/out", 1); ros::Subscriber sub = SUB("/one", 1, got); std_msgs::String s;'
        body += f" while (ros::ok()) {{ {loop} ros::spinOnce(); }}"
    out = cpp(body, before)["/out"]
    assert said(out) == {"/one": "direct" if loop is None else "state ready"}
    assert out.is_start is (loop is not None)


PYTHON = {
    "its callback publishes": ("self.pub.publish(m)", "pass", {"/one": "direct"}),
    "a timer sends what came": ("self.last = m", "self.pub.publish(self.last)", {"timer": "direct", "/one": "state last"}),
    "in a list": ("self.all.append(m)", "self.pub.publish(self.all[0])", {"timer": "direct", "/one": "state all"}),
    "a flag": ("self.ready = True", "if not self.ready:\n      return\n    self.pub.publish(String())",
               {"timer": "direct", "/one": "state ready"}),
    "another attribute": ("self.seen = True", "self.pub.publish(String())", {"timer": "direct"}),
    "an attribute of an attribute": ("self.last.data = m.data", "self.pub.publish(self.last)",
                                     {"timer": "direct", "/one": "state last"}),
    "a local that is it": ("x = self.last\n    x.data = m.data", "self.pub.publish(self.last)",
                           {"timer": "direct", "/one": "state last"}),
    "a log": ("rospy.loginfo(self.last)", "self.pub.publish(self.last)", {"timer": "direct"}),
    "a property": ("self.last = m", "if self.known:\n      self.pub.publish(String())", {"timer": "direct", "/one": "state last"}),
    "a function that is handed on": ("self.last = m", "self.pub.publish(max([1, 2], key=self.cost))",
                                     {"timer": "direct", "/one": "state last"}),
    "a property of something else": ("self.seen = m", "if self.known:\n      self.pub.publish(String())", {"timer": "direct"}),
    "a library": ("stir(self.last)", "self.pub.publish(self.last)", {"timer": "direct", "/one": "? state last"}),
}  # fmt: skip


@pytest.mark.parametrize("case", PYTHON)
def test_python(case: str) -> None:
    from dependence_kit import said

    got, tick, expected = PYTHON[case]
    body = f"""class A:
  def __init__(self):
    self.last = String()
    self.all = []
    self.ready = False
    self.pub = rospy.Publisher("/out", String, queue_size=1)
    self.sub = rospy.Subscriber("/one", String, self.got)
    self.timer = rospy.Timer(rospy.Duration(1), self.tick)
  @property
  def known(self):
    return self.last is not None
  def cost(self, n):
    return self.last.data
  def got(self, m):
    {got}
  def tick(self, event):
    {tick}
a = A()
rospy.spin()
"""
    assert said(python(body)["/out"]) == expected


FILTERS = {
    "a synchronizer": "self.both = message_filters.TimeSynchronizer([self.one, self.two], 10)\n    "
    "self.both.registerCallback(self.got)",
    "the subscriber itself": "self.one.registerCallback(self.got)\n    self.two.registerCallback(self.got)",
    "behind a cache": "self.cache = message_filters.Cache(self.one)\n    "
    "self.both = message_filters.TimeSynchronizer([self.cache, self.two], 10)\n    self.both.registerCallback(self.got)",
}


@pytest.mark.parametrize("case", FILTERS)
def test_filters_pass_messages_on(case: str) -> None:
    from dependence_kit import said

    body = f"""import message_filters
class A:
  def __init__(self):
    self.pub = rospy.Publisher("/out", String, queue_size=1)
    self.one = message_filters.Subscriber("/one", String)
    self.two = message_filters.Subscriber("/two", String)
    {FILTERS[case]}
  def got(self, *messages):
    self.pub.publish(String())
a = A()
rospy.spin()
"""
    assert said(python(body)["/out"]) == {"/one": "direct", "/two": "direct"}


def test_filters_of_cpp_pass_messages_on() -> None:
    from dependence_kit import cpp, said

    before = """#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
struct A {
  message_filters::Subscriber<std_msgs::String> one_, two_;
  message_filters::TimeSynchronizer<std_msgs::String, std_msgs::String> both_;
  ros::Publisher pub_;
  A(ros::NodeHandle& nh) : one_(nh, "/one", 1), two_(nh, "/two", 1), both_(one_, two_, 10) {
    pub_ = ADV("/out", 1);
    both_.registerCallback(boost::bind(&A::got, this, _1, _2));
  }
  void got(const std_msgs::StringConstPtr& m, const std_msgs::StringConstPtr& n) { pub_.publish(m); }
};"""
    assert said(cpp("A a(nh);", before)["/out"]) == {"/one": "direct", "/two": "direct"}


def test_a_method_that_overrides_one_may_run_where_that_is_called() -> None:
    from dependence_kit import cpp, said

    before = """struct B {
  virtual void send() {}
  void one(const std_msgs::String& m) { send(); }
  ros::Subscriber sub_;
};
struct A : B {
  A(ros::NodeHandle& nh) { pub_ = ADV("/out", 1); sub_ = SUB("/one", 1, &B::one, this); }
  void send() override { pub_.publish(std_msgs::String()); }
  ros::Publisher pub_;
};"""
    assert said(cpp("A a(nh);", before)["/out"]) == {"/one": "? direct"}


def test_an_attribute_that_is_set_by_its_name_may_be_any() -> None:
    from dependence_kit import said

    body = """class A:
  def __init__(self):
    self.last = String()
    self.pub = rospy.Publisher("/out", String, queue_size=1)
    self.sub = rospy.Subscriber("/one", String, self.got)
    self.timer = rospy.Timer(rospy.Duration(1), self.tick)
  def got(self, m):
    setattr(self, m.data, m)
  def tick(self, event):
    self.pub.publish(self.last)
a = A()
rospy.spin()
"""
    found = said(python(body)["/out"])
    assert found["timer"] == "direct" and "by their names" in found["more"]
