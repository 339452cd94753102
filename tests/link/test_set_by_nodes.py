# SPDX-License-Identifier: Apache-2.0
"""Parameters that nodes set while the system runs: who asks for them may find them, and no branch is ruled out for that."""

from __future__ import annotations

import pytest
from follow_kit import (
    CMAKE,
    PYTHON_HEAD,
    cpp,
    cpp_files,
    ends,
    follow,
    main,
    names,
    node,
    python,
    python_files,
    ros2_cpp,
)

from haros_ci.model.architecture import Node

SET = "void f(ros::NodeHandle& nh) { "
CALLED = "void cb(const std_msgs::String&) { ros::NodeHandle nh; "


def ruled_out(found: Node) -> list[str]:
    return sorted(end.name for end in found.endpoints if end.is_ruled_out)


#: What stands before ``main`` and in it: the same node may have set what it asks for, in an earlier run or call.
OPEN = (
    ("", 'if (nh.hasParam("x")) ADV("a", 1); else nh.setParam("x", 1);'),
    ("", 'if (nh.hasParam("x")) ADV("a", 1); nh.setParam("/x", 1);'),
    ("", 'if (ros::param::has("x")) ADV("a", 1); else ros::param::set("x", 1);'),
    ("", 'int i; if (nh.getParam("x", i)) ADV("a", 1); else nh.setParam("x", 1);'),
    ("", 'std::string k; if (nh.searchParam("x", k)) ADV("a", 1); else nh.setParam("x", 1);'),
    ("std::string text();", 'if (nh.hasParam("x")) ADV("a", 1); nh.setParam(text(), 1);'),
    ("std::string text();", 'if (nh.hasParam("s/x")) ADV("a", 1); nh.setParam("s/" + text(), 1);'),
    ("", 'if (nh.hasParam("s/x")) ADV("a", 1); XmlRpc::XmlRpcValue v; v["x"] = 1; nh.setParam("s", v);'),
    ("", 'if (nh.hasParam("s")) ADV("a", 1); nh.setParam("s/x", 1);'),
    (
        SET + 'if (nh.hasParam("x")) nh.advertise<std_msgs::String>("a", 1); else nh.setParam("x", 1); }',
        "f(nh); f(nh);",
    ),
    (
        CALLED + 'if (nh.hasParam("x")) nh.advertise<std_msgs::String>("a", 1); else nh.setParam("x", 1); }',
        'ros::Subscriber s = nh.subscribe("t", 1, cb);',
    ),
    (
        CALLED + 'nh.setParam("x", 1); }',
        'if (nh.hasParam("x")) ADV("a", 1); ros::Subscriber s = nh.subscribe("t", 1, cb);',
    ),
)


@pytest.mark.parametrize(("before", "code"), OPEN)
def test_what_the_node_sets_itself_may_be_there(before: str, code: str) -> None:
    found = cpp(code, before)
    assert names(found) == ["/a"]
    assert ruled_out(found) == []


#: The same in Python.
OPEN_PYTHON = (
    'if rospy.has_param("x"):\n    PUB("a")\nelse:\n    rospy.set_param("x", 1)',
    'if rospy.has_param("~x"):\n    PUB("a")\nrospy.set_param("~x", 1)',
    'if not rospy.has_param("x"):\n    rospy.set_param("x", 1)\nelse:\n    PUB("a")',
    'if rospy.search_param("x"):\n    PUB("a")\nelse:\n    rospy.set_param("x", 1)',
    'def cb(m):\n    rospy.set_param("x", 1)\nif rospy.has_param("x"):\n    PUB("a")\nrospy.Subscriber("t", String, cb)',
)


@pytest.mark.parametrize("code", OPEN_PYTHON)
def test_what_the_script_sets_itself_may_be_there(code: str) -> None:
    found = python(code + "\n")
    assert names(found) == ["/a"]
    assert ruled_out(found) == []


