# SPDX-License-Identifier: Apache-2.0
"""Objects whose owner is given on, constant references, and members that a parameter initializes."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_doubts import is_refuted

POINTER = "Non-local variable 'view_.first' will use pointer to local variable 'task'."
OBJECT = "Non-local variable 'tasks_' will use object that points to local variable 'task'."
UNIQUE = "  auto task = std::make_unique<Task>();\n"
SHARED = "  auto task = std::make_shared<Task>();\n"
KEEP = "  view_.first = task.get();\n"


def function(body: str, head: str = "void Pool::add(int id)") -> str:
    return f"{head}\n{{\n{body}}}\n"


def dangles(text: str, message: str = POINTER) -> bool:
    lines = text.split("\n")
    line = next(number for number, item in enumerate(lines, 1) if "view_" in item or "tasks_" in item)
    return not is_refuted("danglingLifetime", message, line, text)


GIVEN_ON = [
    function(UNIQUE + KEEP + "  all_.push_back(std::move(task));\n"),
    function("  std::unique_ptr<Task> task(new Task);\n" + KEEP + "  all_.emplace_back(std::move(task));\n"),
    function("  std::unique_ptr<Task> task{new Task};\n" + KEEP + "  owner_ = std::move(task);\n"),
    function(UNIQUE + "  view_.first = &task->item;\n  owner_ = std::move(task);\n"),
    function(UNIQUE + "  view_.first = &*task;\n  owner_.reset(task.release());\n"),
    function(UNIQUE + KEEP + "  return task;\n", "std::unique_ptr<Task> Pool::add(int id)"),
    function(KEEP + "  owner_ = std::move(task);\n", "void Pool::add(std::unique_ptr<Task> task)"),
    function(KEEP + "  publish(std::move(task));\n", "void Pool::add(msg::Task::UniquePtr task)"),
    function(SHARED + KEEP + "  owner_ = task;\n"),
    function(SHARED + KEEP + "  all_.push_back(task);\n"),
    function("  std::shared_ptr<Task> task(new Task(id));\n" + KEEP + "  all_.insert({id, task});\n"),
    function("  CloudPtr task(new Cloud);\n" + KEEP + "  clouds_[id] = task;\n"),
]


@pytest.mark.parametrize("text", GIVEN_ON)
@pytest.mark.parametrize("message", [POINTER, OBJECT])
def test_who_is_given_the_owner_has_the_object(text: str, message: str) -> None:
    assert not dangles(text, message)


@pytest.mark.parametrize(
    "text",
    [
        function(UNIQUE + KEEP),
        function(UNIQUE + KEEP + "  // all_.push_back(std::move(task));\n"),
        function(UNIQUE + KEEP + "  all_.push_back(std::move(other));\n"),
        function(UNIQUE + KEEP + "  task.reset();\n"),
        function(UNIQUE + KEEP + "  run(*task);\n"),
        function(UNIQUE + "  view_.first = &task;\n  all_.push_back(std::move(task));\n"),
        function(SHARED + KEEP),
        function(SHARED + KEEP + "  print(task->name);\n"),
        function("  Task task;\n  view_.first = &task;\n  all_.push_back(std::move(task));\n"),
        function("  Task task;\n  view_.first = task.data();\n  all_.push_back(task);\n"),
        function('  std::string task = "a";\n  view_.first = task.c_str();\n  all_.push_back(std::move(task));\n'),
        function("  std::array<int, 3> task;\n  view_.first = task.data();\n  kept_ = task;\n"),
        function(UNIQUE + KEEP)
        + function("  owner_ = std::move(task);\n", "void Pool::drop(std::unique_ptr<Task> task)"),
    ],
)
def test_nobody_else_has_the_object(text: str) -> None:
    assert dangles(text)


def test_a_lambda_has_the_place_of_the_pointer() -> None:
    said = "Non-local variable 'tasks_' will use lambda that captures local variable 'task'."
    assert dangles(function(SHARED + "  tasks_ = [&task] { task->run(); };\n  owner_ = task;\n"), said)


PATH = "Non-local variable 'view_' will use object that points to local variable 'below'."
REST = '  if (stat(view_.c_str(), &s) != 0) {\n    return 0;\n  }\n  std::string below = view_ + "/a";\n  return size(below);\n'


@pytest.mark.parametrize(
    ("head", "expected"),
    [
        ("int size(const std::string & view_)", False),
        ("int size(const std::string& view_, int depth = 0)", False),
        ("int size(int depth, std::string const & view_)", False),
        ("int size(const std::vector<std::string> & view_)", False),
        ("int size(std::string & view_)", True),
        ("int size(std::string_view & view_)", True),
        ("int size(const char ** view_)", True),
        ("int size(const Path & other, View & view_)", True),
        ("int size(const Path & other)", True),
    ],
)
def test_nothing_is_set_through_a_constant_reference(head: str, expected: bool) -> None:
    assert dangles(function(REST, head), PATH) is expected


ITSELF = "Member variable 'rate' is initialized by itself."


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("struct Node { int rate; Node(int rate) : rate(rate) {} };", 1),
        ("struct Node { int rate; Node(int rate = 3) noexcept(false) : rate{rate} {} };", 1),
        ("struct Node { int rate; Node(int rate) noexcept : rate{rate} {} };", 1),
        ("template <class T>\nNode<T>::Node(T a, T rate)\n: a(a),\n  rate(rate)\n{}\n", 4),
        ("template <class T>\nNode<T>::Node(T a, T rate)\n: a(a),\n  rate(rate)\n{}\n", 3),
        ("Node::Node(std::map<int, std::string> all, double rate)\n  : Base(name(all), {1, 2}), rate(rate) {}\n", 2),
        ("#define NODE(name) name(int rate) : rate(rate) {}\n", 1),
        ("Node::Node(int rate[3]) : rate(rate) {}\n", 1),
    ],
)
def test_a_parameter_initializes_the_member(text: str, line: int) -> None:
    assert is_refuted("selfInitialization", ITSELF, line, text)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("struct Node { int rate; Node(int rate_) : rate(rate) {} };", 1),
        ("struct Node { int rate; Node() : rate(rate) {} };", 1),
        ("struct Node { int rate; Node(int rates) : rate{rate} {} };", 1),
        ("struct Node { int rate; Node(int /*rate*/) : rate(rate) {} };", 1),
        ("struct Node { int rate; Node(Config rate_) : other(f(rate_)), rate(rate) {} };", 1),
        ("struct Node { int rate; Node(rate::Type a) : rate(rate) {} };", 1),
        ("struct Node { int rate; Node(int a = rate + 1) : rate(rate) {} };", 1),
        ("void set(int rate);\nNode::Node(int a)\n: rate(rate)\n{}\n", 3),
        ("Node::Node(int rate);\nNode::Node(int a) noexcept(true)\n: rate(rate)\n{}\n", 3),
        ("Node::Node(int rate) {}\nint rate(rate);\n", 2),
        ("int rate(rate);\n", 1),
        ("", 1),
    ],
)
def test_a_member_initializes_itself(text: str, line: int) -> None:
    assert not is_refuted("selfInitialization", ITSELF, line, text)


GONE = "Access of moved variable 'force'."


@pytest.mark.parametrize(
    ("declared", "expected"),
    [
        ("blaze::StaticVector<double, 5UL> force, last, start;", True),
        ("blaze::StaticVector<double, 5UL> last, start, force;", True),
        ("Eigen::Vector3d force(0, 0, 0);", True),
        ("Vector4f force = start();", True),
        ("Eigen::Matrix<double, 6, 1> force;", True),
        ("std::array<double, 3> force{};", True),
        ("cv::Point2f force;", True),
        ("tf2::Vector3 force;", True),
        ("Eigen::VectorXd force;", False),
        ("Eigen::Matrix<double, Eigen::Dynamic, 1> force;", False),
        ("blaze::DynamicVector<double> force;", False),
        ("std::vector<double> force;", False),
        ("std::array<std::string, 3> force;", False),
        ("std::unique_ptr<Eigen::Vector3d> force;", False),
        ("std::vector<Eigen::Vector3d> force;", False),
        ("Eigen::Vector3d forces;", False),
        ("// Eigen::Vector3d force;", False),
        ("auto force = start();", False),
        ("cv::Mat force;", False),
    ],
)
def test_what_a_move_copies(declared: str, expected: bool) -> None:
    text = function(f"  {declared}\n  last = std::move(force);\n  return last - force;\n")
    assert is_refuted("accessMoved", GONE, 5, text) is expected
    other = function(f"  {declared}\n") + function("  last = std::move(force);\n  return force;\n", "void Pool::drop()")
    assert not is_refuted("accessMoved", GONE, 8, other)
