# SPDX-License-Identifier: Apache-2.0
"""Functions that a C++ program keeps in containers and calls later: which is called there is often not known."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_cpp

from haros_ci.follow.uncalled import KEPT

FUNCTION = "std::function<void()>"
MAKE = '[this]() { pub_ = this->create_publisher<String>("%s", 1); }'
MEMBERS = (
    "rclcpp::Publisher<String>::SharedPtr pub_;\nstd::shared_ptr<std::thread> thread_;\n%s\n"
    "void cb(const String & s) { %s }\n"
    'void make() { pub_ = this->create_publisher<String>("m", 1); }\n'
)
START = (
    "thread_ = std::make_shared<std::thread>([this]() { loop(); });\n"
    'this->create_subscription<String>("s", 1, std::bind(&N::cb, this, std::placeholders::_1));\n%s'
)
LAMBDA = MAKE % "a"


def made(members: str, kept: str, begin: str = "", head: str = "") -> list[tuple[str, bool]]:
    """The publishers of a node with these *members* whose callback does *kept*, and whether each is certain."""
    (found,) = ros2_cpp(START % begin, MEMBERS % (members, kept), head).nodes
    ends = explicit(found)
    return sorted((end.name, KEPT not in [unknown.reason for unknown in end.unknowns]) for end in ends)


#: Members of the class and what the callback does.
FIRES = {
    "a deque of which the first is called": (
        f"std::deque<{FUNCTION}> q_;\nvoid loop() {{ while (!q_.empty()) {{ q_.front()(); q_.pop_front(); }} }}",
        f"q_.push_back({LAMBDA});",
    ),
    "a range of a vector": (
        f"std::deque<{FUNCTION}> q_;\nvoid push(std::vector<{FUNCTION}> v) {{ q_.insert(q_.end(), v.begin(), v.end()); }}\n"
        "void loop() { while (!q_.empty()) { q_.front()(); q_.pop_front(); } }",
        f"push({{{LAMBDA}}});",
    ),
    "a vector": (
        f"std::vector<{FUNCTION}> v_;\nvoid loop() {{ for (auto & f : v_) f(); }}",
        f"v_.push_back({LAMBDA});",
    ),
    "a map": (
        f"std::map<std::string, {FUNCTION}> m_;\nstd::string next();\n"
        "void loop() { auto it = m_.find(next()); if (it != m_.end()) it->second(); }",
        f'm_["x"] = {LAMBDA};',
    ),
}


@pytest.mark.parametrize("name", FIRES)
def test_functions_that_are_kept(name: str) -> None:
    members, kept = FIRES[name]
    assert made(members, kept) == [("/a", False)]


def test_a_bound_method_that_is_kept() -> None:
    members = f"std::vector<{FUNCTION}> v_;\nvoid loop() {{ for (auto & f : v_) f(); }}"
    assert made(members, "v_.push_back(std::bind(&N::make, this));") == [("/m", False)]


def test_a_function_that_is_kept_by_a_function_that_is_kept() -> None:
    inner = LAMBDA.replace("[this]", "[this]", 1)
    members = f"std::deque<{FUNCTION}> q_;\nvoid loop() {{ q_.front()(); q_.pop_front(); }}"
    assert made(members, f"q_.push_back([this]() {{ q_.push_back({inner}); }});") == [("/a", False)]


def test_the_conditions_of_what_is_kept() -> None:
    members = f"std::deque<{FUNCTION}> q_;\nvoid loop() {{ q_.front()(); q_.pop_front(); }}"
    begin = f"if (get_clock()->now().seconds() > 3) q_.push_back({LAMBDA});"
    (found,) = ros2_cpp(START % begin, MEMBERS % (members, "")).nodes
    (end,) = explicit(found)
    assert [condition.statement for condition in end.conditions] == ["if"]


#: What the constructor does with a lambda that makes something, and whether it may be among those that are kept.
CALLED = (
    ("for (int i = 0; i < 0; i++) f();", False),
    ("for (auto & s : std::vector<int>{}) f();", False),
    ("while (false) f();", False),
    ("std::vector<int> v; for (int i : v) { [&] { f(); }(); }", False),
    ("std::vector<int> v; std::for_each(v.begin(), v.end(), f);", True),
    ("for (int i = 0; i < 0; i++) q_.push_back(f);", True),
    ("auto g = f; for (int i = 0; i < 0; i++) g();", True),
    (f"{FUNCTION} h = f; h = nullptr;", True),
)


@pytest.mark.parametrize(("use", "is_kept"), CALLED)
def test_a_lambda_that_is_only_called_is_kept_nowhere(use: str, is_kept: bool) -> None:
    members = f"std::deque<{FUNCTION}> q_;\nvoid loop() {{ q_.front()(); q_.pop_front(); }}"
    assert made(members, "", f"auto f = {LAMBDA}; {use}") == [("/a", False)] * is_kept


#: What is certain, as it is seen to be called or registered.
CERTAIN = {
    "it is called": (f"{FUNCTION} f_;\nvoid loop() {{}}", "", f"f_ = {LAMBDA}; f_();"),
    "a timer": ("rclcpp::TimerBase::SharedPtr t_;\nvoid loop() {}", "", f"t_ = create_wall_timer(1s, {LAMBDA});"),
    "an element that is known": (
        f"std::vector<{FUNCTION}> v_;\nvoid loop() {{}}",
        "",
        f"v_.push_back({LAMBDA}); for (auto & f : v_) f();",
    ),
    "a struct in a list": (
        f"struct Job {{ int n; {FUNCTION} f; }};\nstd::list<Job> q_;\nvoid loop() {{ for (auto & job : q_) job.f(); }}",
        f"q_.push_back(Job{{1, {LAMBDA}}});",
        "",
    ),
    "a variable": ("void loop() {}", "", f"auto f = {LAMBDA}; f();"),
    "an algorithm": (
        "void loop() {}",
        "",
        "std::vector<int> v{1}; std::for_each(v.begin(), v.end(), [this](int) { make_a(); });",
    ),
}


@pytest.mark.parametrize("name", CERTAIN)
def test_functions_that_are_called(name: str) -> None:
    members, kept, begin = CERTAIN[name]
    more = 'void make_a() { pub_ = this->create_publisher<String>("a", 1); }\n'
    assert made(more + members, kept, begin) == [("/a", True)]


def test_a_method_that_is_called_elsewhere_stays_certain() -> None:
    members = f"std::vector<{FUNCTION}> v_;\nvoid loop() {{ for (auto & f : v_) f(); }}"
    assert made(members, "v_.push_back(std::bind(&N::make, this));", "make();") == [("/m", True)]


#: What makes nothing, or is never made itself.
QUIET = {
    "it makes nothing": (
        f"std::deque<{FUNCTION}> q_;\nint n_;\nvoid loop() {{ q_.front()(); }}",
        "q_.push_back([this]() { ++n_; });",
    ),
    "a function that nobody calls": (
        f"std::deque<{FUNCTION}> q_;\nvoid loop() {{}}\nvoid no() {{ q_.push_back({LAMBDA}); }}",
        "",
    ),
    "a method of which no pointer is kept": (f"std::deque<{FUNCTION}> q_;\nvoid loop() {{ q_.front()(); }}", ""),
}


@pytest.mark.parametrize("name", QUIET)
def test_what_is_not_made(name: str) -> None:
    assert made(*QUIET[name]) == []


def test_more_functions_than_are_followed() -> None:
    members = f"std::deque<{FUNCTION}> q_;\nvoid loop() {{ q_.front()(); }}"
    kept = "\n".join(f"q_.push_back({MAKE % f'a{number}'});" for number in range(450))
    assert len(made(members, "", kept)) <= 400