#: Nothing can set it: the branch is ruled out as before.
CLOSED = (
    'if (nh.hasParam("x")) ADV("a", 1); else ADV("b", 1);',
    'if (nh.hasParam("x")) ADV("a", 1); else nh.setParam("y", 1);',
    'if (nh.hasParam("x")) ADV("a", 1); nh.setParam("xx", 1);',
    'if (nh.hasParam("s/x")) ADV("a", 1); nh.setParam("s/y", 1);',
    'if (nh.hasParam("x")) ADV("a", 1); nh.deleteParam("x");',
    'if (nh.hasParam("x")) { ADV("a", 1); nh.setParam("x", 1); }',
    'int i; if (nh.getParam("x", i)) ADV("a", 1); int k; nh.param("x", k, 1);',
)


@pytest.mark.parametrize("code", CLOSED)
def test_what_nothing_sets_is_not_there(code: str) -> None:
    assert ruled_out(cpp(code))[:1] == ["/a"]


def test_search_param_of_python_gives_nothing_where_nothing_sets_it() -> None:
    found = python('if rospy.search_param("x"):\n    PUB("a")\nelse:\n    PUB("b")\n')
    assert names(found) == ["/a", "/b"]
    assert ruled_out(found) == []


#: What is read is as in the first run.
VALUES = (
    ('std::string s; nh.param<std::string>("x", s, "a"); nh.setParam("x", s); ADV(s, 1);', "/a"),
    ('std::string s; nh.param<std::string>("x", s, "a"); nh.setParam("x", "b"); ADV(s, 1);', "/a"),
    ('std::string s = "a"; if (!nh.getParam("x", s)) nh.setParam("x", s); ADV(s, 1);', "/a"),
    ('std::string s = "a"; if (!nh.getParam("x", s)) { s = "b"; nh.setParam("x", s); } ADV(s, 1);', "/b"),
    ('std::string s = "a"; nh.getParam("x", s); nh.setParam("x", "b"); ADV(s, 1);', "/a"),
)


@pytest.mark.parametrize(("code", "expected"), VALUES)
def test_values_that_the_node_sets_itself(code: str, expected: str) -> None:
    assert names(cpp(code)) == [expected]


READ = 'std::string s; nh.param<std::string>("/t", s, "a"); ADV(s, 1);'
GET = 'std::string s = "a"; nh.getParam("/t", s); ADV(s, 1);'
#: What another node does, what this one does, more of the launch file, and the name that follows.
OTHERS = (
    ('rospy.set_param("/t", "b")', READ, "", "/?"),
    ('rospy.set_param("/t", "b")', GET, "", "/?"),
    ('rospy.set_param("/t", "b")', READ, '<param name="/t" value="c"/>', "/?"),
    ('rospy.set_param("/s/t", "b")', 'std::string s = "a"; nh.getParam("/s/t", s); ADV(s, 1);', "", "/?"),
    ('rospy.delete_param("/t")', READ, '<param name="/t" value="c"/>', "/?"),
    ('rospy.set_param("/t", "a")', READ, "", "/a"),
    ('rospy.set_param("/t", "c")', READ, '<param name="/t" value="c"/>', "/c"),
    ('rospy.set_param("/u", "b")', READ, '<param name="/t" value="c"/>', "/c"),
    ('rospy.set_param("~t", "b")', READ, "", "/a"),
    ('rospy.delete_param("/t")', READ, "", "/a"),
    ('rospy.get_param("/t", "b")', READ, "", "/a"),
    ('import q\nrospy.set_param(q.name, "b")', READ, "", "/a"),
)


def two(setter: str, reader: str, more: str = "") -> list[Node]:
    launch = '<launch><node pkg="p" type="n.py" name="s"/><node pkg="q" type="r" name="r"/>%s</launch>' % more
    files = python_files(f'{PYTHON_HEAD}rospy.init_node("s")\n{setter}\n') | {
        "q/CMakeLists.txt": CMAKE.format("q") + "add_executable(r main.cpp)\n",
        "q/main.cpp": main(reader),
        "q/launch/l.launch": launch,
    }
    (configuration,) = follow(files).configurations
    return sorted(configuration.nodes, key=lambda each: each.name)


