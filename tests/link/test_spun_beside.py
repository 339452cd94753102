# SPDX-License-Identifier: Apache-2.0
"""ROS 2: executors that are spun in a thread: what callbacks set is not ruled out in loops, and after waits, beside them."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_main
from test_ros2_python import program

from haros_ci.model.architecture import Configuration

PYTHON = (
    "from std_msgs.msg import Bool\nimport threading, time\nclass N(Node):\n    def __init__(self):\n        super().__init__('n')\n"
    "        self.on = False\n        self.create_subscription(Bool, '/b', self.cb, 1)\n"
    "    def cb(self, m):\n        self.on = m.data\n    def make(self):\n        if self.on:\n            self.create_publisher(String, '/x', 1)\n"
    "    def run(self):\n        while rclpy.ok():\n            self.make()\n    def spinning(self):\n        rclpy.spin(self)\n"
    "    def other(self):\n        print(self.on)\n"
)
EXECUTOR = "e = rclpy.executors.MultiThreadedExecutor()\ne.add_node(n)\n"
THREAD = "threading.Thread(target=%s, daemon=True).start()\n"
CPP = (
    'class N : public rclcpp::Node { public:\nN() : Node("n") { s_ = create_subscription<String>("/b", 1, [this](String::SharedPtr) { on_ = true; }); }\n'
    'void make() { if (on_) { p_ = create_publisher<String>("/x", 1); } }\nvoid run() { while (rclcpp::ok()) { make(); } }\nvoid other() {}\n'
    "bool on_ = false; rclcpp::Subscription<String>::SharedPtr s_; rclcpp::Publisher<String>::SharedPtr p_; };\n"
)
ALONE = "rclcpp::executors::SingleThreadedExecutor"


def is_ruled_out(found: Configuration) -> bool:
    (end,) = (end for node in found.nodes for end in explicit(node))
    assert end.name == "/x"
    return end.is_ruled_out


@pytest.mark.parametrize(
    "body",
    [
        THREAD % "rclpy.spin, args=(n,)" + "n.run()",
        THREAD % "lambda: rclpy.spin(n)" + "n.run()",
        EXECUTOR + THREAD % "e.spin" + "n.run()",
        THREAD % "n.spinning" + "n.run()",
        EXECUTOR + THREAD % "e.spin" + "while True:\n    n.make()",
        THREAD % "rclpy.spin, args=(n,)" + "time.sleep(2)\nn.make()",
        THREAD % "rclpy.spin, args=(n,)" + "n.create_rate(1).sleep()\nn.make()",
        THREAD % "n.run" + "rclpy.spin(n)",
    ],
)
def test_a_flag_that_a_callback_sets_in_python(body: str) -> None:
    assert not is_ruled_out(program("n = N()\n" + body, PYTHON))


THREADS = "class T(threading.Thread):\n    def __init__(self, n):\n        super().__init__()\n        self.n = n\n    def run(self):\n        %s\n"


@pytest.mark.parametrize(("run", "expected"), [("rclpy.spin(self.n)", False), ("print(self.n)", True)])
def test_a_class_of_threads(run: str, expected: bool) -> None:
    assert is_ruled_out(program("n = N()\nT(n).start()\nn.run()", PYTHON + THREADS % run)) is expected


@pytest.mark.parametrize(
    ("way", "expected"),
    [
        ("lambda m: setattr(self, 'on', m.data)", False),
        ("lambda m: setattr(self, 'off', m.data)", True),
        ("lambda m: setattr(m, 'on', m.data)", True),
        ("lambda m: getattr(self, 'on', m.data)", True),
    ],
)
def test_what_a_callback_sets_by_its_name(way: str, expected: bool) -> None:
    text = PYTHON.replace("self.cb, 1)", f"{way}, 1)").replace(
        "self.create_sub", "self.create_timer(1.0, self.make)\n        self.create_sub"
    )
    assert is_ruled_out(program("n = N()\nrclpy.spin(n)", text)) is expected


@pytest.mark.parametrize(
    "body",
    [
        "n.run()",
        THREAD % "n.other" + "n.run()",
        THREAD % "rclpy.spin, args=(n,)" + "n.make()",
        "time.sleep(2)\nn.make()",
        "n.make()\n" + THREAD % "rclpy.spin, args=(n,)",
        "n.make()\nrclpy.spin(n)",
    ],
)
def test_what_no_callback_has_set_by_then_in_python(body: str) -> None:
    assert is_ruled_out(program("n = N()\n" + body, PYTHON))


@pytest.mark.parametrize(
    "body",
    [
        f"{ALONE} e; e.add_node(n); std::thread t([&e]() {{ e.spin(); }}); n->run();",
        "std::thread t([n]() { rclcpp::spin(n); }); n->run();",
        f"{ALONE} e; std::thread t(std::bind(&{ALONE}::spin, &e)); n->run();",
        f"auto e = std::make_shared<{ALONE}>(); std::thread t(&{ALONE}::spin, e); n->run();",
        "auto f = std::async(std::launch::async, [n]() { rclcpp::spin(n); }); n->run();",
        "std::thread t([n]() { rclcpp::spin(n); }); std::this_thread::sleep_for(1s); n->make();",
        "std::thread t([n]() { rclcpp::spin(n); }); rclcpp::Rate r(1); r.sleep(); n->make();",
    ],
)
def test_a_flag_that_a_callback_sets_in_cpp(body: str) -> None:
    assert not is_ruled_out(ros2_main("auto n = std::make_shared<N>();" + body, CPP))


@pytest.mark.parametrize(
    "body",
    [
        "n->run();",
        "std::thread t([n]() { n->other(); }); n->run();",
        "n->make(); std::thread t([n]() { rclcpp::spin(n); });",
        "std::this_thread::sleep_for(1s); n->make();",
        "std::function<void()> f = [n]() { rclcpp::spin(n); }; n->run();",
        "n->make(); rclcpp::spin(n);",
    ],
)
def test_what_no_callback_has_set_by_then_in_cpp(body: str) -> None:
    assert is_ruled_out(ros2_main("auto n = std::make_shared<N>();" + body, CPP))