@pytest.mark.parametrize(("setter", "reader", "more", "expected"), OTHERS)
def test_what_another_node_sets_may_be_read(setter: str, reader: str, more: str, expected: str) -> None:
    reading, _ = two(setter, reader, more)
    assert names(reading) == [expected]


def test_what_another_node_sets_may_be_there() -> None:
    reading, _ = two('rospy.set_param("/t", "b")', 'if (nh.hasParam("/t")) ADV("a", 1); else ADV("b", 1);')
    assert ruled_out(reading) == []


def test_what_another_node_deletes_may_be_gone() -> None:
    code = 'if (nh.hasParam("/t")) ADV("a", 1); else ADV("b", 1);'
    reading, _ = two('rospy.delete_param("/t")', code, '<param name="/t" value="c"/>')
    assert ruled_out(reading) == []


def test_a_node_of_another_configuration_sets_nothing_here() -> None:
    files = cpp_files(main('if (nh.hasParam("/t")) ADV("a", 1);')) | {
        "q/CMakeLists.txt": CMAKE.format("q") + "add_executable(r main.cpp)\n",
        "q/main.cpp": main('nh.setParam("/t", 1);'),
    }
    found = {each.name: each for each in follow(files).configurations}
    assert ruled_out(found["p/n"].nodes[0]) == ["/a"]


def test_what_is_ruled_out_sets_nothing() -> None:
    reading, _ = two('if rospy.has_param("/u"):\n    rospy.set_param("/t", "b")', READ)
    assert names(reading) == ["/a"]


TIMER = "rclcpp::TimerBase::SharedPtr t_;"
#: ROS 2: a callback may run again, and finds what it declared or noted before.
AGAIN = (
    't_ = create_wall_timer(1s, [this]() { if (!has_parameter("x")) declare_parameter("x", 1); else create_publisher<String>("a", 1); });',
    't_ = create_wall_timer(1s, [this]() { if (has_parameter("x")) create_publisher<String>("a", 1); declare_parameter("x", 1); });',
    't_ = create_wall_timer(1s, [this]() { if (!done_) { done_ = true; } else { create_publisher<String>("a", 1); } });',
    't_ = create_wall_timer(1s, [this]() { if (done_) { create_publisher<String>("a", 1); } done_ = elsewhere(); });',
    't_ = create_wall_timer(1s, [this]() { if (!done_) { done_ = true; return; } create_publisher<String>("a", 1); });',
)


@pytest.mark.parametrize("code", AGAIN)
def test_a_callback_runs_again(code: str) -> None:
    (found,) = ros2_cpp(code, f"bool done_ = false; {TIMER}", "bool elsewhere();\n").nodes
    assert ruled_out(found) == []
    assert names(found).count("/a") == 1


#: What runs once has not declared it before.
ONCE = (
    'if (!has_parameter("x")) declare_parameter("x", 1); else create_publisher<String>("a", 1);',
    'if (has_parameter("x")) create_publisher<String>("a", 1); declare_parameter("x", 1);',
    'if (!done_) { done_ = true; } else { create_publisher<String>("a", 1); }',
    't_ = create_wall_timer(1s, [this]() { if (done_) create_publisher<String>("a", 1); });',
    't_ = create_wall_timer(1s, [this]() { if (has_parameter("x")) create_publisher<String>("a", 1); });',
    't_ = create_wall_timer(1s, [this]() { if (done_) create_publisher<String>("a", 1); done_ = false; });',
)


@pytest.mark.parametrize("code", ONCE)
def test_what_nothing_changes_stays(code: str) -> None:
    (found,) = ros2_cpp(code, f"bool done_ = false; {TIMER}").nodes
    assert ruled_out(found) == ["/a"]


def test_a_nodelet_finds_what_it_has_set() -> None:
    files = cpp_files(main('nh.setParam("x", 1); if (nh.hasParam("x")) ADV("a", 1); else ADV("b", 1);'))
    (ruled,) = (end for end in ends(node(follow(files))) if end.is_ruled_out)
    assert ruled.name == "/b"
